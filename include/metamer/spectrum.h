/* SPDX-License-Identifier: BSD-3-Clause
 * Sampled spectra, tables of them, and the named and computed lights. */
#ifndef METAMER_SPECTRUM_H
#define METAMER_SPECTRUM_H

#include "metamer/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The one wavelength grid: 380, 385 … 780 nm. */
enum {
    MTM_SPECTRUM_SAMPLES = 81,
    MTM_WAVELENGTH_FIRST_NM = 380,
    MTM_WAVELENGTH_STEP_NM = 5,
};

/* A spectrum on the grid. Reflectances are 0..1 where physical, lights are in relative power per wavelength. */
typedef struct mtm_spectrum {
    double value[MTM_SPECTRUM_SAMPLES];
} mtm_spectrum;

/* What a table holds decides how it comes to the grid: tables with a median step of 5 nm or more are interpolated
 * linearly; finer ones are averaged over 5 nm for lights (the exact mean of the piecewise-linear curve within
 * 2.5 nm of each wavelength) and interpolated for the rest; beyond the table's ends the end value is held for
 * lights and reflectances and is 0 for observers. Samples may be spaced unevenly. */
typedef enum mtm_spectrum_kind {
    MTM_KIND_LIGHT,
    MTM_KIND_REFLECTANCE,
    MTM_KIND_OBSERVER,
} mtm_spectrum_kind;

/* A table as its file has it, before resampling. */
typedef struct mtm_spectrum_table {
    int column_count;
    int row_count;
    char **names;          /* column_count names, the wavelength column not among them */
    double *wavelength_nm; /* row_count, rising */
    double *values;        /* row_count × column_count, a row after the other */
} mtm_spectrum_table;

/* The same value at every wavelength. */
MTM_API mtm_spectrum mtm_spectrum_constant(double value);

/* Sample by sample product and scaling. */
MTM_API mtm_spectrum mtm_spectrum_multiply(const mtm_spectrum *a, const mtm_spectrum *b);
MTM_API mtm_spectrum mtm_spectrum_scale(const mtm_spectrum *spectrum, double factor);

/* Brings `count` samples (count ≥ 1, wavelengths in nm rising strictly) to the grid. */
MTM_API mtm_spectrum mtm_spectrum_resample(int count, const double *wavelength_nm, const double *value,
                                           mtm_spectrum_kind kind);

/* Reads a CSV table: a header row "wavelength_nm,name,…", then one row per wavelength, numbers with a decimal
 * point whatever the locale; blank lines, lines that begin with '#', blanks and quotes round cells, a UTF-8 mark
 * and CR LF line ends are allowed. Errors (each names file and line): MTM_IO; MTM_FORMAT for another first
 * column, a missing, unreadable or not finite number, a row of another length, wavelengths that do not rise or all
 * miss the grid (another unit), two columns of one name, no data; MTM_LIMIT beyond 64 MiB, 4096 columns or 100000
 * rows; MTM_MEMORY. On success the caller calls mtm_spectrum_table_free. */
MTM_API MTM_CHECK mtm_status mtm_spectrum_table_read(const char *path, mtm_spectrum_table *table,
                                                     mtm_error *error);
MTM_API void mtm_spectrum_table_free(mtm_spectrum_table *table);

/* The column of that name on the grid. MTM_ARGUMENT for an unknown column names the nearest known one; `path`
 * only serves that message; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_spectrum_table_column(const mtm_spectrum_table *table, const char *path,
                                                       const char *column, mtm_spectrum_kind kind,
                                                       mtm_spectrum *spectrum, mtm_error *error);

/* Reads "FILE.csv:COLUMN" (split at the last colon), the file relative to `folder`. Errors: MTM_ARGUMENT without
 * file or column, and those of the two calls above. */
MTM_API MTM_CHECK mtm_status mtm_spectrum_read(const char *folder, const char *file_and_column,
                                               mtm_spectrum_kind kind, mtm_spectrum *spectrum,
                                               mtm_error *error);

/* A standard illuminant by its CIE name, letter case ignored: A C D50 D55 D65 D75 E, FL1 … FL12, FL3.1 … FL3.15,
 * HP1 … HP5, LED-B1 … LED-V2 (CIE 015:2018), as tabulated. MTM_ARGUMENT for an unknown name names the nearest. */
MTM_API MTM_CHECK mtm_status mtm_illuminant(const char *name, mtm_spectrum *light, mtm_error *error);

/* The names mtm_illuminant knows, in the order above; NULL for an index outside 0 … mtm_illuminant_count()-1. */
MTM_API int mtm_illuminant_count(void);
MTM_API const char *mtm_illuminant_name(int index);

/* Planck's law at `kelvin` with c2 = 1.4388e-2 m K (CIE 015), scaled to 1 at 560 nm. MTM_ARGUMENT outside
 * 500 … 1e6 K. */
MTM_API MTM_CHECK mtm_status mtm_blackbody(double kelvin, mtm_spectrum *light, mtm_error *error);

/* CIE daylight of correlated color temperature `kelvin` from S0, S1, S2 with unrounded M1, M2 (CIE 015), scaled
 * to 1 at 560 nm. MTM_ARGUMENT outside 4000 … 25000 K. */
MTM_API MTM_CHECK mtm_status mtm_daylight(double kelvin, mtm_spectrum *light, mtm_error *error);

#ifdef __cplusplus
}
#endif
#endif
