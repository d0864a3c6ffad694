#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The first program of a board: finds the partition that the kernel's command line names, and goes on in it.
export PATH=/bin
busybox mount -t devtmpfs dev /dev
busybox mkdir -p /proc /sys /root
busybox mount -t proc proc /proc
busybox mount -t sysfs sys /sys
while read -r module; do
    busybox insmod "/modules/$module"
done </modules/order

fail() {
    echo "wallwarp: $1; restarting" >/dev/console
    busybox sleep 2
    busybox reboot -f
}

label=
for word in $(busybox cat /proc/cmdline); do
    case $word in
    root=PARTLABEL=*) label=${word#root=PARTLABEL=} ;;
    esac
done

# A card takes its time to appear.
i=0
until device=$(busybox grep -lsx "PARTNAME=$label" /sys/class/block/*/uevent); do
    i=$((i + 1))
    [ "$i" -lt 200 ] || fail "no partition is named \"$label\" (root= on the kernel's command line)"
    busybox usleep 50000
done
device=${device%%/uevent*}
busybox mount -t squashfs -o ro "/dev/${device##*/}" /root || fail "partition \"$label\" is no squashfs"
busybox mount --move /dev /root/dev
busybox umount /sys /proc
exec busybox switch_root /root /lib/systemd/systemd
