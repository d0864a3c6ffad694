#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Writes a board's image and a card's own settings onto a disk: board/image/flash.sh NAME=VALUE ...; from the tree's root.
#
#   BOARD=rpi4          whose image; made first when it is missing
#   DEV=/dev/sdX        the disk, or a plain file that is made. Without it: lists the disks that may be written
#   IMAGE=FILE.img.xz   this image in place of build/BOARD/wallwarp-BOARD.img.xz; FILE.img.bmap is beside it
#   NODE=3 ROOM=studio.yaml KEY=room.key CAN=can1 DISPLAY=HDMI-A-2 CAMERA=v4l2:/dev/video2
#                       what differs from the image's own: each is put onto the card, and into its wallwarp.yaml
#   LOGIN=id.pub        public SSH keys, those of who may log in
#   YES=1               does not ask before it erases a disk
#
# All that can be wrong is looked for before the first byte is written. What was written is read again at the end.
# Exit status: 0 done, 1 refused or failed, 2 bad usage.
set -eu -o pipefail
PATH=$PATH:/usr/sbin:/sbin # Debian's users have them not
export LC_ALL=C TZ=UTC

say() { echo "flash: $*" >&2; }
fail() {
    say "$@"
    exit 1
}
usage() {
    say "$@"
    exit 2
}

board='' dev='' image='' node='' room='' key='' can='' display='' camera='' login='' yes=''
for argument in "$@"; do
    case $argument in
    BOARD=* | DEV=* | IMAGE=* | NODE=* | ROOM=* | KEY=* | CAN=* | DISPLAY=* | CAMERA=* | LOGIN=* | YES=*)
        name=${argument%%=*}
        [[ $argument != *[[:cntrl:]]* ]] || usage "$name=: holds a line end or another control character, expected a name"
        printf -v "${name,,}" %s "${argument#*=}"
        ;;
    *) usage "found \"$argument\", expected BOARD=, DEV=, IMAGE=, NODE=, ROOM=, KEY=, CAN=, DISPLAY=, CAMERA=, LOGIN= or YES=1" ;;
    esac
done

# --- the disk ---------------------------------------------------------------------------------------------------------

# One column that lsblk has for a disk; empty when it is no block device.
column_of() {
    lsblk -dbno "$1" "$2" 2>/dev/null | sed 's/^ *//; s/ *$//' || true
}

described() {
    local model
    model=$(column_of MODEL "$1")
    echo "${model:-a disk without a model name}, $(column_of SIZE "$1" | numfmt --to=iec-i --suffix=B --format=%.1f)"
}

# Where a disk, or one of what is on it, is mounted or otherwise in use; empty: nowhere.
uses_of() {
    lsblk -nrpo NAME,TYPE,MOUNTPOINTS "$1" | awk '
        $3 != "" {gsub(/\\x0a/, ", ", $3); print $1 " is mounted on " $3; exit}
        $2 != "disk" && $2 != "part" {print $1 " (" $2 ") is made of it"; exit}'
}

# Which folder of this system is on a disk; empty: none.
system_folder_on() {
    local folder source
    for folder in / /usr /boot /boot/efi /var /home; do
        source=$(findmnt -nvo SOURCE --target "$folder" || true)
        if lsblk -nsrpo NAME "$source" 2>/dev/null | grep -qxF "$1"; then
            echo "$folder"
            return
        fi
    done
}

# Refuse what is not a whole disk, free, writable and of `least` bytes.
check_disk() {
    local disk=$1 least=$2 type found
    type=$(column_of TYPE "$disk")
    case $type in
    disk) ;;
    part) fail "DEV=$disk: is a partition, expected the whole disk, /dev/$(column_of PKNAME "$disk")" ;;
    *) fail "DEV=$disk: is of type $type, expected a disk" ;;
    esac
    found=$(system_folder_on "$disk")
    [ -z "$found" ] || fail "DEV=$disk: holds $found of this system, expected another disk"
    found=$(uses_of "$disk")
    [ -z "$found" ] || fail "DEV=$disk: $found, expected a disk that is not in use (umount it)"
    found=$(column_of SIZE "$disk")
    [ "$found" -gt 0 ] || fail "DEV=$disk: has no size, expected a card in the reader"
    [ "$found" -ge "$least" ] || fail "DEV=$disk: has $found bytes, expected $least or more for this image"
    [ "$(column_of RO "$disk")" = 0 ] || fail "DEV=$disk: is read-only, expected a disk to write (the card's lock?)"
}

list_disks() {
    local disk found=0
    say "expected DEV=, one of these disks:"
    while read -r disk; do
        if (check_disk "$disk" 1) 2>/dev/null; then
            echo "  DEV=$disk  $(described "$disk")"
            found=1
        fi
    done < <(lsblk -dnrpo NAME)
    [ $found = 1 ] || echo "  none is here that is not in use; put a card into the reader"
}

