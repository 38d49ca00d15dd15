# SPDX-License-Identifier: BSD-3-Clause
# What `make install` puts where: libraries, headers, a pkg-config file, a CMake package, the licence.
include_guard()
include(CMakePackageConfigHelpers)

set(METAMER_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/metamer)
install(TARGETS metamer_shared metamer_static EXPORT metamerTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT metamerTargets NAMESPACE metamer:: DESTINATION ${METAMER_PACKAGE_FOLDER})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/metamerConfig.cmake.in ${CMAKE_BINARY_DIR}/metamerConfig.cmake
                              INSTALL_DESTINATION ${METAMER_PACKAGE_FOLDER})
# Before 1.0 a minor version may change the API.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/metamerConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/metamerConfig.cmake ${CMAKE_BINARY_DIR}/metamerConfigVersion.cmake
        DESTINATION ${METAMER_PACKAGE_FOLDER})

# The prefix in metamer.pc is relative to the file, so that `cmake --install --prefix` and moved trees work.
set(METAMER_PKGCONFIG_FOLDER ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${METAMER_PKGCONFIG_FOLDER}
           OUTPUT_VARIABLE METAMER_PREFIX_FROM_PKGCONFIG)
configure_file(${CMAKE_CURRENT_LIST_DIR}/metamer.pc.in ${CMAKE_BINARY_DIR}/metamer.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/metamer.pc DESTINATION ${METAMER_PKGCONFIG_FOLDER})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The library holds tables of data/spectra, whose licences ask to come along.
file(GLOB METAMER_SPECTRA_TERMS ${PROJECT_SOURCE_DIR}/data/spectra/LICENSE-*.txt ${PROJECT_SOURCE_DIR}/data/spectra/README.md)
install(FILES ${METAMER_SPECTRA_TERMS} DESTINATION ${CMAKE_INSTALL_DOCDIR}/spectra)
