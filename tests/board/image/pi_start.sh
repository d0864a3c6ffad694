#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The Raspberry Pi 4's image, flashed as a card of the virtual board's room, on QEMU's Pi 3: the card's own U-Boot and
# script, kernel, system and firmware, which says that this is not its board. What of it is a Pi 4's is not there: the
# chip's ROM and firmware, HDMI, SPI and the hat, Ethernet; pi_card.sh looks at the files for these.
# Usage, from the tree's root: tests/board/image/pi_start.sh build/rpi4
set -u
build=${1:?usage: pi_start.sh build/rpi4}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/support/checks.sh

# As the chip's firmware does: U-Boot in memory, with the device tree beside it. U-Boot's serial line is the second one.
card_qemu() {
    exec timeout -k 5 "$CARD_SECONDS" qemu-system-aarch64 -M raspi3b -display none -kernel "$VM/u-boot.bin" -dtb "$VM/pi3.dtb" \
        -drive "file=$VM/card,format=raw,if=sd" -serial null \
        -chardev "pipe,id=serial,path=$VM/serial,logfile=$VM/console" -serial chardev:serial \
        -chardev "pipe,id=monitor,path=$VM/monitor" -mon chardev=monitor,mode=control "$@"
}

# says SECONDS TEXT...: each of these texts comes on the console.
says() {
    local until=$((SECONDS + $1)) text
    shift
    for text in "$@"; do
        until grep -aqF "$text" "$VM/console"; do
            if ! vm_alive || [ $SECONDS -ge $until ]; then
                ok 1 "the console does not say \"$text\""
                return 1
            fi
            sleep 0.5
        done
        ok 0
    done
}

types() { echo "$1" 1<>"$VM/serial.in"; }

trap vm_stop EXIT
flashed=build/pi-start.img
said=$(board/image/flash.sh BOARD=rpi4 "IMAGE=$build/wallwarp-rpi4.img.xz" DEV=$flashed NODE=1 ROOM=board/qemu-virt/room.yaml 2>&1) ||
    { echo "$said"; exit 1; }
card_insert build/pi-start $flashed && rm $flashed || exit 1
truncate -s 2G "$VM/card" # QEMU has cards of powers of two
mcopy -i "$VM/card@@1M" ::u-boot.bin "$VM/" || exit 1
{
    dtc -q -I dtb -O dts build/image/kernel/usr/lib/linux-image-*/broadcom/bcm2837-rpi-3-b.dtb
    cat tests/board/image/pi3.dtsi
} | dtc -q -I dts -O dtb -o "$VM/pi3.dtb" - || exit 1

card_power
if says 60 'Hit any key to stop autoboot'; then
    types ''
    says 20 'U-Boot> '
    types 'setenv more_arguments console=ttyS1,115200 loglevel=7 systemd.journald.forward_to_console=1 systemd.journald.max_level_console=info'
    types boot
    says 400 'Found U-Boot script /boot.scr' 'wallwarp: starting slot A, starts left: 2' 'running in system mode' \
        'wallwarp: data: growing to the end of /dev/mmcblk0' 'Finished wallwarp-data.service' 'Finished wallwarp-grow.service' \
        'wallwarp: board "front" on rpi4' \
        'machine: this is raspberrypi,3-model-b, and the firmware that of board rpi4, expected brcm,bcm2711' \
        'Finished wallwarp-update-start.service'
fi
! grep -aq 'partition .* cannot\|no partition\|Kernel panic' "$VM/console"
ok $? "$(grep -a 'partition .* cannot\|no partition\|Kernel panic' "$VM/console")"
vm_stop
[ "$(card_state BOOT_A_LEFT)" = 9 ]
ok $? "the update agent left slot A $(card_state BOOT_A_LEFT) starts, expected 9"
fw_setenv -c "$VM/fw_env.config" BOOT_ORDER "B A"
card_power
says 60 'wallwarp: starting slot B, starts left: 2'
vm_stop
[ "$(card_state BOOT_B_LEFT)" = 2 ]
ok $? "U-Boot left slot B $(card_state BOOT_B_LEFT) starts, expected 2"
sectors=$(sfdisk -d "$VM/card" 2>/dev/null | sed -n 's/.* size= *\([0-9]*\),.*name="data".*/\1/p')
[ "$sectors" -gt 2000000 ]
ok $? "partition data has $sectors sectors, expected the rest of the card"
ok_end