# --- the image and what is put into it --------------------------------------------------------------------------------

stage='' # for the copy of the image with the card's settings and its key; nobody else may read it
clean_up() { [ -z "$stage" ] || rm -rf "$stage"; }
trap clean_up EXIT
trap 'exit 1' INT TERM

start_of() {
    sfdisk -d "$copy" 2>/dev/null | sed -n 's/.* start= *\([0-9]*\),.*name="'"$1"'".*/\1/p'
}

# The byte at which a partition of the copy begins.
offset_of() {
    local start
    start=$(start_of "$1")
    [ -n "$start" ] || fail "$image: has no partition \"$1\", expected an image of \`make image\`"
    echo $((512 * start))
}

# A file of the first root slot.
root_file() {
    unsquashfs -o "$root_at" -cat "$copy" "$1" 2>/dev/null || true
}

# The copy that is changed and then written. Every byte that counts is in the bmap, with its checksum.
unpack_image() {
    say "unpacking $image"
    copy=$stage/card.img
    bmaptool -q copy --bmap "$bmap" "$image" "$copy" >"$stage/log" 2>&1 ||
        fail "$image: is not what $bmap says, expected both of one build: $(grep . "$stage/log" | tail -n 1)"
    local found
    card_at=$(offset_of card)
    data_at=$(offset_of data)
    root_at=$(offset_of root-a)
    found=$(root_file etc/rauc/system.conf | sed -n 's/^compatible=//p')
    [ "$found" = "wallwarp-$board" ] ||
        fail "$image: is for \"$found\", expected \"wallwarp-$board\" (BOARD=$board)"
}

# Set a key of the card's settings, in place of the line that has it or shows it ("# key:"), else at the end.
set_key() {
    name=$1 value=$2 awk '
        BEGIN {key = ENVIRON["name"] ":"; line = key " " ENVIRON["value"]}
        index($0, key) == 1 || (!done && index($0, "# " key) == 1) {
            if (!done++) print line
            next
        }
        {print}
        END {if (!done) print line}' "$settings" >"$settings.new"
    touch -r "$settings" "$settings.new"
    mv "$settings.new" "$settings"
}

# A text as YAML writes it, whatever is in it.
quoted() { echo "'${1//\'/\'\'}'"; }

# Public keys, a line each, with dropbear's options before them or not. A private one must not get onto a card.
check_login() {
    local found
    [ -r "$login" ] || fail "LOGIN=$login: cannot be read, expected public SSH keys, as ~/.ssh/id_ed25519.pub"
    found=$(grep -nvE '^ *(#|$)|(^| )(ssh-(ed25519|rsa)|ecdsa-sha2-nistp[0-9]+|sk-[^ ]+) AAAA' "$login" | head -n 1 || true)
    [ -z "$found" ] || fail "LOGIN=$login:${found%%:*}: is no public SSH key, expected them, as ~/.ssh/id_ed25519.pub"
    grep -q AAAA "$login" || fail "LOGIN=$login: has no key, expected public SSH keys, as ~/.ssh/id_ed25519.pub"
}

# What the firmware's own reader of a room, key or configuration says of it.
check_by_firmware() {
    local part=$1 said
    shift
    said=$(build/host/wallwarp --check "$@" 2>&1 || true)
    grep -q "^found *$part: " <<<"$said" && return
    grep "^missing *$part: " <<<"$said" >"$stage/log" || head -n 1 <<<"$said" >"$stage/log"
    fail "$(sed 's/^missing *//' "$stage/log")"
}

# The image's wallwarp.yaml with what was asked for. Its time is the image's, so that cards differ in nothing else.
make_settings() {
    settings=$stage/wallwarp.yaml
    mcopy -n -m -i "$copy@@$card_at" ::wallwarp.yaml "$settings" 2>"$stage/log" ||
        fail "$image: has no wallwarp.yaml on its partition \"card\", expected an image of \`make image\`"
    [ -z "$node" ] || set_key node "$node"
    [ -z "$room" ] || set_key room /data/room.yaml
    [ -z "$key" ] || set_key key /data/room.key
    [ -z "$can" ] || set_key can "$(quoted "$can")"
    [ -z "$display" ] || set_key display "$(quoted "$display")"
    [ -z "$camera" ] || set_key camera "$(quoted "$camera")"
    check_by_firmware config --config "$settings"
}

# A file onto the data partition, with owner and mode. debugfs tells no failure: what is there is compared.
put_data() {
    local file=$1 name=$2 owner=$3 mode=$4
    cat "$file" >"$stage/put"
    (cd "$stage" && debugfs -w -f /dev/stdin "card.img?offset=$data_at") >"$stage/log" 2>&1 <<END
set_current_time @$(stat -c %Y "$settings")
rm $name
write put $name
set_inode_field $name uid $owner
set_inode_field $name gid $owner
set_inode_field $name mode $mode
END
    debugfs -R "cat $name" "$copy?offset=$data_at" 2>/dev/null | cmp -s - "$file" ||
        fail "$image: $file does not fit onto its partition \"data\""
}

