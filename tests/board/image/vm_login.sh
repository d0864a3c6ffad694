#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Who can log in to an image on the virtual board, and what is found there: nobody but who has a key of the card's; the
# log, which a card in a PC has, too; --check; a clock that is no older than the image, though the board's says 1970.
# Usage, from the tree's root: tests/board/image/vm_login.sh BUILD_FOLDER_OF_THE_BOARD
set -u
build=${1:?usage: vm_login.sh BUILD_FOLDER_OF_THE_BOARD}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/support/checks.sh

# login KEY [OPTION...] COMMAND: as root, with the key and nothing else.
login() {
    local key=$1
    shift
    ssh -F none -i "$VM/$key" -p "$port" -o IdentitiesOnly=yes -o BatchMode=yes -o ConnectTimeout=120 -o LogLevel=ERROR \
        -o StrictHostKeyChecking=accept-new -o "UserKnownHostsFile=$VM/known" root@127.0.0.1 "$@"
}

# The port of this machine that leads to the board's.
forwarded() {
    vm_monitor 'info usernet' | grep -o 'HOST_FORWARD.*' | awk '{ print $4 }'
}

# said WHAT PATTERN: the last command's output has it.
said() {
    grep -q "$2" "$VM/said"
    ok $? "$1: expected $2, it said: $(head -c 2000 "$VM/said")"
}

trap vm_stop EXIT
card_insert build/vm-login "$build/wallwarp-qemu-virt.img" || exit 1
ssh-keygen -q -t ed25519 -N '' -C '' -f "$VM/owner" && ssh-keygen -q -t ed25519 -N '' -C '' -f "$VM/stranger"
mcopy -i "$VM/card@@1M" "$VM/owner.pub" ::/authorized_keys
ok $? "the key can't be put onto the card"
card_power -rtc base=1970-01-01,clock=vm
card_up 300
ok $? "the board does not start: $(tail -n 5 "$VM/console")"
vm_monitor "hostfwd_add net tcp:127.0.0.1:0-:22" >/dev/null
port=$(forwarded)
# It makes a key of its own first.
for ((i = 0; i < 60; i++)); do
    login owner true 2>"$VM/said" && break
    sleep 1
done

login owner 'id -un; hostname; resolvectl mdns' >"$VM/said" 2>&1
said "with a key of the card's" '^root$'
said "its name" '^wallwarp-1$'
said "its name, by multicast" '^Link .* (eth0): yes$'
! login stranger id >"$VM/said" 2>&1
ok $? "a stranger's key logs in"
said "a stranger's key" 'Permission denied (publickey)'
! login stranger -o PubkeyAuthentication=no -o PreferredAuthentications=password,keyboard-interactive,none id >"$VM/said" 2>&1
ok $? "no key logs in"
said "no key" 'Permission denied (publickey)'

login owner 'journalctl -u wallwarp; wallwarp --check --config /etc/wallwarp/wallwarp.yaml; date +%s' >"$VM/said" 2>&1
said "journalctl" 'wallwarp\['
said "--check" '^found    updates: slot A, version .*, marked good'
said "--check" '^found    can can0: 500000 bit/s'
said "--check" '^found    gpio '
! grep -v '^found' "$VM/said" | grep -E '^(missing|advice)'
ok $? "--check: something is missing, or could be better"
[ "$(tail -n 1 "$VM/said")" -ge "$(stat -c %Y "$build"/image/root/usr/lib/clock-epoch)" ]
ok $? "the clock is older than the image: $(tail -n 1 "$VM/said")"
login owner 'cat >/data/room.new && sync && mv /data/room.new /data/room.yaml && md5sum </data/room.yaml' \
    <sim/demo/room.yaml >"$VM/said"
said "a room file by SSH" "$(md5sum <sim/demo/room.yaml)"
# The firmware reads once a second what the update agent says.
login owner 'sleep 2; wallwarp-pose command --bus can0 --node 1 hello
    wallwarp-pose update --bus can0 /card/room.yaml --status' >"$VM/said" 2>&1
said "commands from the board itself" '^board 1: wallwarp '
said "updates from the board itself" '^ *1  *A  *front: runs .*, idle$'

login owner sync >"$VM/said" 2>&1
vm_stop
start=$(sfdisk -d "$VM/card" 2>/dev/null | sed -n 's/.*start= *\([0-9]*\),.*name="data".*/\1/p')
mkdir "$VM/log"
debugfs -R "rdump /log/journal $VM/log" "$VM/card?offset=$((start * 512))" 2>"$VM/said"
journalctl -D "$VM/log/journal" -u wallwarp >"$VM/said" 2>&1
said "journalctl of the card" 'wallwarp\['
ok_end
