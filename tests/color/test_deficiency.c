/* SPDX-License-Identifier: BSD-3-Clause
 * What color-blind eyes see, against the published matrices and what is known of the colors they confuse. */
#include <math.h>

#include "fixture.h"

static const mtm_vision blind[] = {MTM_VISION_PROTAN, MTM_VISION_DEUTAN, MTM_VISION_TRITAN};

static mtm_rgb color_of(const char *hex) {
    mtm_error error;
    mtm_rgb linear;
    assert_ok(mtm_rgb_parse(hex, &linear, &error), error);
    return linear;
}

static double difference(mtm_vision vision, double severity, const char *a, const char *b) {
    const char *hex[] = {a, b};
    mtm_lab lab[2];
    for (int i = 0; i < 2; i++) lab[i] = mtm_lab_shown(mtm_vision_see(vision, severity, color_of(hex[i])));
    return mtm_ciede2000(lab[0], lab[1]);
}

static void grays_stay_as_they_are(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++)
        for (int n = 0; n <= 40; n++)
            for (double gray = 0; gray <= 1; gray += 0.25) {
                const mtm_rgb seen = mtm_vision_see(blind[kind], n / 40.0, (mtm_rgb){gray, gray, gray});
                assert_near(seen.r, gray, 3e-6);
                assert_near(seen.g, gray, 3e-6);
                assert_near(seen.b, gray, 3e-6);
            }
}

static void normal_eyes_and_severity_0_change_nothing(void **state) {
    (void)state;
    for (int n = 0; n < 4; n++) {
        double m[3][3];
        mtm_vision_matrix((mtm_vision)n, n == 0 ? 1 : 0, m);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) assert_true(m[i][j] == (i == j));
    }
}

/* The first rows, from the paper's page; with the test above, all that a wrong order of rows or kinds would change. */
static void the_published_matrices_are_met(void **state) {
    (void)state;
    static const struct {
        mtm_vision vision;
        double severity;
        double rows[3][3];
    } published[] = {
        {MTM_VISION_PROTAN,
         1,
         {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
        {MTM_VISION_DEUTAN,
         1,
         {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
        {MTM_VISION_TRITAN,
         1,
         {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
        {MTM_VISION_DEUTAN,
         0.5,
         {{0.547494, 0.607765, -0.155259}, {0.181692, 0.781742, 0.036566}, {-0.010410, 0.027275, 0.983136}}},
        {MTM_VISION_PROTAN,
         0.1,
         {{0.856167, 0.182038, -0.038205}, {0.029342, 0.955115, 0.015544}, {-0.002880, -0.001563, 1.004443}}},
    };
    for (size_t n = 0; n < sizeof published / sizeof published[0]; n++) {
        double m[3][3];
        mtm_vision_matrix(published[n].vision, published[n].severity, m);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) assert_near(m[i][j], published[n].rows[i][j], 1e-12);
    }
}

static void between_tenths_the_matrices_are_interpolated(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++)
        for (int n = 0; n < 10; n++) {
            double low[3][3];
            double high[3][3];
            double between[3][3];
            mtm_vision_matrix(blind[kind], n / 10.0, low);
            mtm_vision_matrix(blind[kind], (n + 1) / 10.0, high);
            mtm_vision_matrix(blind[kind], (n + 0.3) / 10.0, between);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    assert_near(between[i][j], 0.7 * low[i][j] + 0.3 * high[i][j], 1e-12);
        }
}

/* Reds and greens or grays for protan and deutan eyes, blue and green for tritan ones; `other` eyes tell them apart. */
static const struct {
    mtm_vision vision, other;
    const char *a, *b;
} confusions[] = {
    {MTM_VISION_PROTAN, MTM_VISION_TRITAN, "#b06060", "#686860"},
    {MTM_VISION_DEUTAN, MTM_VISION_TRITAN, "#c08070", "#939170"},
    {MTM_VISION_TRITAN, MTM_VISION_DEUTAN, "#5a9c8c", "#5a98b0"},
};

static void each_kind_confuses_its_own_colors(void **state) {
    (void)state;
    for (int n = 0; n < 3; n++) {
        const char *a = confusions[n].a;
        const char *b = confusions[n].b;
        const double normal = difference(MTM_VISION_NORMAL, 1, a, b);
        const double confused = difference(confusions[n].vision, 1, a, b);
        const double apart = difference(confusions[n].other, 1, a, b);
        print_message("%s: %.1f, normal %.1f, %s %.1f\n", mtm_vision_name(confusions[n].vision), confused,
                      normal, mtm_vision_name(confusions[n].other), apart);
        assert_true(confused < 0.3 * normal);
        assert_true(apart > 0.7 * normal);
    }
}

static void confused_colors_come_nearer_with_severity(void **state) {
    (void)state;
    for (int n = 0; n < 3; n++) {
        double before = INFINITY;
        for (int tenths = 0; tenths <= 10; tenths++) {
            const double now =
                difference(confusions[n].vision, tenths / 10.0, confusions[n].a, confusions[n].b);
            if (now > before) fail_msg("%s: %g after %g", mtm_vision_name(confusions[n].vision), now, before);
            before = now;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grays_stay_as_they_are),
        cmocka_unit_test(normal_eyes_and_severity_0_change_nothing),
        cmocka_unit_test(the_published_matrices_are_met),
        cmocka_unit_test(between_tenths_the_matrices_are_interpolated),
        cmocka_unit_test(confused_colors_come_nearer_with_severity),
        cmocka_unit_test(each_kind_confuses_its_own_colors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
