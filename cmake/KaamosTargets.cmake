# SPDX-License-Identifier: MIT
# What every target of the project shares: warnings, sanitizers, a faster linker where there is one,
# and kaamos_add_test, which gives a GoogleTest executable its ctest labels.
include_guard()

add_library(kaamos_build_flags INTERFACE)
target_compile_options(kaamos_build_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
if(KAAMOS_WERROR)
  target_compile_options(kaamos_build_flags INTERFACE -Werror)
endif()
if(KAAMOS_SANITIZE)
  target_compile_options(kaamos_build_flags INTERFACE
    -fsanitize=${KAAMOS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(kaamos_build_flags INTERFACE -fsanitize=${KAAMOS_SANITIZE})
endif()
find_program(KAAMOS_MOLD mold)
if(KAAMOS_MOLD AND NOT KAAMOS_SANITIZE)
  target_link_options(kaamos_build_flags INTERFACE -fuse-ld=mold)
endif()
find_program(KAAMOS_CCACHE ccache)
if(KAAMOS_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${KAAMOS_CCACHE}")
endif()

# kaamos_add_test(NAME SOURCES a.cpp ... LIBRARIES x ... LABELS unit [TIMEOUT s])
# One executable; every TEST in it is one ctest test with the given labels.
function(kaamos_add_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT KAAMOS_BUILD_TESTS)
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE kaamos_build_flags ${arg_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    KAAMOS_SOURCE_DIR="${PROJECT_SOURCE_DIR}" KAAMOS_BINARY_DIR="${PROJECT_BINARY_DIR}")
  include(GoogleTest)
  # DISCOVERY_MODE PRE_TEST keeps the build from running every test executable once.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()
