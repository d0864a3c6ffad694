// SPDX-License-Identifier: Apache-2.0
// YUV4MPEG2 files (.y4m): uncompressed 8-bit video.
#include "sim/files/y4m_file.h"

#include <assert.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/pixel.h"
#include "sim/files/yuv_to_rgb.h"

enum { LINE_BYTES = 256, HD_HEIGHT = 720 };

/* How the chroma planes of a colour space are laid out. */
typedef struct {
    const char *name;
    bool has_chroma;
    int32_t shift_x, shift_y; /**< pixel (x, y) uses chroma sample (x >> shift_x, y >> shift_y) */
} layout_t;

static const layout_t layouts[] = {
    {"420jpeg", true, 1, 1}, {"420mpeg2", true, 1, 1}, {"420paldv", true, 1, 1}, {"420", true, 1, 1},
    {"422", true, 1, 0},     {"444", true, 0, 0},      {"mono", false, 0, 0},
};

struct y4m_file {
    FILE *file;
    char *path;
    y4m_info_t info;
    const layout_t *layout;
    bool full_range;
    int32_t chroma_width, chroma_height;
    int64_t frame_bytes;
    int64_t *starts;  /**< of every frame's first sample, bytes from the file's beginning */
    uint8_t *samples; /**< of one frame */
};

/* Read up to the newline, which is dropped. False when none comes in time, or anything comes that is no text. */
static bool read_line(FILE *file, char line[LINE_BYTES])
{
    for (int length = 0; length < LINE_BYTES; length++) {
        const int byte = getc(file);
        if (byte == '\n') {
            line[length] = '\0';
            return true;
        }
        if (byte < ' ' || byte > '~')
            return false;
        line[length] = (char)byte;
    }
    return false;
}

/* A decimal number of 0 to INT32_MAX that ends at the given character; *text moves behind that character. */
static bool read_number(const char **text, char end, int32_t *number)
{
    int64_t value = 0;
    const char *at = *text;
    if (*at < '0' || *at > '9')
        return false;
    for (; *at >= '0' && *at <= '9'; at++) {
        value = value * 10 + (*at - '0');
        if (value > INT32_MAX)
            return false;
    }
    if (*at != end)
        return false;
    *number = (int32_t)value;
    *text = at + 1;
    return true;
}

static bool read_size(int32_t *size, const char *text, int32_t limit)
{
    return read_number(&text, '\0', size) && *size >= 1 && *size <= limit;
}

/* 0:0 means unknown: the rate stays as it is. */
static bool read_rate(y4m_info_t *info, const char *text)
{
    int32_t frames, seconds;
    if (!read_number(&text, ':', &frames) || !read_number(&text, '\0', &seconds))
        return false;
    if (frames == 0 && seconds == 0)
        return true;
    info->rate_frames = frames;
    info->rate_seconds = seconds;
    return frames > 0 && seconds > 0;
}

static bool read_layout(const layout_t **layout, const char *name)
{
    for (size_t i = 0; i < sizeof layouts / sizeof layouts[0]; i++) {
        if (strcmp(layouts[i].name, name) == 0) {
            *layout = &layouts[i];
            return true;
        }
    }
    return false;
}

static bool read_parameter(y4m_file_t *y4m, const char *word, char error[FILE_ERROR_LENGTH])
{
    const char *value = word + 1;
    switch (word[0]) {
    case 'W':
        return read_size(&y4m->info.width, value, IMAGE_MAX_WIDTH) ||
               file_error(error, y4m->path, "width '%s', expected 1 to %d", value, IMAGE_MAX_WIDTH);
    case 'H':
        return read_size(&y4m->info.height, value, IMAGE_MAX_HEIGHT) ||
               file_error(error, y4m->path, "height '%s', expected 1 to %d", value, IMAGE_MAX_HEIGHT);
    case 'F':
        return read_rate(&y4m->info, value) ||
               file_error(error, y4m->path, "frame rate '%s', expected FRAMES:SECONDS", value);
    case 'C':
        return read_layout(&y4m->layout, value) ||
               file_error(error, y4m->path, "colour space '%s', expected 8-bit 420, 422, 444 or mono", value);
    case 'I':
        return strcmp(value, "p") == 0 || strcmp(value, "?") == 0 ||
               file_error(error, y4m->path, "interlacing '%s', expected progressive video (Ip)", value);
    case 'A':
        return true;
    case 'X':
        if (strcmp(value, "COLORRANGE=FULL") == 0)
            y4m->full_range = true;
        return true;
    default:
        return file_error(error, y4m->path, "unknown header parameter '%s'", word);
    }
}

static bool read_header(y4m_file_t *y4m, char error[FILE_ERROR_LENGTH])
{
    char line[LINE_BYTES];
    char *rest = line;
    if (!read_line(y4m->file, line) || strcmp(strsep(&rest, " "), "YUV4MPEG2") != 0)
        return file_error(error, y4m->path, "not a Y4M file, expected a first line 'YUV4MPEG2 W... H...'");
    y4m->info = (y4m_info_t){.rate_frames = 30, .rate_seconds = 1};
    y4m->layout = &layouts[0];
    for (const char *word = strsep(&rest, " "); word != NULL; word = strsep(&rest, " "))
        if (word[0] != '\0' && !read_parameter(y4m, word, error))
            return false;
    if (y4m->info.width == 0 || y4m->info.height == 0)
        return file_error(error, y4m->path, "no width or height in the header, expected W and H");
    const layout_t *layout = y4m->layout;
    if (layout->has_chroma) {
        y4m->chroma_width = (y4m->info.width + (1 << layout->shift_x) - 1) >> layout->shift_x;
        y4m->chroma_height = (y4m->info.height + (1 << layout->shift_y) - 1) >> layout->shift_y;
    }
    y4m->frame_bytes =
        (int64_t)y4m->info.width * y4m->info.height + 2 * (int64_t)y4m->chroma_width * y4m->chroma_height;
    return true;
}

