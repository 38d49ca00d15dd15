/* SPDX-License-Identifier: BSD-3-Clause
 * The lines of a NRRD header: fields, keys and comments ("Definition of NRRD File Format", teem.sourceforge.net). */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/nearest.h"
#include "volume/nrrd.h"

enum { HEADER_LIMIT_BYTES = 1 << 24, HEADER_FIRST_BYTES = 1 << 10 };

static const char *const field_names[MTM_NRRD_FIELD_COUNT] = {
    [MTM_NRRD_AXIS_MAXS] = "axis maxs",
    [MTM_NRRD_AXIS_MINS] = "axis mins",
    [MTM_NRRD_BLOCK_SIZE] = "block size",
    [MTM_NRRD_BYTE_SKIP] = "byte skip",
    [MTM_NRRD_CENTERINGS] = "centerings",
    [MTM_NRRD_CONTENT] = "content",
    [MTM_NRRD_DATA_FILE] = "data file",
    [MTM_NRRD_DIMENSION] = "dimension",
    [MTM_NRRD_ENCODING] = "encoding",
    [MTM_NRRD_ENDIAN] = "endian",
    [MTM_NRRD_KINDS] = "kinds",
    [MTM_NRRD_LABELS] = "labels",
    [MTM_NRRD_LINE_SKIP] = "line skip",
    [MTM_NRRD_MAX] = "max",
    [MTM_NRRD_MEASUREMENT_FRAME] = "measurement frame",
    [MTM_NRRD_MIN] = "min",
    [MTM_NRRD_NUMBER] = "number",
    [MTM_NRRD_OLD_MAX] = "old max",
    [MTM_NRRD_OLD_MIN] = "old min",
    [MTM_NRRD_SAMPLE_UNITS] = "sample units",
    [MTM_NRRD_SIZES] = "sizes",
    [MTM_NRRD_SPACE] = "space",
    [MTM_NRRD_SPACE_DIMENSION] = "space dimension",
    [MTM_NRRD_SPACE_DIRECTIONS] = "space directions",
    [MTM_NRRD_SPACE_ORIGIN] = "space origin",
    [MTM_NRRD_SPACE_UNITS] = "space units",
    [MTM_NRRD_SPACINGS] = "spacings",
    [MTM_NRRD_THICKNESSES] = "thicknesses",
    [MTM_NRRD_TYPE] = "type",
    [MTM_NRRD_UNITS] = "units",
};

const char *mtm_nrrd_field_name(mtm_nrrd_field field) {
    return field_names[field];
}

static const char *skip_ignored(const char *text) {
    while (*text == ' ' || *text == '\t' || *text == '-') text++;
    return text;
}

bool mtm_nrrd_is_same_name(const char *a, const char *b) {
    a = skip_ignored(a);
    b = skip_ignored(b);
    while (*a != '\0' && tolower((unsigned char)*a) == tolower((unsigned char)*b)) {
        a = skip_ignored(a + 1);
        b = skip_ignored(b + 1);
    }
    return *a == '\0' && *b == '\0';
}

/* The header up to and without its empty line, or the whole file where it has none. */
typedef struct header_text {
    char *bytes;
    size_t count, capacity;
} header_text;

static bool append(header_text *text, char byte) {
    if (text->count + 1 >= text->capacity) {
        const size_t capacity = text->capacity == 0 ? HEADER_FIRST_BYTES : 2 * text->capacity;
        char *larger = realloc(text->bytes, capacity);
        if (larger == NULL) return false;
        text->bytes = larger;
        text->capacity = capacity;
    }
    text->bytes[text->count++] = byte;
    text->bytes[text->count] = '\0';
    return true;
}

static mtm_status read_text(FILE *stream, mtm_nrrd_header *header, mtm_error *error) {
    header_text text = {0};
    size_t line_start = 0;
    int byte = getc(stream);
    while (byte != EOF && !header->has_empty_line && text.count < HEADER_LIMIT_BYTES) {
        /* Control characters have no place in a header, and none in our messages. */
        const bool is_control = iscntrl(byte) && byte != '\n' && byte != '\t' && byte != '\r';
        const bool is_appended = append(&text, is_control ? '?' : (char)byte);
        header->text = text.bytes;
        if (!is_appended) return mtm_fail_memory(error, header->path, 2 * text.capacity);
        if (byte == '\n') {
            const size_t length = text.count - line_start;
            header->has_empty_line = length == 1 || (length == 2 && text.bytes[line_start] == '\r');
            line_start = text.count;
        }
        if (!header->has_empty_line) byte = getc(stream);
    }
    if (ferror(stream)) return mtm_fail(error, MTM_IO, "%s: cannot be read", header->path);
    if (text.count >= HEADER_LIMIT_BYTES)
        return mtm_fail(error, MTM_LIMIT, "%s: its header has more than %d bytes", header->path,
                        HEADER_LIMIT_BYTES);
    if (text.count == 0) return mtm_fail(error, MTM_FORMAT, "%s: is empty", header->path);
    header->data_offset = (long long)text.count;
    return MTM_OK;
}

