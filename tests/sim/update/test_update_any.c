// SPDX-License-Identifier: Apache-2.0
// Whatever is lost or fails: no board switches before all have the bundle, boards that switch do so together, and the
// operator is told the truth.
#include "tests/sim/update/play_bench.h"
#include "tests/support/rng.h"

enum { SEED = 20261123, CASES = 40, SECOND_US = 1000000, MOST_LOST_PPM = 30000 };

/* What a case is made of, for the message. */
static void describe(char text[200], const update_play_settings_t *settings)
{
    int length =
        snprintf(text, 200, "lost %u ppm, ahead %.1f s:", settings->lose_ppm, (double)settings->ahead_us / 1e6);
    for (int i = 0; i < settings->room->board_count; i++)
        length += snprintf(text + length, 200 - (size_t)length, " %s", update_play_failure_name(settings->failure[i]));
}

static void test_any_update(void **state)
{
    (void)state;
    static room_t room;
    rng_t random = {SEED};
    int results[ROOM_UPDATE_MIXED + 1] = {0};
    for (int n = 0; n < CASES; n++) {
        char error[FILE_ERROR_LENGTH] = "", text[200];
        const int boards = (int)rng_int(&random, 1, MOST_BOARDS);
        small_room_load(&room, &(small_room_t){.boards = boards, .nodes_apart = 7});
        update_play_settings_t settings = {.room = &room,
                                           .install_us = rng_int(&random, 1, 4 * SECOND_US),
                                           .reboot_us = rng_int(&random, 1, 5 * SECOND_US),
                                           .ahead_us = rng_int(&random, 5 * SECOND_US, 8 * SECOND_US),
                                           .lose_ppm = n % 2 == 0 ? 0 : (uint32_t)rng_int(&random, 1, MOST_LOST_PPM),
                                           .seed = rng_next(&random)};
        for (int i = 0; i < boards; i++)
            if (rng_int(&random, 0, 5) == 0)
                settings.failure[i] = (update_play_failure_t)rng_int(&random, 1, UPDATE_PLAY_FAILURES - 1);
        describe(text, &settings);
        update_play_t *play = update_play_open(&settings, error);
        assert_string_equal(error, "");
        const char *wrong = play_all(play, boards);
        if (wrong != NULL)
            fail_msg("seed %d, case %d, %s: %s", SEED, n, text, wrong);
        results[update_play_operator(play)->result]++;
        update_play_close(play);
    }
    printf("%d rooms: %d done, %d refused, %d failed, %d cancelled, %d mixed\n", CASES, results[ROOM_UPDATE_DONE],
           results[ROOM_UPDATE_REFUSED], results[ROOM_UPDATE_FAILED], results[ROOM_UPDATE_CANCELLED],
           results[ROOM_UPDATE_MIXED]);
    assert_true(results[ROOM_UPDATE_DONE] >= 8 && results[ROOM_UPDATE_FAILED] >= 2 && results[ROOM_UPDATE_MIXED] >= 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_any_update)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
