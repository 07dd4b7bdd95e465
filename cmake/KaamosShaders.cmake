# SPDX-License-Identifier: MIT
# kaamos_add_shader_library: HLSL compiled at build time. Part of the installed package too.
include_guard()

# How emitted code is compiled: here, and with the same lists at run time
# (runtime/hlsl/driver/compiler_options.cpp). The first makes it mean the same on every compiler.
# -fwrapv: HLSL's integers wrap. -ffp-contract=off: no fused operations that the source does not ask
# for. -fno-math-errno, -fno-trapping-math: nothing looks at errno or the exception flags.
# -fstack-clash-protection: variables that do not fit the stack hit its guard page.
set(KAAMOS_SHADER_COMPILE_OPTIONS
  -w -fwrapv -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti
  -fno-strict-aliasing -fstack-clash-protection)
# The level of release builds; those for debugging have their own.
set(KAAMOS_SHADER_OPTIMISATION -O3)
# For AVX2, whose registers hold the eight threads that a compute shader runs at once. g++ has to be
# told from version 12 on that whole registers may be copied: by itself it copies and clears eight
# threads' values in halves, which a load of the whole waits for. Other compilers lack these options.
set(KAAMOS_SHADER_AVX2_OPTIONS -mavx2)
set(KAAMOS_SHADER_GNU_AVX2_OPTIONS -mmove-max=256 -mstore-max=256)

# A build compiles shader libraries for any x86-64 and a second time for AVX2. The program picks what
# its processor can run (kaamos/shader/cpu_level.h); both give the same bits. -fno-weak keeps inline
# functions local to their object, so the linker cannot pick the AVX2 version of one for code that runs
# everywhere. Only g++ has this option.
set(KAAMOS_SECOND_VERSION_OPTIONS ${KAAMOS_SHADER_AVX2_OPTIONS} -fno-weak)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
  list(APPEND KAAMOS_SECOND_VERSION_OPTIONS ${KAAMOS_SHADER_GNU_AVX2_OPTIONS})
endif()
set(_kaamos_shader_avx2 OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$"
   AND NOT KAAMOS_SANITIZE)
  set(_kaamos_shader_avx2 ON)
endif()
option(KAAMOS_SHADER_AVX2 "Compile shader libraries for AVX2 too" ${_kaamos_shader_avx2})

# kaamos_add_shader_library(TARGET SOURCES a.hlsl b.hlsl ... [INCLUDES folder ...]
#   [DEFINES NAME=VALUE ...] [OPTIONS more options of kaamos-hlsl ...] [SUFFIX text] [BASELINE_ONLY]
#   [AT_FIRST_USE])
# makes a static library TARGET to link to. Each source NAME.hlsl gets a header <shaders/NAME.h> with
#   const kaamos::shader::LibraryDesc* kaamos_shaders_NAME();
# to pass to rtapi::ShaderLibrary. Sources are libraries unless OPTIONS has a target, such as
# -T ps_6_6 -E main; SUFFIX _ps makes both names end so (NAME_ps), for a source with several entry
# points. The library runs on every backend; OPTIONS -no-spirv leaves out what
# Vulkan needs, BASELINE_ONLY leaves out the AVX2 version. It is compiled again when a source or anything
# it includes changes. AT_FIRST_USE checks the sources and leaves their code to the program, which has
# it made by the C++ compiler of the machine where it runs when it first loads the library; a cache keeps
# it. Programs whose shaders are many and of which a run needs few build faster so.
function(kaamos_add_shader_library target)
  cmake_parse_arguments(arg "BASELINE_ONLY;AT_FIRST_USE" "SUFFIX" "SOURCES;INCLUDES;DEFINES;OPTIONS" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "kaamos_add_shader_library(${target}): unknown arguments: "
      "${arg_UNPARSED_ARGUMENTS}; name the files after SOURCES")
  endif()
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "kaamos_add_shader_library(${target}): no SOURCES given")
  endif()
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}")
  file(MAKE_DIRECTORY "${folder}/shaders")
  set(flags ${arg_OPTIONS})
  foreach(include IN LISTS arg_INCLUDES)
    get_filename_component(include "${include}" ABSOLUTE)
    list(APPEND flags -I "${include}")
  endforeach()
  foreach(define IN LISTS arg_DEFINES)
    list(APPEND flags -D "${define}")
  endforeach()
  set(optimisation "$<$<NOT:$<CONFIG:Debug,RelWithDebInfo>>:${KAAMOS_SHADER_OPTIMISATION}>")
  set(levels sse2)
  if(arg_AT_FIRST_USE)
    list(APPEND flags -emit source)
  elseif(KAAMOS_SHADER_AVX2 AND NOT arg_BASELINE_ONLY)
    list(APPEND levels avx2)
  endif()
  set(generated)
  set(choices)
  set(entries)
  foreach(source IN LISTS arg_SOURCES)
    get_filename_component(source "${source}" ABSOLUTE)
    get_filename_component(name "${source}" NAME_WE)
    string(MAKE_C_IDENTIFIER "${name}${arg_SUFFIX}" name)
    set(output "${folder}/${name}.cpp")
    add_custom_command(
      OUTPUT "${output}"
      COMMAND kaamos::kaamos-hlsl ${flags} --entry-function kaamos_shaders_${name}
              -MF "${output}.d" -o "${output}" "${source}"
      DEPENDS "${source}" kaamos::kaamos-hlsl
      DEPFILE "${output}.d"
      COMMENT "Compiling ${name}"
      VERBATIM)
    set(header "${folder}/shaders/${name}.h")
    file(CONFIGURE OUTPUT "${header}" @ONLY CONTENT
"// SPDX-License-Identifier: MIT
#pragma once
#include <kaamos/shader/abi.h>
// The library compiled from @name@.hlsl.
extern \"C\" const kaamos::shader::LibraryDesc* kaamos_shaders_@name@();
")
    list(APPEND generated "${output}")
    list(APPEND entries kaamos_shaders_${name})
    file(CONFIGURE OUTPUT "${folder}/${name}_level.cpp" @ONLY CONTENT
"// SPDX-License-Identifier: MIT
#include <kaamos/shader/cpu_level.h>

#include \"shaders/@name@.h\"

extern \"C\" const kaamos::shader::LibraryDesc* kaamos_shaders_@name@_sse2();
extern \"C\" const kaamos::shader::LibraryDesc* kaamos_shaders_@name@_avx2();
extern \"C\" const kaamos::shader::LibraryDesc* kaamos_shaders_@name@() {
  return kaamos::shader::cpu_level() == kaamos::shader::CpuLevel::kAvx2
             ? kaamos_shaders_@name@_avx2()
             : kaamos_shaders_@name@_sse2();
}
")
    list(APPEND choices "${folder}/${name}_level.cpp")
  endforeach()
  if(NOT "avx2" IN_LIST levels)
    add_library(${target} STATIC ${generated})
  else()
    # One rule makes both versions from the same sources.
    add_custom_target(${target}-sources DEPENDS ${generated})
    add_library(${target} STATIC ${choices})
    foreach(level IN LISTS levels)
      add_library(${target}-${level} OBJECT ${generated})
      add_dependencies(${target}-${level} ${target}-sources)
      list(TRANSFORM entries REPLACE "(.+)" "\\1=\\1_${level}" OUTPUT_VARIABLE names)
      target_compile_definitions(${target}-${level} PRIVATE ${names})
      target_link_libraries(${target}-${level} PRIVATE kaamos::shader)
      target_compile_features(${target}-${level} PRIVATE cxx_std_20)
      target_compile_options(${target}-${level} PRIVATE ${KAAMOS_SHADER_COMPILE_OPTIONS} "${optimisation}")
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}-${level}>)
    endforeach()
    target_compile_options(${target}-avx2 PRIVATE ${KAAMOS_SECOND_VERSION_OPTIONS})
  endif()
  target_link_libraries(${target} PUBLIC kaamos::shader)
  target_include_directories(${target} PUBLIC "${folder}")
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE ${KAAMOS_SHADER_COMPILE_OPTIONS} "${optimisation}")
endfunction()

