// SPDX-License-Identifier: MIT
// Assertions; there is no debug heap. [MSVC: crtdbg.h]
#pragma once

#include <assert.h>

#define _ASSERT(condition) assert(condition)
#define _ASSERTE(condition) assert(condition)
#define _CRTDBG_ALLOC_MEM_DF 0x01
#define _CRTDBG_LEAK_CHECK_DF 0x20
#define _CRTDBG_REPORT_FLAG (-1)
inline int _CrtSetDbgFlag(int) {
  return 0;
}
inline int _CrtDumpMemoryLeaks() {
  return 0;
}
