// SPDX-License-Identifier: Apache-2.0
// The page's template and its script, as bytes of the program.
    .section .rodata
    .global page_template, page_template_end, page_script, page_script_end
page_template:
    .incbin "sim/run/page.html"
page_template_end:
    .byte 0
page_script:
    .incbin "sim/run/page.js"
page_script_end:
    .byte 0
    .section .note.GNU-stack,"",%progbits
