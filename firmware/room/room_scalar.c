// SPDX-License-Identifier: Apache-2.0
// Single values of a room file: do they have the type asked for, and how to name them in a message.
#include "firmware/room/room_scalar.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SHOWN = 40, MAX_DIGITS = 18 };

static const char *text_of(const yaml_node_t *scalar)
{
    return (const char *)scalar->data.scalar.value;
}

static bool is_plain(const yaml_node_t *node)
{
    return node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

bool room_scalar_is_null(const yaml_node_t *node)
{
    static const char *const names[] = {"", "~", "null", "Null", "NULL"};
    if (node->type != YAML_SCALAR_NODE || !is_plain(node))
        return false;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(text_of(node), names[i]) == 0)
            return true;
    return false;
}

/* libcyaml would read 010 as 8 and 0x10 as 16. 18 digits fit 64 bits. */
static bool is_whole_number(const char *text)
{
    const char *digits = text[0] == '-' ? text + 1 : text;
    const size_t count = strspn(digits, "0123456789");
    return count > 0 && count <= MAX_DIGITS && digits[count] == '\0' && (count == 1 || digits[0] != '0');
}

/* strtod, which libcyaml uses, also takes nan, inf, hexadecimal and leading spaces. */
static bool is_number(const char *text)
{
    if (text[0] == '\0' || text[strspn(text, "+-.0123456789eE")] != '\0')
        return false;
    char *end = NULL;
    const double value = strtod(text, &end);
    return *end == '\0' && isfinite(value);
}

static bool is_one_of(const char *text, const cyaml_schema_value_t *schema)
{
    for (uint32_t i = 0; i < schema->enumeration.count; i++)
        if (strcmp(text, schema->enumeration.strings[i].str) == 0)
            return true;
    return false;
}

bool room_scalar_fits(const yaml_node_t *node, const cyaml_schema_value_t *schema)
{
    if (node->type != YAML_SCALAR_NODE || strlen(text_of(node)) != node->data.scalar.length)
        return false;
    const char *text = text_of(node);
    if (schema->type == CYAML_INT)
        return is_plain(node) && is_whole_number(text);
    if (schema->type == CYAML_FLOAT)
        return is_plain(node) && is_number(text);
    if (schema->type == CYAML_BOOL)
        return is_plain(node) && (strcmp(text, "true") == 0 || strcmp(text, "false") == 0);
    if (schema->type == CYAML_ENUM)
        return is_one_of(text, schema);
    return schema->type == CYAML_STRING;
}

room_phrase_t room_phrase_cut(const char *text)
{
    room_phrase_t phrase;
    size_t length = strlen(text);
    const bool whole = length <= MAX_SHOWN;
    if (!whole)
        for (length = MAX_SHOWN; length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80; length--)
            ;
    snprintf(phrase.text, sizeof phrase.text, "%.*s%s", (int)length, text, whole ? "" : "...");
    return phrase;
}

static room_phrase_t phrase_scalar(const yaml_node_t *node)
{
    if (strlen(text_of(node)) != node->data.scalar.length)
        return (room_phrase_t){"a text with a NUL character"};
    if (is_plain(node) && node->data.scalar.length == 0)
        return (room_phrase_t){"nothing"};
    room_phrase_t phrase;
    const room_phrase_t cut = room_phrase_cut(text_of(node));
    snprintf(phrase.text, sizeof phrase.text, is_plain(node) ? "'%.*s'" : "the text \"%.*s\"", MAX_SHOWN + 3, cut.text);
    return phrase;
}

room_phrase_t room_phrase_found(const yaml_node_t *node)
{
    if (node->type == YAML_SCALAR_NODE)
        return phrase_scalar(node);
    room_phrase_t phrase = {"keys and values"};
    if (node->type == YAML_SEQUENCE_NODE)
        snprintf(phrase.text, sizeof phrase.text, "a list of %td",
                 node->data.sequence.items.top - node->data.sequence.items.start);
    return phrase;
}

static void append(room_phrase_t *phrase, const char *separator, const char *name)
{
    const size_t used = strlen(phrase->text);
    snprintf(phrase->text + used, sizeof phrase->text - used, "%s%s", separator, name);
}

room_phrase_t room_phrase_keys(const cyaml_schema_field_t *fields)
{
    room_phrase_t phrase = {""};
    for (int f = 0; fields[f].key != NULL; f++)
        append(&phrase, f == 0 ? "" : ", ", fields[f].key);
    return phrase;
}

static room_phrase_t phrase_mapping(const cyaml_schema_value_t *schema)
{
    room_phrase_t phrase = {"the keys "};
    append(&phrase, "", room_phrase_keys(schema->mapping.fields).text);
    return phrase;
}

static room_phrase_t phrase_enum(const cyaml_schema_value_t *schema)
{
    room_phrase_t phrase = {"one of "};
    for (uint32_t i = 0; i < schema->enumeration.count; i++)
        append(&phrase, i == 0 ? "" : ", ", schema->enumeration.strings[i].str);
    return phrase;
}

static room_phrase_t phrase_list(const cyaml_schema_value_t *schema)
{
    room_phrase_t phrase;
    const uint32_t min = schema->sequence.min, max = schema->sequence.max;
    const bool nullable = (schema->flags & CYAML_FLAG_POINTER_NULL_STR) == CYAML_FLAG_POINTER_NULL_STR;
    if (min == max)
        snprintf(phrase.text, sizeof phrase.text, "a list of %u%s", min, nullable ? ", or null" : "");
    else if (max == CYAML_UNLIMITED)
        snprintf(phrase.text, sizeof phrase.text, "a list of %u or more", min);
    else
        snprintf(phrase.text, sizeof phrase.text, "a list of %u to %u", min, max);
    return phrase;
}

room_phrase_t room_phrase_expected(const cyaml_schema_value_t *schema)
{
    if (schema->type == CYAML_SEQUENCE || schema->type == CYAML_SEQUENCE_FIXED)
        return phrase_list(schema);
    if (schema->type == CYAML_ENUM)
        return phrase_enum(schema);
    if (schema->type == CYAML_INT)
        return (room_phrase_t){"a whole number"};
    if (schema->type == CYAML_FLOAT)
        return (room_phrase_t){"a finite number"};
    if (schema->type == CYAML_BOOL)
        return (room_phrase_t){"true or false"};
    if (schema->type == CYAML_MAPPING)
        return phrase_mapping(schema);
    return (room_phrase_t){"a text"};
}
