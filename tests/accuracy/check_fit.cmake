# SPDX-License-Identifier: BSD-3-Clause
# cmake -D FIT=program -D SOURCE=folder -D OUT=folder -D THREADS=n [-D DIMENSION=d] -P check_fit.cmake
# The program writes, byte for byte, the tables of data/bases: all of them, or those of one dimension.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
set(arguments --threads ${THREADS})
set(pattern *.csv)
if(DIMENSION)
    list(APPEND arguments --dimension ${DIMENSION})
    set(pattern factors_${DIMENSION}.csv)
endif()
execute_process(COMMAND ${FIT} ${arguments} ${SOURCE} ${OUT} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB written RELATIVE ${OUT} ${OUT}/*)
file(GLOB expected RELATIVE ${SOURCE}/data/bases ${SOURCE}/data/bases/${pattern})
if(NOT written STREQUAL expected OR NOT expected)
    message(FATAL_ERROR "written: ${written}\nexpected: ${expected}")
endif()
foreach(table ${expected})
    execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${OUT}/${table} ${SOURCE}/data/bases/${table}
                    RESULT_VARIABLE difference)
    if(difference)
        message(FATAL_ERROR "${OUT}/${table} differs from data/bases/${table}; `make bases` fits the tables again")
    endif()
endforeach()
