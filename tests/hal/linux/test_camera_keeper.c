// SPDX-License-Identifier: Apache-2.0
// The thread that holds a camera open, with a source of its own: first attempt, loss and return, what is said, end.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <poll.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "hal/linux/camera_clock.h"
#include "hal/linux/camera_keeper.h"
#include "tests/support/scratch.h"

enum { SIDE = 64, BYTES = SIDE * SIDE * 4, PATIENCE_US = 20000000 };

/* What the source does; the test's and the keeper's threads both look. One camera at a time. */
static struct {
    atomic_bool absent, lost, silent; /* can't be opened; fails when served; gives no pictures */
    atomic_int opened, closed, destroyed;
} will;

typedef struct {
    camera_wanted_t wanted;
    int next; /* buffer, or none */
    uint32_t sequence;
} source_t;

static void *create(const camera_wanted_t *wanted)
{
    source_t *source = calloc(1, sizeof *source);
    assert_non_null(source);
    source->wanted = *wanted;
    return source;
}

static bool open_source(void *context, char error[HAL_BOARD_ERROR_LENGTH])
{
    source_t *source = context;
    if (atomic_load(&will.absent))
        return camera_fail(error, "is not here");
    for (int buffer = 0; buffer < CAMERA_BUFFERS; buffer++) {
        const camera_map_t map[PICTURE_MAX_PLANES] = {
            {mmap(NULL, BYTES, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0), BYTES}};
        camera_exchange_map(source->wanted.exchange, buffer, map);
    }
    source->next = 0;
    atomic_fetch_add(&will.opened, 1);
    return true;
}

static bool serve(void *context, char news[HAL_BOARD_ERROR_LENGTH])
{
    source_t *source = context;
    struct pollfd woken = {.fd = source->wanted.wake, .events = POLLIN};
    (void)poll(&woken, 1, 1);
    camera_wake_clear(source->wanted.wake);
    if (atomic_load(&will.lost))
        return camera_fail(news, "is gone");
    if (atomic_load(&will.silent))
        return !camera_fail(news, "no signal");
    if (source->next == CAMERA_NO_BUFFER)
        source->next = camera_exchange_collect(source->wanted.exchange);
    if (source->next == CAMERA_NO_BUFFER)
        return true;
    hal_camera_frame_t frame = {.picture = {.width = source->wanted.width, .height = source->wanted.height},
                                .sequence = source->sequence++};
    frame.picture.data[0] = camera_exchange_memory(source->wanted.exchange, source->next, 0).address;
    source->next = camera_exchange_put(source->wanted.exchange, source->next, &frame);
    if (source->next == CAMERA_NO_BUFFER)
        source->next = source->sequence < CAMERA_BUFFERS ? (int)source->sequence : CAMERA_NO_BUFFER;
    return true;
}

static void close_source(void *context)
{
    source_t *source = context;
    assert_int_equal(camera_exchange_memory(source->wanted.exchange, 0, 0).length, 0); /* withdrawn before */
    source->sequence = 0;
    atomic_fetch_add(&will.closed, 1);
}

static void destroy(void *context)
{
    atomic_fetch_add(&will.destroyed, 1);
    free(context);
}

static const camera_source_t source = {create, open_source, serve, close_source, destroy};

static const camera_settings_t settings = {
    .name = "v4l2:test", .width = SIDE, .height = SIDE, .rate_frames = 60, .rate_seconds = 1};

static hal_status_t open_camera(hal_camera_t **camera, char error[HAL_BOARD_ERROR_LENGTH])
{
    const camera_name_t parsed = {.kind = CAMERA_V4L2, .any_format = true, .which = "test"};
    return camera_keeper_open(camera, &settings, &parsed, &source, error);
}

/* Wait until taking gives this; pictures are released. */
static void expect_status(hal_camera_t *camera, hal_status_t wanted)
{
    const int64_t until_us = camera_now_us() + PATIENCE_US;
    hal_status_t status;
    do {
        hal_camera_frame_t frame;
        status = hal_camera_take(camera, &frame);
        if (status == HAL_OK)
            hal_camera_release(camera, &frame);
        usleep(1000);
    } while (status != wanted && camera_now_us() < until_us);
    assert_int_equal(status, wanted);
}

