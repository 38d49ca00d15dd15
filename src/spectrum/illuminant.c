/* SPDX-License-Identifier: BSD-3-Clause
 * The CIE standard illuminants by name (CIE 015:2018, Colorimetry; ISO 11664-2). */
#include <assert.h>
#include <strings.h>

#include "base/fail.h"
#include "base/nearest.h"
#include "spectrum/embedded.h"

/* A built-in table's column bears the illuminant's name. */
typedef struct illuminant {
    const char *name;
    const char *table; /* NULL: constant 1 */
} illuminant;

static const illuminant illuminants[] = {
    {"A", "cie_illuminants_standard"},
    {"C", "cie_illuminants_standard"},
    {"D50", "cie_illuminants_standard"},
    {"D55", "cie_illuminants_standard"},
    {"D65", "cie_illuminants_standard"},
    {"D75", "cie_illuminants_standard"},
    {"E", NULL},
    {"FL1", "cie_illuminants_fl1-12"},
    {"FL2", "cie_illuminants_fl1-12"},
    {"FL3", "cie_illuminants_fl1-12"},
    {"FL4", "cie_illuminants_fl1-12"},
    {"FL5", "cie_illuminants_fl1-12"},
    {"FL6", "cie_illuminants_fl1-12"},
    {"FL7", "cie_illuminants_fl1-12"},
    {"FL8", "cie_illuminants_fl1-12"},
    {"FL9", "cie_illuminants_fl1-12"},
    {"FL10", "cie_illuminants_fl1-12"},
    {"FL11", "cie_illuminants_fl1-12"},
    {"FL12", "cie_illuminants_fl1-12"},
    {"FL3.1", "cie_illuminants_fl3"},
    {"FL3.2", "cie_illuminants_fl3"},
    {"FL3.3", "cie_illuminants_fl3"},
    {"FL3.4", "cie_illuminants_fl3"},
    {"FL3.5", "cie_illuminants_fl3"},
    {"FL3.6", "cie_illuminants_fl3"},
    {"FL3.7", "cie_illuminants_fl3"},
    {"FL3.8", "cie_illuminants_fl3"},
    {"FL3.9", "cie_illuminants_fl3"},
    {"FL3.10", "cie_illuminants_fl3"},
    {"FL3.11", "cie_illuminants_fl3"},
    {"FL3.12", "cie_illuminants_fl3"},
    {"FL3.13", "cie_illuminants_fl3"},
    {"FL3.14", "cie_illuminants_fl3"},
    {"FL3.15", "cie_illuminants_fl3"},
    {"HP1", "cie_illuminants_hp"},
    {"HP2", "cie_illuminants_hp"},
    {"HP3", "cie_illuminants_hp"},
    {"HP4", "cie_illuminants_hp"},
    {"HP5", "cie_illuminants_hp"},
    {"LED-B1", "cie_illuminants_led"},
    {"LED-B2", "cie_illuminants_led"},
    {"LED-B3", "cie_illuminants_led"},
    {"LED-B4", "cie_illuminants_led"},
    {"LED-B5", "cie_illuminants_led"},
    {"LED-BH1", "cie_illuminants_led"},
    {"LED-RGB1", "cie_illuminants_led"},
    {"LED-V1", "cie_illuminants_led"},
    {"LED-V2", "cie_illuminants_led"},
};
enum { ILLUMINANT_COUNT = sizeof illuminants / sizeof *illuminants };

int mtm_illuminant_count(void) {
    return ILLUMINANT_COUNT;
}

const char *mtm_illuminant_name(int index) {
    return index < 0 || index >= ILLUMINANT_COUNT ? NULL : illuminants[index].name;
}

static const illuminant *find_illuminant(const char *name) {
    for (int i = 0; i < ILLUMINANT_COUNT; i++)
        if (strcasecmp(illuminants[i].name, name) == 0) return &illuminants[i];
    return NULL;
}

static mtm_status fail_unknown(const char *name, mtm_error *error) {
    const char *names[ILLUMINANT_COUNT];
    for (int i = 0; i < ILLUMINANT_COUNT; i++) names[i] = illuminants[i].name;
    return mtm_fail(error, MTM_ARGUMENT, "unknown illuminant '%.64s', did you mean '%s'?", name,
                    mtm_nearest_name(name, names, ILLUMINANT_COUNT));
}

mtm_status mtm_illuminant(const char *name, mtm_spectrum *light, mtm_error *error) {
    assert(name != NULL);
    const illuminant *found = find_illuminant(name);
    if (found == NULL) return fail_unknown(name, error);
    if (found->table != NULL)
        return mtm_embedded_column(found->table, found->name, MTM_KIND_LIGHT, light, error);
    *light = mtm_spectrum_constant(1);
    return MTM_OK;
}
