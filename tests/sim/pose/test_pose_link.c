// SPDX-License-Identifier: Apache-2.0
// Tests of the sender's link: a socketcand server made up in a thread hears exactly what was to be sent.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "firmware/can_protocol.h"
#include "sim/pose/pose_link.h"
#include "sim/pose/pose_send.h"

enum { HEARD_LENGTH = 65536 };

/* Greets, answers two commands, sends some frames of its own, then hears until the client leaves. */
typedef struct {
    const char *greeting, *answer;
    int listening;
    char address[32]; /* 127.0.0.1:PORT */
    char heard[HEARD_LENGTH];
    size_t length;
    pthread_t thread;
} server_t;

/* To the end of a command, or to the end of everything. */
static void hear(server_t *server, int client, bool everything)
{
    char c = '\0';
    while ((everything || c != '>') && server->length < HEARD_LENGTH - 1 && recv(client, &c, 1, 0) == 1)
        server->heard[server->length++] = c;
}

static void say(int client, const char *text)
{
    if (send(client, text, strlen(text), MSG_NOSIGNAL) < 0)
        return; /* the client has left: what it makes of that is the test */
}

static void *serve(void *context)
{
    server_t *server = context;
    const int client = accept(server->listening, NULL, NULL);
    if (client < 0)
        return NULL;
    say(client, server->greeting);
    hear(server, client, false);
    say(client, server->answer);
    hear(server, client, false);
    say(client, "< ok >< frame 123 1.5 1122 >");
    for (int i = 0; i < 1000; i++)
        say(client, "< frame 700 2.5 1122334455667788 >");
    hear(server, client, true);
    close(client);
    return NULL;
}

static void start_server(server_t *server, const char *greeting, const char *answer)
{
    memset(server, 0, sizeof *server);
    server->greeting = greeting;
    server->answer = answer;
    server->listening = socket(AF_INET, SOCK_STREAM, 0);
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof address;
    assert_int_equal(bind(server->listening, (struct sockaddr *)&address, size), 0);
    assert_int_equal(listen(server->listening, 1), 0);
    assert_int_equal(getsockname(server->listening, (struct sockaddr *)&address, &size), 0);
    snprintf(server->address, sizeof server->address, "127.0.0.1:%u", (unsigned)ntohs(address.sin_port));
    assert_int_equal(pthread_create(&server->thread, NULL, serve, server), 0);
}

static void stop_server(server_t *server)
{
    assert_int_equal(pthread_join(server->thread, NULL), 0);
    close(server->listening);
    server->heard[server->length] = '\0';
}

static void test_frames_arrive_as_socketcand_text(void **state)
{
    (void)state;
    static server_t server;
    start_server(&server, "< hi >", "< ok >");
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
    stop_server(&server);
    assert_string_equal(server.heard, "< open can0 >< rawmode >"
                                      "< send 110 8 0 1 10 ff ab 6 7 8 >< send 7FF 0 >< send 00001234 1 9 >");
}

