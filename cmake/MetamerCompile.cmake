# SPDX-License-Identifier: BSD-3-Clause
# How every target of this project is compiled.
include_guard()

# Kernels have a variant per instruction set in one binary (src/base/isa.h): the x86-64 levels where the compiler has
# them, elsewhere only what the compiler makes by default.
include(CheckCCompilerFlag)
set(METAMER_ISA_LEVELS)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
    check_c_compiler_flag(-march=x86-64-v4 METAMER_COMPILER_HAS_X86_64_LEVELS)
    if(METAMER_COMPILER_HAS_X86_64_LEVELS)
        set(METAMER_ISA_LEVELS x86-64-v3 x86-64-v4)
    endif()
endif()

function(metamer_compile_options target)
    target_compile_features(${target} PUBLIC c_std_17)
    set_target_properties(${target} PROPERTIES C_EXTENSIONS OFF C_VISIBILITY_PRESET hidden)
    target_compile_definitions(${target} PRIVATE _POSIX_C_SOURCE=200809L
                               $<$<BOOL:${METAMER_ISA_LEVELS}>:METAMER_HAS_X86_64_LEVELS>)
    # No contraction to fused operations: the same bits from every compiler; kernels name what they want fused.
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes
                           -Wmissing-prototypes -Wpointer-arith -Wvla -Wundef -ffp-contract=off
                           -Wno-psabi) # vectors wider than the machine's are passed within a file only
    if(METAMER_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(METAMER_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${METAMER_SANITIZE} -fno-sanitize-recover=all
                               -fno-omit-frame-pointer)
        target_link_options(${target} PRIVATE -fsanitize=${METAMER_SANITIZE})
    endif()
endfunction()

# Compiles the sources, which belong to `target` and are its baseline variants, once more for every level. The objects
# are appended to the list named by `objects_variable`.
function(metamer_compile_per_isa objects_variable target)
    set(objects ${${objects_variable}})
    foreach(level ${METAMER_ISA_LEVELS})
        string(REPLACE - _ suffix ${level})
        set(variant ${target}_${suffix})
        add_library(${variant} OBJECT ${ARGN})
        metamer_compile_options(${variant})
        target_compile_options(${variant} PRIVATE -march=${level} -mprefer-vector-width=512)
        target_compile_definitions(${variant} PRIVATE MTM_ISA_SUFFIX=${suffix})
        set_target_properties(${variant} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        target_include_directories(${variant} PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
        list(APPEND objects $<TARGET_OBJECTS:${variant}>)
    endforeach()
    set(${objects_variable} ${objects} PARENT_SCOPE)
endfunction()
