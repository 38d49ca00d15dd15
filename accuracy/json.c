/* SPDX-License-Identifier: BSD-3-Clause
 * The measured numbers as JSON. Names hold nothing that JSON would escape. */
#include "json.h"

#include "output.h"

static const char *const set_names[SET_COUNT] = {
    [SET_HELD_OUT] = "held_out",       [SET_PAIRS] = "pairs",
    [SET_HOUSER] = "houser",           [SET_FULL] = "full",
    [SET_FULL_HOUSER] = "full_houser", [SET_OPSTELTEN] = "opstelten",
    [SET_CRI2012] = "cri2012",
};

static void print_summary(FILE *stream, const char *name, const error_summary *errors, const char *end) {
    (void)fprintf(stream, "\"%s\": {\"mean\": %.15g, \"p95\": %.15g, \"max\": %.15g}%s", name, errors->mean,
                  errors->p95, errors->max, end);
}

static void print_products(FILE *stream, const product_errors *errors) {
    print_summary(stream, "one", &errors->products[0], ", ");
    print_summary(stream, "two", &errors->products[1], ", ");
    print_summary(stream, "three", &errors->products[2], ", ");
    print_summary(stream, "three_matched", &errors->matched, ", ");
    print_summary(stream, "one_filter", &errors->filtered[0], ", ");
    print_summary(stream, "two_filters", &errors->filtered[1], ", ");
    (void)fprintf(stream, "\"by_class\": [%.15g, %.15g, %.15g]", errors->class_mean[0], errors->class_mean[1],
                  errors->class_mean[2]);
}

static void print_metamers(FILE *stream, const metamer_errors *errors) {
    print_summary(stream, "spurious", &errors->spurious, ", ");
    print_summary(stream, "split_error", &errors->split_error, ", ");
    print_summary(stream, "true_split", &errors->true_split, "");
}

/* A set of products, or the metamers, model by model. */
static void print_models(FILE *stream, const measurements *made, const product_errors *products) {
    const char *separator = "";
    for (int index = 0; index < MODEL_COUNT; index++) {
        char name[MODEL_NAME_BYTES];
        if (made->is_missing[index]) continue;
        model_name(model_choice_at(index), name);
        (void)fprintf(stream, "%s\n    \"%s\": {", separator, name);
        if (products != NULL)
            print_products(stream, &products[index]);
        else
            print_metamers(stream, &made->metamers[index]);
        (void)fprintf(stream, "}");
        separator = ",";
    }
}

static void print_engine(FILE *stream, const engine_errors *engine) {
    for (int basis = 0; basis < ENGINE_BASES; basis++) {
        (void)fprintf(stream, "%s\n    \"%s\": {", basis == 0 ? "" : ",", engine_bases[basis]);
        print_summary(stream, "own", &engine->palette[basis][0], ", ");
        print_summary(stream, "measured", &engine->measured[basis], "}");
    }
}

mtm_status json_write(const measurements *made, const char *path, mtm_error *error) {
    output_file file;
    const mtm_status status = output_open(path, &file, error);
    if (status != MTM_OK) return status;
    (void)fprintf(file.stream, "{\n  \"pair_count\": %d", made->pair_count);
    for (int set = 0; set < made->set_count; set++) {
        (void)fprintf(file.stream, ",\n  \"%s\": {", set_names[set]);
        print_models(file.stream, made, made->products[set]);
        (void)fprintf(file.stream, "\n  }");
    }
    (void)fprintf(file.stream, ",\n  \"metamers\": {");
    print_models(file.stream, made, NULL);
    (void)fprintf(file.stream, "\n  },\n  \"engine\": {");
    print_engine(file.stream, &made->engine);
    (void)fprintf(file.stream, "\n  }\n}\n");
    return output_close(&file, error);
}
