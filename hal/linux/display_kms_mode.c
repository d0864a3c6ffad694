// SPDX-License-Identifier: Apache-2.0
// Which of the modes that a projector offers is the room's.
#include "hal/linux/display_kms_mode.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "warp_fixed/image.h"

enum { ENTRY_LENGTH = 40, OMITTED_LENGTH = 6 /* ", ..." and its end */ };

static int64_t pixels(const drmModeModeInfo *mode)
{
    return (int64_t)mode->htotal * mode->vtotal;
}

/* 1000 kHz are 1 million times the clock's unit in millihertz: below 2^32 * 10^6, fits. */
int32_t kms_mode_millihertz(const drmModeModeInfo *mode)
{
    return pixels(mode) == 0 ? 0 : (int32_t)((mode->clock * INT64_C(1000000) + pixels(mode) / 2) / pixels(mode));
}

int64_t kms_mode_period_ns(const drmModeModeInfo *mode)
{
    return mode->clock == 0 ? 0 : (pixels(mode) * 1000000 + mode->clock / 2) / mode->clock;
}

static bool is_progressive(const drmModeModeInfo *mode)
{
    return (mode->flags & (DRM_MODE_FLAG_INTERLACE | DRM_MODE_FLAG_DBLSCAN)) == 0 && mode->vscan <= 1;
}

static bool has_size(const drmModeModeInfo *mode, int32_t width, int32_t height)
{
    return mode->hdisplay == width && mode->vdisplay == height;
}

static kms_mode_wanted_t wanted_of(const drmModeModeInfo *mode)
{
    return (kms_mode_wanted_t){mode->hdisplay, mode->vdisplay, kms_mode_millihertz(mode), 1000};
}

int32_t kms_mode_choose(const drmModeModeInfo *modes, int32_t count, const kms_mode_wanted_t *wanted)
{
    const int64_t rate = INT64_C(1000) * wanted->refresh_frames / wanted->refresh_seconds;
    int64_t best_off = rate / KMS_RATE_TOLERANCE + 1;
    int32_t best = KMS_NO_MODE;
    for (int32_t i = 0; i < count; i++) {
        const drmModeModeInfo *mode = &modes[i];
        const int64_t off = llabs(kms_mode_millihertz(mode) - rate);
        const bool preferred = off == best_off && best != KMS_NO_MODE && (mode->type & DRM_MODE_TYPE_PREFERRED) != 0 &&
                               (modes[best].type & DRM_MODE_TYPE_PREFERRED) == 0;
        if (!has_size(mode, wanted->width, wanted->height) || !is_progressive(mode) || (off >= best_off && !preferred))
            continue;
        best_off = off;
        best = i;
    }
    return best;
}

static int64_t area(const drmModeModeInfo *mode)
{
    return (int64_t)mode->hdisplay * mode->vdisplay;
}

kms_mode_wanted_t kms_mode_preferred(const drmModeModeInfo *modes, int32_t count)
{
    const drmModeModeInfo *best = NULL;
    for (int32_t i = 0; i < count; i++) {
        const drmModeModeInfo *mode = &modes[i];
        if (!is_progressive(mode) || mode->hdisplay > IMAGE_MAX_WIDTH || mode->vdisplay > IMAGE_MAX_HEIGHT)
            continue;
        if ((mode->type & DRM_MODE_TYPE_PREFERRED) != 0)
            return wanted_of(mode);
        if (best == NULL || area(mode) > area(best))
            best = mode;
    }
    return best == NULL ? (kms_mode_wanted_t){640, 480, 60, 1} : wanted_of(best);
}

/* The rate as people write it: 60, 59.94. */
static void write_rate(char text[ENTRY_LENGTH], const drmModeModeInfo *mode)
{
    const int32_t hundredths = (kms_mode_millihertz(mode) + 5) / 10;
    if (hundredths % 100 == 0)
        (void)snprintf(text, ENTRY_LENGTH, " %d", hundredths / 100);
    else
        (void)snprintf(text, ENTRY_LENGTH, " %d.%02d", hundredths / 100, hundredths % 100);
}

/* Is there one like it, for people, among the modes before? */
static bool is_repeated(const drmModeModeInfo *modes, int32_t index, bool same_rate)
{
    const int32_t rate = (kms_mode_millihertz(&modes[index]) + 5) / 10;
    for (int32_t i = 0; i < index; i++)
        if (is_progressive(&modes[i]) && has_size(&modes[i], modes[index].hdisplay, modes[index].vdisplay) &&
            (!same_rate || (kms_mode_millihertz(&modes[i]) + 5) / 10 == rate))
            return true;
    return false;
}

/* @return false when it does not fit any more; the text then ends with "...". */
static bool append(char *text, size_t size, const char *entry)
{
    const size_t length = strlen(text);
    const bool fits = length + strlen(entry) + OMITTED_LENGTH <= size;
    (void)snprintf(text + length, size - length, "%s", fits ? entry : length == 0 ? "..." : ", ...");
    return fits;
}

/* All rates of the size that the mode at an index has. @return As append(). */
static bool append_size(char *text, size_t size, const drmModeModeInfo *modes, int32_t count, int32_t first)
{
    char entry[ENTRY_LENGTH];
    (void)snprintf(entry, sizeof entry, "%s%dx%d at", text[0] == '\0' ? "" : ", ", modes[first].hdisplay,
                   modes[first].vdisplay);
    bool fits = append(text, size, entry);
    for (int32_t i = first; i < count && fits; i++) {
        if (!is_progressive(&modes[i]) || !has_size(&modes[i], modes[first].hdisplay, modes[first].vdisplay) ||
            is_repeated(modes, i, true))
            continue;
        write_rate(entry, &modes[i]);
        fits = append(text, size, entry);
    }
    return fits;
}

void kms_mode_list(char *text, size_t size, const drmModeModeInfo *modes, int32_t count,
                   const kms_mode_wanted_t *wanted)
{
    bool fits = true;
    text[0] = '\0';
    for (int pass = 0; pass < 2; pass++)
        for (int32_t i = 0; i < count && fits; i++)
            if (is_progressive(&modes[i]) && !is_repeated(modes, i, false) &&
                has_size(&modes[i], wanted->width, wanted->height) == (pass == 0))
                fits = append_size(text, size, modes, count, i);
}
