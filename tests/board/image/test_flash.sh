#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# `make flash`: what it writes, read with others' tools, and every refusal. Disks are files that a made-up lsblk calls
# disks. Run it from the tree's root. usage: test_flash.sh BUILD
# shellcheck disable=SC2016 # the made-up tools expand their own variables
set -u
export LC_ALL=C
PATH=$PATH:/usr/sbin:/sbin
root=$PWD
flash=board/image/flash.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files=$folder/said
. tests/support/checks.sh
. tests/board/image/flash_bench.sh

# --- what is written --------------------------------------------------------------------------------------------------

# A tree of its own, whose build folder is nobody else's.
mkdir -p "$folder/tree/build"
ln -s "$root/board" "$root/sim" "$folder/tree"
ln -s "$root/$1" "$folder/tree/build/host"
cd "$folder/tree" || exit 1
make_tools
make_image
printf '%s\n' '# who stands in the studio' 'ssh-ed25519 AAAAC3Nza me' '' 'no-pty sk-ssh-ed25519@openssh.com AAAAGnNr you' >"$folder/login"
(umask 077 && echo 000102030405060708090A0b0c0d0e0f >"$folder/room.key")

name='a file, nothing but the image'
run DEV="$folder/card1.img"
exits 0
cmp -s "$folder/card1.img" "$folder/card.img"
ok $? "$name: the same bytes"
[ "$(stat -c %a "$folder/card1.img")" = 600 ]
ok $? "$name: nobody else may read it"

name='a disk that was full of something else, all settings'
make_disk sdx 60000000
run DEV="$folder/sdx" NODE=3 ROOM=sim/demo/room.yaml KEY="$folder/room.key" CAN=can1 DISPLAY="it's" \
    CAMERA='libcamera:\_SB_.PCI "0"' LOGIN="$folder/login" YES=1
exits 0
said "flash: $folder/sdx: Card of a test, 57.3MiB"
said 'flash: wallwarp-qemu-virt 1.2-test, node 3, room sim/demo/room.yaml'
is_whole "$folder/sdx"
[ "$(tail -c +53477377 "$folder/sdx" | tr -d '\245' | wc -c)" = 0 ] && [ "$(stat -c %s "$folder/sdx")" = 60000000 ]
ok $? "$name: beyond the image nothing is written"
settings_of "$folder/sdx" >"$folder/settings"
diff - "$folder/settings" >"$folder/said" <<'END'
# This board.
node: 3

room: /data/room.yaml

# The key of the room.
key: /data/room.key
can: 'can1'
# end
display: 'it''s'
camera: 'libcamera:\_SB_.PCI "0"'
END
ok $? "$name: the settings are those asked for, the rest of the file is as it was"
data_of "$folder/sdx" 'cat room.yaml' | cmp -s - sim/demo/room.yaml
ok $? "$name: the room file is on the data partition"
data_of "$folder/sdx" 'cat room.key' | cmp -s - "$folder/room.key"
ok $? "$name: so is the key"
mcopy -n -i "$folder/sdx@@$((512 * start[card]))" ::authorized_keys - | cmp -s - "$folder/login"
ok $? "$name: so are the SSH keys, on the first partition"
data_of "$folder/sdx" 'stat room.key' >"$folder/said"
grep -q 'Type: regular *Mode: *0600 ' "$folder/said" && grep -q 'User: *990 ' "$folder/said"
ok $? "$name: the key is of the user wallwarp alone"
data_of "$folder/sdx" 'stat room.yaml' >"$folder/said"
grep -q 'Type: regular *Mode: *0644 ' "$folder/said" && grep -q 'User: *0 *Group: *0 ' "$folder/said"
ok $? "$name: the room is for all to read"
grep -q "^blockdev --flushbufs $folder/sdx,  locked$" "$folder/flushed"
ok $? "$name: what is compared comes from the disk, and nobody else has it"

name='two cards of a room'
run DEV="$folder/card1.img" NODE=1 ROOM=sim/demo/room.yaml KEY="$folder/room.key" LOGIN="$folder/login"
exits 0
sleep 1.1 # were there a time in it, it would be another one
run DEV="$folder/card2.img" NODE=2 ROOM=sim/demo/room.yaml KEY="$folder/room.key" LOGIN="$folder/login"
exits 0
[ "$(cmp -l "$folder/card1.img" "$folder/card2.img" | awk '{print $2, $3}')" = '61 62' ]
ok $? "$name: differ in the digit of the node, and in no other byte"

# --- what is refused --------------------------------------------------------------------------------------------------

cp "$folder/sdx" "$folder/sdx.before"
disk=$folder/sdx

name='no disk named'
make_disk system_disk 60000
make_disk locked 60000000
tell_lsblk locked RO 1
run
exits 2
said 'expected DEV=, one of these disks'
[ "$(cat "$folder/out")" = "  DEV=$disk  Card of a test, 57.3MiB" ]
ok $? "$name: lists the free disk alone: $(cat "$folder/out")"
tell_lsblk sdx RO 1
run
exits 2
grep -q 'none is here that is not in use' "$folder/out"
ok $? "$name: says that there is none"
tell_lsblk sdx RO 0

