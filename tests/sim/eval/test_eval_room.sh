#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wallwarp-eval over a whole room: psnr of every wall and of the view, colour channels, advise.
# Usage, from the tree's root: tests/sim/eval/test_eval_room.sh BUILD_FOLDER
set -u
build=${1:?usage: test_eval_room.sh BUILD_FOLDER}
eval_program=$build/wallwarp-eval
# shellcheck source=tests/sim/run/programs.sh
. tests/sim/run/programs.sh
one=tests/oracle/room_480x270_eq.yaml
one_pose='1250 0 -2165.063509 0.965925826 0 -0.258819045 0'
gray=tests/images/studio_480x270.png
demo=sim/demo/room.yaml
corner='0 -1700 600 0.933012702 -0.25 0.25 0.066987298' # sees front, right and floor
colour=sim/demo/studio_960x540.png

# run ARGUMENTS...: results in $scratch/out, errors in $scratch/err.
run() {
    "$eval_program" "$@" >"$scratch/out" 2>"$scratch/err"
}

# refuses STATUS TEXT ARGUMENTS...: ends with this status, says TEXT on stderr, prints no results.
refuses() {
    status=$1
    text=$2
    shift 2
    run "$@"
    [ $? -eq "$status" ] && [ ! -s "$scratch/out" ] && grep -qF -e "$text" "$scratch/err"
    good=$?
    [ $good -eq 0 ] || cat "$scratch/err"
    check "refuses $*" $good
}

test_room_of_one_board() {
    run psnr $one --pose "$one_pose" --in $gray --method limit,area,mean+cubic --board front
    awk 'NR == 1 { print "board," $0; next } { print "front," $0; print "view," $0 }' "$scratch/out" >"$scratch/expected"
    run psnr $one --pose "$one_pose" --in $gray --method limit,area,mean+cubic
    diff "$scratch/expected" "$scratch/out"
    check 'a room of one board: the same digits for board and view' $?
}

# adds_up POSE WALLS: the view's error is the sum of its walls', 255^2 coverage / 10^(dB/10) each; so many are in view.
adds_up() {
    run psnr $demo --pose "$1" --in $colour --method limit,area,none+nearest
    check 'psnr of a room' $?
    awk -F, -v in_view="$2" '
        function square(db, coverage) { return coverage > 0 ? 65025 * coverage / 10 ^ (db / 10) : 0 }
        function near(a, b, by) { return a - b <= by && b - a <= by }
        NR == 1 { good = $0 == "board,method,psnr_db,limit_db,k_in,k_all,coverage"; next }
        $1 == "view" {
            good = good && near($7, coverage, 0.0003) && near(square($3, $7), error, 0.001 * error) &&
                   near(square($4, $7), limit, 0.001 * limit) && near($5, k_in, 0) && near($6, k_all, 0) &&
                   walls == 4 && seen == in_view
            coverage = error = limit = k_in = k_all = walls = seen = 0
            views++
            next
        }
        { coverage += $7; error += square($3, $7); limit += square($4, $7); walls++; seen += $7 > 0.05
          k_in = $5 > k_in ? $5 : k_in; k_all = $6 > k_all ? $6 : k_all }
        END { exit !(good && views == 3) }' "$scratch/out"
    good=$?
    [ $good -eq 0 ] || cat "$scratch/out"
    check "the view of $2 walls is their sum" $good
}

test_view() {
    adds_up '0 -1700 -1500 0.965925826 -0.258819045 0 0' 4
    adds_up "$corner" 3
    grep -Eqx 'left,area,inf,inf,0\.0000,[0-9.]+,0\.0000' "$scratch/out"
    check 'a wall out of view has its row' $?
}

# Gray: every channel is luma. Colour: channels differ, and Y is what it is without --channels.
test_channels() {
    run psnr $one --pose "$one_pose" --in $gray --method area --board front --channels
    [ "$(head -n 1 "$scratch/out")" = channel,method,psnr_db,limit_db,k_in,k_all,coverage ] &&
        [ "$(sed 1d "$scratch/out" | cut -d, -f1 | tr -d '\n')" = YRGB ] &&
        [ "$(sed 1d "$scratch/out" | cut -d, -f2- | uniq | wc -l)" -eq 1 ]
    check 'channels of a gray picture are its luma' $?
    run psnr $demo --pose "$corner" --in $colour --method limit,area
    cp "$scratch/out" "$scratch/luma"
    run psnr $demo --pose "$corner" --in $colour --method limit,area --channels
    awk -F, -v OFS=, '$2 == "Y" || NR == 1 { print $1, $3, $4, $5, $6, $7, $8 }' "$scratch/out" |
        diff - "$scratch/luma" &&
        [ "$(wc -l <"$scratch/out")" -eq 41 ] &&
        [ "$(grep '^view,.,area' "$scratch/out" | cut -d, -f4 | sort -u | wc -l)" -eq 4 ]
    check 'channels of a colour picture' $?
    run psnr $demo --pose "$corner" --in $colour --original tests/images/studio_1920x1080.png --method area --channels
    [ "$(grep -c '^front,[YRGB],area,' "$scratch/out")" -eq 4 ]
    check 'channels against a finer original' $?
}

