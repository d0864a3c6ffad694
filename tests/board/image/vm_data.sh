#!/bin/bash
# shellcheck disable=SC2016,SC2119 # the board expands what is in commands; card_power: with options or without
# SPDX-License-Identifier: Apache-2.0
# The data partition of an image on the virtual board: it grows to the card's end, is repaired with its settings, made
# anew when that fails, may be full or missing. The board always starts, and wall, console and bus say what is wrong.
# Usage, from the tree's root: tests/board/image/vm_data.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
set -u
build=${1:?usage: vm_data.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/board/image/bundles.sh
. tests/board/image/updates.sh
. tests/support/checks.sh
no_room='/data/room.yaml:1: file: cannot be opened (No such file or directory), expected a room file in YAML'
config_fault=' fault .* 0x200 '

# As make flash does: the room file is on the data partition.
insert() {
    card_insert build/vm-data "$build/wallwarp-qemu-virt.img" || return
    sed 's|^room:.*|room: /data/room.yaml|' board/qemu-virt/wallwarp.yaml >"$VM/wallwarp.yaml"
    mcopy -o -i "$VM/card@@$(card_at card)" "$VM/wallwarp.yaml" ::wallwarp.yaml &&
        debugfs -w -R "write board/qemu-virt/room.yaml room.yaml" "$VM/card?offset=$(card_at data)" >/dev/null 2>&1
}

# starts WHAT BOARD REASON: with the card as it is now; soon the wall shows the safe picture with this.
starts() {
    card_power
    card_up 300
    ok $? "$1: the board does not start: $(tail -n 5 "$VM/console")"
    wall "$@"
}

wall() {
    local i
    for ((i = 0; i < 60; i++)); do
        # As large as it is: without a room the display has its own size. The words are width and height.
        # shellcheck disable=SC2046
        vm_screenshot "$VM/seen.ppm" &&
            "$host/tests/board/picture_tool" safe $(sed -n 2p "$VM/seen.ppm") 1 "$2" "$3" | cmp -s - "$VM/seen.ppm" && return
        sleep 0.5
    done
    ok 1 "$1: the wall does not say \"$3\"; the firmware: $(card_run 'systemctl show wallwarp -p StatusText')"
}

# told WHAT: the console has this of the data partition.
told() {
    tr -d '\r' <"$VM/console" | grep -aq "wallwarp: data: $1"
    ok $? "the console does not say \"$1\""
}

room_kept() {
    card_run 'cat /data/room.yaml' | cmp -s - board/qemu-virt/room.yaml
    ok $? "$1: the room file is not what it was"
}

# over BYTES FROM: writes these, as printf reads them, onto the card, from this byte of the data partition.
over() {
    printf '%b' "$1" | dd of="$VM/card" bs=4096 seek=$(($(card_at data) + $2)) oflag=seek_bytes conv=notrunc status=none
}

# damage: the first superblock, and the inode of the log's folder.
damage() {
    local data at
    data="$VM/card?offset=$(card_at data)"
    # "located at block B, offset 0xO"
    at=$(debugfs -R 'imap /log' "$data" 2>/dev/null | sed -n 's/.*block \([0-9]*\), offset \(0x[0-9a-f]*\).*/\1 * 4096 + \2/p')
    over "$(printf '\\0377%.0s' {1..256})" $((at))
    over "$(printf '\\0125%.0s' {1..2048})" 0
    ! e2fsck -fn "$data" >/dev/null 2>&1
}

grown() {
    local i
    for ((i = 0; i < 60; i++)); do
        [ "$(card_run 'df -m /data' | awk 'END { print $2 }')" -gt 400 ] && return 0
        sleep 0.5
    done
    return 1
}

trap vm_stop EXIT
insert
ok $? "no card can be made"
bundle_make "$VM/web/2.0.raucb" 2.0
ok $? "no bundle can be made"
starts "at first" front 'no pose yet'
grown
ok $? "the file system does not fill the card: $(card_run 'df -m /data; journalctl -b -u wallwarp-grow')"
card_run 'sync'

vm_stop
damage
ok $? "the file system is not damaged"
starts "damaged" front 'no pose yet'
told 'is damaged, repairing it'
room_kept "damaged"

# Full, and the first partition table with a wrong sum: what a lost supply leaves when it is being written.
data_fill
ok $? "the data partition can't be filled"
vm_stop
printf '\125\252\125\252' | dd of="$VM/card" bs=1 seek=$((512 + 16)) conv=notrunc status=none
starts "full" front 'no pose yet'
room_kept "full"
card_run 'systemctl start wallwarp-grow && sfdisk -V /dev/vda 2>&1' >"$VM/table"
! grep -q corrupt "$VM/table"
ok $? "the first partition table is not mended: $(cat "$VM/table")"
request 'install http://10.0.2.100/2.0.raucb'
becomes state=failed && said | grep -q '^message=the data partition is too full for http://10.0.2.100/2.0.raucb'
ok $? "full: an update over the network: it says $(said | tr '\n' ' ')"
stick_plug "$VM/web/2.0.raucb" && becomes 'state=ready waiting=2.0'
ok $? "full: an update from a stick: it says $(said | tr '\n' ' ')"

vm_stop
# Its superblocks, too; the last sectors of the card are the partition table's copy.
fallocate --punch-hole -o "$(card_at data)" -l 512M "$VM/card"
starts "past repair" qemu-virt "$no_room"
told 'cannot be repaired, making it anew: room file, key and log are gone'
card_run "ip link set can1 up txqueuelen 64 type can bitrate 500000
    timeout 5 wallwarp-pose monitor --bus can1" >"$VM/monitored"
grep -q "$config_fault" "$VM/monitored"
ok $? "past repair: the bus: $(tail -n 3 "$VM/monitored")"

vm_stop
sfdisk -q --part-label "$VM/card" 7 other >/dev/null
starts "no partition" qemu-virt "$no_room"
told 'the card has no partition "data"; settings and log are lost when the board goes off'
ok_end