name='device'
run DEV="$disk"
refused 1 "DEV=$disk: nobody can be asked without a terminal, expected YES=1"
run DEV=/dev/no-such-disk YES=1
refused 1 'DEV=/dev/no-such-disk: is not there, expected a disk'
run DEV="$folder/system_disk" YES=1
refused 1 "DEV=$folder/system_disk: holds / of this system, expected another disk"
tell_lsblk sdx RO 1
run DEV="$disk" YES=1
refused 1 "DEV=$disk: is read-only, expected a disk to write"
tell_lsblk sdx RO 0
tell_lsblk sdx SIZE 0
run DEV="$disk" YES=1
refused 1 "DEV=$disk: has no size, expected a card in the reader"
tell_lsblk sdx SIZE 53477375
run DEV="$disk" YES=1
refused 1 "DEV=$disk: has 53477375 bytes, expected 53477376 or more for this image"
tell_lsblk sdx SIZE 60000000
printf '%s1 part /media/card\\x0a/mnt\n' "$disk" >>"$disk.tree"
run DEV="$disk" YES=1
refused 1 "DEV=$disk: ${disk}1 is mounted on /media/card, /mnt, expected a disk that is not in use"
printf '%s disk\n%s1 part\nvg-home lvm\n' "$disk" "$disk" >"$disk.tree"
run DEV="$disk" YES=1
refused 1 "DEV=$disk: vg-home (lvm) is made of it, expected a disk that is not in use"
printf '%s disk\n%s1 part\n' "$disk" "$disk" >"$disk.tree"
tell_lsblk sdx TYPE part
echo PKNAME=sdw >>"$disk.lsblk"
run DEV="$disk" YES=1
refused 1 "DEV=$disk: is a partition, expected the whole disk, /dev/sdw"
tell_lsblk sdx TYPE rom
run DEV="$disk" YES=1
refused 1 "DEV=$disk: is of type rom, expected a disk"
tell_lsblk sdx TYPE disk

name='a question on a terminal'
ask() {
    echo "$1" | PATH="$folder/bin:$PATH" script -qec "$flash BOARD=qemu-virt IMAGE=$folder/image.img.xz DEV=$disk NODE=2" \
        "$folder/typescript" >"$folder/said" 2>&1
    code=$?
}
ask y
exits 1
said "$disk: Card of a test, 57.3MiB"
said 'Type yes to go on'
said 'nothing was written'
cmp -s "$disk" "$disk.before"
ok $? "$name: another answer than yes leaves the disk as it was"
ask yes
exits 0
[ "$(settings_of "$disk" | grep -c '^node: 2$')" = 1 ]
ok $? "$name: yes writes"
cp "$disk" "$disk.before"

name='a disk that reads back otherwise'
echo 'printf x | dd of='"$disk"' bs=1 seek='$((512 * start[card] + 100))' conv=notrunc status=none' >"$folder/on_flush"
run DEV="$disk" YES=1
exits 1
said "DEV=$disk: reads back otherwise than it was written, from byte"
: >"$folder/on_flush"
cp "$disk.before" "$disk"

name='a disk that cannot be written'
: >"$folder/refuse"
run DEV="$disk" YES=1
exits 1
said "DEV=$disk: was not written whole, expected a good disk that nobody else uses"
rm "$folder/refuse"

name='plain file'
run DEV="$folder/no/made.img"
refused 1 "DEV=$folder/no/made.img: has no folder, expected a file in one, or a disk"
run DEV="$folder"
refused 1 "DEV=$folder: is neither a disk nor a plain file"
run DEV=sim/demo/room.yaml NODE=1 ROOM=sim/demo/room.yaml
refused 1 'DEV=sim/demo/room.yaml: is what is to be written'

name='settings'
dev="DEV=$folder/made.img"
run "$dev" NODE=5 ROOM=sim/demo/room.yaml
refused 1 'room: sim/demo/room.yaml: no board has node 5'
run "$dev" NODE=64 ROOM=sim/demo/room.yaml
refused 1 'found "64", expected 1 to 63'
run "$dev" NODE=64
refused 1 'node: found 64, expected 1 to 63'
run "$dev" NODE=two
refused 1 "node: found 'two', expected a whole number"
run "$dev" ROOM=sim/demo/room.yaml
refused 2 'ROOM=sim/demo/room.yaml: expected NODE= with it'
run "$dev" NODE=1 ROOM="$folder/none.yaml"
refused 1 "room: $folder/none.yaml"
sed 's/^boards:/board:/' sim/demo/room.yaml >"$folder/broken.yaml"
run "$dev" NODE=1 ROOM="$folder/broken.yaml"
refused 1 "room: $folder/broken.yaml:"
head -c 31 "$folder/room.key" >"$folder/short.key"
chmod 600 "$folder/short.key"
run "$dev" KEY="$folder/short.key"
refused 1 "key: $folder/short.key: is no key, expected 32 hexadecimal digits"
chmod 644 "$folder/short.key"
run "$dev" KEY="$folder/short.key"
refused 1 "key: $folder/short.key: has mode 0644"
run "$dev" LOGIN="$folder/none.pub"
refused 1 "LOGIN=$folder/none.pub: cannot be read, expected public SSH keys"
printf '%s\n' '-----BEGIN OPENSSH PRIVATE KEY-----' AAAA >"$folder/private"
run "$dev" LOGIN="$folder/private"
refused 1 "LOGIN=$folder/private:1: is no public SSH key"
echo '# none' >"$folder/empty"
run "$dev" LOGIN="$folder/empty"
refused 1 "LOGIN=$folder/empty: has no key"
run "$dev" CAN="$(printf 'can0\ncan1')"
refused 2 'CAN=: holds a line end or another control character, expected a name'
run "$dev" DISK=1
refused 2 'found "DISK=1", expected BOARD='

