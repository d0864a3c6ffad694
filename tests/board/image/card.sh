# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# A virtual board that starts from a card, as an image makes it: firmware, U-Boot, kernel, system; for scripts to source
# after tests/board/virtual/vm.sh, whose vm_alive, vm_monitor, vm_screenshot and vm_stop work here too.
#
# The card is the file $VM/card and stays when the board is ended or starts anew. Commands are typed at its serial
# console, where only the image for the virtual machine lets root in without a password; so the image that is tested
# holds nothing for its tests. What it says there is in $VM/console. In it http://10.0.2.100/NAME is $VM/web/NAME.
#
#   card_insert FOLDER IMAGE        VM=FOLDER, with a copy of the image as its card, 512 MiB larger
#   card_power [QEMU_OPTION...]     on; returns at once
#   card_keep NAME                  the board as it is, memory and card, into $VM/NAME.*; it is off then
#   card_back NAME [QEMU_OPTION...] goes on as it was kept; VM has no sticks in it, then and now
#   card_up [SECONDS]               until commands can be run. False after that time (120), or when the board has ended
#   card_run [-t SECONDS] COMMAND   as vm_run
#   card_shows PROGRAM...           soon its display shows what this says of the screenshot $VM/seen.ppm
#   card_edit SED FILE              changes a file of its first partition, as on a laptop
#   card_boots                      how many times U-Boot has started a slot since card_power
#   card_slot                       which slot it has started last
#   card_state NAME                 of the boot state on the card; the board is to be off
#   card_at PARTITION               prints the byte of $VM/card at which it begins
#   card_count NAME                 rd_bytes, wr_bytes, operations: what the board has done with its card since card_power
#                                   or card_back; seconds: of its clock, when it has the QEMU_OPTION -rtc clock=vm
CARD_SECONDS=1800
# How long U-Boot waits for a key; 2 s in Debian's.
card_delay=0

card_insert() {
    VM=$1
    vm_stop
    rm -rf "$VM"
    mkdir -p "$VM/web" || return 1
    cp --sparse=always "$2" "$VM/card" && truncate -s +512M "$VM/card"
    sed "s/bootdelay=2/bootdelay=$card_delay/" /usr/lib/u-boot/qemu_arm64/u-boot.bin >"$VM/rom"
    local state
    state=$(card_at state)
    printf '%s %#x 0x200\n' "$VM/card" "$state" "$VM/card" $((state + 0x80000)) >"$VM/fw_env.config"
}

card_at() {
    local start
    start=$(sfdisk -d "$VM/card" 2>/dev/null | sed -n 's/.*start= *\([0-9]*\),.*name="'"$1"'".*/\1/p')
    echo $((start * 512))
}

