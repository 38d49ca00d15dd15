/* SPDX-License-Identifier: BSD-3-Clause
 * The tables of docs/accuracy.md, in Markdown. */
#include "tables.h"

#include <string.h>

/* What most tables compare. */
static const model_choice main_models[] = {
    {FAMILY_RGB, 0},    {FAMILY_RGB_BRADFORD, 0},   {FAMILY_UNSHARPENED, 7}, {FAMILY_SHARPENED, 7},
    {FAMILY_PEERCY, 7}, {FAMILY_FACTORS, 5},        {FAMILY_FACTORS, 7},     {FAMILY_FACTORS, 9},
    {FAMILY_POINTS, 0}, {FAMILY_WAVELENGTHS_31, 0}, {FAMILY_WAVELENGTHS, 0},
};
enum { MAIN_MODELS = sizeof main_models / sizeof *main_models };

static const char none[] = " – |";

static int index_of(model_choice choice) {
    return model_index(choice.family, choice.dimension);
}

static void print_name(FILE *stream, model_choice choice) {
    char name[MODEL_NAME_BYTES];
    model_name(choice, name);
    (void)fprintf(stream, "| %s |", name);
}

static void print_mean_p95(FILE *stream, const error_summary *errors) {
    (void)fprintf(stream, " %.2f / %.2f |", errors->mean, errors->p95);
}

static void print_summary(FILE *stream, const error_summary *errors) {
    (void)fprintf(stream, " %.2f / %.2f / %.1f |", errors->mean, errors->p95, errors->max);
}

static void print_mean_max(FILE *stream, const error_summary *errors) {
    (void)fprintf(stream, " %.2f / %.2f |", errors->mean, errors->max);
}

/* A header of `count` columns and the line below it. */
static void print_header(FILE *stream, int count, const char *const *titles) {
    (void)fprintf(stream, "|");
    for (int i = 0; i < count; i++) (void)fprintf(stream, " %s |", titles[i]);
    (void)fprintf(stream, "\n|");
    for (int i = 0; i < count; i++) (void)fprintf(stream, "---|");
    (void)fprintf(stream, "\n");
}

/* The row of engine_errors for a model; -1: it was not rendered. */
static int engine_row(model_choice choice) {
    char name[MODEL_NAME_BYTES];
    model_name(choice, name);
    if (choice.family == FAMILY_RGB) return 0;
    for (int i = 0; i < ENGINE_BASES; i++)
        if (strcmp(engine_bases[i], name) == 0) return i;
    return -1;
}

static void print_headline_row(FILE *stream, const measurements *made, model_choice choice) {
    static const int dimensions[FAMILY_COUNT] = {
        [FAMILY_RGB] = 3, [FAMILY_RGB_BRADFORD] = 3, [FAMILY_WAVELENGTHS_31] = 31, [FAMILY_WAVELENGTHS] = 81};
    const int index = index_of(choice);
    const int row = engine_row(choice);
    print_name(stream, choice);
    (void)fprintf(stream, " %d |", choice.dimension > 0 ? choice.dimension : dimensions[choice.family]);
    print_summary(stream, &made->products[SET_HELD_OUT][index].products[0]);
    print_mean_p95(stream, &made->products[SET_HELD_OUT][index].matched);
    print_mean_p95(stream, &made->products[SET_HOUSER][index].products[0]);
    (void)fprintf(stream, " %.2f |", made->metamers[index].split_error.mean);
    if (row >= 0)
        print_mean_p95(stream, &made->engine.measured[row]);
    else
        (void)fprintf(stream, "%s", choice.family == FAMILY_WAVELENGTHS ? " 0.00 / 0.00 |" : none);
    (void)fprintf(stream, "\n");
}

