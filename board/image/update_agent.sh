#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The update agent of a board (contract: hal/hal_update.h and hal/linux/update_folder.h): with RAUC it writes a bundle
# into the slot that does not run, and with the boot state (boot.cmd) it starts the board in that one, on trial.
#
# usage: update_agent start           once a start, after the firmware: the running slot has come up
#        update_agent request         do what is in the folder's file `request`
#        update_agent stick DEVICE    a partition of a stick was plugged in: install the bundle that is on it
#        update_agent expired         a trial has taken too long: give it up
# Its units are in board/service. WALLWARP_ROOT, for tests, is put before every path.
set -u
root=${WALLWARP_ROOT-}
folder=$root/run/wallwarp/update  # the firmware's user writes there, so nothing in it is opened for writing here
own=$root/run/wallwarp-update
version_file=usr/lib/wallwarp/version
fetched=$root/data/update.raucb
parts=$root/dev/disk/by-partlabel
trial_starts=3
proven_starts=9

# What is true of both slots, into slot, other, letter (of the other), order, left (of the other), update, trial, running,
# fit (the version in the other slot when the board may be switched to it).
look() {
    slot=$(tr ' ' '\n' <"$root/proc/cmdline" | sed -n 's/^rauc\.slot=//p')
    case $slot in
    A) other=B letter=b ;;
    B) other=A letter=a ;;
    *)
        echo "update: the kernel's command line has no rauc.slot=A or B: was this board started by boot.scr?" >&2
        exit 1
        ;;
    esac
    order=$(fw_printenv -n BOOT_ORDER)
    left=$(fw_printenv -n BOOT_${other}_LEFT)
    update=$(fw_printenv -n BOOT_UPDATE 2>/dev/null)
    trial=0
    [ "$update" != "trial $slot" ] || trial=1
    running=$(cat "$root/$version_file")
    fit=
    case $update in
    "waiting $other") fit=$(other_version) ;;
    *)
        case " $order " in
        *" $other "*) [ "${left:-0}" = 0 ] || fit=$(other_version) ;;
        esac
        ;;
    esac
}

# The version in the other slot, when that can be read.
other_version() {
    mkdir -p "$own/other"
    mount -t squashfs -o ro,nosuid,nodev,noexec "$parts/root-$letter" "$own/other" || return 0
    cat "$own/other/$version_file"
    umount "$own/other"
}

# tell STATE PROGRESS MESSAGE
tell() {
    mkdir -p "$own"
    waiting=
    [ "$update" != "waiting $other" ] || waiting=$fit
    {
        printf 'state=%s\nprogress=%s\nslot=%s\ntrial=%s\nrunning=%s\n' "$1" "$2" "$slot" "$trial" "$running"
        printf 'waiting=%s\nother=%s\n' "$waiting" "$fit"
        printf 'message=%.128s\n' "$(printf '%s' "$3" | tr '\n' ' ' | LC_ALL=C tr -c ' -~' '?')"
    } >"$own/state"
    mv -T "$own/state" "$folder/state"
    [ "$1" != failed ] || echo "<3>update: $3" >&2 # for the journal, which takes the level off: an error
}

# What is true after a request: a version waits or none does.
tell_idle() {
    if [ "$update" = "waiting $other" ]; then tell ready 100 "$1"; else tell idle 0 "$1"; fi
}

# Boot state, whole or not at all: NAME=VALUE arguments, an empty VALUE takes it out.
set_boot() {
    printf '%s\n' "$@" | fw_setenv -s - && return 0
    tell failed 0 "the boot state can't be written (partition 'state' of the card)"
    return 1
}

start() {
    look
    mkdir -p "$folder"
    rm -f "$fetched" # the supply may have failed while it came
    first=${order%% *}
    if [ "$trial" = 1 ]; then
        tell idle 0 "version $running is on trial"
    elif [ "$first" != "$slot" ] || [ "$update" = "trial $other" ]; then
        gone=$(other_version)
        gone=${gone:-(unknown)}
        set_boot "BOOT_ORDER=$slot" "BOOT_${slot}_LEFT=$proven_starts" "BOOT_UPDATE=failed $other" || return
        look
        tell failed 0 "version $gone in slot $other did not prove itself; back in slot $slot with version $running"
    else
        set_boot "BOOT_${slot}_LEFT=$proven_starts" || return
        tell_idle ""
    fi
}

# The firmware sees a request gone after the state that answers it.
answered() {
    rm -f "$folder/request"
}

good() {
    look
    [ "$trial" = 0 ] || set_boot "BOOT_ORDER=$slot $other" "BOOT_${slot}_LEFT=$proven_starts" BOOT_UPDATE= || return
    look
    tell_idle ""
}

switch() {
    look
    if [ -z "$fit" ]; then
        tell failed 0 "no version waits in slot $other, install one first"
        return
    fi
    set_boot "BOOT_ORDER=$other $slot" "BOOT_${other}_LEFT=$trial_starts" "BOOT_UPDATE=trial $other" || return
    tell switching 100 "to version $fit"
    systemctl reboot
}

expired() {
    look
    [ "$trial" = 1 ] || return 0
    echo "update: version $running has shown no good picture in time, going back to slot $other" >&2
    set_boot "BOOT_${slot}_LEFT=0" && systemctl reboot
}

