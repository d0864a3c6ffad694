// SPDX-License-Identifier: Apache-2.0
// Tests of a program's link to a bus: a made up socketcand server hears exactly what was to be sent, and is heard.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmocka.h>

#include "sim/pose/pose_link.h"
#include "tests/support/fake_server.h"

static void test_frames_arrive_as_socketcand_text(void **state)
{
    (void)state;
    static fake_server_t server;
    fake_server_start(&server, "< hi >", "< ok >");
    pose_link_t link;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    if (!pose_link_open(&link, server.address, false, error))
        fail_msg("%s", error);
    const hal_can_frame_t frame[3] = {
        {.id = 0x110, .length = 8, .data = {0, 1, 0x10, 0xFF, 0xAB, 6, 7, 8}},
        {.id = 0x7FF, .length = 0},
        {.id = 0x1234, .extended = true, .length = 1, .data = {9}},
    };
    assert_true(pose_link_send(&link, frame, 3, error));
    pose_link_close(&link);
    fake_server_stop(&server);
    assert_string_equal(server.heard, "< open can0 >< rawmode >"
                                      "< send 110 8 0 1 10 ff ab 6 7 8 >< send 7FF 0 >< send 00001234 1 9 >");
}

/* The made up server says frame 123 once and frame 700 a thousand times, and then nothing. */
static void test_frames_are_heard_in_order(void **state)
{
    (void)state;
    static fake_server_t server;
    fake_server_start(&server, "< hi >", "< ok >");
    pose_link_t link;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_true(pose_link_open(&link, server.address, false, error));
    assert_true(pose_link_listen(&link, error));
    hal_can_frame_t frame;
    assert_int_equal(pose_link_receive(&link, &frame, 5000, error), POSE_LINK_FRAME);
    assert_int_equal(frame.id, 0x123);
    assert_int_equal(frame.time_us, 1500000);
    assert_int_equal(frame.length, 2);
    assert_int_equal(frame.data[1], 0x22);
    for (int i = 0; i < 1000; i++) {
        assert_int_equal(pose_link_receive(&link, &frame, 5000, error), POSE_LINK_FRAME);
        assert_int_equal(frame.id, 0x700);
        assert_memory_equal(frame.data, "\x11\x22\x33\x44\x55\x66\x77\x88", 8);
        if (i == 500) /* sending must not throw away what was not taken yet */
            assert_true(pose_link_send(&link, &(hal_can_frame_t){.id = 1}, 1, error));
    }
    assert_int_equal(pose_link_receive(&link, &frame, 0, error), POSE_LINK_QUIET);
    pose_link_close(&link);
    fake_server_stop(&server);
}

