# SPDX-License-Identifier: Apache-2.0
# Prints what pages show as code, a line each, as "PAGE<tab>CODE": a code span, or a line of a block, put together when it
# goes on after a backslash.
function spans(    part, count, i) {
    count = split(text, part, "`")
    for (i = 2; i <= count; i += 2)
        print page "\t" part[i]
    text = ""
}
FNR == 1 { spans(); page = FILENAME; fenced = 0 }
/^ *```/ { spans(); fenced = !fenced; held = ""; next }
fenced || (/^    / && text == "") {
    held = held $0
    if (!sub(/\\$/, "", held)) {
        print page "\t" held
        held = ""
    }
    next
}
/^$/ { spans(); next }
{ text = text $0 " " }
END { spans() }
