// SPDX-License-Identifier: Apache-2.0
// Copies of the part of a picture that the windows of a patch read, continued by mirroring and laid out for the loop.
#include "warp_fixed/window_copy_neon.h"

#include <string.h>

#include "warp_fixed/fixed.h"

enum { STRIP_VECTORS = 4 };

/* The same bytes of each row; vectors overlap at the end. */
static void copy_rows(uint8_t *to, const uint8_t *const *row, int32_t rows, int32_t first, int32_t bytes)
{
    for (int32_t v = 0; v < rows; v++, to += COPY_STRIDE) {
        const uint8_t *from = row[v] + first;
        if (bytes < COPY_VECTOR) {
            memcpy(to, from, (size_t)bytes);
            continue;
        }
        for (int32_t i = 0; i < bytes - COPY_VECTOR; i += COPY_VECTOR)
            vst1q_u8(to + i, vld1q_u8(from + i));
        vst1q_u8(to + bytes - COPY_VECTOR, vld1q_u8(from + bytes - COPY_VECTOR));
    }
}

NEON_INLINE void copy_texels_of(uint8_t *to, const uint8_t *const *row, int32_t rows, int32_t first, size_t bytes)
{
    for (int32_t v = 0; v < rows; v++, to += COPY_STRIDE)
        memcpy(to, row[v] + first, bytes);
}

/* One texel of each row. */
static void copy_column(uint8_t *to, const uint8_t *const *row, int32_t rows, int32_t first, int32_t bytes)
{
    if (bytes == 1)
        copy_texels_of(to, row, rows, first, 1);
    else if (bytes == 2)
        copy_texels_of(to, row, rows, first, 2);
    else if (bytes == 4)
        copy_texels_of(to, row, rows, first, 4);
    else
        copy_texels_of(to, row, rows, first, 8);
}

/* Copy that part of the picture, and its mirror images where it reaches beyond. Apart from its callers, whose loops
 * need the registers. */
static __attribute__((noinline)) void copy_mirrored(uint8_t *to, const texels_t *from, reach_t x, reach_t y)
{
    const int32_t bytes = from->texel_bytes, rows = y.end - y.begin;
    const int32_t first = clamp_i32(0, x.begin, x.end), last = clamp_i32(from->width, first, x.end);
    const uint8_t *row[COPY_ROWS];
    for (int32_t v = 0; v < rows; v++)
        row[v] = from->data + mirror_index(y.begin + v, from->height) * from->stride;
    for (int32_t u = x.begin; u < first; u++)
        copy_column(to + (u - x.begin) * bytes, row, rows, mirror_index(u, from->width) * bytes, bytes);
    copy_rows(to + (first - x.begin) * bytes, row, rows, first * bytes, (last - first) * bytes);
    for (int32_t u = last; u < x.end; u++)
        copy_column(to + (u - x.begin) * bytes, row, rows, mirror_index(u, from->width) * bytes, bytes);
}

/* Rows of so many vectors, less 128. May be in place. */
NEON_INLINE void centre_strip(uint8_t *to, const uint8_t *from, ptrdiff_t stride, int32_t rows, int vectors)
{
    for (int32_t v = 0; v < rows; v++, to += COPY_STRIDE, from += stride)
        for (int i = 0; i < vectors; i++)
            vst1q_u8(to + COPY_VECTOR * i, veorq_u8(vld1q_u8(from + COPY_VECTOR * i), vdupq_n_u8(128)));
}

/* Columns of cache lines, one after the other. */
static void centre(uint8_t *to, const uint8_t *from, ptrdiff_t stride, int32_t rows, int32_t vectors)
{
    for (; vectors >= STRIP_VECTORS; vectors -= STRIP_VECTORS) {
        centre_strip(to, from, stride, rows, STRIP_VECTORS);
        to += STRIP_VECTORS * COPY_VECTOR;
        from += STRIP_VECTORS * COPY_VECTOR;
    }
    if (vectors == 3)
        centre_strip(to, from, stride, rows, 3);
    else if (vectors == 2)
        centre_strip(to, from, stride, rows, 2);
    else if (vectors == 1)
        centre_strip(to, from, stride, rows, 1);
}

/* On an A72, st2 takes as long as two stores, and zip of long vectors three micro-operations each. */
NEON_INLINE void store_in_turn(uint8_t *to, uint8x16_t a, uint8x16_t b)
{
#ifdef __aarch64__
    vst2q_u8(to, ((uint8x16x2_t){{a, b}}));
#else
    vst1q_u8(to, vzip1q_u8(a, b));
    vst1q_u8(to + COPY_VECTOR, vzip2q_u8(a, b));
#endif
}

