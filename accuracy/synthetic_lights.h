/* SPDX-License-Identifier: BSD-3-Clause
 * Lights with narrow lines where no measured lamp of the training set has them. */
#ifndef METAMER_ACCURACY_SYNTHETIC_LIGHTS_H
#define METAMER_ACCURACY_SYNTHETIC_LIGHTS_H

#include "collection.h"
#include "random.h"

/* Appends `count` lights made from the first `measured_count` of the list (≥ 1). MTM_NUMERIC where a measured light is so
 * saturated that no mixture of lines has its color; MTM_MEMORY. */
MTM_CHECK mtm_status synthetic_lights_append(int count, random_state seed, int measured_count,
                                             collection_list *lights, mtm_error *error);

#endif
