# SPDX-License-Identifier: MIT
# kaamos_add_shader_library: HLSL compiled with the program. Part of the installed package too.
include_guard()

# What emitted code needs to mean the same on every compiler; runtime/hlsl/host_compiler.cpp has the
# same list for libraries that are compiled at run time.
set(KAAMOS_SHADER_COMPILE_OPTIONS
  -w -fwrapv -ffp-contract=off -fno-math-errno -fno-trapping-math -fno-exceptions -fno-rtti
  -fno-strict-aliasing -fstack-clash-protection)

# kaamos_add_shader_library(TARGET SOURCES a.hlsl b.hlsl ... [INCLUDES folder ...]
#   [DEFINES NAME=VALUE ...] [OPTIONS more options of kaamos-hlsl ...])
# makes a static library TARGET to link to. Each source NAME.hlsl gives a header <shaders/NAME.h>
# with
#   const kaamos::shader::LibraryDesc* kaamos_shaders_NAME();
# for rtapi::ShaderLibrary. It runs on every backend; OPTIONS -no-spirv leaves out what Vulkan needs.
# A change of a source or of anything it includes compiles it again.
function(kaamos_add_shader_library target)
  cmake_parse_arguments(arg "" "" "SOURCES;INCLUDES;DEFINES;OPTIONS" ${ARGN})
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
  set(generated)
  foreach(source IN LISTS arg_SOURCES)
    get_filename_component(source "${source}" ABSOLUTE)
    get_filename_component(name "${source}" NAME_WE)
    string(MAKE_C_IDENTIFIER "${name}" name)
    set(output "${folder}/${name}.cpp")
    add_custom_command(
      OUTPUT "${output}"
      COMMAND kaamos::kaamos-hlsl ${flags} --entry-function kaamos_shaders_${name}
              -MF "${output}.d" -o "${output}" "${source}"
      DEPENDS "${source}" kaamos::kaamos-hlsl
      DEPFILE "${output}.d"
      COMMENT "Compiling ${name}.hlsl"
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
  endforeach()
  add_library(${target} STATIC ${generated})
  target_link_libraries(${target} PUBLIC kaamos::shader)
  target_include_directories(${target} PUBLIC "${folder}")
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE ${KAAMOS_SHADER_COMPILE_OPTIONS})
endfunction()
