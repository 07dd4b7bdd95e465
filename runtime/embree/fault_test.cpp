// SPDX-License-Identifier: MIT
#include "runtime/embree/fault.h"

#include <gtest/gtest.h>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree {
namespace {

using testing::Harness;
using testing::kNonOpaque;
using testing::Payload;
using testing::PipelineBuilder;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // their checks come before the fault, or enlarge frames
#else
constexpr bool kSanitized = false;
#endif

rtapi::Status run(Harness& h, shader::RayGenerationFn entry, uint32_t width = 64) {
  PipelineBuilder builder;
  const auto identifier = builder.ray_generation(entry);
  h.set_pipeline(builder, identifier);
  const uint64_t root = 0;
  return h.dispatch(width, 1, 1, &root, sizeof(root));
}

void write_to_nowhere(shader::Invocation& invocation) {
  if (invocation.index[0] != 37) return;
  auto* volatile nowhere = reinterpret_cast<uint32_t*>(uint64_t{0x10000});
  *nowhere = 1;
}

TEST(Fault, AWildAccessRemovesTheDeviceAndNamesShaderAndCell) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the access itself";
  Harness h(2);
  const auto status = run(h, write_to_nowhere);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0892");
  EXPECT_EQ(status.error().code, rtapi::ErrorCode::kDeviceRemoved);
  EXPECT_NE(status.error().message.find("0x10000"), std::string::npos) << status.error().message;
  EXPECT_NE(status.error().message.find("\"shader0\" at (37,0,0)"), std::string::npos)
      << status.error().message;
  EXPECT_NE(status.error().message.find("DispatchRays"), std::string::npos);
}

TEST(Fault, TheProcessGoesOnAfterMany) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the access itself";
  Harness h(2);
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(run(h, write_to_nowhere).ok());
  EXPECT_TRUE(run(h, [](shader::Invocation&) {}).ok());
}

TEST(Fault, AnIntegerDivisionByZeroRemovesTheDevice) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the division itself";
#if defined(__aarch64__)
  GTEST_SKIP() << "the quotient is 0 on ARM64, and nothing faults";
#endif
  Harness h;
  const auto status = run(h, [](shader::Invocation& invocation) {
    volatile int32_t zero = static_cast<int32_t>(invocation.index[1]);
    volatile int32_t result = 7 / zero;
    (void)result;
  });
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("SIGFPE"), std::string::npos) << status.error().message;
}

// Keeps a frame per call: no tail call, no inlining.
__attribute__((noinline)) uint32_t deeper(uint32_t depth) {
  volatile uint8_t frame[512];
  frame[depth % 512] = static_cast<uint8_t>(depth);
  return depth == 0xFFFFFFFF ? 0 : deeper(depth + 1) + frame[depth % 512];
}

TEST(Fault, ARunawayFunctionIsAStackOverflow) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the overflow itself";
  for (const uint32_t threads : {1u, 2u}) {
    Harness h(threads);
    const auto status = run(h, [](shader::Invocation&) { deeper(0); });
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().id.text(), "KA0891") << status.error().message;
  }
}

TEST(Fault, EndlessCallShaderIsAStackOverflow) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own call stack ends first";
#endif
  Harness h(2);
  PipelineBuilder builder;
  const auto ray_generation = builder.ray_generation([](shader::Invocation& invocation) {
    uint32_t data = 0;
    invocation.dispatch->services->call_shader(invocation, 0, &data, sizeof(data));
  });
  const auto callable = builder.callable([](shader::Invocation& invocation, void* data) {
    invocation.dispatch->services->call_shader(invocation, 0, data, 4);
    // The caller's frame must stay, so this is not a tail call.
    *static_cast<volatile uint32_t*>(data) = 1;
  });
  h.set_pipeline(builder, ray_generation);
  h.set_callable_table({{callable, 0}});
  const uint64_t root = 0;
  const auto status = h.dispatch(4, 4, 1, &root, sizeof(root));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0891");
}

TEST(Fault, AFaultInAnAnyHitShaderLeavesTheTraversal) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the access itself";
  Harness h;
  const uint64_t scene = h.scene({testing::triangle_at(3, kNonOpaque)});
  PipelineBuilder builder;
  const auto ray_generation = builder.ray_generation([](shader::Invocation& invocation) {
    uint64_t top_level;
    std::memcpy(&top_level, invocation.dispatch->root_arguments, sizeof(top_level));
    Payload payload;
    testing::trace_ray(invocation, testing::ray_along_z(top_level), &payload);
  });
  const auto hit = builder.hit_group(
      nullptr, [](shader::Invocation&, void*, const void*) -> shader::AnyHitResult {
        auto* volatile nowhere = reinterpret_cast<shader::AnyHitResult*>(uint64_t{0x20000});
        return *nowhere;
      });
  h.set_pipeline(builder, ray_generation);
  h.set_hit_table({{hit, 0}});
  const auto status = h.dispatch(8, 8, 1, &scene, sizeof(scene));
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("\"shader1\""), std::string::npos)
      << status.error().message;
  // The same structure can still be traced.
  h.use_standard_pipeline();
  EXPECT_EQ(h.trace(testing::ray_along_z(scene)).end, testing::End::kClosestHit);
}

TEST(Fault, AShaderMayAskForRemoval) {
  Harness h;
  const auto status = run(h, [](shader::Invocation& invocation) {
    invocation.dispatch->services->remove_device(invocation, shader::RemovalReason::kOther);
  });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0893");
}

TEST(Fault, AWildShaderTableRemovesTheDevice) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the access itself";
  Harness h;
  const uint64_t scene = h.scene({testing::triangle_at(3)});
  h.use_standard_pipeline();
  h.desc().HitGroupTable.StartAddress = 0x40000;
  EXPECT_EQ(h.trace(testing::ray_along_z(scene, 50)).end, testing::End::kMiss);
  const auto table = h.desc().RayGenerationShaderRecord;
  h.desc().RayGenerationShaderRecord.StartAddress = 0x40000;
  const uint64_t root = 0;
  const auto status = h.dispatch(1, 1, 1, &root, sizeof(root));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0892");
  h.desc().RayGenerationShaderRecord = table;
}

TEST(Fault, AnAddressWithoutATopLevelMissesWithAMessage) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t bottom_level = h.bottom_level({testing::triangle_at(3)});
  for (const uint64_t address : {uint64_t{0x123456789A00}, bottom_level, h.buffer(64)->address()}) {
    h.messages.clear();
    EXPECT_EQ(h.trace(testing::ray_along_z(address)).end, testing::End::kMiss);
    ASSERT_EQ(h.messages.size(), 1u);
    EXPECT_EQ(h.messages[0].Id.text(), "KA0894");
  }
}

}  // namespace
}  // namespace kaamos::embree
