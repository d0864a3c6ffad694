#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Kernel modules of a first file system: each after those that it needs, and none may be left out without a word. The
# same bytes whoever packs them.
# Usage, from the tree's root, after `make image`: tests/board/image/test_modules.sh
set -u
# shellcheck source=tests/support/checks.sh
. tests/support/checks.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files=$folder/said

# pack MODULE...: the file system, into out.
pack() {
    rm -f "$folder/out"
    board/initramfs.sh build/image/root/bin/busybox board/image/init.sh build/image/kernel "$folder/out" "$@" \
        >"$folder/said" 2>&1
}

pack ext4 'vivid n_devs=1'
ok $? "modules of the kernel are not packed"
order=$(cd "$folder" && gzip -dc out | cpio -i --quiet --to-stdout modules/order)
ok "$([[ $order =~ jbd2.ko.*ext4.ko.*videodev.ko.*vivid.ko\ n_devs=1 ]]; echo $?)" "found the order \"$order\""

mv "$folder/out" "$folder/first"
(umask 077 && pack ext4 'vivid n_devs=1') && cmp "$folder/first" "$folder/out" >"$folder/said"
ok $? "another umask makes other bytes"

! pack ext4 no_such_module vfat
ok $? "a module that is not there is left out, and all after it"
grep -q no_such_module "$folder/said"
ok $? "nobody says which module is not there"
[ ! -e "$folder/out" ]
ok $? "a file system is there that lacks modules"
ok_end
