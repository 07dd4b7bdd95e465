// SPDX-License-Identifier: MIT
// Numbers that no other call of this process gets. [Win32: securitybaseapi.h]
#pragma once

#include <winnt.h>

inline BOOL AllocateLocallyUniqueId(PLUID id) {
  static volatile LONGLONG last = 0;
  const LONGLONG number = InterlockedIncrement64(&last);
  id->LowPart = (DWORD)number;
  id->HighPart = (LONG)(number >> 32);
  return TRUE;
}
