# SPDX-License-Identifier: MIT
# kaamos_add_d3d12_program: host code written for Windows and D3D12, compiled for Linux by clang.
include_guard()

# Sets KAAMOS_D3D12_HEADER_FOLDERS beforehand: folders whose headers stand for Win32's and DirectX's.

find_program(KAAMOS_CLANG NAMES clang++ clang++-19 clang++-18 clang++-17 clang++-16 clang++-15 clang++-14)
mark_as_advanced(KAAMOS_CLANG)

# Windows' compiler extensions, without the macro that says it is Microsoft's compiler.
set(KAAMOS_D3D12_COMPILE_OPTIONS
  -fms-extensions -fms-compatibility -fms-compatibility-version=19.30 -U_MSC_VER
  -Wno-unknown-pragmas -Wno-microsoft -Wno-nonportable-include-path
  # `&CD3DX12_RESOURCE_BARRIER::Transition(...)`: the temporary lives until the call returns.
  -Wno-address-of-temporary
  # Nor is there a return at the end of every WinMain.
  -fno-strict-return)

# Writes a header with the macros that clang defines for Linux and leaves out in MS mode, without
# which the system's headers do not compile.
function(kaamos_write_gnu_predefines file)
  set(command "${KAAMOS_CLANG}" -x c++ -std=gnu++17 -dM -E /dev/null)
  execute_process(COMMAND ${command} OUTPUT_VARIABLE gnu COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${command} ${KAAMOS_D3D12_COMPILE_OPTIONS} OUTPUT_VARIABLE ms COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "" gnu "${gnu}")
  string(REPLACE "\n" ";" gnu "${gnu}")
  set(text "")
  foreach(line IN LISTS gnu)
    string(REGEX MATCH "^#define ([A-Za-z0-9_]+)" name "${line}")
    set(name "${CMAKE_MATCH_1}")
    if(name AND NOT ms MATCHES "#define ${name}[ (\n]")
      string(APPEND text "#ifndef ${name}\n${line}\n#endif\n")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT "${file}" @ONLY CONTENT "${text}")
endfunction()

# Copies the C++ library's own header of std::exception to `folder`/bits/exception.h, with MSVC's constructor that takes
# a text. What that text says is printed, since the class has no room for it.
function(kaamos_write_exception_header folder)
  execute_process(COMMAND "${KAAMOS_CLANG}" -x c++ -std=gnu++17 -M -include exception /dev/null
    OUTPUT_VARIABLE files COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "[^ \n]*/bits/exception\\.h" header "${files}")
  if(NOT header)
    return()  # not GNU's library: programs that use the constructor do not compile
  endif()
  file(READ "${header}" text)
  string(REPLACE "exception() _GLIBCXX_NOTHROW { }"
    "exception() _GLIBCXX_NOTHROW { }\n    explicit exception(const char* text) { kaamos_print_exception(text); }" text "${text}")
  string(REPLACE "extern \"C++\" {" "extern \"C++\" {\nvoid kaamos_print_exception(const char* text);" text "${text}")
  file(CONFIGURE OUTPUT "${folder}/bits/exception.h" @ONLY CONTENT "${text}")
endfunction()

# Copies the C++ library's own <fstream> to `folder`, with MSVC's wide paths and with backslashes in every path; the
# library itself declares wide ones where the system opens such files.
function(kaamos_write_fstream_header folder)
  execute_process(COMMAND "${KAAMOS_CLANG}" -x c++ -std=gnu++17 -M -include fstream /dev/null
    OUTPUT_VARIABLE files COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "[^ \n]*/fstream[ \n]" header "${files}")
  string(STRIP "${header}" header)
  if(NOT header)
    return()  # not GNU's library: programs with wide paths do not compile
  endif()
  file(READ "${header}" text)
  string(REPLACE "_GLIBCXX_HAVE__WFOPEN && _GLIBCXX_USE_WCHAR_T" "1" text "${text}")
  string(REPLACE "open(const wchar_t* __s, ios_base::openmode __mode);"
    "open(const wchar_t* __s, ios_base::openmode __mode) { return open(kaamos_stream_path(__s), __mode); }"
    text "${text}")
  string(REPLACE "_M_filebuf.open(__s, __mode | ios_base::in)"
    "_M_filebuf.open(kaamos_input_path(__s), __mode | ios_base::in)" text "${text}")
  string(REPLACE "_M_filebuf.open(__s," "_M_filebuf.open(kaamos_stream_path(__s)," text "${text}")
  string(REPLACE "decltype(std::declval<_Path&>().make_preferred().filename())"
    "decltype(kaamos_path_type(std::declval<_Path&>()))" text "${text}")
  # Inlined: the library has the code of the class as it was, and none for wide paths.
  foreach(name IN ITEMS open basic_ifstream basic_ofstream basic_fstream)
    foreach(path IN ITEMS "const char[*]" "const wchar_t[*]" "const std::string&")
      string(REGEX REPLACE "([ \t])${name}\\((${path}) __s(,[^;{]*\\)[ \t\n]*[{:])"
        "\\1__attribute__((__always_inline__)) ${name}(\\2 __s\\3" text "${text}")
    endforeach()
  endforeach()
  string(REPLACE "namespace std " "#include <kaamos_stream_path.h>\nnamespace std " text "${text}")
  file(CONFIGURE OUTPUT "${folder}/fstream" @ONLY CONTENT "${text}")
