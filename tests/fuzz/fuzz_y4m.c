// SPDX-License-Identifier: Apache-2.0
// Fuzzes the Y4M reader: any bytes are a video whose frames can all be read, or an error of one line.
#include "sim/files/y4m_file.h"

#include <stdlib.h>
#include <string.h>

#include "sim/files/pixel.h"
#include "tests/fuzz/input.h"

enum { FRAMES_READ = 4 };

static image_t new_image(const y4m_info_t *info, image_format_t format)
{
    const int32_t stride = info->width * (int32_t)format;
    image_t image = {malloc((size_t)stride * (size_t)info->height), info->width, info->height, stride, format};
    fuzz_check(image.data != NULL, "memory for a frame no larger than the file");
    return image;
}

static void check_frame(y4m_file_t *y4m, int32_t index)
{
    char error[FILE_ERROR_LENGTH] = "";
    const image_t colour = new_image(y4m_file_info(y4m), IMAGE_XRGB8888);
    const image_t gray = new_image(y4m_file_info(y4m), IMAGE_GRAY8);
    fuzz_check(y4m_file_frame(y4m, index, &colour, error), "a frame that was found can be read");
    fuzz_check(y4m_file_frame(y4m, index, &gray, error), "a frame that was found can be read as gray");
    for (int32_t i = 0; i < gray.width * gray.height; i++) {
        const uint8_t *pixel = colour.data + (ptrdiff_t)4 * i;
        fuzz_check(pixel[3] == 0, "X is 0");
        fuzz_check(gray.data[i] == luma_from_rgb(pixel[2], pixel[1], pixel[0]), "gray is the luma of the colour");
    }
    free(colour.data);
    free(gray.data);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[FILE_ERROR_LENGTH] = "";
    const input_file_t file = input_file_open(data, size);
    y4m_file_t *y4m = y4m_file_open(file.path, error);
    if (y4m != NULL) {
        const y4m_info_t *info = y4m_file_info(y4m);
        fuzz_check(info->width >= 1 && info->width <= IMAGE_MAX_WIDTH, "a width fits the buffers");
        fuzz_check(info->height >= 1 && info->height <= IMAGE_MAX_HEIGHT, "a height fits the buffers");
        fuzz_check(info->frame_count >= 1 && info->rate_frames >= 1 && info->rate_seconds >= 1,
                   "frames and their rate");
        for (int32_t i = 0; i < info->frame_count && i < FRAMES_READ; i++)
            check_frame(y4m, i);
        check_frame(y4m, info->frame_count - 1);
    } else {
        fuzz_check_line(error);
    }
    y4m_file_close(y4m);
    input_file_close(&file);
    return 0;
}
