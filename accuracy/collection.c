/* SPDX-License-Identifier: BSD-3-Clause
 * The spectra that bases are fitted to and judged by. */
#include "collection.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { PATH_BYTES = 4096, LINE_BYTES = 256, PART_COUNT = PART_FLUORESCENT + 1 };

static const char *const part_names[PART_COUNT] = {"train", "test", "smooth", "led", "fluorescent"};
static const char optional_table[] = "reflectance_munsell1269_matt";

/* What reading the split needs from row to row. Rows of one table follow each other, so the last table read is kept. */
typedef struct split_reader {
    const char *source_folder, *extra_folder;
    char path[PATH_BYTES]; /* of split.csv */
    int line;
    char table_name[64], table_path[PATH_BYTES];
    mtm_spectrum_table table;
    mtm_observer observer;
    collection *spectra;
    mtm_error *error;
} split_reader;

mtm_status collection_append(collection_list *list, const collection_item *item, mtm_error *error) {
    if (list->count == list->capacity) {
        const int capacity = list->capacity == 0 ? 256 : 2 * list->capacity;
        collection_item *items = realloc(list->items, (size_t)capacity * sizeof *items);
        if (items == NULL) return fail_memory(error, "spectra");
        list->items = items;
        list->capacity = capacity;
    }
    list->items[list->count++] = *item;
    return MTM_OK;
}

mtm_status collection_append_part(const collection_list *from, collection_part part, collection_list *to,
                                  mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < from->count && status == MTM_OK; i++)
        if (from->items[i].part == part) status = collection_append(to, &from->items[i], error);
    return status;
}

void collection_list_free(collection_list *list) {
    free(list->items);
    *list = (collection_list){0};
}

void collection_free(collection *spectra) {
    collection_list_free(&spectra->lights);
    collection_list_free(&spectra->reflectances);
}

/* The file of a table: of data/spectra, or of the extra folder where the repository has not got it. */
static mtm_status find_table(const char *source_folder, const char *extra_folder, const char *table,
                             char path[PATH_BYTES], mtm_error *error) {
    const bool is_extra = strcmp(table, optional_table) == 0 && extra_folder != NULL;
    const int length = is_extra ? snprintf(path, PATH_BYTES, "%s/%s_5nm.csv", extra_folder, table)
                                : snprintf(path, PATH_BYTES, "%s/data/spectra/%s.csv", source_folder, table);
    if (length > 0 && length < PATH_BYTES) return MTM_OK;
    return fail(error, MTM_LIMIT, "%.64s…: a path too long to be opened", path);
}

mtm_status collection_append_file(const char *path, const char *table, mtm_spectrum_kind kind,
                                  collection_part part, collection_list *list, mtm_error *error) {
    mtm_spectrum_table columns = {0};
    mtm_status status = mtm_spectrum_table_read(path, &columns, error);
    for (int i = 0; i < columns.column_count && status == MTM_OK; i++) {
        collection_item item = {.part = part};
        (void)snprintf(item.table, sizeof item.table, "%s", table);
        (void)snprintf(item.name, sizeof item.name, "%s", columns.names[i]);
        status = mtm_spectrum_table_column(&columns, path, columns.names[i], kind, &item.spectrum, error);
        if (status == MTM_OK) status = collection_append(list, &item, error);
    }
    mtm_spectrum_table_free(&columns);
    return status;
}

mtm_status collection_append_table(const char *source_folder, const char *table, mtm_spectrum_kind kind,
                                   collection_part part, collection_list *list, mtm_error *error) {
    char path[PATH_BYTES];
    const mtm_status status = find_table(source_folder, NULL, table, path, error);
    return status == MTM_OK ? collection_append_file(path, table, kind, part, list, error) : status;
}

/* The C library's exp and pow may differ in their last digits from another's; as floats the values do not. */
static mtm_status read_blackbody(split_reader *reader, collection_item *item) {
    char *end = NULL;
    const double kelvin = strtod(item->name, &end);
    if (end == item->name || *end != '\0')
        return fail(reader->error, MTM_FORMAT, "black body of '%s', expected kelvin", item->name);
    const mtm_status status = mtm_blackbody(kelvin, &item->spectrum, reader->error);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES && status == MTM_OK; i++)
        item->spectrum.value[i] = (float)item->spectrum.value[i];
    return status;
}

/* Makes `reader->table` that of the name. */
static mtm_status open_table(split_reader *reader, const char *name) {
    if (strcmp(reader->table_name, name) == 0) return MTM_OK;
    mtm_status status =
        find_table(reader->source_folder, reader->extra_folder, name, reader->table_path, reader->error);
    if (status != MTM_OK) return status;
    mtm_spectrum_table_free(&reader->table);
    reader->table_name[0] = '\0';
    status = mtm_spectrum_table_read(reader->table_path, &reader->table, reader->error);
    if (status == MTM_OK) (void)snprintf(reader->table_name, sizeof reader->table_name, "%s", name);
    return status;
}

