/* SPDX-License-Identifier: BSD-3-Clause
 * How far two materials that match under one light can part under another: the widest place of the metamer mismatch body
 * (A. D. Logvinenko, B. Funt, C. Godau, Metamer Mismatching, IEEE TIP 23(1), 2014), all colors under the second light of the
 * reflectances 0 ≤ ρ ≤ 1 that show one color under the first. The body is convex, and a linear program for a direction
 * gives the spectrum at its end there. Real materials are smoother than such spectra, so they can be bounded further
 * (G. D. Finlayson, P. Morovic, Metamer sets, JOSA A 22(5), 2005).
 *
 * CIEDE2000 is no norm, so the widest place is looked for: the widest pair of ends in directions spread evenly over CIELAB,
 * then each of the two moved in turn towards the end where the difference grows fastest, as long as it grows; the same
 * from some more pairs, of other ends. Every pair is one that can be had, so the result errs by being too small only. */
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/qp.h"
#include "metamer/palette.h"

enum {
    SAMPLES = MTM_SPECTRUM_SAMPLES,
    DIRECTIONS = 48,
    STARTS = 4,
    ROUNDS_MAX = 8,
    SHARES = 9, /* of the way to an end that are tried: 1 … 0.06 */
    ENDS_MAX = DIRECTIONS + 6,
};

/* A light as the three curves whose sums with a reflectance are its linear sRGB. */
typedef struct response {
    double curves[3][SAMPLES];
} response;

/* An end of the body. */
typedef struct end {
    mtm_spectrum reflectance;
    double rgb[3]; /* under the second light, linear, not clipped */
} end;

typedef struct end_pair {
    double separation;
    end ends[2];
} end_pair;

typedef struct mismatch_body {
    response first, second;
    double color[3]; /* under the first light */
    double bend;
    int end_count;
    end ends[ENDS_MAX];
} mismatch_body;

static response response_of(const mtm_illumination *light) {
    response made;
    const mtm_observer *eye = &light->observer;
    for (int c = 0; c < 3; c++) {
        const double *m = light->rgb_from_xyz[c];
        for (int k = 0; k < SAMPLES; k++)
            made.curves[c][k] = light->light.value[k] *
                                (m[0] * eye->x.value[k] + m[1] * eye->y.value[k] + m[2] * eye->z.value[k]);
    }
    return made;
}

static void respond(const response *light, const mtm_spectrum *reflectance, double rgb[3]) {
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int k = 0; k < SAMPLES; k++) rgb[c] += light->curves[c][k] * reflectance->value[k];
    }
}

/* The reflectance that shows the color under the first light with the least linear·ρ + ½·size·|ρ|². */
static mtm_status minimize(const mismatch_body *body, const double *linear, double size, double give,
                           end *found, mtm_error *error) {
    mtm_qp_sum sums[3];
    for (int k = 0; k < SAMPLES; k++) found->reflectance.value[k] = 0.5;
    for (int c = 0; c < 3; c++)
        sums[c] = (mtm_qp_sum){.term_count = 1,
                               .terms = {{0, body->first.curves[c]}},
                               .low = body->color[c],
                               .high = body->color[c],
                               .give = give};
    mtm_qp_curve curve = {.size = size,
                          .linear = linear,
                          .low = 0,
                          .high = 1,
                          .bend = body->bend,
                          .x = found->reflectance.value};
    mtm_qp program = {SAMPLES, 1, &curve, 3, sums};
    const mtm_status status = mtm_qp_minimize(&program, error);
    respond(&body->second, &found->reflectance, found->rgb);
    return status;
}

/* The body's end in a direction, which is one of linear sRGB under the second light. */
static mtm_status find_end(const mismatch_body *body, const double direction[3], end *found,
                           mtm_error *error) {
    static const double size = 1e-6, size_bent = 1e-4, give = 1e-9;
    double linear[SAMPLES];
    double largest = 0;
    for (int k = 0; k < SAMPLES; k++) {
        linear[k] = 0;
        for (int c = 0; c < 3; c++) linear[k] -= direction[c] * body->second.curves[c][k];
        largest = fmax(largest, fabs(linear[k]));
    }
    for (int k = 0; k < SAMPLES && largest > 0; k++) linear[k] /= largest;
    return minimize(body, linear, body->bend > 0 ? size_bent : size, give, found, error);
}

