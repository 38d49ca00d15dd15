/* SPDX-License-Identifier: BSD-3-Clause
 * The smoothest curve within 0 … 1 that has three given weighted sums. */
#ifndef METAMER_COLOR_SMOOTHEST_H
#define METAMER_COLOR_SMOOTHEST_H

#include "metamer/spectrum.h"

/* Minimises Σ(ρᵢ₊₁ − ρᵢ)² subject to rows[k]·ρ = target[k] and 0 ≤ ρ ≤ 1. The three rows are independent and have
 * sums that are not all 0. MTM_NUMERIC where no such curve exists; MTM_MEMORY. */
MTM_CHECK mtm_status mtm_smoothest_curve(const mtm_spectrum rows[3], const double target[3],
                                         mtm_spectrum *curve, mtm_error *error);

#endif
