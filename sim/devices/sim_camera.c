// SPDX-License-Identifier: Apache-2.0
// The camera in the simulator (hal/hal_camera.h): plays a video, and fails on demand.
#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_camera.h"

#include <assert.h>
#include <stdlib.h>

#include "sim/devices/sim_picture.h"
#include "sim/rng.h"

/* Those held by the firmware, one ready to be taken, one being decoded. */
enum { BUFFERS = HAL_CAMERA_LENT + 2 };
enum { MILLION = 1000000, NO_PICTURE = -1, MAX_CATCH_UP = 100000 };

typedef enum { DROP_CHANCE = 1, CORRUPT_CHANCE = 2, NOISE = 3 } chance_t;

typedef enum { BUFFER_FREE, BUFFER_READY, BUFFER_HELD } buffer_state_t;

typedef struct {
    hal_camera_frame_t frame;
    buffer_state_t state;
    int64_t video_frame; /**< which one it holds, unspoilt; NO_PICTURE when none */
} buffer_t;

struct hal_camera {
    sim_camera_settings_t settings;
    sim_camera_faults_t faults;
    sim_camera_counts_t counts;
    buffer_t buffers[BUFFERS];
    image_t decoded; /* XRGB8888, on the way to a format that videos are not read in */
    uint8_t *pixels;
    int64_t arrived;   /**< newest picture that has arrived, or was lost */
    int64_t delivered; /**< newest picture that was made ready; what a stuck camera repeats */
    bool unplugged;
};

static sim_rate_t rate_of(const sim_camera_settings_t *settings)
{
    sim_rate_t rate = settings->rate;
    if (rate.frames == 0) {
        rate.frames = video_info(settings->video)->rate_frames;
        rate.seconds = video_info(settings->video)->rate_seconds;
    }
    return rate;
}

static picture_t picture_of(const sim_camera_settings_t *settings, uint8_t *bytes)
{
    return sim_picture(settings->format, settings->width, settings->height, bytes);
}

static bool settings_are_right(const sim_camera_settings_t *settings, char error[FILE_ERROR_LENGTH])
{
    if (settings->width < 1 || settings->width > IMAGE_MAX_WIDTH || settings->height < 1 ||
        settings->height > IMAGE_MAX_HEIGHT)
        return file_error(error, "camera", "picture %dx%d, expected at most %dx%d", settings->width, settings->height,
                          IMAGE_MAX_WIDTH, IMAGE_MAX_HEIGHT);
    const picture_t picture = picture_of(settings, NULL);
    if (!picture_is_valid(&picture))
        return file_error(error, "camera", "picture %dx%d, expected an even size for %s", settings->width,
                          settings->height, sim_picture_formats[settings->format]);
    const sim_rate_t rate = rate_of(settings);
    if (!sim_rate_is_valid(&rate))
        return file_error(error, "camera", "%d pictures in %d s, expected up to 1000000 a second", rate.frames,
                          rate.seconds);
    if (settings->latency_us < 0)
        return file_error(error, "camera", "latency %lld us, expected 0 or more", (long long)settings->latency_us);
    return true;
}

hal_camera_t *sim_camera_create(const sim_camera_settings_t *settings, char error[FILE_ERROR_LENGTH])
{
    if (!settings_are_right(settings, error))
        return NULL;
    hal_camera_t *camera = malloc(sizeof *camera);
    const picture_t picture = picture_of(settings, NULL);
    const int32_t stride = settings->width * (int32_t)IMAGE_XRGB8888;
    const size_t bytes = sim_picture_bytes(&picture), decoded = (size_t)stride * (size_t)settings->height;
    uint8_t *pixels = malloc(decoded + bytes * BUFFERS);
    if (camera == NULL || pixels == NULL) {
        free(camera);
        free(pixels);
        file_error(error, "camera", "out of memory");
        return NULL;
    }
    *camera = (hal_camera_t){.settings = *settings, .pixels = pixels, .arrived = NO_PICTURE, .delivered = NO_PICTURE};
    camera->settings.rate = rate_of(settings);
    camera->decoded = (image_t){pixels, settings->width, settings->height, stride, IMAGE_XRGB8888};
    for (size_t i = 0; i < BUFFERS; i++) {
        camera->buffers[i].frame.picture = picture_of(settings, pixels + decoded + i * bytes);
        camera->buffers[i].video_frame = NO_PICTURE;
    }
    return camera;
}

void sim_camera_destroy(hal_camera_t *camera)
{
    if (camera == NULL)
        return;
    free(camera->pixels);
    free(camera);
}

sim_camera_faults_t *sim_camera_faults(hal_camera_t *camera)
{
    return &camera->faults;
}

sim_camera_counts_t sim_camera_counts(const hal_camera_t *camera)
{
    return camera->counts;
}

/* A number from seed, picture and purpose alone: the same whatever was asked before. */
static uint64_t hash(uint32_t seed, int64_t picture, chance_t purpose)
{
    return rng_next(&(rng_t){((uint64_t)seed << 32) + 4 * (uint64_t)picture + (uint64_t)purpose});
}

/* Whether a fault hits this picture: because it was ordered for the next ones, or by chance. */
static bool hit(const hal_camera_t *camera, uint32_t *next, uint32_t ppm, int64_t picture, chance_t purpose)
{
    if (*next > 0) {
        (*next)--;
        return true;
    }
    return hash(camera->settings.seed, picture, purpose) % MILLION < ppm;
}

