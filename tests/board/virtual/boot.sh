#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs on the virtual board as its first process: devices, then the jobs that the host sends.
export PATH=/usr/sbin:/usr/bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t tmpfs run /run
mount -t tmpfs tmp /tmp
modprobe configfs
mount -t configfs config /sys/kernel/config
mkdir -p /dev/pts /dev/shm
mount -t devpts pts /dev/pts
mount -t tmpfs shm /dev/shm
hostname board
ip link set lo up

# In this order: can0 and can1 on the first wire, can2 and can3, which know CAN FD, on the second.
modprobe kvaser_pci
modprobe ctucanfd_pci
for module in virtio_console can-raw can-isotp virtio-gpu i6300esb gpio-sim vimc vivid; do
    modprobe "$module"
done

chip=/sys/kernel/config/gpio-sim/lines
mkdir -p "$chip/bank"
echo 8 >"$chip/bank/num_lines"
echo board-lines >"$chip/bank/label"
echo 1 >"$chip/live"

/lib/systemd/systemd-udevd --daemon
udevadm trigger --subsystem-match=video4linux --subsystem-match=media --subsystem-match=drm
udevadm settle

printf '%s\n' ::respawn:/share/agent.sh >/etc/inittab
exec busybox init
