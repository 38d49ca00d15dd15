/* SPDX-License-Identifier: BSD-3-Clause
 * The CSV tables of data/spectra/cie_*.csv, built into the library by cmake/embed_spectra.cmake. */
#ifndef METAMER_SPECTRUM_EMBEDDED_H
#define METAMER_SPECTRUM_EMBEDDED_H

typedef struct mtm_embedded_table {
    const char *name; /* file name without ".csv" */
    const char *text; /* its content, '\n' line ends */
} mtm_embedded_table;

/* Ends with an entry of two null pointers. */
extern const mtm_embedded_table mtm_embedded_tables[];

#endif
