// SPDX-License-Identifier: Apache-2.0
// The page of the study: everything escaped, every element closed, every claim in the list and in its place.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/support/study_bench.h"

static void say_everything(study_t *study)
{
    FILE *csv = study_csv_begin(study, "table.csv", "name<1>,value");
    fputs("a&b,1\n\"c\",2\n", csv);
    study_csv_end(study, csv);
    study_section(study, "First <section>", "seed \"%d\" & size", 7);
    study_text(study, "%d < %d", 3, 4);
    study_figure(study, "a.svg", "a.csv", "One \"figure\"");
    study_figure(study, "b.svg", NULL, "Another");
    study_table(study, "table.csv", "A table");
    study_data(study, "table.csv", "The same & more:");
    study_claim(study, STUDY_PARTLY, "paper, fig 1", "A claim", "because %d", 5);
    study_section(study, "Second", "none");
    study_claim(study, STUDY_FAILS, "wallwarp", "Another claim", "no");
    study_headline(study, "%d > %d", 4, 3);
}

static int count_of(const char *text, const char *word)
{
    int count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
        count++;
    return count;
}

static void page_holds_all_escaped_and_closed(void **state)
{
    study_bench_succeed(*state, say_everything);
    char *page = study_bench_text(*state, "index.html");
    static const char *const expected[] = {
        "<h2>First &lt;section&gt;</h2>",
        "<p class=\"settings\">seed &quot;7&quot; &amp; size</p>",
        ">3 &lt; 4</p>",
        "<img src=\"a.svg\" alt=\"One &quot;figure&quot;\">",
        "<a href=\"a.csv\">a.csv</a>",
        "<tr><th>name&lt;1&gt;</th><th>value</th></tr>",
        "<tr><td>a&amp;b</td><td>1</td></tr>",
        "The same &amp; more: <a href=\"table.csv\">table.csv</a></p>",
        "<div class=\"headlines\">\n<p>4 &gt; 3</p>\n</div>",
        "2 claims: 0 hold, 1 in part, 1 not.",
        "<a class=\"claim\" href=\"#c1\"><span class=\"pill part\">holds in part</span>",
        "id=\"c1\"><span class=\"pill part\">holds in part</span>",
        "<p>because 5</p></div></div>",
        "id=\"c2\"><span class=\"pill bad\">does not hold</span>",
        "<a href=\"#s2\">Second</a>",
    };
    for (size_t n = 0; n < sizeof expected / sizeof *expected; n++) {
        if (strstr(page, expected[n]) == NULL)
            print_error("missing: %s\n", expected[n]);
        assert_non_null(strstr(page, expected[n]));
    }
    static const char *const elements[][2] = {{"<section", "</section>"}, {"<div", "</div>"}, {"<figure ", "</figure>"},
                                              {"<table", "</table>"},     {"<p", "</p>"},     {"<a ", "</a>"}};
    for (size_t n = 0; n < sizeof elements / sizeof *elements; n++)
        assert_int_equal(count_of(page, elements[n][0]), count_of(page, elements[n][1]));
    /* every claim in the list at the top and in its place */
    const char *claims = strstr(page, "<div class=\"claims card\">"), *sections = strstr(page, "id=\"s1\"");
    assert_int_equal(count_of(claims, "<b>A claim</b>"), 2);
    assert_int_equal(count_of(page, "<b>A claim</b>"), 2);
    assert_int_equal(count_of(sections, "<b>A claim</b>"), 1);
    assert_int_equal(count_of(sections, "<b>Another claim</b>"), 1);
    assert_null(strstr(page, "<!--CLAIMS-->"));
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(page_holds_all_escaped_and_closed, scratch_set_up, scratch_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
