# shellcheck shell=bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# The update agent of a virtual board with a card, its sticks and its settings, for scripts to source after card.sh.
#
#   request LINE          tells the agent, as the firmware does
#   said                  prints its state file
#   becomes 'LINE...'     soon its state file has all these lines
#   becomes_any LINE...   soon it has one of these
#   restarts N BEFORE     soon U-Boot has started N slots more than BEFORE
#   stick_plug BUNDLE     puts a stick with it into the board
#   stick_pull            takes it out
#   settings_make         leaves a settings file on the data partition
#   data_fill             leaves no free byte on the data partition
#   settings_kept         whether that is as it was, and what the card's first partition has
updates_seconds=400

request() {
    card_run "echo '$1' >/run/wallwarp/update/new; mv /run/wallwarp/update/new /run/wallwarp/update/request" >/dev/null
}

said() {
    card_run 'cat /run/wallwarp/update/state'
}

becomes() {
    local until=$((SECONDS + updates_seconds)) line now
    while [ $SECONDS -lt $until ] && vm_alive; do
        # A request that is not answered yet has the state before it.
        now=$(card_run 'test -e /run/wallwarp/update/request || cat /run/wallwarp/update/state')
        for line in $1; do
            grep -qx "$line" <<<"$now" || continue 2
        done
        return 0
    done
    return 1
}

becomes_any() {
    local until=$((SECONDS + updates_seconds)) line
    while [ $SECONDS -lt $until ] && vm_alive; do
        for line in "$@"; do
            said | grep -qx "$line" && return 0
        done
    done
    return 1
}

restarts() {
    local until=$((SECONDS + updates_seconds))
    while [ $SECONDS -lt $until ] && vm_alive; do
        [ "$(card_boots)" -ge $(($1 + $2)) ] && return 0
        sleep 1
    done
    return 1
}

stick_plug() {
    stick_make "$VM/stick" "$1" &&
        vm_monitor "drive_add 0 file=$VM/stick,format=raw,if=none,id=stick" >/dev/null &&
        vm_monitor "device_add usb-storage,drive=stick,id=plugged" >/dev/null
}

stick_pull() {
    vm_monitor "device_del plugged" >/dev/null
    sleep 2
    vm_monitor "drive_del stick" >/dev/null
}

settings_make() {
    card_run 'echo "a room of mine" >/data/room.yaml; sync' >/dev/null
    settings=$(card_run 'cat /data/room.yaml; md5sum /card/*')
}

settings_kept() {
    [ "$(card_run 'cat /data/room.yaml; md5sum /card/*')" = "$settings" ]
}

# With next to nothing to write, which takes a busy machine its time.
data_fill() {
    card_run 'systemctl start wallwarp-grow; fallocate -l "$(df -k /data | awk "END { print \$4 - 1000 }")k" /data/full
        dd if=/dev/zero of=/data/full2 bs=512; sync; df -k /data' | tail -n 1 | grep -q ' 0 100%'
}
