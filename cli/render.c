/* SPDX-License-Identifier: BSD-3-Clause
 * metamer render: a scene, a volume or a picture that carries its scene, to a spectral image or a picture. */
#include <stdio.h>
#include <string.h>

#include "task.h"

static const command_option options[] = {
    {"-o", "FILE", "IMAGE.exr (spectral, to be relit) or PICTURE.png (under the scene's light)"},
    {"--renderer", "NAME", "raycast"},
    {"--basis", "NAME", "auto, materials, factors:D, sharpened:D, wavelengths or rgb"},
    {"--size", "WxH", "picture size in pixels"},
    {"--threads", "N", "default: all processors; the picture is the same for any"},
    {"--memory", "SIZE",
     "for faster copies of the volume: bytes, or with K, M, G, T; default: half of the machine's"},
    {"--volume", "FILE", "the volume to use instead of the scene's"},
    {"--half", NULL, "16-bit coefficients in the EXR, half the size"},
    {"--spectral", NULL, "add T.380,000000nm … channels to the EXR, for programs that read spectral images"},
    {NULL, NULL, NULL},
};

typedef struct render_request {
    const char *input, *output, *volume, *renderer, *basis;
    int width, height, threads;
    size_t memory_bytes; /* 0: the default */
    bool is_half, is_spectral;
} render_request;

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        render_request *request) {
    if (option == NULL && request->input != NULL)
        fail_usage(walk, "one input at a time, not \"%s\" and \"%s\"", request->input, value);
    else if (option == NULL)
        request->input = value;
    else if (is_option(option, "-o"))
        request->output = value;
    else if (is_option(option, "--renderer"))
        request->renderer = value;
    else if (is_option(option, "--basis"))
        request->basis = value;
    else if (is_option(option, "--size"))
        (void)parse_size(walk, option, value, &request->width, &request->height);
    else if (is_option(option, "--threads"))
        (void)parse_count(walk, option, value, &request->threads);
    else if (is_option(option, "--memory"))
        (void)parse_bytes(walk, option, value, &request->memory_bytes);
    else if (is_option(option, "--volume"))
        request->volume = value;
    else if (is_option(option, "--half"))
        request->is_half = true;
    else
        request->is_spectral = true;
}

static void apply_request(const render_request *request, mtm_scene *scene) {
    if (request->renderer != NULL)
        (void)snprintf(scene->renderer, sizeof scene->renderer, "%s", request->renderer);
    if (request->basis != NULL) (void)snprintf(scene->basis, sizeof scene->basis, "%s", request->basis);
    if (request->width > 0) {
        scene->render.width = request->width;
        scene->render.height = request->height;
    }
    scene->render.thread_count = request->threads;
    scene->render.memory_bytes = request->memory_bytes;
}

static mtm_status write_image(const render_request *request, const mtm_scene *scene, const mtm_image *image,
                              const mtm_picture *preview, mtm_error *error) {
    float rows[MTM_SPECTRUM_SAMPLES * MTM_DIMENSION_MAX];
    mtm_image_write_options write = mtm_image_write_defaults();
    write.is_half = request->is_half;
    write.preview = preview;
    if (request->is_spectral) {
        const mtm_status status = mtm_scene_reconstruction(scene, image, rows, error);
        if (status != MTM_OK) return status;
        write.reconstruction = rows;
    }
    return mtm_image_write(image, request->output, &write, error);
}

/* The preview in an EXR and the picture in a PNG are the same: the image under the scene's light. */
static mtm_status write_result(const render_request *request, const mtm_scene *scene, const mtm_image *image,
                               mtm_error *error) {
    mtm_picture *picture = NULL;
    mtm_status status = mtm_scene_relight(scene, image, request->threads, &picture, error);
    if (status == MTM_OK)
        status = has_extension(request->output, ".exr")
                     ? write_image(request, scene, image, picture, error)
                     : write_picture(picture, scene, request->output, error);
    mtm_picture_destroy(picture);
    return status;
}

/* The volume is the box from the first to the last voxel center, and such a box is empty. */
static void note_flat_volume(const subcommand *command, const mtm_volume *volume) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    for (int axis = 0; axis < 3; axis++)
        if (grid->size[axis] == 1) {
            (void)fprintf(stderr,
                          "metamer %s: note: the volume is one voxel thick along axis %d, so there is "
                          "nothing to see between its voxel centers\n",
                          command->name, axis);
            return;
        }
}

/* A basis of few coefficients may part what full spectra merge; worth knowing before a picture is believed. */
static void note_basis_error(const subcommand *command, const mtm_scene *scene) {
    const double visible = 2; /* CIEDE2000 */
    mtm_basis_error largest;
    if (mtm_scene_basis_error(scene, &largest, NULL) != MTM_OK || largest.ciede2000 < visible) return;
    (void)fprintf(stderr, "metamer %s: note: basis ", command->name);
    print_plainly(stderr, scene->basis);
    (void)fprintf(stderr, " shows \"");
    print_plainly(stderr, scene->palette.materials[largest.material].name);
    (void)fprintf(stderr, "\" under \"");
    print_plainly(stderr, scene->palette.lights[largest.light].name);
    (void)fprintf(stderr, "\" %.1f CIEDE2000 from its true color; --basis materials is exact\n",
                  largest.ciede2000);
}

static int render(const subcommand *command, const render_request *request) {
    mtm_error error = {""};
    mtm_scene *scene = NULL;
    mtm_volume *volume = NULL;
    mtm_image *image = NULL;
    progress_bar bar;
    mtm_status status = check_picture_output(request->output, true, &error);
    if (status == MTM_OK) status = open_scene(request->input, request->volume, &scene, &volume, &error);
    if (status == MTM_OK) {
        note_flat_volume(command, volume);
        apply_request(request, scene);
        note_basis_error(command, scene);
        const mtm_progress progress = start_progress(&bar, "rendering");
        status = mtm_scene_render(scene, volume, &progress, &image, &error);
        end_progress(&bar);
        status = name_failure(status, request->input, NULL, &error);
    }
    if (status == MTM_OK) status = write_result(request, scene, image, &error);
    mtm_image_destroy(image);
    mtm_volume_destroy(volume);
    mtm_scene_destroy(scene);
    return status == MTM_OK ? EXIT_DONE : fail_command(command, &error);
}

static int run(const subcommand *command, int argc, char **argv) {
    render_request request = {0};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (walk.is_over) return walk.exit_status;
    if (request.input == NULL)
        fail_usage(&walk, "a scene, a volume or a picture is needed");
    else if (request.output == NULL)
        fail_usage(&walk, "-o IMAGE.exr or -o PICTURE.png is needed");
    return walk.is_over ? walk.exit_status : render(command, &request);
}

const subcommand render_command = {
    .name = "render",
    .arguments = "SCENE.json|VOLUME|PICTURE.png|IMAGE.exr -o IMAGE.exr|PICTURE.png [options]",
    .summary =
        "Project a volume once, without light, into a spectral image, or straight into a picture.\n"
        "A volume alone gets a default scene; a picture made by metamer is rendered again from the scene it\n"
        "carries. Volumes are looked for beside the scene, then in the folders of METAMER_DATA.",
    .options = options,
    .run = run,
};
