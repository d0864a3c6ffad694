// SPDX-License-Identifier: Apache-2.0
// Every value of a room file: its full name, its line, and whether it has the shape that the schema asks for.
#include "firmware/room/room_places.h"

#include <stdlib.h>
#include <string.h>

#include "firmware/room/room_scalar.h"

/* The deepest is the number in boards[0].wall.corners_mm[0][0]. */
enum { MAX_DEPTH = 8, MAX_KEYS = 16 };

static room_key_t key_of(const room_places_t *places, int32_t at)
{
    int32_t chain[MAX_DEPTH];
    int depth = 0;
    for (int32_t i = at; i > 0 && depth < MAX_DEPTH; i = places->place[i].parent)
        chain[depth++] = i;
    room_key_t key = {""};
    while (depth-- > 0) {
        const room_place_t *place = &places->place[chain[depth]];
        const room_key_t parent = key;
        if (place->key == NULL)
            key = room_key("%s[%d]", parent.text, place->index);
        else
            key = room_key("%s%s%s", parent.text, parent.text[0] == '\0' ? "" : ".", place->key);
    }
    return key;
}

static room_key_t key_within(const room_places_t *places, int32_t at, const char *key)
{
    const room_key_t parent = key_of(places, at);
    return room_key("%s%s%s", parent.text, parent.text[0] == '\0' ? "" : ".", key);
}

static bool refuse_place(const room_places_t *places, int32_t at, const room_report_t *report)
{
    const room_place_t *place = &places->place[at];
    const room_key_t key = key_of(places, at);
    const room_phrase_t found = room_phrase_found(place->node);
    const room_phrase_t expected = room_phrase_expected(place->schema);
    return room_refuse(report, place->line, at == 0 ? "file" : key.text, "found %s, expected %s", found.text,
                       expected.text);
}

/* Without aliases every node has one parent, so there are never more places than nodes. */
static void push(room_places_t *places, const room_place_t *place)
{
    if (places->count < places->capacity)
        places->place[places->count++] = *place;
}

static bool check_list(room_places_t *places, int32_t at, const room_report_t *report)
{
    const room_place_t list = places->place[at];
    if (list.node->type != YAML_SEQUENCE_NODE)
        return refuse_place(places, at, report);
    const yaml_node_item_t *begin = list.node->data.sequence.items.start;
    const ptrdiff_t count = list.node->data.sequence.items.top - begin;
    if (count < list.schema->sequence.min || count > list.schema->sequence.max)
        return refuse_place(places, at, report);
    for (int32_t i = 0; i < count; i++) {
        yaml_node_t *node = yaml_document_get_node(&places->document, begin[i]);
        push(places, &(room_place_t){node, list.schema->sequence.entry, node->start_mark.line + 1, at, NULL, i});
    }
    return true;
}

static int field_named(const cyaml_schema_field_t *fields, const yaml_node_t *key)
{
    if (key->type != YAML_SCALAR_NODE)
        return -1;
    for (int f = 0; fields[f].key != NULL; f++)
        if (strlen(fields[f].key) == key->data.scalar.length &&
            memcmp(fields[f].key, key->data.scalar.value, key->data.scalar.length) == 0)
            return f;
    return -1;
}

static bool refuse_key(const room_places_t *places, int32_t at, const yaml_node_t *key, const room_report_t *report)
{
    const size_t line = key->start_mark.line + 1;
    const room_phrase_t names = room_phrase_keys(places->place[at].schema->mapping.fields);
    if (key->type != YAML_SCALAR_NODE) {
        const room_key_t parent = key_of(places, at);
        return room_refuse(report, line, at == 0 ? "file" : parent.text,
                           "found a key that is no name, expected one of %s", names.text);
    }
    const room_phrase_t name = room_phrase_cut((const char *)key->data.scalar.value);
    const room_key_t full = key_within(places, at, name.text);
    return room_refuse(report, line, full.text, "unknown key, expected one of %s", names.text);
}

