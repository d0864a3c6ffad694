// SPDX-License-Identifier: Apache-2.0
// The look that all pages share, as bytes of the program.
    .section .rodata
    .global html_style, html_style_end
html_style:
    .incbin "sim/files/html_style.css"
html_style_end:
    .section .note.GNU-stack,"",%progbits
