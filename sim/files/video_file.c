// SPDX-License-Identifier: Apache-2.0
// A video, whatever it is made of: one PNG, numbered PNGs, Y4M, raw pixels, or the test pattern.
#include "sim/files/video_file.h"

#include <assert.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "sim/devices/test_pattern.h"
#include "sim/files/numbered_name.h"
#include "sim/files/pixel.h"
#include "sim/files/png_file.h"
#include "sim/files/y4m_file.h"

enum { PATH_BYTES = 4096, MAGIC_BYTES = 9 };

typedef enum { VIDEO_PATTERN, VIDEO_STILL, VIDEO_NUMBERED, VIDEO_Y4M, VIDEO_RAW } video_kind_t;

struct video {
    video_kind_t kind;
    char *name;
    int32_t width, height;
    video_info_t info;
    int32_t first_number; /**< of numbered PNGs: 0 or 1 */
    y4m_file_t *y4m;
    FILE *raw;
    image_t kept; /**< the newest decoded frame; its format is the last asked for */
    int64_t kept_index;
    uint8_t *kept_pixels;
};

static bool right_size(const video_t *video, const char *path, int32_t width, int32_t height,
                       char error[FILE_ERROR_LENGTH])
{
    return (width == video->width && height == video->height) ||
           file_error(error, path, "picture %dx%d, the room's camera is %dx%d", width, height, video->width,
                      video->height);
}

static bool right_png(const video_t *video, const char *path, char error[FILE_ERROR_LENGTH])
{
    int32_t width, height;
    return png_file_size(path, &width, &height, error) && right_size(video, path, width, height, error);
}

static bool open_numbered(video_t *video, char error[FILE_ERROR_LENGTH])
{
    char path[PATH_BYTES];
    if (!numbered_name(path, sizeof path, video->name, 0))
        return file_error(error, video->name, "expected exactly one %%d or %%0Nd (and %%%% for a %% sign)");
    if (access(path, F_OK) != 0)
        video->first_number = 1;
    int32_t count = 0;
    for (; count <= VIDEO_MAX_FRAMES; count++) {
        if (!numbered_name(path, sizeof path, video->name, video->first_number + count))
            return file_error(error, video->name, "name too long, expected less than %d bytes", PATH_BYTES);
        if (access(path, F_OK) != 0)
            break;
        if (!right_png(video, path, error))
            return false;
    }
    if (count == 0)
        return file_error(error, video->name, "no such pictures, expected the first with number 0 or 1");
    if (count > VIDEO_MAX_FRAMES)
        return file_error(error, video->name, "too many pictures, expected at most %d", VIDEO_MAX_FRAMES);
    video->info.frame_count = count;
    return true;
}

static bool open_raw(video_t *video, char error[FILE_ERROR_LENGTH])
{
    int64_t bytes;
    video->raw = file_open(video->name, &bytes, error);
    if (video->raw == NULL)
        return false;
    const int64_t frame_bytes = (int64_t)video->width * video->height * IMAGE_XRGB8888;
    if (bytes == 0 || bytes % frame_bytes != 0 || bytes / frame_bytes > VIDEO_MAX_FRAMES)
        return file_error(error, video->name, "%lld bytes, expected a multiple of %lld (%dx%d, 4 bytes a pixel)",
                          (long long)bytes, (long long)frame_bytes, video->width, video->height);
    video->info.frame_count = (int32_t)(bytes / frame_bytes);
    return true;
}

static bool open_y4m(video_t *video, char error[FILE_ERROR_LENGTH])
{
    video->y4m = y4m_file_open(video->name, error);
    if (video->y4m == NULL)
        return false;
    const y4m_info_t *info = y4m_file_info(video->y4m);
    video->info = (video_info_t){info->frame_count, info->rate_frames, info->rate_seconds};
    return right_size(video, video->name, info->width, info->height, error);
}

static bool ends_with(const char *name, const char *ending)
{
    const size_t length = strlen(name), wanted = strlen(ending);
    return length >= wanted && strcasecmp(name + length - wanted, ending) == 0;
}

/* PNG or Y4M by the first bytes; where those tell nothing, by the name, so that the reader can say what is wrong. */
static bool find_kind_of_file(video_t *video, char error[FILE_ERROR_LENGTH])
{
    char magic[MAGIC_BYTES] = {0};
    int64_t bytes;
    FILE *file = file_open(video->name, &bytes, error);
    if (file == NULL)
        return false;
    const size_t got = fread(magic, 1, sizeof magic, file);
    fclose(file);
    if (got == sizeof magic && memcmp(magic, "YUV4MPEG2", sizeof magic) == 0)
        video->kind = VIDEO_Y4M;
    else if (got == sizeof magic && memcmp(magic + 1, "PNG", 3) == 0)
        video->kind = VIDEO_STILL;
    else if (ends_with(video->name, ".y4m"))
        video->kind = VIDEO_Y4M;
    else if (ends_with(video->name, ".png"))
        video->kind = VIDEO_STILL;
    else
        return file_error(error, video->name,
                          "unknown kind of video, expected PNG, name_%%05d.png, Y4M, or raw XRGB (.raw .xrgb .bgrx)");
    return true;
}

