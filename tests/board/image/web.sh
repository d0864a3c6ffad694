#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Answers one HTTP request, from stdin to stdout, with a file of a folder: tests/board/image/web.sh FOLDER
read -r _ path _
while read -r line && [ "${line%$'\r'}" ]; do :; done
file=$1/${path##*/}
if [ -f "$file" ]; then
    printf 'HTTP/1.0 200 OK\r\nContent-Length: %s\r\n\r\n' "$(stat -c %s "$file")"
    exec cat "$file"
fi
printf 'HTTP/1.0 404 Not Found\r\nContent-Length: 0\r\n\r\n'
