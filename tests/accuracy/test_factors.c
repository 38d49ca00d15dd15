/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/factors.h"

#include <math.h>
#include <stdlib.h>

#include "test.h"

enum { N = MTM_SPECTRUM_SAMPLES, VARIABLES_MAX = 2 * FACTORS_MAX * N };

static int make_training(void **state) {
    static training_set training;
    collection spectra;
    if (collection_read(METAMER_SOURCE_DIR, NULL, &spectra, NULL) != MTM_OK) return 1;
    const mtm_status status = training_create(METAMER_SOURCE_DIR, &spectra, &training, NULL);
    collection_free(&spectra);
    *state = &training;
    return status != MTM_OK;
}

static int free_training(void **state) {
    training_free(*state);
    return 0;
}

static void color_of(const observed_light *light, const double *reflectance, double xyz[3]) {
    for (int c = 0; c < 3; c++) {
        xyz[c] = 0;
        for (int i = 0; i < N; i++) xyz[c] += light->value[c][i] * reflectance[i];
    }
}

static void reflectances_are_physical_and_lights_equally_bright(void **state) {
    const training_set *training = *state;
    double one[N];
    for (int i = 0; i < N; i++) one[i] = 1;
    assert_int_equal(training->light_count, 20 + 60);
    for (int l = 0; l < training->light_count; l++) {
        double xyz[3];
        color_of(&training->lights[l], one, xyz);
        assert_float_equal(xyz[1], 1, 1e-9);
    }
    assert_in_range(training->reflectance_count, 400, 61 + 190 + 170 + 30);
    for (int r = 0; r < training->reflectance_count; r++)
        for (int i = 0; i < N; i++)
            assert_true(training->reflectances[r].value[i] >= 0 && training->reflectances[r].value[i] <= 1);
}

/* A single reflectance is seen as it is, products half way to the luminance of their first factor. */
static void targets_are_the_true_colors_of_the_products(void **state) {
    const training_set *training = *state;
    for (int n = 0; n < training->draw_count; n++) {
        const observed_light *light = &training->lights[training->draws[n].light];
        double product[N];
        double first_luminance = 0;
        for (int m = 0; m < DRAW_REFLECTANCES; m++) {
            const double *reflectance = training->reflectances[training->draws[n].reflectance[m]].value;
            const lab_target *target = &training->targets[n * DRAW_REFLECTANCES + m];
            double xyz[3], ignored[3];
            for (int i = 0; i < N; i++) product[i] = m == 0 ? reflectance[i] : product[i] * reflectance[i];
            color_of(light, product, xyz);
            if (m == 0) first_luminance = xyz[1];
            assert_float_equal(lab_error(target, xyz, ignored), 0, 1e-9);
            const double exposure = fmin(sqrt(first_luminance / xyz[1]), sqrt(50));
            assert_float_equal(target->scale[1], exposure, 1e-9 * exposure); /* the white has y = 1 */
        }
    }
}

static void spectra_that_are_missing_are_named(void **state) {
    (void)state;
    const collection_item item = {.name = "one", .spectrum = mtm_spectrum_constant(1)};
    collection spectra = {{0}, {0}};
    training_set training;
    mtm_error error;
    assert_fails(training_create(METAMER_SOURCE_DIR, &spectra, &training, &error), MTM_ARGUMENT, error,
                 "accuracy/split.csv: no lights or no reflectances to train with");
    assert_ok(collection_append(&spectra.lights, &item, &error), error);
    assert_ok(collection_append(&spectra.reflectances, &item, &error), error);
    assert_fails(training_create("no-folder", &spectra, &training, &error), MTM_IO, error,
                 "no-folder/data/spectra/reflectance_aces190.csv");
    collection_free(&spectra);
}

/* Variables near the start, where no slope is small. */
static void random_variables(int dimension, double *variables) {
    random_state random = 5;
    factor_start(dimension, variables);
    for (int i = 0; i < factor_variable_count(dimension); i++)
        variables[i] *= random_between(&random, 0.8, 1.2);
}

static void curves_meet_their_conditions_for_any_variables(void **state) {
    (void)state;
    double variables[VARIABLES_MAX];
    random_state random = 9;
    for (int dimension = FACTORS_MIN; dimension <= FACTORS_MAX; dimension++) {
        factor_curves curves;
        for (int i = 0; i < factor_variable_count(dimension); i++)
            variables[i] = random_between(&random, -1, 1);
        factor_curves_of(dimension, variables, &curves);
        for (int j = 0; j < dimension; j++) {
            double sum = 0;
            for (int i = 0; i < N; i++) {
                assert_true(curves.encode[j][i] >= 0);
                sum += curves.encode[j][i];
            }
            assert_float_equal(sum, 1, 1e-13);
        }
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int j = 0; j < dimension; j++) sum += curves.spectrum[j][i];
            assert_float_equal(sum, 1, 1e-13);
        }
    }
}

