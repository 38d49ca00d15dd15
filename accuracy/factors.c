/* SPDX-License-Identifier: BSD-3-Clause
 * The fit of the basis `factors`.
 *
 * The variables are q (d × 81) and b (d × 81). P = q²/Σ q² is never negative and b, moved at each wavelength by the
 * same number for all coefficients until the sum is 1, is B; so no bounds and no conditions are left to the minimizer.
 *
 * Value and gradient go over every reflectance once (encoding it), over every light once (its matrix), and over the
 * draws, which only take indices of these. Sums run in the order of the indices, in doubles, with + − × ÷ and square
 * roots only, so that every compiler and machine finds the same curves. */
#include "factors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { N = MTM_SPECTRUM_SAMPLES, D = FACTORS_MAX };

/* Twice as many iterations take 0.001 off the held-out errors. */
static const minimize_options options = {.iterations_max = 800, .decrease_min = 1e-5};

static const double encode_roughness = 0.1; /* weights of the sums of squared second differences */
static const double spectrum_roughness = 1e-2;

/* Numbers per coefficient, and the matrix of a light. */
typedef struct coefficients {
    double value[D];
} coefficients;
typedef struct light_matrix {
    double value[3][D];
} light_matrix;

struct factor_objective {
    const training_set *training;
    factor_curves curves;
    factor_curves slopes;             /* the gradient with respect to the curves */
    coefficients *encoded;            /* of every reflectance */
    coefficients *coefficient_slopes; /* the gradient with respect to them */
    light_matrix *matrices;           /* of every light */
    light_matrix *matrix_slopes;
};

int factor_variable_count(int dimension) {
    return 2 * dimension * N;
}

mtm_status factor_objective_create(const training_set *training, int dimension, factor_objective **objective,
                                   mtm_error *error) {
    *objective = NULL;
    factor_objective *o = calloc(1, sizeof *o);
    if (o == NULL) return fail_memory(error, "fit");
    o->training = training;
    o->curves.dimension = dimension;
    o->encoded = calloc((size_t)training->reflectance_count, sizeof *o->encoded);
    o->coefficient_slopes = calloc((size_t)training->reflectance_count, sizeof *o->coefficient_slopes);
    o->matrices = calloc((size_t)training->light_count, sizeof *o->matrices);
    o->matrix_slopes = calloc((size_t)training->light_count, sizeof *o->matrix_slopes);
    if (o->encoded == NULL || o->coefficient_slopes == NULL || o->matrices == NULL ||
        o->matrix_slopes == NULL) {
        factor_objective_destroy(o);
        return fail_memory(error, "fit");
    }
    *objective = o;
    return MTM_OK;
}

void factor_objective_destroy(factor_objective *objective) {
    if (objective == NULL) return;
    free(objective->encoded);
    free(objective->coefficient_slopes);
    free(objective->matrices);
    free(objective->matrix_slopes);
    free(objective);
}

static double square_sum(const double *values) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += values[i] * values[i];
    return sum;
}

void factor_curves_of(int dimension, const double *variables, factor_curves *curves) {
    const double *q = variables;
    const double *b = variables + dimension * N;
    curves->dimension = dimension;
    for (int j = 0; j < dimension; j++) {
        const double sum = square_sum(&q[j * N]);
        for (int i = 0; i < N; i++) curves->encode[j][i] = q[j * N + i] * q[j * N + i] / sum;
    }
    for (int i = 0; i < N; i++) {
        double sum = 0;
        for (int j = 0; j < dimension; j++) sum += b[j * N + i];
        for (int j = 0; j < dimension; j++) curves->spectrum[j][i] = b[j * N + i] + (1 - sum) / dimension;
    }
}

/* The chain rule through factor_curves_of. */
static void variable_gradient(const factor_objective *o, const double *variables, double *gradient) {
    const int dimension = o->curves.dimension;
    double *of_b = gradient + dimension * N;
    for (int j = 0; j < dimension; j++) {
        const double *q = &variables[j * N];
        const double sum = square_sum(q);
        double mean = 0;
        for (int i = 0; i < N; i++) mean += o->curves.encode[j][i] * o->slopes.encode[j][i];
        for (int i = 0; i < N; i++) gradient[j * N + i] = 2 * q[i] / sum * (o->slopes.encode[j][i] - mean);
    }
    for (int i = 0; i < N; i++) {
        double sum = 0;
        for (int j = 0; j < dimension; j++) sum += o->slopes.spectrum[j][i];
        for (int j = 0; j < dimension; j++) of_b[j * N + i] = o->slopes.spectrum[j][i] - sum / dimension;
    }
}

