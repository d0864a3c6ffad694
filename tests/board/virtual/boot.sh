#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs on the virtual board as its first process: finds the devices, then runs the jobs that the host sends.
export PATH=/usr/sbin:/usr/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t tmpfs run /run
mount -t tmpfs tmp /tmp
mkdir -p /dev/pts /dev/shm
mount -t devpts pts /dev/pts
mount -t tmpfs shm /dev/shm
modprobe configfs
mount -t configfs config /sys/kernel/config
hostname board
ip link set lo up

# The order gives the names. can0 and can1 are on one wire; can2 and can3, which know CAN FD, on another. vivid is
# /dev/video0 to 3, with its input in the first; vimc is /dev/video4 to 6.
for module in virtio_console kvaser_pci ctucanfd_pci can-raw can-isotp virtio-gpu i6300esb gpio-sim vivid vimc; do
    modprobe "$module"
done

lines=/sys/kernel/config/gpio-sim/lines
mkdir -p "$lines/bank"
echo 8 >"$lines/bank/num_lines"
echo wallwarp >"$lines/bank/label"
echo 1 >"$lines/live"

/lib/systemd/systemd-udevd --daemon
udevadm trigger --subsystem-match=video4linux --subsystem-match=media --subsystem-match=drm
udevadm settle

# busybox's init buries the processes that lost their parents, as a board's does.
echo ::respawn:/share/agent.sh >/etc/inittab
exec busybox init
