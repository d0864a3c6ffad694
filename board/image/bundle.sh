#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes a signed update of a board's slots: board/image/bundle.sh BOARD FOLDER CERT KEY BUNDLE. FOLDER has kernel.vfat and
# root.squashfs; the version is the one in the root.
set -eu
[ $# = 5 ] || { echo "usage: board/image/bundle.sh BOARD FOLDER CERT KEY BUNDLE" >&2; exit 2; }
board=$1
folder=$2
bundle=$5
for file in "$folder/kernel.vfat" "$folder/root.squashfs" "$3" "$4"; do
    [ -r "$file" ] || { echo "bundle: can't read $file" >&2; exit 1; }
done
version=$(unsquashfs -cat "$folder/root.squashfs" usr/lib/wallwarp/version)
work=$(mktemp -d "$bundle.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir "$work/content"
ln "$folder/kernel.vfat" "$folder/root.squashfs" "$work/content/" 2>/dev/null ||
    cp "$folder/kernel.vfat" "$folder/root.squashfs" "$work/content/"
mv "$work/content/kernel.vfat" "$work/content/kernel.img"
mv "$work/content/root.squashfs" "$work/content/root.img"
cat >"$work/content/manifest.raucm" <<MANIFEST
[update]
compatible=wallwarp-$board
version=$version

[bundle]
format=verity

[image.kernel]
filename=kernel.img

[image.root]
filename=root.img
MANIFEST
# What is in it is packed already, but for the free space of the kernel's file system.
rauc bundle --cert="$3" --key="$4" --mksquashfs-args="-comp zstd -Xcompression-level 3 -no-progress -quiet" \
    "$work/content" "$work/bundle" >"$work/said" 2>&1 || { cat "$work/said" >&2; exit 1; }
mv "$work/bundle" "$bundle"
unsquashfs -cat "$folder/root.squashfs" etc/rauc/keyring.pem >"$work/keyring" 2>/dev/null || true # none is another one, too
openssl verify -no_check_time -CAfile "$work/keyring" "$3" >/dev/null 2>&1 ||
    echo "bundle: boards that start this version take nothing more that is signed with $3: it has another ca.pem" >&2
openssl x509 -noout -checkend 0 -in "$3" >/dev/null ||
    echo "bundle: boards will refuse it: $3 has expired; make a new one: RENEW=1 make DIR=$(dirname "$3") signing-key" >&2
echo "$bundle: version $version for $board, $(stat -c %s "$bundle") bytes"
