#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The budget of made-up boards, worked out by hand, and that README.md has the table of the present baseline.
set -u

passed=0
failed=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

same() { # WHAT FOUND EXPECTED
    if [ "$2" = "$3" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED: %s\n    found:    %s\n    expected: %s\n' "$1" "$2" "$3"
    fi
}

# The line of a method. 1 cycle per pixel is 2.0736 ms at 1000 MHz; an XRGB frame is copied in 1 ms at 8294.4 MB/s.
line() { # METHOD [FORMAT]
    awk -v form=csv -f board/budget.awk "$folder/baseline.csv" "$folder/boards.csv" | grep "^one,$1,${2-xrgb},"
}

cat >"$folder/boards.csv" <<END
# a comment
board,cpu,cores,clock_mhz,cycles_percent,copy_mb_s
one,Cortex-A72,4,1000,100,8294.4
END
{
    echo case,format,pose,instructions_per_px,a72_cycles_per_px
    for format in gray xrgb; do
        for pose in strong mild; do
            for cycles in grid,0.5 nearest,0.5 linear,1 cubic,2 area,9 mean+cubic,9 mean+spline,4 ls,30 gauss,7 \
                frame:mean+cubic,6; do
                echo "${cycles%,*},$format,$pose,99,${cycles#*,}"
            done
        done
    done
} >"$folder/baseline.csv"

same 'case and grid' "$(line none+nearest)" one,none+nearest,xrgb,yes,1,82,2.07,1.00
same 'a counted frame goes before its case' "$(line mean+cubic)" one,mean+cubic,xrgb,yes,1,19,12.44,1.00
same 'two cores' "$(line area)" one,area,xrgb,yes,2,35,19.70,1.00
same 'filter, and its picture' "$(line gauss+cubic)" one,gauss+cubic,xrgb,yes,2,23,19.70,3.00
same 'coefficients are 17 taps' "$(line mean+spline)" one,mean+spline,xrgb,yes,4,15,44.58,3.00
same 'too slow with all cores' "$(line ls)" one,ls,xrgb,no,4,-49,63.24,9.00
same 'gray is no display format' "$(line area gray)" ''

sed -i 's/^area,xrgb,mild,99,9$/area,xrgb,mild,99,13.5/' "$folder/baseline.csv"
same 'the worse pose' "$(line area)" one,area,xrgb,yes,3,36,29.03,1.00
sed -i 's/,1000,100,8294.4$/,2000,200,4147.2/' "$folder/boards.csv"
same 'clock, cycles, bandwidth' "$(line mean+cubic)" one,mean+cubic,xrgb,yes,1,13,12.44,2.00

table=$(awk -v form=table -f board/budget.awk "$folder/baseline.csv" "$folder/boards.csv")
# shellcheck disable=SC2016 # the backquotes are Markdown's
same 'the table' "$(echo "$table" | grep -e XRGB -e mean+cubic -e ls)" '| XRGB | one |
| `mean+cubic` | 1, 13 % |
| `ls` | no: 30 Hz |'

sed -i '/^ls,/d' "$folder/baseline.csv"
said=$(awk -v form=csv -f board/budget.awk "$folder/baseline.csv" "$folder/boards.csv" 2>&1 >"$folder/out")
same 'a case is missing: status' $? 1
same 'a case is missing: message' "$said" 'budget: the baseline has no line ls,xrgb,strong'

said=$(board/budget.sh check 2>&1)
same 'README.md is up to date' "$said" ''
said=$(board/budget.sh 2>&1)
same 'usage: status' $? 2
same 'usage: message' "$said" 'usage: budget.sh table | csv | readme | check'

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
