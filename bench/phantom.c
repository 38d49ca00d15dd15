/* SPDX-License-Identifier: BSD-3-Clause
 * Writes a volume of any size in closed form, slice by slice: a ball full of detail, empty space round it, and two thin
 * shells. Over the cube -1 … 1, voxel i of n at -1 + 2i / (n - 1), with r the distance from the center and m the signal
 * of S. R. Marschner, R. J. Lobb, "An Evaluation of Reconstruction Filters for Volume Rendering" (IEEE Visualization
 * 1994), the voxels are the nearest bytes to
 *   255 m(x, y, z) clamp((0.7 - r) / 0.03) + 96 (tent((r - 0.8) / 0.03) + tent((r - 0.92) / 0.03)),
 * clamp to 0 … 1, tent(t) = max(0, 1 - |t|). Usage: phantom EDGE FILE.nrrd */
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { EDGE_MIN = 2, EDGE_MAX = 8192, PATH_BYTES = 4096 };

static double clamp01(double value) {
    return value < 0 ? 0 : value > 1 ? 1 : value;
}

static double tent(double value) {
    return fabs(value) < 1 ? 1 - fabs(value) : 0;
}

/* The two parts of Marschner's and Lobb's signal, which is their sum: it is separable into z and (x, y). */
static double signal_along_z(double z) {
    const double pi = 3.14159265358979323846;
    return (1 - sin(0.5 * pi * z)) / 2.5;
}

static double signal_across_z(double x, double y) {
    const double pi = 3.14159265358979323846;
    return 0.25 * (1 + cos(12 * pi * cos(0.5 * pi * sqrt(x * x + y * y)))) / 2.5;
}

static double position(int edge, int index) {
    return -1 + 2.0 * index / (edge - 1);
}

static unsigned char value_at(double marschner_lobb, double r) {
    const double width = 0.03;
    const double ball = 255 * marschner_lobb * clamp01((0.7 - r) / width);
    const double shells = 96 * (tent((r - 0.8) / width) + tent((r - 0.92) / width));
    return (unsigned char)(ball + shells + 0.5);
}

/* across: edge × edge values of signal_across_z; slice: as many voxels. */
static void fill_slice(int edge, int k, const double *across, unsigned char *slice) {
    const double z = position(edge, k);
    const double along = signal_along_z(z);
    for (int j = 0; j < edge; j++) {
        const double y = position(edge, j);
        const size_t row = (size_t)j * (size_t)edge;
        for (int i = 0; i < edge; i++) {
            const double x = position(edge, i);
            slice[row + (size_t)i] = value_at(along + across[row + (size_t)i], sqrt(x * x + y * y + z * z));
        }
    }
}

/* Ctrl-C and kill wait, blocked, until the unfinished file is gone. */
static sigset_t ending_signals(void) {
    sigset_t set;
    (void)sigemptyset(&set);
    (void)sigaddset(&set, SIGINT);
    (void)sigaddset(&set, SIGTERM);
    return set;
}

static bool is_ended(void) {
    sigset_t pending;
    return sigpending(&pending) == 0 &&
           (sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1);
}

/* False after the disk refused, with errno set, or when the user ended it. */
static bool write_volume(int edge, FILE *stream) {
    const size_t slice_bytes = (size_t)edge * (size_t)edge;
    const bool is_terminal = isatty(STDERR_FILENO) == 1;
    double *across = malloc(slice_bytes * sizeof *across);
    unsigned char *slice = malloc(slice_bytes);
    bool is_good = across != NULL && slice != NULL;
    for (size_t n = 0; is_good && n < slice_bytes; n++)
        across[n] =
            signal_across_z(position(edge, (int)(n % (size_t)edge)), position(edge, (int)(n / (size_t)edge)));
    if (is_good)
        is_good = fprintf(stream, "NRRD0004\ntype: uint8\ndimension: 3\nsizes: %d %d %d\nencoding: raw\n\n",
                          edge, edge, edge) > 0;
    for (int k = 0; is_good && k < edge; k++) {
        fill_slice(edge, k, across, slice);
        is_good = fwrite(slice, 1, slice_bytes, stream) == slice_bytes && !is_ended();
        if (is_terminal) (void)fprintf(stderr, "\rphantom: %3d %%", 100 * (k + 1) / edge);
    }
    if (is_terminal) (void)fprintf(stderr, "\r\033[K");
    free(slice);
    free(across);
    return is_good;
}

/* Writes beside the target and renames, so that a target is whole or not there. */
static bool write_file(int edge, const char *path) {
    char temporary[PATH_BYTES];
    const int length = snprintf(temporary, sizeof temporary, "%s.%ld.tmp", path, (long)getpid());
    if (length < 0 || length >= PATH_BYTES) {
        errno = ENAMETOOLONG;
        return false;
    }
    FILE *stream = fopen(temporary, "wbx");
    if (stream == NULL) return false;
    bool is_good = write_volume(edge, stream);
    is_good = fclose(stream) == 0 && is_good;
    is_good = is_good && rename(temporary, path) == 0;
    if (!is_good) {
        const int cause = errno;
        (void)remove(temporary);
        errno = cause;
    }
    return is_good;
}

/* A whole number within bounds; 0 for anything else. */
static int parse_edge(const char *text) {
    char *end = NULL;
    const long edge = strtol(text, &end, 10);
    return end != text && *end == '\0' && edge >= EDGE_MIN && edge <= EDGE_MAX ? (int)edge : 0;
}

int main(int argc, char **argv) {
    const int edge = argc == 3 ? parse_edge(argv[1]) : 0;
    if (edge == 0 || *argv[2] == '\0') {
        (void)fprintf(stderr, "usage: phantom EDGE FILE.nrrd, EDGE from %d to %d\n", EDGE_MIN, EDGE_MAX);
        return 2;
    }
    const sigset_t ending = ending_signals();
    (void)sigprocmask(SIG_BLOCK, &ending, NULL);
    (void)signal(SIGXFSZ, SIG_IGN); /* the user's limit is then an error of writing */
    const bool is_good = write_file(edge, argv[2]);
    const int cause = errno;
    (void)sigprocmask(SIG_UNBLOCK, &ending, NULL);
    if (is_good) return 0;
    (void)fprintf(stderr, "phantom: %s: cannot be written: %s\n", argv[2], strerror(cause));
    return 1;
}
