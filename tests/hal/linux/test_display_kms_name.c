// SPDX-License-Identifier: Apache-2.0
// Names of displays: what they mean, and which are refused.
#include "hal/linux/display_kms_name.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

static void expect(const char *text, int32_t card, const char *connector)
{
    kms_name_t name = {0};
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    if (!kms_name_parse(&name, text, error) || name.card != card || strcmp(name.connector, connector) != 0)
        fail_msg("\"%s\": found card %d, connector \"%s\", error \"%s\"", text, name.card, name.connector, error);
}

static void expect_refused(const char *text)
{
    const kms_name_t untouched = {.card = 77, .connector = "as it was"};
    kms_name_t name = untouched;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    if (kms_name_parse(&name, text, error))
        fail_msg("\"%s\" was taken: card %d, connector \"%s\"", text, name.card, name.connector);
    assert_memory_equal(&name, &untouched, sizeof name);
    assert_non_null(strstr(error, "display: found \""));
    assert_non_null(strstr(error, "expected a connector"));
    assert_null(strchr(error, '\n'));
    assert_true(strlen(error) < HAL_BOARD_ERROR_LENGTH - 1);
}

static void names_are_read(void **state)
{
    (void)state;
    expect("HDMI-A-1", KMS_ANY_CARD, "HDMI-A-1");
    expect("card1:HDMI-A-1", 1, "HDMI-A-1");
    expect("card0:DP-2", 0, "DP-2");
    expect("card15:Virtual-1", 15, "Virtual-1");
    expect("auto", KMS_ANY_CARD, "");
    expect("card2:auto", 2, "");
    expect("1234567890123456789012345678901", KMS_ANY_CARD, "1234567890123456789012345678901");
}

static void wrong_names_are_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "",
        ":",
        "card1:",
        ":HDMI-A-1",
        "card:HDMI-A-1",
        "card16:HDMI-A-1",
        "card-1:HDMI-A-1",
        "card 1:HDMI-A-1",
        "card1x:a",
        "Card1:HDMI-A-1",
        "1:HDMI-A-1",
        "card1:card1:a",
        "/dev/dri/card1",
        "card1/HDMI-A-1",
        "../x",
        "card99999999999999999999:HDMI-A-1",
        "12345678901234567890123456789012",
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        expect_refused(wrong[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_read),
        cmocka_unit_test(wrong_names_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