name='image'
wrong() {
    PATH="$folder/bin:$PATH" "$flash" BOARD="$1" IMAGE="$folder/$2.img.xz" "$dev" >"$folder/out" 2>"$folder/said" </dev/null
    code=$?
}
wrong rpi4 image
refused 1 "$folder/image.img.xz: is for \"wallwarp-qemu-virt\", expected \"wallwarp-rpi4\" (BOARD=rpi4)"
wrong host image
refused 2 'BOARD=host: expected a board that has an image'
wrong rpi5x image
refused 2 'BOARD=rpi5x: expected a board that has an image'
wrong qemu-virt none
refused 1 "$folder/none.img.xz: cannot be read, expected an image with its block map beside it"
cp "$folder/image.img.xz" "$folder/bare.img.xz"
wrong qemu-virt bare
refused 1 "$folder/bare.img.bmap: cannot be read, expected an image with its block map beside it"
cp "$folder/image.img.bmap" "$folder/cut.img.bmap"
head -c $(($(stat -c %s "$folder/image.img.xz") / 2)) "$folder/image.img.xz" >"$folder/cut.img.xz"
wrong qemu-virt cut
refused 1 "$folder/cut.img.xz: is not what $folder/cut.img.bmap says, expected both of one build"
cp "$folder/image.img.bmap" "$folder/other.img.bmap"
cp "$folder/card.img" "$folder/card.img.before"
printf x | dd of="$folder/card.img" bs=1 seek=$((512 * ${start[root-a]} + 300)) conv=notrunc status=none
xz -0 -c "$folder/card.img" >"$folder/other.img.xz"
wrong qemu-virt other
refused 1 "$folder/other.img.xz: is not what $folder/other.img.bmap says"
cp "$folder/card.img.before" "$folder/card.img"
sed 's/<BlocksCount>/<BlocksCount> /' "$folder/image.img.bmap" >"$folder/edited.img.bmap"
cp "$folder/image.img.xz" "$folder/edited.img.xz"
wrong qemu-virt edited
refused 1 "$folder/edited.img.xz: is not what $folder/edited.img.bmap says"
sfdisk -q --part-label "$folder/card.img" 7 rest
pack_image no-data
wrong qemu-virt no-data
refused 1 "$folder/no-data.img.xz: has no partition \"data\", expected an image of"
cp "$folder/card.img.before" "$folder/card.img"
head -c $((512 * size[data] - 1000000)) /dev/urandom >"$folder/much"
printf 'write %s much\n' "$folder/much" | debugfs -w -f - "$folder/card.img?offset=$((512 * start[data]))" >"$folder/said" 2>&1
pack_image full
{ cat sim/demo/room.yaml && yes '#' | head -c 4000000; } >"$folder/long.yaml"
PATH="$folder/bin:$PATH" "$flash" BOARD=qemu-virt IMAGE="$folder/full.img.xz" NODE=1 ROOM="$folder/long.yaml" "$dev" \
    >"$folder/out" 2>"$folder/said" </dev/null
code=$?
refused 1 "$folder/full.img.xz: $folder/long.yaml does not fit onto its partition \"data\""

# --- make -------------------------------------------------------------------------------------------------------------

name='make flash, no image yet'
make_tool make 'echo "make $*" >>'"$folder"'/made
    for end in xz bmap; do cp '"$folder"'/image.img.$end build/qemu-virt/wallwarp-qemu-virt.img.$end; done'
for time in first second; do
    PATH="$folder/bin:$PATH" "$flash" BOARD=qemu-virt DEV="$folder/$time.img" >"$folder/out" 2>"$folder/said" </dev/null
    code=$?
    exits 0
    cmp -s "$folder/$time.img" "$folder/card.img.before"
    ok $? "$name: the $time time: writes the image"
done
[ "$(cat "$folder/made")" = 'make --no-print-directory BOARD=qemu-virt image' ]
ok $? "$name: the image is made, once"

name='make flash'
DISPLAY=:0 KEY=no NODE=9 make -C "$root" -n BOARD=qemu-virt flash DEV="my card.img" CAN="it's" >"$folder/said" 2>&1
grep -q "board/image/flash.sh 'BOARD=qemu-virt' 'DEV=my card.img' *'CAN=it'\\\\''s' *\$" "$folder/said"
ok $? "$name: takes what is on its command line, and not the variables of a desktop"

ok_end
