#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints the version of what is built from this tree: board/image/version.sh. The firmware's, then the commit when there
# is one, with .changed when the tree is not as committed.
set -eu
version=$(sed -n 's/.*firmware_version\[\] = "wallwarp \(.*\)";/\1/p' firmware/version.h)
commit=$(git describe --always --dirty=.changed --exclude='*' 2>/dev/null) || commit=
echo "$version${commit:+-$commit}"
