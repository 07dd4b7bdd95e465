# SPDX-License-Identifier: MIT
# What all targets of the project share: warnings, sanitizers, a faster linker where there is one,
# and kaamos_add_test, which gives a GoogleTest executable its ctest labels.
include_guard()

# Older compilers fail in the middle of the build with unhelpful messages.
if((CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
   OR (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14))
  message(FATAL_ERROR "Kaamos needs g++ 12 or clang++ 14 or newer; ${CMAKE_CXX_COMPILER} is "
    "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}. Set CXX to a newer one.")
endif()

# All of this applies to this build only. The package exports the target empty, because static
# libraries that link it refer to it by name.
add_library(kaamos_build_flags INTERFACE)
set_target_properties(kaamos_build_flags PROPERTIES EXPORT_NAME build_flags)
function(kaamos_add_build_flags)
  cmake_parse_arguments(arg "" "" "COMPILE;LINK" ${ARGN})
  foreach(flag IN LISTS arg_COMPILE)
    target_compile_options(kaamos_build_flags INTERFACE "$<BUILD_INTERFACE:${flag}>")
  endforeach()
  foreach(flag IN LISTS arg_LINK)
    target_link_options(kaamos_build_flags INTERFACE "$<BUILD_INTERFACE:${flag}>")
  endforeach()
endfunction()
kaamos_add_build_flags(COMPILE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
  -Wno-missing-braces  # clang asks for braces around each row of a matrix
  -Wno-missing-field-initializers)  # designated initialisers name what differs from the default
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # gcc 12 reports overlapping copies in every "literal" + std::string at -O2 and above (its bug
  # 105651). In moves of std::variant and std::optional it reports reads of inactive members; clang
  # and the sanitizers catch real ones.
  kaamos_add_build_flags(COMPILE -Wno-restrict -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # An eighth of what g++ takes goes into tidying its own memory. It has a gigabyte before it begins to.
  kaamos_add_build_flags(COMPILE --param=ggc-min-heapsize=1000000)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(KAAMOS_X86_64 ON)
else()
  set(KAAMOS_X86_64 OFF)
  # So that results have the bits that they have on x86-64. By default g++ fuses a * b + c wherever the
  # processor can, rounding once, not twice; any x86-64 cannot. char has a sign there, and not on ARM.
  kaamos_add_build_flags(COMPILE -ffp-contract=off -fsigned-char)
endif()
if(KAAMOS_WERROR)
  kaamos_add_build_flags(COMPILE -Werror)
endif()
if(KAAMOS_SANITIZE)
  kaamos_add_build_flags(
    COMPILE -fsanitize=${KAAMOS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined
    LINK -fsanitize=${KAAMOS_SANITIZE})
  if(KAAMOS_SANITIZE MATCHES "undefined")
    # Debian's glslang has no type information, which this check needs.
    kaamos_add_build_flags(COMPILE -fno-sanitize=vptr)
  endif()
  # Sanitizer suppressions are linked into every program, so that they apply to tests, to the tools
  # that tests start, and to programs started by hand.
  add_library(kaamos_sanitizer_defaults OBJECT "${CMAKE_CURRENT_LIST_DIR}/sanitizer_defaults.cpp")
  target_compile_options(kaamos_sanitizer_defaults PRIVATE -fsanitize=${KAAMOS_SANITIZE})
  target_link_libraries(kaamos_build_flags INTERFACE
    "$<BUILD_INTERFACE:$<TARGET_OBJECTS:kaamos_sanitizer_defaults>>")
endif()
find_program(KAAMOS_MOLD mold)
if(KAAMOS_MOLD AND NOT KAAMOS_SANITIZE)
  if(NOT CMAKE_CROSSCOMPILING)
    kaamos_add_build_flags(LINK -fuse-ld=mold)
  elseif(EXISTS "/usr/libexec/mold/ld")
    # g++ for another processor looks for a mold with that processor's name, but takes any ld of -B.
    kaamos_add_build_flags(LINK -B/usr/libexec/mold)
  endif()
endif()
find_program(KAAMOS_CCACHE ccache)
if(KAAMOS_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${KAAMOS_CCACHE}")
endif()

# What runs for each ray, triangle or texel is optimised fully in builds that optimise little else.
function(kaamos_compile_fully)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  endforeach()
endfunction()

# Programs leave the work to libraries and are compiled lightly: at -O3, the command line of
# northlight alone takes five seconds.
function(kaamos_compile_lightly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# How many times as long a test may take: tests of cross builds run in an emulator.
set(KAAMOS_TIME_FACTOR 1)
if(CMAKE_CROSSCOMPILING)
  set(KAAMOS_TIME_FACTOR 10)
endif()

# What scripts/test --full=arm64 builds: the tests below these folders, and the programs that they start.
set(KAAMOS_EMULATED_TESTS "^(runtime|rtapi|tests/(conformance|draws|errors|hlsl|observed|shaders))(/|$)")
add_custom_target(emulated-tests)
function(kaamos_test_when_emulated target)
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  if(folder MATCHES "${KAAMOS_EMULATED_TESTS}")
    add_dependencies(emulated-tests ${target})
  endif()
endfunction()

# kaamos_add_test(NAME SOURCES a.cpp ... LIBRARIES x ... LABELS unit [TIMEOUT s]
#   [MANY_PIPELINES])
# Adds one executable; every TEST in it becomes one ctest test with the given labels, in a process of
# its own. Under scripts/test, neighbours share a process (tests/vulkan/shared_runs.h), so a test puts
# back what it changes of the environment and of limits. Tests start through kaamos-isolate, which
# repeats a test on Vulkan that the driver crashed. A test counts as one on Vulkan if it or its
# executable has "vulkan" in its name; it then gets the label vulkan too. Tests are half of what a
# build compiles, and each runs only once: they are compiled without optimisation, in two thirds of
# the time; what they test is optimised. MANY_PIPELINES is for Vulkan tests that make many pipelines and
# trace few rays: lavapipe does not optimise those pipelines, which takes it less than half the time.
# All other tests run what users run. The first test of each process has a COST, so that ctest starts
# it before all others: the rest then find their results, and no job waits for one that another runs.
set(KAAMOS_TESTS_PER_PROCESS 16)
set(KAAMOS_COST_OF_A_PROCESS 100)
# Of a test that takes a minute by itself.
set(KAAMOS_COST_OF_A_LONG_TEST 200)
function(kaamos_add_test name)
  cmake_parse_arguments(arg "MANY_PIPELINES" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT KAAMOS_BUILD_TESTS)
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  math(EXPR arg_TIMEOUT "${arg_TIMEOUT} * ${KAAMOS_TIME_FACTOR}")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE kaamos_build_flags ${arg_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O0>)
  target_compile_definitions(${name} PRIVATE
    KAAMOS_SOURCE_DIR="${PROJECT_SOURCE_DIR}" KAAMOS_BINARY_DIR="${PROJECT_BINARY_DIR}")
  # CMake calls the program that starts a test its emulator. A real one, of cross builds, has to start
  # kaamos-isolate too, which starts the test under it.
  set(isolate "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/kaamos-isolate" --limit ${arg_TIMEOUT}
    --share ${KAAMOS_TESTS_PER_PROCESS})
  if(CMAKE_CROSSCOMPILING)
    list(PREPEND isolate ${CMAKE_CROSSCOMPILING_EMULATOR})
    foreach(word IN LISTS CMAKE_CROSSCOMPILING_EMULATOR)
      list(APPEND isolate --under ${word})
    endforeach()
  endif()
  set_target_properties(${name} PROPERTIES CROSSCOMPILING_EMULATOR "${isolate}")
  add_dependencies(${name} kaamos-isolate)
  kaamos_test_when_emulated(${name})
  math(EXPR timeout "2 * ${arg_TIMEOUT} + 30")  # kaamos-isolate ends it before this
  include(GoogleTest)
  # DISCOVERY_MODE PRE_TEST keeps the build from running every test executable once. With sanitizers
  # on a busy machine, listing the tests takes longer than the default 5 s.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${timeout})
  set(vulkan_environment "")
  if(arg_MANY_PIPELINES)
    set(vulkan_environment "GALLIVM_PERF=nopt")
  endif()
  # gtest_discover_tests splits lists of labels, so they are set once ctest knows the tests.
  set(labels_file "${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake")
  file(WRITE "${labels_file}"
    "set(count_other 0)\n"
    "set(count_vulkan 0)\n"
    "foreach(test IN LISTS ${name}_TESTS)\n"
    "  string(REGEX REPLACE \"  #.*\" \"\" plain \"\${test}\")\n"
    "  set(kind other)\n"
    "  if(plain MATCHES \"[Vv][Uu][Ll][Kk][Aa][Nn]\")\n"
    "    set(kind vulkan)\n"
    "  endif()\n"
    "  math(EXPR place \"\${count_\${kind}} % ${KAAMOS_TESTS_PER_PROCESS}\")\n"
    "  math(EXPR count_\${kind} \"\${count_\${kind}} + 1\")\n"
    "  if(place EQUAL 0)\n"
    "    set_tests_properties(\"\${test}\" PROPERTIES COST ${KAAMOS_COST_OF_A_PROCESS})\n"
    "  endif()\n"
    "  set(labels ${arg_LABELS})\n"
    "  if(test MATCHES \"[Vv]ulkan\")\n"
    "    list(APPEND labels vulkan)\n"
    "    list(REMOVE_DUPLICATES labels)\n"
    "    set_tests_properties(\"\${test}\" PROPERTIES ENVIRONMENT \"${vulkan_environment}\")\n"
    "  endif()\n"
    "  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"\${labels}\")\n"
    "endforeach()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${labels_file}")
endfunction()
