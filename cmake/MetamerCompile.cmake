# SPDX-License-Identifier: BSD-3-Clause
# How every target of this project is compiled.
include_guard()

function(metamer_compile_options target)
    target_compile_features(${target} PUBLIC c_std_17)
    set_target_properties(${target} PROPERTIES C_EXTENSIONS OFF C_VISIBILITY_PRESET hidden)
    target_compile_definitions(${target} PRIVATE _POSIX_C_SOURCE=200809L)
    # No contraction to fused operations: pictures are the same bits on every compiler and instruction set.
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes
                           -Wmissing-prototypes -Wpointer-arith -Wvla -Wundef -ffp-contract=off)
    if(METAMER_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(METAMER_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${METAMER_SANITIZE} -fno-sanitize-recover=all
                               -fno-omit-frame-pointer)
        target_link_options(${target} PRIVATE -fsanitize=${METAMER_SANITIZE})
    endif()
endfunction()
