#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What pages, messages and help texts name is there: files and headings that are linked to, targets and variables of make,
# boards, programs, their commands and options. usage: test_pages.sh BUILD
set -u
build=$1
passed=0 failed=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/wallwarp-pages.XXXXXX") || exit 1
trap 'rm -rf "$scratch"' EXIT
mapfile -t pages < <(find . -name build -prune -o -name '*.md' -print | sed 's|^\./||' | sort)
mapfile -t sources < <(find firmware hal sim board -name '*.[ch]' -o -name '*.cpp' -o -name '*.sh' -o -name '*.html' -o -name '*.mk')

# good WHERE WHAT COMMAND ...: the command must succeed.
good() {
    local where=$1 what=$2
    shift 2
    if "$@" >/dev/null 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED  $where: $what"
    fi
}

# The headings of a page, as links name them.
headings() {
    sed -n 's/^##* //p' "$1" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-'
}

links() {
    local page link file
    for page in "${pages[@]}"; do
        while read -r link; do
            file=${link%%#*}
            [ -n "$file" ] && file=$(dirname "$page")/$file || file=$page
            good "$page" "link to $link" test -e "$file"
            [ "$link" = "${link#*#}" ] || good "$page" "heading of $link" grep -qxF -- "${link#*#}" <(headings "$file")
        done < <(grep -o '](\([^)]*\))' "$page" | sed 's/^](//; s/)$//' | grep -v '^http' | sort -u)
    done
}

# All targets that make knows, patterns' among them.
make -pnq BUILD="$build" 2>/dev/null | sed -n 's/^\([a-z][a-z0-9-]*\):.*/\1/p' >"$scratch/targets"

# make_words WHERE WORD ...: what follows "make".
make_words() {
    local where=$1 word
    shift
    for word; do
        case $word in
        BOARD=NAME | BOARD= | -* | ...) ;;
        BOARD=*) good "$where" "make $word" test -e "board/${word#BOARD=}/board.mk" ;;
        [A-Z]*=*) good "$where" "make $word" grep -rqw --include=Makefile --include='*.mk' --include='*.sh' -- "${word%%=*}" Makefile board tests ;;
        [a-z]*) good "$where" "make $word" grep -qxF -- "$word" "$scratch/targets" ;;
        *) break ;;
        esac
    done
}

# help_of PROGRAM [COMMAND]: prints the name of a file with its help; fails when it has none.
help_of() {
    local file="$scratch/$1${2+ $2}"
    [ -e "$file" ] || timeout 60 "$build/$1" ${2+"$2"} --help >"$file" 2>/dev/null || { rm -f "$file" && return 1; }
    echo "$file"
}

has_option() {
    grep -qE -- "^ .*$1([=[ ,]|\$)" "$2"
}

# program_words WHERE PROGRAM WORD ...: what follows a program's name, up to the end of its command.
program_words() {
    local where=$1 program=$2 text word
    shift 2
    if [ "$program" != wallwarp ]; then
        case ${1-} in
        [a-z]*) ;;
        *) return ;;
        esac
        good "$where" "$program $1" help_of "$program" "$1"
        text=$(help_of "$program" "$1") || return
        program="$program $1"
        shift
    else
        text=$(help_of "$program") || return
    fi
    for word; do
        case $word in
        '|' | '||' | '&' | '&&' | ';' | '>'* | wallwarp*) return ;;
        --help | --usage) ;;
        --[a-z]*)
            word=${word%%[^a-z-]*}
            good "$where" "$program $word" has_option "$word" "$text"
            ;;
        esac
    done
}

# An option by itself: any of our programs must have it.
lone_option() {
    local option=$1 text
    for text in "$scratch"/wallwarp*; do
        has_option "$option" "$text" && return
    done
    return 1
}

code() {
    local where line word
    while IFS=$'\t' read -r where line; do
        local -a words
        read -r -a words <<<"$line"
        for ((i = 0; i < ${#words[@]}; i++)); do
            word=${words[i]##*/}
            case $word in
            make) [[ $i != 0 && ${words[i - 1]} != [A-Z]*=* ]] || make_words "$where" "${words[@]:i+1}" ;;
            wallwarp | wallwarp-sim | wallwarp-pose | wallwarp-eval)
                program_words "$where" "$word" "${words[@]:i+1}" ;;
            esac
        done
        [[ $line != --[a-z]* ]] || good "$where" "$line" lone_option "${line%%[^a-z-]*}"
    done
}

links
for program in wallwarp-sim:run wallwarp-sim:update wallwarp-pose:send wallwarp-pose:bridge wallwarp-pose:update \
    wallwarp-pose:command wallwarp-eval:study wallwarp-eval:psnr; do
    good "$program" "its help" help_of "${program%:*}" "${program#*:}"
done
good wallwarp "its help" help_of wallwarp
code < <(awk -f tests/readme/commands.awk "${pages[@]}")
# Messages name commands in the same way.
# shellcheck disable=SC1003,SC2016
code < <(grep -o '`\(make\|wallwarp\)[^`"]*`' "${sources[@]}" Makefile | tr -d '`\\' | sed 's/:/\t/')
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
