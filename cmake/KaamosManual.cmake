# SPDX-License-Identifier: MIT
# The reference manual: target reference-manual makes PROJECT_BINARY_DIR/manual/html/index.html of the public
# headers by cmake/Doxyfile, and fails where a comment is missing or broken. Not part of a build; a test
# makes it.
include_guard()

find_program(KAAMOS_DOXYGEN doxygen)

set(manual_command "${CMAKE_COMMAND}" -E env "KAAMOS_MANUAL_DIR=${PROJECT_BINARY_DIR}/manual"
  "KAAMOS_VERSION=${PROJECT_VERSION}" "${KAAMOS_DOXYGEN}" cmake/Doxyfile)
kaamos_add_source_check(reference-manual "${KAAMOS_DOXYGEN}" doxygen
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${PROJECT_BINARY_DIR}/manual" COMMAND ${manual_command}
  COMMENT "Reference manual: ${PROJECT_BINARY_DIR}/manual/html/index.html")
if(KAAMOS_BUILD_TESTS)
  add_test(NAME manual.BuildsWithoutWarnings WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    COMMAND ${manual_command})
  set_tests_properties(manual.BuildsWithoutWarnings PROPERTIES LABELS unit TIMEOUT 300)
endif()