/* How far the nearest color of any reflectance is from the one asked for, at most `tolerance` where that can be met. Sums
 * that give way settle also where it cannot, the more the better, but are less exact. */
static mtm_status find_miss(const mismatch_body *body, double *miss, double *tolerance, mtm_error *error) {
    static const double sizes[] = {1e-6, 1e-3}, gives[] = {1e-4, 1e-1}, tolerances[] = {1e-5, 3e-3};
    mtm_status status = MTM_NUMERIC;
    double rgb[3];
    end found;
    for (int n = 0; n < 2 && status == MTM_NUMERIC; n++) {
        status = minimize(body, NULL, sizes[n], gives[n], &found, error);
        *tolerance = tolerances[n];
    }
    respond(&body->first, &found.reflectance, rgb);
    *miss = 0;
    for (int c = 0; c < 3; c++) *miss = fmax(*miss, fabs(rgb[c] - body->color[c]));
    return status;
}

/* Whether the body has any point. */
static mtm_status check_color(const mismatch_body *body, mtm_error *error) {
    char bend[64] = "";
    double miss = 0;
    double tolerance = 0;
    const mtm_status status = find_miss(body, &miss, &tolerance, error);
    if (status != MTM_OK || miss <= tolerance) return status;
    if (body->bend > 0) (void)snprintf(bend, sizeof bend, " and second differences up to %g", body->bend);
    return mtm_fail(error, MTM_NUMERIC,
                    "no reflectance between 0 and 1%s has the linear sRGB color (%.4g, %.4g, %.4g) under the "
                    "first light",
                    bend, body->color[0], body->color[1], body->color[2]);
}

/* As the picture shows them. */
static double separation_of(const double a[3], const double b[3]) {
    return mtm_ciede2000(mtm_lab_shown((mtm_rgb){a[0], a[1], a[2]}),
                         mtm_lab_shown((mtm_rgb){b[0], b[1], b[2]}));
}

/* A direction in which rounding keeps the program from settling is left out. */
static mtm_status add_end(mismatch_body *body, const double direction[3], mtm_error *error) {
    end *found = &body->ends[body->end_count];
    const mtm_status status = find_end(body, direction, found, error);
    if (status == MTM_NUMERIC) return MTM_OK;
    if (status == MTM_OK) body->end_count++;
    return status;
}

static mtm_lab lab_of(const double rgb[3]) {
    return mtm_lab_from_xyz(mtm_xyz_from_rgb((mtm_rgb){rgb[0], rgb[1], rgb[2]}), mtm_white_d65());
}

/* Three times three: how CIELAB grows with linear sRGB, in the middle of the ends found so far. */
static void find_growth(const mismatch_body *body, double growth[3][3]) {
    static const double step = 1e-4;
    double middle[3] = {0, 0, 0};
    for (int n = 0; n < body->end_count; n++)
        for (int c = 0; c < 3; c++) middle[c] += body->ends[n].rgb[c] / body->end_count;
    const mtm_lab from = lab_of(middle);
    for (int c = 0; c < 3; c++) {
        middle[c] += step;
        const mtm_lab to = lab_of(middle);
        middle[c] -= step;
        growth[0][c] = (to.l - from.l) / step;
        growth[1][c] = (to.a - from.a) / step;
        growth[2][c] = (to.b - from.b) / step;
    }
}

/* Ends along the axes, then in directions on a spiral, spread evenly in CIELAB (R. Swinbank, R. J. Purser, Fibonacci
 * grids, Q. J. R. Meteorol. Soc. 132, 2006). */
