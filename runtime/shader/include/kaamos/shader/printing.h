// SPDX-License-Identifier: MIT
//
// printf and errorf of shaders: what a call writes into the device's print buffer, and what a
// library knows of its calls. Shaders reach the buffer through DispatchConstants::prints; without
// one they write nothing.
#pragma once

#include <cstdint>

namespace kaamos::shader {

// One printf or errorf in the source of a library.
struct PrintDesc {
  uint64_t id;         // a hash of the rest, so that equal calls have the same in every library
  const char* format;  // of C's printf; %v is a value of any type. Without %s, which is filled in
  // Three characters for each value: f, d (64 bits), i, u, l (int64_t), q (uint64_t) or b; rows and
  // columns. "f13" is a float3, "f34" a float3x4.
  const char* arguments;
  bool is_error;  // errorf
};

// The buffer's first words, by byte offset.
inline constexpr uint32_t kPrintUsed = 0;      // bytes of records that were asked for
inline constexpr uint32_t kPrintFilter = 4;    // not 0: only thread kPrintThread prints
inline constexpr uint32_t kPrintThread = 8;    // uint3
inline constexpr uint32_t kPrintRoom = 20;     // bytes that records may take
inline constexpr uint32_t kPrintLost = 24;     // calls that found no room
inline constexpr uint32_t kPrintRecords = 32;  // here the records begin

// A record's first words. Its values follow, row by row and without padding: 4 bytes each, or 8.
inline constexpr uint32_t kRecordBytes = 0;    // of the whole record, a multiple of 4
inline constexpr uint32_t kRecordId = 4;       // uint64_t
inline constexpr uint32_t kRecordThread = 12;  // uint3: DispatchRaysIndex, SV_DispatchThreadID; of
                                               // pixels x, y, 0; of vertices vertex, instance, 0
inline constexpr uint32_t kRecordValues = 24;

}  // namespace kaamos::shader
