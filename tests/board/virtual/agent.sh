#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs on the virtual board: takes names of jobs from the host, one a line, and runs each beside the others.
export PATH=/usr/sbin:/usr/bin HOME=/root
cd /root || exit 1
touch /share/up
while read -r job; do
    folder=/share/jobs/$job
    {
        # shellcheck source=/dev/null # the host's
        (. "$folder/command") >"$folder/output" 2>&1 </dev/null
        echo $? >"$folder/status"
    } &
done <"$(echo /dev/vport*p1)"
