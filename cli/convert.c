/* SPDX-License-Identifier: BSD-3-Clause
 * metamer convert: any readable volume to NRRD. */
#include <string.h>

#include "task.h"

static const command_option options[] = {
    {"-o", "VOLUME.nrrd", "one file; VOLUME.nhdr writes a header beside a data file"},
    {"--encoding", "gzip|raw", "default gzip"},
    {"--endian", "little|big", "default little"},
    {NULL, NULL, NULL},
};

typedef struct convert_request {
    const char *input, *output;
    mtm_volume_write_options write;
} convert_request;

/* Sets *is_second by which of two words the value is. */
static void choose(argument_walk *walk, const command_option *option, const char *value, const char *first,
                   const char *second, bool *is_second) {
    *is_second = strcmp(value, second) == 0;
    if (!*is_second && strcmp(value, first) != 0)
        fail_usage(walk, "%s is \"%s\", must be %s or %s", option->name, value, first, second);
}

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        convert_request *request) {
    if (option == NULL && request->input != NULL)
        fail_usage(walk, "one volume at a time, not \"%s\" and \"%s\"", request->input, value);
    else if (option == NULL)
        request->input = value;
    else if (is_option(option, "-o"))
        request->output = value;
    else if (is_option(option, "--encoding"))
        choose(walk, option, value, "raw", "gzip", &request->write.is_gzip);
    else
        choose(walk, option, value, "little", "big", &request->write.is_big_endian);
}

static int run(const subcommand *command, int argc, char **argv) {
    convert_request request = {.write = mtm_volume_write_defaults()};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (!walk.is_over && request.input == NULL) fail_usage(&walk, "a volume is needed");
    if (!walk.is_over && request.output == NULL) fail_usage(&walk, "-o VOLUME.nrrd is needed");
    if (walk.is_over) return walk.exit_status;

    mtm_error error = {""};
    mtm_volume *volume = NULL;
    mtm_status status = mtm_volume_read(request.input, &volume, &error);
    if (status == MTM_OK) status = mtm_volume_write(volume, request.output, &request.write, &error);
    mtm_volume_destroy(volume);
    return status == MTM_OK ? EXIT_DONE : fail_command(command, &error);
}

const subcommand convert_command = {
    .name = "convert",
    .arguments = "VOLUME -o VOLUME.nrrd [options]",
    .summary = "Write any readable volume as NRRD, geometry and voxel type kept.",
    .options = options,
    .run = run,
};
