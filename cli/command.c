/* SPDX-License-Identifier: BSD-3-Clause
 * Reading the arguments of subcommands. */
#include "command.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "metamer/image.h"

argument_walk walk_arguments(const subcommand *command, int argc, char **argv) {
    return (argument_walk){.command = command, .count = argc, .texts = argv};
}

void print_plainly(FILE *stream, const char *text) {
    for (; *text != '\0'; text++)
        (void)fputc((unsigned char)*text < ' ' || *text == 0x7F ? '?' : *text, stream);
}

void fail_usage(argument_walk *walk, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    (void)fprintf(stderr, "metamer %s: ", walk->command->name);
    char message[1024];
    (void)vsnprintf(message, sizeof message, format, arguments);
    print_plainly(stderr, message);
    (void)fprintf(stderr, "; see metamer %s --help\n", walk->command->name);
    va_end(arguments);
    walk->exit_status = EXIT_USAGE;
    walk->is_over = true;
}

static const command_option *find_option(const subcommand *command, const char *text, size_t length) {
    for (const command_option *option = command->options; option->name != NULL; option++)
        if (strlen(option->name) == length && strncmp(option->name, text, length) == 0) return option;
    return NULL;
}

bool is_option(const command_option *option, const char *name) {
    return option != NULL && strcmp(option->name, name) == 0;
}

/* "--name value", "--name=value" or a flag. */
static bool take_option(argument_walk *walk, const char *text, const command_option **option,
                        const char **value) {
    const char *equals = strchr(text, '=');
    const size_t length = equals == NULL ? strlen(text) : (size_t)(equals - text);
    *option = find_option(walk->command, text, length);
    *value = equals == NULL ? NULL : equals + 1;
    if (*option == NULL) {
        fail_usage(walk, "unknown option %.*s", (int)length, text);
        return false;
    }
    if ((*option)->placeholder == NULL && *value != NULL) {
        fail_usage(walk, "%s takes no value", (*option)->name);
        return false;
    }
    if ((*option)->placeholder == NULL || *value != NULL) return true;
    if (walk->next == walk->count) {
        fail_usage(walk, "%s needs a value, %s", (*option)->name, (*option)->placeholder);
        return false;
    }
    *value = walk->texts[walk->next++];
    return true;
}

bool next_argument(argument_walk *walk, const command_option **option, const char **value) {
    if (walk->is_over || walk->next == walk->count) return false;
    const char *text = walk->texts[walk->next++];
    *option = NULL;
    *value = text;
    if (walk->options_ended || text[0] != '-' || text[1] == '\0') return true;
    if (strcmp(text, "--") == 0) {
        walk->options_ended = true;
        return next_argument(walk, option, value);
    }
    if (strcmp(text, "--help") == 0 || strcmp(text, "-h") == 0) {
        print_help(walk->command);
        walk->is_over = true;
        return false;
    }
    return take_option(walk, text, option, value);
}

bool parse_amount(argument_walk *walk, const command_option *option, const char *value, double *result) {
    static const double amount_max = 1e6; /* as in scene documents */
    if (!parse_number(walk, option, value, result)) return false;
    if (*result <= amount_max) return true;
    fail_usage(walk, "%s is \"%s\", must be at most %.0f", option->name, value, amount_max);
    return false;
}

bool parse_number(argument_walk *walk, const command_option *option, const char *value, double *result) {
    char *end = NULL;
    const double number = strtod(value, &end); /* this program never leaves the "C" locale */
    if (end == value || *end != '\0' || !isfinite(number) || number < 0) {
        fail_usage(walk, "%s is \"%s\", must be a number, 0 or more", option->name, value);
        return false;
    }
    *result = number;
    return true;
}

bool parse_count(argument_walk *walk, const command_option *option, const char *value, int *result) {
    double number = 0;
    if (!parse_number(walk, option, value, &number)) return false;
    if (number < 1 || number > 256 || number != floor(number)) {
        fail_usage(walk, "%s is \"%s\", must be a whole number from 1 to 256", option->name, value);
        return false;
    }
    *result = (int)number;
    return true;
}

bool parse_bytes(argument_walk *walk, const command_option *option, const char *value, size_t *result) {
    static const char *const suffixes[] = {"", "K", "M", "G", "T"};
    const size_t digit_count = strspn(value, "0123456789");
    const bool is_number = digit_count >= 1 && digit_count <= 19; /* less than 2^64 */
    const unsigned long long number = is_number ? strtoull(value, NULL, 10) : 0;
    for (int i = 0; i < 5; i++) {
        if (strcmp(value + digit_count, suffixes[i]) != 0 || number == 0 || number > SIZE_MAX >> 10 * i)
            continue;
        *result = (size_t)number << 10 * i;
        return true;
    }
    fail_usage(walk, "%s is \"%s\", must be a number of bytes, 1 or more, or one with K, M, G or T",
               option->name, value);
    return false;
}

bool parse_size(argument_walk *walk, const command_option *option, const char *value, int *width,
                int *height) {
    int end = 0;
    int w = 0;
    int h = 0;
    const bool has_digits = strspn(value, "0123456789x") == strlen(value); /* no signs, no blanks */
    if (has_digits && sscanf(value, "%5dx%5d%n", &w, &h, &end) == 2 && value[end] == '\0' && w >= 1 &&
        h >= 1 && w <= MTM_IMAGE_EDGE_MAX && h <= MTM_IMAGE_EDGE_MAX) {
        *width = w;
        *height = h;
        return true;
    }
    fail_usage(walk, "%s is \"%s\", must be WIDTHxHEIGHT, each from 1 to %d", option->name, value,
               MTM_IMAGE_EDGE_MAX);
    return false;
}

void print_help(const subcommand *command) {
    (void)printf("usage: metamer %s %s\n\n%s\n\noptions:\n", command->name, command->arguments,
                 command->summary);
    for (const command_option *option = command->options; option->name != NULL; option++) {
        char head[64];
        (void)snprintf(head, sizeof head, "%s %s", option->name,
                       option->placeholder == NULL ? "" : option->placeholder);
        (void)printf("  %-28s %s\n", head, option->help);
    }
    (void)printf("  %-28s %s\n", "--help", "this text");
}
