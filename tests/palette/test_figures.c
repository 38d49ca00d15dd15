/* SPDX-License-Identifier: BSD-3-Clause
 * The figures of S. Bergner, T. Möller, M. Tory, M. S. Drew, IEEE TVCG 11(2), 2005, with physical spectra. */
#include "palette/designs.h"

static void check_figure(const char *text, double basis) {
    mtm_design *design = design_of(text);
    assert_met(design, 0.5, basis);
    assert_physical(design);
    for (int i = 0; i < design->palette.material_count; i++)
        assert_int_equal(design->materials[i], MTM_HONESTY_PHYSICAL);
    mtm_design_destroy(design);
}

static void the_figures_of_the_paper_have_physical_spectra(void **state) {
    (void)state;
    check_figure("{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 2\"}]}", 1);
    check_figure("{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 5\"}]}", 1);
    check_figure("{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 6\"}]}", 2);
    check_figure("{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 7\"}]}", 1);
}

/* Leaving a view out leaves it to chance, which shows. */
static void leaving_a_view_out_shows_in_it(void **state) {
    (void)state;
    static const char text[] = "{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 2\"}]}";
    mtm_design_options options = mtm_design_defaults();
    for (int k = 0; k < 2; k++) {
        double worst[2] = {0, 0};
        options.without = k == 0 ? MTM_DESIGN_WITHOUT_BASIS : MTM_DESIGN_WITHOUT_FULL;
        mtm_design *design = design_with(text, &options);
        for (int i = 0; i < design->result_count; i++) {
            worst[0] = fmax(worst[0], design->results[i].ciede2000);
            worst[1] = fmax(worst[1], design->results[i].ciede2000_basis);
        }
        assert_true(worst[k] < 1);
        assert_true(worst[1 - k] > 5);
        mtm_design_destroy(design);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_figures_of_the_paper_have_physical_spectra),
        cmocka_unit_test(leaving_a_view_out_shows_in_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
