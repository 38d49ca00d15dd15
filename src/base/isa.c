/* SPDX-License-Identifier: BSD-3-Clause
 * Chooses the instruction set of the kernels. The levels are those of the x86-64 psABI (System V Application Binary
 * Interface, AMD64 Architecture Processor Supplement, section 3.1.1). */
#include "base/isa.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "metamer/base.h"

static const char *const names[] = {"baseline", "x86-64-v3", "x86-64-v4"};

#ifdef METAMER_HAS_X86_64_LEVELS
#include <cpuid.h>

/* What clang 14 has no __builtin_cpu_supports for. These need no support of the operating system beyond AVX2's. */
static bool has_f16c_movbe_lzcnt(void) {
    unsigned a, b, c, d;
    const unsigned wanted = bit_F16C | bit_MOVBE;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & wanted) != wanted) return false;
    return __get_cpuid(0x80000001, &a, &b, &c, &d) && (c & bit_LZCNT) != 0;
}

/* __builtin_cpu_supports also asks whether the operating system saves the wide registers. */
static mtm_isa detect(void) {
    __builtin_cpu_init();
    const bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                        __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                        has_f16c_movbe_lzcnt();
    const bool has_v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512vl");
    if (!has_v3) return MTM_ISA_BASELINE;
    return has_v4 ? MTM_ISA_X86_64_V4 : MTM_ISA_X86_64_V3;
}
#else
static mtm_isa detect(void) {
    return MTM_ISA_BASELINE;
}
#endif

/* Written once: asking the processor takes microseconds inside a virtual machine. */
static pthread_once_t is_detected = PTHREAD_ONCE_INIT;
static mtm_isa detected;

static void detect_once(void) {
    detected = detect();
}

mtm_isa mtm_isa_highest(void) {
    (void)pthread_once(&is_detected, detect_once);
    return detected;
}

mtm_isa mtm_isa_chosen(void) {
    const mtm_isa highest = mtm_isa_highest();
    const char *wanted = getenv("METAMER_ISA");
    for (mtm_isa isa = MTM_ISA_BASELINE; wanted != NULL && isa < highest; isa++)
        if (strcmp(wanted, names[isa]) == 0) return isa;
    return highest;
}

const char *mtm_isa_name(void) {
    return names[mtm_isa_chosen()];
}
