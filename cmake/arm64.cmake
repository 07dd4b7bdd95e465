# SPDX-License-Identifier: MIT
# The toolchain file of the preset arm64: Debian's cross compiler for ARM64, the folder of ARM64
# packages that scripts/arm64-sysroot makes, and qemu, which runs what is built, such as kaamos-hlsl
# during the build and every test.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(KAAMOS_ARM64_SYSROOT "${CMAKE_CURRENT_LIST_DIR}/../build/arm64-sysroot" CACHE PATH
  "Where scripts/arm64-sysroot has unpacked Debian's packages for ARM64")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES KAAMOS_ARM64_SYSROOT)
get_filename_component(CMAKE_SYSROOT "${KAAMOS_ARM64_SYSROOT}" ABSOLUTE)
if(NOT EXISTS "${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu")
  message(FATAL_ERROR "\"${CMAKE_SYSROOT}\" holds no packages for ARM64: run scripts/arm64-sysroot, "
    "or name the folder that it made with -DKAAMOS_ARM64_SYSROOT=FOLDER")
endif()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
find_program(KAAMOS_QEMU_AARCH64 NAMES qemu-aarch64-static qemu-aarch64)
if(NOT KAAMOS_QEMU_AARCH64)
  message(FATAL_ERROR "qemu-aarch64-static is not installed (Debian: apt-get install qemu-user-static)")
endif()
set(CMAKE_CROSSCOMPILING_EMULATOR "${KAAMOS_QEMU_AARCH64};-L;${CMAKE_SYSROOT}")
