# SPDX-License-Identifier: BSD-3-Clause
# cmake -D OUTPUT=file.c -D TABLES=a.csv;b.csv -P embed_spectra.cmake
# Writes the tables as the array that src/spectrum/embedded.h declares: each file's text, named by its file.
set(code "/* Made by cmake/embed_spectra.cmake from data/spectra/. */\n#include \"spectrum/embedded.h\"\n\n")
string(APPEND code "const mtm_embedded_table mtm_embedded_tables[] = {\n")
foreach(table ${TABLES})
    cmake_path(GET table STEM LAST_ONLY name)
    string(APPEND code "    {\"${name}\",\n")
    file(STRINGS ${table} lines)
    foreach(line ${lines})
        string(REPLACE "\"" "\\\"" line "${line}")
        string(APPEND code "     \"${line}\\n\"\n")
    endforeach()
    string(APPEND code "    },\n")
endforeach()
string(APPEND code "    {0, 0},\n};\n")
file(WRITE ${OUTPUT} "${code}")
