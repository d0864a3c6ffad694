// SPDX-License-Identifier: Apache-2.0
// An atomic request to the kernel's mode setting: values of properties, made and sent without the heap.
#ifndef HAL_LINUX_DISPLAY_KMS_REQUEST_H
#define HAL_LINUX_DISPLAY_KMS_REQUEST_H

#include <stdint.h>

enum { KMS_REQUEST_VALUES = 96 };

/** Start with all bytes zero. */
typedef struct {
    int32_t count;
    uint32_t object[KMS_REQUEST_VALUES], property[KMS_REQUEST_VALUES];
    uint64_t value[KMS_REQUEST_VALUES];
} kms_request_t;

/** Add a value. Property 0 is one that the driver does not have: nothing is added. */
void kms_request_add(kms_request_t *request, uint32_t object, uint32_t property, uint64_t value);

/**
 * Send a request: all of it is done, or nothing.
 *
 * @param flags  Of DRM_IOCTL_MODE_ATOMIC.
 * @param token  Comes back as the user_data of its event, if there is one.
 * @return 0, or the errno of the refusal; ENOSPC when more than KMS_REQUEST_VALUES were added.
 */
int kms_request_commit(const kms_request_t *request, int card, uint32_t flags, uint64_t token);

/**
 * Find a property of an object. Uses the heap.
 *
 * @param      type   DRM_MODE_OBJECT_...
 * @param[out] value  Its present value, written when it is there; NULL is allowed.
 * @return Its id; 0 when the object has none of that name.
 */
uint32_t kms_property(int card, uint32_t object, uint32_t type, const char *name, uint64_t *value);

/** Add a property's present value, when the object has it. Uses the heap. */
void kms_request_add_present(kms_request_t *request, int card, uint32_t object, uint32_t type, const char *name);

/** @return The value of an enumeration's name, or -1 when it has none of that name. Uses the heap. */
int64_t kms_enum_value(int card, uint32_t property, const char *name);

/** @return A copy of a blob, for the caller to destroy; 0 when there is none of that id, or no memory. */
uint32_t kms_blob_copy(int card, uint64_t blob);

#endif
