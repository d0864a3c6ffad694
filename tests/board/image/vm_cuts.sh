#!/bin/bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# Cuts the power of a virtual board with an image at random moments of what it does. After each cut it must start and show
# a picture, its settings as they were, with all bytes of the slot that runs, and of the one that waits if one does.
#   first     the first start of a card that was just flashed, whose data partition grows
#   boot      a later start
#   run       while it is given another room file again and again
#   install   a bundle from a stick, or from the network
#   switch    from the request until the board restarts
#   trial     from there until the new version has proved itself, and a little longer
# CUTS of them (2), each kind once before any comes again. A moment is a count of what the board does, or of its own
# clock's seconds, so that SEED (printed) gives nearly the same ones on any machine; ONLY=N does no more than cut N of them.
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
clock=(-rtc clock=vm)
trial_seconds=40

# Draws all cuts at once, as others draw, too: kinds[], fractions[] of 32768 of what a kind does, sources[].
draw() {
    local bag=() i at
    RANDOM=$((seed % 32768))
    for ((i = 1; i <= cuts; i++)); do
        [ ${#bag[@]} -gt 0 ] || bag=(first boot run install switch trial)
        at=$((RANDOM % ${#bag[@]}))
        kinds[i]=${bag[at]}
        bag=("${bag[@]:0:at}" "${bag[@]:at+1}")
        fractions[i]=$RANDOM
        sources[i]=$((RANDOM % 2))
    done
}

needs() {
    if [ -n "${ONLY-}" ]; then [ "${kinds[ONLY]}" = "$1" ]; else [[ " ${kinds[*]} " == *" $1 "* ]]; fi
}

# prepare: cards and memories of a board at the beginning of each kind, and how much is done from there to its end.
prepare() {
    bundle_make $bundle 2.0
    ok $? "the bundle can't be made"
    card_insert build/vm-cuts "$build/wallwarp-qemu-virt.img" || return
    unsquashfs -quiet -no-progress -d "$VM/2.0" $bundle >/dev/null && cp $bundle "$VM/web/2.0.raucb"
    ok $? "the bundle can't be read"
    # As make flash does.
    echo "$room" >"$VM/room.yaml"
    debugfs -w -R "write $VM/room.yaml room.yaml" "$VM/card?offset=$(card_at data)" >/dev/null 2>&1
    cp --sparse=always "$VM/card" "$VM/first.card"
    card_power "${clock[@]}"
    card_up 300 && becomes state=idle && card_run 'systemctl start wallwarp-grow'
    ok $? "the board does not start: $(tail -n 8 "$VM/console")"
    boot_operations=$(card_count operations)
    settings=$(card_run 'md5sum /card/*')
    card_keep up
    ok $? "the board can't be kept as it is"
    if needs install || needs switch || needs trial; then
        prepare_update
    fi
}

prepare_update() {
    card_back up "${clock[@]}" && stick_plug $bundle && becomes "state=ready waiting=2.0"
    ok $? "the bundle is not installed: $(said | tr '\n' ' ')"
    stick_pull
    install_bytes=$(card_count wr_bytes)
    card_keep ready
    ok $? "the board can't be kept as it is"
    # To its restart, which is the end here.
    card_back ready -no-reboot "${clock[@]}" && request switch
    while vm_alive; do
        now=$(card_count operations)
        switch_operations=${now:-$switch_operations}
    done
    cp --sparse=always "$VM/card" "$VM/trial.card"
}

# passes NAME COUNT: until so much more is done than at the call, or nothing more for a while; and how much, in $done.
passes() {
    local until=$((SECONDS + 20)) began now
    began=$(card_count "$1")
    done=0
    while [ "$done" -lt "$2" ] && [ $SECONDS -lt $until ] && vm_alive; do
        now=$(($(card_count "$1") - began))
        [ "$now" = "$done" ] || until=$((SECONDS + 20))
        done=$now
    done
}

# does KIND FRACTION SOURCE: brings the board to the moment, and says in $moment which.
does() {
    local name=operations count=$boot_operations
    case $1 in
    first | trial)
        cp --sparse=always "$VM/$1.card" "$VM/card"
        card_power "${clock[@]}"
        ;;
    boot)
        cp --sparse=always "$VM/up.card" "$VM/card"
        card_power "${clock[@]}"
        ;;
    run)
        card_back up "${clock[@]}"
        # As board/image/README.md says it is done.
        card_run "while :; do for room in '$other_room' '$room'; do
            echo \"\$room\" >/data/room.new && sync && mv /data/room.new /data/room.yaml
            done; done >/dev/null 2>&1 &" >/dev/null
        count=200
        ;;
    install)
        card_back up "${clock[@]}"
        if [ "$3" = 0 ]; then stick_plug $bundle; else request "install http://10.0.2.100/2.0.raucb"; fi
        name=wr_bytes count=$install_bytes
        ;;
    switch)
        card_back ready "${clock[@]}"
        request switch
        count=$switch_operations
        ;;
    esac
    [ "$1" != trial ] || name=seconds count=$trial_seconds
    passes $name $((count * $2 / 32768))
    moment="$1, $done of $count $name"
    [ "$1 $3" != "install 1" ] || moment="$moment, over the network"
}

