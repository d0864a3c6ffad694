# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The virtual board as seen from this machine, for scripts to source: start it, run commands in it, look at its display.
#
# A board is known by its folder VM; any number of shells may use one at a time. Its root is build/sysroot above
# build/board-kernel/root, and forgets its changes. /tree in it is this tree, read-only; /share is $VM/share, and both
# sides see at once what is in it. What it and qemu say is in $VM/console and $VM/qemu. boot.sh says which devices it has.
#
# Its time is told by its instructions, 1 ns each: what it does takes as long however busy this machine is, and what sleeps
# in it costs nothing. Left alone, it runs ahead: its minutes pass in seconds, also while it waits for a file of this
# machine's, as /tree and at first its root are. So wait in it for what is to happen, not for a while; and what must be in
# time, or runs often, belongs in its memory (vm_in_memory).
#
#   vm_use                             for tests that leave the board as they found it: the one that run.sh's tests share,
#                                      or this script's own
#   vm_start FOLDER [QEMU_OPTION...]   a new one, VM=FOLDER. Returns when commands can be run; on failure says why
#   vm_in_memory PROGRAM...            copies these, their libraries and busybox from this machine into its memory
#   vm_run [-t SECONDS] COMMAND        runs it in a shell of the board and prints what it prints. Exit status: its own,
#                                      124 after SECONDS (300), 125 when the board is gone
#   vm_screenshot FILE [DEVICE]        what a display shows, as a PPM: gpu, or another device's id
#   vm_monitor COMMAND                 a line to qemu's monitor; prints the answer
#   vm_has_event NAME                  whether qemu has told of it: WATCHDOG, SHUTDOWN ...
#   vm_alive                           whether it runs
#   vm_stop                            ends it as a lost power supply does
# Each call is bounded in time. A board is ended after VM_SECONDS, whatever becomes of those who use it.
VM=${VM-}
VM_SECONDS=2400
VM_START_SECONDS=300

vm_use() {
    if [ -z "${VM_SHARED-}" ]; then
        trap vm_stop EXIT
        vm_start "build/vm-$(basename "$0" .sh)"
        return
    fi
    VM=$VM_SHARED
    vm_alive || vm_start "$VM"
}

vm_start() {
    local i
    VM=$1
    shift
    vm_stop
    rm -rf "$VM"
    mkdir -p "$VM/share/jobs" || return 1
    cp tests/board/virtual/{boot,agent}.sh "$VM/share/"
    # Pipes to qemu; a file for its answers, and none for the board's.
    mkfifo "$VM"/{monitor,jobs}.in
    : >"$VM/monitor.out"
    ln -s /dev/null "$VM/jobs.out"
    vm_qemu "$@" </dev/null >"$VM/qemu" 2>&1 &
    echo $! >"$VM/pid"
    for ((i = 0; i < VM_START_SECONDS * 10; i++)); do
        [ -e "$VM/share/up" ] && vm_qmp qmp_capabilities '{}' >/dev/null && return 0
        vm_alive || break
        sleep 0.1
    done
    echo "vm: the board did not start; the end of what it and qemu said, in $VM:" >&2
    tail -n 15 "$VM/console" "$VM/qemu" >&2
    vm_stop
    return 1
}

vm_in_memory() {
    vm_run "touch /bin/busybox /etc/ld.so.cache /lib/ld-linux-aarch64.so.1; for program in $*; do
        touch \$program; /lib/ld-linux-aarch64.so.1 --list \$program | sed -n 's/.*=> \\([^ ]*\\) .*/\\1/p' | xargs touch; done"
}

# Two wires of CAN; reset and panic end it.
vm_qemu() {
    local folder folders=()
    for folder in sysroot=build/sysroot kernel=build/board-kernel/root tree=.; do
        folders+=(-fsdev "local,id=${folder%%=*},path=${folder#*=},security_model=none,readonly=on"
            -device "virtio-9p-pci,fsdev=${folder%%=*},mount_tag=${folder%%=*}")
    done
    exec timeout -k 5 "$VM_SECONDS" qemu-system-aarch64 -M virt -cpu cortex-a72 -smp 2 -m 1024 \
        -accel tcg,thread=single -icount shift=0,sleep=off -nodefaults -display none -no-reboot -serial "file:$VM/console" \
        -kernel build/board-kernel/vmlinuz -initrd build/board-kernel/initramfs.gz \
        -append 'console=ttyAMA0 panic=-1 quiet' \
        -chardev "pipe,id=jobs,path=$VM/jobs" -device virtio-serial-pci -device virtserialport,chardev=jobs \
        -chardev "pipe,id=monitor,path=$VM/monitor" -mon chardev=monitor,mode=control \
        "${folders[@]}" -fsdev "local,id=share,path=$VM/share,security_model=none" \
        -device virtio-9p-pci,fsdev=share,mount_tag=share \
        -object can-bus,id=wire0 -device kvaser_pci,canbus=wire0 -device kvaser_pci,canbus=wire0 \
        -object can-bus,id=wire1 -device ctucan_pci,canbus0=wire1,canbus1=wire1 \
        -device virtio-gpu-pci,id=gpu -device bochs-display,id=bochs,romfile= -device i6300esb -action watchdog=reset "$@"
}

vm_alive() {
    [ -e "$VM/pid" ] && kill -0 "$(cat "$VM/pid")" 2>/dev/null
}

vm_run() {
    local seconds=300 job i
    if [ "$1" = -t ]; then
        seconds=$2
        shift 2
    fi
    vm_alive || return 125
    job=$(mktemp -d "$VM/share/jobs/XXXXXX") || return 125
    echo "$1" >"$job/command"
    # Opened for both directions, so that nothing hangs when the board ends meanwhile.
    echo "${job##*/}" 1<>"$VM/jobs.in"
    for ((i = 0; i < seconds * 20; i++)); do
        if [ -s "$job/status" ]; then
            cat "$job/output"
            return "$(cat "$job/status")"
        fi
        vm_alive || break
        sleep 0.05
    done
    cat "$job/output"
    if vm_alive; then
        return 124
    fi
    return 125
}

# vm_qmp COMMAND ARGUMENTS: a command of qemu's own protocol, with its arguments as JSON; prints the line of its answer.
vm_qmp() {
    local id=$BASHPID.$RANDOM i
    vm_alive || return 125
    echo "{\"execute\": \"$1\", \"arguments\": $2, \"id\": \"$id\"}" 1<>"$VM/monitor.in"
    for ((i = 0; i < 600; i++)); do
        grep -F "\"id\": \"$id\"" "$VM/monitor.out" && return 0
        vm_alive || return 125
        sleep 0.05
    done
    return 124
}

vm_monitor() {
    local answer
    answer=$(vm_qmp human-monitor-command "{\"command-line\": \"$1\"}") || return
    answer=${answer#'{"return": "'}
    printf '%b' "${answer%'", "id": '*}" | tr -d '\r'
}

vm_screenshot() {
    local answer
    answer=$(vm_qmp screendump "{\"filename\": \"$1\", \"device\": \"${2-gpu}\"}") || return
    case $answer in
    '{"return"'*) return 0 ;;
    esac
    echo "vm: no screenshot: $answer" >&2
    return 1
}

vm_has_event() {
    grep -q "\"event\": \"$1\"" "$VM/monitor.out"
}

vm_stop() {
    [ -e "$VM/pid" ] || return 0
    kill "$(cat "$VM/pid")" 2>/dev/null
    while vm_alive; do
        sleep 0.05
    done
    return 0
}
