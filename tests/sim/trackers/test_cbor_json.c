// SPDX-License-Identifier: Apache-2.0
// Tests of CBOR: the examples of RFC 8949, appendix A, against their JSON, and what is refused.
#include "sim/trackers/cbor_json.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* "a3..." -> bytes. @return How many. */
static size_t from_hex(uint8_t *bytes, const char *hex)
{
    size_t size = 0;
    for (; hex[0] != '\0'; hex += 2) {
        static const char digits[] = "0123456789abcdef";
        bytes[size++] = (uint8_t)((strchr(digits, hex[0]) - digits) << 4 | (strchr(digits, hex[1]) - digits));
    }
    return size;
}

static json_t *read_hex(const char *hex)
{
    uint8_t bytes[256];
    return cbor_json_read(bytes, from_hex(bytes, hex));
}

static void test_the_rfcs_examples(void **state)
{
    (void)state;
    static const struct {
        const char *hex, *json;
    } example[] = {
        {"00", "0"},
        {"17", "23"},
        {"1818", "24"},
        {"1903e8", "1000"},
        {"1a000f4240", "1000000"},
        {"1b000000e8d4a51000", "1000000000000"},
        {"1b7fffffffffffffff", "9223372036854775807"},
        {"20", "-1"},
        {"3863", "-100"},
        {"3903e7", "-1000"},
        {"3a000f423f", "-1000000"},
        {"3b7fffffffffffffff", "-9223372036854775808"},
        {"f93c00", "1.0"},
        {"f93e00", "1.5"},
        {"fa47c35000", "100000.0"},
        {"fbc010666666666666", "-4.1"},
        {"f4", "false"},
        {"f5", "true"},
        {"f6", "null"},
        {"60", "\"\""},
        {"6449455446", "\"IETF\""},
        {"62c3bc", "\"\\u00fc\""},
        {"80", "[]"},
        {"8301820203820405", "[1, [2, 3], [4, 5]]"},
        {"a0", "{}"},
        {"a26161016162820203", "{\"a\": 1, \"b\": [2, 3]}"},
        {"826161a161626163", "[\"a\", {\"b\": \"c\"}]"},
        {"9fff", "[]"},
        {"9f018202039f0405ffff", "[1, [2, 3], [4, 5]]"},
        {"83018202039f0405ff", "[1, [2, 3], [4, 5]]"},
        {"bf61610161629f0203ffff", "{\"a\": 1, \"b\": [2, 3]}"},
        {"c11a514b67b0", "1363896240"},
        {"a16161a0", "{\"a\": {}}"},
    };
    for (size_t i = 0; i < sizeof example / sizeof example[0]; i++) {
        json_t *found = read_hex(example[i].hex);
        json_t *expected = json_loads(example[i].json, JSON_DECODE_ANY, NULL);
        assert_non_null(expected);
        if (found == NULL || !json_equal(found, expected))
            fail_msg("%s is not %s", example[i].hex, example[i].json);
        json_decref(found);
        json_decref(expected);
    }
}

static void test_what_is_no_json_is_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "",
        "0000",               /* two values */
        "18",                 /* cut off */
        "1c",                 /* reserved */
        "1b8000000000000000", /* above 2^63 - 1 */
        "3bffffffffffffffff",
        "f97e00", /* NaN */
        "f97c00", /* infinite */
        "fa7f800000",
        "f7",         /* undefined */
        "f0",         /* unassigned */
        "4401020304", /* bytes */
        "5f42010243030405ff",
        "7f657374726561646d696e67ff", /* a text in pieces */
        "61ff",                       /* no UTF-8 */
        "61",
        "8201",
        "82",
        "9f01",
        "ff",
        "81ff",
        "bf6161ff", /* a key without a value */
        "a10102",   /* a number as a key */
        "a1a0a0",
        "a2616101616102", /* a key twice */
        "c1",
        "9bffffffffffffffff", /* claims to be endlessly long */
        "bbffffffffffffffff",
        "bb7fffffffffffffff",
        "7bffffffffffffffff",
        "5bffffffffffffffff",
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (read_hex(bad[i]) != NULL)
            fail_msg("%s is taken", bad[i]);
}

static void test_depth_is_bounded(void **state)
{
    (void)state;
    uint8_t bytes[CBOR_JSON_MAX_DEPTH + 1];
    memset(bytes, 0x81, sizeof bytes);
    bytes[CBOR_JSON_MAX_DEPTH] = 0x00;
    json_t *deepest = cbor_json_read(bytes, sizeof bytes);
    assert_non_null(deepest);
    json_decref(deepest);
    bytes[CBOR_JSON_MAX_DEPTH] = 0x80;
    assert_null(cbor_json_read(bytes, sizeof bytes));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_rfcs_examples),
        cmocka_unit_test(test_what_is_no_json_is_refused),
        cmocka_unit_test(test_depth_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
