#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Every branch of board/setup.sh, with a made-up dpkg-query, apt-get, sudo and id. Run it from the tree's root.
# shellcheck disable=SC2016 # the made-up tools expand their own variables
set -u
unset DEBIAN_FRONTEND
. tests/support/checks.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ok_files="$folder/said $folder/done"

# A new machine: $1 is its user's number, $2 its sudo (none, free, password or broken).
machine() {
    rm -rf "${folder:?}/bin"
    mkdir "$folder/bin"
    : >"$folder/installed"
    : >"$folder/done"
    echo good >"$folder/apt"
    for tool in sh awk dirname mktemp rm tail env cat grep; do
        ln -s "$(command -v $tool)" "$folder/bin/$tool"
    done
    make_tool true 'exit 0'
    make_tool id "echo $1"
    make_tool dpkg-query '
        shift 3
        code=0
        for name in "$@"; do
            if grep -qx "$name" '"$folder"'/installed; then echo "$name installed"
            elif [ "$name" = make ]; then echo "make config-files"
            else echo "dpkg-query: no packages found matching $name" >&2; code=1; fi
        done
        exit $code'
    make_tool apt-get '
        echo "apt-get as ${fake_root-no root} ${DEBIAN_FRONTEND-no frontend}: $*" >>'"$folder"'/done
        case "$1 $(cat '"$folder"'/apt)" in
        "update no-lists") echo "E: no lists"; exit 100 ;;
        "install broken") for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do echo "E: reason $i"; done; exit 100 ;;
        "install liar" | update*) exit 0 ;;
        esac
        for word in "$@"; do echo "$word" >>'"$folder"'/installed; done
        echo "noise of apt-get"'
    case $2 in
    free) make_tool sudo '[ "$1" = -n ] && shift; export fake_root=sudo; exec "$@"' ;;
    password) make_tool sudo '
        [ "$1" = -n ] && exit 1
        echo "asked for a password" >>'"$folder"'/done
        export fake_root=sudo; exec "$@"' ;;
    broken) make_tool sudo 'exit 1' ;;
    esac
}

make_tool() {
    rm -f "$folder/bin/$1"
    printf '#!%s\n%s\n' "$(command -v sh)" "$2" >"$folder/bin/$1"
    chmod +x "$folder/bin/$1"
}

remove_tool() {
    rm -f "$folder/bin/$1"
}

# All packages but those named are installed.
have_all_but() {
    grep -v -e '^#' -e '^\[' -e '^$' board/host/packages >"$folder/installed"
    for package in "$@"; do
        grep -vx "$package" "$folder/installed" >"$folder/fewer"
        mv "$folder/fewer" "$folder/installed"
    done
}

run() {
    PATH="$folder/bin" sh board/setup.sh "$@" >"$folder/out" 2>"$folder/said" </dev/null
    code=$?
}

said() {
    grep -qF -e "$1" "$folder/said"
    ok $? "$name: says '$1'"
}

did() {
    grep -qF -e "$1" "$folder/done"
    ok $? "$name: does '$1'"
}

did_nothing() {
    [ ! -s "$folder/done" ]
    ok $? "$name: leaves apt-get alone"
}

exits() {
    [ "$code" = "$1" ]
    ok $? "$name: exit status $1, found $code"
    [ ! -s "$folder/out" ]
    ok $? "$name: nothing on stdout"
}

name='nothing missing'
machine 1000 none
have_all_but
run test
exits 0
did_nothing
[ ! -s "$folder/said" ]
ok $? "$name: silent"

name='root, nothing installed'
machine 0 none
run demo
exits 0
said 'setup: installing: gcc libc6-dev binutils make libsimde-dev libcyaml-dev libyaml-dev libjansson-dev libcbor-dev liblo-dev libpng-dev zlib1g-dev libmbedtls-dev gnuplot-nox'
did 'apt-get as no root noninteractive: update -qq'
did 'noninteractive: install -y -qq --no-install-recommends -o DPkg::Lock::Timeout=300 gcc libc6-dev binutils make'
! grep -q noise "$folder/said"
ok $? "$name: apt-get is quiet"
! grep -q libcmocka-dev "$folder/said"
ok $? "$name: demo takes the first group only"

