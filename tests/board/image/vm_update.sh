#!/bin/bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# Updates of an image on the virtual board. An operator on its bus has it install bundles that it must refuse, and one
# that proves itself, but not before it has shown its healthy frames. It comes back by itself from a version that shows
# none, as its settings are broken, and from two from a stick whose firmware crashes and hangs. Its settings stay.
# Usage, from the tree's root: tests/board/image/vm_update.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]
set -u
build=${1:?usage: vm_update.sh BUILD_FOLDER_OF_THE_BOARD [BUILD_FOLDER_OF_THE_HOST]}
host=${2:-build/host}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/board/image/bundles.sh
. tests/board/image/updates.sh
. tests/support/checks.sh
folder=build/vm-update-bundles
# By its clock the certificate of good bundles has expired, too; what counts is when they were signed.
later=(-rtc base=2035-01-01)
good_frames=600 # UPDATE_GOOD_FRAMES of firmware/update.h

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

# on_console PATTERN: the journal has said this there. What commands print begins with an @.
on_console() {
    tr -d '\r' <"$VM/console" | grep -av '^@' | grep -aq -- "$1"
    ok $? "the console does not say \"$1\""
}

# refuses NAME WHAT: the bundle of the web server is not installed; the operator, the board's log and its console say this.
refuses() {
    local said
    said=$(room_update --install "http://10.0.2.100/$1.raucb")
    [ $? = 1 ] && grep -q "^ *1  A  *front: runs .*, failed: $2" <<<"$said"
    ok $? "$1.raucb: the operator is told $said"
    card_run 'journalctl -b -o cat -u wallwarp-update' | grep -q "^update: $2"
    ok $? "$1.raucb: the board's log does not have \"$2\""
    on_console "update: $2"
    [ "$(said | sed -n 's/^waiting=//p')" = "" ]
    ok $? "$1.raucb waits for the switch"
}

# says LINE...: since the last time the board's Update has said these one after the other, maybe more between them, and
# nothing after the last.
says() {
    local line heard at=0
    heard=$(bus_heard)
    for line in "$@"; do
        at=$(awk -v "at=$at" -v "line=$line" 'NR > at && index($0, line " ") == 1 { print NR; exit }' <<<"$heard")
        [ "$at" ] || break
    done
    [ "$at" ] && [ "$at" = "$(wc -l <<<"$heard")" ]
    ok $? "its Update has not said \"$line\" in turn, or has said more: $heard"
    card_run 'echo >/data/heard'
}

# Over the bus, from the bundle of the web server to the mark that it is good.
test_bus() {
    room_update --install http://10.0.2.100/2.raucb | grep -qx 'all 1 boards have 2.0: --switch starts them in it'
    ok $? "2.0 is not installed: $(said)"
    room_switch 2.0
    goes_down "${later[@]}" && card_up 300 && bus_up && agent_heard
    ok $? "2.0 does not come up; the operator was told $(card_run 'cat /data/operator')"
    [ "$(card_slot)" = B ]
    ok $? "it starts in slot $(card_slot), expected B"
    room_update --switch --version 2.0 | grep -qx 'all 1 boards run 2.0, and have marked it good'
    ok $? "2.0 is not marked good: $(said)"
    local frames
    frames=$(bus_heard | sed -n 's/^idle B good no \([0-9]*\) .*/\1/p')
    [ "${frames:-0}" -ge $good_frames ]
    ok $? "it was marked good after ${frames:-no} frames, expected $good_frames at least"
    says 'failed A good no' 'installing A good no' 'ready A good no' 'ready A good promised' 'ready A good confirmed' \
        'switching A good no' 'idle B trial no' 'idle B good no'
    settings_kept
    ok $? "the settings are not what they were"
}

# tells REASON: on the wall, in the log, on the console and on the bus.
tells() {
    card_shows shows_reason "$1"
    ok $? "the wall does not say \"$1\""
    card_run 'journalctl -b -o cat -u wallwarp' | grep -qxF "wallwarp: $1"
    ok $? "the log does not say \"$1\""
    on_console "wallwarp: ${1//\[/\\[}"
    card_run 'wallwarp-pose monitor --bus can1 --seconds 1' | grep -q '^ *1  fault .* 0x200 '
    ok $? "heartbeats don't have the fault configuration: $1"
}

shows_reason() {
    # shellcheck disable=SC2046 # width and height
    "$host/tests/board/picture_tool" safe $(sed -n 2p "$VM/seen.ppm") 1 qemu-virt "$1" | cmp -s - "$VM/seen.ppm"
}

# The display has had more than enough pictures, of which none is healthy.
shows_many() {
    local until=$((SECONDS + updates_seconds)) frames=0
    while [ $SECONDS -lt $until ] && [ "$frames" -le $((2 * good_frames)) ]; do
        frames=$(card_run 'wallwarp-pose monitor --bus can1 --seconds 1' |
            awk '$1 == 1 && $2 == "fault" { n = $4 } END { print n + 0 }')
    done
    [ "$frames" -gt $((2 * good_frames)) ]
}

# The former version is well, but what is on the card is not: it says so, and is left again when its trial is over.
test_broken_settings() {
    local line wrong
    line=$(card_run 'grep -n corners_mm /card/room.yaml')
    card_edit s/corners_mm/corner_mm/ room.yaml
    room_switch "$version"
    goes_down "${later[@]}" && card_up 300 && bus_up
    ok $? "the board does not start in $version"
    tells "/card/room.yaml:${line%%:*}: boards[0].wall.corner_mm: unknown key, expected one of corners_mm"
    card_edit '$acann: can1' wallwarp.yaml
    line=$(card_run 'grep -n cann /card/wallwarp.yaml')
    wrong="/etc/wallwarp/wallwarp.yaml:${line%%:*}: cann: unknown key, "
    wrong+="expected one of node, room, key, can, camera, display, workers"
    card_run 'systemctl restart wallwarp'
    tells "$wrong"
    shows_many && said | grep -qx trial=1
    ok $? "it is marked good: $(said)"
    card_run 'systemctl show wallwarp-trial.timer -p TimersMonotonic' | grep -q 'OnBootUSec=3min '
    ok $? "the trial's end is not 3 minutes after the start"
    restart_is_end
    card_run 'mkdir -p /run/systemd/system/wallwarp-trial.timer.d
        printf "[Timer]\nOnBootSec=\nOnBootSec=1\n" >/run/systemd/system/wallwarp-trial.timer.d/now.conf
        systemctl daemon-reload; systemctl restart wallwarp-trial.timer'
    goes_down "${later[@]}" && card_up 300 && bus_up && becomes "state=failed slot=B trial=0 running=2.0"
    ok $? "it is not back: $(said)"
    tells "$wrong"
    card_edit '/^cann/d' wallwarp.yaml
    card_edit s/corner_mm/corners_mm/ room.yaml
    card_run 'systemctl restart wallwarp'
    agent_heard && room_update --status | grep -q "failed: version $version in slot A did not prove itself"
    ok $? "the operator is not told that it is back: $(said)"
    settings_kept
    ok $? "the settings are not what they were"
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
cp "$folder"/{stranger,old,other,cut,altered,small,2}.raucb "$VM/web/"
card_power "${later[@]}"
card_up 300 && bus_up && agent_heard
ok $? "the board does not start: $(tail -n 5 "$VM/console")"
settings_make
version=$(said | sed -n 's/^running=//p')

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

test_bus
test_broken_settings
comes_back crash 3.0
comes_back hang 4.0
vm_has_event WATCHDOG
ok $? "the watchdog did not end what hangs"
rm -rf "$folder"
ok_end
