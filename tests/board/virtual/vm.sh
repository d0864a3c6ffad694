# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Host's side of the virtual board, to be sourced: start it, run commands in it, look at its display, stop it.
#
# The board's root is made of build/sysroot and build/board-kernel and forgets its changes. In it, /tree is the tree of
# this project, read-only, and /share is $VM/share here. A board is known by its folder $VM: any number of shells may
# set VM and use the same one.
#
#   vm_start FOLDER [QEMU_OPTION...]     sets VM=FOLDER, made anew, and returns when commands can be run
#   vm_run [-t SECONDS] COMMAND          prints what the command prints; its exit status, or 124 after SECONDS (60),
#                                        or 125 when the board is gone
#   vm_monitor COMMAND                   one line to qemu's monitor; prints its answer
#   vm_screenshot FILE                   what the display shows, as a PPM
#   vm_has_event NAME                    whether qemu has told of this: WATCHDOG, SHUTDOWN ...
#   vm_stop                              ends the board, in whatever state it is
VM=${VM-}

vm_start() {
    VM=$1
    shift
    rm -rf "$VM"
    mkdir -p "$VM/share/jobs" || return 1
    cp tests/board/virtual/{boot,agent}.sh "$VM/share/"
    mkfifo "$VM"/{monitor,control}.in
    : >"$VM/monitor.out"
    ln -s /dev/null "$VM/control.out"
    qemu-system-aarch64 -M virt -cpu cortex-a72 -smp 2 -accel tcg,thread=multi -m 1024 -display none -nodefaults \
        -kernel build/board-kernel/vmlinuz -initrd build/board-kernel/initramfs.gz \
        -append 'console=ttyAMA0 panic=-1 quiet' -no-reboot -serial "file:$VM/console" \
        -fsdev local,id=sysroot,path=build/sysroot,security_model=none,readonly=on \
        -fsdev local,id=kernel,path=build/board-kernel/root,security_model=none,readonly=on \
        -fsdev local,id=tree,path=.,security_model=none,readonly=on \
        -fsdev "local,id=share,path=$VM/share,security_model=none" \
        -device virtio-9p-pci,fsdev=sysroot,mount_tag=sysroot -device virtio-9p-pci,fsdev=kernel,mount_tag=kernel \
        -device virtio-9p-pci,fsdev=tree,mount_tag=tree -device virtio-9p-pci,fsdev=share,mount_tag=share \
        -chardev "pipe,id=control,path=$VM/control" -device virtio-serial-pci -device virtserialport,chardev=control \
        -chardev "pipe,id=monitor,path=$VM/monitor" -mon chardev=monitor,mode=control \
        -object can-bus,id=wire0 -device kvaser_pci,canbus=wire0 -device kvaser_pci,canbus=wire0 \
        -object can-bus,id=wire1 -device ctucan_pci,canbus0=wire1,canbus1=wire1 \
        -device virtio-gpu-pci,id=gpu -device i6300esb -action watchdog=reset \
        "$@" </dev/null >"$VM/qemu" 2>&1 &
    echo $! >"$VM/pid"
    for ((i = 0; i < 1200; i++)); do
        if [ -e "$VM/share/up" ]; then
            vm_qmp qmp_capabilities >"$VM/qmp" && return 0
        fi
        vm_alive || break
        sleep 0.1
    done
    echo "vm: the board did not start; what it and qemu said is in $VM" >&2
    tail -n 15 "$VM/console" "$VM/qemu" >&2
    vm_stop
    return 1
}

vm_alive() {
    kill -0 "$(cat "$VM/pid")" 2>/dev/null
}

vm_run() {
    local seconds=60 job i
    if [ "$1" = -t ]; then
        seconds=$2
        shift 2
    fi
    job=$(mktemp -d "$VM/share/jobs/XXXXXX")
    chmod 755 "$job"
    echo "$1" >"$job/command"
    vm_alive || return 125
    echo "${job##*/}" 1<>"$VM/control.in"
    for ((i = 0; i < seconds * 20; i++)); do
        if [ -e "$job/status" ]; then
            cat "$job/output"
            return "$(cat "$job/status")"
        fi
        vm_alive || return 125
        sleep 0.05
    done
    cat "$job/output"
    return 124
}

# A command of qemu's own protocol, with its arguments as JSON or none; prints the line of its answer.
vm_qmp() {
    local id=$BASHPID.$RANDOM i
    # Opened for both, so that nothing hangs when the board is gone.
    echo "{\"execute\": \"$1\", \"arguments\": ${2-{\}}, \"id\": \"$id\"}" 1<>"$VM/monitor.in"
    for ((i = 0; i < 600; i++)); do
        grep -F "\"id\": \"$id\"" "$VM/monitor.out" && return
        vm_alive || return 125
        sleep 0.05
    done
    return 124
}

vm_monitor() {
    local answer
    answer=$(vm_qmp human-monitor-command "{\"command-line\": \"$1\"}") || return
    answer=${answer#'{"return": "'}
    printf '%b' "${answer%%'", "id": '*}" | tr -d '\r'
}

vm_screenshot() {
    local answer
    answer=$(vm_qmp screendump "{\"filename\": \"$1\", \"device\": \"gpu\"}") || return
    [ "${answer#'{"return"'}" != "$answer" ] || { echo "vm: no screenshot: $answer" >&2; return 1; }
}

vm_has_event() {
    grep -q "\"event\": \"$1\"" "$VM/monitor.out"
}

vm_stop() {
    kill "$(cat "$VM/pid")" 2>/dev/null
    wait "$(cat "$VM/pid")" 2>/dev/null
    return 0
}
