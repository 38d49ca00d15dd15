/* SPDX-License-Identifier: BSD-3-Clause
 * The spectra that bases are fitted to and judged by: the rows of accuracy/split.csv, each a spectrum of
 * data/spectra, an illuminant or a black body, and the part it plays. */
#ifndef METAMER_ACCURACY_COLLECTION_H
#define METAMER_ACCURACY_COLLECTION_H

#include "metamer/metamer.h"

/* Lights are for training or held out in one of three classes, reflectances for training or testing. */
typedef enum collection_part {
    PART_TRAIN,
    PART_TEST,
    PART_SMOOTH,
    PART_LED,
    PART_FLUORESCENT,
} collection_part;

typedef struct collection_item {
    char table[64]; /* "illuminant", "blackbody", or a table of data/spectra without ".csv" */
    char name[64];  /* of the illuminant, the column; kelvin of a black body */
    collection_part part;
    mtm_spectrum spectrum; /* of a light: y = 1 on white for the CIE 1931 observer */
} collection_item;

typedef struct collection_list {
    int count, capacity;
    collection_item *items;
} collection_list;

typedef struct collection {
    collection_list lights, reflectances;
} collection;

/* Reads `source_folder`/accuracy/split.csv and the spectra that it names, in its order. Its table
 * reflectance_munsell1269_matt is not in the repository; its rows are skipped where `extra_folder` is NULL, and are read
 * from reflectance_munsell1269_matt_5nm.csv there otherwise. Errors (each names file and line): MTM_IO;
 * MTM_FORMAT for a row that is not three names, or an unknown part; MTM_ARGUMENT for an unknown spectrum; those of
 * mtm_spectrum_table_read; MTM_MEMORY. On success the caller calls collection_free. */
MTM_CHECK mtm_status collection_read(const char *source_folder, const char *extra_folder, collection *spectra,
                                     mtm_error *error);
void collection_free(collection *spectra);

/* Appends every column of `source_folder`/data/spectra/`table`.csv, as that part. Errors as above; the list keeps what
 * was appended before. */
MTM_CHECK mtm_status collection_append_table(const char *source_folder, const char *table,
                                             mtm_spectrum_kind kind, collection_part part,
                                             collection_list *list, mtm_error *error);

/* The same of any file; the items name `table` as theirs. */
MTM_CHECK mtm_status collection_append_file(const char *path, const char *table, mtm_spectrum_kind kind,
                                            collection_part part, collection_list *list, mtm_error *error);

/* Appends one item. MTM_MEMORY. */
MTM_CHECK mtm_status collection_append(collection_list *list, const collection_item *item, mtm_error *error);
/* Appends copies of the items that play this part. MTM_MEMORY. */
MTM_CHECK mtm_status collection_append_part(const collection_list *from, collection_part part,
                                            collection_list *to, mtm_error *error);
void collection_list_free(collection_list *list);

#endif
