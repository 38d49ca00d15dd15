/* SPDX-License-Identifier: BSD-3-Clause
 * What the subcommands say as JSON. A value that cannot be made is NULL, and so is what jansson makes of it. */
#ifndef METAMER_CLI_DOCUMENT_H
#define METAMER_CLI_DOCUMENT_H

#include <jansson.h>

/* JSON holds UTF-8 only; where the text is none, every byte beyond ASCII becomes a question mark. */
json_t *make_text(const char *text);

/* NULL also for numbers that JSON cannot hold: what is not finite. */
json_t *make_numbers(int count, const double *values);

/* Onto standard output, indented, numbers with 15 significant digits. */
void print_document(const json_t *document);

#endif
