// SPDX-License-Identifier: MIT
//
// The comments that make an .hlsl file a test:
//   // FEATURE: core 12 swizzles       the tier and which of its features it covers
//   // TRAP: 7                         or which trap
//   // OPTIONS: -HV 2018               as kaamos-hlsl takes them
//   // DISPATCH: 2 1 1                 groups, or threads of ray generation (default 1 1 1)
//   // BREAKS: KA0417                 what checked mode must say: it breaks a rule on purpose
//   // EXPECT u32 0 42                 type, byte offset in `results`, value
//   // EXPECT f32 4 0.5 2              floats may be so many ulps off (default 0)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::test {

enum class ValueKind : uint8_t { kU32, kI32, kF32, kU64, kF64 };

struct Expectation {
  ValueKind kind = ValueKind::kU32;
  uint32_t offset = 0;
  uint64_t bits = 0;  // of the expected value
  uint32_t ulps = 0;
  uint32_t line = 0;
};

struct HlslTest {
  std::string path;
  std::string name;                  // "core/swizzles"
  std::string feature;               // text behind FEATURE or "trap N"
  std::vector<std::string> options;  // words behind "// OPTIONS:", as for kaamos-hlsl
  uint32_t dispatch[3] = {1, 1, 1};
  std::vector<std::string> breaks;  // ids
  std::vector<Expectation> expectations;
  std::string error;  // what is wrong with the comments
};

// Every .hlsl file in these parts of `folder`, ordered by name.
std::vector<HlslTest> find_hlsl_tests(const std::string& folder,
                                      const std::vector<std::string>& parts);

// Returns what was found and what was expected; empty if they agree.
std::string compare(const Expectation& expectation, const std::vector<std::byte>& results);

}  // namespace kaamos::test
