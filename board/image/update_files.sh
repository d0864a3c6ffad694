#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Puts the update agent into a board's root, with RAUC's configuration and the certificate that bundles must come from.
#
# usage: board/image/update_files.sh BOARD ROOT CA VERSION      needs in it: rauc rauc-service libubootenv-tool busybox
set -eu
[ $# = 4 ] || { echo "usage: board/image/update_files.sh BOARD ROOT CA VERSION" >&2; exit 2; }
here=$(dirname "$0")
service=$here/../service
root=$2
install -D "$here/update_agent.sh" "$root/usr/local/lib/wallwarp/update_agent"
install -D -m 644 "$3" "$root/etc/rauc/keyring.pem"
install -D -m 644 "$here/fw_env.config" "$root/etc/fw_env.config"
sed "s/@BOARD@/$1/" "$here/system.conf" >"$root/etc/rauc/system.conf"
install -d "$root/usr/lib/wallwarp"
echo "$4" >"$root/usr/lib/wallwarp/version"
install -D -m 644 -t "$root/etc/systemd/system" "$service"/wallwarp-*.path "$service"/wallwarp-*.service "$service"/wallwarp-*.timer
install -D -m 644 "$service/rauc-modules.conf" "$root/etc/systemd/system/rauc.service.d/modules.conf"
install -D -t "$root/etc/systemd/system-generators" "$service/wallwarp-trial-generator"
install -D -m 644 -t "$root/etc/udev/rules.d" "$service/65-wallwarp-stick.rules"
