#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The kernel modules of the Raspberry Pi 4's image against its device tree: each device's driver is there, and in the first
# file system also those of what its devices are supplied by. Needs build/image, but nothing of non-free-firmware.
# Usage, from the tree's root: tests/board/image/test_pi_modules.sh
set -u
. tests/support/checks.sh
kernel=build/image/kernel
version=$(basename $kernel/lib/modules/*)
tree=$(mktemp)
trap 'rm -f "$tree"' EXIT

# What a projector does without: Bluetooth, USB-C, the chip's own camera and sound services, the board's own LEDs.
without='hci_uart dwc2 phy_generic vchiq pwm_bcm2835 leds_gpio'

# modules_of NAME...: the modules that these need and are.
modules_of() {
    printf '%s\n' "$@" | while read -r name _; do
        modprobe -d $kernel -S "$version" --show-depends "$name"
    done | sed -n 's|^insmod .*/\([^/]*\)\.ko.*|\1|p' | tr - _ | sort -u
}

# driver_of NODE COMPATIBLE...: the module that drives it; nothing when the kernel does by itself, or nobody.
driver_of() {
    local node=$1 compatible
    shift
    for compatible in "$@"; do
        modprobe -d $kernel -S "$version" --show-depends "of:N${node}T(null)C$compatible" 2>/dev/null |
            sed -n '$s|^insmod .*/\([^/]*\)\.ko.*|\1|p' | tr - _
    done | head -n 1
}

# Of each enabled node: its own handle, or 0; those of its suppliers, by commas, or 0; its name; what it is compatible with.
devices() {
    dtc -q -I dtb -O dts "$1" | awk '
        /{$/ {
            name[++depth] = $1
            sub(/@.*/, "", name[depth])
            compatible[depth] = ""
            suppliers[depth] = handle[depth] = "0"
            off[depth] = off[depth - 1]
        }
        $1 == "status" && /disabled/ {off[depth] = 1}
        $1 == "phandle" {handle[depth] = first($3)}
        $1 == "compatible" {gsub(/.*= "|";$/, ""); gsub(/", "|\\0/, " "); compatible[depth] = $0}
        $1 ~ /-supply$|-gpios?$|^gpios$|^(clocks|resets|power-domains|dmas|ddc|mmc-pwrseq)$/ && $3 ~ /^</ {
            suppliers[depth] = suppliers[depth] "," first($3)
        }
        /};$/ {
            if (!off[depth] && compatible[depth] != "")
                print handle[depth], suppliers[depth], name[depth], compatible[depth]
            off[depth--] = 0
        }
        function first(cell) {
            gsub(/[<>;]/, "", cell)
            return cell
        }'
}

board/image/device_tree_rpi4.sh build/image "$tree" || exit 1
mapfile -t late < <(grep -hv '^#' board/image/modules board/rpi4/modules)
mapfile -t early < <(grep -v '^#' board/rpi4/modules_early)
all=" $(modules_of "${late[@]}" "${early[@]}" | tr '\n' ' ')"
first=" $(modules_of "${early[@]}" | tr '\n' ' ')"
declare -A driver supplied
while read -r handle suppliers name compatible; do
    # shellcheck disable=SC2086 # a word each
    module=$(driver_of "$name" $compatible)
    [ -n "$module" ] || continue
    driver[$handle]=$module
    supplied[$module]+=,$suppliers
    [[ "$all $without " == *" $module "* ]]
    ok $? "$name ($compatible): its driver, $module, is not in the image"
done < <(devices "$tree")
[[ ${#driver[@]} -gt 5 && -n ${supplied[sdhci_iproc]-} && -n ${supplied[mcp251xfd]-} ]]
ok $? "the device tree was not read: ${driver[*]}"
for module in $first; do
    for handle in $(tr , '\n' <<<"${supplied[$module]-}" | sort -u); do
        [[ -n $handle && $handle != 0 && -n ${driver[$handle]-} ]] || continue
        [[ "$first" == *" ${driver[$handle]} "* ]]
        ok $? "$module is in the first file system and waits for ${driver[$handle]}, which is not"
    done
done
ok_end