static double roughness(const double *curve) {
    double sum = 0;
    for (int i = 1; i + 1 < N; i++) sum += pow(curve[i + 1] - 2 * curve[i] + curve[i - 1], 2);
    return sum;
}

/* Encodes, multiplies, reconstructs and lights every draw on its own, spectrum by spectrum. */
static double slow_value(const training_set *training, const factor_curves *curves) {
    double sum = 0;
    for (int n = 0; n < training->draw_count; n++) {
        double codes[FACTORS_MAX];
        for (int j = 0; j < curves->dimension; j++) codes[j] = 1;
        for (int m = 0; m < DRAW_REFLECTANCES; m++) {
            const double *reflectance = training->reflectances[training->draws[n].reflectance[m]].value;
            double spectrum[N] = {0};
            double xyz[3], ignored[3];
            for (int j = 0; j < curves->dimension; j++) {
                double mean = 0;
                for (int i = 0; i < N; i++) mean += curves->encode[j][i] * reflectance[i];
                codes[j] *= mean;
                for (int i = 0; i < N; i++) spectrum[i] += curves->spectrum[j][i] * codes[j];
            }
            color_of(&training->lights[training->draws[n].light], spectrum, xyz);
            sum += lab_error(&training->targets[n * DRAW_REFLECTANCES + m], xyz, ignored);
        }
    }
    double value = sum / (training->draw_count * DRAW_REFLECTANCES);
    for (int j = 0; j < curves->dimension; j++)
        value += 0.1 * roughness(curves->encode[j]) + 0.01 * roughness(curves->spectrum[j]);
    return value;
}

static void the_objective_is_the_mean_error_and_the_roughness(void **state) {
    static double variables[VARIABLES_MAX], gradient[VARIABLES_MAX];
    for (int dimension = 3; dimension <= 8; dimension += 5) {
        factor_objective *objective = NULL;
        factor_curves curves;
        mtm_error error;
        assert_ok(factor_objective_create(*state, dimension, &objective, &error), error);
        random_variables(dimension, variables);
        factor_curves_of(dimension, variables, &curves);
        const double value = factor_objective_value(objective, variables, gradient);
        assert_true(value > 0.1);
        assert_float_equal(value, slow_value(*state, &curves), 1e-9 * value);
        factor_objective_destroy(objective);
    }
}

/* Central differences along every kind of variable, and along a direction through all of them. */
static void the_gradient_is_that_of_the_objective(void **state) {
    static double variables[VARIABLES_MAX], moved[VARIABLES_MAX], gradient[VARIABLES_MAX],
        ignored[VARIABLES_MAX];
    const int dimension = 4;
    const int count = factor_variable_count(dimension);
    const double step = 1e-5;
    factor_objective *objective = NULL;
    mtm_error error;
    assert_ok(factor_objective_create(*state, dimension, &objective, &error), error);
    random_variables(dimension, variables);
    (void)factor_objective_value(objective, variables, gradient);
    random_state random = 3;
    for (int n = 0; n < 25; n++) {
        const bool is_along_all = n == 0;
        const int index = random_below(&random, count);
        double expected = 0;
        double values[2];
        for (int side = 0; side < 2; side++) {
            for (int i = 0; i < count; i++) {
                const double direction = is_along_all ? (i % 3 - 1) * variables[i] : i == index;
                moved[i] = variables[i] + (side == 0 ? -step : step) * direction;
                if (side == 0) expected += gradient[i] * direction;
            }
            values[side] = factor_objective_value(objective, moved, ignored);
        }
        const double slope = (values[1] - values[0]) / (2 * step);
        assert_float_equal(slope, expected, 1e-5 * fabs(expected) + 1e-8);
    }
    factor_objective_destroy(objective);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reflectances_are_physical_and_lights_equally_bright),
        cmocka_unit_test(targets_are_the_true_colors_of_the_products),
        cmocka_unit_test(spectra_that_are_missing_are_named),
        cmocka_unit_test(curves_meet_their_conditions_for_any_variables),
        cmocka_unit_test(the_objective_is_the_mean_error_and_the_roughness),
        cmocka_unit_test(the_gradient_is_that_of_the_objective),
    };
    return cmocka_run_group_tests(tests, make_training, free_training);
}
