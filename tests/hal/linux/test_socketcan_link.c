// SPDX-License-Identifier: Apache-2.0
// What the kernel tells of interfaces: read whole, damaged, and from this machine's kernel; and the lines that say how
// to set one up.
#include "hal/linux/socketcan_link.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <errno.h>
#include <libmnl/libmnl.h>
#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if_arp.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/socketcan_netlink.h"

static const can_socketcan_settings_t FD_ROOM = {"can0", 500000, 2000000, true};
static const can_socketcan_settings_t CLASSIC_ROOM = {"can0", 500000, 0, false};

/* A controller as the kernel tells of it. */
typedef struct {
    uint32_t mtu, flags, bitrate, data_bitrate, state, restart_ms, modes;
    const char *kind;
    uint16_t type;
} told_t;

static const told_t GOOD = {CANFD_MTU, IFF_UP,          500000, 2000000,    CAN_STATE_ERROR_ACTIVE,
                            100,       CAN_CTRLMODE_FD, "can",  RTM_NEWLINK};

static struct nlmsghdr *message_of(void *buffer, const told_t *told)
{
    const struct can_bittiming arbitration = {.bitrate = told->bitrate}, data = {.bitrate = told->data_bitrate};
    const struct can_ctrlmode mode = {.flags = told->modes};
    struct nlmsghdr *message = mnl_nlmsg_put_header(buffer);
    message->nlmsg_type = told->type;
    struct ifinfomsg *about = mnl_nlmsg_put_extra_header(message, sizeof *about);
    *about = (struct ifinfomsg){.ifi_type = ARPHRD_CAN, .ifi_index = 7, .ifi_flags = told->flags};
    mnl_attr_put_strz(message, IFLA_IFNAME, "can0");
    mnl_attr_put_u32(message, IFLA_MTU, told->mtu);
    struct nlattr *info = mnl_attr_nest_start(message, IFLA_LINKINFO);
    mnl_attr_put_strz(message, IFLA_INFO_KIND, told->kind);
    struct nlattr *nest = mnl_attr_nest_start(message, IFLA_INFO_DATA);
    mnl_attr_put(message, IFLA_CAN_BITTIMING, sizeof arbitration, &arbitration);
    mnl_attr_put_u32(message, IFLA_CAN_STATE, told->state);
    mnl_attr_put(message, IFLA_CAN_CTRLMODE, sizeof mode, &mode);
    mnl_attr_put_u32(message, IFLA_CAN_RESTART_MS, told->restart_ms);
    mnl_attr_put(message, IFLA_CAN_DATA_BITTIMING, sizeof data, &data);
    mnl_attr_nest_end(message, nest);
    mnl_attr_nest_end(message, info);
    return message;
}

static socketcan_link_t link_of(const told_t *told)
{
    _Alignas(8) char buffer[1024];
    socketcan_link_t link = {.index = 0};
    assert_true(socketcan_link_parse(&link, message_of(buffer, told)));
    return link;
}

static void controllers_are_read(void **state)
{
    (void)state;
    const socketcan_link_t link = link_of(&GOOD);
    assert_string_equal(link.name, "can0");
    assert_int_equal(link.index, 7);
    assert_true(link.can && link.up && link.fd && link.controller && !link.listen_only);
    assert_true(link.any_state && link.state == HAL_CAN_ERROR_ACTIVE);
    assert_int_equal(link.bitrate, 500000);
    assert_int_equal(link.data_bitrate, 2000000);
    assert_int_equal(link.restart_ms, 100);
}

