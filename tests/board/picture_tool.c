// SPDX-License-Identifier: Apache-2.0
// Pictures of the virtual board's tests: a camera's raw bytes as a PNG for the simulator, a screenshot compared with
// the simulator's PNG, and the safe picture as a screenshot has it.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/can_protocol.h"
#include "firmware/quaternion.h"
#include "firmware/safe_picture.h"
#include "sim/files/png_file.h"
#include "sim/pose/motion.h"
#include "sim/pose/pose_text.h"

static const char USAGE[] =
    "usage: picture_tool png WIDTH HEIGHT RAW PNG   raw XRGB8888, or RGB888, as a PNG\n"
    "       picture_tool differ PPM PNG            says how many bytes of RGB differ; 0 if none\n"
    "       picture_tool pose POSE fd|classic      as `send still` and such frames carry it\n"
    "       picture_tool safe WIDTH HEIGHT NODE BOARD REASON    the safe picture as a PPM, to stdout\n";

enum { BYTES = IMAGE_XRGB8888, PACKED_BYTES = 3 };

static int fail(const char *error)
{
    fprintf(stderr, "picture_tool: %s\n", error);
    return 2;
}

/* From RGB888 to XRGB8888 in place: the last pixel first. */
static void unpack(uint8_t *pixels, size_t count)
{
    while (count-- > 0)
        memmove(&pixels[count * BYTES], &pixels[count * PACKED_BYTES], PACKED_BYTES);
}

static int write_png(int32_t width, int32_t height, const char *raw, const char *png)
{
    char error[FILE_ERROR_LENGTH];
    int64_t size;
    FILE *file = file_open(raw, &size, error);
    if (file == NULL)
        return fail(error);
    const size_t count = (size_t)width * (size_t)height, bytes = (size_t)size;
    uint8_t *pixels = calloc(count, BYTES);
    const image_t image = {pixels, width, height, width * BYTES, IMAGE_XRGB8888};
    const bool right = pixels != NULL && (bytes == count * BYTES || bytes == count * PACKED_BYTES) &&
                       fread(pixels, 1, bytes, file) == bytes;
    (void)fclose(file);
    if (right && bytes == count * PACKED_BYTES)
        unpack(pixels, count);
    const bool written = right && png_file_write(png, &image, error);
    free(pixels);
    if (!right)
        (void)file_error(error, raw, "%lld bytes, expected the %d x %d x %d or %d of a picture", (long long)size, width,
                         height, BYTES, PACKED_BYTES);
    return written ? 0 : fail(error);
}

/* Bytes of R, G and B that are not the same in both; all of them when the screenshot ends early. */
static int64_t count_differences(FILE *ppm, const image_t *image)
{
    int64_t differences = 0;
    for (int64_t i = 0; i < (int64_t)image->width * image->height; i++)
        for (int channel = 2; channel >= 0; channel--)
            differences += fgetc(ppm) != image->data[i * BYTES + channel];
    return differences;
}

static int differ(const char *ppm, const char *png)
{
    char error[FILE_ERROR_LENGTH];
    image_t image;
    int64_t size;
    FILE *file = file_open(ppm, &size, error);
    if (file == NULL || !png_file_load(png, IMAGE_XRGB8888, &image, error))
        return fail(error);
    int32_t width, height;
    const bool same_size = fscanf(file, "P6 %d %d 255", &width, &height) == 2 && fgetc(file) == '\n' &&
                           width == image.width && height == image.height;
    const int64_t differences = same_size ? count_differences(file, &image) : -1;
    free(image.data);
    (void)fclose(file);
    if (!same_size) {
        (void)file_error(error, ppm, "expected a P6 of %dx%d, the size of %s", image.width, image.height, png);
        return fail(error);
    }
    printf("%lld bytes differ\n", (long long)differences);
    return differences == 0 ? 0 : 1;
}

static bool carried(can_pose_t *got, const can_pose_t *sent, bool fd)
{
    hal_can_frame_t part[CAN_POSE_PARTS];
    if (fd)
        return can_pose_fd_encode(part, sent) && can_pose_fd_decode(got, part, 0) == CAN_CHECK_OK;
    return can_pose_set_encode(part, sent) && can_pose_set_decode(got, part, 0) == CAN_CHECK_OK;
}

static int carry_pose(const char *text, bool fd)
{
    char error[POSE_TEXT_MESSAGE_LENGTH];
    motion_t still = {.kind = MOTION_STILL, .rate_hz = 1.0, .duration_s = 1.0};
    pose_list_t list;
    can_pose_t got;
    int32_t unit[4];
    if (!pose_from_text(text, &still.start, error))
        return fail(error);
    if (!motion_make(&list, &still))
        return fail("out of memory");
    const can_pose_t sent = {.pose = list.entry[0].pose, .quality = CAN_POSE_TRACKED};
    pose_list_free(&list);
    if (!carried(&got, &sent, fd) || !quaternion_normalise(unit, got.pose.quaternion_q30))
        return fail("the pose does not fit its frames");
    for (int i = 0; i < 3; i++)
        printf("%.6f ", (double)got.pose.eye_nm[i] / 1e6);
    for (int i = 0; i < 4; i++)
        printf("%.12f%s", unit[i] / 1073741824.0, i < 3 ? " " : "\n");
    return 0;
}

static int write_safe(int32_t width, int32_t height, const safe_picture_t *safe)
{
    uint8_t *pixels = calloc((size_t)width * (size_t)height, BYTES);
    if (pixels == NULL)
        return fail("out of memory");
    const picture_t panel = {
        .format = PICTURE_XRGB8888, .width = width, .height = height, .data = {pixels}, .stride = {width * BYTES}};
    safe_picture_draw(&panel, safe);
    printf("P6\n%d %d\n255\n", width, height);
    for (int64_t i = 0; i < (int64_t)width * height; i++)
        for (int channel = 2; channel >= 0; channel--)
            putchar(pixels[i * BYTES + channel]);
    free(pixels);
    return 0;
}

int main(int argc, char **argv)
{
    const bool fd = argc == 4 && strcmp(argv[3], "fd") == 0;
    if (argc == 6 && strcmp(argv[1], "png") == 0)
        return write_png(atoi(argv[2]), atoi(argv[3]), argv[4], argv[5]);
    if (argc == 4 && strcmp(argv[1], "differ") == 0)
        return differ(argv[2], argv[3]);
    if (argc == 4 && strcmp(argv[1], "pose") == 0 && (fd || strcmp(argv[3], "classic") == 0))
        return carry_pose(argv[2], fd);
    if (argc == 7 && strcmp(argv[1], "safe") == 0)
        return write_safe(atoi(argv[2]), atoi(argv[3]), &(safe_picture_t){argv[5], atoi(argv[4]), argv[6]});
    fputs(USAGE, stderr);
    return 2;
}