/* The made up server says frame 123 once and frame 700 a thousand times, and then nothing. */
static void test_frames_are_heard_in_order(void **state)
{
    (void)state;
    static server_t server;
    start_server(&server, "< hi >", "< ok >");
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
    stop_server(&server);
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

static const pose_list_entry_t WALK[] = {
    {.time_us = 5000000, .pose = {.eye_nm = {1000000, 0, -2000000}, .quaternion_q30 = {1 << 30, 0, 0, 0}}},
    {.time_us = 5000000, .pose = {.eye_nm = {2000000, 0, -2000000}, .quaternion_q30 = {0, 1 << 30, 0, 0}}},
    {.time_us = 5030000, .pose = {.eye_nm = {3000000, 0, -2000000}, .quaternion_q30 = {0, 0, 0, -(1 << 30)}}},
};
enum { STEPS = sizeof WALK / sizeof WALK[0] };
static const volatile sig_atomic_t going_on = 0;

/* Reads the next "< send ... >" and moves on behind it. */
static hal_can_frame_t next_frame(const char **text)
{
    hal_can_frame_t frame = {0};
    unsigned id = 0;
    unsigned length = 0;
    unsigned byte[8] = {0};
    int used = 0;
    assert_int_equal(sscanf(*text, "< send %x %x %x %x %x %x %x %x %x %x >%n", &id, &length, &byte[0], &byte[1],
                            &byte[2], &byte[3], &byte[4], &byte[5], &byte[6], &byte[7], &used),
                     10);
    frame.id = id;
    frame.length = (uint8_t)length;
    for (int i = 0; i < 8; i++)
        frame.data[i] = (uint8_t)byte[i];
    *text += used;
    return frame;
}

static void test_a_list_arrives_pose_by_pose_with_rising_times(void **state)
{
    (void)state;
    static server_t server;
    start_server(&server, "< hi >", "< ok >");
    pose_list_entry_t entry[STEPS];
    memcpy(entry, WALK, sizeof entry);
    const pose_list_t list = {.entry = entry, .count = STEPS};
    pose_link_t link;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_true(pose_send_check(&(pose_send_t){.list = &list}, error));
    assert_true(pose_link_open(&link, server.address, false, error));
    size_t sent = 0;
    struct timespec before;
    assert_int_equal(clock_gettime(CLOCK_MONOTONIC, &before), 0);
    const uint64_t before_us = (uint64_t)before.tv_sec * 1000000 + (uint64_t)before.tv_nsec / 1000;
    assert_true(pose_send_list(&link, &(pose_send_t){.list = &list, .stop = &going_on}, &sent, error));
    assert_int_equal(sent, STEPS);
    pose_link_close(&link);
    stop_server(&server);

    const char *text = server.heard + strlen("< open can0 >< rawmode >");
    can_pose_t got[STEPS];
    for (int i = 0; i < STEPS; i++) {
        hal_can_frame_t part[CAN_POSE_PARTS];
        for (int k = 0; k < CAN_POSE_PARTS; k++)
            part[k] = next_frame(&text);
        assert_int_equal(can_pose_set_decode(&got[i], part, 0), CAN_CHECK_OK);
        assert_memory_equal(got[i].pose.eye_nm, WALK[i].pose.eye_nm, sizeof WALK[i].pose.eye_nm);
        assert_int_equal(got[i].quality, CAN_POSE_TRACKED);
        assert_int_equal(got[i].counter, (got[0].counter + i) % CAN_E2E_P01_COUNTERS);
    }
    assert_string_equal(text, "");
    /* Never early; how late is the machine's affair. */
    const uint64_t since_us =
        (got[2].capture_time_us + CAN_POSE_SET_WRAP_US - before_us % CAN_POSE_SET_WRAP_US) % CAN_POSE_SET_WRAP_US;
    assert_true(since_us >= 29900);
}

static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

static void test_a_stop_ends_a_list_before_its_end(void **state)
{
    (void)state;
    static server_t server;
    start_server(&server, "< hi >", "< ok >");
    pose_list_entry_t entry[STEPS];
    memcpy(entry, WALK, sizeof entry);
    entry[2].time_us += INT64_C(3600000000);
    const pose_list_t list = {.entry = entry, .count = STEPS};
    pose_link_t link;
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_true(pose_link_open(&link, server.address, false, error));
    signal(SIGALRM, request_stop);
    alarm(1);
    size_t sent = STEPS;
    assert_true(pose_send_list(&link, &(pose_send_t){.list = &list, .stop = &stop_requested}, &sent, error));
    pose_link_close(&link);
    stop_server(&server);
    assert_true(sent < STEPS);
    const char *text = server.heard + strlen("< open can0 >< rawmode >");
    for (size_t i = 0; i < sent * CAN_POSE_PARTS; i++)
        (void)next_frame(&text);
    assert_string_equal(text, "");
}

static void test_poses_that_do_not_fit_are_found_before_sending(void **state)
{
    (void)state;
    pose_list_entry_t entry[STEPS];
    memcpy(entry, WALK, sizeof entry);
    entry[1].pose.eye_nm[2] = INT64_C(90000000000);
    const pose_list_t list = {.entry = entry, .count = STEPS};
    char error[POSE_LINK_MESSAGE_LENGTH] = "";
    assert_false(pose_send_check(&(pose_send_t){.list = &list}, error));
    assert_non_null(strstr(error, "pose 2: farther than 83.886 m"));
    assert_true(pose_send_check(&(pose_send_t){.list = &list, .fd = true}, error));
}

static void test_servers_that_answer_wrongly_are_refused(void **state)
{
    (void)state;
    static const char *const TALK[][3] = {
        {"HTTP/1.1 200 >", "", "the answer to \"connect\" was \"HTTP/1.1 200 >\""},
        {"< hi >", "< error no such bus >", "the answer to \"< open can0 >\" was \"< error no such bus >\""},
    };
    for (size_t i = 0; i < sizeof TALK / sizeof TALK[0]; i++) {
        static server_t server;
        start_server(&server, TALK[i][0], TALK[i][1]);
        pose_link_t link = {.socket = 77};
        char error[POSE_LINK_MESSAGE_LENGTH] = "";
        assert_false(pose_link_open(&link, server.address, false, error));
        if (strstr(error, TALK[i][2]) == NULL)
            fail_msg("the reason was \"%s\", expected \"%s\"", error, TALK[i][2]);
        assert_int_equal(link.socket, 77);
        stop_server(&server);
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
        cmocka_unit_test(test_a_list_arrives_pose_by_pose_with_rising_times),
        cmocka_unit_test(test_a_stop_ends_a_list_before_its_end),
        cmocka_unit_test(test_poses_that_do_not_fit_are_found_before_sending),
        cmocka_unit_test(test_servers_that_answer_wrongly_are_refused),
        cmocka_unit_test(test_texts_that_can_name_a_bus),
        cmocka_unit_test(test_bad_names_are_refused_with_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
