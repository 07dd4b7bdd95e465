# SPDX-License-Identifier: MIT
# cmake -DPROGRAM=kaamos-d3d12-support -DPAGE=SUPPORT.md -P support_test.cmake: the page has what the program prints.
execute_process(COMMAND "${PROGRAM}" OUTPUT_VARIABLE table COMMAND_ERROR_IS_FATAL ANY)
file(READ "${PAGE}" page)
string(FIND "${page}" "${table}" found)
if(found EQUAL -1)
  message(FATAL_ERROR "${PAGE} does not have this table, which kaamos-d3d12-support prints:\n${table}")
endif()
