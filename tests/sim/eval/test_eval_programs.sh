#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-eval from end to end: the tables of tests/oracle, its output formats, and every bad command line.
# Usage, from the tree's root: tests/sim/eval/test_eval_programs.sh BUILD_FOLDER
# shellcheck disable=SC2086,SC2258 # $front is three words, and an --at ends in a comma, on purpose
set -u
eval_program=${1:?usage: test_eval_programs.sh BUILD_FOLDER}/wallwarp-eval
oracle=tests/oracle
images=tests/images
scratch=$(mktemp -d "${TMPDIR:-/tmp}/wallwarp-eval.XXXXXX") || exit 1
trap 'rm -rf "$scratch"' EXIT
results=$scratch/results
: >"$results"
for table in grid psnr original; do
    tr -d '\r' <$oracle/expected_$table.csv >"$scratch/expected_$table.csv"
done

# check NAME STATUS: note a result; STATUS 0 is good.
check() {
    if [ "$2" -eq 0 ]; then
        echo "pass $1" >>"$results"
    else
        echo "FAIL $1" | tee -a "$results"
    fi
}

# Both tables as lines "room|image|original|pose|factor|method|psnr|k_in|k_all|coverage", only methods of this build.
# (Tables may name methods of later builds.)
expected_rows() {
    awk -F, -v OFS='|' '
        FNR == 1 { original = $3 == "original" ? 1 : 0; next }
        { print $1, $2, original ? $3 : "-", $(3 + original), $(4 + original), $(5 + original), $(6 + original),
                $(7 + original), $(8 + original), $(9 + original) }' \
        "$scratch/expected_psnr.csv" "$scratch/expected_original.csv" |
        awk -F'|' '$6 ~ /^(limit|ls|area|mean\+(cubic|spline)|(none|gauss|kaiser|butter)\+(nearest|linear|cubic|spline))$/'
}

# One call per room, picture and pose; its rows as "room|image|original|pose|factor|method,psnr,limit,k_in,...".
got_rows() {
    awk -F'|' -v OFS='|' '
        { key = $1 OFS $2 OFS $3 OFS $4 OFS $5
          if (!(key in methods)) order[++n] = key
          methods[key] = methods[key] (methods[key] == "" ? "" : ",") $6 }
        END { for (k = 1; k <= n; k++) print order[k], methods[order[k]] }' "$scratch/expected" |
        while IFS='|' read -r room image original pose factor methods; do
            set -- --board front --pose "$pose" --in "$images/$image" --factor "$factor" --method "$methods"
            [ "$original" = - ] || set -- "$@" --original "$images/$original"
            "$eval_program" psnr "$oracle/$room" "$@" </dev/null >"$scratch/csv" || echo "FAIL psnr $room $image" >&2
            sed "1d; s#^#$room|$image|$original|$pose|$factor|#" "$scratch/csv"
        done
}

# A row passes when PSNR is within 0.02 dB; area, judged by the picture's own pixels, at most 0.12 dB below the limit;
# k within 0.02 % of the exhaustive one; coverage right.
test_psnr_tables() {
    expected_rows >"$scratch/expected"
    got_rows >"$scratch/got"
    awk -F'|' '
        function away(a, b) { return a == b ? 0 : a == "inf" || b == "inf" ? 99 : a > b ? a - b : b - a }
        FILENAME == ARGV[1] {
            at = index($6, ",")
            got[$1 $2 $3 $4 $5 "|" substr($6, 1, at - 1)] = substr($6, at + 1)
            next
        }
        { split(got[$1 $2 $3 $4 $5 "|" $6], g, ",")
          gap = g[1] == g[2] ? 0 : g[2] == "inf" ? 99 : g[2] - g[1]
          good = g[1] != "" && away(g[1], $7) <= 0.02 && ($6 != "area" || $3 != "-" || gap <= 0.12) &&
                 away(g[3], $8) <= 0.0002 * $8 && away(g[4], $9) <= 0.0002 * $9 && away(g[5], $10) <= 0.0002
          print (good ? "pass" : "FAIL") " psnr " $0 " got " g[1] ", limit " g[2] ", k " g[3] " " g[4] \
                ", coverage " g[5]
        }' "$scratch/got" "$scratch/expected" >"$scratch/psnr"
    grep FAIL "$scratch/psnr"
    cat "$scratch/psnr" >>"$results"
    [ "$(wc -l <"$scratch/psnr")" -eq 399 ]
    check 'all 399 rows of the tables that this build has methods for' $?
}

