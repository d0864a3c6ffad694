#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# shellcheck disable=SC2016 # the played programs expand what is in them
# The update agent on this machine, with a folder for a board's root: real RAUC checks real bundles, libubootenv keeps the
# boot state in a file; mounts, installs, downloads and restarts are played.
# Usage, from the tree's root: tests/board/image/test_update_agent.sh
set -u
# shellcheck source=tests/support/checks.sh
. tests/support/checks.sh
folder=$PWD/build/update_agent
export WALLWARP_ROOT=$folder/root
state=$WALLWARP_ROOT/run/wallwarp/update/state
request=$WALLWARP_ROOT/run/wallwarp/update/request
parts=$WALLWARP_ROOT/dev/disk/by-partlabel

# program NAME: a played one, from stdin.
program() {
    { echo '#!/bin/bash'; echo "folder=$folder"; cat; } >"$folder/bin/$1"
    chmod +x "$folder/bin/$1"
}

# bundle NAME BOARD VERSION KEYS
bundle() {
    mkdir -p "$folder"/slot/root/{etc/rauc,usr/lib/wallwarp}
    cp "$folder/$4/ca.pem" "$folder/slot/root/etc/rauc/keyring.pem"
    echo "$3" >"$folder/slot/root/usr/lib/wallwarp/version"
    head -c 300000 /dev/urandom >"$folder/slot/root/programs"
    mksquashfs "$folder/slot/root" "$folder/slot/root.squashfs" -noappend -quiet -no-progress
    head -c 100000 /dev/zero >"$folder/slot/kernel.vfat"
    board/image/bundle.sh "$2" "$folder/slot" "$folder/$4/signing.pem" "$folder/$4/signing.key" "$folder/root/$1" >/dev/null
}

make_root() {
    rm -rf "$folder"
    mkdir -p "$folder"/bin "$WALLWARP_ROOT"/{proc,data,run/wallwarp/update,etc/rauc,usr/lib/wallwarp,dev/disk/by-id} \
        "$parts"/root-{a,b}/usr/lib/wallwarp "$folder/stick"
    {
        board/image/signing_key.sh "$folder/keys" &&
            board/image/signing_key.sh "$folder/stranger" &&
            mkdir "$folder/expired" && cp "$folder"/keys/ca.* "$folder/expired/" &&
            END=20210101000000Z board/image/signing_key.sh "$folder/expired"
    } 2>/dev/null || exit 1
    install -D board/image/tree/usr/local/lib/wallwarp/download "$WALLWARP_ROOT/usr/local/lib/wallwarp/download"
    sed "s/@BOARD@/front/" board/image/system.conf >"$WALLWARP_ROOT/etc/rauc/system.conf"
    bundle new front 2.0 keys
    bundle stranger front 2.0 stranger
    bundle expired front 2.0 expired
    bundle other rear 2.0 keys
    head -c 200000 "$WALLWARP_ROOT/new" >"$WALLWARP_ROOT/cut"
    printf '%s %#x 0x200\n' "$folder/boot" 0 "$folder/boot" 0x80000 >"$folder/fw_env.config"
    program fw_printenv <<<'exec /usr/bin/fw_printenv -c $folder/fw_env.config "$@"'
    program fw_setenv <<<'[ ! -e $folder/boot.broken ] && exec /usr/bin/fw_setenv -c $folder/fw_env.config -f /dev/null "$@"'
    program mount <<<'from=${@: -2:1}; [ -e "$from" ] && cp -r "$from/." "${@: -1}"'
    program umount <<<'rm -rf "$1"/*'
    program systemctl <<<'echo "$@" >>$folder/systemctl'
    program wget <<<'to=${@: -3:1}; case ${@: -1} in
        */new) cp $folder/root/new "$to" ;;
        */slow) : >$folder/slow; : >$folder/seconds
            until [ $(wc -l <$folder/seconds) -ge 170 ]; do /bin/sleep 0.05; done
            rm $folder/slow; /bin/sleep 0.2; cp $folder/root/new "$to" ;;
        */stalled) echo part >"$to"; echo $$ >$folder/stalled; exec /bin/sleep 600 ;;
        */big) echo part >"$to"; : >$folder/full; echo "wget: short write" >&2; exit 1 ;;
        *) echo "wget: server returned error: HTTP/1.1 404 Not Found" >&2; exit 1 ;;
        esac'
    # Of a slow download a byte comes at every fiftieth second, which is a short one.
    program sleep <<<'/bin/sleep 0.01
        echo >>$folder/seconds
        [ ! -e $folder/slow ] || [ $(($(wc -l <$folder/seconds) % 50)) != 0 ] || echo >>$folder/root/data/update.raucb'
    program df <<<'echo "Filesystem 1K-blocks Used Available Use% Mounted on"
        if [ -e $folder/full ]; then echo "/dev/x 1000 1000 0 100% /data"; else echo "/dev/x 9999 0 9999 0% /data"; fi'
    program rauc <<<'case $1 in
        info) exec /usr/bin/rauc --conf=$folder/root/etc/rauc/system.conf --keyring=$folder/keys/ca.pem "$@" ;;
        esac
        echo "$@" >>$folder/installs
        fw_setenv BOOT_ORDER $(sed -n "s/.*rauc.slot=\([AB]\).*/\1/p" $folder/root/proc/cmdline)
        cp $folder/root/run/wallwarp/update/state $folder/state.began
        ls $folder/root/run/wallwarp/update >$folder/ls.began
        echo " 40% Copying image to root.1"
        /bin/sleep 0.1; grep -q "^progress=40" $folder/root/run/wallwarp/update/state || /bin/sleep 1
        cp $folder/root/run/wallwarp/update/state $folder/state.halfway
        [ ! -e $folder/altered ] || { echo "LastError: Failed updating slot root.1: Input/output error"; exit 1; }
        mkdir -p $folder/root/dev/disk/by-partlabel/root-b/usr/lib/wallwarp
        echo 2.0 >$folder/root/dev/disk/by-partlabel/root-b/usr/lib/wallwarp/version'
    PATH=$folder/bin:$PATH
}

