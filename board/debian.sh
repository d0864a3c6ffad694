# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Debian packages for arm64, unpacked into a folder, for scripts to source.
#
#   debian_extract FOLDER PACKAGES [MMDEBSTRAP_OPTION...]
#
# PACKAGES are names in one word, by spaces or line ends; what they depend on comes, too. FOLDER appears when all is in
# it; what was said is in FOLDER.log. No arm64 program runs, and nothing of this machine is changed. mmdebstrap knows
# where Debian's packages are, or takes a place from this machine's apt.
debian_extract() {
    local folder=$1 names mode=root
    names=$(printf '%s' "$2" | tr -s ' \n' ',')
    shift 2
    [ "$(id -u)" = 0 ] || mode=chrootless
    rm -rf "$folder" "$folder.part"
    mkdir -p "$(dirname "$folder")"
    # bin, sbin and lib are links into usr, as on every Debian system. Nothing is mounted, as nothing runs in it.
    # shellcheck disable=SC2016 # $1 is mmdebstrap's
    mmdebstrap --mode="$mode" --architectures=arm64 --variant=extract --skip=chroot/mount \
        --setup-hook='for f in bin sbin lib; do mkdir -p "$1/usr/$f"; ln -s "usr/$f" "$1/$f"; done' \
        --include="${names%,}" "$@" bookworm "$folder.part" 2>"$folder.log" && mv "$folder.part" "$folder" && return
    echo "${0##*/}: mmdebstrap failed; the end of what it said, all of which is in $folder.log:" >&2
    tail -n 15 "$folder.log" >&2
    return 1
}
