// SPDX-License-Identifier: Apache-2.0
// Pictures from the capturing thread to the loop: the newest, some at a time, and what stays when the source goes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/mman.h>

#include "hal/linux/camera_exchange.h"
#include "tests/support/rng.h"

enum { WIDTH = 64, HEIGHT = 64, BYTES = WIDTH * HEIGHT * 3 / 2, LUMA = WIDTH * HEIGHT };

typedef struct {
    camera_exchange_t exchange;
    uint32_t sequence; /* of the source */
} rig_t;

/* Memory as a driver has it: in two maps, one for each plane. */
static void map_all(rig_t *rig)
{
    for (int buffer = 0; buffer < CAMERA_BUFFERS; buffer++) {
        camera_map_t map[PICTURE_MAX_PLANES];
        for (int plane = 0; plane < PICTURE_MAX_PLANES; plane++) {
            map[plane].length = plane == 0 ? LUMA : BYTES - LUMA;
            map[plane].address =
                mmap(NULL, map[plane].length, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
            assert_ptr_not_equal(map[plane].address, MAP_FAILED);
        }
        camera_exchange_map(&rig->exchange, buffer, map);
    }
}

/* All bytes of a picture are those of its number in the source. */
static int put(rig_t *rig, int buffer)
{
    hal_camera_frame_t frame = {
        .picture = {.format = PICTURE_NV12, .width = WIDTH, .height = HEIGHT, .stride = {WIDTH, WIDTH}},
        .capture_time_us = rig->sequence,
        .sequence = rig->sequence,
    };
    for (int plane = 0; plane < PICTURE_MAX_PLANES; plane++) {
        const camera_map_t map = camera_exchange_memory(&rig->exchange, buffer, plane);
        frame.picture.data[plane] = map.address;
        memset(map.address, (int)(rig->sequence & 0xFF), map.length);
    }
    rig->sequence++;
    return camera_exchange_put(&rig->exchange, buffer, &frame);
}

static bool holds_its_number(const hal_camera_frame_t *frame)
{
    bool good = true;
    for (int i = 0; i < LUMA; i++)
        good &= frame->picture.data[0][i] == (uint8_t)frame->capture_time_us;
    for (int i = 0; i < BYTES - LUMA; i++)
        good &= frame->picture.data[1][i] == (uint8_t)frame->capture_time_us;
    return good;
}

static bool all_hold_their_numbers(const hal_camera_frame_t held[HAL_CAMERA_LENT])
{
    bool good = true;
    for (int i = 0; i < HAL_CAMERA_LENT; i++)
        good &= holds_its_number(&held[i]);
    return good;
}

static void set_up(rig_t *rig)
{
    memset(rig, 0, sizeof *rig);
    assert_true(camera_exchange_init(&rig->exchange));
    map_all(rig);
}

static hal_camera_frame_t take(rig_t *rig)
{
    hal_camera_frame_t frame;
    assert_int_equal(camera_exchange_take(&rig->exchange, &frame), HAL_OK);
    assert_true(holds_its_number(&frame));
    return frame;
}

static void the_newest_is_taken_and_older_ones_go_back(void **state)
{
    (void)state;
    rig_t rig;
    set_up(&rig);
    hal_camera_frame_t frame = {.sequence = 77};
    assert_int_equal(camera_exchange_take(&rig.exchange, &frame), HAL_IO); /* not here yet */
    assert_false(camera_exchange_is_here(&rig.exchange));
    assert_int_equal(put(&rig, 0), CAMERA_NO_BUFFER);
    assert_true(camera_exchange_is_here(&rig.exchange));
    assert_int_equal(put(&rig, 1), 0);
    assert_int_equal(put(&rig, 2), 1);
    frame = take(&rig);
    assert_int_equal(frame.capture_time_us, 2);
    const hal_camera_frame_t before = frame;
    assert_int_equal(camera_exchange_take(&rig.exchange, &frame), HAL_EMPTY);
    assert_memory_equal(&frame, &before, sizeof frame);
    assert_int_equal(camera_exchange_collect(&rig.exchange), CAMERA_NO_BUFFER);
    camera_exchange_release(&rig.exchange, &frame);
    assert_int_equal(camera_exchange_collect(&rig.exchange), 2);
    assert_int_equal(camera_exchange_collect(&rig.exchange), CAMERA_NO_BUFFER);
    camera_exchange_end(&rig.exchange);
}

static void as_many_are_lent_as_the_contract_says(void **state)
{
    (void)state;
    rig_t rig;
    set_up(&rig);
    hal_camera_frame_t frame[HAL_CAMERA_LENT], another;
    for (int i = 0; i < HAL_CAMERA_LENT; i++) {
        put(&rig, i);
        frame[i] = take(&rig);
    }
    assert_int_equal(camera_exchange_take(&rig.exchange, &another), HAL_FULL); /* with no newer one */
    for (int buffer = HAL_CAMERA_LENT; buffer < CAMERA_BUFFERS; buffer++)
        put(&rig, buffer);
    assert_int_equal(camera_exchange_take(&rig.exchange, &another), HAL_FULL);
    assert_true(all_hold_their_numbers(frame));
    camera_exchange_release(&rig.exchange, &frame[0]);
    another = take(&rig);
    assert_int_equal(another.capture_time_us, CAMERA_BUFFERS - 1);
    const uint32_t lost = CAMERA_BUFFERS - HAL_CAMERA_LENT - 1;
    assert_int_equal(another.sequence, frame[HAL_CAMERA_LENT - 1].sequence + lost + 1);
    camera_exchange_end(&rig.exchange);
}

static void lent_pictures_stay_when_the_source_goes(void **state)
{
    (void)state;
    rig_t rig;
    set_up(&rig);
    hal_camera_frame_t held[HAL_CAMERA_LENT], none;
    for (int i = 0; i < HAL_CAMERA_LENT; i++) {
        put(&rig, i);
        held[i] = take(&rig);
    }
    put(&rig, HAL_CAMERA_LENT);
    for (int time = 0; time < 3; time++) { /* gone, back with memory of its own, gone again */
        camera_exchange_withdraw(&rig.exchange);
        assert_int_equal(camera_exchange_take(&rig.exchange, &none), HAL_IO);
        assert_int_equal(camera_exchange_memory(&rig.exchange, 0, 0).length, 0);
        assert_true(all_hold_their_numbers(held));
        map_all(&rig);
        rig.sequence = 0;
        put(&rig, 0);
        put(&rig, 1);
        assert_int_equal(camera_exchange_take(&rig.exchange, &none), HAL_FULL);
        assert_true(all_hold_their_numbers(held));
    }
    camera_exchange_release(&rig.exchange, &held[0]);
    const hal_camera_frame_t next = take(&rig);
    assert_int_equal(next.capture_time_us, 1);
    assert_true((int32_t)(next.sequence - held[HAL_CAMERA_LENT - 1].sequence) > 1); /* it goes on, and tells a gap */
    for (int i = 1; i < HAL_CAMERA_LENT; i++)
        camera_exchange_release(&rig.exchange, &held[i]);
    camera_exchange_release(&rig.exchange, &next);
    assert_int_equal(camera_exchange_collect(&rig.exchange), 1);
    assert_int_equal(camera_exchange_collect(&rig.exchange), CAMERA_NO_BUFFER);
    camera_exchange_end(&rig.exchange);
}

/* --- both threads at once --- */

enum { ROUNDS = 20000, WITHDRAWN = 100 };

typedef struct {
    rig_t rig;
    atomic_bool ended;
    atomic_long withdrawn;
} both_t;

static void *capture(void *context)
{
    both_t *both = context;
    rng_t rng = {.state = 1};
    int away[CAMERA_BUFFERS], count = 0;
    for (; count < CAMERA_BUFFERS; count++)
        away[count] = count;
    while (!atomic_load(&both->ended)) {
        for (int buffer = 0; buffer != CAMERA_NO_BUFFER;) {
            buffer = camera_exchange_collect(&both->rig.exchange);
            if (buffer != CAMERA_NO_BUFFER)
                away[count++] = buffer;
        }
        if (rng_int(&rng, 0, 40) == 0) {
            camera_exchange_withdraw(&both->rig.exchange);
            map_all(&both->rig);
            both->rig.sequence = (uint32_t)rng_next(&rng);
            for (count = 0; count < CAMERA_BUFFERS; count++)
                away[count] = count;
            atomic_fetch_add(&both->withdrawn, 1);
        }
        const int older = count == 0 ? CAMERA_NO_BUFFER : put(&both->rig, away[--count]);
        if (older != CAMERA_NO_BUFFER)
            away[count++] = older;
    }
    return NULL;
}

static void pictures_stay_whole_while_both_threads_run(void **state)
{
    (void)state;
    static both_t both;
    const uint64_t seed = 20261123;
    rng_t rng = {.state = seed};
    set_up(&both.rig);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, capture, &both), 0);
    hal_camera_frame_t held[HAL_CAMERA_LENT];
    int count = 0;
    uint32_t last = 0;
    for (int round = 0; round < ROUNDS || atomic_load(&both.withdrawn) < WITHDRAWN || last <= WITHDRAWN; round++) {
        const hal_status_t status =
            camera_exchange_take(&both.rig.exchange, &held[count < HAL_CAMERA_LENT ? count : 0]);
        if (count == HAL_CAMERA_LENT && status != HAL_FULL && status != HAL_IO)
            fail_msg("seed %llu, round %d: status %d with all held", (unsigned long long)seed, round, status);
        if (status == HAL_OK) {
            if ((int32_t)(held[count].sequence - last) <= 0)
                fail_msg("seed %llu, round %d: sequence %u after %u", (unsigned long long)seed, round,
                         held[count].sequence, last);
            last = held[count++].sequence;
        }
        for (int i = 0; i < count; i++)
            if (!holds_its_number(&held[i]))
                fail_msg("seed %llu, round %d: a held picture changed", (unsigned long long)seed, round);
        if (count > 0 && rng_int(&rng, 0, 2) == 0) {
            const int which = (int)rng_int(&rng, 0, count - 1);
            camera_exchange_release(&both.rig.exchange, &held[which]);
            held[which] = held[--count];
        }
    }
    atomic_store(&both.ended, true);
    pthread_join(thread, NULL);
    camera_exchange_end(&both.rig.exchange);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_newest_is_taken_and_older_ones_go_back),
        cmocka_unit_test(as_many_are_lent_as_the_contract_says),
        cmocka_unit_test(lent_pictures_stay_when_the_source_goes),
        cmocka_unit_test(pictures_stay_whole_while_both_threads_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