# board SLOT BOOT_STATE...: a board that has started from a slot, with 1.0 in A and in B.
board() {
    echo "console=ttyAMA0 root=PARTLABEL=root-x rauc.slot=$1 quiet" >"$WALLWARP_ROOT/proc/cmdline"
    shift
    rm -rf "${folder:?}"/{boot,installs,systemctl,full,altered,boot.broken} "$request" "$state" "$WALLWARP_ROOT"/run/wallwarp-update
    truncate -s 1M "$folder/boot"
    printf '%s\n' "$@" | fw_setenv -s - >/dev/null 2>&1
    echo 1.0 | tee "$parts"/root-{a,b}/usr/lib/wallwarp/version >"$WALLWARP_ROOT/usr/lib/wallwarp/version"
}

agent() { board/image/update_agent.sh "$@" >"$folder/agent" 2>&1; }
ask() {
    printf '%s\n' "$1" >"$request"
    agent request
}

# says WHAT KEY=PATTERN...: lines of the state.
says() {
    local line
    for line in "${@:2}"; do
        # shellcheck disable=SC2053 # a pattern
        [[ $(grep "^${line%%=*}=" "$state") == $line ]]
        ok $? "$1, $line: $(cat "$state" "$folder/agent")"
    done
}

# boots WHAT NAME=VALUE...: the boot state.
boots() {
    local line value
    for line in "${@:2}"; do
        value=$(fw_printenv -n "${line%%=*}" 2>/dev/null)
        [ "$value" = "${line#*=}" ]
        ok $? "$1, $line: $value"
    done
}

# never WHAT FILE, done WHAT FILE: whether a file of a played program is there.
never() { [ ! -e "$folder/$2" ]; ok $? "$1: no $2"; }
happened() { [ -e "$folder/$2" ]; ok $? "$1: $2"; }

make_root
settled=("BOOT_ORDER=A B" BOOT_A_LEFT=8 BOOT_B_LEFT=1)

board A "${settled[@]}"
echo half >"$WALLWARP_ROOT/data/update.raucb"
agent start
never "start, after a download that was cut short" root/data/update.raucb
says "start" state=idle slot=A trial=0 running=1.0 waiting= other=1.0 message=
boots "start" BOOT_A_LEFT=9 "BOOT_ORDER=A B"
ask "install /new"
says "install" state=ready progress=100 waiting=2.0 other=2.0 running=1.0 message=
boots "install" BOOT_ORDER=A "BOOT_UPDATE=waiting B"
[ ! -e "$request" ]
ok $? "install: the request is gone"
! grep -q request "$folder/ls.began" && grep -q state=installing "$folder/state.began"
ok $? "install: the request is gone when it begins"
grep -q state=installing "$folder/state.halfway" && grep -q progress=40 "$folder/state.halfway" &&
    grep -qx waiting= "$folder/state.halfway" && grep -qx other= "$folder/state.halfway"
ok $? "install: halfway: $(cat "$folder/state.halfway")"
agent start
says "start with a version that waits" state=ready waiting=2.0
rm -f "$folder/installs"
for try in "stranger *signature*" "expired *certificate has expired*" "other *wallwarp-rear*wallwarp-front*" "cut *Signature*exceeds*" \
    "none *No such file*"; do
    ask "install /${try%% *}"
    says "${try%% *} is refused" state=failed "message=refused: ${try#* }" waiting=2.0
    never "${try%% *} is refused" installs
done
ask switch
says "switch" state=switching
boots "switch" "BOOT_ORDER=B A" BOOT_B_LEFT=3 BOOT_A_LEFT=9 "BOOT_UPDATE=trial B"
grep -qx reboot "$folder/systemctl"
ok $? "switch restarts"

