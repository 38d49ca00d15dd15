/* SPDX-License-Identifier: BSD-3-Clause
 * Designs for tests, and what they look like: judged from the palette alone, by full spectra and through a basis. */
#ifndef METAMER_TEST_PALETTE_DESIGNS_H
#define METAMER_TEST_PALETTE_DESIGNS_H

#include <math.h>

#include "metamer/metamer.h"
#include "test.h"

enum { N = MTM_SPECTRUM_SAMPLES };

static inline mtm_design *design_with(const char *text, const mtm_design_options *options) {
    mtm_error error;
    mtm_goals *goals = NULL;
    mtm_design *design = NULL;
    assert_ok(mtm_goals_parse("test.json", text, METAMER_SOURCE_DIR "/data/spectra", &goals, &error), error);
    assert_ok(mtm_design_find(goals, options, &design, &error), error);
    mtm_goals_destroy(goals);
    return design;
}

static inline mtm_design *design_of(const char *text) {
    return design_with(text, NULL);
}

/* The picture's color of a cell: by full spectra, or by a basis' matrix on its coefficients. */
static inline mtm_lab look(const mtm_palette *palette, mtm_cell cell, const char *basis_name) {
    mtm_error error;
    mtm_observer observer;
    mtm_basis *basis = NULL;
    double weights[MTM_LIGHTS_MAX] = {0};
    double matrix[3 * MTM_DIMENSION_MAX], coefficients[MTM_DIMENSION_MAX];
    const mtm_spectrum *reflectance = &palette->materials[cell.material].reflectance;
    weights[cell.light] = 1;
    const mtm_spectrum light = mtm_palette_mix(palette, weights, 1);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    const mtm_illumination illumination = mtm_illumination_of(&light, &observer, 0);
    mtm_rgb rgb = mtm_illuminate(&illumination, reflectance);
    if (basis_name != NULL) {
        assert_ok(mtm_basis_create(basis_name, 0, NULL, NULL, &basis, &error), error);
        assert_ok(mtm_basis_matrix(basis, &illumination, matrix, &error), error);
        assert_ok(mtm_basis_encode(basis, reflectance, coefficients, &error), error);
        rgb = mtm_basis_color(mtm_basis_dimension(basis), matrix, coefficients);
        mtm_basis_destroy(basis);
    }
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(rgb), mtm_white_d65());
}

/* What a goal lacks, from the palette alone. */
static inline double lack_of(const mtm_palette *palette, const mtm_goal *goal, const char *basis) {
    const mtm_lab own = look(palette, goal->cell, basis);
    const mtm_xyz black = {0, 0, 0};
    const mtm_lab other = goal->kind == MTM_GOAL_COLOR ? mtm_lab_from_xyz(goal->color, mtm_white_d65())
                          : goal->other.material < 0   ? mtm_lab_from_xyz(black, mtm_white_d65())
                                                       : look(palette, goal->other, basis);
    const double difference = mtm_ciede2000(own, other);
    return goal->kind == MTM_GOAL_DIFFERENT ? fmax(0, goal->least - difference) : difference;
}

/* The report is true, and every goal is met within these CIEDE2000. */
static inline void assert_met(const mtm_design *design, double full, double basis) {
    assert_true(design->result_count > 0);
    for (int i = 0; i < design->result_count; i++) {
        const mtm_goal_result *result = &design->results[i];
        const double lack = lack_of(&design->palette, &result->goal, NULL);
        const double lack_basis = lack_of(&design->palette, &result->goal, design->basis);
        assert_float_equal(result->ciede2000, lack, 1e-6);
        assert_float_equal(result->ciede2000_basis, lack_basis, 1e-6);
        if (!(lack <= full && lack_basis <= basis)) fail_msg("goal %d lacks %g and %g", i, lack, lack_basis);
    }
}

static inline void assert_physical(const mtm_design *design) {
    for (int m = 0; m < design->palette.material_count; m++) {
        assert_true(design->materials[m] != MTM_HONESTY_ARTIFICIAL);
        for (int i = 0; i < N; i++) {
            const double value = design->palette.materials[m].reflectance.value[i];
            assert_true(value >= 0 && value <= 1);
        }
    }
    for (int l = 0; l < design->palette.light_count; l++)
        for (int i = 0; i < N; i++) assert_true(design->palette.lights[l].emission.value[i] >= 0);
}

#endif
