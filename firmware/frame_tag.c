// SPDX-License-Identifier: Apache-2.0
// The code in a picture's top rows: found, checked, and cut off.
#include "firmware/frame_tag.h"

#include <stddef.h>

enum {
    SYNC_BLOCKS = 16,
    SYNC_WHITE = 8, /* of them; as many are black */
    SIDE_PX = 8,
    SMALL_SIDE_PX = 4,
    SMALL_BELOW_PX = 320,
    DATA_BYTES = 9,
    CRC_BYTES = 4
};

_Static_assert(SYNC_BLOCKS + 8 * (DATA_BYTES + CRC_BYTES) == FRAME_TAG_BLOCKS, "all blocks are used");

bool frame_tag_layout(frame_tag_layout_t *layout, int32_t width_px, int32_t height_px)
{
    const int32_t side_px = width_px < SMALL_BELOW_PX ? SMALL_SIDE_PX : SIDE_PX;
    const int32_t whole = width_px / side_px;
    if (whole < 1)
        return false;
    const int32_t columns = whole < FRAME_TAG_BLOCKS ? whole : FRAME_TAG_BLOCKS;
    const int32_t rows = (FRAME_TAG_BLOCKS + columns - 1) / columns;
    const int32_t hidden_px = rows * side_px + FRAME_TAG_MARGIN_PX;
    if (2 * hidden_px > height_px)
        return false;
    *layout = (frame_tag_layout_t){side_px, columns, rows, hidden_px};
    return true;
}

/* 0 to 255; of an RGB pixel with BT.601's weights, which JPEG has too. */
static int32_t luma_at(const picture_t *picture, int32_t x, int32_t y)
{
    const uint8_t *row = picture->data[0] + (ptrdiff_t)y * picture->stride[0];
    switch (picture->format) {
    case PICTURE_GRAY8:
    case PICTURE_NV12:
        return row[x];
    case PICTURE_YUYV:
        return row[2 * x];
    case PICTURE_UYVY:
        return row[2 * x + 1];
    case PICTURE_RGB888:
        return (29 * row[3 * x] + 150 * row[3 * x + 1] + 77 * row[3 * x + 2]) / 256;
    case PICTURE_BGR888:
        return (77 * row[3 * x] + 150 * row[3 * x + 1] + 29 * row[3 * x + 2]) / 256;
    case PICTURE_XRGB8888:
        return (29 * row[4 * x] + 150 * row[4 * x + 1] + 77 * row[4 * x + 2]) / 256;
    case PICTURE_FORMATS:
        break;
    }
    return 0;
}

/* Sums of luma over the middles of all blocks: at most 16 * 255 each. */
static void read_blocks(int32_t sum[FRAME_TAG_BLOCKS], const picture_t *picture, const frame_tag_layout_t *layout)
{
    const int32_t side = layout->side_px;
    for (int32_t block = 0; block < FRAME_TAG_BLOCKS; block++) {
        const int32_t left = block % layout->columns * side, top = block / layout->columns * side;
        sum[block] = 0;
        for (int32_t y = side / 4; y < side - side / 4; y++)
            for (int32_t x = side / 4; x < side - side / 4; x++)
                sum[block] += luma_at(picture, left + x, top + y);
    }
}

/* Are the first blocks there? @param[out] threshold  2 * SYNC_WHITE times the middle between black and white. */
static bool find_sync(int32_t *threshold, const int32_t sum[FRAME_TAG_BLOCKS], int32_t samples)
{
    int32_t level[2] = {0, 0};
    for (int block = 0; block < SYNC_BLOCKS; block++)
        level[FRAME_TAG_SYNC >> (SYNC_BLOCKS - 1 - block) & 1] += sum[block];
    if (level[1] - level[0] < FRAME_TAG_MIN_CONTRAST * SYNC_WHITE * samples)
        return false;
    *threshold = level[0] + level[1];
    int32_t read = 0;
    for (int block = 0; block < SYNC_BLOCKS; block++)
        read = read << 1 | (2 * SYNC_WHITE * sum[block] > *threshold);
    return read == FRAME_TAG_SYNC;
}

static uint32_t crc32_of(const uint8_t *bytes, int count)
{
    uint32_t crc = UINT32_MAX;
    for (int i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = (crc & 1) != 0 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    }
    return ~crc;
}

static uint32_t word_of(const uint8_t bytes[4])
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

frame_tag_status_t frame_tag_decode(frame_tag_t *tag, const picture_t *picture)
{
    frame_tag_layout_t layout;
    if (!picture_is_valid(picture) || !frame_tag_layout(&layout, picture->width, picture->height))
        return FRAME_TAG_NONE;
    int32_t sum[FRAME_TAG_BLOCKS], threshold;
    read_blocks(sum, picture, &layout);
    if (!find_sync(&threshold, sum, layout.side_px * layout.side_px / 4))
        return FRAME_TAG_NONE;

    uint8_t bytes[DATA_BYTES + CRC_BYTES] = {0};
    for (int bit = 0; bit < 8 * (DATA_BYTES + CRC_BYTES); bit++)
        if (2 * SYNC_WHITE * sum[SYNC_BLOCKS + bit] > threshold)
            bytes[bit / 8] |= (uint8_t)(0x80U >> bit % 8);
    if (crc32_of(bytes, DATA_BYTES) != word_of(bytes + DATA_BYTES))
        return FRAME_TAG_DAMAGED;
    const uint8_t version = bytes[0] >> 4, viewer = bytes[0] & 0xF;
    if (version != FRAME_TAG_VERSION || viewer >= FRAME_TAG_VIEWERS)
        return FRAME_TAG_FOREIGN;
    *tag = (frame_tag_t){word_of(bytes + 1), word_of(bytes + 5), viewer};
    return FRAME_TAG_OK;
}

bool frame_tag_is_of(const frame_tag_t *tag, uint8_t viewer, uint64_t capture_time_us, uint64_t wrap_us)
{
    return tag->viewer == viewer && tag->capture_time_us == capture_time_us % wrap_us;
}

picture_t frame_tag_picture_below(const picture_t *picture, int32_t rows_px)
{
    picture_t below = *picture;
    below.height -= rows_px;
    below.data[0] += (ptrdiff_t)rows_px * below.stride[0];
    if (below.format == PICTURE_NV12)
        below.data[1] += (ptrdiff_t)(rows_px / 2) * below.stride[1];
    return below;
}

camera_t frame_tag_camera_below(const camera_t *camera, int32_t rows_px)
{
    camera_t below = *camera;
    below.height -= rows_px;
    below.principal_upx[1] -= rows_px * INT64_C(1000000);
    return below;
}