/* Ends the line that begins at `line` and takes the blanks off its end; returns the next one, NULL at the end. */
static char *cut_line(char *line) {
    char *newline = strchr(line, '\n');
    char *end = newline != NULL ? newline : line + strlen(line);
    *end = '\0';
    while (end > line && isspace((unsigned char)end[-1])) *--end = '\0';
    return newline == NULL ? NULL : newline + 1;
}

static mtm_status check_magic(const mtm_nrrd_header *header, mtm_error *error) {
    const char *magic = header->text;
    const bool is_known =
        strlen(magic) == 8 && strncmp(magic, "NRRD000", 7) == 0 && magic[7] >= '1' && magic[7] <= '5';
    if (is_known) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s: begins with '%.20s', expected NRRD0001 to NRRD0005", header->path,
                    magic);
}

/* MTM_NRRD_FIELD_COUNT for an unknown name. */
static mtm_nrrd_field find_field(const char *name) {
    if (mtm_nrrd_is_same_name(name, "centers")) return MTM_NRRD_CENTERINGS;
    int field = 0;
    while (field < MTM_NRRD_FIELD_COUNT && !mtm_nrrd_is_same_name(name, field_names[field])) field++;
    return (mtm_nrrd_field)field;
}

/* Where the name of a field ends: at ": ", at a colon that ends the line or else, leniently, at any colon. NULL
 * for a line that is no field, in particular for "key:=value". */
static char *find_colon(char *line) {
    char *key_end = strstr(line, ":=");
    char *name_end = strstr(line, ": ");
    if (name_end == NULL) name_end = strchr(line, ':');
    return name_end == key_end || (key_end != NULL && key_end < name_end) ? NULL : name_end;
}

static mtm_status take_line(mtm_nrrd_header *header, char *line, int line_number, mtm_error *error) {
    if (line[0] == '#' || line[0] == '\0') return MTM_OK;
    char *colon = find_colon(line);
    const bool is_key = strstr(line, ":=") != NULL; /* unless a field whose text has ":=" */
    if (colon == NULL && is_key) return MTM_OK;
    if (colon == NULL)
        return mtm_fail(error, MTM_FORMAT,
                        "%s: line %d: '%.60s' is no 'field: value', no 'key:=value' and no comment",
                        header->path, line_number, line);
    *colon = '\0';
    const mtm_nrrd_field field = find_field(line);
    if (field == MTM_NRRD_FIELD_COUNT && is_key) return MTM_OK;
    if (field == MTM_NRRD_FIELD_COUNT)
        return mtm_fail(error, MTM_FORMAT, "%s: line %d: unknown field '%.60s'; did you mean '%s'?",
                        header->path, line_number, line,
                        mtm_nearest_name(line, field_names, MTM_NRRD_FIELD_COUNT));
    if (header->values[field] != NULL)
        return mtm_fail(error, MTM_FORMAT, "%s: line %d: field '%s' stands there a second time", header->path,
                        line_number, field_names[field]);
    const char *value = colon + 1;
    while (isspace((unsigned char)*value)) value++;
    header->values[field] = value;
    return MTM_OK;
}

/* "LIST" or "LIST 3"; a file called "LISTEN.raw" is none. */
static bool begins_list(const char *value) {
    char word[MTM_NRRD_NAME_TEXT];
    if (value == NULL || mtm_nrrd_next_word(value, word) == NULL || strcmp(word, "LIST") != 0) return false;
    const char *rest = mtm_nrrd_next_word(value, word);
    while (isspace((unsigned char)*rest)) rest++;
    return rest[strspn(rest, "0123456789")] == '\0';
}

/* The names follow each other in the text, each ended by a 0, as the lines did. */
static void take_file_list(mtm_nrrd_header *header, char *line) {
    char *list = line;
    header->file_list = list;
    while (line != NULL && *line != '\0') {
        char *next = cut_line(line);
        const size_t length = strlen(line);
        if (length > 0) {
            memmove(list, line, length + 1);
            list += length + 1;
            header->file_list_count++;
        }
        line = next;
    }
}

mtm_status mtm_nrrd_header_read(FILE *stream, const char *path, mtm_nrrd_header *header, mtm_error *error) {
    *header = (mtm_nrrd_header){.path = path};
    mtm_status status = read_text(stream, header, error);
    if (status != MTM_OK) return status;
    char *line = cut_line(header->text);
    status = check_magic(header, error);
    for (int line_number = 2; status == MTM_OK && line != NULL; line_number++) {
        char *next = cut_line(line);
        status = take_line(header, line, line_number, error);
        if (status == MTM_OK && header->file_list == NULL &&
            begins_list(header->values[MTM_NRRD_DATA_FILE])) {
            take_file_list(header, next == NULL ? line + strlen(line) : next);
            next = NULL;
        }
        line = next;
    }
    return status;
}

void mtm_nrrd_header_free(mtm_nrrd_header *header) {
    free(header->text);
    *header = (mtm_nrrd_header){0};
}