void print_headline_table(FILE *stream, const measurements *made) {
    static const char *const titles[] = {"model",
                                         "d",
                                         "one reflectance, mean / 95 % / max",
                                         "three, exposure-matched, mean / 95 %",
                                         "other lamps, mean / 95 %",
                                         "metamers, error of the split",
                                         "pictures, mean / 95 %"};
    static const model_choice choices[] = {
        {FAMILY_RGB, 0},     {FAMILY_RGB_BRADFORD, 0}, {FAMILY_SHARPENED, 7},      {FAMILY_FACTORS, 5},
        {FAMILY_FACTORS, 7}, {FAMILY_FACTORS, 9},      {FAMILY_WAVELENGTHS_31, 0}, {FAMILY_WAVELENGTHS, 0},
    };
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++)
        print_headline_row(stream, made, choices[i]);
    (void)fprintf(stream, "| materials | materials + 1 | no products | no products | – | 0.00 |");
    print_mean_p95(stream, &made->engine.measured[ENGINE_BASES - 1]);
    (void)fprintf(stream, "\n\n");
}

static const error_summary *pick(const product_errors *errors, product_kind kind) {
    return kind == PRODUCT_MATCHED ? &errors->matched : &errors->products[kind];
}

static void print_dimension_row(FILE *stream, const measurements *made, measured_set set, product_kind kind,
                                model_family family) {
    (void)fprintf(stream, "| %s |", model_family_name(family));
    for (int d = MODEL_DIMENSION_MIN; d <= MODEL_DIMENSION_MAX; d++) {
        if (made->is_missing[model_index(family, d)])
            (void)fprintf(stream, "%s", none);
        else
            print_mean_p95(stream, pick(measured_products(made, set, family, d), kind));
    }
    (void)fprintf(stream, "\n");
}

