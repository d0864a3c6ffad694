// SPDX-License-Identifier: Apache-2.0
// What the kernel tells of vertical blanks: flips done, and blanks that were asked for.
#include "hal/linux/display_kms_events.h"

#include <stddef.h>
#include <string.h>
#include <unistd.h>
#include <xf86drm.h>

static const int64_t SECOND_NS = 1000000000;

/* The smallest event that is taken, so that no more than KMS_EVENTS fit the buffer. */
enum { EVENT_BYTES = sizeof(struct drm_event_vblank) };

_Static_assert(sizeof(struct drm_event_crtc_sequence) >= EVENT_BYTES, "the smallest event");

static kms_event_t from_flip(const uint8_t *bytes)
{
    struct drm_event_vblank flip;
    memcpy(&flip, bytes, sizeof flip);
    return (kms_event_t){flip.user_data, flip.tv_sec * SECOND_NS + flip.tv_usec * INT64_C(1000), flip.sequence};
}

static kms_event_t from_sequence(const uint8_t *bytes)
{
    struct drm_event_crtc_sequence blank;
    memcpy(&blank, bytes, sizeof blank);
    return (kms_event_t){blank.user_data, blank.time_ns, (uint32_t)blank.sequence};
}

int32_t kms_events_take(kms_event_t events[KMS_EVENTS], int card)
{
    uint8_t bytes[KMS_EVENTS * EVENT_BYTES];
    const ssize_t length = read(card, bytes, sizeof bytes);
    int32_t count = 0;
    struct drm_event header;
    for (ssize_t at = 0; at + (ssize_t)sizeof header <= length; at += header.length) {
        memcpy(&header, bytes + at, sizeof header);
        if (header.length < sizeof header || at + (ssize_t)header.length > length)
            break;
        if (header.type == DRM_EVENT_FLIP_COMPLETE && header.length >= sizeof(struct drm_event_vblank))
            events[count++] = from_flip(bytes + at);
        else if (header.type == DRM_EVENT_CRTC_SEQUENCE && header.length >= sizeof(struct drm_event_crtc_sequence))
            events[count++] = from_sequence(bytes + at);
    }
    return count;
}
