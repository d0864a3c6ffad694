#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The watchdog of a virtual board through hal/hal_watchdog.h: fed, closed, held by another program, and left unfed by
# one that hangs and by one that was killed. Each of these two ends a board; the next script that calls vm_use boots anew.
#
# usage: tests/board/virtual/test_watchdog.sh BUILD
set -u
. tests/board/virtual/vm.sh
. tests/support/checks.sh
probe="/run/probe_watchdog /dev/watchdog0"

# A program that waits for its own file while it has the watchdog would be too late.
load() {
    vm_run "cp /tree/$1/tests/board/virtual/probe_watchdog /run/" && vm_in_memory /run/probe_watchdog
}

vm_use && load "$1" || exit 1
said=$(vm_run "$probe 6 close & until grep -qx active /sys/class/watchdog/watchdog0/state; do sleep 0.1; done
    $probe 1 close; wait")
[ "$said" = "period 2 s
watchdog /dev/watchdog0: held by another program (\`fuser /dev/watchdog0\`); if that is systemd, leave \
RuntimeWatchdogSec out of system.conf" ]
ok $? "fed for three periods, and for one program only: found \"$said\""
vm_run 'sleep 4' && ! vm_has_event WATCHDOG
ok $? "closed, it lets the board live"
vm_run "$probe 1 hang" >/dev/null
[ $? = 125 ] && vm_has_event WATCHDOG
ok $? "unfed by a program that hangs, it ends the board"
vm_run true
[ $? = 125 ]
ok $? "a command for a board that is gone"

trap vm_stop EXIT
vm_start "$VM-crash" && load "$1" || exit 1
vm_run "$probe 1 crash; sleep 30" >/dev/null
[ $? = 125 ] && vm_has_event WATCHDOG
ok $? "unfed as its program is gone, it ends the board"
ok_end
