// SPDX-License-Identifier: Apache-2.0
// Code whose cycles on a Cortex-A72 are known, for check_a72_cycles.sh: programs that make 10000 turns each.

        .macro  program name
        .globl  \name
\name:  bl      bench_begin
        mov     x9, #10000
        .endm

        .macro  finish
        bl      bench_end
        mov     x0, #0
        mov     x8, #93
        svc     #0
        .endm

        .text
bench_begin:
        ret
bench_end:
        ret

// Each of 4 additions waits for the one before. The loop lies across the end of a page.
        .balign 4096
        .rept   1020
        nop
        .endr
        program chain
1:      add     x0, x0, x1
        add     x0, x0, x1
        add     x0, x0, x1
        add     x0, x0, x1
        subs    x9, x9, #1
        b.ne    1b
        finish

// There is one port for 5 loads.
        program loads
1:      ldr     x0, [sp]
        ldr     x1, [sp]
        ldr     x2, [sp]
        ldr     x3, [sp]
        ldr     x4, [sp]
        subs    x9, x9, #1
        b.ne    1b
        finish

// A chain of 7 goes on behind a condition. What stands under it runs in one turn of 16: 2 additions take one cycle.
        program condition
1:      add     x0, x0, x1
        add     x0, x0, x1
        add     x0, x0, x1
        tst     x9, #15
        b.ne    2f
        add     x2, x2, x1
        add     x3, x3, x1
2:      add     x0, x0, x1
        add     x0, x0, x1
        add     x0, x0, x1
        add     x0, x0, x1
        subs    x9, x9, #1
        b.ne    1b
        finish

// A function that jumps back is no loop, so that its products are no chain: it takes 1 + 1 cycles, the loop with the
// call 2 for its branches.
        program returns
1:      bl      3f
        subs    x9, x9, #1
        b.ne    1b
        finish
2:      mul     x0, x0, x1
        ret
3:      nop
        b       2b
