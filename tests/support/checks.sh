# shellcheck shell=sh
# SPDX-License-Identifier: Apache-2.0
# Counts what a script's tests found, for scripts to source.
#
#   ok STATUS WHAT    one test: good when STATUS is 0; else WHAT is printed, and what is in the files $ok_files. STATUS is
#                     first, as a command inside WHAT would change it
#   ok_end            prints the last line of a script's output; its status is the script's
passed=0
failed=0

ok() {
    if [ "$1" = 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $2"
        for ok_file in ${ok_files-}; do
            sed "s/^/    ${ok_file##*/}: /" "$ok_file"
        done
    fi
}

ok_end() {
    echo "$passed passed, $failed failed"
    [ "$failed" = 0 ]
}