# A file onto the first partition. Its time is the image's.
put_card() {
    local file=$1 name=$2
    cat "$file" >"$stage/put"
    touch -r "$settings" "$stage/put"
    mcopy -o -m -i "$copy@@$card_at" "$stage/put" "::$name" 2>"$stage/log" || true
    mcopy -n -i "$copy@@$card_at" "::$name" - 2>"$stage/log" | cmp -s - "$file" ||
        fail "$image: $name does not fit onto its partition \"card\""
}

put_settings() {
    local user
    [ -z "$node$room$key$can$display$camera" ] || put_card "$settings" wallwarp.yaml
    [ -z "$login" ] || put_card "$login" authorized_keys
    [ -z "$room" ] || put_data "$room" room.yaml 0 0100644
    if [ -n "$key" ]; then # of the firmware's user, and nobody else's: hal/hal_key.h
        user=$(root_file etc/passwd | awk -F: '$1 == "wallwarp" {print $3}')
        [ -n "$user" ] || fail "$image: has no user wallwarp for the key, expected an image of \`make image\`"
        put_data "$key" room.key "$user" 0100600
    fi
}

# --- writing ----------------------------------------------------------------------------------------------------------

ask() {
    local answer
    [ "$yes" != 1 ] || return 0
    read -r -p "flash: everything on it will be lost. Type yes to go on: " answer || true
    [ "$answer" = yes ] || fail "nothing was written"
}

write_card() {
    local as_root=()
    if [ "$kind" != disk ]; then
        install -m 600 /dev/null "$dev" # the key may be in it
    elif [ ! -w "$dev" ]; then
        as_root=(sudo)
    fi
    bmaptool create -o "$stage/bmap" "$copy" >"$stage/log" 2>&1 || fail "$copy: $(tail -n 1 "$stage/log")"
    "${as_root[@]}" flock "$dev" "$(dirname "$0")/write_card.sh" "$copy" "$stage/bmap" "$dev" || exit 1
}

# --- in order ---------------------------------------------------------------------------------------------------------

if [ -z "$dev" ]; then
    list_disks
    exit 2
fi
[[ $board != host && -f board/$board/board.mk ]] || usage "BOARD=$board: expected a board that has an image, as rpi4"
[ -z "$room" ] || [ -n "$node" ] || usage "ROOM=$room: expected NODE= with it, the board's number in the room file"
own=build/$board/wallwarp-$board.img.xz
image=${image:-$own}

kind='plain file'
[ -z "$(column_of TYPE "$dev")" ] || kind=disk
if [ "$kind" != disk ]; then
    [ "${dev#/dev/}" = "$dev" ] || fail "DEV=$dev: is not there, expected a disk; \`make flash\` lists them"
    [ -d "$(dirname "$dev")" ] || fail "DEV=$dev: has no folder, expected a file in one, or a disk"
    for file in "$image" "$room" "$key" "$login"; do
        [ ! "$dev" -ef "$file" ] || fail "DEV=$dev: is what is to be written, expected another file"
    done
    [ ! -e "$dev" ] || [ -f "$dev" ] || fail "DEV=$dev: is neither a disk nor a plain file, expected one of them"
else
    dev=$(realpath "$dev")
    check_disk "$dev" 1
    [[ $yes = 1 || (-t 0 && -t 2) ]] || fail "DEV=$dev: nobody can be asked without a terminal, expected YES=1"
fi

mkdir -p "build/$board"
stage=$(mktemp -d "build/$board/flash.XXXXXX")
[ -z "$room" ] || check_by_firmware room "$room" --node "$node"
[ -z "$key" ] || check_by_firmware key --key "$key"
[ -z "$login" ] || check_login

[[ -e $image || $image != "$own" ]] || make --no-print-directory BOARD="$board" image
bmap=${image%.xz}.bmap
for file in "$image" "$bmap"; do
    [[ -f $file && -r $file ]] || fail "$file: cannot be read, expected an image with its block map beside it"
done
if [ "$kind" = disk ]; then
    check_disk "$dev" "$(sed -n 's/.*<ImageSize> *\([0-9]*\).*/\1/p' "$bmap")"
fi
unpack_image
make_settings
put_settings

say "$dev: $(if [ "$kind" = disk ]; then described "$dev"; else echo "a $kind"; fi)"
say "wallwarp-$board $(root_file usr/lib/wallwarp/version)${node:+, node $node}${room:+, room $room}${key:+, key $key}${login:+, login $login}"
[ "$kind" != disk ] || ask
write_card
say "done: $dev is a card for $board${node:+, node $node}$([ "$kind" != disk ] || echo "; eject it")"
