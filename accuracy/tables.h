/* SPDX-License-Identifier: BSD-3-Clause
 * The tables of docs/accuracy.md, in Markdown. Errors are CIEDE2000. */
#ifndef METAMER_ACCURACY_TABLES_H
#define METAMER_ACCURACY_TABLES_H

#include <stdio.h>

#include "cost.h"
#include "measure.h"

/* What the light fell on: one, two, three reflectances, or three at the exposure of one. */
typedef enum product_kind { PRODUCT_ONE, PRODUCT_TWO, PRODUCT_THREE, PRODUCT_MATCHED } product_kind;

/* The models side by side: what most readers need. */
void print_headline_table(FILE *stream, const measurements *made);

/* Families by dimension, then those of one dimension: mean / 95 %. */
void print_dimension_table(FILE *stream, const measurements *made, measured_set set, product_kind kind);

/* The main models by class of light: mean of one product. */
void print_class_table(FILE *stream, const measurements *made);

/* The main models on one set: one product, three at the first one's exposure. */
void print_set_table(FILE *stream, const measurements *made, measured_set set);

void print_metamer_table(FILE *stream, const measurements *made);
void print_filter_table(FILE *stream, const measurements *made);

/* Bases by palette, then factors:7 light by light. */
void print_engine_table(FILE *stream, const measurements *made);
void print_engine_light_table(FILE *stream, const measurements *made);

/* Every model, everything of one set. */
void print_full_table(FILE *stream, const measurements *made, measured_set set);

void print_cost_table(FILE *stream, const measurements *made, const basis_cost costs[COST_BASES]);

#endif
