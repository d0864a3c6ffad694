// SPDX-License-Identifier: Apache-2.0
// Code of known length between the markers, for test_count_plugin.sh.

        .text
        .globl  _start
_start: mov     x0, #77
        bl      bench_begin
        // 1 + 2 * 1000
        mov     x0, #1000
turn:   subs    x0, x0, #1
        b.ne    turn
        // 1, and 12 + 2 * 5 in the functions
        bl      left_out
        // 3000, over a page's end
        .rept   3000
        nop
        .endr
        // 2, and the markers' call in `last`
        bl      last
        add     x0, x0, #1
        bl      bench_begin
        // 2 of a second stretch
        nop
        bl      bench_end
        mov     x0, #0
        mov     x8, #93
        svc     #0

left_out:
        stp     x29, x30, [sp, #-16]!
        bl      inner
        bl      inner
        ldp     x29, x30, [sp], #16
        b       inner

inner:  mov     x1, #1
again:  subs    x1, x1, #1
        b.ne    again
        nop
        ret

last:   stp     x29, x30, [sp, #-16]!
        bl      bench_end
        ldp     x29, x30, [sp], #16
        ret

bench_begin:
        ret
bench_end:
        ret
unused: ret
