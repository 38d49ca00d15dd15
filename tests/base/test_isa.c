/* SPDX-License-Identifier: BSD-3-Clause
 * The instruction set of the kernels. */
#include <stdio.h>
#include <stdlib.h>

#include "base/isa.h"
#include "test.h"

static const char *const names[] = {"baseline", "x86-64-v3", "x86-64-v4"};

static const char *name_with(const char *wanted) {
    assert_int_equal(setenv("METAMER_ISA", wanted, 1), 0);
    return mtm_isa_name();
}

static void the_environment_lowers_the_instruction_set(void **state) {
    (void)state;
    for (mtm_isa isa = MTM_ISA_BASELINE; isa <= mtm_isa_highest(); isa++)
        assert_string_equal(name_with(names[isa]), names[isa]);
    assert_int_equal(unsetenv("METAMER_ISA"), 0);
}

static void the_environment_cannot_raise_it_and_other_words_are_ignored(void **state) {
    (void)state;
    assert_int_equal(unsetenv("METAMER_ISA"), 0);
    const char *highest = mtm_isa_name();
    assert_string_equal(highest, names[mtm_isa_highest()]);
    for (mtm_isa isa = mtm_isa_highest(); isa <= MTM_ISA_X86_64_V4; isa++)
        assert_string_equal(name_with(names[isa]), highest);
    assert_string_equal(name_with(""), highest);
    assert_string_equal(name_with("BASELINE"), highest);
    assert_int_equal(unsetenv("METAMER_ISA"), 0);
}

/* Linux lists what the processor and the kernel support together. */
static void the_highest_is_what_the_system_lists(void **state) {
    (void)state;
    char flags[16384] = "";
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file != NULL && fgets(flags, sizeof flags, file) != NULL && strncmp(flags, "flags", 5) != 0) {
    }
    if (file != NULL) (void)fclose(file);
    if (strncmp(flags, "flags", 5) != 0) skip();
#ifdef METAMER_HAS_X86_64_LEVELS
    static const char *const v3[] = {" avx2", " fma", " f16c", " movbe", " abm", " bmi1", " bmi2"};
    static const char *const v4[] = {" avx512f", " avx512bw", " avx512cd", " avx512dq", " avx512vl"};
    bool has_v3 = true;
    bool has_v4 = true;
    for (size_t i = 0; i < sizeof v3 / sizeof *v3; i++) has_v3 = has_v3 && strstr(flags, v3[i]) != NULL;
    for (size_t i = 0; i < sizeof v4 / sizeof *v4; i++) has_v4 = has_v4 && strstr(flags, v4[i]) != NULL;
    assert_int_equal(mtm_isa_highest(),
                     has_v3 ? has_v4 ? MTM_ISA_X86_64_V4 : MTM_ISA_X86_64_V3 : MTM_ISA_BASELINE);
#else
    assert_int_equal(mtm_isa_highest(), MTM_ISA_BASELINE);
#endif
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_environment_lowers_the_instruction_set),
        cmocka_unit_test(the_environment_cannot_raise_it_and_other_words_are_ignored),
        cmocka_unit_test(the_highest_is_what_the_system_lists),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
