// SPDX-License-Identifier: Apache-2.0
// CBOR -> the values that jansson makes of JSON, so that one reader serves both.
#include "sim/trackers/cbor_json.h"

#include <stdbool.h>

#include <cbor.h>

/* A map or an array that is not complete yet. */
typedef struct {
    json_t *container; /* borrowed: the root owns it */
    bool endless;      /* ends with a break, not by count */
    size_t left;       /* items to come, keys and values counted alike */
    const char *key;   /* in the bytes; NULL when a key is due */
    size_t key_length;
} level_t;

typedef struct {
    json_t *root;
    level_t level[CBOR_JSON_MAX_DEPTH];
    int depth;
    bool failed;
} builder_t;

static level_t *innermost(builder_t *builder)
{
    return builder->depth == 0 ? NULL : &builder->level[builder->depth - 1];
}

static void close_full(builder_t *builder)
{
    while (builder->depth > 0 && !innermost(builder)->endless && innermost(builder)->left == 0)
        builder->depth--;
}

/* Takes the value over, also when it is refused. Does not close what is full: a container put last is still to open. */
static bool put(builder_t *builder, json_t *value)
{
    level_t *level = innermost(builder);
    bool good = value != NULL && !builder->failed;
    if (good && level == NULL) {
        good = builder->root == NULL;
        if (good)
            builder->root = value;
    } else if (good && json_is_array(level->container)) {
        good = json_array_append_new(level->container, value) == 0;
        value = good ? value : NULL;
    } else if (good) {
        good = level->key != NULL && json_object_getn(level->container, level->key, level->key_length) == NULL;
        if (good) {
            good = json_object_setn_new(level->container, level->key, level->key_length, value) == 0;
            value = good ? value : NULL; /* the call has taken it, even when it failed */
        }
        level->key = NULL;
    }
    if (!good) {
        json_decref(value);
        builder->failed = true;
        return false;
    }
    if (level != NULL)
        level->left--;
    return true;
}

static void put_scalar(void *context, json_t *value)
{
    builder_t *builder = context;
    if (put(builder, value))
        close_full(builder);
}

static void open_container(builder_t *builder, json_t *container, bool endless, size_t items)
{
    if (!put(builder, container))
        return;
    if (builder->depth == CBOR_JSON_MAX_DEPTH) {
        builder->failed = true;
        return;
    }
    builder->level[builder->depth++] = (level_t){.container = container, .endless = endless, .left = items};
    close_full(builder);
}

static void hear_whole(void *context, uint64_t value)
{
    put_scalar(context, value > INT64_MAX ? NULL : json_integer((json_int_t)value));
}

static void hear_whole8(void *context, uint8_t value)
{
    hear_whole(context, value);
}

static void hear_whole16(void *context, uint16_t value)
{
    hear_whole(context, value);
}

static void hear_whole32(void *context, uint32_t value)
{
    hear_whole(context, value);
}

/* The value is -1 - n. */
static void hear_negative(void *context, uint64_t n)
{
    put_scalar(context, n > INT64_MAX ? NULL : json_integer(-1 - (json_int_t)n));
}

static void hear_negative8(void *context, uint8_t n)
{
    hear_negative(context, n);
}

static void hear_negative16(void *context, uint16_t n)
{
    hear_negative(context, n);
}

static void hear_negative32(void *context, uint32_t n)
{
    hear_negative(context, n);
}

static void hear_double(void *context, double value)
{
    put_scalar(context, json_real(value)); /* NULL when it is not finite */
}

static void hear_float(void *context, float value)
{
    hear_double(context, (double)value);
}

static void hear_bool(void *context, bool value)
{
    put_scalar(context, json_boolean(value));
}

static void hear_null(void *context)
{
    put_scalar(context, json_null());
}

static void hear_text(void *context, cbor_data text, size_t length)
{
    builder_t *builder = context;
    level_t *level = innermost(builder);
    if (level == NULL || !json_is_object(level->container) || level->key != NULL) {
        put_scalar(builder, json_stringn((const char *)text, length));
        return;
    }
    level->key = (const char *)text;
    level->key_length = length;
    level->left--;
}

static void hear_map(void *context, size_t pairs)
{
    if (pairs > SIZE_MAX / 2)
        put_scalar(context, NULL);
    else
        open_container(context, json_object(), false, 2 * pairs);
}

static void hear_endless_map(void *context)
{
    open_container(context, json_object(), true, 0);
}

static void hear_array(void *context, size_t items)
{
    open_container(context, json_array(), false, items);
}

static void hear_endless_array(void *context)
{
    open_container(context, json_array(), true, 0);
}

static void hear_break(void *context)
{
    builder_t *builder = context;
    level_t *level = innermost(builder);
    if (level == NULL || !level->endless || level->key != NULL) {
        builder->failed = true;
        return;
    }
    builder->depth--;
    close_full(builder);
}

static void pass_over_tag(void *context, uint64_t tag)
{
    (void)context;
    (void)tag;
}

static void refuse(void *context)
{
    put_scalar(context, NULL);
}

static void refuse_bytes(void *context, cbor_data bytes, size_t length)
{
    (void)bytes;
    (void)length;
    put_scalar(context, NULL);
}

json_t *cbor_json_read(const uint8_t *bytes, size_t size)
{
    static const struct cbor_callbacks callbacks = {
        .uint8 = hear_whole8,
        .uint16 = hear_whole16,
        .uint32 = hear_whole32,
        .uint64 = hear_whole,
        .negint8 = hear_negative8,
        .negint16 = hear_negative16,
        .negint32 = hear_negative32,
        .negint64 = hear_negative,
        .byte_string_start = refuse,
        .byte_string = refuse_bytes,
        .string = hear_text,
        .string_start = refuse,
        .indef_array_start = hear_endless_array,
        .array_start = hear_array,
        .indef_map_start = hear_endless_map,
        .map_start = hear_map,
        .tag = pass_over_tag,
        .float2 = hear_float,
        .float4 = hear_float,
        .float8 = hear_double,
        .undefined = refuse,
        .null = hear_null,
        .boolean = hear_bool,
        .indef_break = hear_break,
    };
    builder_t builder = {.root = NULL};
    size_t at = 0;
    while (at < size && !builder.failed && (builder.root == NULL || builder.depth > 0)) {
        const struct cbor_decoder_result item = cbor_stream_decode(bytes + at, size - at, &callbacks, &builder);
        if (item.status != CBOR_DECODER_FINISHED)
            break;
        at += item.read; /* at least 1 */
    }
    if (!builder.failed && builder.root != NULL && builder.depth == 0 && at == size)
        return builder.root;
    json_decref(builder.root);
    return NULL;
}
