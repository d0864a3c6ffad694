// SPDX-License-Identifier: Apache-2.0
// An atomic request to the kernel's mode setting: values of properties, made and sent without the heap.
#include "hal/linux/display_kms_request.h"

#include <errno.h>
#include <string.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

void kms_request_add(kms_request_t *request, uint32_t object, uint32_t property, uint64_t value)
{
    if (property == 0)
        return;
    if (request->count < KMS_REQUEST_VALUES) {
        request->object[request->count] = object;
        request->property[request->count] = property;
        request->value[request->count] = value;
    }
    request->count++;
}

int kms_request_commit(const kms_request_t *request, int card, uint32_t flags, uint64_t token)
{
    uint32_t objects[KMS_REQUEST_VALUES], counts[KMS_REQUEST_VALUES], object_count = 0;
    if (request->count > KMS_REQUEST_VALUES)
        return ENOSPC;
    for (int32_t i = 0; i < request->count; i++) {
        if (i == 0 || request->object[i] != request->object[i - 1]) {
            objects[object_count] = request->object[i];
            counts[object_count++] = 0;
        }
        counts[object_count - 1]++;
    }
    struct drm_mode_atomic atomic = {
        .flags = flags,
        .count_objs = object_count,
        .objs_ptr = (uintptr_t)objects,
        .count_props_ptr = (uintptr_t)counts,
        .props_ptr = (uintptr_t)request->property,
        .prop_values_ptr = (uintptr_t)request->value,
        .user_data = token,
    };
    return drmIoctl(card, DRM_IOCTL_MODE_ATOMIC, &atomic) == 0 ? 0 : errno;
}

uint32_t kms_property(int card, uint32_t object, uint32_t type, const char *name, uint64_t *value)
{
    uint32_t found = 0;
    drmModeObjectProperties *properties = drmModeObjectGetProperties(card, object, type);
    for (uint32_t i = 0; properties != NULL && i < properties->count_props && found == 0; i++) {
        drmModePropertyRes *property = drmModeGetProperty(card, properties->props[i]);
        if (property != NULL && strcmp(property->name, name) == 0) {
            found = property->prop_id;
            if (value != NULL)
                *value = properties->prop_values[i];
        }
        drmModeFreeProperty(property);
    }
    drmModeFreeObjectProperties(properties);
    return found;
}

void kms_request_add_present(kms_request_t *request, int card, uint32_t object, uint32_t type, const char *name)
{
    uint64_t value = 0;
    const uint32_t property = kms_property(card, object, type, name, &value);
    kms_request_add(request, object, property, value);
}

int64_t kms_enum_value(int card, uint32_t property, const char *name)
{
    int64_t value = -1;
    drmModePropertyRes *found = drmModeGetProperty(card, property);
    for (int i = 0; found != NULL && i < found->count_enums; i++)
        if (strcmp(found->enums[i].name, name) == 0)
            value = (int64_t)found->enums[i].value;
    drmModeFreeProperty(found);
    return value;
}

uint32_t kms_blob_copy(int card, uint64_t blob)
{
    uint32_t copy = 0;
    drmModePropertyBlobRes *found = blob == 0 ? NULL : drmModeGetPropertyBlob(card, (uint32_t)blob);
    if (found != NULL && drmModeCreatePropertyBlob(card, found->data, found->length, &copy) != 0)
        copy = 0;
    drmModeFreePropertyBlob(found);
    return copy;
}