name='the second time'
: >"$folder/done"
run demo
exits 0
did_nothing

name='root, some missing, tests'
machine 0 none
have_all_but clang make
run
exits 0
said 'setup: installing: make clang'
did 'Timeout=300 make clang'

name='root, benchmarks'
machine 0 none
have_all_but llvm libopencv-imgproc-dev
run test
exits 0
did_nothing
run bench
exits 0
said 'setup: installing: llvm libopencv-imgproc-dev'
did 'Timeout=300 llvm libopencv-imgproc-dev'

name='root, boards'
machine 0 none
have_all_but qemu-user clang qemu-system-arm
run board
exits 0
said 'setup: installing: qemu-user qemu-system-arm'

name='root, cards'
machine 0 none
have_all_but qemu-user clang bmap-tools
run flash
exits 0
said 'setup: installing: bmap-tools'
! grep -q -e clang -e qemu "$folder/said"
ok $? "$name: without the tests' packages"

name='sudo without a password'
machine 1000 free
run demo
exits 0
did 'apt-get as sudo noninteractive: update'
did 'apt-get as sudo noninteractive: install'

name='sudo with a password, no terminal'
machine 1000 password
have_all_but clang
run test
exits 1
said '  sudo apt-get update && sudo apt-get install -y --no-install-recommends clang'
did_nothing

name='sudo with a password, on a terminal'
machine 1000 password
PATH="$folder/bin:$PATH" script -qec 'sh board/setup.sh demo' /dev/null >"$folder/said" 2>&1 </dev/null
code=$?
: >"$folder/out"
exits 0
did 'asked for a password'
did 'apt-get as sudo noninteractive: install'

name='sudo refuses, on a terminal'
machine 1000 broken
PATH="$folder/bin:$PATH" script -qec 'sh board/setup.sh demo' /dev/null >"$folder/said" 2>&1 </dev/null
code=$?
exits 1
said 'sudo refused'
did_nothing

name='no sudo'
machine 1000 none
run demo
exits 1
said '  sudo apt-get update && sudo apt-get install -y --no-install-recommends gcc libc6-dev'
did_nothing

name='apt-get fails'
machine 0 none
echo broken >"$folder/apt"
run demo
exits 1
said 'apt-get could not install them'
said 'E: reason 16'
! grep -q 'reason 1$' "$folder/said"
ok $? "$name: the tail only"

name='lists cannot be updated'
machine 0 none
echo no-lists >"$folder/apt"
run demo
exits 0
said 'apt-get update failed, trying'
did 'install -y'

name='apt-get says yes and does nothing'
machine 0 none
echo liar >"$folder/apt"
have_all_but make
run demo
exits 1
said 'still missing after apt-get install: make'

name='no Debian, tools here'
machine 1000 none
remove_tool dpkg-query
for tool in gcc make gnuplot; do make_tool $tool ''; done
run demo
exits 0
said 'this is no Debian system; it needs what Debian calls: gcc libc6-dev'
said 'going on'

name='no Debian, a test tool missing'
run test
exits 1
said 'clang is not here'

name='no Debian, a benchmark tool missing'
run flash
exits 1
said 'bmaptool is not here'
for tool in bmaptool sfdisk mcopy mkfs.vfat debugfs mksquashfs xz; do make_tool $tool ''; done
run flash
exits 0
for tool in clang aarch64-linux-gnu-gcc qemu-aarch64 python3 llvm-objdump llvm-mca; do make_tool $tool ''; done
run test
exits 0
run bench
exits 1
said 'g++ is not here'
run board
exits 1
said 'mmdebstrap is not here'

name='no Debian, no compiler'
remove_tool gcc
run demo
exits 1
said 'gcc is not here'

name='dpkg without apt-get'
machine 0 none
remove_tool apt-get
run demo
exits 1
said 'this is no Debian system'

name='wrong arguments'
machine 0 none
run everything
exits 1
said "unknown argument 'everything', expected demo, test, bench, board, flash or image"
run demo test
exits 1
said 'expected one argument at most: demo, test, bench, board, flash or image'
did_nothing

ok_end