endfunction()

# Writes a file for clang's -ivfsoverlay that shows the headers of a list of folders, and below, in one
# folder `root` whose names match in any case. The first folder wins. Where `root` is such a folder
# itself, its own headers get the match; those that come later do when CMake runs again. Build folders have none.
function(kaamos_write_header_overlay file root)
  set(entries "")
  set(seen)
  foreach(folder IN LISTS ARGN)
    file(GLOB_RECURSE headers RELATIVE "${folder}" "${folder}/*.h" "${folder}/*.hpp" "${folder}/*.inl")
    get_filename_component(folder_name "${folder}" NAME)
    foreach(header IN LISTS headers)
      string(FIND "${folder}/${header}" "${CMAKE_BINARY_DIR}/" in_build)
      if(in_build EQUAL 0)
        continue()
      endif()
      if(folder_name STREQUAL "directx")
        # As DirectX-Headers' own users include it, and the headers that add to Microsoft's.
        string(APPEND entries
          "  {'name': 'directx/${header}', 'type': 'file', 'external-contents': '${folder}/${header}'},\n")
      endif()
      string(TOLOWER "${header}" key)
      if(key IN_LIST seen)
        continue()
      endif()
      list(APPEND seen "${key}")
      string(APPEND entries "  {'name': '${header}', 'type': 'file', 'external-contents': '${folder}/${header}'},\n")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT "${file}" @ONLY CONTENT
"{'version': 0, 'case-sensitive': 'false', 'use-external-names': 'true', 'roots': [
 {'name': '${root}', 'type': 'directory', 'contents': [
${entries} ]}]}
")
endfunction()

# kaamos_add_d3d12_shader(SOURCE OUTPUT_VARIABLE [PROFILE lib_6_3] [ENTRY main] [OBJECT name.cso]
#   [HEADER file.h] [VARIABLE g_name] [OPTIONS more options of dxc ...])
# Compiles an HLSL file by kaamos-dxc, at build time, to OBJECT (NAME.cso; NAME.ENTRY.cso with ENTRY) in the programs'
# folder; with HEADER also to an array VARIABLE in that header, below a folder that is an include folder of programs.
# Adds the files to the list OUTPUT_VARIABLE, for SHADERS of kaamos_add_d3d12_program.
function(kaamos_add_d3d12_shader source outputs)
  cmake_parse_arguments(arg "" "PROFILE;ENTRY;OBJECT;HEADER;VARIABLE" "OPTIONS" ${ARGN})
  if(NOT arg_PROFILE)
    set(arg_PROFILE lib_6_3)
  endif()
  get_filename_component(source "${source}" ABSOLUTE)
  get_filename_component(name "${source}" NAME_WLE)
  if(arg_ENTRY)
    string(APPEND name ".${arg_ENTRY}")
  endif()
  if(NOT arg_OBJECT)
    set(arg_OBJECT "${name}.cso")
  endif()
  set(folder "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  if(NOT folder)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}")  # where CMake puts programs without being told
  endif()
  set(object "${folder}/${arg_OBJECT}")
  get_filename_component(folder "${object}" DIRECTORY)
  file(MAKE_DIRECTORY "${folder}")
  set(flags -T ${arg_PROFILE} ${arg_OPTIONS})
  if(arg_ENTRY)
    list(APPEND flags -E ${arg_ENTRY})
  endif()
  set(made "${object}")
  if(arg_HEADER)
    set(header "${CMAKE_CURRENT_BINARY_DIR}/d3d12_shaders/${arg_HEADER}")
    get_filename_component(folder "${header}" DIRECTORY)
    file(MAKE_DIRECTORY "${folder}")
    list(APPEND flags -Fh "${header}")
    list(APPEND made "${header}")
    if(arg_VARIABLE)
      list(APPEND flags -Vn ${arg_VARIABLE})
    endif()
  endif()
  add_custom_command(
    OUTPUT ${made}
    COMMAND kaamos::kaamos-dxc ${flags} -Fo "${object}" -MF "${object}.d" "${source}"
    DEPENDS "${source}" kaamos::kaamos-dxc
    DEPFILE "${object}.d"
    COMMENT "Compiling ${name} for D3D12"
    VERBATIM)
  set(${outputs} ${${outputs}} ${made} PARENT_SCOPE)