# kaamos_add_shader_test(NAME FILE tests.hlsl [ON interpreter embree vulkan] [INCLUDES folder ...]
#   [DEFINES NAME=VALUE ...] [OPTIONS more options of kaamos-test ...] [LABELS label ...])
# makes a CTest test NAME.executor.TEST of every [test] in the file, which kaamos-test runs. ON: the
# interpreter if it is not given. The names come from the file as it is when CMake runs, and CMake runs
# again when it changes.
function(kaamos_add_shader_test name)
  cmake_parse_arguments(arg "" "FILE" "ON;INCLUDES;DEFINES;OPTIONS;LABELS" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_FILE)
    message(FATAL_ERROR "kaamos_add_shader_test(${name}): needs FILE, and knows no "
      "\"${arg_UNPARSED_ARGUMENTS}\"")
  endif()
  if(NOT arg_ON)
    set(arg_ON interpreter)
  endif()
  get_filename_component(file "${arg_FILE}" ABSOLUTE)
  get_filename_component(folder "${file}" DIRECTORY)
  get_filename_component(base "${file}" NAME)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  set(flags ${arg_OPTIONS})
  foreach(include IN LISTS arg_INCLUDES)
    get_filename_component(include "${include}" ABSOLUTE)
    list(APPEND flags -I "${include}")
  endforeach()
  foreach(define IN LISTS arg_DEFINES)
    list(APPEND flags -D "${define}")
  endforeach()
  file(READ "${file}" text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REPLACE "[" "@" text "${text}")  # lists of CMake do not divide brackets
  string(REPLACE "]" "@" text "${text}")
  string(REPLACE ";" "," text "${text}")
  string(REGEX MATCHALL "@test(\\([^)]*\\))?@[^{},]*(,[^{}]*)?void[ \t\n]+[A-Za-z_0-9]+" tests "${text}")
  foreach(test IN LISTS tests)
    string(REGEX MATCH "[A-Za-z_0-9]+$" test "${test}")
    foreach(executor IN LISTS arg_ON)
      set(id "${name}.${executor}.${test}")
      add_test(NAME ${id} WORKING_DIRECTORY "${folder}"
        COMMAND kaamos::kaamos-test "${base}" --filter "=${test}" --on ${executor} ${flags})
      set_tests_properties(${id} PROPERTIES SKIP_RETURN_CODE 77 LABELS "${arg_LABELS}")
    endforeach()
  endforeach()
  if(NOT tests)
    message(FATAL_ERROR "kaamos_add_shader_test(${name}): ${arg_FILE} has no [test]")
  endif()
endfunction()
