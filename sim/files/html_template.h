// SPDX-License-Identifier: Apache-2.0
// Pages made from a template: its text with marks in it, where a program puts its own.
#ifndef SIM_FILES_HTML_TEMPLATE_H
#define SIM_FILES_HTML_TEMPLATE_H

#include <stdio.h>

/** How far a template is written. */
typedef struct {
    FILE *file;
    const char *rest, *end;
} html_template_t;

/** Begin to write the template's bytes [begin, end): up to its mark for the style, with the common style in its place.
 */
html_template_t html_template_begin(FILE *file, const char *begin, const char *end);

/** Write on to the next such mark and pass over it; the mark must be there. What is printed now stands in its place. */
void html_template_until(html_template_t *page, const char *mark);

/** Write the rest. */
void html_template_end(const html_template_t *page);

#endif
