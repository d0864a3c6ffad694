#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs tests on the virtual board: those that call vm_use share one, and what they and the boards say is kept in LOGS.
#
# usage: tests/board/virtual/run.sh LOGS BUILD TEST...      BUILD: the programs of BOARD=qemu-virt. From the tree's root
set -u
logs=$1
build=$2
shift 2
. tests/board/virtual/vm.sh
export VM_SHARED=$logs/shared
trap 'VM=$VM_SHARED; vm_stop' EXIT
tests/run.sh "$logs" "${@/%/ $build}"
