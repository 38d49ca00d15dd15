/* SPDX-License-Identifier: BSD-3-Clause
 * What the parts of the NRRD reader know of a file: its header's texts, and what they mean. */
#ifndef METAMER_VOLUME_NRRD_H
#define METAMER_VOLUME_NRRD_H

#include <stdio.h>

#include "metamer/volume.h"

enum {
    MTM_NRRD_AXES = 16,      /* the format's own limit */
    MTM_NRRD_NAME_TEXT = 64, /* longest type, encoding, kind … that can mean something, and a 0 */
};

typedef enum mtm_nrrd_field {
    MTM_NRRD_AXIS_MAXS,
    MTM_NRRD_AXIS_MINS,
    MTM_NRRD_BLOCK_SIZE,
    MTM_NRRD_BYTE_SKIP,
    MTM_NRRD_CENTERINGS,
    MTM_NRRD_CONTENT,
    MTM_NRRD_DATA_FILE,
    MTM_NRRD_DIMENSION,
    MTM_NRRD_ENCODING,
    MTM_NRRD_ENDIAN,
    MTM_NRRD_KINDS,
    MTM_NRRD_LABELS,
    MTM_NRRD_LINE_SKIP,
    MTM_NRRD_MAX,
    MTM_NRRD_MEASUREMENT_FRAME,
    MTM_NRRD_MIN,
    MTM_NRRD_NUMBER,
    MTM_NRRD_OLD_MAX,
    MTM_NRRD_OLD_MIN,
    MTM_NRRD_SAMPLE_UNITS,
    MTM_NRRD_SIZES,
    MTM_NRRD_SPACE,
    MTM_NRRD_SPACE_DIMENSION,
    MTM_NRRD_SPACE_DIRECTIONS,
    MTM_NRRD_SPACE_ORIGIN,
    MTM_NRRD_SPACE_UNITS,
    MTM_NRRD_SPACINGS,
    MTM_NRRD_THICKNESSES,
    MTM_NRRD_TYPE,
    MTM_NRRD_UNITS,
    MTM_NRRD_FIELD_COUNT,
} mtm_nrrd_field;

typedef struct mtm_nrrd_header {
    const char *path;                         /* the header's file, which every message names */
    char *text;                               /* the header, cut at line ends; the values point into it */
    const char *values[MTM_NRRD_FIELD_COUNT]; /* without blanks at the ends; NULL where absent */
    const char *file_list;                    /* file names of "data file: LIST", each ended by a 0 */
    int file_list_count;
    long long data_offset; /* of the first byte after the header's empty line */
    bool has_empty_line;   /* without one there is no attached data */

    int dimension;
    int sizes[MTM_NRRD_AXES];
    mtm_voxel_type type;
    bool is_gzip;
    bool is_big_endian;
    long long line_skip, byte_skip; /* byte_skip -1: the data are the last bytes of a raw file */
} mtm_nrrd_header;

/* Where the voxels are: the rest of the header's file, one file, or several that follow each other. */
typedef struct mtm_nrrd_files {
    int count;
    char *folder; /* of the header; file names are relative to it */
    const char
        *pattern; /* a name, or with `is_numbered` a name with a number's place; NULL for attached data */
    const char **names; /* of LIST, inside the header's text; NULL otherwise */
    bool is_attached, is_numbered;
    int first, step; /* of the numbers put into the pattern */
} mtm_nrrd_files;

/* Reads and cuts the header at the start of the stream; then what the basic fields say. Release in every case
 * with mtm_nrrd_header_free. */
MTM_CHECK mtm_status mtm_nrrd_header_read(FILE *stream, const char *path, mtm_nrrd_header *header,
                                          mtm_error *error);
MTM_CHECK mtm_status mtm_nrrd_header_interpret(mtm_nrrd_header *header, mtm_error *error);
void mtm_nrrd_header_free(mtm_nrrd_header *header);

const char *mtm_nrrd_field_name(mtm_nrrd_field field);

/* Whether two names are the same but for letter case, blanks and hyphens: "Space Directions", "spacedirections". */
bool mtm_nrrd_is_same_name(const char *a, const char *b);

/* Copies the next word of the text and returns what follows it, NULL where no word is left. A longer word is cut,
 * which makes it a word that nobody knows. */
const char *mtm_nrrd_next_word(const char *text, char word[MTM_NRRD_NAME_TEXT]);

/* Reads a field of exactly `count` ≤ MTM_NRRD_AXES numbers; false, and no error, where the field is absent. */
MTM_CHECK mtm_status mtm_nrrd_numbers(const mtm_nrrd_header *header, mtm_nrrd_field field, int count,
                                      double *numbers, bool *is_present, mtm_error *error);

/* The grid that the header's axes and space describe. Errors as all the above: MTM_FORMAT, MTM_LIMIT. */
MTM_CHECK mtm_status mtm_nrrd_grid(const mtm_nrrd_header *header, mtm_grid *grid, mtm_error *error);

/* Which axes of the file are the volume's; the others have size 1. */
MTM_CHECK mtm_status mtm_nrrd_choose_axes(const mtm_nrrd_header *header, const bool *has_direction,
                                          int axes[3], mtm_error *error);

/* The files that hold the voxels of a header that was interpreted. Release in every case. */
MTM_CHECK mtm_status mtm_nrrd_files_find(const mtm_nrrd_header *header, mtm_nrrd_files *files,
                                         mtm_error *error);
void mtm_nrrd_files_free(mtm_nrrd_files *files);

/* The path of one of them for free(); NULL when out of memory. */
char *mtm_nrrd_file_path(const mtm_nrrd_files *files, int index);

/* Reads a volume from a stream that can seek; `path` names it in messages and gives the folder of data files. */
MTM_CHECK mtm_status mtm_nrrd_read(FILE *stream, const char *path, mtm_volume **volume, mtm_error *error);

#endif
