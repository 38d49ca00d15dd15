/* SPDX-License-Identifier: BSD-3-Clause
 * Subcommands: one file each, one row in the table of main.c. */
#ifndef METAMER_CLI_COMMAND_H
#define METAMER_CLI_COMMAND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

typedef struct command_option {
    const char *name;        /* "--size" or "-o" */
    const char *placeholder; /* of its value, "WxH"; NULL for a flag */
    const char *help;
} command_option;

typedef struct subcommand {
    const char *name;
    const char *arguments; /* "SCENE.json -o IMAGE.exr" */
    const char *summary;
    const command_option *options; /* ended by a row without name */
    int (*run)(const struct subcommand *command, int argc, char **argv);
} subcommand;

extern const subcommand render_command, relight_command, info_command, compare_command, convert_command,
    color_command, design_command, bench_command;

/* Walks the arguments of a subcommand. */
typedef struct argument_walk {
    const subcommand *command;
    int count, next;
    char **texts;
    bool options_ended; /* after "--" */
    int exit_status;    /* EXIT_USAGE after a mistake, else EXIT_DONE */
    bool is_over;       /* nothing more to do: a mistake was reported, or --help answered */
} argument_walk;

argument_walk walk_arguments(const subcommand *command, int argc, char **argv);

/* The next argument: *option is its row (NULL for a plain argument, then *value is its text) and *value its value
 * (NULL for a flag). False at the end, and after a mistake or --help, with is_over set. */
bool next_argument(argument_walk *walk, const command_option **option, const char **value);

/* Whether an option has this name. */
bool is_option(const command_option *option, const char *name);

/* Prints a text that came from outside: one line, whatever a terminal would do with its control characters. */
void print_plainly(FILE *stream, const char *text);

/* Reports a mistake in the use of the command and ends the walk. */
__attribute__((format(printf, 2, 3))) void fail_usage(argument_walk *walk, const char *format, ...);

/* Values of options; a mistake ends the walk. */
bool parse_count(argument_walk *walk, const command_option *option, const char *value, int *result);
bool parse_size(argument_walk *walk, const command_option *option, const char *value, int *width,
                int *height);
bool parse_number(argument_walk *walk, const command_option *option, const char *value, double *result);
/* Bytes: a whole number, 1 or more, also with K, M, G or T behind it (powers of 1024). */
bool parse_bytes(argument_walk *walk, const command_option *option, const char *value, size_t *result);
/* An amount of light, 0 … 10⁶. */
bool parse_amount(argument_walk *walk, const command_option *option, const char *value, double *result);

void print_help(const subcommand *command);

#endif
