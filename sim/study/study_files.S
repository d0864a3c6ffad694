// SPDX-License-Identifier: Apache-2.0
// The page's template and the photographs of the study, as bytes of the program.
    .section .rodata
    .global study_template, study_template_end
    .global study_studio, study_studio_end, study_astronaut, study_astronaut_end, study_coffee, study_coffee_end
study_template:
    .incbin "sim/study/study_page.html"
study_template_end:
    .byte 0
study_studio:
    .incbin "tests/images/studio_1920x1080.png"
study_studio_end:
study_astronaut:
    .incbin "tests/images/astronaut_510x290.png"
study_astronaut_end:
study_coffee:
    .incbin "tests/images/coffee_510x290.png"
study_coffee_end:
    .section .note.GNU-stack,"",%progbits
