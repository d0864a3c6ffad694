#!/bin/bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# A board with a second card in a USB reader: it stays with its own, whose partitions have the same names.
# Usage, from the tree's root: tests/board/image/vm_two_cards.sh BUILD_FOLDER_OF_THE_BOARD
set -u
build=${1:?usage: vm_two_cards.sh BUILD_FOLDER_OF_THE_BOARD}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/support/checks.sh

trap vm_stop EXIT
card_insert build/vm-two-cards "$build/wallwarp-qemu-virt.img" || exit 1
cp --sparse=always "$build/wallwarp-qemu-virt.img" "$VM/reader"
card_power -drive "file=$VM/reader,format=raw,if=none,id=reader" -device usb-storage,drive=reader
card_up 600
ok $? "the board does not start"
# A reader is announced seconds after the shell is there.
card_run 'for i in 1 2 3 4 5 6 7 8 9 10; do [ -e /dev/sda7 ] && break; sleep 1; done; udevadm settle
    lsblk -nro NAME /dev/sda' | grep -q sda7
ok $? "the second card is not seen: $(card_run 'lsblk -nro NAME')"
for name in card state kernel-a root-a kernel-b root-b data; do
    device=$(card_run "readlink -f /dev/disk/by-partlabel/$name")
    [[ $device == */vda? ]]
    ok $? "$name is $device, expected a partition of the board's own card"
done
for folder in / /card /data; do
    device=$(card_run "findmnt -no SOURCE $folder")
    [[ $device == */vda? ]]
    ok $? "$folder is $device, expected a partition of the board's own card"
done
ok_end
