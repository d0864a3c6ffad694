#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The first program of a board: mounts the root that the kernel's command line names, and what it needs from the first
# moment, and goes on in it. It waits for nothing but the partition.
export PATH=/bin
busybox mount -t devtmpfs dev /dev
busybox mkdir -p /proc /sys /root
busybox mount -t proc proc /proc
busybox mount -t sysfs sys /sys
while read -r module parameters; do
    # shellcheck disable=SC2086 # a word each
    busybox insmod "/modules/$module" $parameters
done </modules/order

say() {
    echo "wallwarp: $*" >/dev/console
}

fail() {
    say "$*; restarting"
    busybox sleep 2
    busybox reboot -f
}

# device_of LABEL: the device of a partition; the first, as another card may be in a reader.
device_of() {
    for device in $(busybox grep -lsx "PARTNAME=$1" /sys/class/block/*/uevent); do
        device=${device%/uevent}
        echo "/dev/${device##*/}"
        return
    done
    return 1
}

label=
# shellcheck disable=SC2013 # words are what it is made of
for word in $(busybox cat /proc/cmdline); do
    case $word in
    root=PARTLABEL=*) label=${word#root=PARTLABEL=} ;;
    esac
done

# A card takes its time to appear.
i=0
until root=$(device_of "$label"); do
    i=$((i + 1))
    [ "$i" -lt 200 ] || fail "no partition is named \"$label\", expected what root= on the kernel's command line says"
    busybox usleep 50000
done
busybox mount -t squashfs -o ro "$root" /root || fail "$root: cannot be mounted, expected the squashfs of a slot"

card=$(device_of card)
busybox mount -t vfat -o ro,nosuid,nodev,noexec,umask=022 "$card" /root/card ||
    say "partition \"card\" cannot be mounted: put the card into a PC and repair it, or flash it anew"
# So that boards of a room can be told apart on the network and in their logs.
node=$(busybox sed -n 's/^node: *\([0-9][0-9]*\).*/\1/p' /root/card/wallwarp.yaml)
busybox hostname "wallwarp${node:+-$node}"
busybox mount -t tmpfs -o nosuid,nodev,mode=1777,size=64m tmp /root/tmp
busybox mount -t tmpfs -o nosuid,nodev,mode=755,size=64m var /root/var
busybox mkdir -p /root/var/lib /root/var/log /root/var/cache /root/var/spool
busybox mkdir -m 1777 /root/var/tmp
busybox ln -s /run /root/var/run

busybox mount --move /dev /root/dev
busybox umount /sys /proc
exec busybox switch_root /root /lib/systemd/systemd