static void test_what_is_no_frame_is_passed_over(void **state)
{
    (void)state;
    static const char said[] =
        "< frame 7FF 1.000000 >\n< echo >< frame 800 2.5 0 >garbage< frame 1 x 00 >"
        "< frame 1 1.5 00112233445566778899 >< frame 00000001 3.25 aB >< frame 20000000 1.5 00 >";
    int ends[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    static pose_link_t link;
    link = (pose_link_t){.socket = ends[0], .socketcand = true, .listening = true, .name = "made up"};
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    static const char letters[POSE_LINK_INPUT_BYTES + 100] = "<";
    assert_int_equal(write(ends[1], letters, sizeof letters), sizeof letters);
    assert_int_equal(write(ends[1], "> ", 2), 2);
    assert_int_equal(write(ends[1], said, sizeof said - 1), sizeof said - 1);
    close(ends[1]);
    hal_can_frame_t frame;
    assert_int_equal(pose_link_receive(&link, &frame, 1000, error), POSE_LINK_FRAME);
    assert_int_equal(frame.id, 0x7FF);
    assert_int_equal(frame.length, 0);
    assert_int_equal(pose_link_receive(&link, &frame, 1000, error), POSE_LINK_FRAME);
    assert_true(frame.id == 1 && frame.extended && frame.time_us == 3250000);
    assert_int_equal(frame.data[0], 0xAB);
    assert_int_equal(pose_link_receive(&link, &frame, 1000, error), POSE_LINK_ENDED);
    assert_non_null(strstr(error, "made up"));
    close(ends[0]);
}

static void test_servers_that_answer_wrongly_are_refused(void **state)
{
    (void)state;
    static const char *const TALK[][3] = {
        {"HTTP/1.1 200 >", "", "the answer to \"connect\" was \"HTTP/1.1 200 >\""},
        {"", NULL, "no answer to \"connect\""},
        {"< hi >", "< error no such bus >", "the answer to \"< open can0 >\" was \"< error no such bus >\""},
    };
    for (size_t i = 0; i < sizeof TALK / sizeof TALK[0]; i++) {
        static fake_server_t server;
        fake_server_start(&server, TALK[i][0], TALK[i][1]);
        pose_link_t link = {.socket = 77};
        char error[POSE_LINK_MESSAGE_LENGTH] = "";
        assert_false(pose_link_open(&link, server.address, false, error));
        if (strstr(error, TALK[i][2]) == NULL)
            fail_msg("the reason was \"%s\", expected \"%s\"", error, TALK[i][2]);
        assert_int_equal(link.socket, 77);
        fake_server_stop(&server);
    }
}

static void test_texts_that_can_name_a_bus(void **state)
{
    (void)state;
    static const char *const GOOD[] = {"127.0.0.1:1", "localhost:65535", "[::1]:28600", "can0", "nocan0"};
    static const char *const BAD[] = {"127.0.0.1:65536", "127.0.0.1:99999", "127.0.0.1:0",
                                      "127.0.0.1:",      ":29536",          "127.0.0.1:+80",
                                      "127.0.0.1: 80",   "::1:80",          ""};
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    for (size_t i = 0; i < sizeof GOOD / sizeof GOOD[0]; i++)
        if (!pose_link_check(GOOD[i], error))
            fail_msg("\"%s\" was refused: %s", GOOD[i], error);
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++)
        if (pose_link_check(BAD[i], error))
            fail_msg("\"%s\" was taken", BAD[i]);
}

static void test_bad_names_are_refused_with_advice(void **state)
{
    (void)state;
    static const struct {
        const char *bus;
        bool fd;
        const char *reason;
    } BAD[] = {
        {"127.0.0.1:28600", true, "classic frames only"},
        {":28600", false, "not an address; expected HOST:PORT"},
        {"127.0.0.1:", false, "not an address; expected HOST:PORT"},
        {"127.0.0.1:port", false, "not an address; expected HOST:PORT"},
        {"127.0.0.1:123456", false, "not an address; expected HOST:PORT"},
        {"127.0.0.1:65536", false, "a port from 1 to 65535"},
        {"127.0.0.1:0", false, "a port from 1 to 65535"},
        {"::1:28600", false, "not an address; expected HOST:PORT"},
        {"", false, "not the name of an interface"},
        {"an_interface_with_a_long_name", false, "not the name of an interface"},
        {"nocan0", false, "HOST:PORT"},
        {"nocan0", true, "HOST:PORT"},
    };
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        pose_link_t link = {.socket = 77};
        char error[POSE_LINK_MESSAGE_LENGTH] = "";
        assert_false(pose_link_open(&link, BAD[i].bus, BAD[i].fd, error));
        if (strstr(error, BAD[i].reason) == NULL)
            fail_msg("\"%s\": the reason was \"%s\", expected \"%s\"", BAD[i].bus, error, BAD[i].reason);
        assert_int_equal(link.socket, 77);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames_arrive_as_socketcand_text),
        cmocka_unit_test(test_frames_are_heard_in_order),
        cmocka_unit_test(test_what_is_no_frame_is_passed_over),
        cmocka_unit_test(test_servers_that_answer_wrongly_are_refused),
        cmocka_unit_test(test_texts_that_can_name_a_bus),
        cmocka_unit_test(test_bad_names_are_refused_with_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