static void states_are_those_of_the_contract(void **state)
{
    (void)state;
    static const struct {
        uint32_t told;
        bool any;
        hal_can_state_t state;
    } cases[] = {
        {CAN_STATE_ERROR_ACTIVE, true, HAL_CAN_ERROR_ACTIVE},   {CAN_STATE_ERROR_WARNING, true, HAL_CAN_ERROR_ACTIVE},
        {CAN_STATE_ERROR_PASSIVE, true, HAL_CAN_ERROR_PASSIVE}, {CAN_STATE_BUS_OFF, true, HAL_CAN_BUS_OFF},
        {CAN_STATE_STOPPED, false, HAL_CAN_ERROR_ACTIVE},       {CAN_STATE_SLEEPING, false, HAL_CAN_ERROR_ACTIVE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        told_t told = GOOD;
        told.state = cases[i].told;
        const socketcan_link_t link = link_of(&told);
        assert_int_equal(link.any_state, cases[i].any);
        assert_int_equal(link.state, cases[i].state);
    }
}

static void other_kinds_have_no_controller(void **state)
{
    (void)state;
    told_t told = GOOD;
    told.kind = "vcan";
    const socketcan_link_t link = link_of(&told);
    assert_true(link.can && link.fd && !link.controller && !link.any_state);
    assert_int_equal(link.bitrate, 0);
}

static void deleted_ones_have_no_index(void **state)
{
    (void)state;
    told_t told = GOOD;
    told.type = RTM_DELLINK;
    const socketcan_link_t link = link_of(&told);
    assert_true(link.index == 0 && strcmp(link.name, "can0") == 0);
}

static void other_messages_are_refused(void **state)
{
    (void)state;
    _Alignas(8) char buffer[1024];
    socketcan_link_t link = {.index = 42};
    struct nlmsghdr *message = message_of(buffer, &GOOD);
    message->nlmsg_type = RTM_NEWADDR;
    assert_false(socketcan_link_parse(&link, message));
    message->nlmsg_type = RTM_NEWLINK;
    message->nlmsg_len = NLMSG_HDRLEN + sizeof(struct ifinfomsg) - 1;
    assert_false(socketcan_link_parse(&link, message));
    assert_int_equal(link.index, 42);
}

/* A copy in memory of its own, cut there, with a byte another; a message fills whole words. */
static void parse_damaged(const void *message, size_t length, size_t at, uint8_t flip)
{
    uint8_t *bytes = calloc(1, (length + 3) / 4 * 4);
    socketcan_link_t link;
    assert_non_null(bytes);
    memcpy(bytes, message, length);
    bytes[at] ^= flip;
    struct nlmsghdr *damaged = (void *)bytes;
    damaged->nlmsg_len = (uint32_t)length;
    if (socketcan_link_parse(&link, damaged))
        assert_true(strlen(link.name) < IFNAMSIZ);
    free(bytes);
}

/* Nothing outside of the message is read: the sanitizers would see it. */
static void damaged_messages_do_no_harm(void **state)
{
    (void)state;
    _Alignas(8) char buffer[1024];
    const size_t whole = message_of(buffer, &GOOD)->nlmsg_len;
    for (size_t length = NLMSG_HDRLEN; length <= whole; length++)
        parse_damaged(buffer, length, 0, 0);
    for (size_t at = NLMSG_HDRLEN; at < whole; at++)
        for (unsigned bit = 0; bit < 8; bit++)
            parse_damaged(buffer, whole, at, (uint8_t)(1U << bit));
}

static const char FD_COMMAND[] =
    "`ip link set can0 down; ip link set can0 up txqueuelen 64 type can bitrate 500000 dbitrate 2000000 fd on "
    "restart-ms 100`";
static const char CLASSIC_COMMAND[] =
    "`ip link set can0 down; ip link set can0 up txqueuelen 64 type can bitrate 500000 restart-ms 100`";

static void assert_taken(const told_t *told, const can_socketcan_settings_t *room, bool may_restart)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    const socketcan_link_t link = link_of(told);
    assert_int_equal(socketcan_link_check(&link, room, may_restart, error), HAL_OK);
    assert_string_equal(error, "");
}

static void assert_refused(const told_t *told, const can_socketcan_settings_t *room, const char *reason)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "", expected[HAL_BOARD_ERROR_LENGTH];
    const socketcan_link_t link = link_of(told);
    assert_int_equal(socketcan_link_check(&link, room, false, error), HAL_IO);
    snprintf(expected, sizeof expected, "can can0: %s: %s", reason, room->fd ? FD_COMMAND : CLASSIC_COMMAND);
    assert_string_equal(error, expected);
}

static void links_as_wanted_are_taken(void **state)
{
    (void)state;
    told_t told = GOOD;
    assert_taken(&told, &FD_ROOM, false);
    assert_taken(&told, &CLASSIC_ROOM, false);
    told.bitrate = 501000;
    told.data_bitrate = 1999000;
    assert_taken(&told, &FD_ROOM, false);
    told.restart_ms = 0;
    assert_taken(&told, &FD_ROOM, true);
    told.bitrate = UINT32_MAX; /* the driver does not know */
    assert_taken(&told, &FD_ROOM, true);
    told.mtu = CAN_MTU;
    assert_taken(&told, &CLASSIC_ROOM, true);
    told = GOOD;
    told.kind = "vcan";
    told.restart_ms = told.bitrate = 0;
    assert_taken(&told, &FD_ROOM, false);
}

/* Who asks for no rates takes the link as it is, but not one that is down. */
static void any_rates_are_taken_by_who_wants_none(void **state)
{
    (void)state;
    static const can_socketcan_settings_t any = {.interface = "can0"};
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    told_t told = GOOD;
    told.bitrate = 125000;
    told.data_bitrate = 8000000;
    assert_taken(&told, &any, false);
    told.flags = 0;
    const socketcan_link_t link = link_of(&told);
    assert_int_equal(socketcan_link_check(&link, &any, false, error), HAL_IO);
    assert_non_null(strstr(error, "type can bitrate 125000 restart-ms 100`"));
    told.bitrate = 0;
    assert_refused(&told, &any, "is down");
}

