/* SPDX-License-Identifier: BSD-3-Clause
 * A basis fitted to a few lamps does well on the lines that these have and less well between them. So each measured
 * light is also mixed with a metamer of itself that consists of three lines, a share of 0…1 of it: lamps of the same
 * white, anything from three lasers' width to nearly the measured lamp. */
#include "synthetic_lights.h"

#include <math.h>
#include <stdio.h>

#include "fail.h"

/* A line's center and full width at half its height are drawn from these. */
typedef struct line_range {
    double center_min_nm, center_max_nm;
} line_range;
static const line_range line_ranges[3] = {{430, 480}, {505, 570}, {590, 660}}; /* blue, green, red */
static const double width_min_nm = 10;
static const double width_max_nm = 40;

enum { ATTEMPTS_MAX = 1000 };

/* (1 + (2¼ − 1) x²)⁻⁴ with x = 1 at half the height: close to a Gaussian, from IEEE operations only. */
static mtm_spectrum make_line(double center_nm, double width_nm) {
    const double half = sqrt(sqrt(2.0)) - 1;
    mtm_spectrum line;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double x =
            (MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i - center_nm) / (0.5 * width_nm);
        const double base = 1 + half * x * x;
        line.value[i] = 1 / (base * base * base * base);
    }
    return line;
}

static double determinant(mtm_xyz a, mtm_xyz b, mtm_xyz c) {
    return a.x * (b.y * c.z - c.y * b.z) - b.x * (a.y * c.z - c.y * a.z) + c.x * (a.y * b.z - b.y * a.z);
}

/* Three random lines of the color `white`; false where that would need a negative one. */
static bool make_triple(random_state *state, mtm_xyz white, const mtm_observer *observer,
                        mtm_spectrum *triple) {
    mtm_spectrum lines[3];
    mtm_xyz colors[3];
    for (int i = 0; i < 3; i++) {
        const double center_nm =
            random_between(state, line_ranges[i].center_min_nm, line_ranges[i].center_max_nm);
        lines[i] = make_line(center_nm, random_between(state, width_min_nm, width_max_nm));
        colors[i] = mtm_xyz_of(&lines[i], observer);
    }
    const double whole = determinant(colors[0], colors[1], colors[2]);
    const double powers[3] = {determinant(white, colors[1], colors[2]) / whole,
                              determinant(colors[0], white, colors[2]) / whole,
                              determinant(colors[0], colors[1], white) / whole};
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        triple->value[i] =
            powers[0] * lines[0].value[i] + powers[1] * lines[1].value[i] + powers[2] * lines[2].value[i];
    return powers[0] > 0 && powers[1] > 0 && powers[2] > 0;
}

mtm_status synthetic_lights_append(int count, random_state seed, int measured_count, collection_list *lights,
                                   mtm_error *error) {
    mtm_observer observer;
    mtm_status status = mtm_observer_get("cie1931", &observer, error);
    random_state state = seed;
    for (int n = 0; n < count && status == MTM_OK; n++) {
        const mtm_spectrum measured = lights->items[n % measured_count].spectrum;
        const mtm_xyz white = mtm_xyz_of(&measured, &observer);
        collection_item item = {.table = "synthetic", .part = PART_TRAIN};
        mtm_spectrum triple;
        int attempt = 0;
        while (attempt < ATTEMPTS_MAX && !make_triple(&state, white, &observer, &triple)) attempt++;
        if (attempt == ATTEMPTS_MAX)
            return fail(error, MTM_NUMERIC, "light '%s': no three lines of light have its color",
                        lights->items[n % measured_count].name);
        const double share = random_between(&state, 0, 1);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
            item.spectrum.value[i] = share * triple.value[i] + (1 - share) * measured.value[i];
        (void)snprintf(item.name, sizeof item.name, "%d", n + 1);
        status = collection_append(lights, &item, error);
    }
    return status;
}