static void encode_reflectances(factor_objective *o) {
    const int dimension = o->curves.dimension;
    for (int r = 0; r < o->training->reflectance_count; r++) {
        double sums[D] = {0};
        for (int i = 0; i < N; i++)
            for (int j = 0; j < dimension; j++)
                sums[j] += o->training->reflectances[r].value[i] * o->curves.encode[j][i];
        memcpy(o->encoded[r].value, sums, sizeof sums);
    }
}

static void find_matrices(factor_objective *o) {
    for (int l = 0; l < o->training->light_count; l++)
        for (int c = 0; c < 3; c++)
            for (int j = 0; j < o->curves.dimension; j++) {
                const double *light = o->training->lights[l].value[c];
                double sum = 0;
                for (int i = 0; i < N; i++) sum += light[i] * o->curves.spectrum[j][i];
                o->matrices[l].value[c][j] = sum;
            }
}

/* The error of one product, whose coefficients are `product`; adds to the slopes of the light's matrix and writes those of
 * the coefficients. */
static double add_product(factor_objective *o, int light, const lab_target *target, const double *product,
                          double *coefficient_slope) {
    const int dimension = o->curves.dimension;
    const light_matrix *matrix = &o->matrices[light];
    light_matrix *slope = &o->matrix_slopes[light];
    double xyz[3] = {0, 0, 0};
    double gradient[3];
    for (int c = 0; c < 3; c++)
        for (int j = 0; j < dimension; j++) xyz[c] += matrix->value[c][j] * product[j];
    const double error = lab_error(target, xyz, gradient);
    for (int j = 0; j < dimension; j++)
        coefficient_slope[j] = gradient[0] * matrix->value[0][j] + gradient[1] * matrix->value[1][j] +
                               gradient[2] * matrix->value[2][j];
    for (int c = 0; c < 3; c++)
        for (int j = 0; j < dimension; j++) slope->value[c][j] += gradient[c] * product[j];
    return error;
}

/* The errors of a, a·b and a·b·c for the coefficients a, b, c of a draw's reflectances. */
static double add_draw(factor_objective *o, const product_draw *draw, const lab_target *targets) {
    const double *a = o->encoded[draw->reflectance[0]].value;
    const double *b = o->encoded[draw->reflectance[1]].value;
    const double *c = o->encoded[draw->reflectance[2]].value;
    double *a_slope = o->coefficient_slopes[draw->reflectance[0]].value;
    double *b_slope = o->coefficient_slopes[draw->reflectance[1]].value;
    double *c_slope = o->coefficient_slopes[draw->reflectance[2]].value;
    double ab[D], abc[D], one_slope[D], two_slope[D], three_slope[D];
    for (int j = 0; j < o->curves.dimension; j++) {
        ab[j] = a[j] * b[j];
        abc[j] = ab[j] * c[j];
    }
    double sum = add_product(o, draw->light, &targets[0], a, one_slope);
    sum += add_product(o, draw->light, &targets[1], ab, two_slope);
    sum += add_product(o, draw->light, &targets[2], abc, three_slope);
    for (int j = 0; j < o->curves.dimension; j++) {
        a_slope[j] += one_slope[j] + b[j] * (two_slope[j] + c[j] * three_slope[j]);
        b_slope[j] += a[j] * (two_slope[j] + c[j] * three_slope[j]);
        c_slope[j] += ab[j] * three_slope[j];
    }
    return sum;
}

/* The slopes of the curves from those of coefficients and matrices, times `factor`. */
static void find_slopes(factor_objective *o, double factor) {
    const training_set *training = o->training;
    memset(&o->slopes, 0, sizeof o->slopes);
    for (int j = 0; j < o->curves.dimension; j++) {
        for (int r = 0; r < training->reflectance_count; r++) {
            const double slope = factor * o->coefficient_slopes[r].value[j];
            for (int i = 0; i < N; i++) o->slopes.encode[j][i] += slope * training->reflectances[r].value[i];
        }
        for (int l = 0; l < training->light_count; l++)
            for (int c = 0; c < 3; c++) {
                const double slope = factor * o->matrix_slopes[l].value[c][j];
                for (int i = 0; i < N; i++)
                    o->slopes.spectrum[j][i] += slope * training->lights[l].value[c][i];
            }
    }
}

