#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-eval study --quick, once: its files, its figures, and every bad command line.
# Usage, from the tree's root: tests/sim/study/test_study_program.sh BUILD_FOLDER
# shellcheck disable=SC2086 # $study is two words, on purpose
# shellcheck disable=SC2016 # the conditions of awk are not for the shell
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

# holds FILE WHAT AWK: a condition of every row but the first, and there are rows.
holds() {
    awk -F, "NR > 1 { rows++; if (!($3)) { print; bad = 1 } } END { exit bad || !rows }" "$out/$1"
    check "$1: $2" $?
}

# The k that a board computes, against all neighbours one by one.
test_figure_5() {
    holds fig05_k.csv "k is the measured one, to its last printed digit" \
        '$3 - $2 < 0.00015 && $2 - $3 < 0.00015 && $4 >= $3'
}

test_gap() {
    holds gap_claims.csv "what must hold does in every case" '$3 > 0 && $4 == $3 && $5 >= $6'
    for truth in picture original; do
        holds gap_table_$truth.csv "the worst is no better than the mean, and nothing beats the limit" \
            '$2 > 0 && $3 >= $2 && $4 > 0 && $5 >= $4 && $6 > 0 && $7 >= $6'
    done
}

# What a user needs to know, against the curves that it is taken from.
test_late_poses() {
    awk -F, '
        NR == FNR && FNR == 1 { for (c = 2; c <= 7; c++) name[c] = $c }
        NR == FNR && $1 == 10 { for (c = 2; c <= 7; c++) at_10[name[c]] = $c }
        NR == FNR && $1 == 50 { for (c = 2; c <= 7; c++) at_50[name[c]] = $c }
        NR != FNR && FNR > 1 {
            rows++
            px = at_10[$1] * $7 / 10 # of the latency for 1 px, printed to 0.1 ms
            if (at_50[$1] - $2 > 0.006 || $2 - at_50[$1] > 0.006 || $8 > $7) bad = 1
            if ($7 >= 1 && (px < 0.95 || px > 1.05)) bad = 1
        }
        END { exit bad || rows != 6 }' "$out/latency_late.csv" "$out/latency_needs.csv"
    check "the table of what a tracker must deliver is that of the curves" $?
}

test_prediction() {
    holds prediction.csv "prediction is no worse than holding by 10 %, 10 to 60 ms ahead" \
        '$2 < 10 || $2 > 60 || $5 <= 1.1 && $8 <= 1.1'
    holds prediction_40ms.csv "at 40 ms it leaves 30 % of what moves, at most" \
        '$1 == "turning" || $1 == "standing" || $4 <= 0.3'
    holds prediction_40ms.csv "at 40 ms it leaves 30 % of what turns, at most" \
        '$1 != "turning" && $1 != "both" || $7 <= 0.3'
}

test_uneven_light() {
    holds intensity_order.csv "the paper's own pixels keep their order, and no order is kept by more than all" \
        '($1 != "ideal" || $3 == 100 && $4 == 100) && $3 <= 100 && $4 <= 100'
    models=$(awk -F, 'NR > 2 && $3 >= 95 { n++ } END { print n + 0 }' "$out/intensity_order.csv")
    grep -q "It holds with $models of the 5 other models" "$out/index.html"
    check "the claim counts the table's models: $models" $?
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
test_figure_5
test_figures_8_and_9
test_gap
test_late_poses
test_prediction
test_uneven_light
test_bad_command_lines
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