endfunction()

# kaamos_add_d3d12_program(TARGET SOURCES a.cpp ... [SHADERS files of kaamos_add_d3d12_shader ...]
#   [INCLUDES folder ...] [DEFINES NAME=VALUE ...] [OPTIONS more options of clang ...])
# Makes a program of sources that are written for Windows: <windows.h>, <d3d12.h>, <d3dx12.h>,
# <dxgi1_6.h>, <wrl/client.h>, in any letter case and with backslashes; it begins in main, wmain,
# WinMain or wWinMain. INCLUDES, DEFINES and OPTIONS are for its sources, which target_compile_definitions and the like
# do not reach: clang compiles them by commands of their own. _DEBUG is defined in Debug builds, NDEBUG in others.
# Without clang there is no target, and a status message says so.
function(kaamos_add_d3d12_program target)
  cmake_parse_arguments(arg "" "" "SOURCES;SHADERS;INCLUDES;DEFINES;OPTIONS" ${ARGN})
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "kaamos_add_d3d12_program(${target}): no SOURCES given")
  endif()
  if(CMAKE_CROSSCOMPILING)
    message(STATUS "${target} is left out: D3D12 programs are compiled for this machine's processor only")
    return()
  endif()
  if(NOT KAAMOS_CLANG)
    message(STATUS "${target} is left out: D3D12 programs need clang++ (Debian: package clang)")
    return()
  endif()
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}.d3d12")
  set(overlays "${folder}/headers.yaml")
  kaamos_write_header_overlay("${folder}/headers.yaml" "${folder}/headers" ${KAAMOS_D3D12_HEADER_FOLDERS})
  set(includes)
  foreach(own IN LISTS CMAKE_CURRENT_SOURCE_DIR arg_INCLUDES)
    get_filename_component(own "${own}" ABSOLUTE)
    string(MD5 name "${own}")
    kaamos_write_header_overlay("${folder}/${name}.yaml" "${own}" "${own}")
    list(APPEND overlays "${folder}/${name}.yaml")
    list(APPEND includes -I "${own}")
  endforeach()
  kaamos_write_gnu_predefines("${folder}/gnu_predefines.h")
  kaamos_write_exception_header("${folder}/library")
  kaamos_write_fstream_header("${folder}/library")
  set(flags ${KAAMOS_D3D12_COMPILE_OPTIONS} -std=gnu++17 -fPIC -include "${folder}/gnu_predefines.h"
    -I "${CMAKE_CURRENT_BINARY_DIR}/d3d12_shaders" ${includes} -isystem "${folder}/headers"
    -isystem "${folder}/library"
    -include kaamos_crt.h)
  foreach(overlay IN LISTS overlays)
    list(APPEND flags -ivfsoverlay "${overlay}")
  endforeach()
  foreach(define IN LISTS arg_DEFINES)
    list(APPEND flags "-D${define}")
  endforeach()
  # -Og and not -O0: code for Windows refers to static constants of classes that are defined nowhere.
  set(objects)
  foreach(source IN LISTS arg_SOURCES)
    get_filename_component(source "${source}" ABSOLUTE)
    file(RELATIVE_PATH name "${CMAKE_CURRENT_SOURCE_DIR}" "${source}")
    string(REPLACE "../" "__/" name "${name}")
    get_filename_component(own "${source}" DIRECTORY)
    set(object "${folder}/${name}.o")
    get_filename_component(object_folder "${object}" DIRECTORY)
    file(MAKE_DIRECTORY "${object_folder}")
    add_custom_command(
      OUTPUT "${object}"
      COMMAND "${KAAMOS_CLANG}" ${flags} -I "${own}" "$<IF:$<CONFIG:Debug>,-Og;-D_DEBUG,-O2;-DNDEBUG>"
              "$<$<OR:$<CONFIG:Debug>,$<CONFIG:RelWithDebInfo>>:-g>" ${arg_OPTIONS}
              -MD -MF "${object}.d" -c "${source}" -o "${object}"
      DEPENDS "${source}" ${arg_SHADERS} ${overlays}
      DEPFILE "${object}.d"
      COMMENT "Building D3D12 program ${target}: ${name}"
      COMMAND_EXPAND_LISTS
      VERBATIM)
    list(APPEND objects "${object}")
  endforeach()
  set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  add_executable(${target} ${objects} ${arg_SHADERS})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${target} PRIVATE kaamos::d3d12_main kaamos::d3d12)
endfunction()
