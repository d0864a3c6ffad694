#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Run a build of golden_hashes (the words of the command line) and compare what it prints with hashes.txt.
expected=$(dirname "$0")/hashes.txt
if difference=$("$@" | diff "$expected" -); then
    echo "1 passed, 0 failed"
else
    echo "$*: differs from $expected ('<' expected, '>' got):"
    echo "$difference" | head -n 10
    echo "0 passed, 1 failed"
    exit 1
fi