static void other_links_are_refused_with_the_command(void **state)
{
    (void)state;
    told_t told = GOOD;
    told.flags = 0;
    assert_refused(&told, &FD_ROOM, "is down");
    assert_refused(&told, &CLASSIC_ROOM, "is down");
    told = GOOD;
    told.bitrate = 503000;
    assert_refused(&told, &FD_ROOM, "bitrate 503000, the room has 500000");
    told = GOOD;
    told.data_bitrate = 5000000;
    assert_refused(&told, &FD_ROOM, "dbitrate 5000000, the room has 2000000");
    told = GOOD;
    told.mtu = CAN_MTU;
    assert_refused(&told, &FD_ROOM, "classic frames only, the room has CAN FD");
    told = GOOD;
    told.restart_ms = 0;
    assert_refused(&told, &CLASSIC_ROOM, "no way back from bus-off, expected restart-ms or CAP_NET_ADMIN");
}

static void assert_said(const told_t *told, const can_socketcan_settings_t *room, const char *expected)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    const socketcan_link_t link = link_of(told);
    assert_int_equal(socketcan_link_check(&link, room, false, error), HAL_IO);
    assert_string_equal(error, expected);
}

static void some_links_get_another_command(void **state)
{
    (void)state;
    told_t listener = GOOD, virtual_one = GOOD;
    listener.modes |= CAN_CTRLMODE_LISTENONLY;
    assert_said(&listener, &CLASSIC_ROOM,
                "can can0: listens only: `ip link set can0 down; ip link set can0 up txqueuelen 64 type can bitrate "
                "500000 restart-ms 100 listen-only off`");
    virtual_one.kind = "vcan";
    virtual_one.mtu = CAN_MTU;
    assert_said(&virtual_one, &FD_ROOM,
                "can can0: classic frames only, the room has CAN FD: `ip link set can0 down; ip link set can0 up mtu "
                "72`");
}

/* The longest there is must not be cut. */
static void the_command_is_whole(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    const can_socketcan_settings_t room = {"fifteenletters1", 1000000, 8000000, true};
    socketcan_link_t link = link_of(&GOOD);
    strcpy(link.name, room.interface);
    link.restart_ms = 0;
    link.bitrate = link.data_bitrate = 0;
    assert_int_equal(socketcan_link_check(&link, &room, false, error), HAL_IO);
    assert_non_null(strstr(error, "fifteenletters1 up txqueuelen 64 type can bitrate 1000000 dbitrate 8000000 fd on "
                                  "restart-ms 100`"));
}

static void this_machines_kernel_answers(void **state)
{
    (void)state;
    static socketcan_netlink_t netlink;
    socketcan_link_t link = {.index = 42};
    char error[HAL_BOARD_ERROR_LENGTH];
    assert_int_equal(socketcan_netlink_open(&netlink), 0);
    assert_int_equal(socketcan_netlink_ask(&netlink, "nosuchlink", &link), ENODEV);
    assert_int_equal(link.index, 42);
    assert_int_equal(socketcan_netlink_ask(&netlink, "lo", &link), 0);
    assert_string_equal(link.name, "lo");
    assert_true(link.index > 0 && link.index != 42 && !link.can);
    assert_int_equal(socketcan_link_check(&link, &CLASSIC_ROOM, true, error), HAL_IO);
    assert_string_equal(error, "can lo: is no CAN interface, expected one of `ip link show type can`");
    assert_int_equal(socketcan_netlink_hear(&netlink, "nosuchlink", &link), HAL_EMPTY);
    assert_int_not_equal(socketcan_netlink_restart(&netlink, 0), 0);
    assert_int_equal(socketcan_netlink_ask(&netlink, "lo", &link), 0); /* and still answers */
    socketcan_netlink_close(&netlink);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(controllers_are_read),
        cmocka_unit_test(states_are_those_of_the_contract),
        cmocka_unit_test(other_kinds_have_no_controller),
        cmocka_unit_test(deleted_ones_have_no_index),
        cmocka_unit_test(other_messages_are_refused),
        cmocka_unit_test(damaged_messages_do_no_harm),
        cmocka_unit_test(links_as_wanted_are_taken),
        cmocka_unit_test(any_rates_are_taken_by_who_wants_none),
        cmocka_unit_test(other_links_are_refused_with_the_command),
        cmocka_unit_test(some_links_get_another_command),
        cmocka_unit_test(the_command_is_whole),
        cmocka_unit_test(this_machines_kernel_answers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
