#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# U-Boot's script on Debian's U-Boot for the virtual machine, on a disk without a system: which slot it starts, and that
# it and libubootenv read the same in the boot state, whatever is broken. Each start ends with "cannot be started".
# Usage, from the tree's root: tests/board/image/test_boot_script.sh
set -u
# shellcheck source=tests/support/checks.sh
. tests/support/checks.sh
folder=build/boot_script
disk=$folder/disk
first=$((32 << 20))           # of partition state
second=$((first + 512 * 1024))

make_disk() {
    rm -rf $folder
    mkdir -p $folder || exit 1
    board/image/boot_script.sh $folder/boot.scr || exit 1
    echo 'console=ttyAMA0' >$folder/cmdline
    echo 'no kernel' >$folder/vmlinuz
    truncate -s 16M $folder/card $folder/kernel
    truncate -s 64M $disk
    mkfs.vfat $folder/card >/dev/null && mcopy -i $folder/card $folder/boot.scr ::/
    mkfs.vfat $folder/kernel >/dev/null && mcopy -i $folder/kernel $folder/cmdline $folder/vmlinuz ::/
    mcopy -i $folder/kernel $folder/vmlinuz ::/initrd
    sfdisk -q $disk <<'TABLE' || exit 1
label: gpt
start=1MiB, size=16MiB, name=card, type=uefi, attrs="LegacyBIOSBootable"
start=32MiB, size=1MiB, name=state
start=33MiB, size=14MiB, name=kernel-b
start=47MiB, size=16MiB, name=kernel-a
TABLE
    dd if=$folder/card of=$disk bs=1M seek=1 conv=notrunc,sparse status=none
    dd if=$folder/kernel of=$disk bs=1M seek=47 conv=notrunc,sparse status=none
    printf '%s %#x 0x200\n' $disk $first $disk $second >$folder/fw_env.config
}

# start: into $line, what the script says of its choice.
start() {
    timeout 60 qemu-system-aarch64 -M virt -cpu cortex-a72 -m 512 -nodefaults -display none -no-reboot -serial stdio \
        -bios /usr/lib/u-boot/qemu_arm64/u-boot.bin -drive "file=$disk,format=raw,if=virtio" \
        </dev/null >$folder/console 2>&1
    line=$(tr -d '\r' <$folder/console | grep '^wallwarp: ' | grep -v 'the kernel gets\|cannot be' | tail -n 1)
}

# is WHAT TEXT: the script said this, and ended.
is() {
    start
    [ "$line" = "wallwarp: $2" ] && grep -q 'cannot be started\|no slot has' $folder/console
    ok $? "$1: $line"
}

get() { fw_printenv -c $folder/fw_env.config -n "$1" 2>&1; }
# set_: NAME=VALUE lines in. When both copies are broken it starts from nothing, and writes copy 1.
set_() { fw_setenv -c $folder/fw_env.config -f /dev/null -s - >$folder/fw_setenv 2>&1 || ok 1 "fw_setenv: $(cat $folder/fw_setenv)"; }

# has WHAT NAME VALUE: libubootenv reads this.
has() {
    local value
    value=$(get "$2")
    [ "$value" = "$3" ]
    ok $? "$1: $2=$value"
}

# spoil OFFSET BYTES: overwrites that many from there.
spoil() { head -c "$2" /dev/zero | tr '\0' '\245' | dd of=$disk bs=1 seek="$1" conv=notrunc status=none; }

# count OFFSET BYTE: how many writes a copy says it is the result of; its CRC does not cover that.
count() { printf '%b' "\\x$2" | dd of=$disk bs=1 seek=$(($1 + 4)) conv=notrunc status=none; }

make_disk
is "an empty state" "starting slot A, starts left: 2"
has "an empty state" BOOT_A_LEFT 2
has "an empty state" BOOT_B_LEFT 3
has "an empty state" BOOT_ORDER "A B"
# What U-Boot must not take from there is beside it.
set_ <<<'BOOT_ORDER=B A
BOOT_B_LEFT=2
bootargs=stranger
devtype=stranger'
has "a stranger in the state" bootargs stranger
is "what libubootenv wrote" "starting slot B, starts left: 1"
has "what libubootenv wrote" BOOT_B_LEFT 1
has "what libubootenv wrote" bootargs ''
is "the next start" "starting slot B, starts left: 0"
is "none left to the first" "starting slot A, starts left: 1"
has "none left to the first" BOOT_B_LEFT 0

# gets WHAT ARGUMENTS: these follow the slot's own on the kernel's command line.
gets() {
    tr -d '\r' <$folder/console | grep -qx "wallwarp: the kernel gets console=ttyAMA0 *$2"
    ok $? "$1: $(grep -a 'the kernel gets' $folder/console)"
}

gets "slot A" 'root=PARTLABEL=root-a rauc.slot=A *'
set_ <<<$'BOOT_ORDER=A B\nBOOT_A_LEFT=1\nBOOT_UPDATE=trial A'
is "a trial" "starting slot A, starts left: 0"
gets "a trial" 'root=PARTLABEL=root-a rauc.slot=A *wallwarp.trial'
has "a trial" BOOT_UPDATE "trial A"
set_ <<<$'BOOT_B_LEFT=1'
is "a trial that has failed" "starting slot B, starts left: 0"
has "a trial that has failed" BOOT_UPDATE "trial A"

# Each copy broken while it is the newer one, and while it is the older one; then both.
for counts in "20 10" "10 20"; do
    read -r count_0 count_1 <<<"$counts"
    for copy in $first $second; do
        spoil $first 512
        spoil $second 512
        set_ <<<$'BOOT_ORDER=B\nBOOT_A_LEFT=3\nBOOT_B_LEFT=3'
        set_ <<<BOOT_ORDER=A
        count $first "$count_0"
        count $second "$count_1"
        spoil $((copy + 9)) 1
        slot=$([ "$copy" = "$first" ] && echo B || echo A)
        is "counts $counts, $copy broken" "starting slot $slot, starts left: 2"
        has "counts $counts, $copy broken" BOOT_ORDER "$slot"
    done
done
spoil $first 512
spoil $second 512
is "both copies broken" "starting slot A, starts left: 2"

set_ <<<'BOOT_ORDER=A
BOOT_A_LEFT=0
BOOT_B_LEFT=3'
is "a slot that is not in the order" "no slot has a start left, all get 3 again"
has "a slot that is not in the order" BOOT_ORDER A
is "after that" "starting slot A, starts left: 2"

# The count's end. Copy 0 says A, copy 1 says B.
for counts in "ff 00 B" "00 ff A" "fe ff B" "ff fe A" "80 7f A" "7f 80 B" "05 05 A"; do
    read -r count_0 count_1 slot <<<"$counts"
    spoil $first 512
    spoil $second 512
    set_ <<<$'BOOT_ORDER=B\nBOOT_A_LEFT=3\nBOOT_B_LEFT=3'
    count $second 1
    set_ <<<BOOT_ORDER=A
    count $first "$count_0"
    count $second "$count_1"
    has "counts $counts" BOOT_ORDER "$slot"
    is "counts $counts" "starting slot $slot, starts left: 2"
    has "counts $counts, then" BOOT_ORDER "$slot"
    has "counts $counts, then" "BOOT_${slot}_LEFT" 2
done
ok_end