# Points within 1/256 px and right about inside; depth within 0.01 mm.
test_grid_table() {
    sed 1d "$scratch/expected_grid.csv" | awk -F, -v OFS='|' '
        { key = $1 OFS $2
          if (!(key in at)) order[++n] = key
          at[key] = at[key] " " $3 "," $4 }
        END { for (k = 1; k <= n; k++) print order[k], at[order[k]] }' |
        while IFS='|' read -r board pose points; do
            set --
            for point in $points; do
                set -- "$@" --at "$point"
            done
            "$eval_program" grid $oracle/room_grid.yaml --board "$board" --pose "$pose" "$@" \
                </dev/null 2>"$scratch/err" || cat "$scratch/err" >&2
        done >"$scratch/grid"
    sed 1d "$scratch/expected_grid.csv" | tr ',' '|' | paste -d'|' - "$scratch/grid" | awk -F'|' '
        function near(a, b, by) { return a - b <= by && b - a <= by }
        { n = split($9, g, " ")
          good = n == 6 && g[1] == $3 && g[2] == $4 && near(g[5], $7, 0.01) && g[6] == $8
          good = good && ($8 == 1 ? near(g[3], $5, 1 / 256) && near(g[4], $6, 1 / 256) : g[3] == "-" && g[4] == "-")
          print (good ? "pass" : "FAIL") " grid " $0 }' >"$scratch/grid_results"
    grep FAIL "$scratch/grid_results"
    cat "$scratch/grid_results" >>"$results"
    [ "$(wc -l <"$scratch/grid_results")" -eq 1151 ]
    check 'all 1151 rows of the grid table' $?
}

# The table of methods: filters times interpolators, then the others, each with a space behind it.
all_methods() {
    for filter in none gauss kaiser butter; do
        printf "$filter+%s " nearest linear cubic spline
    done
    printf '%s ' ls area mean+spline mean+cubic
}

front="$oracle/room_480x270_eq.yaml --board front"
mirror='-1250 0 -2165.063509 0.965925826 0 0.258819045 0'