/* How rows become pairs. */
typedef struct {
    int step; /* rows from pair to pair */
    bool centred;
} pairing_t;

NEON_INLINE uint8x16_t load_for_pair(const uint8_t *from, pairing_t how)
{
    return how.centred ? veorq_u8(vld1q_u8(from), vdupq_n_u8(128)) : vld1q_u8(from);
}

/* Rows of so many vectors, each byte followed by the one below. */
NEON_INLINE void pair_strip(uint8_t *to, const uint8_t *from, ptrdiff_t stride, int32_t rows, pairing_t how,
                            int vectors)
{
    uint8x16_t above[STRIP_VECTORS];
    for (int i = 0; i < vectors; i++)
        above[i] = load_for_pair(from + COPY_VECTOR * i, how);
    for (int32_t next = 1; next < rows; next += how.step, to += COPY_STRIDE, from += how.step * stride)
        for (int i = 0; i < vectors; i++) {
            if (how.step == 2)
                above[i] = load_for_pair(from + COPY_VECTOR * i, how);
            const uint8x16_t below = load_for_pair(from + stride + COPY_VECTOR * i, how);
            store_in_turn(to + 2 * COPY_VECTOR * i, above[i], below);
            above[i] = below;
        }
}

NEON_INLINE void pair(uint8_t *to, const uint8_t *from, ptrdiff_t stride, int32_t rows, pairing_t how, int32_t vectors)
{
    for (; vectors >= STRIP_VECTORS; vectors -= STRIP_VECTORS) {
        pair_strip(to, from, stride, rows, how, STRIP_VECTORS);
        to += 2 * STRIP_VECTORS * COPY_VECTOR;
        from += STRIP_VECTORS * COPY_VECTOR;
    }
    if (vectors == 3)
        pair_strip(to, from, stride, rows, how, 3);
    else if (vectors == 2)
        pair_strip(to, from, stride, rows, how, 2);
    else if (vectors == 1)
        pair_strip(to, from, stride, rows, how, 1);
}

static void pair_by(pairing_t how, uint8_t *to, const uint8_t *from, ptrdiff_t stride, int32_t rows, int32_t vectors)
{
    if (!how.centred)
        pair(to, from, stride, rows, (pairing_t){1, false}, vectors);
    else if (how.step == 1)
        pair(to, from, stride, rows, (pairing_t){1, true}, vectors);
    else
        pair(to, from, stride, rows, (pairing_t){2, true}, vectors);
}

/* Where a copy can be made from without mirroring: rows of the picture in which whole vectors can be read. */
static bool copies_picture(const texels_t *texels, reach_t x, reach_t y)
{
    const int32_t end = x.begin * texels->texel_bytes + copy_vectors(texels, x) * COPY_VECTOR;
    return x.begin >= 0 && end <= texels->width * texels->texel_bytes && reach_is_inside(y, texels->height);
}

static const uint8_t *texel_of(const texels_t *texels, reach_t x, reach_t y)
{
    return texels->data + y.begin * texels->stride + x.begin * texels->texel_bytes;
}

static void copy_centred(uint8_t *copy, const texels_t *texels, reach_t x, reach_t y)
{
    const int32_t vectors = copy_vectors(texels, x), rows = y.end - y.begin;
    if (copies_picture(texels, x, y)) {
        centre(copy, texel_of(texels, x, y), texels->stride, rows, vectors);
    } else {
        copy_mirrored(copy, texels, x, y);
        centre(copy, copy, COPY_STRIDE, rows, vectors);
    }
}

/* From the right halves of the copy's own rows, at the worst: no byte is written before it was read. */
static void copy_paired(uint8_t *copy, const texels_t *texels, pairing_t how, reach_t x, reach_t y)
{
    const int32_t vectors = copy_vectors(texels, x), rows = y.end - y.begin;
    if (copies_picture(texels, x, y)) {
        pair_by(how, copy, texel_of(texels, x, y), texels->stride, rows, vectors);
    } else {
        copy_mirrored(copy + COPY_STRIDE / 2, texels, x, y);
        pair_by(how, copy, copy + COPY_STRIDE / 2, COPY_STRIDE, rows, vectors);
    }
}

void copy_texels(uint8_t *copy, const texels_t *texels, const patch_loop_t *loop, reach_t x, reach_t y)
{
    if (loop->pair_step != 0)
        copy_paired(copy, texels, (pairing_t){loop->pair_step, loop->centred}, x, y);
    else if (loop->centred)
        copy_centred(copy, texels, x, y);
    else
        copy_mirrored(copy, texels, x, y);
}
