# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Counts what a script's tests found, for scripts to source.
passed=0
failed=0

# ok WHAT STATUS: one test. WHAT is printed when STATUS is not 0.
ok() {
    if [ "$2" = 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1"
    fi
}

# The script's last line, and its exit status.
ok_end() {
    echo "$passed passed, $failed failed"
    [ "$failed" = 0 ]
}
