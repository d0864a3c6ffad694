#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Lines of the virtual board through hal/hal_gpio.h: driven and seen from their other ends.
#
# usage: tests/board/virtual/test_gpio.sh BUILD
set -u
. tests/board/virtual/vm.sh
. tests/support/checks.sh

vm_use || exit 1
for program in check_hal_gpio check_gpio; do
    said=$(vm_run "/tree/$1/tests/board/virtual/$program")
    status=$?
    [ $status = 0 ] || echo "$said"
    ok $status "$program"
done
ok_end