/* What is said on stderr while it is caught. */
typedef struct {
    scratch_t scratch;
    char path[SCRATCH_PATH_LENGTH];
    int before;
} caught_t;

static void catch_stderr(caught_t *caught)
{
    scratch_open(&caught->scratch);
    scratch_path(&caught->scratch, "stderr", caught->path);
    (void)fflush(stderr);
    caught->before = dup(STDERR_FILENO);
    assert_non_null(freopen(caught->path, "w", stderr));
}

static int count_of(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = strstr(text, part); at != NULL; at = strstr(at + 1, part))
        count++;
    return count;
}

static char *end_catch(caught_t *caught)
{
    (void)fflush(stderr);
    assert_true(dup2(caught->before, STDERR_FILENO) >= 0);
    close(caught->before);
    size_t length;
    char *said = (char *)scratch_read(caught->path, &length);
    said = realloc(said, length + 1);
    assert_non_null(said);
    said[length] = '\0';
    scratch_close(&caught->scratch);
    return said;
}

static int begin(void **state)
{
    (void)state;
    memset(&will, 0, sizeof will);
    return 0;
}

static void an_absent_camera_is_an_error_at_start(void **state)
{
    (void)state;
    atomic_store(&will.absent, true);
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_camera_t *camera = NULL;
    assert_int_equal(open_camera(&camera, error), HAL_IO);
    assert_null(camera);
    assert_string_equal(error, "camera v4l2:test: is not here");
    assert_int_equal(atomic_load(&will.destroyed), 1);
}

static void a_lost_camera_comes_back(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_camera_t *camera;
    caught_t caught;
    assert_int_equal(open_camera(&camera, error), HAL_OK);
    expect_status(camera, HAL_OK);
    hal_camera_frame_t held;
    while (hal_camera_take(camera, &held) != HAL_OK)
        usleep(1000);
    catch_stderr(&caught);
    atomic_store(&will.absent, true);
    atomic_store(&will.lost, true);
    expect_status(camera, HAL_IO);
    usleep(3 * CAMERA_RETRY_MS * 1000); /* for more than one attempt */
    hal_camera_release(camera, &held);
    atomic_store(&will.lost, false);
    atomic_store(&will.absent, false);
    expect_status(camera, HAL_OK);
    atomic_store(&will.silent, true);
    usleep(100000);
    atomic_store(&will.silent, false);
    usleep(100000);
    camera_keeper_close(camera);
    char *said = end_catch(&caught);
    assert_int_equal(count_of(said, "camera v4l2:test: is gone\n"), 1);
    assert_int_equal(count_of(said, "camera v4l2:test: is not here\n"), 1);
    assert_int_equal(count_of(said, "camera v4l2:test: no signal\n"), 1);
    assert_int_equal(count_of(said, "camera v4l2:test: delivers pictures again\n"), 2);
    assert_int_equal(count_of(said, "\n"), 5);
    free(said);
    assert_int_equal(atomic_load(&will.opened), 2);
    assert_int_equal(atomic_load(&will.closed), 2);
    assert_int_equal(atomic_load(&will.destroyed), 1);
}

static void it_closes_while_it_waits_for_the_device(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_camera_t *camera;
    assert_int_equal(open_camera(&camera, error), HAL_OK);
    atomic_store(&will.absent, true);
    atomic_store(&will.lost, true);
    expect_status(camera, HAL_IO);
    camera_keeper_close(camera);
    camera_keeper_close(NULL);
    assert_int_equal(atomic_load(&will.closed), 1);
    assert_int_equal(atomic_load(&will.destroyed), 1);
}

static void times_of_two_clocks(void **state)
{
    (void)state;
    assert_int_equal(camera_stamp_us(900, 1000, 1000), 900);  /* the board never slept */
    assert_int_equal(camera_stamp_us(900, 1000, 5000), 900);  /* it slept for 4000: a stamp of CLOCK_MONOTONIC */
    assert_int_equal(camera_stamp_us(4900, 1000, 5000), 900); /* and one of CLOCK_BOOTTIME */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(an_absent_camera_is_an_error_at_start, begin),
        cmocka_unit_test_setup(a_lost_camera_comes_back, begin),
        cmocka_unit_test_setup(it_closes_while_it_waits_for_the_device, begin),
        cmocka_unit_test(times_of_two_clocks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
