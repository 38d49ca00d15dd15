/* SPDX-License-Identifier: BSD-3-Clause
 * All of metamer. */
#ifndef METAMER_METAMER_H
#define METAMER_METAMER_H

#include "metamer/base.h"
#include "metamer/basis.h"
#include "metamer/camera.h"
#include "metamer/color.h"
#include "metamer/image.h"
#include "metamer/palette.h"
#include "metamer/relight.h"
#include "metamer/render.h"
#include "metamer/scene.h"
#include "metamer/spectrum.h"
#include "metamer/transfer.h"
#include "metamer/volume.h"

#endif
