# SPDX-License-Identifier: BSD-3-Clause
# Turns the CSV tables of data/ that the library needs into one C source.
include_guard()

function(metamer_embed_spectra output_variable)
    file(GLOB tables CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/data/spectra/cie_*.csv
         ${CMAKE_CURRENT_SOURCE_DIR}/data/bases/*.csv)
    set(script ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_spectra.cmake)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_spectra.c)
    add_custom_command(OUTPUT ${source}
        COMMAND ${CMAKE_COMMAND} -D OUTPUT=${source} "-D TABLES=${tables}" -P ${script}
        DEPENDS ${tables} ${script} COMMENT "Embedding spectra" VERBATIM)
    set(${output_variable} ${source} PARENT_SCOPE)
endfunction()
