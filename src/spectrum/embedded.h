/* SPDX-License-Identifier: BSD-3-Clause
 * The CSV tables of data/spectra/cie_….csv and data/bases/, built into the library by cmake/embed_spectra.cmake. */
#ifndef METAMER_SPECTRUM_EMBEDDED_H
#define METAMER_SPECTRUM_EMBEDDED_H

#include "metamer/spectrum.h"

typedef struct mtm_embedded_table {
    const char *name; /* file name without ".csv" */
    const char *text; /* its content, '\n' line ends */
} mtm_embedded_table;

/* Ends with an entry of two null pointers. */
extern const mtm_embedded_table mtm_embedded_tables[];

/* The built-in table of that name, which exists. Errors: MTM_MEMORY. On success the caller calls
 * mtm_spectrum_table_free. */
MTM_CHECK mtm_status mtm_embedded_table_read(const char *table_name, mtm_spectrum_table *table,
                                             mtm_error *error);

/* A column of the built-in table of that name, which exists, on the grid. The text is parsed anew on each call
 * (a fraction of a millisecond), so that there is no cache to share between threads. Errors: MTM_MEMORY. */
MTM_CHECK mtm_status mtm_embedded_column(const char *table_name, const char *column, mtm_spectrum_kind kind,
                                         mtm_spectrum *spectrum, mtm_error *error);

#endif