/* The weighted sum of squared second differences; adds its gradient to `slopes`. */
static double add_roughness(double weight, const double *curve, double *slopes) {
    double sum = 0;
    for (int i = 1; i + 1 < N; i++) {
        const double bend = curve[i - 1] - 2 * curve[i] + curve[i + 1];
        sum += weight * bend * bend;
        slopes[i - 1] += 2 * weight * bend;
        slopes[i] -= 4 * weight * bend;
        slopes[i + 1] += 2 * weight * bend;
    }
    return sum;
}

double factor_objective_value(void *objective, const double *variables, double *gradient) {
    factor_objective *o = objective;
    const training_set *training = o->training;
    factor_curves_of(o->curves.dimension, variables, &o->curves);
    encode_reflectances(o);
    find_matrices(o);
    memset(o->coefficient_slopes, 0, (size_t)training->reflectance_count * sizeof *o->coefficient_slopes);
    memset(o->matrix_slopes, 0, (size_t)training->light_count * sizeof *o->matrix_slopes);
    double sum = 0;
    for (int n = 0; n < training->draw_count; n++)
        sum += add_draw(o, &training->draws[n], &training->targets[n * DRAW_REFLECTANCES]);
    const double mean = 1.0 / ((double)training->draw_count * DRAW_REFLECTANCES);
    double value = mean * sum;
    find_slopes(o, mean);
    for (int j = 0; j < o->curves.dimension; j++) {
        value += add_roughness(encode_roughness, o->curves.encode[j], o->slopes.encode[j]);
        value += add_roughness(spectrum_roughness, o->curves.spectrum[j], o->slopes.spectrum[j]);
    }
    variable_gradient(o, variables, gradient);
    return value;
}

/* Bells round the middles of d equal intervals. They fall off slowly: where q is 0 its gradient is 0 for good. */
void factor_start(int dimension, double *variables) {
    const double first_nm = 410;
    const double last_nm = 680;
    const double width_nm = (last_nm - first_nm) / dimension;
    double *q = variables;
    double *b = variables + dimension * N;
    for (int i = 0; i < N; i++) {
        double sum = 0;
        for (int j = 0; j < dimension; j++) {
            const double center_nm = first_nm + (j + 0.5) * (last_nm - first_nm) / dimension;
            const double x =
                (MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i - center_nm) / (0.5 * width_nm);
            q[j * N + i] = 1 / (1 + x * x);
            b[j * N + i] = 1 / ((1 + x * x) * (1 + x * x));
            sum += b[j * N + i];
        }
        for (int j = 0; j < dimension; j++) b[j * N + i] /= sum;
    }
}

static double centroid(const double *curve) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += i * curve[i];
    return sum;
}

static void swap_curves(double *a, double *b) {
    double kept[N];
    memcpy(kept, a, sizeof kept);
    memcpy(a, b, sizeof kept);
    memcpy(b, kept, sizeof kept);
}

static void sort_curves(factor_curves *curves) {
    for (int i = 1; i < curves->dimension; i++)
        for (int j = i; j > 0 && centroid(curves->encode[j]) < centroid(curves->encode[j - 1]); j--) {
            swap_curves(curves->encode[j], curves->encode[j - 1]);
            swap_curves(curves->spectrum[j], curves->spectrum[j - 1]);
        }
}

mtm_status factor_fit(const training_set *training, int dimension, factor_curves *curves,
                      minimize_result *result, mtm_error *error) {
    factor_objective *objective = NULL;
    double *variables = calloc((size_t)factor_variable_count(dimension), sizeof *variables);
    mtm_status status = variables == NULL ? fail_memory(error, "fit")
                                          : factor_objective_create(training, dimension, &objective, error);
    if (status == MTM_OK) {
        factor_start(dimension, variables);
        status = minimize(factor_variable_count(dimension), factor_objective_value, objective, &options,
                          variables, result, error);
        factor_curves_of(dimension, variables, curves);
        sort_curves(curves);
    }
    factor_objective_destroy(objective);
    free(variables);
    return status;
}