static bool find_kind(video_t *video, char error[FILE_ERROR_LENGTH])
{
    if (strcmp(video->name, "pattern") == 0)
        video->kind = VIDEO_PATTERN;
    else if (strchr(video->name, '%') != NULL)
        video->kind = VIDEO_NUMBERED;
    else if (ends_with(video->name, ".raw") || ends_with(video->name, ".xrgb") || ends_with(video->name, ".bgrx"))
        video->kind = VIDEO_RAW;
    else
        return find_kind_of_file(video, error);
    return true;
}

static bool open_kind(video_t *video, char error[FILE_ERROR_LENGTH])
{
    switch (video->kind) {
    case VIDEO_PATTERN:
        video->info.frame_count = TEST_PATTERN_STEPS;
        return true;
    case VIDEO_STILL:
        return right_png(video, video->name, error);
    case VIDEO_NUMBERED:
        return open_numbered(video, error);
    case VIDEO_Y4M:
        return open_y4m(video, error);
    case VIDEO_RAW:
        return open_raw(video, error);
    }
    return false;
}

video_t *video_open(const char *name, int32_t width, int32_t height, char error[FILE_ERROR_LENGTH])
{
    assert(width >= 1 && width <= IMAGE_MAX_WIDTH && height >= 1 && height <= IMAGE_MAX_HEIGHT);
    video_t *video = malloc(sizeof *video);
    if (video == NULL) {
        file_error(error, name, "out of memory");
        return NULL;
    }
    *video = (video_t){.width = width, .height = height, .info = {1, 30, 1}, .kept_index = -1};
    video->name = strdup(name);
    video->kept_pixels = malloc((size_t)width * (size_t)height * IMAGE_XRGB8888);
    bool done = (video->name != NULL && video->kept_pixels != NULL) || file_error(error, name, "out of memory");
    done = done && find_kind(video, error) && open_kind(video, error);
    if (!done) {
        video_close(video);
        return NULL;
    }
    return video;
}

void video_close(video_t *video)
{
    if (video == NULL)
        return;
    y4m_file_close(video->y4m);
    if (video->raw != NULL)
        fclose(video->raw);
    free(video->name);
    free(video->kept_pixels);
    free(video);
}

const video_info_t *video_info(const video_t *video)
{
    return &video->info;
}

static bool read_raw(video_t *video, int32_t index, const image_t *image, char error[FILE_ERROR_LENGTH])
{
    const size_t row_bytes = (size_t)video->width * IMAGE_XRGB8888;
    if (fseeko(video->raw, (off_t)row_bytes * video->height * index, SEEK_SET) != 0)
        return file_error(error, video->name, "cannot read frame %d: %s", index, strerror(errno));
    uint8_t *row = malloc(row_bytes);
    if (row == NULL)
        return file_error(error, video->name, "out of memory");
    bool done = true;
    for (int32_t y = 0; y < image->height && done; y++) {
        if (fread(row, 1, row_bytes, video->raw) != row_bytes)
            done = file_error(error, video->name, "frame %d is short, row %d of %d", index, y, image->height);
        uint8_t *to = image_row(image, y);
        for (int32_t x = 0; x < image->width && done; x++, to += image->format)
            pixel_put(to, image->format, row[4 * x + 2], row[4 * x + 1], row[4 * x]);
    }
    free(row);
    return done;
}

static bool decode(video_t *video, int32_t index, const image_t *image, char error[FILE_ERROR_LENGTH])
{
    char path[PATH_BYTES];
    switch (video->kind) {
    case VIDEO_PATTERN:
        test_pattern_draw(image, index);
        return true;
    case VIDEO_STILL:
        return png_file_read(video->name, image, error);
    case VIDEO_NUMBERED:
        return (numbered_name(path, sizeof path, video->name, video->first_number + index) ||
                file_error(error, video->name, "name too long")) &&
               png_file_read(path, image, error);
    case VIDEO_Y4M:
        return y4m_file_frame(video->y4m, index, image, error);
    case VIDEO_RAW:
        return read_raw(video, index, image, error);
    }
    return false;
}

bool video_frame(video_t *video, int64_t index, const image_t *image, char error[FILE_ERROR_LENGTH])
{
    assert(index >= 0 && image->width == video->width && image->height == video->height);
    const int32_t frame = (int32_t)(index % video->info.frame_count);
    if (video->kept_index != frame || video->kept.format != image->format) {
        video->kept_index = -1; /* a failed decode may leave half a picture here */
        video->kept = (image_t){video->kept_pixels, video->width, video->height, video->width * (int32_t)image->format,
                                image->format};
        if (!decode(video, frame, &video->kept, error))
            return false;
        video->kept_index = frame;
    }
    for (int32_t y = 0; y < image->height; y++)
        memcpy(image_row(image, y), image_row(&video->kept, y), (size_t)video->kept.stride);
    return true;
}
