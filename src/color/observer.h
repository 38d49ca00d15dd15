/* SPDX-License-Identifier: BSD-3-Clause
 * What every source of an observer's curves has in common. */
#ifndef METAMER_COLOR_OBSERVER_H
#define METAMER_COLOR_OBSERVER_H

#include "metamer/color.h"

/* Whether curves can work: each has a positive sum over the grid, that of y (green) is within 1e-30 … 1e30, and no
 * value is above a million times that sum, so that pictures hold the responses. MTM_FORMAT names the curve, by its
 * letter, and the value; `document` begins the message. */
MTM_CHECK mtm_status mtm_observer_check(const mtm_observer *observer, const char *document, mtm_error *error);

#endif
