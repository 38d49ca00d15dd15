/* SPDX-License-Identifier: BSD-3-Clause
 * Which instruction set the kernels run with. A kernel is one source that CMake compiles once per instruction set
 * (metamer_compile_per_isa); it names what it exports with MTM_OF_ISA, and its callers choose among the variants:
 *
 *     const mtm_x_kernel MTM_OF_ISA(mtm_x_kernel) = {…};                        in x_kernel.c
 *     MTM_ISA_DECLARE(mtm_x_kernel, mtm_x_kernel);                              in x_kernel.h
 *     static const mtm_x_kernel *const kernels[] = MTM_ISA_LIST(mtm_x_kernel);  in x.c
 *     kernels[mtm_isa_chosen()] … */
#ifndef METAMER_BASE_ISA_H
#define METAMER_BASE_ISA_H

/* From the lowest on; each has all instructions of those before it. */
typedef enum mtm_isa {
    MTM_ISA_BASELINE,  /* what the compiler is asked for by default: SSE2 on x86-64, NEON on arm64 */
    MTM_ISA_X86_64_V3, /* AVX2, FMA, F16C, BMI */
    MTM_ISA_X86_64_V4, /* AVX-512 F, BW, CD, DQ, VL */
} mtm_isa;

/* The highest that is compiled in and that this processor and its operating system support. */
mtm_isa mtm_isa_highest(void);

/* The same, or the lower one that the environment variable METAMER_ISA names ("baseline", "x86-64-v3", "x86-64-v4").
 * A name that is higher or unknown changes nothing. */
mtm_isa mtm_isa_chosen(void);

#ifndef MTM_ISA_SUFFIX
#define MTM_ISA_SUFFIX baseline /* the build sets another for every other variant */
#endif
#define MTM_ISA_JOIN(name, suffix)        name##_##suffix
#define MTM_ISA_JOIN_VALUES(name, suffix) MTM_ISA_JOIN(name, suffix)
#define MTM_OF_ISA(name)                  MTM_ISA_JOIN_VALUES(name, MTM_ISA_SUFFIX)

#ifdef METAMER_HAS_X86_64_LEVELS
#define MTM_ISA_DECLARE(type, name) extern const type name##_baseline, name##_x86_64_v3, name##_x86_64_v4
#define MTM_ISA_LIST(name)                                                                                   \
    { &name##_baseline, &name##_x86_64_v3, &name##_x86_64_v4 }
#else
#define MTM_ISA_DECLARE(type, name) extern const type name##_baseline
#define MTM_ISA_LIST(name)                                                                                   \
    { &name##_baseline }
#endif

#endif