void print_dimension_table(FILE *stream, const measurements *made, measured_set set, product_kind kind) {
    static const char *const titles[] = {"model", "d = 3", "4", "5", "6", "7", "8", "9"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int family = 0; family < MODEL_FAMILIES_WITH_DIMENSION; family++)
        print_dimension_row(stream, made, set, kind, (model_family)family);
    (void)fprintf(stream, "\n| model | mean / 95 %% |\n|---|---|\n");
    for (int family = MODEL_FAMILIES_WITH_DIMENSION; family < FAMILY_COUNT; family++) {
        (void)fprintf(stream, "| %s |", model_family_name((model_family)family));
        print_mean_p95(stream, pick(measured_products(made, set, (model_family)family, 0), kind));
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_class_table(FILE *stream, const measurements *made) {
    static const char *const titles[] = {"model", "smooth", "LED", "fluorescent"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int i = 0; i < MAIN_MODELS; i++) {
        const product_errors *errors = &made->products[SET_HELD_OUT][index_of(main_models[i])];
        print_name(stream, main_models[i]);
        for (int class = 0; class < LIGHT_CLASSES; class ++)
            (void)fprintf(stream, " %.2f |", errors->class_mean[class]);
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_set_table(FILE *stream, const measurements *made, measured_set set) {
    static const char *const titles[] = {"model", "one reflectance, mean / 95 % / max",
                                         "three, exposure-matched, mean / 95 % / max"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int i = 0; i < MAIN_MODELS; i++) {
        const product_errors *errors = &made->products[set][index_of(main_models[i])];
        print_name(stream, main_models[i]);
        print_summary(stream, &errors->products[0]);
        print_summary(stream, &errors->matched);
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_metamer_table(FILE *stream, const measurements *made) {
    static const char *const titles[] = {"model", "difference under D65 that is not there, mean / max",
                                         "error of the split under the other lights, mean / max"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int index = 0; index < MODEL_COUNT; index++) {
        if (made->is_missing[index]) continue;
        print_name(stream, model_choice_at(index));
        print_mean_max(stream, &made->metamers[index].spurious);
        print_mean_max(stream, &made->metamers[index].split_error);
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_filter_table(FILE *stream, const measurements *made) {
    static const char *const titles[] = {"model", "one filter, mean / 95 % / max",
                                         "two filters, mean / 95 % / max"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int i = 0; i < MAIN_MODELS; i++) {
        const product_errors *errors = &made->products[SET_HELD_OUT][index_of(main_models[i])];
        print_name(stream, main_models[i]);
        for (int filters = 0; filters < FILTERS_MAX; filters++)
            print_summary(stream, &errors->filtered[filters]);
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_engine_table(FILE *stream, const measurements *made) {
    (void)fprintf(stream, "| palette |");
    for (int basis = 0; basis < ENGINE_BASES; basis++) (void)fprintf(stream, " %s |", engine_bases[basis]);
    (void)fprintf(stream, "\n|---|");
    for (int basis = 0; basis < ENGINE_BASES; basis++) (void)fprintf(stream, "---|");
    (void)fprintf(stream, "\n");
    for (int palette = 0; palette < ENGINE_PALETTES; palette++) {
        (void)fprintf(stream, "| %s |", engine_palettes[palette]);
        for (int basis = 0; basis < ENGINE_BASES; basis++)
            print_mean_p95(stream, &made->engine.palette[basis][palette]);
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_engine_light_table(FILE *stream, const measurements *made) {
    (void)fprintf(stream, "| palette |");
    for (int light = 0; light < ENGINE_LIGHTS; light++) (void)fprintf(stream, " %s |", engine_lights[light]);
    (void)fprintf(stream, "\n|---|");
    for (int light = 0; light < ENGINE_LIGHTS; light++) (void)fprintf(stream, "---|");
    (void)fprintf(stream, "\n");
    for (int palette = 0; palette < ENGINE_PALETTES; palette++) {
        (void)fprintf(stream, "| %s |", engine_palettes[palette]);
        for (int light = 0; light < ENGINE_LIGHTS; light++)
            print_summary(stream, &made->engine.each[ENGINE_FACTORS_7][palette][light]);
        (void)fprintf(stream, "\n");
    }
    (void)fprintf(stream, "\n");
}

void print_full_table(FILE *stream, const measurements *made, measured_set set) {
    static const char *const titles[] = {
        "model", "one", "two", "three", "three, exposure-matched", "one, mean: smooth, LED, fluorescent"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int index = 0; index < MODEL_COUNT; index++) {
        const product_errors *errors = &made->products[set][index];
        if (made->is_missing[index]) continue;
        print_name(stream, model_choice_at(index));
        for (int i = 0; i < DRAW_REFLECTANCES; i++) print_summary(stream, &errors->products[i]);
        print_summary(stream, &errors->matched);
        (void)fprintf(stream, " %.2f, %.2f, %.2f |\n", errors->class_mean[0], errors->class_mean[1],
                      errors->class_mean[2]);
    }
    (void)fprintf(stream, "\n");
}

/* The model of a basis; false for materials, which multiplies nothing. */
static bool find_model(const char *basis, int *index) {
    for (*index = 0; *index < MODEL_COUNT; (*index)++) {
        char name[MODEL_NAME_BYTES];
        model_name(model_choice_at(*index), name);
        if (strcmp(name, basis) == 0 || (strcmp(name, "RGB") == 0 && strcmp(basis, "rgb") == 0)) return true;
    }
    return false;
}

static void print_picture_error(FILE *stream, const measurements *made, const char *basis) {
    for (int i = 0; i < ENGINE_BASES; i++) {
        if (strcmp(engine_bases[i], basis) != 0) continue;
        print_mean_p95(stream, &made->engine.measured[i]);
        return;
    }
    (void)fprintf(stream, " 0.00 / 0.00 |");
}

void print_cost_table(FILE *stream, const measurements *made, const basis_cost costs[COST_BASES]) {
    static const char *const titles[] = {
        "basis",        "d",        "pictures, mean / 95 %", "one reflectance, mean", "render (ms)",
        "relight (ms)", "EXR (MiB)"};
    print_header(stream, sizeof titles / sizeof *titles, titles);
    for (int i = 0; i < COST_BASES; i++) {
        int index = 0;
        (void)fprintf(stream, "| %s | %d |", costs[i].basis, costs[i].dimension);
        print_picture_error(stream, made, costs[i].basis);
        if (find_model(costs[i].basis, &index))
            (void)fprintf(stream, " %.2f |", made->products[SET_HELD_OUT][index].products[0].mean);
        else
            (void)fprintf(stream, "%s", none);
        (void)fprintf(stream, " %.0f | %.2f | %.2f |\n", costs[i].render_ms, costs[i].relight_ms,
                      costs[i].file_mib);
    }
    (void)fprintf(stream, "\n");
}