test_bad_psnr_usage() {
    refuses 2 '--pose is missing' psnr $demo --in $colour --method area
    refuses 2 'ROOM is missing' psnr --pose "$corner" --in $colour --method area
    refuses 2 'expected one of front, left, right, floor' psnr $demo --board '' --pose "$corner" --in $colour --method area
    refuses 2 '--pose' psnr $demo --pose '1 2 3' --in $colour --method area
    refuses 1 'expected 960 x 540' psnr $demo --pose "$corner" --in $gray --method area
    refuses 1 'studio_1920x1080.png: factor 3, expected a multiple of 2' psnr sim/demo/room.yaml --pose "$corner" --factor 3 \
        --in $colour --original tests/images/studio_1920x1080.png --method area
    sed 's/name: left/name: view/' $demo >"$scratch/room.yaml"
    refuses 1 "a board is named 'view'" psnr "$scratch/room.yaml" --pose "$corner" --in $colour --method area
    run psnr "$scratch/room.yaml" --pose "$corner" --in $colour --method area --board view
    check 'a board named view is measured alone' $?
}

# A row per board and method; k, gaps and costs are numbers; the same with the default area and with that area given.
test_advise() {
    # psnr's all has the limit, which is no method, but not auto
    methods=$("$eval_program" psnr $one --board front --pose "$one_pose" --in $gray --method all | sed 1d | wc -l)
    run advise $demo --csv
    check 'advise a room' $?
    awk -F, -v methods="$methods" '
        NR == 1 { good = $0 == "board,method,k_min,k_median,k_max,gap_db,gap_original_db,cost"; next }
        { good = good && NF == 8 && $3 > 0 && $3 <= $4 && $4 <= $5 && $6 >= 0 && $6 < 20 && $7 >= 0 && $7 < 20 && $8 >= 1
          rows[$1]++; gap[$1 $2] = $6; gap_original[$1 $2] = $7 }
        END { for (b = 1; b <= split("front left right floor", board, " "); b++)
                  good = good && rows[board[b]] == methods && gap[board[b] "area"] < 0.12 &&
                         gap_original[board[b] "mean+cubic"] < gap_original[board[b] "none+nearest"]
              exit !good }' "$scratch/out"
    good=$?
    [ $good -eq 0 ] || cat "$scratch/out"
    check 'advise prints CSV' $good
    cp "$scratch/out" "$scratch/default"
    run advise $demo --csv --up -y --height 1700 --area '1900 1900 -1900 -1900'
    cmp "$scratch/default" "$scratch/out"
    check 'the default area of the demo is 0.5 m inside its walls' $?
    run advise $demo --csv --area '0 0 0 0' --height 1350
    grep -Eq '^front,area,(1\.[0-9]{4}),\1,\1,' "$scratch/out"
    check 'one place has one k' $?
    run advise $demo --area '0 0 100 100' --area '500 500 600 600'
    grep -qF 'up is -y; the viewer'"'"'s eye is at y = -1700 mm and walks x 0 to 100, z 0 to 100 mm and x 500 to 600' \
        "$scratch/out" && [ "$(grep -c '^  advice: method: ' "$scratch/out")" -eq 4 ]
    check 'advise prints a table to read' $?
    run advise $demo --area '0 0 0 0' --up z --height 10 && head -n 1 "$scratch/out" | grep -qF 'up is z; '
    check 'up can be given' $?
    run advise $one --area '0 -100 0 -100' --csv && grep -qx 'front,area,-,-,-,-,-,-' "$scratch/out" &&
        grep -q 'board front: 49 of 49 places are nearer than 0.3 m' "$scratch/err" &&
        grep -q 'board front: out of view from everywhere' "$scratch/err"
    check 'a wall that is too near everywhere' $?
}

test_bad_advise_usage() {
    refuses 2 'ROOM is missing' advise
    refuses 2 'one argument too many' advise $demo $demo
    refuses 2 'unrecognized option' advise $demo --board front
    refuses 1 'no_such_room.yaml' advise no_such_room.yaml
    for area in '' '1 2 3' '1 2 3 4 5' '1 2 3 x' '1 2 3 nan' '1 2 3 1e7' '1,2,3,4'; do
        refuses 2 "--area '$area': expected" advise $demo --area "$area"
    done
    for height in '' x '1 2' inf 2e6; do
        refuses 2 "--height '$height': expected mm" advise $demo --height "$height"
    done
    for up in '' w +y yy -; do
        refuses 2 "--up '$up': expected x, y, z, -x, -y or -z" advise $demo --up "$up"
    done
    "$eval_program" advise --help >"$scratch/out" 2>&1 && grep -q '^Usage: wallwarp-eval advise' "$scratch/out"
    check 'advise --help' $?
}

test_room_of_one_board
test_view
test_channels
test_bad_psnr_usage
test_advise
test_bad_advise_usage
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