board B "BOOT_ORDER=B A" BOOT_A_LEFT=9 BOOT_B_LEFT=2 "BOOT_UPDATE=trial B"
agent start
says "trial" state=idle slot=B trial=1 other=1.0 waiting=
boots "trial" BOOT_B_LEFT=2
ask "install /new"
says "install on trial" state=failed "message=*trial*"
never "install on trial" installs
ask good
says "good" state=idle trial=0
boots "good" "BOOT_ORDER=B A" BOOT_B_LEFT=9 BOOT_UPDATE=
agent expired
never "a trial's end after good" systemctl

board B "BOOT_ORDER=B A" BOOT_A_LEFT=9 BOOT_B_LEFT=2 "BOOT_UPDATE=trial B"
agent expired
boots "a trial's end" BOOT_B_LEFT=0
happened "a trial's end" systemctl

board A "BOOT_ORDER=B A" BOOT_A_LEFT=8 BOOT_B_LEFT=0 "BOOT_UPDATE=trial B"
echo 2.0 >"$parts/root-b/usr/lib/wallwarp/version"
agent start
says "back" state=failed slot=A trial=0 other= waiting= "message=version 2.0 in slot B did not prove itself; back in slot A*1.0"
boots "back" BOOT_ORDER=A BOOT_A_LEFT=9 "BOOT_UPDATE=failed B"
ask switch
says "switch to what has failed" state=failed "message=*install one first"
never "switch to what has failed" systemctl
ask "install /new"
says "install after that" state=ready waiting=2.0

board A "${settled[@]}"
: >"$folder/altered"
ask "install /new"
says "an altered payload" state=failed "message=not installed: Failed updating slot*" other= waiting=
boots "an altered payload" BOOT_ORDER=A BOOT_UPDATE=

board A "${settled[@]}"
ask "install http://host/new"
says "from the network" state=ready waiting=2.0
never "network: what was fetched stays" root/data/update.raucb
ask "install http://host/none"
says "not in the network" state=failed "message=can't fetch http://host/none: *404*"
ask "install http://host/slow"
says "a slow one from the network" state=ready waiting=2.0
ask "install http://host/stalled"
says "a download that stalls" state=failed "message=can't fetch http://host/stalled: no byte has come for 60 s"
! kill -0 "$(cat "$folder/stalled")" 2>/dev/null
ok $? "a download that stalls has ended"
ask "install http://host/big"
says "no room" state=failed "message=the data partition is too full for http://host/big: 0 MiB are free"
[ -z "$(ls "$WALLWARP_ROOT/data")" ]
ok $? "nothing is left on the data partition"

board A "${settled[@]}"
ask "install usb"
says "no stick" state=failed "message=no USB stick has a file wallwarp-front*.raucb at its top"
ln -sfn "$folder/stick" "$WALLWARP_ROOT/dev/disk/by-id/usb-x-part1"
ask "install usb"
says "an empty stick" state=failed "message=no USB stick*"
agent stick "$folder/stick"
says "an empty stick is plugged in" state=failed
cp "$WALLWARP_ROOT/new" "$folder/stick/wallwarp-front-2.0.raucb"
agent stick "$folder/stick"
says "a stick" state=ready waiting=2.0
rm -f "$folder/installs"
agent stick "$folder/stick"
never "the same stick again" installs
says "the same stick again" state=ready waiting=2.0
ask "install usb"
happened "a stick by request" installs
echo 2.0 >"$WALLWARP_ROOT/usr/lib/wallwarp/version"
echo 3.0 >"$parts/root-b/usr/lib/wallwarp/version"
rm -f "$folder/installs"
agent stick "$folder/stick"
never "a stick with what runs" installs

board B "BOOT_ORDER=B A" BOOT_A_LEFT=9 BOOT_B_LEFT=2 "BOOT_UPDATE=trial B"
agent start
rm -f "$folder/installs"
agent stick "$folder/stick"
never "a stick on trial" installs
says "a stick on trial" state=idle

board A "${settled[@]}"
ask $'install http://host/\xc3\xa4\x1b'
says "not a letter" state=failed "message=can't fetch http://host/\?\?\?: *"
board A "BOOT_ORDER=A B" BOOT_A_LEFT=8 BOOT_B_LEFT=0
agent start
says "a slot without a start left" other=
for line in "" install "install  " "switch now" "install ftp://host/x" "install x" "$(head -c 9000 /dev/zero | tr '\0' x)" $'goo\x01d'; do
    rm -f "$state"
    ask "$line"
    says "request '${line:0:20}'" state=failed "message=*"
    never "request '${line:0:20}'" installs
    [ ! -e "$request" ] && [ "$(wc -c <"$state")" -lt 1023 ]
    ok $? "request '${line:0:20}' is gone"
done
echo "install /new" >"$folder/elsewhere"
ln -s "$folder/elsewhere" "$request"
agent request
[ ! -L "$request" ] && [ -e "$folder/elsewhere" ]
ok $? "a request that is a link is gone"
never "a request that is a link" installs
: >"$folder/boot.broken"
ask "install /new"
says "a boot state that can't be written" state=failed "message=the boot state can't be written*"
never "a boot state that can't be written" installs
ok_end
