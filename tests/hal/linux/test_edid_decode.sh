#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# edid-decode finds no fault in the EDID of HDMI receivers, and reads the mode that was meant.
# Usage, from the tree's root: tests/hal/linux/test_edid_decode.sh BUILD_FOLDER
set -u
build=${1:?usage: test_edid_decode.sh BUILD_FOLDER}
passed=0
failed=0

# judge "WIDTH HEIGHT FRAMES SECONDS" MODE: MODE as edid-decode prints the first detailed timing.
judge() {
    # shellcheck disable=SC2086 # four words
    said=$("$build/tests/hal/linux/print_edid" $1 | edid-decode --check)
    mode=$(echo "$said" | sed -n 's/.*DTD 1: *//p' | tr -s ' ' | cut -d ' ' -f 1,2)
    if [ "$mode" != "$2" ] || ! echo "$said" | grep -q 'EDID conformity: PASS' || echo "$said" | grep -q 'Warnings:'; then
        echo "EDID of $1: mode \"$mode\", expected \"$2\"; edid-decode says:"
        echo "$said"
        failed=$((failed + 1))
    else
        passed=$((passed + 1))
    fi
}

judge '1920 1080 60 1' '1920x1080 60.000000'
judge '1920 1080 60000 1001' '1920x1080 59.939394'
judge '1920 1080 50 1' '1920x1080 50.000000'
judge '1280 720 60 1' '1280x720 60.000000'
judge '640 480 60 1' '640x480 60.000000'
judge '3840 2160 30 1' '3840x2160 30.000000'
judge '1280 800 60 1' '1280x800 59.909545'
judge '1920 1200 60 1' '1920x1200 59.950171'
judge '1366 768 60 1' '1366x768 59.931649'
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
