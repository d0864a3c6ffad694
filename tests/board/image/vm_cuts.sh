#!/bin/bash
# shellcheck disable=SC2119 # card_power: with options or without
# SPDX-License-Identifier: Apache-2.0
# Cuts the power of a virtual board with an image at random moments while it starts, installs a bundle from a stick,
# switches, and tries the new version. After each cut it must start and show a picture, with its settings as they were.
# CUTS of them (2), each with the seed SEED + its number; seeds are printed.
# Usage, from the tree's root: CUTS=20 tests/board/image/vm_cuts.sh BUILD_FOLDER_OF_THE_BOARD
set -u
build=${1:?usage: vm_cuts.sh BUILD_FOLDER_OF_THE_BOARD}
cuts=${CUTS:-2}
seed=${SEED:-$(date +%s)}
. tests/board/virtual/vm.sh
. tests/board/image/card.sh
. tests/board/image/bundles.sh
. tests/board/image/updates.sh
. tests/support/checks.sh
bundle=build/vm-cuts.raucb

# begin PHASE: leaves the board in that of what it does, and $moment says in which.
begin() {
    moment="after the power came"
    [ "$1" = 0 ] && return
    card_up 300 || return
    stick_plug $bundle
    moment="while it installs"
    becomes_any state=installing state=ready
    [ "$1" = 1 ] && return
    becomes state=ready
    request switch
    moment="after the switch"
    [ "$1" = 2 ] && return
    restarts 1 1
    moment="on trial"
}

# What runs has been made by the image or by the bundle, and the wall shows a picture of it.
lives() {
    card_power
    card_up 400 && becomes_any state=idle state=ready state=failed &&
        card_run 'systemctl show wallwarp -p StatusText | grep -q waiting' &&
        vm_screenshot "$VM/seen.ppm" && [ "$(tail -c +16 "$VM/seen.ppm" | od -An -v -tx1 -w3 | sort -u | wc -l)" -gt 1 ]
}

cut() {
    # As a lost supply: what qemu has not written is gone.
    kill -9 "$(pgrep -P "$(cat "$VM/pid")")"
    wait "$(cat "$VM/pid")" 2>/dev/null
}

trap 'vm_stop; rm -f $bundle' EXIT
bundle_make $bundle 2.0
ok $? "the bundle can't be made"
card_insert build/vm-cuts "$build/wallwarp-qemu-virt.img" || exit 1
card_power
card_up 300
ok $? "the board does not start"
settings_make
cp --sparse=always "$VM/card" "$VM/card.new"
for ((i = 1; i <= cuts; i++)); do
    # The other slot has the version that it came with, so that each time all of an update is done.
    vm_stop
    cp --sparse=always "$VM/card.new" "$VM/card"
    # Drawn at once: others draw, too.
    RANDOM=$(((seed + i) % 32768))
    phase=$((RANDOM % 4))
    wait_ms=$((RANDOM % 20000))
    card_power
    begin $phase
    sleep "$((wait_ms / 1000)).$(printf %03d $((wait_ms % 1000)))"
    echo "cut $i, SEED=$seed: $wait_ms ms $moment"
    cut
    lives
    ok $? "cut $i: it does not come back: $(tail -n 8 "$VM/console")"
    settings_kept
    ok $? "cut $i: the settings are not what they were"
done
ok_end
