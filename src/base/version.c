/* SPDX-License-Identifier: BSD-3-Clause
 * The version that CMakeLists.txt states. */
#include "metamer/base.h"

const char *mtm_version(void) {
    return METAMER_VERSION;
}