/* Noise over a quarter of the height, at a height that depends on the picture. */
static void spoil(const hal_camera_t *camera, const picture_t *image, int64_t picture)
{
    rng_t noise = {hash(camera->settings.seed, picture, NOISE)};
    const int32_t rows = (image->height + 3) / 4;
    const int32_t begin = (int32_t)(rng_next(&noise) % (uint64_t)(image->height - rows + 1));
    for (int32_t y = begin; y < begin + rows; y++) {
        uint8_t *row = image->data[0] + (ptrdiff_t)y * image->stride[0];
        for (int32_t x = 0; x < image->stride[0]; x++)
            row[x] = (uint8_t)(rng_next(&noise) >> 56);
    }
}

/* The buffer to fill: best a free one that holds the wanted picture already. */
static buffer_t *choose_buffer(hal_camera_t *camera, int64_t video_frame)
{
    buffer_t *chosen = NULL;
    for (int i = 0; i < BUFFERS; i++) {
        buffer_t *buffer = &camera->buffers[i];
        if (buffer->state == BUFFER_FREE && (chosen == NULL || buffer->video_frame == video_frame))
            chosen = buffer;
    }
    assert(chosen != NULL);
    return chosen;
}

static buffer_t *find_ready(hal_camera_t *camera)
{
    for (int i = 0; i < BUFFERS; i++)
        if (camera->buffers[i].state == BUFFER_READY)
            return &camera->buffers[i];
    return NULL;
}

static void forget_ready(hal_camera_t *camera)
{
    buffer_t *ready = find_ready(camera);
    if (ready != NULL)
        ready->state = BUFFER_FREE;
}

/* Decode a frame of the video into the camera's format. */
static bool decode(hal_camera_t *camera, int64_t index, const picture_t *picture, char error[FILE_ERROR_LENGTH])
{
    const bool direct = picture->format == PICTURE_XRGB8888 || picture->format == PICTURE_GRAY8;
    const image_t image = direct ? picture_plane(picture, 0) : camera->decoded;
    if (!video_frame(camera->settings.video, index, &image, error))
        return false;
    if (!direct)
        sim_picture_from_xrgb(picture, &image);
    return true;
}

static bool deliver(hal_camera_t *camera, int64_t captured, char error[FILE_ERROR_LENGTH])
{
    const bool repeats = camera->faults.stuck && camera->delivered != NO_PICTURE;
    const int64_t picture = repeats ? camera->delivered : captured;
    const int64_t video_frame_index = picture % video_info(camera->settings.video)->frame_count;
    buffer_t *buffer = choose_buffer(camera, video_frame_index);
    if (buffer->video_frame != video_frame_index) {
        buffer->video_frame = NO_PICTURE;
        if (!decode(camera, video_frame_index, &buffer->frame.picture, error)) {
            camera->counts.lost++;
            return false;
        }
        buffer->video_frame = video_frame_index;
    }
    if (hit(camera, &camera->faults.corrupt_next, camera->faults.corrupt_ppm, captured, CORRUPT_CHANCE)) {
        spoil(camera, &buffer->frame.picture, captured);
        buffer->video_frame = NO_PICTURE;
        camera->counts.corrupted++;
    }
    forget_ready(camera);
    const int64_t time_us = sim_rate_time_us(&camera->settings.rate, captured);
    const hal_time_t *clock = camera->settings.clock;
    buffer->frame.capture_time_us = clock == NULL ? time_us : sim_clock_shows_us(clock, time_us);
    buffer->frame.sequence = (uint32_t)picture;
    buffer->state = BUFFER_READY;
    camera->delivered = picture;
    camera->counts.delivered++;
    return true;
}

bool sim_camera_advance(hal_camera_t *camera, int64_t now_us, char error[FILE_ERROR_LENGTH])
{
    const int64_t delay_us = camera->settings.latency_us + camera->faults.late_us;
    const int64_t due = sim_rate_beat_at(&camera->settings.rate, now_us - delay_us);
    const int64_t until_us = camera->faults.unplugged_until_us;
    camera->unplugged = until_us != 0 && now_us < until_us;
    if (camera->unplugged)
        forget_ready(camera);
    if (due - camera->arrived > MAX_CATCH_UP)
        camera->arrived = due - MAX_CATCH_UP;
    int64_t newest = NO_PICTURE;
    while (camera->arrived < due) {
        camera->arrived++;
        if (camera->unplugged ||
            hit(camera, &camera->faults.drop_next, camera->faults.drop_ppm, camera->arrived, DROP_CHANCE))
            camera->counts.lost++;
        else
            newest = camera->arrived;
    }
    return newest == NO_PICTURE || deliver(camera, newest, error);
}

hal_status_t hal_camera_take(hal_camera_t *camera, hal_camera_frame_t *frame)
{
    if (camera->unplugged)
        return HAL_IO;
    int held = 0;
    for (int i = 0; i < BUFFERS; i++)
        held += camera->buffers[i].state == BUFFER_HELD;
    if (held >= HAL_CAMERA_LENT)
        return HAL_FULL;
    buffer_t *ready = find_ready(camera);
    if (ready == NULL)
        return HAL_EMPTY;
    ready->state = BUFFER_HELD;
    *frame = ready->frame;
    return HAL_OK;
}

void hal_camera_release(hal_camera_t *camera, const hal_camera_frame_t *frame)
{
    int lent = 0;
    while (lent < BUFFERS && camera->buffers[lent].frame.picture.data[0] != frame->picture.data[0])
        lent++;
    assert(lent < BUFFERS && camera->buffers[lent].state == BUFFER_HELD);
    camera->buffers[lent].state = BUFFER_FREE;
}
