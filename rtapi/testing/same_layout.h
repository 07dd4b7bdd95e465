// SPDX-License-Identifier: MIT
//
// Static comparisons of rtapi's numbers, sizes and offsets with Microsoft's d3d12.h.
#pragma once

#include <wsl/winadapter.h>

#include <directx/d3d12.h>
#include <directx/dxgiformat.h>

#include <cstddef>
#include <cstdint>

#include <rtapi/rtapi.h>

#define SAME_VALUE(ours, theirs)                                                        \
  static_assert(static_cast<uint64_t>(ours) == static_cast<uint64_t>(theirs), #theirs); \
  static_assert(__COUNTER__ > 0)
#define SAME_SIZE(ours, theirs)                                    \
  static_assert(sizeof(rtapi::ours) == sizeof(theirs), #theirs);   \
  static_assert(alignof(rtapi::ours) == alignof(theirs), #theirs); \
  static_assert(__COUNTER__ > 0)
#define SAME_OFFSET(ours, theirs, member)                                                         \
  static_assert(offsetof(rtapi::ours, member) == offsetof(theirs, member), #theirs "::" #member); \
  static_assert(__COUNTER__ > 0)

namespace rtapi::testing {

// Each returns the number of comparisons that its file makes.
int layout_formats();
int layout_graphics();
int layout_numbers();
int layout_structs();

}  // namespace rtapi::testing
