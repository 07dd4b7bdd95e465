// SPDX-License-Identifier: MIT
//
// Tests that a multisampled texture that is writable gives the same error on every executor where a
// shader uses it. tests/draws reads the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "executors.h"
#include "fixtures.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kUses[] = {"written.Load(int3(z, 0, 0), 1);",
                                 "written.sample[z][uint3(1, 1, 0)] = 2;",
                                 "written[uint3(z, 0, 0)] = 1;", "written.GetSamplePosition(z);",
                                 "{ uint w, h, e, n; written.GetDimensions(w, h, e, n); }"};

hlsl::FrontendOptions use_in(const char* stage, const char* use) {
  hlsl::FrontendOptions options;
  options.path = "multisampled.hlsl";
  options.text = std::string(
                     "RWByteAddressBuffer results : register(u0);\n"
                     "RWTexture2DMSArray<uint> written : register(u1);\n") +
                 stage + " void Main() {\n  const uint z = results.Load(65532);\n" +
                 "  results.Store(0, 5);\n  " + use + "\n}\n";
  return options;
}

constexpr const char* kCompute = "[shader(\"compute\")] [numthreads(1, 1, 1)]";
constexpr const char* kRays = "[shader(\"raygeneration\")]";

void expect_removal(const std::string& backend, const Compiled& code) {
  ASSERT_NE(code.library, nullptr) << code.error;
  const std::string error = run_on_device(backend, *code.library, {1, 1, 1}).error();
  EXPECT_THAT(error, HasSubstr("KA0844"));
  EXPECT_THAT(error, HasSubstr("it used a RWTexture2DMS or RWTexture2DMSArray"));
}

std::vector<hlsl::FrontendOptions> all_uses() {
  std::vector<hlsl::FrontendOptions> out;
  for (const char* stage : {kCompute, kRays}) {
    for (const char* use : kUses) out.push_back(use_in(stage, use));
  }
  return out;
}

TEST(Multisampled, AUseThatRunsRemovesTheDevice_Native) {
  for (const Compiled& code : compile_native(all_uses())) expect_removal("embree", code);
}

TEST(Multisampled, AUseThatRunsRemovesTheDevice_Interpreted) {
  for (const auto& options : all_uses()) expect_removal("embree", compile_interpreted(options));
}

TEST(Multisampled, AUseThatRunsRemovesTheDevice_Vulkan) {
  KAAMOS_NEED_VULKAN();
  for (const auto& options : all_uses()) expect_removal("vulkan", compile_vulkan(options));
}

}  // namespace
}  // namespace kaamos::test
