# SPDX-License-Identifier: Apache-2.0
# Cuts the code that ran into loops and straight blocks for llvm-mca, and says how often each ran.
#
# usage: awk -v loops=FILE -v blocks=FILE -f hot_code.awk DISASSEMBLY COUNTS     COUNTS from count_plugin.c
# Writes the two files with one region per loop and per straight block; prints lines "loop|block REGION WEIGHT", where
# cycles = WEIGHT x cycles of the region; and last "all INSTRUCTIONS PRICED", PRICED of them in the regions.
#
# A loop is the innermost code between a branch back and its target, less what runs in under half of the turns. A
# straight block ends at a branch or before the target of one. Code of which less than 1/10000 of all runs is left out.

# A disassembled line: "  400530:      	mov	w3, w0", or "0000000000400530 <main>:".
FNR == NR {
    if ($1 ~ /^[0-9a-f]+:$/ && NF > 1) {
        n++
        line_at[substr($1, 1, length($1) - 1)] = n
        function_of[n] = name
        operation[n] = $2
        text[n] = $0
        sub(/^ *[0-9a-f]+:[ \t]*/, "", text[n])
    } else if ($2 ~ /^<.*>:$/) {
        name = $2
    }
    next
}

{
    if (!($1 in line_at)) {
        print "hot_code: no code at " $1 > "/dev/stderr"
        exit failed = 1
    }
    first = line_at[$1]
    for (i = first; i < first + $2; i++)
        ran[i] += $3
    all += $2 * $3
}

function is_branch(i) {
    return operation[i] ~ /^(b|b\.[a-z]+|cbn?z|tbn?z|bl|blr|br|ret)$/
}

# The line that a branch names, or 0.
function target_of(i,    address) {
    if (operation[i] !~ /^(b|b\.[a-z]+|cbn?z|tbn?z)$/ || !match(text[i], /0x[0-9a-f]+ </))
        return 0
    address = substr(text[i], RSTART + 2, RLENGTH - 4)
    return address in line_at ? line_at[address] : 0
}

# As llvm-mca takes it: nothing is named outside the region, and a call costs no more than a branch.
function printable(i,    line) {
    line = text[i]
    if (operation[i] == "bl")
        return "b ."
    if (operation[i] == "blr" || operation[i] == "ret")
        return "br x30"
    sub(/0x[0-9a-f]+ <.*>$/, ".", line)
    return line
}

# Give llvm-mca the lines of a loop or block as one region, unless they hardly ran.
function price(kind, begin, end,    i, count, runs, region) {
    for (i = begin; i <= end; i++) {
        if (kind == "block" || 2 * ran[i] >= ran[end]) {
            region = region printable(i) "\n"
            is_done[i] = 1
            count++
            runs += ran[i]
        }
    }
    if (runs < all / 10000)
        return
    print "# LLVM-MCA-BEGIN " begin "\n" region "# LLVM-MCA-END" > (kind == "loop" ? loops : blocks)
    printf "%s %d %.17g\n", kind, begin, runs / count
    priced += runs
}

END {
    if (failed)
        exit 1
    for (i = 1; i <= n; i++) {
        target = ran[i] ? target_of(i) : 0
        if (target) {
            is_target[target] = 1
            if (target <= i && function_of[target] == function_of[i])
                loop_begin[i] = target
        }
    }
    # Of loops within each other the one that ends first is the innermost. A jump back over a return closes no loop.
    for (i = 1; i <= n; i++) {
        if (!(i in loop_begin))
            continue
        inner = 0
        for (j = loop_begin[i]; j < i; j++)
            if (is_done[j] || (operation[j] == "ret" && 2 * ran[j] >= ran[i]))
                inner = 1
        if (inner || 2 * ran[i] < ran[loop_begin[i]])
            continue
        price("loop", loop_begin[i], i)
    }
    for (i = 1; i <= n; i = end + 1) {
        end = i
        if (!ran[i] || is_done[i])
            continue
        while (end < n && !is_branch(end) && ran[end + 1] == ran[i] && !is_target[end + 1] && !is_done[end + 1])
            end++
        price("block", i, end)
    }
    printf "all %.0f %.0f\n", all, priced
}
