#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Boots the virtual board, runs one command in it and ends it: tests/board/virtual/try.sh [-t SECONDS] COMMAND
# /tree in it is this tree, read-only; what the command writes into /share is left in build/try/share.
set -u
cd "$(dirname "$0")/../../.." || exit 1
. tests/board/virtual/vm.sh
trap vm_stop EXIT
vm_start build/try || exit 1
vm_run "$@"
