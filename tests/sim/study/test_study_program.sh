#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-eval study --quick, once: its files, its figures, and every bad command line.
# Usage, from the tree's root: tests/sim/study/test_study_program.sh BUILD_FOLDER
# shellcheck disable=SC2086 # $study is two words, on purpose
set -u
build=${1:?usage: test_study_program.sh BUILD_FOLDER}
# shellcheck source=tests/sim/run/programs.sh
. tests/sim/run/programs.sh
study="$build/wallwarp-eval study"
out=$scratch/study

# value FILE COLUMN ANGLE: one figure, by the name of its column.
value() {
    awk -F, -v name="$2" -v angle="$3" '
        NR == 1 { for (c = 1; c <= NF; c++) if ($c == name) column = c; next }
        column && $1 == angle { print $column }' "$out/$1"
}

# within VALUE LOW HIGH
within() {
    awk -v v="${1:-none}" -v low="$2" -v high="$3" 'BEGIN { exit !(v != "none" && v + 0 >= low && v + 0 <= high) }'
    check "$1, expected $2 to $3: $4" $?
}

test_quick_study() {
    $study --quick --out "$out" >"$scratch/stdout" 2>"$scratch/stderr" </dev/null
    good=$?
    [ "$good" -eq 0 ] || cat "$scratch/stderr"
    check "the quick study ends with 0" "$good"
    [ "$(cat "$scratch/stdout")" = "$out/index.html" ]
    check "its page is named on stdout" $?
    grep -q "experiments, about .* on this machine" "$scratch/stderr" && grep -q "^\[1/.*left$" "$scratch/stderr"
    check "it says how long it takes, and how far it is" $?
    [ -s "$out/index.html" ] && ! grep -q -- '<!--[A-Z]' "$out/index.html"
    check "the page is whole" $?
    sed 's/"/\n/g' "$out/index.html" | grep -E '^[A-Za-z0-9_]+\.(svg|csv|png)$' | sort -u >"$scratch/shown"
    while read -r name; do
        [ -s "$out/$name" ]
        check "the page's $name is there" $?
    done <"$scratch/shown"
    (cd "$out" && find . -type f ! -name index.html) | sed 's,^./,,' | sort >"$scratch/found"
    cmp -s "$scratch/shown" "$scratch/found"
    check "no file is there that the page does not show" $?
    for name in fig05.csv fig05_x.svg fig08.csv fig08.svg fig09.csv fig09.svg; do
        grep -qx "$name" "$scratch/shown"
        check "the page shows $name" $?
    done
}

# What figures 8 and 9 must show without noise.
test_figures_8_and_9() {
    for angle in -60 -45 -30 -15 0 15 30 45 60; do
        for how in geometry seen; do
            within "$(value fig08.csv compensated_$how $angle)" 0 0.05 "deviation, $how, $angle degrees"
            within "$(value fig09.csv compensated_$how $angle)" 0.998 1 "rectangularity, $how, $angle degrees"
        done
    done
    for angle in -60 60; do
        for how in geometry seen; do
            within "$(value fig08.csv uncompensated_$how $angle)" 12.25 12.36 "uncompensated deviation, $how"
            within "$(value fig09.csv uncompensated_$how $angle)" 0.837 0.839 "uncompensated rectangularity, $how"
        done
    done
    within "$(value fig08.csv 5mm_0.5deg_seen_worst 60)" 0.05 2 "noise is seen, and stays small"
}

test_bad_command_lines() {
    refuses 2 "--out is missing" $study
    refuses 2 "no such experiment, expected one of fig 5," $study --out "$scratch/x" --only "fig 4"
    refuses 2 "unrecognized option" $study --out "$scratch/x" --slow
    refuses 2 "Too many arguments" $study --out "$scratch/x" more
    touch "$scratch/file"
    refuses 1 "is not a folder" $study --out "$scratch/file"
    refuses 1 "can't make this folder" $study --out "$scratch/file/below"
    $study --help | grep -q -- "--quick"
    check "--help names --quick" $?
    [ ! -e "$scratch/x" ]
    check "a bad command line makes no folder" $?
}

test_quick_study
test_figures_8_and_9
test_bad_command_lines
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
