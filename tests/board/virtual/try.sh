#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Boots a virtual board, runs one command in it, and ends it with the command's exit status.
#
# usage: tests/board/virtual/try.sh [-t SECONDS] COMMAND      COMMAND finds this tree in /tree, read-only, and leaves files
#                                                             in /share, which is build/try/share here
set -u
cd "$(dirname "$0")/../../.." || exit 1
. tests/board/virtual/vm.sh
trap vm_stop EXIT
vm_start build/try || exit 1
vm_run "$@"
