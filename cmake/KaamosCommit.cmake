# SPDX-License-Identifier: MIT
# kaamos_add_commit(TARGET HEADER): makes HEADER, below a folder include/, which says from which commit the sources
# are: kaamos::kCommit, empty if that is not known. The build runs this file as a script for it. Sources of a release
# have no repository; git archive writes the commit into commit.txt for them.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  file(READ "${CMAKE_CURRENT_LIST_DIR}/commit.txt" commit)
  if(EXISTS "${SOURCE}/.git")
    execute_process(COMMAND git -C "${SOURCE}" rev-parse HEAD OUTPUT_VARIABLE commit ERROR_QUIET)
  endif()
  string(STRIP "${commit}" commit)
  if(NOT commit MATCHES "^[0-9a-f]+$")
    set(commit "")
  endif()
  file(WRITE "${OUTPUT}" "#pragma once\n\nnamespace kaamos {\ninline constexpr char kCommit[] = \"${commit}\";\n}\n")
  return()
endif()
include_guard()

function(kaamos_add_commit target header)
  # The log of HEAD changes with every commit and every checkout.
  execute_process(COMMAND git -C "${PROJECT_SOURCE_DIR}" rev-parse --git-path logs/HEAD
    OUTPUT_VARIABLE log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  set(changes)
  if(log)
    get_filename_component(log "${log}" ABSOLUTE BASE_DIR "${PROJECT_SOURCE_DIR}")
    if(EXISTS "${log}")
      set(changes "${log}")
    endif()
  endif()
  add_custom_command(OUTPUT "${header}"
    COMMAND ${CMAKE_COMMAND} -D "OUTPUT=${header}" -D "SOURCE=${PROJECT_SOURCE_DIR}" -P "${CMAKE_CURRENT_FUNCTION_LIST_FILE}"
    DEPENDS "${CMAKE_CURRENT_FUNCTION_LIST_FILE}" ${changes} VERBATIM)
  target_sources(${target} PRIVATE "${header}")
  get_filename_component(folder "${header}" DIRECTORY)
  target_include_directories(${target} PRIVATE "${folder}/..")
endfunction()
