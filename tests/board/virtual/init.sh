#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The virtual board's first program: stacks its root from folders of the host, and goes on in it.
export PATH=/bin
busybox mount -t devtmpfs dev /dev
while read -r module parameters; do
    # shellcheck disable=SC2086 # a word each
    busybox insmod "/modules/$module" $parameters
done </modules/order

mount_9p() {
    busybox mkdir -p "$2"
    busybox mount -t 9p -o "trans=virtio,version=9p2000.L,msize=262144,$3" "$1" "$2"
}
mount_9p sysroot /sysroot ro,cache=loose
mount_9p kernel /kernel ro,cache=loose
busybox mkdir /upper
busybox mount -t tmpfs upper /upper
busybox mkdir /upper/changes /upper/work
busybox mount -t overlay -o lowerdir=/sysroot:/kernel,upperdir=/upper/changes,workdir=/upper/work root /root

# What a job writes must be seen by the host at once, and the host's files by jobs.
mount_9p share /root/share cache=none
mount_9p tree /root/tree ro,cache=none
busybox mount --move /dev /root/dev
exec busybox switch_root /root /bin/busybox sh /share/boot.sh
