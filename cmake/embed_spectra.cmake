# SPDX-License-Identifier: BSD-3-Clause
# cmake -D OUTPUT=file.c -D TABLES=a.csv;b.csv -P embed_spectra.cmake
# Writes the tables as the array that src/spectrum/embedded.h declares: each file's text, named by its file.
# As bytes, because C compilers need not take string literals of more than 4095 characters.
set(texts "")
set(entries "")
set(index 0)
foreach(table ${TABLES})
    cmake_path(GET table STEM LAST_ONLY name)
    file(READ ${table} bytes HEX)
    string(REGEX REPLACE "(................................)" "\\1\n   " bytes "${bytes}")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" " 0x\\1," bytes "${bytes}")
    string(APPEND texts "static const char text_${index}[] = {\n   ${bytes} 0x00};\n\n")
    string(APPEND entries "    {\"${name}\", text_${index}},\n")
    math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT} "/* Made by cmake/embed_spectra.cmake from data/. */\n#include \"spectrum/embedded.h\"\n\n"
     "${texts}const mtm_embedded_table mtm_embedded_tables[] = {\n${entries}    {0, 0},\n};\n")