card_power() {
    local VM_ACCEL=tcg,thread=single
    vm_stop
    rm -f "$VM"/*.in
    mkfifo "$VM/monitor.in" "$VM/serial.in"
    : >"$VM/monitor.out"
    : >"$VM/console"
    ln -sf /dev/null "$VM/serial.out"
    card_jobs=0
    card_qemu "$@" </dev/null >"$VM/qemu" 2>&1 &
    echo $! >"$VM/pid"
    # What is said before qemu has its pipes open is lost.
    while vm_alive && [ ! -s "$VM/monitor.out" ]; do
        sleep 0.1
    done
    vm_qmp qmp_capabilities '{}' >/dev/null
}

card_keep() {
    local until=$((SECONDS + 60))
    vm_qmp stop '{}' >/dev/null && vm_qmp migrate "{\"uri\": \"exec:cat >$VM/$1.memory\"}" >/dev/null
    until vm_qmp query-migrate '{}' | grep -q '"status": "completed"'; do
        [ $SECONDS -lt $until ] && vm_alive || return 1
    done
    cp --sparse=always "$VM/card" "$VM/$1.card"
    vm_stop
}

card_back() {
    local until=$((SECONDS + 60)) name=$1
    shift
    vm_stop
    cp --sparse=always "$VM/$name.card" "$VM/card"
    card_power -incoming "exec:cat $VM/$name.memory" "$@"
    until vm_qmp query-status '{}' | grep -q '"status": "paused"'; do
        [ $SECONDS -lt $until ] && vm_alive || return 1
    done
    vm_qmp cont '{}' >/dev/null
}

# Its second CAN controller is somebody else on the bus. A restart of the board is one, not the end.
card_qemu() {
    # Without acpi=off qemu leaves out the board's lines.
    exec timeout -k 5 "$CARD_SECONDS" qemu-system-aarch64 -M virt,acpi=off -cpu cortex-a72 -smp 2 -m 1024 \
        -accel "${VM_ACCEL-tcg,thread=multi}" -nodefaults -display none -bios "$VM/rom" \
        -drive "file=$VM/card,format=raw,if=virtio,id=card" \
        -chardev "pipe,id=serial,path=$VM/serial,logfile=$VM/console" -serial chardev:serial \
        -chardev "pipe,id=monitor,path=$VM/monitor" -mon chardev=monitor,mode=control \
        -netdev "user,id=net,restrict=on,guestfwd=tcp:10.0.2.100:80-cmd:tests/board/image/web.sh $VM/web" \
        -device virtio-net-pci,netdev=net,romfile= \
        -object can-bus,id=wire -device kvaser_pci,canbus=wire -device kvaser_pci,canbus=wire -device qemu-xhci \
        -device virtio-gpu-pci,id=gpu -device i6300esb -action watchdog=reset -icount shift=0 "$@"
}

card_up() {
    local until=$((SECONDS + ${1-120}))
    # Nothing may be typed before the shell asks for it: U-Boot would take it for a stop.
    while [ $SECONDS -lt $until ] && vm_alive; do
        tail -c "+$(card_began)" "$VM/console" | grep -aq '^# ' && card_run -t 20 true >/dev/null && return 0
        sleep 0.5
    done
    return 1
}

card_run() {
    local seconds=60 mark status until from
    if [ "$1" = -t ]; then
        seconds=$2
        shift 2
    fi
    vm_alive || return 125
    card_jobs=$((card_jobs + 1))
    mark="@$card_jobs.$RANDOM"
    from=$(wc -c <"$VM/console")
    echo "( $1 ) >/tmp/said 2>&1; s=\$?; echo; sed 's/^/$mark: /' /tmp/said; echo; echo '$mark='\$s" 1<>"$VM/serial.in"
    until=$((SECONDS + seconds))
    while vm_alive && [ $SECONDS -le $until ]; do
        status=$(tail -c +$((from + 1)) "$VM/console" | tr -d '\r' | sed -n "s/^$mark=//p")
        if [ -n "$status" ]; then
            tail -c +$((from + 1)) "$VM/console" | tr -d '\r' | sed -n "s/^$mark: //p"
            return "$status"
        fi
        sleep 0.1
    done
    vm_alive && return 124
    return 125
}

card_shows() {
    local i
    for ((i = 0; i < 60; i++)); do
        vm_screenshot "$VM/seen.ppm" && "$@" && return 0
        sleep 0.5
    done
    return 1
}

card_edit() {
    card_run "mount -o remount,rw /card && sed -i '$1' '/card/$2' && mount -o remount,ro /card" >/dev/null
}

# Where in $VM/console its newest start begins.
card_began() {
    local at
    at=$(grep -abo '^U-Boot 2' "$VM/console" | tail -n 1)
    echo $((${at%%:*} + 1))
}

card_boots() {
    grep -ac '^wallwarp: starting slot' "$VM/console"
}

card_slot() {
    sed -n 's/^wallwarp: starting slot \([AB]\),.*/\1/p' "$VM/console" | tail -n 1
}

card_state() {
    fw_printenv -c "$VM/fw_env.config" -n "$1" 2>/dev/null
}

card_count() {
    case $1 in
    # What its clock's chip has at its first register.
    seconds) echo $(($(vm_monitor 'xp /1wx 0x9010000' | sed 's/.*: //'))) ;;
    *)
        vm_monitor 'info blockstats' | awk -F '[ =]' -v name="$1" '/^card: / {
            for (i = 2; i < NF; i++) n[$i] = $(i + 1)
            n["operations"] = n["rd_operations"] + n["wr_operations"]
            print n[name] }'
        ;;
    esac
}
