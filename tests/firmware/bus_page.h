// SPDX-License-Identifier: Apache-2.0
// BUS.md, for tests of what it says.
#ifndef TESTS_FIRMWARE_BUS_PAGE_H
#define TESTS_FIRMWARE_BUS_PAGE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { LINE_LENGTH = 512 };

static const char page_path[] = "firmware/BUS.md";

static inline FILE *open_page(void)
{
    FILE *page = fopen(page_path, "r");
    if (page == NULL)
        fail_msg("%s is missing", page_path);
    return page;
}

static inline void assert_page_has(const char *text)
{
    char line[LINE_LENGTH];
    FILE *page = open_page();
    bool found = false;
    while (!found && fgets(line, sizeof line, page) != NULL)
        found = strstr(line, text) != NULL;
    fclose(page);
    if (!found)
        fail_msg("\"%s\" is not in %s", text, page_path);
}

#endif