static bool check_missing(const room_places_t *places, int32_t at, const size_t line_of[MAX_KEYS],
                          const room_report_t *report)
{
    const cyaml_schema_field_t *fields = places->place[at].schema->mapping.fields;
    for (int f = 0; fields[f].key != NULL && f < MAX_KEYS; f++) {
        if (line_of[f] != 0 || (fields[f].value.flags & CYAML_FLAG_OPTIONAL) != 0)
            continue;
        const room_key_t key = key_within(places, at, fields[f].key);
        const room_phrase_t expected = room_phrase_expected(&fields[f].value);
        return room_refuse(report, places->place[at].line, key.text, "missing, expected %s", expected.text);
    }
    return true;
}

static bool check_mapping(room_places_t *places, int32_t at, const room_report_t *report)
{
    const room_place_t mapping = places->place[at];
    if (mapping.node->type != YAML_MAPPING_NODE)
        return refuse_place(places, at, report);
    const cyaml_schema_field_t *fields = mapping.schema->mapping.fields;
    size_t line_of[MAX_KEYS] = {0};
    const yaml_node_pair_t *end = mapping.node->data.mapping.pairs.top;
    for (const yaml_node_pair_t *pair = mapping.node->data.mapping.pairs.start; pair < end; pair++) {
        const yaml_node_t *key = yaml_document_get_node(&places->document, pair->key);
        const int f = field_named(fields, key);
        if (f < 0 || f >= MAX_KEYS)
            return refuse_key(places, at, key, report);
        const size_t line = key->start_mark.line + 1;
        if (line_of[f] != 0) {
            const room_key_t full = key_within(places, at, fields[f].key);
            return room_refuse(report, line, full.text, "found a second time, expected only the one of line %zu",
                               line_of[f]);
        }
        line_of[f] = line;
        yaml_node_t *value = yaml_document_get_node(&places->document, pair->value);
        push(places, &(room_place_t){value, &fields[f].value, line, at, fields[f].key, 0});
    }
    return check_missing(places, at, line_of, report);
}

static bool check_place(room_places_t *places, int32_t at, const room_report_t *report)
{
    const room_place_t *place = &places->place[at];
    if (room_scalar_is_null(place->node) &&
        (place->schema->flags & CYAML_FLAG_POINTER_NULL_STR) == CYAML_FLAG_POINTER_NULL_STR)
        return true;
    if (place->schema->type == CYAML_MAPPING)
        return check_mapping(places, at, report);
    if (place->schema->type == CYAML_SEQUENCE || place->schema->type == CYAML_SEQUENCE_FIXED)
        return check_list(places, at, report);
    return room_scalar_fits(place->node, place->schema) || refuse_place(places, at, report);
}

static bool load_document(yaml_document_t *document, const room_text_t *text, const room_report_t *report)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser))
        return room_refuse(report, 1, "file", "out of memory, expected enough to read it");
    yaml_parser_set_input_string(&parser, text->bytes, text->length);
    const bool good = yaml_parser_load(&parser, document) || room_text_refuse_syntax(report, &parser, text);
    yaml_parser_delete(&parser);
    return good;
}

static bool walk(room_places_t *places, const cyaml_schema_value_t *schema, const room_report_t *report)
{
    yaml_node_t *root = yaml_document_get_root_node(&places->document);
    places->capacity = (int32_t)(places->document.nodes.top - places->document.nodes.start);
    places->place = calloc((size_t)places->capacity, sizeof *places->place);
    if (places->place == NULL)
        return room_refuse(report, 1, "file", "out of memory, expected enough to read it");
    push(places, &(room_place_t){root, schema, root->start_mark.line + 1, -1, NULL, 0});
    bool good = true;
    for (int32_t at = 0; good && at < places->count; at++)
        good = check_place(places, at, report);
    return good;
}

bool room_places_read(room_places_t *places, const room_text_t *text, const cyaml_schema_value_t *schema,
                      const room_report_t *report)
{
    room_places_t read = {0};
    if (!load_document(&read.document, text, report))
        return false;
    if (!walk(&read, schema, report)) {
        room_places_free(&read);
        return false;
    }
    *places = read;
    return true;
}

void room_places_free(room_places_t *places)
{
    free(places->place);
    places->place = NULL;
    yaml_document_delete(&places->document);
}

size_t room_places_line(const room_places_t *places, const char *key)
{
    for (int32_t i = 0; i < places->count; i++) {
        const room_key_t candidate = key_of(places, i);
        if (strcmp(candidate.text, key) == 0)
            return places->place[i].line;
    }
    return 1;
}