/* Note where a frame's samples start, and step over them. */
static bool find_frame(y4m_file_t *y4m, int64_t file_bytes, char error[FILE_ERROR_LENGTH])
{
    const int32_t frame = y4m->info.frame_count;
    char line[LINE_BYTES];
    if (!read_line(y4m->file, line) || strncmp(line, "FRAME", 5) != 0 || (line[5] != '\0' && line[5] != ' '))
        return file_error(error, y4m->path, "frame %d is broken, expected a line 'FRAME'", frame);
    const int64_t start = ftello(y4m->file);
    if (file_bytes - start < y4m->frame_bytes)
        return file_error(error, y4m->path, "frame %d is short: %lld bytes, expected %lld", frame,
                          (long long)(file_bytes - start), (long long)y4m->frame_bytes);
    /* The table doubles whenever the count reaches a power of two. */
    if ((frame & (frame - 1)) == 0) {
        int64_t *starts = realloc(y4m->starts, sizeof *starts * (frame == 0 ? 1 : 2 * (size_t)frame));
        if (starts == NULL)
            return file_error(error, y4m->path, "out of memory");
        y4m->starts = starts;
    }
    y4m->starts[frame] = start;
    y4m->info.frame_count = frame + 1;
    return fseeko(y4m->file, start + y4m->frame_bytes, SEEK_SET) == 0 ||
           file_error(error, y4m->path, "cannot read frame %d: %s", frame, strerror(errno));
}

static bool find_frames(y4m_file_t *y4m, int64_t file_bytes, char error[FILE_ERROR_LENGTH])
{
    while (ftello(y4m->file) < file_bytes) {
        if (y4m->info.frame_count == INT32_MAX)
            return file_error(error, y4m->path, "too many frames, expected at most %d", INT32_MAX);
        if (!find_frame(y4m, file_bytes, error))
            return false;
    }
    return y4m->info.frame_count > 0 || file_error(error, y4m->path, "no frame behind the header, expected one");
}

y4m_file_t *y4m_file_open(const char *path, char error[FILE_ERROR_LENGTH])
{
    int64_t file_bytes;
    FILE *file = file_open(path, &file_bytes, error);
    if (file == NULL)
        return NULL;
    y4m_file_t *y4m = calloc(1, sizeof *y4m);
    if (y4m == NULL) {
        file_error(error, path, "out of memory");
        fclose(file);
        return NULL;
    }
    y4m->file = file;
    y4m->path = strdup(path);
    bool done = y4m->path != NULL || file_error(error, path, "out of memory");
    done = done && read_header(y4m, error) && find_frames(y4m, file_bytes, error);
    if (done) {
        y4m->samples = malloc((size_t)y4m->frame_bytes);
        done = y4m->samples != NULL || file_error(error, path, "out of memory");
    }
    if (!done) {
        y4m_file_close(y4m);
        return NULL;
    }
    return y4m;
}

void y4m_file_close(y4m_file_t *file)
{
    if (file == NULL)
        return;
    fclose(file->file);
    free(file->path);
    free(file->starts);
    free(file->samples);
    free(file);
}

const y4m_info_t *y4m_file_info(const y4m_file_t *file)
{
    return &file->info;
}

static void convert(const y4m_file_t *y4m, const image_t *image)
{
    const yuv_matrix_t *matrix = yuv_matrix(y4m->info.height >= HD_HEIGHT, y4m->full_range);
    const layout_t *layout = y4m->layout;
    const size_t chroma_bytes = (size_t)y4m->chroma_width * (size_t)y4m->chroma_height;
    const uint8_t *luma = y4m->samples;
    const uint8_t *cb = luma + (size_t)image->width * (size_t)image->height;
    for (int32_t y = 0; y < image->height; y++) {
        const uint8_t *cb_row = cb + (ptrdiff_t)(y >> layout->shift_y) * y4m->chroma_width;
        uint8_t *to = image_row(image, y);
        for (int32_t x = 0; x < image->width; x++, luma++, to += image->format) {
            const int32_t at = x >> layout->shift_x;
            const uint8_t b = layout->has_chroma ? cb_row[at] : 128;
            const uint8_t r = layout->has_chroma ? cb_row[chroma_bytes + (size_t)at] : 128;
            const rgb_t rgb = rgb_from_yuv(matrix, *luma, b, r);
            pixel_put(to, image->format, rgb.red, rgb.green, rgb.blue);
        }
    }
}

bool y4m_file_frame(y4m_file_t *file, int32_t index, const image_t *image, char error[FILE_ERROR_LENGTH])
{
    assert(index >= 0 && index < file->info.frame_count);
    assert(image->width == file->info.width && image->height == file->info.height);
    if (fseeko(file->file, file->starts[index], SEEK_SET) != 0)
        return file_error(error, file->path, "cannot read frame %d: %s", index, strerror(errno));
    if (fread(file->samples, 1, (size_t)file->frame_bytes, file->file) != (size_t)file->frame_bytes)
        return file_error(error, file->path, "frame %d is short, expected %lld bytes", index,
                          (long long)file->frame_bytes);
    convert(file, image);
    return true;
}
