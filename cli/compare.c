/* SPDX-License-Identifier: BSD-3-Clause
 * metamer compare: how far two pictures are apart. */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "task.h"

static const command_option options[] = {
    {"--tolerance", "MAX_ERROR", "exit status 1 where the largest difference (0..1) is above this"},
    {"-o", "DIFF.png", "write the absolute difference, 8 times as bright"},
    {"--json", NULL, "print a JSON document"},
    {NULL, NULL, NULL},
};

typedef struct compare_request {
    const char *inputs[2];
    int input_count;
    const char *output;
    double tolerance; /* -1: none */
    bool is_json;
} compare_request;

/* A picture as it is; a spectral image under its own light. */
static mtm_status open_picture(const char *path, mtm_picture **picture, mtm_error *error) {
    mtm_image *image = NULL;
    mtm_scene *scene = NULL;
    if (kind_of_file(path) != FILE_EXR) return mtm_picture_read_png(path, picture, NULL, error);
    mtm_status status = mtm_image_read(path, &image, error);
    if (status == MTM_OK) status = mtm_scene_of_image(image, path, &scene, error);
    if (status == MTM_OK) status = mtm_scene_relight(scene, image, 0, picture, error);
    mtm_scene_destroy(scene);
    mtm_image_destroy(image);
    return status;
}

static void print_json(const mtm_comparison *c) {
    json_t *object =
        json_pack("{s:f, s:f, s:f, s:{s:f, s:f, s:f}, s:I}", "max_error", c->max_error, "mean_error",
                  c->mean_error, "psnr_db", c->psnr_db, "ciede2000", "mean", c->ciede2000_mean, "p99",
                  c->ciede2000_p99, "max", c->ciede2000_max, "pixels", (json_int_t)c->pixels);
    (void)json_dumpf(object, stdout, JSON_COMPACT | JSON_REAL_PRECISION(9));
    (void)printf("\n");
    json_decref(object);
}

static void print_table(const mtm_comparison *c) {
    (void)printf("largest difference  %.6f\nmean difference     %.6f\nPSNR                %.2f dB%s\n",
                 c->max_error, c->mean_error, c->psnr_db,
                 c->max_error == 0 ? " (the pictures are equal)" : "");
    (void)printf("CIEDE2000           mean %.4f, 99 %% below %.4f, largest %.4f\npixels              %zu\n",
                 c->ciede2000_mean, c->ciede2000_p99, c->ciede2000_max, c->pixels);
}

static int compare(const subcommand *command, const compare_request *request) {
    mtm_error error = {""};
    mtm_picture *pictures[2] = {NULL, NULL};
    mtm_picture *difference = NULL;
    mtm_comparison comparison = {0};
    mtm_status status = MTM_OK;
    if (request->output != NULL) status = check_picture_output(request->output, false, &error);
    if (status == MTM_OK) status = open_picture(request->inputs[0], &pictures[0], &error);
    if (status == MTM_OK) status = open_picture(request->inputs[1], &pictures[1], &error);
    if (status == MTM_OK)
        status = name_failure(mtm_picture_compare(pictures[0], pictures[1], &comparison, &error),
                              request->inputs[0], request->inputs[1], &error);
    if (status == MTM_OK && request->output != NULL) {
        status = mtm_picture_difference(pictures[0], pictures[1], 8, &difference, &error);
        if (status == MTM_OK) status = mtm_picture_write_png(difference, request->output, NULL, &error);
    }
    if (status == MTM_OK && request->is_json) print_json(&comparison);
    if (status == MTM_OK && !request->is_json) print_table(&comparison);
    mtm_picture_destroy(difference);
    mtm_picture_destroy(pictures[0]);
    mtm_picture_destroy(pictures[1]);
    if (status != MTM_OK) return fail_command(command, &error);
    if (request->tolerance < 0 || comparison.max_error <= request->tolerance) return EXIT_DONE;
    (void)fprintf(stderr, "metamer compare: the largest difference %.9g is above the tolerance %g\n",
                  comparison.max_error, request->tolerance);
    return EXIT_FAILED;
}

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        compare_request *request) {
    if (option == NULL && request->input_count == 2)
        fail_usage(walk, "two pictures at a time, \"%s\" is the third", value);
    else if (option == NULL)
        request->inputs[request->input_count++] = value;
    else if (is_option(option, "--tolerance"))
        (void)parse_number(walk, option, value, &request->tolerance);
    else if (is_option(option, "-o"))
        request->output = value;
    else
        request->is_json = true;
}

static int run(const subcommand *command, int argc, char **argv) {
    compare_request request = {.tolerance = -1};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (!walk.is_over && request.input_count < 2) fail_usage(&walk, "two pictures are needed");
    return walk.is_over ? walk.exit_status : compare(command, &request);
}

const subcommand compare_command = {
    .name = "compare",
    .arguments = "A B [options]",
    .summary =
        "Tell how far two pictures are apart.\n"
        "PNG pictures are compared as they are, spectral images (EXR) under their own light; differences are "
        "of\n"
        "the encoded picture in 0..1, over black. PSNR is at most 200 dB, the value of equal pictures.",
    .options = options,
    .run = run,
};
