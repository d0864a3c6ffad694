// SPDX-License-Identifier: Apache-2.0
// Texts in lines: where they are broken, that nothing is lost, and the longest line.
#include "firmware/text_wrap.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/rng.h"

enum { ROUNDS = 3000, MOST_TEXT = 512 };

/* The lines, with a bar between them. */
static void expect_lines(const char *text, int32_t columns, const char *expected)
{
    char found[MOST_TEXT] = "";
    const char *rest = text;
    int32_t lines = 0;
    for (text_line_t line = text_wrap_next(&rest, columns); line.bytes > 0; line = text_wrap_next(&rest, columns)) {
        const size_t used = strlen(found);
        snprintf(found + used, sizeof found - used, "%s%.*s", lines++ > 0 ? "|" : "", (int)line.bytes, line.begin);
    }
    assert_string_equal(found, expected);
    assert_int_equal(text_wrap_count(text, columns), lines);
}

static void breaks_are_at_spaces(void **state)
{
    (void)state;
    expect_lines("", 5, "");
    expect_lines("   ", 5, "");
    expect_lines("one", 5, "one");
    expect_lines("one two three", 13, "one two three");
    expect_lines("one two three", 12, "one two|three");
    expect_lines("one two three", 7, "one two|three");
    expect_lines("one two three", 6, "one|two|three");
    expect_lines("  one   two", 3, "one|two");
    expect_lines("one two ", 7, "one two");
    expect_lines("one two ", 8, "one two ");
}

static void long_words_are_broken_behind_a_joint(void **state)
{
    (void)state;
    expect_lines("/data/room.yaml:3: node", 12, "/data/room.|yaml:3: node");
    expect_lines("/data/room.yaml:3: node", 8, "/data/|room.|yaml:3:|node");
    expect_lines("a/b/c", 2, "a/|b/|c");
    expect_lines("abcdefgh", 3, "abc|def|gh");
    expect_lines("abc", 1, "a|b|c");
}

static void characters_of_several_bytes_are_one_letter(void **state)
{
    (void)state;
    const char *text = "\xc3\xa4\xc3\xb6\xe2\x82\xac!";
    const text_line_t line = {text, (int32_t)strlen(text)};
    assert_int_equal(text_wrap_letters(&line), 4);
    expect_lines(text, 4, text);
    expect_lines(text, 2, "\xc3\xa4\xc3\xb6|\xe2\x82\xac!");
}

/* Any text: lines are not too long, and together they are the text without some of its spaces. */
static void nothing_is_lost(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < ROUNDS; seed++) {
        rng_t rng = {seed};
        static const char letters[] = "ab/:  .\xc3\xa4";
        char text[40] = "";
        const int32_t columns = (int32_t)rng_int(&rng, 1, 12), length = (int32_t)rng_int(&rng, 0, 39);
        for (int32_t i = 0; i < length; i++)
            text[i] = letters[rng_int(&rng, 0, (int64_t)sizeof letters - 2)];
        const char *rest = text, *seen = text;
        for (text_line_t line = text_wrap_next(&rest, columns); line.bytes > 0; line = text_wrap_next(&rest, columns)) {
            if (text_wrap_letters(&line) > columns || line.begin < seen ||
                strspn(seen, " ") < (size_t)(line.begin - seen) || rest < line.begin + line.bytes)
                fail_msg("seed %d, %d columns: a line of \"%s\" is wrong", (int)seed, columns, text);
            seen = line.begin + line.bytes;
        }
        assert_int_equal(strspn(seen, " "), strlen(seen));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(breaks_are_at_spaces),
        cmocka_unit_test(long_words_are_broken_behind_a_joint),
        cmocka_unit_test(characters_of_several_bytes_are_one_letter),
        cmocka_unit_test(nothing_is_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