static mtm_status read_column(split_reader *reader, mtm_spectrum_kind kind, collection_item *item) {
    const mtm_status status = open_table(reader, item->table);
    if (status != MTM_OK) return status;
    return mtm_spectrum_table_column(&reader->table, reader->table_path, item->name, kind, &item->spectrum,
                                     reader->error);
}

static mtm_status read_light(split_reader *reader, collection_item *item) {
    mtm_status status = MTM_OK;
    if (strcmp(item->table, "illuminant") == 0)
        status = mtm_illuminant(item->name, &item->spectrum, reader->error);
    else if (strcmp(item->table, "blackbody") == 0)
        status = read_blackbody(reader, item);
    else
        status = read_column(reader, MTM_KIND_LIGHT, item);
    if (status == MTM_OK)
        status = mtm_light_normalize(&item->spectrum, &reader->observer, &item->spectrum, reader->error);
    return status == MTM_OK ? collection_append(&reader->spectra->lights, item, reader->error) : status;
}

static mtm_status read_reflectance(split_reader *reader, collection_item *item) {
    if (reader->extra_folder == NULL && strcmp(item->table, optional_table) == 0) return MTM_OK;
    const mtm_status status = read_column(reader, MTM_KIND_REFLECTANCE, item);
    return status == MTM_OK ? collection_append(&reader->spectra->reflectances, item, reader->error) : status;
}

static mtm_status find_part(const char *name, collection_part *part, mtm_error *error) {
    for (int i = 0; i < PART_COUNT; i++) {
        if (strcmp(name, part_names[i]) != 0) continue;
        *part = (collection_part)i;
        return MTM_OK;
    }
    return fail(error, MTM_FORMAT, "part '%s', expected train, test, smooth, led or fluorescent", name);
}

static mtm_status read_row(split_reader *reader, char *text) {
    collection_item item = {.part = PART_TRAIN};
    char part[32];
    int end = 0;
    const int cells = sscanf(text, "%63[^,\n],%63[^,\n],%31[^,\n]%n", item.table, item.name, part, &end);
    if (cells != 3 || strcmp(text + end, "\n") != 0)
        return fail(reader->error, MTM_FORMAT, "expected a row 'table,name,part'");
    const mtm_status status = find_part(part, &item.part, reader->error);
    if (status != MTM_OK) return status;
    return strncmp(item.table, "reflectance_", strlen("reflectance_")) == 0 ? read_reflectance(reader, &item)
                                                                            : read_light(reader, &item);
}

/* Puts file and line before what was wrong with the row. */
static mtm_status fail_row(const split_reader *reader, mtm_status status) {
    if (reader->error == NULL) return status;
    const mtm_error cause = *reader->error;
    return fail(reader->error, status, "%s:%d: %.900s", reader->path, reader->line, cause.message);
}

static mtm_status read_rows(split_reader *reader, FILE *stream) {
    char text[LINE_BYTES];
    while (fgets(text, sizeof text, stream) != NULL) {
        reader->line++;
        mtm_status status = MTM_OK;
        if (reader->line > 1)
            status = read_row(reader, text);
        else if (strcmp(text, "table,name,part\n") != 0)
            status = fail(reader->error, MTM_FORMAT, "expected the header 'table,name,part'");
        if (status != MTM_OK) return fail_row(reader, status);
    }
    if (ferror(stream) == 0) return MTM_OK;
    return fail(reader->error, MTM_IO, "%s: cannot be read: %s", reader->path, strerror(errno));
}

mtm_status collection_read(const char *source_folder, const char *extra_folder, collection *spectra,
                           mtm_error *error) {
    *spectra = (collection){{0}, {0}};
    split_reader reader = {
        .source_folder = source_folder, .extra_folder = extra_folder, .spectra = spectra, .error = error};
    const int length = snprintf(reader.path, sizeof reader.path, "%s/accuracy/split.csv", source_folder);
    if (length >= PATH_BYTES)
        return fail(error, MTM_LIMIT, "%.64s…: a path too long to be opened", source_folder);
    mtm_status status = mtm_observer_get("cie1931", &reader.observer, error);
    if (status != MTM_OK) return status;
    FILE *stream = fopen(reader.path, "r");
    if (stream == NULL) return fail(error, MTM_IO, "%s: cannot be opened: %s", reader.path, strerror(errno));
    status = read_rows(&reader, stream);
    (void)fclose(stream);
    mtm_spectrum_table_free(&reader.table);
    if (status != MTM_OK) collection_free(spectra);
    return status;
}
