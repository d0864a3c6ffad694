#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the packages that this tree needs and this machine lacks: board/setup.sh [demo|test|bench|board|flash|image]
set -u

packages_file=$(dirname "$0")/host/packages
install_options='-y -qq --no-install-recommends -o DPkg::Lock::Timeout=300'
log=

say() {
    echo "setup: $*" >&2
}

fail() {
    say "$@"
    exit 1
}

# Packages of the groups named, on one line.
packages_of() {
    awk -v groups=" $* " '
        /^\[.*\]$/ { wanted = index(groups, " " substr($0, 2, length($0) - 2) " "); next }
        wanted && NF && $1 !~ /^#/ { printf "%s ", $1 }' "$packages_file"
}

# Those of the packages named that are not installed. dpkg-query fails when it has never heard of one: not an error here.
missing_of() {
    # shellcheck disable=SC2016 # the ${} are dpkg-query's
    dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
        awk -v wanted="$*" '
            $2 == "installed" { have[$1] = 1 }
            END { n = split(wanted, name, " "); for (i = 1; i <= n; i++) if (!(name[i] in have)) printf "%s ", name[i] }'
}

# The command that gives the right to install, into $as_root: empty for root itself.
find_right() {
    as_root=
    [ "$(id -u)" = 0 ] && return 0
    command -v sudo >/dev/null || return 1
    as_root='sudo -n'
    sudo -n true 2>/dev/null && return 0
    as_root=sudo
    [ -t 0 ] && [ -t 2 ]
}

# Without dpkg and apt-get: go on if the tools at least are here.
go_on_without_apt() {
    say "this is no Debian system; it needs what Debian calls: $*"
    tools='gcc make gnuplot'
    case $group in
    test | bench) tools="$tools clang python3" ;;
    board) tools="$tools mmdebstrap aarch64-linux-gnu-g++ qemu-system-aarch64 modprobe cpio" ;;
    image) tools="$tools mmdebstrap aarch64-linux-gnu-g++ modprobe cpio mke2fs mkimage dtc openssl rauc systemd-sysusers" ;;
    esac
    case $group in
    test | bench | flash | image) tools="$tools bmaptool sfdisk mcopy mkfs.vfat debugfs mksquashfs xz" ;;
    esac
    [ "$group" != demo ] && [ "$group" != flash ] && tools="$tools aarch64-linux-gnu-gcc qemu-aarch64"
    [ "$group" = bench ] && tools="$tools llvm-objdump llvm-mca g++"
    for tool in $tools; do
        command -v "$tool" >/dev/null || fail "$tool is not here: install it and the others with this system's own tools"
    done
    say "the tools are here, going on: a missing header or library will show up in the build"
    exit 0
}

install_packages() {
    log=$(mktemp) || fail "cannot make a temporary file"
    trap 'rm -f "$log"' EXIT
    say "installing: $*"
    if [ "$as_root" = sudo ]; then
        sudo true || fail "sudo refused; install them yourself: apt-get install $*"
    fi
    # shellcheck disable=SC2086 # words are meant to split
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq -o DPkg::Lock::Timeout=300 >"$log" 2>&1 ||
        say "apt-get update failed, trying with the package lists that are here"
    # shellcheck disable=SC2086
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install $install_options "$@" >>"$log" 2>&1 && return 0
    say "apt-get could not install them; the end of what it said:"
    tail -n 15 "$log" >&2
    exit 1
}

group=${1-test}
[ $# -le 1 ] || fail "expected one argument at most: demo, test, bench, board, flash or image"
case $group in
demo) needed=$(packages_of demo) ;;
test) needed=$(packages_of demo arm test flash) ;;
bench) needed=$(packages_of demo arm test flash bench) ;;
board) needed=$(packages_of demo arm board) ;;
flash) needed=$(packages_of demo flash) ;;
image) needed=$(packages_of demo arm board flash image) ;;
*) fail "unknown argument '$group', expected demo, test, bench, board, flash or image" ;;
esac
[ -n "$needed" ] || fail "$packages_file lists no packages"

# shellcheck disable=SC2086 # one argument for each package
{
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        go_on_without_apt $needed
    fi
    missing=$(missing_of $needed)
    [ -n "$missing" ] || exit 0
    if ! find_right; then
        say "these packages are missing, and only root may install them; type this once:"
        echo "  sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing% }" >&2
        exit 1
    fi
    install_packages $missing
    missing=$(missing_of $missing)
    [ -z "$missing" ] || fail "still missing after apt-get install: $missing"
}
