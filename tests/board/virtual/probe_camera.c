// SPDX-License-Identifier: Apache-2.0
// Takes pictures through hal_camera.h as the firmware does, and says what came: for tests on a board.
//
// usage: probe_camera NAME WIDTH HEIGHT RATE PICTURES SECONDS [hold]
//   until PICTURES were taken, or SECONDS are over; it holds each picture until the next one, with hold: as many
//   as it may.
// Lines on stdout:
//   picture SEQUENCE time US age US FORMAT MATRIX stride BYTES pixel HEX    HEX: of the middle, and of its chroma
//   status io | status ok                                                   when it changes
//   end pictures N gaps N full N rss KB to KB heap BYTES to BYTES threads NAME...    from the 20th picture to the last
// Exit status: 0 when all pictures came, 1 when time was over, 2 when the camera could not be opened.
#include <dirent.h>
#include <inttypes.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/camera.h"
#include "hal/linux/camera_clock.h"
#include "hal/linux/camera_name.h"

enum { SETTLED = 20 };

typedef struct {
    hal_camera_frame_t held[HAL_CAMERA_LENT];
    int held_count, hold;
    long pictures, gaps, full;
    uint32_t sequence;
    long rss_kb;
    size_t heap_bytes;
    hal_status_t status;
} probe_t;

/* Of smaps_rollup: statm lags behind by what each thread has not told yet. */
static long rss_kb(void)
{
    long kb = -1;
    char line[256];
    FILE *file = fopen("/proc/self/smaps_rollup", "r");
    while (file != NULL && kb < 0 && fgets(line, sizeof line, file) != NULL)
        (void)sscanf(line, "Rss: %ld kB", &kb);
    if (file != NULL)
        fclose(file);
    return kb;
}

static void print_threads(void)
{
    DIR *tasks = opendir("/proc/self/task");
    for (struct dirent *task = NULL; tasks != NULL && (task = readdir(tasks)) != NULL;) {
        char path[300], name[64] = "";
        snprintf(path, sizeof path, "/proc/self/task/%s/comm", task->d_name);
        FILE *file = task->d_name[0] == '.' ? NULL : fopen(path, "r");
        if (file != NULL && fgets(name, sizeof name, file) != NULL)
            printf(" '%.*s'", (int)strcspn(name, "\n"), name);
        if (file != NULL)
            fclose(file);
    }
    if (tasks != NULL)
        closedir(tasks);
    printf("\n");
}

static void print_picture(const hal_camera_frame_t *frame)
{
    static const int pixel_bytes[PICTURE_FORMATS] = {4, 1, 3, 3, 2, 2, 1};
    const picture_t *picture = &frame->picture;
    const int32_t x = picture->width / 4 * 2, y = picture->height / 4 * 2;
    const int32_t bytes = pixel_bytes[picture->format];
    const uint8_t *at = picture->data[0] + (ptrdiff_t)y * picture->stride[0] + (ptrdiff_t)x * bytes;
    printf("picture %" PRIu32 " time %" PRId64 " age %" PRId64 " %s %s stride %d pixel ", frame->sequence,
           frame->capture_time_us, camera_now_us() - frame->capture_time_us, camera_format_name(picture->format),
           picture->matrix == PICTURE_BT709 ? "bt709" : "bt601", picture->stride[0]);
    const bool pairs = picture->format == PICTURE_YUYV || picture->format == PICTURE_UYVY;
    for (int32_t i = 0; i < (pairs ? 2 * bytes : bytes); i++)
        printf("%02x", at[i]);
    if (picture->format == PICTURE_NV12) {
        const uint8_t *chroma = picture->data[1] + (ptrdiff_t)(y / 2) * picture->stride[1] + x;
        printf(" %02x%02x", chroma[0], chroma[1]);
    }
    printf("\n");
}

static void release_oldest(probe_t *probe, hal_camera_t *camera)
{
    hal_camera_release(camera, &probe->held[0]);
    probe->held_count--;
    memmove(&probe->held[0], &probe->held[1], (size_t)probe->held_count * sizeof probe->held[0]);
}

static void keep(probe_t *probe, hal_camera_t *camera, const hal_camera_frame_t *frame)
{
    if (probe->pictures != 0 && frame->sequence != probe->sequence + 1)
        probe->gaps++;
    probe->sequence = frame->sequence;
    probe->pictures++;
    print_picture(frame);
    if (probe->held_count == probe->hold)
        release_oldest(probe, camera);
    probe->held[probe->held_count++] = *frame;
    if (probe->pictures == SETTLED) {
        probe->rss_kb = rss_kb();
        probe->heap_bytes = mallinfo2().uordblks;
    }
}

static void step(probe_t *probe, hal_camera_t *camera)
{
    hal_camera_frame_t frame;
    hal_status_t status = hal_camera_take(camera, &frame);
    if (status == HAL_FULL) {
        probe->full++;
        release_oldest(probe, camera);
        status = hal_camera_take(camera, &frame);
    }
    if (status == HAL_EMPTY)
        return;
    if (status != probe->status)
        printf("status %s\n", status == HAL_OK ? "ok" : "io");
    probe->status = status;
    if (status == HAL_OK)
        keep(probe, camera, &frame);
}

int main(int argc, char **argv)
{
    if (argc < 7)
        return 2;
    const camera_settings_t settings = {.name = argv[1],
                                        .width = atoi(argv[2]),
                                        .height = atoi(argv[3]),
                                        .rate_frames = atoi(argv[4]),
                                        .rate_seconds = 1};
    const long wanted = atol(argv[5]);
    const int64_t until_us = camera_now_us() + 1000000 * (int64_t)atol(argv[6]);
    probe_t probe = {.hold = argc > 7 ? HAL_CAMERA_LENT : 1, .status = HAL_OK};
    setvbuf(stdout, NULL, _IOLBF, 0);
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_camera_t *camera;
    if (camera_open(&camera, &settings, error) != HAL_OK) {
        fprintf(stderr, "%s\n", error);
        return 2;
    }
    while (probe.pictures < wanted && camera_now_us() < until_us) {
        step(&probe, camera);
        usleep(1000);
    }
    printf("end pictures %ld gaps %ld full %ld rss %ld to %ld heap %zu to %zu threads", probe.pictures, probe.gaps,
           probe.full, probe.rss_kb, rss_kb(), probe.heap_bytes, mallinfo2().uordblks);
    print_threads();
    camera_close(camera);
    return probe.pictures >= wanted ? 0 : 1;
}
