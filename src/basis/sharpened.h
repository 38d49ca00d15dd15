/* SPDX-License-Identifier: BSD-3-Clause
 * Spectral sharpening of any subspace, so that a test can bring an unsuitable one. */
#ifndef METAMER_BASIS_SHARPENED_H
#define METAMER_BASIS_SHARPENED_H

#include "basis/kind.h"

/* Fills columns and encoder of `basis` from as many orthonormal `components` on 400 … 700 nm, of which the first is the
 * flat spectrum. MTM_NUMERIC where the sharpened basis is ill-conditioned. */
MTM_CHECK mtm_status mtm_basis_sharpen(mtm_basis *basis, const mtm_spectrum *components, mtm_error *error);

#endif
