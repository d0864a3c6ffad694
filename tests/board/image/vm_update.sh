#!/bin/bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# Updates of an image on the virtual board: bundles that it must refuse, one from a stick that proves itself, and two whose
# firmware crashes and hangs, from which the board comes back by itself. Its settings stay.
# Usage, from the tree's root: tests/board/image/vm_update.sh BUILD_FOLDER_OF_THE_BOARD
set -u
build=${1:?usage: vm_update.sh BUILD_FOLDER_OF_THE_BOARD}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/board/image/bundles.sh
. tests/board/image/updates.sh
. tests/support/checks.sh
folder=build/vm-update-bundles

# small_bundle NAME BOARD KEYS: of the right form, with next to nothing in it.
small_bundle() {
    mkdir -p "$folder/small/root/usr/lib/wallwarp"
    echo 9.0 >"$folder/small/root/usr/lib/wallwarp/version"
    head -c 300000 /dev/urandom >"$folder/small/root/programs"
    mksquashfs "$folder/small/root" "$folder/small/root.squashfs" -noappend -quiet -no-progress
    head -c 100000 /dev/zero >"$folder/small/kernel.vfat"
    board/image/bundle.sh "$2" "$folder/small" "$folder/$3/signing.pem" "$folder/$3/signing.key" "$folder/$1.raucb" \
        >/dev/null
}

make_bundles() {
    rm -rf "$folder"
    mkdir -p "$folder/expired"
    ln -s "$PWD/$bundle_keys" "$folder/keys"
    {
        board/image/signing_key.sh "$folder/stranger"
        cp $bundle_keys/ca.* "$folder/expired/"
        END=20210101000000Z board/image/signing_key.sh "$folder/expired"
    } 2>/dev/null
    small_bundle small qemu-virt keys
    small_bundle stranger qemu-virt stranger
    small_bundle old qemu-virt expired
    small_bundle other rpi4 keys
    head -c 200000 "$folder/small.raucb" >"$folder/cut.raucb"
    cp "$folder/small.raucb" "$folder/altered.raucb"
    printf 'wallwarp' | dd of="$folder/altered.raucb" bs=1 seek=150000 conv=notrunc status=none
    bundle_make "$folder/2.raucb" 2.0
    bundle_make "$folder/crash.raucb" 3.0 'exit 1'
    bundle_make "$folder/hang.raucb" 4.0 '(sleep 3; kill -STOP $$) & exec /usr/local/bin/wallwarp.real "$@"'
}

# refuses NAME WHAT: the bundle of the web server is not installed, and the message is about this.
refuses() {
    request "install http://10.0.2.100/$1.raucb"
    becomes state=failed && said | grep -q "^message=$2"
    ok $? "$1.raucb: it says $(said | tr '\n' ' ')"
    [ "$(said | sed -n 's/^waiting=//p')" = "" ]
    ok $? "$1.raucb waits for the switch"
}

# installs NAME VERSION: from a stick that is plugged in.
installs() {
    stick_plug "$folder/$1.raucb"
    becomes "state=ready waiting=$2"
    ok $? "$1.raucb on a stick: it says $(said | tr '\n' ' ')"
    stick_pull
}

# comes_back NAME VERSION: its firmware does not prove itself, and after three starts the board runs 2.0 again.
comes_back() {
    installs "$1" "$2"
    local before
    before=$(card_boots)
    request switch
    restarts 4 "$before"
    ok $? "$1: $(card_boots) starts after $before, expected 4 more"
    card_up 300 && becomes "state=failed slot=B trial=0 running=2.0"
    ok $? "$1: it says $(said | tr '\n' ' ')"
    said | grep -q "^message=version $2 in slot A did not prove itself"
    ok $? "$1: it says $(said | tr '\n' ' ')"
    settings_kept
    ok $? "$1: the settings are not what they were"
}

trap vm_stop EXIT
make_bundles
ok $? "bundles can't be made"
card_insert build/vm-update "$build/wallwarp-qemu-virt.img" || exit 1
cp "$folder"/{stranger,old,other,cut,altered,small}.raucb "$VM/web/"
# By its clock the certificate of good bundles has expired, too; what counts is when they were signed.
card_power -rtc base=2035-01-01
card_up 300
ok $? "the board does not start: $(tail -n 5 "$VM/console")"
settings_make

refuses stranger 'refused: signature verification failed'
refuses old 'refused: .*certificate has expired'
refuses other 'refused: for wallwarp-rpi4, this board is wallwarp-qemu-virt'
refuses cut 'refused: .*Signature.*exceeds'
refuses altered 'not installed'
refuses missing "can't fetch .*404"
data_fill
ok $? "the data partition can't be filled"
refuses small 'the data partition is too full for'
card_run 'rm /data/full /data/full2'

installs 2 2.0
request switch
restarts 1 1
ok $? "the board does not restart"
[ "$(card_slot)" = B ]
ok $? "it starts in slot $(card_slot), expected B"
card_up 300 && becomes "state=idle slot=B trial=0 running=2.0"
ok $? "2.0 is not marked good: it says $(said | tr '\n' ' ')"
settings_kept
ok $? "the settings are not what they were"

comes_back crash 3.0
comes_back hang 4.0
vm_has_event WATCHDOG
ok $? "the watchdog did not end what hangs"
rm -rf "$folder"
ok_end
