#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The service's files: systemd takes the unit, its commands are ones that the firmware takes, the bus has the bit rates of
# a room that states none. usage: test_service.sh BUILD, from the tree's root
set -u
. tests/support/checks.sh
wallwarp=$(realpath "$1")/wallwarp
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# As it is installed, but with the program that was built.
sed "s|/usr/local/bin/wallwarp|$wallwarp|; s|/etc/wallwarp/|$folder/|" board/service/wallwarp.service >"$folder/wallwarp.service"
cp board/service/wallwarp.yaml sim/demo/room.yaml "$folder"
SYSTEMD_LOG_LEVEL=warning systemd-analyze verify --man=no "$folder/wallwarp.service" >"$folder/said" 2>&1 &&
    [ ! -s "$folder/said" ]
ok $? "systemd-analyze verify: $(cat "$folder/said")"

# A command of the unit.
command_of() {
    sed -n "s/^$1=//p" "$folder/wallwarp.service"
}
sh -c "$(command_of ExecStart) --check" >"$folder/said" 2>&1
ok $? "ExecStart, with --check: $(cat "$folder/said")"
grep -q "found    room: $folder/room.yaml, node 1" "$folder/said"
ok $? "ExecStart names no room: $(cat "$folder/said")"

# Every key that may be left out is in the file, as a comment, and becomes right without it.
sed 's/^# \([a-z]*: \)/\1/; s|^key: .*|key: room.key|; s|^can: .*|can: 0|; s|^camera: .*|camera: pattern|
    s|^display: .*|display: none|' board/service/wallwarp.yaml >"$folder/wallwarp.yaml"
(umask 077 && echo 00112233445566778899aabbccddeeff >"$folder/room.key")
sh -c "$(command_of ExecStart) --check" >"$folder/said" 2>&1
ok $? "ExecStart, with every key and --check: $(cat "$folder/said")"
for key in node room key can camera display workers; do
    grep -q "^$key: " "$folder/wallwarp.yaml"
    ok $? "wallwarp.yaml does not show the key $key"
done
sh -c "$(command_of ExecStopPost)" >"$folder/said" 2>&1
ok $? "ExecStopPost: $(cat "$folder/said")"

for line in 'Type=notify' 'Restart=always' 'WatchdogSec=' 'LimitRTPRIO=' 'LimitMEMLOCK=infinity' 'User=wallwarp'; do
    grep -q "^$line" board/service/wallwarp.service
    ok $? "the unit has no $line"
done
for line in 'BitRate=500K' 'DataBitRate=2M' 'FDMode=yes' 'RestartSec='; do
    grep -q "^$line" board/service/80-wallwarp-can.network
    ok $? "the network file has no $line"
done
# The update agent is in images only: see board/image/update_files.sh.
for file in board/service/*; do
    case $file in *README.md | *wallwarp-stick* | *wallwarp-trial* | *wallwarp-update* | *rauc-*) continue ;; esac
    grep -q "install .*$(basename "$file")" board/service/README.md
    ok $? "the page does not install $file"
done

ok_end
