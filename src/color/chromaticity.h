/* SPDX-License-Identifier: BSD-3-Clause
 * The CIE 1960 uniform chromaticity scale, in which color temperature and color rendering are defined. */
#ifndef METAMER_COLOR_CHROMATICITY_H
#define METAMER_COLOR_CHROMATICITY_H

#include "metamer/color.h"

typedef struct mtm_chromaticity {
    double u, v;
} mtm_chromaticity;

/* u = 4X / (X + 15Y + 3Z), v = 6Y / (X + 15Y + 3Z) (CIE 015:2018, CIE 1960 UCS); not finite for black. */
static inline mtm_chromaticity mtm_chromaticity_of(mtm_xyz xyz) {
    const double sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
    return (mtm_chromaticity){4 * xyz.x / sum, 6 * xyz.y / sum};
}

#endif
