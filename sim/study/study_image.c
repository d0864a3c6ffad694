// SPDX-License-Identifier: Apache-2.0
// The pictures of the study: photographs kept in the program, and made ones.
#include <png.h>
#include <stdlib.h>

#include "sim/files/gray_image.h"
#include "sim/files/pixel.h"
#include "sim/rng.h"
#include "sim/study/study_image.h"

/* sim/study/study_files.S */
extern const uint8_t study_studio[], study_studio_end[], study_astronaut[], study_astronaut_end[], study_coffee[],
    study_coffee_end[];

enum { FIELD_PX = 8, NOISE_SEED = 3 };

const char *study_image_name(study_image_t image)
{
    static const char *const names[STUDY_IMAGES] = {"studio", "astronaut", "coffee", "checkerboard", "noise"};
    return names[image];
}

static bool decode(image_t *luma, const uint8_t *begin, const uint8_t *end)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (png_image_begin_read_from_memory(&png, begin, (size_t)(end - begin)) == 0)
        return false;
    png.format = PNG_FORMAT_RGB;
    const size_t pixels = (size_t)png.width * png.height;
    uint8_t *rgb = malloc(pixels * 3);
    const bool made = rgb != NULL && gray_image(luma, (int32_t)png.width, (int32_t)png.height);
    const bool read = made && png_image_finish_read(&png, NULL, rgb, 0, NULL) != 0;
    for (size_t n = 0; read && n < pixels; n++)
        luma->data[n] = luma_from_rgb(rgb[3 * n], rgb[3 * n + 1], rgb[3 * n + 2]);
    if (made && !read)
        free(luma->data);
    png_image_free(&png);
    free(rgb);
    return read;
}

static bool photograph(study_image_t which, const image_t *out)
{
    const struct {
        const uint8_t *begin, *end;
    } file[] = {[STUDY_STUDIO] = {study_studio, study_studio_end},
                [STUDY_ASTRONAUT] = {study_astronaut, study_astronaut_end},
                [STUDY_COFFEE] = {study_coffee, study_coffee_end}};
    image_t luma;
    if (!decode(&luma, file[which].begin, file[which].end))
        return false;
    const int32_t by_width = luma.width / out->width, by_height = luma.height / out->height;
    const int32_t factor = by_width < by_height ? by_width : by_height;
    if (factor >= 1)
        gray_image_means(out, &luma, factor);
    free(luma.data);
    return factor >= 1;
}

static void checkerboard(const image_t *out, int32_t field_px)
{
    for (int32_t y = 0; y < out->height; y++)
        for (int32_t x = 0; x < out->width; x++)
            image_row(out, y)[x] = (x / field_px + y / field_px) % 2 == 0 ? 0 : 255;
}

static void noise(const image_t *out)
{
    rng_t rng = {NOISE_SEED};
    for (int32_t y = 0; y < out->height; y++)
        for (int32_t x = 0; x < out->width; x++)
            image_row(out, y)[x] = (uint8_t)(rng_next(&rng) >> 56);
}

bool study_image(study_image_t image, int32_t width, int32_t height, int32_t factor, image_t *picture,
                 image_t *original)
{
    image_t fine, coarse;
    if (width * factor > IMAGE_MAX_WIDTH || height * factor > IMAGE_MAX_HEIGHT ||
        !gray_image(&fine, width * factor, height * factor))
        return false;
    bool made = true;
    if (image == STUDY_CHECKERBOARD)
        checkerboard(&fine, FIELD_PX * factor);
    else if (image == STUDY_NOISE)
        noise(&fine);
    else
        made = photograph(image, &fine);
    if (!made || !gray_image(&coarse, width, height)) {
        free(fine.data);
        return false;
    }
    gray_image_means(&coarse, &fine, factor);
    *picture = coarse;
    if (original != NULL)
        *original = fine;
    else
        free(fine.data);
    return true;
}
