# SPDX-License-Identifier: Apache-2.0
# Which method holds 60 Hz at 1920 x 1080 on which board.
#
# usage: awk -v form=csv|table -f budget.awk BASELINE BOARDS     a CSV of bench_arm.sh; budget.csv
#
# Of a frame, picture and panel both 1920 x 1080, in the worse of the two counted poses:
#   cpu_ms     cycles per pixel (baseline.csv, times cycles_percent) over the clock: of one core
#   memory_ms  bytes that it reads and writes over twice the copy bandwidth: of one core too, so rather too much for more
#   time       cpu_ms / cores + memory_ms: as if no core could work while it waits for memory
# A number of cores holds 60 Hz when the time is at most 90 % of 1/60 s, where the firmware would step down (degrade.h).
# Headroom is what is left of 1/60 s. Cores beyond the first assume that the frame is drawn in bands.

BEGIN {
    FS = ","
    PIXELS = 1920 * 1080
    PERIOD_MS = 1000 / 60
    LIMIT_MS = 0.9 * PERIOD_MS
    split("none+nearest none+linear none+cubic gauss+cubic area mean+cubic mean+spline ls", METHODS, " ")
    METHOD_COUNT = 8
    split("strong mild", POSES, " ")
    BYTES["xrgb"] = 4 # per pixel; other formats of the baseline are no panel's
    BYTES["nv12"] = 1.5
    SPLINE_TAPS = 17 # coefficients are a filter of so many; gauss is counted with 7
    # Bytes of intermediate pictures, written and read, per byte of the picture.
    BETWEEN["gauss+cubic"] = BETWEEN["mean+spline"] = 4 # one of 16 bits
    BETWEEN["ls"] = 16                                  # two of 32 bits
}

/^#/ || /^(case|board),/ || NF == 0 { next }
FNR == NR {
    cycles[$1 "," $2 "," $3] = $5
    if ($2 in BYTES && !($2 in seen)) {
        seen[$2] = 1
        FORMATS[++format_count] = $2
    }
    next
}
{
    boards++
    name[boards] = $1; cores[boards] = $3; clock_mhz[boards] = $4; percent[boards] = $5; copy_mb_s[boards] = $6
}

function counted(what, format, pose) {
    if ((what "," format "," pose) in cycles)
        return cycles[what "," format "," pose]
    print "budget: the baseline has no line " what "," format "," pose >"/dev/stderr"
    exit failed = 1
}

function frame_cycles(method, format, pose,    plain) {
    if (("frame:" method "," format "," pose) in cycles)
        return counted("frame:" method, format, pose)
    plain = method
    sub(/^(none|gauss)\+/, "", plain)
    return counted("grid", format, pose) + counted(plain, format, pose) + \
        (method ~ /^gauss/ ? counted("gauss", format, pose) : 0) + \
        (method ~ /spline/ ? SPLINE_TAPS / 7 * counted("gauss", format, pose) : 0)
}

function judge(b, method, format,    worst, p, c) {
    worst = 0
    for (p = 1; p <= 2; p++)
        if (frame_cycles(method, format, POSES[p]) > worst)
            worst = frame_cycles(method, format, POSES[p])
    cpu_ms = worst * percent[b] / 100 * PIXELS / (clock_mhz[b] * 1000)
    memory_ms = PIXELS * BYTES[format] * (2 + BETWEEN[method]) / 2 / (copy_mb_s[b] * 1000)
    for (c = 1; c < cores[b] && cpu_ms / c + memory_ms > LIMIT_MS; c++)
        ;
    needed = c
    time_ms = cpu_ms / c + memory_ms
    headroom = 100 * (1 - time_ms / PERIOD_MS)
    return time_ms <= LIMIT_MS
}

function print_csv(    b, m, f, held) {
    print "board,method,format,holds_60_hz,cores,headroom_percent,cpu_ms,memory_ms"
    for (b = 1; b <= boards; b++)
        for (m = 1; m <= METHOD_COUNT; m++)
            for (f = 1; f <= format_count; f++) {
                held = judge(b, METHODS[m], FORMATS[f])
                printf "%s,%s,%s,%s,%d,%.0f,%.2f,%.2f\n", name[b], METHODS[m], FORMATS[f], held ? "yes" : "no", needed,
                    headroom, cpu_ms, memory_ms
            }
}

function print_table(    b, m, f, line, cell) {
    for (f = 1; f <= format_count; f++) {
        line = "| " toupper(FORMATS[f]) " |"
        for (b = 1; b <= boards; b++)
            line = line sprintf(" %s |", name[b])
        print line
        gsub(/[^|]+/, "---", line)
        print line
        for (m = 1; m <= METHOD_COUNT; m++) {
            line = "| `" METHODS[m] "` |"
            for (b = 1; b <= boards; b++) {
                cell = judge(b, METHODS[m], FORMATS[f]) ? sprintf("%d, %.0f %%", needed, headroom) : \
                    sprintf("no: %.0f Hz", 1000 / time_ms)
                line = line " " cell " |"
            }
            print line
        }
        if (f < format_count)
            print ""
    }
}

END {
    if (failed)
        exit 1
    if (form == "csv")
        print_csv()
    else
        print_table()
}
