// SPDX-License-Identifier: Apache-2.0
// Writes what a card scans out, as a PPM, whoever shows it: the framebuffer of its first plane that is on. For displays
// that can't be seen from outside. For root, and XRGB8888.
#include <drm_fourcc.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

/* @return The framebuffer of the first plane that is on, or 0. */
static uint32_t find_framebuffer(int card)
{
    uint32_t framebuffer = 0;
    drmModePlaneRes *planes = drmModeGetPlaneResources(card);
    for (uint32_t i = 0; planes != NULL && i < planes->count_planes && framebuffer == 0; i++) {
        drmModePlane *plane = drmModeGetPlane(card, planes->planes[i]);
        framebuffer = plane == NULL ? 0 : plane->fb_id;
        drmModeFreePlane(plane);
    }
    drmModeFreePlaneResources(planes);
    return framebuffer;
}

static int write_ppm(const drmModeFB2 *framebuffer, const uint8_t *pixels)
{
    printf("P6\n%u %u\n255\n", framebuffer->width, framebuffer->height);
    for (uint32_t y = 0; y < framebuffer->height; y++)
        for (uint32_t x = 0; x < framebuffer->width; x++) {
            const uint8_t *pixel = pixels + (size_t)framebuffer->pitches[0] * y + 4 * (size_t)x;
            putchar(pixel[2]);
            putchar(pixel[1]);
            putchar(pixel[0]);
        }
    return fflush(stdout) == 0 ? 0 : 1;
}

int main(int argc, char **argv)
{
    const int card = argc == 2 ? open(argv[1], O_RDWR | O_CLOEXEC) : -1;
    if (card < 0 || drmSetClientCap(card, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) != 0) {
        fputs("usage: probe_scanout /dev/dri/cardN\n", stderr);
        return 2;
    }
    drmModeFB2 *framebuffer = drmModeGetFB2(card, find_framebuffer(card));
    uint64_t offset;
    if (framebuffer == NULL || framebuffer->pixel_format != DRM_FORMAT_XRGB8888 || framebuffer->handles[0] == 0 ||
        drmModeMapDumbBuffer(card, framebuffer->handles[0], &offset) != 0) {
        fputs("probe_scanout: nothing to be seen: no framebuffer of XRGB8888, or not root\n", stderr);
        return 1;
    }
    const size_t bytes = (size_t)framebuffer->pitches[0] * framebuffer->height;
    const void *pixels = mmap(NULL, bytes, PROT_READ, MAP_SHARED, card, (off_t)offset);
    if (pixels == MAP_FAILED) {
        perror("probe_scanout");
        return 1;
    }
    return write_ppm(framebuffer, pixels);
}
