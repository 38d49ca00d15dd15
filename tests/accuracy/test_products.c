/* SPDX-License-Identifier: BSD-3-Clause
 * Errors over draws: a set small enough to know what must come out. */
#include <stdlib.h>

#include "accuracy/products.h"
#include "test.h"

typedef struct fixture {
    collection_list lights, reflectances;
    product_set set;
} fixture;

static void append_light(fixture *made, const char *name, collection_part part) {
    mtm_error error;
    mtm_observer observer;
    collection_item item = {.part = part};
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_illuminant(name, &item.spectrum, &error), error);
    assert_ok(mtm_light_normalize(&item.spectrum, &observer, &item.spectrum, &error), error);
    assert_ok(collection_append(&made->lights, &item, &error), error);
}

/* Rises from `low` to `high` over the grid. */
static void append_reflectance(fixture *made, double low, double high) {
    mtm_error error;
    collection_item item = {.part = PART_TEST};
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        item.spectrum.value[i] = low + (high - low) * i / (MTM_SPECTRUM_SAMPLES - 1);
    assert_ok(collection_append(&made->reflectances, &item, &error), error);
}

/* One draw: light 0 … 1 on reflectances 0 (gray) … 1. The set points into the fixture, which stays where it is. */
static void create(int light, int first, int second, int third, fixture *made) {
    mtm_error error;
    *made = (fixture){.lights = {.count = 0}};
    append_light(made, "D65", PART_SMOOTH);
    append_light(made, "FL11", PART_FLUORESCENT);
    append_reflectance(made, 0.5, 0.5);
    append_reflectance(made, 0.05, 0.9);
    product_draw *draws = calloc(1, sizeof *draws);
    assert_non_null(draws);
    draws[0] = (product_draw){light, {first, second, third}};
    assert_ok(product_set_create(&made->lights, &made->reflectances, 1, draws, &made->set, &error), error);
}

static void destroy(fixture *made) {
    product_set_free(&made->set);
    collection_list_free(&made->lights);
    collection_list_free(&made->reflectances);
}

static product_errors measure(const fixture *made, model_family family, int dimension) {
    model tested;
    product_errors errors;
    mtm_error error;
    assert_ok(model_create(METAMER_SOURCE_DIR, (model_choice){family, dimension}, &tested, &error), error);
    assert_ok(product_errors_measure(&tested, &made->set, &errors, &error), error);
    model_free(&tested);
    return errors;
}

static void truths_are_products_of_spectra(void **state) {
    (void)state;
    fixture made;
    create(1, 0, 0, 0, &made);
    const product_truth *truth = &made.set.truths[0];
    assert_float_equal(truth->white.y, 1, 1e-12);
    for (int i = 0; i < DRAW_REFLECTANCES; i++)
        assert_float_equal(truth->products[i].y, 1.0 / (2 << i), 1e-12);
    destroy(&made);
}

static void the_reference_has_no_error(void **state) {
    (void)state;
    fixture made;
    create(1, 1, 0, 1, &made);
    const product_errors errors = measure(&made, FAMILY_WAVELENGTHS, 0);
    for (int i = 0; i < DRAW_REFLECTANCES; i++) assert_float_equal(errors.products[i].max, 0, 1e-5);
    for (int i = 0; i < FILTERS_MAX; i++) assert_float_equal(errors.filtered[i].max, 0, 1e-5);
    assert_float_equal(errors.matched.max, 0, 1e-5);
    destroy(&made);
}

static void grays_are_exact_in_every_model_that_knows_white(void **state) {
    (void)state;
    static const model_choice choices[] = {
        {FAMILY_RGB, 0}, {FAMILY_FACTORS, 7}, {FAMILY_PEERCY, 5}, {FAMILY_WAVELENGTHS_31, 0}};
    fixture made;
    create(1, 0, 0, 0, &made);
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++)
        assert_float_equal(measure(&made, choices[i].family, choices[i].dimension).products[2].max, 0, 1e-4);
    destroy(&made);
}

/* RGB is exact under D65 for one reflectance, and not for two. */
static void products_are_counted_from_one(void **state) {
    (void)state;
    fixture made;
    create(0, 1, 1, 1, &made);
    const product_errors errors = measure(&made, FAMILY_RGB, 0);
    assert_float_equal(errors.products[0].max, 0, 1e-4);
    assert_true(errors.products[1].max > 1);
    assert_true(errors.products[2].max > errors.products[1].max / 2);
    destroy(&made);
}

/* The third product is darker than the first, so matching the exposure lets more be seen. */
static void matched_errors_are_those_of_brighter_colors(void **state) {
    (void)state;
    fixture made;
    create(0, 1, 1, 1, &made);
    const product_errors errors = measure(&made, FAMILY_RGB, 0);
    assert_true(errors.matched.max > 1.1 * errors.products[2].max);
    destroy(&made);
}

/* A gray filter changes nothing but the brightness, which the white takes out again. */
static void a_gray_filter_shows_the_reflectance_at_full_brightness(void **state) {
    (void)state;
    fixture plain;
    create(1, 1, 0, 0, &plain);
    fixture filtered;
    create(1, 0, 1, 0, &filtered);
    const product_errors expected = measure(&plain, FAMILY_RGB, 0);
    const product_errors errors = measure(&filtered, FAMILY_RGB, 0);
    assert_true(expected.products[0].max > 1);
    assert_float_equal(errors.filtered[0].max, expected.products[0].max, 1e-6);
    destroy(&plain);
    destroy(&filtered);
}

static void errors_go_to_the_class_of_the_light(void **state) {
    (void)state;
    fixture made;
    create(1, 1, 0, 0, &made);
    const product_errors errors = measure(&made, FAMILY_RGB, 0);
    assert_float_equal(errors.class_mean[0], 0, 0);
    assert_float_equal(errors.class_mean[1], 0, 0);
    assert_float_equal(errors.class_mean[2], errors.products[0].mean, 1e-12);
    destroy(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truths_are_products_of_spectra),
        cmocka_unit_test(the_reference_has_no_error),
        cmocka_unit_test(grays_are_exact_in_every_model_that_knows_white),
        cmocka_unit_test(products_are_counted_from_one),
        cmocka_unit_test(matched_errors_are_those_of_brighter_colors),
        cmocka_unit_test(a_gray_filter_shows_the_reflectance_at_full_brightness),
        cmocka_unit_test(errors_go_to_the_class_of_the_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
