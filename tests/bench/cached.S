// SPDX-License-Identifier: Apache-2.0
// Walks over memory of known cache misses, for test_cache_plugin.sh.

        .text
        .globl  _start
_start: adr     x9, last_line
        bl      bench_begin
        // twice 64 KiB, a word of each line: 1024 lines, which the second cache alone holds
        mov     x1, #2
turn:   adrp    x2, memory
        add     x2, x2, :lo12:memory
        mov     x0, #1024
load:   ldr     w3, [x2], #64
        subs    x0, x0, #1
        b.ne    load
        subs    x1, x1, #1
        b.ne    turn
        // a store to a line that is there, and one over the end of the last, of which the second half is not
        stur    x3, [x2, #-64]
        stur    x3, [x2, #-4]
        bl      bench_end
        ldr     w3, [x9]
        mov     x0, #0
        mov     x8, #93
        svc     #0

bench_begin:
        ret
bench_end:
        ret
last_line:
        .word   0

        .bss
        .balign 4096
memory: .skip   65536 + 64
