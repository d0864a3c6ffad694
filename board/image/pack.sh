#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Packs an image for those who flash it: IMAGE.xz, its block map IMAGE.bmap, and the checksums of both in IMAGE.sha256.
#
# usage: board/image/pack.sh IMAGE
set -eu
[ $# = 1 ] || { echo "usage: board/image/pack.sh IMAGE" >&2; exit 2; }
name=$(basename "$1")
cd "$(dirname "$1")"
bmaptool -q create -o "$name.bmap" "$name"
# Threads and blocks of one size, however many cores there are: the same bytes from every machine. Most of an image is
# packed already, so that higher levels cost minutes and gain little.
xz -k -f -T2 --block-size=32MiB -2 "$name"
sha256sum "$name.xz" "$name.bmap" >"$name.sha256"
