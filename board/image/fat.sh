# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# FAT file systems in files, for scripts to source: the same bytes from the same files.
#
#   fat_image FILE MIB LABEL FOLDER      a file system of this size with what is in the folder
fat_image() {
    rm -f "$1"
    truncate -s "$2M" "$1"
    mkfs.vfat --invariant -F 32 -n "$3" "$1" >/dev/null
    find "$4" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
    (cd "$4" && find . -mindepth 1 -maxdepth 1 -printf '%P\n' | LC_ALL=C sort) | while read -r name; do
        TZ=UTC0 mcopy -msQ -i "$1" "$4/$name" ::
    done
}
