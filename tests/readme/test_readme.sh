#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Run every command of the README and of the page of wallwarp-pose, block by block, as a user would paste it.
# usage: test_readme.sh BUILD
#
# Not two blocks: the first is the test run itself and the demo, which call this script or are called beside it; the other
# builds for a board, which takes more packages than `make test` does, and which `make boards` does for all.
set -u
[ "$1" = build/host ] || { echo "the README's commands use build/host, not $1"; exit 1; }
passed=0 failed=0 number=0
block=
while IFS= read -r line; do
    case $line in
    '```sh') block=begin text= ;;
    '```')
        if [ -n "$block" ] && [[ $text != *'make test'* && $text != *'make BOARD='* ]]; then
            number=$((number + 1))
            if bash -e -c "$text" >build/readme.log 2>&1; then
                passed=$((passed + 1))
                echo "ok      $(head -n 1 <<<"$text")"
            else
                failed=$((failed + 1))
                echo "FAILED  $text"
                tail -n 20 build/readme.log
            fi
        fi
        block=
        ;;
    *) [ -z "$block" ] || text+=$line$'\n' ;;
    esac
done < <(cat README.md sim/pose/README.md)
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
