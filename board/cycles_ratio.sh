#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints what another CPU's cycles are of the Cortex-A72's, in percent, for the XRGB cases of the last `make bench-arm`:
# both by llvm-mca, with LLVM's models. Where cycles_percent in budget.csv comes from.
#
# usage: cycles_ratio.sh CPU     cortex-a53, say
set -eu
cpu=$1
bench=build/bench
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# a72_cycles.sh asks for one model only; this llvm-mca, found before the real one, takes the other.
mkdir "$scratch/bin"
cat >"$scratch/bin/llvm-mca" <<EOF
#!/bin/sh
exec $(command -v llvm-mca) \$(echo "\$@" | sed s/-mcpu=cortex-a72/-mcpu=$cpu/)
EOF
chmod +x "$scratch/bin/llvm-mca"

for counts in "$bench"/*-xrgb-*.counts; do
    case=${counts#"$bench"/}
    a72=$(tests/bench/a72_cycles.sh "$bench/disassembly" "$counts" "$scratch/a72" | cut -d ' ' -f 2)
    other=$(PATH=$scratch/bin:$PATH tests/bench/a72_cycles.sh "$bench/disassembly" "$counts" "$scratch/other" |
        cut -d ' ' -f 2)
    echo "${case%.counts} $((100 * other / a72))"
done
