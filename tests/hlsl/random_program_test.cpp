// SPDX-License-Identifier: MIT
//
// Executors agree to the bit on random programs. KAAMOS_RANDOM_PROGRAMS="FIRST COUNT" runs others
// than the few that the test always runs.
#include "random_program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <sstream>

#include "executors.h"
#include "fixtures.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

constexpr uint32_t kGroups[3] = {1, 1, 1};

hlsl::FrontendOptions options_of(const std::string& text) {
  hlsl::FrontendOptions options;
  options.path = "random.hlsl";
  options.text = text;
  options.native_16bit = true;
  options.target = "lib_6_9";
  return options;
}

std::vector<std::byte> run(const std::string& backend, const Compiled& code) {
  EXPECT_EQ(code.error, "");
  if (code.library == nullptr) return {};
  const auto out = run_on_device(backend, *code.library, kGroups);
  EXPECT_EQ(out.error(), "");
  return out ? *out : std::vector<std::byte>();
}

void expect_equal(const std::vector<std::byte>& expected, const std::vector<std::byte>& actual,
                  const std::string& text) {
  ASSERT_EQ(expected.size(), actual.size());
  for (size_t i = 0; i + 4 <= expected.size(); i += 4) {
    uint32_t e = 0, a = 0;
    std::memcpy(&e, &expected[i], 4);
    std::memcpy(&a, &actual[i], 4);
    if (e != a) {
      ADD_FAILURE() << "thread " << i / 512 << ", word " << i % 512 / 4 << " of\n" << text;
      return;
    }
  }
}

std::vector<uint64_t> seeds(uint64_t count) {
  uint64_t first = 1;
  if (const char* asked = std::getenv("KAAMOS_RANDOM_PROGRAMS")) {
    std::istringstream(asked) >> first >> count;
  }
  std::vector<uint64_t> out;
  for (uint64_t seed = first; seed < first + count; ++seed) out.push_back(seed);
  return out;
}

TEST(RandomPrograms, VulkanAgreesWithTheInterpreter) {
  KAAMOS_NEED_VULKAN();
  for (const uint64_t seed : seeds(6)) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = random_program(seed);
    expect_equal(run("embree", compile_interpreted(options_of(text))),
                 run("vulkan", compile_vulkan(options_of(text))), text);
  }
}

void expect_native_as_interpreted(hlsl::WideThreads wide) {
  // Only a few, because a C++ compiler takes a second for each.
  const std::vector<uint64_t> programs = seeds(2);
  std::vector<hlsl::FrontendOptions> sources;
  for (const uint64_t seed : programs) sources.push_back(options_of(random_program(seed)));
  const std::vector<Compiled> native = compile_native(sources, wide);
  for (size_t i = 0; i < sources.size(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(programs[i]));
    expect_equal(run("embree", compile_interpreted(sources[i])), run("embree", native[i]),
                 *sources[i].text);
  }
}

TEST(RandomPrograms, NativeCodeAgreesWithTheInterpreter) {
  expect_native_as_interpreted(hlsl::WideThreads::kNever);
}

// Eight threads at once, which diverge at every second condition.
TEST(RandomPrograms, WideCodeAgreesWithTheInterpreter) {
  expect_native_as_interpreted(hlsl::WideThreads::kAlways);
}

}  // namespace
}  // namespace kaamos::test
