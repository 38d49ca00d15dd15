/* SPDX-License-Identifier: BSD-3-Clause
 * Numbers as text, the same in every locale. */
#ifndef METAMER_BASE_NUMBER_H
#define METAMER_BASE_NUMBER_H

#include <stdbool.h>

/* Reads a decimal number with a decimal point (also "nan" and "inf") at the start of `text`, leading blanks
 * allowed. Returns the first character after it, or NULL where there is no number. */
const char *mtm_number_scan(const char *text, double *value);

/* True where the whole text, blanks around it aside, is one number. */
bool mtm_number_parse(const char *text, double *value);

/* The same for a whole number that fits an int. */
bool mtm_integer_parse(const char *text, int *value);

/* The shortest text that reads back as the same double; `buffer` holds at least MTM_NUMBER_TEXT characters. */
enum { MTM_NUMBER_TEXT = 32 };
const char *mtm_number_format(double value, char buffer[MTM_NUMBER_TEXT]);

#endif