cut() {
    # As a lost supply: what is in the board's memory is gone.
    kill -9 "$(pgrep -P "$(cat "$VM/pid")")" 2>/dev/null
    wait "$(cat "$VM/pid")" 2>/dev/null
}

# What runs has been made by the image or by the bundle, and the wall shows a picture of it.
lives() {
    card_power "${clock[@]}"
    card_up 400 && becomes_any state=idle state=ready state=failed && becomes trial=0 &&
        card_run 'systemctl show wallwarp -p StatusText | grep -q waiting' &&
        vm_screenshot "$VM/seen.ppm" && [ "$(tail -c +16 "$VM/seen.ppm" | od -An -v -tx1 -w3 | sort -u | wc -l)" -gt 1 ]
}

# whole SLOT VERSION: a slot has all the bytes of a version.
whole() {
    local kernel=$bundle_image/kernel.vfat root=$bundle_image/root.squashfs
    [ "$2" != 2.0 ] || kernel=$VM/2.0/kernel.img root=$VM/2.0/root.img
    cmp -n "$(stat -c %s "$kernel")" -i "$(card_at "kernel-$1"):0" "$VM/card" "$kernel" &&
        cmp -n "$(stat -c %s "$root")" -i "$(card_at "root-$1"):0" "$VM/card" "$root"
}

slots_whole() {
    local running waiting slot
    running=$(sed -n 's/^running=//p' <<<"$state")
    waiting=$(sed -n 's/^waiting=//p' <<<"$state")
    slot=$(card_slot)
    vm_stop
    whole "${slot,}" "$running" && case $slot$waiting in
    A2.0) whole b 2.0 ;;
    A | B) ;;
    *) false ;;
    esac
}

trap 'vm_stop; rm -f $bundle "$VM"/*.{card,memory}' EXIT
room="a room of mine" other_room="another room of mine"
kinds=() fractions=() sources=() switch_operations=0
draw
prepare
[ "$failed" = 0 ] || { ok_end; exit; }
for ((i = ${ONLY:-1}; i <= ${ONLY:-cuts}; i++)); do
    began=$SECONDS
    does "${kinds[i]}" "${fractions[i]}" "${sources[i]}"
    cut
    at=$SECONDS
    lives
    ok $? "cut $i: it does not come back: $(tail -n 8 "$VM/console")"
    state=$(said)
    now=$(card_run 'cat /data/room.yaml; md5sum /card/*')
    echo "cut $i, SEED=$seed: $moment, $((at - began)) s; back in slot $(card_slot) after $((SECONDS - at)) s:" \
        "$(grep -v '^progress\|^slot' <<<"$state" | tr '\n' ' ')"
    [ "$now" = "$room"$'\n'"$settings" ] || [ "$now" = "$other_room"$'\n'"$settings" ]
    ok $? "cut $i: the settings are not what they were: $now"
    slots_whole
    ok $? "cut $i: a slot is not whole"
done
ok_end
