# SPDX-License-Identifier: MIT
# kaamos_add_shared_library(TARGET ARCHIVE OUTPUT name EXPORTS file [NAMES other.so ...] [LINK library ...]): the whole
# of a static library of this build as lib<name>.so, with what it needs. EXPORTS is a linker's version script; it hides
# all other symbols. What the libraries of LINK define is taken from them. The soname has the version's first two numbers, since a new minor version may break programs.
# NAMES are further names of the file, in a folder of their own.
include_guard()

function(kaamos_add_shared_library target archive)
  cmake_parse_arguments(arg "" "OUTPUT;EXPORTS" "NAMES;LINK" ${ARGN})
  if(KAAMOS_SANITIZE)
    return()  # their runtime belongs into programs
  endif()
  get_filename_component(exports "${arg_EXPORTS}" ABSOLUTE)
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp" "// All code comes from ${archive}.\n")
  add_library(${target} SHARED "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp")
  set_source_files_properties("${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp" PROPERTIES KAAMOS_ALONE ON)
  target_link_libraries(${target} PRIVATE kaamos_build_flags
    ${arg_LINK} "$<LINK_LIBRARY:WHOLE_ARCHIVE,${archive}>")
  target_link_options(${target} PRIVATE "LINKER:--version-script=${exports}" "LINKER:--no-undefined" "LINKER:--gc-sections")
  set_target_properties(${target} PROPERTIES OUTPUT_NAME "${arg_OUTPUT}" VERSION "${PROJECT_VERSION}"
    SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}" LINK_DEPENDS "${exports}")
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$<$<BOOL:${arg_LINK}>:$ORIGIN;$ORIGIN/../..>")
  foreach(name IN LISTS arg_NAMES)
    set(link "${CMAKE_CURRENT_BINARY_DIR}/names/${name}")
    file(MAKE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/names")
    file(CREATE_LINK "../../lib${arg_OUTPUT}.so.${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}" "${link}" SYMBOLIC)
    install(FILES "${link}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/kaamos/d3d12" COMPONENT d3d12)
  endforeach()
endfunction()
