/* SPDX-License-Identifier: BSD-3-Clause
 * metamer: the command line. Results go to standard output, messages and progress to standard error; exit status 0,
 * 1 (failed) or 2 (bad usage). */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "command.h"
#include "metamer/metamer.h"

static const subcommand *const commands[] = {&render_command,  &relight_command, &info_command,
                                             &compare_command, &convert_command, &color_command,
                                             &design_command,  &bench_command};
enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static void print_overview(FILE *stream) {
    (void)fprintf(stream,
                  "metamer %s, a spectral volume renderer: render once, relight at will\n\nusage: metamer "
                  "COMMAND …\n\n",
                  mtm_version());
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        const char *end = strchr(commands[i]->summary, '.');
        const int length =
            end == NULL ? (int)strlen(commands[i]->summary) : (int)(end - commands[i]->summary);
        (void)fprintf(stream, "  %-9s %.*s\n", commands[i]->name, length, commands[i]->summary);
    }
    (void)fprintf(stream,
                  "\nmetamer COMMAND --help tells more. Try: metamer render examples/engine/engine.json -o "
                  "engine.png\n");
}

/* What could not be printed has failed: a full disk or a closed pipe behind standard output. */
static int finish_output(const char *command, int status) {
    if (fflush(stdout) == 0 && !ferror(stdout)) return status;
    (void)fprintf(stderr, "metamer%s%s: standard output cannot be written\n", *command == '\0' ? "" : " ",
                  command);
    return EXIT_FAILED;
}

static void print_version(void) {
    (void)printf("metamer %s\nLicence: BSD-3-Clause. Links zlib, libpng, jansson, OpenEXR and OpenSSL's "
                 "libcrypto, all "
                 "under permissive licences; no GPL code.\nInstruction set on this machine: %s\n",
                 mtm_version(), mtm_isa_name());
}

int main(int argc, char **argv) {
    /* A file that grows beyond the user's limit is then an error of writing, not the end of the program. */
    (void)signal(SIGXFSZ, SIG_IGN);
    if (argc < 2) {
        print_overview(stderr);
        return EXIT_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
        print_overview(stdout);
        return finish_output("", EXIT_DONE);
    }
    if (strcmp(argv[1], "--version") == 0) {
        print_version();
        return finish_output("", EXIT_DONE);
    }
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(argv[1], commands[i]->name) == 0)
            return finish_output(commands[i]->name, commands[i]->run(commands[i], argc - 2, argv + 2));
    (void)fprintf(stderr, "metamer: unknown command \"%s\"; see metamer --help\n", argv[1]);
    return EXIT_USAGE;
}
