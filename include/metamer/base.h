/* SPDX-License-Identifier: BSD-3-Clause
 * Status codes, error text, progress and what every other public header needs. */
#ifndef METAMER_BASE_H
#define METAMER_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define MTM_API   __attribute__((visibility("default")))
#define MTM_CHECK __attribute__((warn_unused_result))
#else
#define MTM_API
#define MTM_CHECK
#endif

/* What the world can do wrong. A caller's own mistake is an assertion instead, stated as a precondition. */
typedef enum mtm_status {
    MTM_OK = 0,
    MTM_ARGUMENT, /* a name or value that the call cannot use: an unknown light, a basis that cannot relight */
    MTM_MEMORY,   /* out of memory */
    MTM_IO,       /* a file could not be found, read or written */
    MTM_FORMAT,   /* a file does not follow its format */
    MTM_LIMIT,    /* a size beyond what this library accepts */
    MTM_NUMERIC,  /* a computation without a usable answer */
    MTM_CANCELLED, /* the progress callback asked to stop */
} mtm_status;

/* One sentence that names file, field and value and says what was expected. Every call that takes an
 * `mtm_error *` fills it exactly when it returns something other than MTM_OK; NULL is allowed. */
typedef struct mtm_error {
    char message[1024];
} mtm_error;

/* Called now and then from the thread that started the work with the fraction begun (0..1, rising; 1 need not be
 * reported). Returning false lets no further part begin, and the work then returns MTM_CANCELLED. */
typedef bool (*mtm_progress_function)(void *user, double fraction);

typedef struct mtm_progress {
    mtm_progress_function report; /* NULL: nobody listens */
    void *user;
} mtm_progress;

/* The version of the library, "major.minor.patch". */
MTM_API const char *mtm_version(void);

/* Number of threads used where an option says 0: the processors this process may run on, at least 1. No option gives
 * more than 256. */
MTM_API int mtm_default_thread_count(void);

/* The instruction set that inner loops run with: "baseline", "x86-64-v3" (AVX2) or "x86-64-v4" (AVX-512), the highest
 * that this machine has, or the lower one that the environment variable METAMER_ISA names. Relit bytes are the
 * same with each of them; projected coefficients agree to 1e-5 of full scale where rays are not terminated. */
MTM_API const char *mtm_isa_name(void);

/* Writes the text as the whole content of a file, all or nothing: the file of that name is replaced when the new one is
 * complete. MTM_IO names the file and the reason; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_text_write(const char *path, const char *text, mtm_error *error);

/* Frees text that the library returned as `char *`. NULL is allowed. */
MTM_API void mtm_text_free(char *text);

#ifdef __cplusplus
}
#endif
#endif