# prints NAME REGEX_FILE_LINES... : stdout of the last run has exactly these lines (extended regular expressions).
prints() {
    name=$1
    shift
    status=0
    [ "$(wc -l <"$scratch/out")" -eq $# ] || status=1
    line=0
    for expected in "$@"; do
        line=$((line + 1))
        sed -n "${line}p" "$scratch/out" | grep -Eqx -e "$expected" || status=1
    done
    [ $status -eq 0 ] || cat "$scratch/out"
    check "$name" $status
}

test_formats() {
    "$eval_program" grid $front --pose '0 0 -2500 1 0 0 0' --at 0,0 --at 479,269 --at 240,135 >"$scratch/out"
    prints 'grid prints six fields' '0 0 0\.500000 0\.500000 2500\.000 1' \
        '479 269 479\.500000 269\.500000 2500\.000 1' '240 135 240\.500000 135\.500000 2500\.000 1'
    "$eval_program" grid $front --pose '0 0 -2500 0 0 1 0' --at 3,4 >"$scratch/out"
    prints 'grid behind the viewer' '3 4 - - -2500\.000 0'
    "$eval_program" grid $front --pose "$mirror" --at=0,135 >"$scratch/out"
    prints 'a pose may begin with a minus sign' '0 135 - - [0-9]+\.[0-9]{3} 0'
    row=',[0-9]+\.[0-9]{3},[0-9]+\.[0-9]{3},[0-9]\.[0-9]{4},[0-9]\.[0-9]{4},0\.[0-9]{4}'
    "$eval_program" psnr $front --pose "$mirror" --in $images/studio_480x270.png --method all >"$scratch/out"
    sed 1d "$scratch/out" | grep -Evx ".*$row"
    [ $? -eq 1 ] && [ "$(cut -d, -f1 "$scratch/out" | tr '\n' ' ')" = "method limit $(all_methods)" ]
    check 'psnr prints every method' $?
    "$eval_program" psnr $front --pose '0 0 -2500 1 0 0 0' --in $images/studio_480x270.png --factor 1 \
        --method area,limit,area >"$scratch/out"
    prints 'psnr of the same picture is inf' 'method,.*' 'area,inf,inf,1\.0000,1\.0000,1\.0000' \
        'limit,inf,inf,1\.0000,1\.0000,1\.0000' 'area,inf,inf,1\.0000,1\.0000,1\.0000'
    "$eval_program" psnr $front --pose '0 0 -2500 1 0 0 0' --in $images/studio_480x270.png --method all \
        --method mean+cubic >"$scratch/out"
    prints 'the last --method counts' 'method,.*' 'mean\+cubic,.*'
    "$eval_program" psnr $front --pose '0 0 -2500 0 0 1 0' --in $images/studio_480x270.png --method limit \
        >"$scratch/out"
    prints 'psnr of a wall behind the viewer' 'method,.*' 'limit,inf,inf,0\.0000,[0-9]+\.0000,0\.0000'
    for command in '' grid psnr; do
        "$eval_program" $command --help >"$scratch/out" 2>&1 && grep -q '^Usage: wallwarp-eval' "$scratch/out"
        check "$command --help" $?
    done
}

# refuses STATUS TEXT ARGUMENTS...: ends with this status, says TEXT on stderr, prints no results.
refuses() {
    status=$1
    text=$2
    shift 2
    "$eval_program" "$@" >"$scratch/out" 2>"$scratch/err"
    [ $? -eq "$status" ] && [ ! -s "$scratch/out" ] && grep -qF -e "$text" "$scratch/err"
    good=$?
    [ $good -eq 0 ] || cat "$scratch/err"
    check "refuses $*" $good
}

test_bad_command_lines() {
    pose='0 0 -2500 1 0 0 0'
    room=$oracle/room_480x270_eq.yaml
    refuses 2 'a command is missing'
    refuses 2 "'frob' is no command" frob
    refuses 2 'unrecognized option' --frob
    refuses 2 'ROOM is missing' grid --board front --pose "$pose" --at 1,1
    refuses 2 '--board is missing' grid $room --pose "$pose" --at 1,1
    refuses 2 '--pose is missing' grid $front --at 1,1
    refuses 2 '--at is missing' grid $front --pose "$pose"
    refuses 2 'one argument too many' grid $front extra --pose "$pose" --at 1,1
    refuses 2 'requires an argument' grid $front --pose "$pose" --at
    for at in '' 1 1, ,1 1,2,3 '1;2' x,y 1.5,2; do
        refuses 2 'expected "i,j"' grid $front --pose "$pose" --at "$at"
    done
    for at in -1,0 0,-1 480,0 0,270 99999999999999999999,0 4294967296,0; do
        refuses 2 'expected i from 0 to 479, j from 0 to 269' grid $front --pose "$pose" --at 1,1 --at "$at"
    done
    refuses 2 'expected one of front' grid $room --board back --pose "$pose" --at 1,1
    for bad in '' '1 2 3' '0 0 0 0 0 0 0' '0 0 nan 1 0 0 0' '0 0 1e99 1 0 0 0' '0 0 0 1 0 0 0 0' 'a b c d e f g'; do
        refuses 2 '--pose' grid $front --pose "$bad" --at 1,1
    done
    refuses 1 'no_such_room.yaml' grid no_such_room.yaml --board front --pose "$pose" --at 1,1
    refuses 1 'coffee' grid $images/coffee_510x290.png --board front --pose "$pose" --at 1,1

    picture=$images/studio_480x270.png
    refuses 2 '--in is missing' psnr $front --pose "$pose" --method all
    refuses 2 '--method is missing' psnr $front --pose "$pose" --in $picture
    for methods in '' , area, none+frob 'area,all' 'area limit'; do
        refuses 2 'no such method' psnr $front --pose "$pose" --in $picture --method "$methods"
    done
    for factor in '' 0 -4 65 x 4x 2.5 99999999999999999999; do
        refuses 2 'expected a whole number from 1 to 64' psnr $front --pose "$pose" --in $picture --method area \
            --factor "$factor"
    done
    refuses 1 'expected 480 x 270' psnr $front --pose "$pose" --in $images/coffee_510x290.png --method area
    for size in 'width: 481' 'height: 271'; do
        sed "/^camera:/s/${size%% *} [0-9]*/$size/" $room >"$scratch/room.yaml"
        refuses 1 "the room's camera" psnr "$scratch/room.yaml" --board front --pose "$pose" --in $picture \
            --method area
    done
    refuses 1 'no_such.png' psnr $front --pose "$pose" --in no_such.png --method area
    refuses 1 'room_eq.yaml' psnr $front --pose "$pose" --in $oracle/room_eq.yaml --method area
    refuses 1 'no_such.png' psnr $front --pose "$pose" --in $picture --method area --original no_such.png
    refuses 1 "a whole multiple of the picture's 480 x 270" psnr $front --pose "$pose" --in $picture --method area \
        --original $images/coffee_510x290.png
    refuses 1 'expected a multiple of 4' psnr $front --pose "$pose" --in $picture --method area --factor 6 \
        --original $images/studio_1920x1080.png
    if [ -w /dev/full ]; then
        "$eval_program" grid $front --pose "$pose" --at 1,1 2>"$scratch/err" >/dev/full
        [ $? -eq 1 ] && grep -q stdout "$scratch/err"
        check 'full disk is reported' $?
    fi
}

test_grid_table
test_formats
test_bad_command_lines
test_psnr_tables
failed=$(grep -c '^FAIL' "$results")
echo "$(grep -c '^pass' "$results") passed, $failed failed"
[ "$failed" -eq 0 ]
