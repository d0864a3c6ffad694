// SPDX-License-Identifier: Apache-2.0
// Pages made from a template: its text with marks in it, where a program puts its own.
#include "sim/files/html_template.h"

#include <assert.h>
#include <string.h>

/* sim/files/html_style.S */
extern const char html_style[], html_style_end[];

static void write_bytes(FILE *file, const char *begin, const char *end)
{
    fwrite(begin, 1, (size_t)(end - begin), file);
}

void html_template_until(html_template_t *page, const char *mark)
{
    const char *found = memmem(page->rest, (size_t)(page->end - page->rest), mark, strlen(mark));
    assert(found != NULL);
    write_bytes(page->file, page->rest, found);
    page->rest = found + strlen(mark);
}

html_template_t html_template_begin(FILE *file, const char *begin, const char *end)
{
    html_template_t page = {file, begin, end};
    html_template_until(&page, "/*STYLE*/\n");
    write_bytes(file, html_style, html_style_end);
    return page;
}

void html_template_end(const html_template_t *page)
{
    write_bytes(page->file, page->rest, page->end);
}
