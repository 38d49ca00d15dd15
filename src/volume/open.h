/* SPDX-License-Identifier: BSD-3-Clause
 * Opening files whose names come from elsewhere. */
#ifndef METAMER_VOLUME_OPEN_H
#define METAMER_VOLUME_OPEN_H

#include <stdio.h>

#include "metamer/base.h"

/* Opens a regular file for reading, binary. MTM_IO with the reason, also for folders, devices and pipes: readers
 * seek, and a header must not make us wait for a pipe that nobody writes to. */
MTM_CHECK mtm_status mtm_open_regular(const char *path, FILE **stream, mtm_error *error);

#endif
