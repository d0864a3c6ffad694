#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# python-can sends to and hears the simulated bus over its socketcand port. usage: test_python_can.sh BUILD
set -eu
out=$(mktemp)
"$1/tests/sim/bus/serve_bus" 20 720 >"$out" &
server=$!
trap 'kill $server 2>/dev/null; rm -f "$out"' EXIT
for _ in 1 2 3 4 5 6 7 8 9 10; do
    port=$(head -n 1 "$out")
    [ -n "$port" ] && break
    sleep 0.2
done
/usr/bin/python3 tests/sim/bus/socketcand_with_python_can.py "$port" can0
