# SPDX-License-Identifier: MIT
# Installs the build into a scratch prefix, moves that prefix (a package must not know where it was
# made), and configures, builds and runs the consumer project against it.
function(run_step what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${what} failed (${status}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/installed elsewhere")
run_step("installing" ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/first")
file(RENAME "${WORK}/first" "${prefix}")

file(GLOB_RECURSE texts "${prefix}/*.cmake" "${prefix}/*.h" "${prefix}/*.hlsl*")
foreach(text IN LISTS texts)
  file(READ "${text}" content)
  foreach(folder IN ITEMS "${SOURCE}/" "${BUILD}/" "${WORK}/first")
    # The character before it tells the folder "/src/" from the middle of "rtapi/src/".
    foreach(before IN ITEMS "\"" " " ";" ":" "=" "I")
      string(FIND "${content}" "${before}${folder}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "the installed \"${text}\" names a folder of the build: \"${folder}\"")
      endif()
    endforeach()
  endforeach()
endforeach()

string(REPLACE "," ";" expected "${EXPECTED}")
run_step("configuring the consumer" ${CMAKE_COMMAND} -S "${CONSUMER}" -B "${WORK}/build" -G Ninja
  "-DCMAKE_PREFIX_PATH=${prefix}" "-DKAAMOS_EXPECTED=${expected}" "-DCMAKE_CXX_COMPILER=${CXX}"
  "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${CCACHE}" -DCMAKE_BUILD_TYPE=Release)
run_step("building the consumer" ${CMAKE_COMMAND} --build "${WORK}/build")
run_step("running the consumer" "${WORK}/build/consumer")
message(STATUS "${output}")
if(EXISTS "${WORK}/build/lounge")
  run_step("rendering the lounge" ${CMAKE_COMMAND} -E chdir "${WORK}/build" "${WORK}/build/lounge")
  message(STATUS "${output}")
endif()
if(EXISTS "${WORK}/build/consumer-d3d12")
  run_step("running the D3D12 consumer" "${WORK}/build/consumer-d3d12")
  message(STATUS "${output}")
  run_step("running the Win32 consumer" "${WORK}/build/win32_words")
  message(STATUS "${output}")
endif()
if(EXISTS "${prefix}/bin/kaamos-hlsl")
  run_step("compiling shaders without the source tree" bash "${SOURCE}/tests/package/without_source.sh"
    "${SOURCE}" "${BUILD}" "${prefix}" "${WORK}/build" "${WORK}/without source")
  message(STATUS "${output}")
endif()
file(REMOVE_RECURSE "${WORK}")
