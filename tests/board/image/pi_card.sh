#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The Raspberry Pi 4's image as the chip and U-Boot go through it: every file that one of them asks for is there, and fits
# the next. Usage, from the tree's root: tests/board/image/pi_card.sh build/rpi4
set -u
build=${1:?usage: pi_card.sh build/rpi4}
export LC_ALL=C
PATH=$PATH:/usr/sbin:/sbin
. tests/support/checks.sh
image=$build/wallwarp-rpi4.img
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# fat NAME: a FAT partition of the image, as mtools take it.
fat() {
    local start
    start=$(sfdisk -d "$image" | sed -n 's/.* start= *\([0-9]*\),.*name="'"$1"'".*/\1/p')
    echo "$image@@$((512 * start))"
}

setting() { sed -n "s/^$1=//p" "$folder/config.txt"; }
has() { [ -s "$folder/$1" ]; }

# The chip's ROM and EEPROM: the first FAT file system of a GPT.
sfdisk -d "$image" | sed -n '/start=/{p;q}' | grep -q 'type=EBD0A0A2-.*name="card"'
ok $? "the first partition is not \"card\", or of no type that the chip starts from"
mcopy -i "$(fat card)" '::*' "$folder/"
ok $? "partition card cannot be read"
minfo -i "$(fat card)" :: | grep -q 'disk type="FAT32'
ok $? "partition card is no FAT32"
has start4.elf && has fixup4.dat && has config.txt
ok $? "the chip's firmware is not whole: $(ls "$folder")"
made=$(strings "$folder/start4.elf" | sed -n 's/^VC_BUILD_ID_TIME: \(... .. ....\)$/\1/p')
[ "$(date -d "${made:-1970-01-01}" +%Y%m%d)" -ge 20250301 ]
ok $? "start4.elf is of $made, and finds no kernel on a GPT when the EEPROM is newer"

# The chip's firmware: what config.txt names, and what it fills in for the kernel.
awk 'length > 98' "$folder/config.txt" | grep -q .
ok $((!$?)) "config.txt has a line that is cut off"
[[ $(setting arm_64bit) = 1 && $(setting enable_uart) = 1 ]]
ok $? "config.txt does not switch on 64 bits and the serial line"
has "$(setting kernel)"
ok $? "config.txt: kernel=$(setting kernel) is not on the card"
tree=$folder/$(setting device_tree)
fdtdump "$tree" >"$folder/tree" 2>/dev/null
ok $? "config.txt: device_tree=$(setting device_tree) is not on the card"
for overlay in $(setting dtoverlay); do
    has "overlays/${overlay%%,*}.dtbo"
    ok $? "config.txt: dtoverlay=$overlay is not on the card"
done
machine=$(sed -n 's/.*\.machine = "\(.*\)",/\1/p' board/rpi4/board.c)
fdtget "$tree" / compatible | tr ' ' '\n' | grep -qxF "$machine"
ok $? "the device tree is for $(fdtget "$tree" / compatible), the firmware for $machine"
for alias in emmc2bus ethernet0 serial1; do
    fdtget "$tree" /aliases $alias >/dev/null 2>&1
    ok $? "the device tree has no alias $alias"
done
can=$(fdtget -l "$tree" /soc/spi@7e204000 2>&1 | grep '^can@')
[ "$(fdtget "$tree" /soc/spi@7e204000 status) $(fdtget "$tree" "/soc/spi@7e204000/$can" compatible)" = \
    "okay microchip,mcp2518fd" ]
ok $? "the device tree has no hat"

# U-Boot: its script, the slots, and room in memory. A slot's own tree would replace the one that the firmware has filled.
has boot.scr && tail -c +73 "$folder/boot.scr" | cmp -s - board/image/boot.cmd
ok $? "boot.scr is not board/image/boot.cmd"
for slot in a b; do
    for file in vmlinuz initrd cmdline; do
        mcopy -n -o -i "$(fat kernel-$slot)" "::$file" "$folder/$file"
        ok $? "slot $slot has no $file"
    done
    ! mdir -b -i "$(fat kernel-$slot)" ::board.dtb >/dev/null 2>&1
    ok $? "slot $slot has a device tree of its own"
done
address() { strings "$folder/u-boot.bin" | sed -n "s/^$1=\(0x[0-9a-f]*\)$/\1/p"; }
size=$(od -A n -t u8 -j 16 -N 8 "$folder/vmlinuz")
# It is moved to the next 2 MiB.
end=$((($(address kernel_addr_r) + 0x1fffff) / 0x200000 * 0x200000 + size))
[[ $size -gt 1000000 && $(address ramdisk_addr_r) -ge $end && $(address scriptaddr) -ge $end ]]
ok $? "the kernel takes memory up to $(printf %#x $end), the script is at $(address scriptaddr), the initrd at $(address ramdisk_addr_r)"
ok_end