static mtm_status find_ends(mismatch_body *body, mtm_error *error) {
    static const double golden_turn = 2.39996322972865332; /* π (3 − √5) */
    double growth[3][3];
    mtm_status status = check_color(body, error);
    for (int n = 0; n < 6 && status == MTM_OK; n++) {
        double direction[3] = {0, 0, 0};
        direction[n / 2] = n % 2 ? 1 : -1;
        status = add_end(body, direction, error);
    }
    if (status == MTM_OK && body->end_count == 0) status = MTM_NUMERIC; /* the error holds the last one's */
    if (status == MTM_OK) find_growth(body, growth);
    for (int n = 0; n < DIRECTIONS && status == MTM_OK; n++) {
        const double height = 1 - (2 * n + 1.0) / DIRECTIONS;
        const double radius = sqrt(1 - height * height);
        const double spread[3] = {height, radius * cos(golden_turn * n), radius * sin(golden_turn * n)};
        double direction[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            for (int c = 0; c < 3; c++) direction[c] += spread[i] * growth[i][c];
        status = add_end(body, direction, error);
    }
    return status;
}

/* The widest pair of ends that were not chosen before; false where fewer than two are left. */
static bool choose_widest(const mismatch_body *body, bool is_chosen[], end_pair *pair) {
    int chosen[2] = {0, 0};
    pair->separation = -1;
    for (int a = 0; a < body->end_count; a++)
        for (int b = a + 1; b < body->end_count; b++) {
            const double separation = separation_of(body->ends[a].rgb, body->ends[b].rgb);
            if (is_chosen[a] || is_chosen[b] || separation <= pair->separation) continue;
            *pair = (end_pair){separation, {body->ends[a], body->ends[b]}};
            chosen[0] = a;
            chosen[1] = b;
        }
    is_chosen[chosen[0]] = is_chosen[chosen[1]] = true;
    return pair->separation >= 0;
}

/* The direction of linear sRGB in which the difference of `moved` from `other` grows fastest. */
static void find_direction(const double moved[3], const double other[3], double direction[3]) {
    static const double step = 1e-5;
    for (int c = 0; c < 3; c++) {
        double up[3];
        double down[3];
        memcpy(up, moved, sizeof up);
        memcpy(down, moved, sizeof down);
        up[c] += step;
        down[c] -= step;
        direction[c] = separation_of(up, other) - separation_of(down, other);
    }
}

/* The body is convex, so what lies between two of its points is in it, too. */
static end mix_ends(const end *a, const end *b, double share) {
    end mixed;
    for (int k = 0; k < SAMPLES; k++)
        mixed.reflectance.value[k] = (1 - share) * a->reflectance.value[k] + share * b->reflectance.value[k];
    for (int c = 0; c < 3; c++) mixed.rgb[c] = (1 - share) * a->rgb[c] + share * b->rgb[c];
    return mixed;
}

/* Moves one of the pair to an end or a part of the way there; whether that parted them farther. */
static mtm_status widen(const mismatch_body *body, int moved, end_pair *pair, bool *is_wider,
                        mtm_error *error) {
    const end *other = &pair->ends[1 - moved];
    const end from = pair->ends[moved];
    double direction[3];
    end to;
    *is_wider = false;
    find_direction(from.rgb, other->rgb, direction);
    const mtm_status status = find_end(body, direction, &to, error);
    if (status != MTM_OK) return status == MTM_NUMERIC ? MTM_OK : status;
    for (int n = 0; n < SHARES; n++) {
        const double share = pow(0.7, n);
        const end mixed = mix_ends(&from, &to, share);
        const double separation = separation_of(mixed.rgb, other->rgb);
        if (separation <= pair->separation * (1 + 1e-6)) continue;
        pair->separation = separation;
        pair->ends[moved] = mixed;
        *is_wider = true;
    }
    return MTM_OK;
}

static mtm_status widen_in_turn(const mismatch_body *body, end_pair *pair, mtm_error *error) {
    mtm_status status = MTM_OK;
    int idle = 0; /* ends in a row that found nothing wider */
    for (int n = 0; n < 2 * ROUNDS_MAX && idle < 2 && status == MTM_OK; n++) {
        bool is_wider = false;
        status = widen(body, n % 2, pair, &is_wider, error);
        idle = is_wider ? 0 : idle + 1;
    }
    return status;
}

mtm_status mtm_mismatch_find(const mtm_illumination *first, const mtm_illumination *second, mtm_rgb color,
                             double bend, mtm_mismatch *result, mtm_error *error) {
    assert(bend == 0 || bend >= MTM_MISMATCH_BEND_MIN);
    mismatch_body body = {.first = response_of(first),
                          .second = response_of(second),
                          .color = {color.r, color.g, color.b},
                          .bend = bend};
    bool is_chosen[ENDS_MAX] = {false};
    end_pair widest = {.separation = -1};
    end_pair pair;
    mtm_status status = find_ends(&body, error);
    for (int n = 0; n < STARTS && status == MTM_OK && choose_widest(&body, is_chosen, &pair); n++) {
        status = widen_in_turn(&body, &pair, error);
        if (pair.separation > widest.separation) widest = pair;
    }
    if (status == MTM_OK)
        *result = (mtm_mismatch){widest.separation, {widest.ends[0].reflectance, widest.ends[1].reflectance}};
    return status;
}
