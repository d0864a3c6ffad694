# shellcheck shell=bash
# shellcheck disable=SC2016 # the board expands what is in commands
# SPDX-License-Identifier: Apache-2.0
# The update agent of a virtual board with a card, its operator on the bus, its sticks and its settings, for scripts to
# source after card.sh.
#
#   bus_up                after each start: the other end of its bus is somebody, who notes what it says in
#                         /data/heard, and has the room file as it was
#   agent_heard           soon its Update tells of its agent: not in its first seconds, nor with broken settings
#   bus_heard             what its Update said, as `wire_tool updates` tells it
#   room_update OPTION... `wallwarp-pose update` on that bus
#   room_switch VERSION   tells it over the bus to switch; then goes_down
#   restart_is_end        from now on qemu ends when the board restarts: its CAN is out of step after a reset
#   goes_down OPTION...   soon it does, and gets power again, as card_power
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

# Until all else has ended, so that the last word of a board that goes down is noted too.
bus_up() {
    card_run 'ip link set can1 up txqueuelen 64 type can bitrate 500000
        [ -e /data/operator.yaml ] || cp /card/room.yaml /data/operator.yaml
        systemd-run -q -p DefaultDependencies=no sh -c "exec candump -L can1,681:7FF,701:7FF >>/data/heard"
        candump -n 1 -T 5000 can1,701:7FF | grep -q .'
}

agent_heard() {
    card_run 'for i in 1 2 3 4 5 6 7 8 9 10; do
        candump -n 1 -T 5000 can1,681:7FF | grep -q "\[8\]  .. [1-5]" && exit; done; false'
}

bus_heard() {
    # Of a full data partition there may be a line that was cut.
    card_run 'cat /data/heard' | grep -x '([0-9.]*) can1 [0-9A-F]*#[0-9A-F]*' |
        "${host:-build/host}/tests/board/wire_tool" updates
}

room_update() {
    card_run -t $updates_seconds "wallwarp-pose update --bus can1 /data/operator.yaml $* 2>/dev/null"
}

# Seen of qemu 7.2: after a reset of the board its kvaser_pci may call every frame that it receives an overrun.
restart_is_end() {
    vm_qmp set-action '{"reboot": "shutdown"}' >/dev/null
}

room_switch() {
    restart_is_end
    card_run "wallwarp-pose update --bus can1 /data/operator.yaml --switch --version $1 >/data/operator 2>&1 &"
}

goes_down() {
    local until=$((SECONDS + updates_seconds))
    while [ $SECONDS -lt $until ] && vm_alive; do
        sleep 1
    done
    ! vm_alive && card_power "$@"
}

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