board() {
    sed -n 's/^compatible=wallwarp-//p' "$root/etc/rauc/system.conf"
}

# The bundle of a mounted stick, the last by name.
bundle_of_stick() {
    for bundle in "$own/stick/wallwarp-$(board)"*.raucb; do :; done
    [ -f "$bundle" ]
}

# Mounts sticks one after the other until one has a bundle, and leaves that mounted.
find_stick() {
    mkdir -p "$own/stick"
    for device in "$@"; do
        mount -o ro,nosuid,nodev,noexec "$device" "$own/stick" 2>/dev/null || continue
        bundle_of_stick && return 0
        umount "$own/stick"
    done
    return 1
}

# What comes over the network is nobody's until RAUC has checked its signature.
fetch() {
    rm -f "$fetched"
    said=$("$root/usr/local/lib/wallwarp/download" "$1" "$fetched" 9>&-) && bundle=$fetched && return 0
    said=${said##*wget: }
    free=$(free_mib)
    rm -f "$fetched"
    if [ "$free" -lt 1 ]; then
        tell failed 0 "the data partition is too full for $1: $free MiB are free"
    else
        tell failed 0 "can't fetch $1: ${said:-not done in 15 minutes}"
    fi
    return 1
}

free_mib() {
    df -k "$root/data" | awk 'END { print int($4 / 1024) }'
}

# install FILE NAME: the bundle in a file, which people know by that name.
install() {
    # Its signature and board first, as these leave the other slot as it is.
    if ! said=$(rauc info --output-format=shell "$1" 2>&1); then
        tell failed 0 "refused: $(printf '%s' "$said" | tail -n 1) ($2)"
        return
    fi
    compatible=$(printf '%s\n' "$said" | sed -n "s/^RAUC_MF_COMPATIBLE='\(.*\)'$/\1/p")
    if [ "$compatible" != "wallwarp-$(board)" ]; then
        tell failed 0 "refused: for $compatible, this board is wallwarp-$(board) ($2)"
        return
    fi
    set_boot BOOT_UPDATE= || return
    look
    fit=
    tell installing 0 "$2"
    mkfifo "$own/said"
    rauc install "$1" >"$own/said" 2>&1 &
    reason=
    while read -r line; do
        case $line in
        [0-9]*%*) tell installing "${line%%%*}" "$2" ;;
        *LastError:*) reason=${line#*LastError: } ;;
        esac
    done <"$own/said"
    rm -f "$own/said"
    if ! wait $!; then
        look
        tell failed 0 "not installed: ${reason:-rauc failed} ($2)"
        return
    fi
    set_boot "BOOT_UPDATE=waiting $other" || return
    look
    tell ready 100 ""
}

# may_install: not while the other slot is the only one that is known to work.
may_install() {
    [ "$trial" = 0 ] && return 0
    tell failed 0 "version $running is on trial, and slot $other the way back: install when it has proved itself"
    return 1
}

install_source() {
    look
    if ! may_install; then
        answered
        return
    fi
    tell installing 0 "$1"
    answered
    case $1 in
    usb)
        if find_stick "$root"/dev/disk/by-id/usb-*; then
            install "$bundle" "${bundle##*/}"
            umount "$own/stick"
        else
            tell failed 0 "no USB stick has a file wallwarp-$(board)*.raucb at its top"
        fi
        ;;
    http://* | https://*)
        fetch "$1" && install "$bundle" "$1"
        rm -f "$fetched"
        ;;
    /*) install "$root$1" "$1" ;;
    *) tell failed 0 "can't install $1: expected usb, a path, or an http:// or https:// URL" ;;
    esac
}

# A stick may stay plugged in: what is in a slot already, or was given up there, is not installed again.
stick() {
    look
    find_stick "$1" || return 0
    version=$(rauc info --output-format=shell "$bundle" 2>/dev/null | sed -n "s/^RAUC_MF_VERSION='\(.*\)'$/\1/p")
    if [ -n "$version" ] && { [ "$version" = "$running" ] || [ "$version" = "$(other_version)" ]; }; then
        echo "update: ${bundle##*/} on the stick is version $version, which is here already" >&2
    elif [ "$trial" = 1 ]; then
        echo "update: ${bundle##*/} on the stick has to wait, version $running is on trial" >&2
    else
        install "$bundle" "${bundle##*/}"
    fi
    umount "$own/stick"
}

request() {
    if [ ! -f "$folder/request" ] || [ -L "$folder/request" ]; then
        answered
        return
    fi
    { read -r word source || [ -n "$word" ]; } <"$folder/request" || word=
    case "$word ${source:+with}" in
    'install with')
        install_source "$source"
        return # there may be a new request by now
        ;;
    'switch ') switch ;;
    'good ') good ;;
    *)
        look
        tell failed 0 "unknown request '$word $source', expected: install SOURCE, switch, or good"
        ;;
    esac
    answered
}

# One at a time.
mkdir -p "$own"
exec 9>"$own/lock"
flock 9
case ${1-} in
start | request | expired) "$1" ;;
stick) stick "${2:?stick DEVICE}" ;;
*)
    echo "usage: update_agent start|request|stick DEVICE|expired" >&2
    exit 2
    ;;
esac
