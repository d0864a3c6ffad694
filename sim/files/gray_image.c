// SPDX-License-Identifier: Apache-2.0
// GRAY8 pictures in memory of their own, and the means that make a picture of a finer one.
#include "sim/files/gray_image.h"

#include <stdlib.h>

bool gray_image(image_t *image, int32_t width, int32_t height)
{
    *image = (image_t){.data = calloc((size_t)height, (size_t)width),
                       .width = width,
                       .height = height,
                       .stride = width,
                       .format = IMAGE_GRAY8};
    return image->data != NULL;
}

static uint8_t mean_at(const image_t *image, int32_t x, int32_t y, int32_t factor)
{
    int32_t sum = 0;
    for (int32_t j = 0; j < factor; j++)
        for (int32_t i = 0; i < factor; i++)
            sum += image_row(image, y + j)[x + i];
    return (uint8_t)((2 * sum + factor * factor) / (2 * factor * factor));
}

void gray_image_means(const image_t *image, const image_t *finer, int32_t factor)
{
    const int32_t left = (finer->width - image->width * factor) / 2, top = (finer->height - image->height * factor) / 2;
    for (int32_t y = 0; y < image->height; y++)
        for (int32_t x = 0; x < image->width; x++)
            image_row(image, y)[x] = mean_at(finer, left + x * factor, top + y * factor, factor);
}
