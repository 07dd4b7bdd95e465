// SPDX-License-Identifier: MIT
//
// Executors agree to the bit on random programs. KAAMOS_RANDOM_PROGRAMS="FIRST COUNT" runs others
// than the few that belong to the test.
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
  return options;
}

std::vector<std::byte> run(const std::string& backend, const std::string& text) {
  const Compiled code = backend == "vulkan" ? compile_vulkan(options_of(text))
                                            : compile_interpreted(options_of(text));
  EXPECT_EQ(code.error, "");
  if (code.library == nullptr) return {};
  std::string error;
  auto out = run_on_device(backend, *code.library, kGroups, error);
  EXPECT_EQ(error, "");
  return out;
}

TEST(RandomPrograms, VulkanAgreesWithTheInterpreter) {
  KAAMOS_NEED_VULKAN();
  uint64_t first = 1;
  uint64_t count = 6;
  if (const char* asked = std::getenv("KAAMOS_RANDOM_PROGRAMS")) {
    std::istringstream(asked) >> first >> count;
  }
  for (uint64_t seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = random_program(seed);
    const auto expected = run("embree", text);
    const auto actual = run("vulkan", text);
    ASSERT_EQ(expected.size(), actual.size());
    for (size_t i = 0; i + 4 <= expected.size(); i += 4) {
      uint32_t e = 0, a = 0;
      std::memcpy(&e, &expected[i], 4);
      std::memcpy(&a, &actual[i], 4);
      if (e != a) {
        ADD_FAILURE() << "thread " << i / 512 << ", word " << i % 512 / 4 << " of\n" << text;
        break;
      }
    }
  }
}

}  // namespace
}  // namespace kaamos::test
