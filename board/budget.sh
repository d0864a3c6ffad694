#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints which method holds 60 Hz on which board: see budget.awk.
#
# usage: budget.sh table | csv | readme | check
# `readme` puts the table into README.md; `check` fails when that one is not of the present baseline.
set -eu
begin='<!-- make budget FORM=readme -->'
end='<!-- end of the budget -->'

print() {
    awk -v form="$1" -f board/budget.awk tests/bench/baseline.csv board/budget.csv
}

# README.md with the present table between the marks.
readme() {
    print table >"$1"
    awk -v begin="$begin" -v end="$end" -v table="$1" '
        $0 == end { inside = 0; ends++ }
        !inside
        $0 == begin {
            inside = 1
            begins++
            while ((getline line <table) > 0)
                print line
        }
        END { exit begins != 1 || ends != 1 }' README.md
}

case ${1-} in
table | csv) print "$1" ;;
readme | check)
    scratch=$(mktemp -d)
    trap 'rm -r "$scratch"' EXIT
    readme "$scratch/table" >"$scratch/README.md" || {
        echo "budget: README.md must have one line \"$begin\" and after it one \"$end\"" >&2
        exit 1
    }
    if cmp -s "$scratch/README.md" README.md; then
        exit 0
    elif [ "$1" = check ]; then
        echo "budget: the table in README.md is not of this baseline; make budget FORM=readme puts the new one in" >&2
        exit 1
    fi
    cat "$scratch/README.md" >README.md
    ;;
*)
    echo 'usage: budget.sh table | csv | readme | check' >&2
    exit 2
    ;;
esac
