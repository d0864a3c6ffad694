// SPDX-License-Identifier: Apache-2.0
// Fuzzes the decoder of the picture's code: any pixels and sizes, and codes with any pixels changed. What is read must
// draw again what was read, and no byte beyond the picture is touched.
//
// An empty input is a picture of one level. A code is drawn over the input's pixels when its first byte is odd.
#include "firmware/frame_tag.h"

#include <stdlib.h>

#include "sim/tag/paint_tag.h"
#include "tests/fuzz/input.h"

enum { MAX_WIDTH = 130, MAX_HEIGHT = 130, LARGE_WIDTH = 330, LARGE_HEIGHT = 60, CHANGES = 16 };

static const int32_t pixel_bytes[PICTURE_FORMATS] = {
    [PICTURE_XRGB8888] = 4, [PICTURE_GRAY8] = 1, [PICTURE_RGB888] = 3, [PICTURE_BGR888] = 3,
    [PICTURE_YUYV] = 2,     [PICTURE_UYVY] = 2,  [PICTURE_NV12] = 1,
};

static bool same(const frame_tag_t *a, const frame_tag_t *b)
{
    return a->capture_time_us == b->capture_time_us && a->frame_number == b->frame_number && a->viewer == b->viewer;
}

static bool painted(const picture_t *picture, const frame_tag_t *tag)
{
    const paint_tag_t code = {tag->capture_time_us, tag->frame_number, tag->viewer};
    const paint_tag_picture_t to = {picture->data[0], picture->width, picture->height, picture->stride[0],
                                    pixel_bytes[picture->format]};
    return picture_is_valid(picture) && to.pixel_bytes != 2 && paint_tag(&to, &code);
}

/* @return Has the picture the code, as far as is known? */
static bool fill(const picture_t *picture, input_t *input, frame_tag_t *tag, bool draw)
{
    const int32_t bytes = picture->stride[0] * picture->height;
    *tag = (frame_tag_t){(uint32_t)input_bits(input, 4), (uint32_t)input_bits(input, 4), input_byte(input) % 4};
    const bool has_code = draw && painted(picture, tag);
    const int32_t changes = has_code ? input_range(input, 0, CHANGES) : 0;
    for (int32_t n = 0; n < changes; n++)
        picture->data[0][input_bits(input, 3) % (uint64_t)bytes] = input_byte(input);
    if (!has_code)
        for (int32_t n = 0; n < bytes && input->left > 0; n++)
            picture->data[0][n] = input_byte(input);
    return has_code && changes == 0;
}

static void check(const picture_t *picture, const frame_tag_t *tag, bool has_code)
{
    const frame_tag_t untouched = {1, 2, 9};
    frame_tag_t found = untouched;
    const frame_tag_status_t status = frame_tag_decode(&found, picture);
    if (status != FRAME_TAG_OK) {
        fuzz_check(!has_code, "what was painted is read");
        fuzz_check(same(&found, &untouched), "nothing is written unless it is whole");
        return;
    }
    fuzz_check(found.viewer < FRAME_TAG_VIEWERS, "the viewer is one of four");
    fuzz_check(!has_code || same(&found, tag), "what is read is what was painted");
    frame_tag_t again = untouched;
    if (painted(picture, &found)) {
        fuzz_check(frame_tag_decode(&again, picture) == FRAME_TAG_OK, "what was read can be painted and read");
        fuzz_check(same(&again, &found), "it stays the same");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    const uint8_t kind = input_byte(&input);
    const bool large = (kind & 2) != 0;
    picture_t picture = {.format = (picture_format_t)input_range(&input, 0, PICTURE_FORMATS - 1),
                         .width = large ? LARGE_WIDTH : input_range(&input, 0, MAX_WIDTH),
                         .height = large ? LARGE_HEIGHT : input_range(&input, 0, MAX_HEIGHT)};
    picture.stride[0] = picture.width * pixel_bytes[picture.format];
    picture.stride[1] = picture.width;
    const size_t bytes = (size_t)picture.stride[0] * (size_t)picture.height;
    picture.data[0] = calloc(1, bytes);
    if (picture.data[0] == NULL)
        abort();
    frame_tag_t tag = {0, 0, 0};
    bool has_code = false;
    if (bytes > 0)
        has_code = fill(&picture, &input, &tag, (kind & 1) != 0);
    check(&picture, &tag, has_code);
    free(picture.data[0]);
    return 0;
}
