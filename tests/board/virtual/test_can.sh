#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# CAN interfaces of the virtual board through hal/hal_can.h: virtual ones, controllers of CAN 2.0 and of CAN FD.
#
# usage: tests/board/virtual/test_can.sh BUILD
set -u
. tests/board/virtual/vm.sh
. tests/support/checks.sh
programs=/tree/$1/tests/board/virtual

# check PROGRAM ARGUMENT...: runs it on the board; prints what it said if it fails.
check() {
    local said status
    said=$(vm_run "$programs/$*")
    status=$?
    [ $status = 0 ] || echo "$said"
    ok $status "$*"
}

vm_use || exit 1
vm_run 'modprobe vcan && ip link add dev vcan0 type vcan'
ok $? "a virtual interface"
check check_hal_can vcan0 vcan0 classic
check check_hal_can vcan0 vcan0 fd
check check_hal_can can0 can1 classic
check check_hal_can can2 can3 classic
check check_hal_can can2 can3 fd
check check_can vcan0
check check_can_controller can2
vm_run 'ip link del vcan0; for can in can0 can1 can2 can3; do ip link set $can down; done'
ok_end
