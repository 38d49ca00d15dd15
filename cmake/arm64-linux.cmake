# SPDX-License-Identifier: BSD-3-Clause
# Toolchain: 64-bit ARM Linux from another Debian machine, with Debian's cross compiler. Libraries come from the folder
# METAMER_SYSROOT, which `tools/bootstrap emulate` fills; tests that are programs of this build run under qemu-aarch64.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
cmake_path(SET sysroot_default NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../build/sysroot/arm64)
set(METAMER_SYSROOT ${sysroot_default} CACHE PATH "Root folder of the arm64 libraries")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES METAMER_SYSROOT)
set(CMAKE_SYSROOT ${METAMER_SYSROOT})
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

# Programs are this machine's, all else is the other's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${METAMER_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${METAMER_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${METAMER_SYSROOT}/usr/share/pkgconfig)

set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L ${METAMER_SYSROOT})
