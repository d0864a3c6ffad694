// SPDX-License-Identifier: Apache-2.0
// BUS.md says what is true: the loads that it tells, and the check values of its CRCs.
#include "firmware/can_counts.h"
#include "firmware/can_e2e.h"
#include "firmware/can_frame_clock.h"
#include "firmware/can_latency.h"
#include "firmware/can_protocol.h"
#include "firmware/can_update.h"
#include "tests/firmware/bus_page.h"

enum { POSES_PER_S = 240 };

/* What a row of the table of loads is about. */
typedef struct {
    const char *name;
    double classic_per_s, fd_per_s; /* frames */
} row_t;

/* "| `Status` | 10 | 0.22 to 0.27 % | 0.11 to 0.14 % |": the share of a second, with the least and the most stuffing.
 */
static void assert_row(const row_t *row)
{
    char text[LINE_LENGTH];
    double percent[4];
    for (int i = 0; i < 4; i++) {
        const bool most = i % 2 == 1;
        const double bitrate = i < 2 ? 500000 : 1000000, data_bitrate = i < 2 ? 2000000 : 5000000;
        percent[i] = 100 * (row->classic_per_s * (most ? 135 : 111) / bitrate +
                            row->fd_per_s * ((most ? 31 : 29) / bitrate + (most ? 359 : 294) / data_bitrate));
    }
    snprintf(text, sizeof text, "%s | %.0f | %.2f to %.2f %% | %.2f to %.2f %% |", row->name,
             row->classic_per_s + row->fd_per_s, percent[0], percent[1], percent[2], percent[3]);
    assert_page_has(text);
}

static double per_s(int period_ms)
{
    return 1000.0 / period_ms;
}

static void test_loads_are_the_sums(void **state)
{
    (void)state;
    const double step = per_s(CAN_STEP_PERIOD_MS), status = per_s(CAN_STATUS_PERIOD_MS),
                 stage = per_s(CAN_STAGE_PERIOD_MS), heartbeat = per_s(CAN_HEARTBEAT_PERIOD_MS),
                 seldom = per_s(CAN_QUALITY_PERIOD_MS) + per_s(CAN_TIME_PERIOD_MS) + per_s(CAN_LATENCY_PERIOD_MS) +
                          per_s(CAN_COUNTS_PERIOD_MS) + per_s(CAN_UPDATE_PERIOD_MS),
                 reports = step + status + stage + heartbeat + seldom, sync = 2 * per_s(CAN_SYNC_PERIOD_MS),
                 clock = per_s(CAN_FRAME_CLOCK_PERIOD_MS), room = sync + clock + 8 * reports;
    const row_t rows[] = {
        {"| `Pose`", 0, POSES_PER_S},
        {"| `PoseSetA`, `B`, `C`", 3 * POSES_PER_S, 0},
        {"| `Sync`, `FollowUp`", sync, 0},
        {"twice that while a change is announced", clock, 0},
        {"| `Step`", step, 0},
        {"| `Status`", status, 0},
        {"| `Stage`", stage, 0},
        {"| `Heartbeat`", heartbeat, 0},
        {"| `Quality`, `Time`, `Latency`, `Counts`, `Update`, together", seldom, 0},
        {"| all reports of a board", reports, 0},
        {"| a room of 8 boards, a viewer with `Pose`", room, POSES_PER_S},
        {"| the same with sets", room + 3 * POSES_PER_S, 0},
        {"| with a key: set and `PoseSetCode`", 4 * POSES_PER_S, 0},
        {"| with a key: `Sync`, `FollowUp`, `TimeCode`", 3 * sync / 2, 0},
        {"half as much again while a change is announced", 2 * clock, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_row(&rows[i]);
    char text[LINE_LENGTH];
    snprintf(text, sizeof text, "| with a key: `PoseSigned` | 240 | %.2f to %.2f %% | %.2f to %.2f %% |",
             24000 * (29 / 5e5 + 422 / 2e6), 24000 * (31 / 5e5 + 519 / 2e6), 24000 * (29 / 1e6 + 422 / 5e6),
             24000 * (31 / 1e6 + 519 / 5e6));
    assert_page_has(text);
}

static void test_check_values_of_the_crcs(void **state)
{
    (void)state;
    /* "12" as the data id, or "89". */
    static const uint8_t p01[] = {0, '3', '4', '5', '6', '7', '8', '9'};
    static const uint8_t p05[] = {0, 0, '1', '2', '3', '4', '5', '6', '7'};
    char text[32];
    snprintf(text, sizeof text, "0x%02X |", (unsigned)can_e2e_p01_crc('1' | '2' << 8, p01, sizeof p01));
    assert_page_has(text);
    snprintf(text, sizeof text, "0x%04X |", (unsigned)can_e2e_p05_crc('8' | '9' << 8, p05, sizeof p05));
    assert_page_has(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_loads_are_the_sums),
        cmocka_unit_test(test_check_values_of_the_crcs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
