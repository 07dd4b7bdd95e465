# SPDX-License-Identifier: MIT
# cmake -DROOT=<folder> -P spdx.cmake: fails and lists every source below ROOT whose first line (the
# second after "#!") is not its SPDX line. Folders named testdata hold inputs of tests, in which a line
# more would move every line number that the tests expect.
set(files)
foreach(folder rtapi runtime effects examples tests cmake)
  file(GLOB_RECURSE found LIST_DIRECTORIES false RELATIVE "${ROOT}"
    "${ROOT}/${folder}/*.cpp" "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.hlsl"
    "${ROOT}/${folder}/*.hlsli" "${ROOT}/${folder}/*.cmake" "${ROOT}/${folder}/*.cmake.in"
    "${ROOT}/${folder}/CMakeLists.txt" "${ROOT}/${folder}/*.sh")
  list(APPEND files ${found})
endforeach()
file(GLOB_RECURSE found LIST_DIRECTORIES false RELATIVE "${ROOT}" "${ROOT}/scripts/*" "${ROOT}/.ci/*")
list(APPEND files ${found} CMakeLists.txt)
list(FILTER files EXCLUDE REGEX "(^|/)(testdata|build)/|\\.(swp|md|orig|rej)$|~$")

set(missing)
list(LENGTH files count)
foreach(file IN LISTS files)
  if(NOT EXISTS "${ROOT}/${file}")
    continue()
  endif()
  file(STRINGS "${ROOT}/${file}" lines LIMIT_COUNT 2)
  list(JOIN lines "\n" head)
  if(NOT head MATCHES "^(#![^\n]*\n)?(//|#) SPDX-License-Identifier: MIT(\n|$)")
    list(APPEND missing "${file}")
  endif()
endforeach()
if(missing)
  list(JOIN missing "\n  " text)
  message(FATAL_ERROR "these sources do not begin with \"SPDX-License-Identifier: MIT\" in a comment:\n  ${text}")
endif()
message(STATUS "${count} sources carry their SPDX line")
