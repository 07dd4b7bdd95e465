# SPDX-License-Identifier: MIT
# Targets that check the form of the sources: format-check (fails where clang-format would change a
# line, as the test style.SourcesAreFormatted does), format (makes those changes), tidy-check
# (clang-tidy over all C++ sources; takes an hour). No build includes them.
include_guard()

find_program(KAAMOS_CLANG_FORMAT NAMES clang-format-14 clang-format)
find_program(KAAMOS_RUN_CLANG_TIDY NAMES run-clang-tidy-14 run-clang-tidy)

# kaamos_add_source_check(name program command...): if the program is missing, building the target
# says so.
function(kaamos_add_source_check name program package)
  if(NOT program)
    add_custom_target(${name} VERBATIM
      COMMAND ${CMAKE_COMMAND} -E echo "${name} needs ${package}: apt-get install ${package}"
      COMMAND ${CMAKE_COMMAND} -E false)
    return()
  endif()
  add_custom_target(${name} ${ARGN} VERBATIM USES_TERMINAL WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
endfunction()

set(format_sources "${PROJECT_SOURCE_DIR}/cmake/format_sources.sh")
kaamos_add_source_check(format-check "${KAAMOS_CLANG_FORMAT}" clang-format
  COMMAND bash "${format_sources}" "${PROJECT_SOURCE_DIR}" "${KAAMOS_CLANG_FORMAT}" --dry-run --Werror)
kaamos_add_source_check(format "${KAAMOS_CLANG_FORMAT}" clang-format
  COMMAND bash "${format_sources}" "${PROJECT_SOURCE_DIR}" "${KAAMOS_CLANG_FORMAT}" -i)
kaamos_add_source_check(tidy-check "${KAAMOS_RUN_CLANG_TIDY}" clang-tidy
  COMMAND "${KAAMOS_RUN_CLANG_TIDY}" -quiet -p "${PROJECT_BINARY_DIR}"
          "^${PROJECT_SOURCE_DIR}/(rtapi|runtime|d3d12|effects|examples|tests)/.*[.]cpp$")
