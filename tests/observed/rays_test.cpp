// SPDX-License-Identifier: MIT
#include <shaders/rays.h>

#include "tests/observed/world.h"

namespace {

using namespace rtapi;
using testing::HasSubstr;

class Rays : public kaamos::observed::World {
 protected:
  StateObjectDesc describe(const std::string& intersection, const std::string& closest_hit,
                           const std::string& any_hit = {}) {
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_rays()).value()});
    desc.Add(RaytracingShaderConfig{4, 12});
    desc.Add(RaytracingPipelineConfig{1});
    desc.Add(GlobalRootSignature{root_});
    desc.Add(HitGroupDesc{.HitGroupExport = "Group",
                          .Type = HitGroupType::kProceduralPrimitive,
                          .AnyHitShaderImport = any_hit,
                          .ClosestHitShaderImport = closest_hit,
                          .IntersectionShaderImport = intersection});
    return desc;
  }
  // The first 32 words after a dispatch of 8 rays up to `t_max`.
  std::vector<uint32_t> trace(const StateObject& pipeline, const char* ray_generation,
                              float t_max) {
    out_ = zeros(1024, "out");
    constants_[0] = static_cast<uint32_t>(2 * t_max);
    const Tables tables = tables_of(pipeline, ray_generation, "Group");
    CommandList list = device_.CreateCommandList().value();
    bind(list);
    list.SetPipelineState1(pipeline);
    list.DispatchRays(tables.desc(8));
    queue_.ExecuteAndWait(list).value();
    auto words = read(out_);
    words.resize(32);
    return words;
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, Rays, testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

// 32 boxes in 8 columns. However the tree groups them, a shader runs for those on the ray, up to
// TMax.
TEST_P(Rays, OnlyBoxesThatARayMeetsRunTheirShader) {
  using Flags = RaytracingAccelerationStructureBuildFlags;
  std::vector<RaytracingAabb> grid;
  for (int i = 0; i < 32; ++i) {
    const float x = 3 * static_cast<float>(i % 8), z = 4 * static_cast<float>(i / 8);
    grid.push_back({x + 0.5f, -0.5f, z + 1, x + 1.5f, 0.5f, z + 2});
  }
  const StateObject pipeline = device_.CreateStateObject(describe("Note", "OfMine")).value();
  for (const Flags flags : {Flags::kNone, Flags::kAllowUpdate, Flags::kPreferFastBuild}) {
    scene_ = boxes(grid, flags);
    for (const char* shader : {"Trace", "Query"}) {
      for (uint32_t rows = 0; rows <= 4; ++rows) {
        // Between two rows; 0: before all boxes.
        const auto words = trace(pipeline, shader, 4 * static_cast<float>(rows) + 0.5f);
        for (uint32_t column = 0; column < 8; ++column) {
          uint32_t expected = 0;
          for (uint32_t row = 0; row < rows; ++row) expected |= 1u << (8 * row + column);
          EXPECT_EQ(words[column], expected) << shader << ", column " << column;
        }
      }
    }
  }
}

TEST_P(Rays, AClosestHitShaderOfTrianglesServesBoxesIfItReadsNoAttributes) {
  scene_ = boxes({{0.5f, -0.5f, 1, 1.5f, 0.5f, 2}, {3.5f, -0.5f, 3, 4.5f, 0.5f, 4}});
  messages_.clear();
  const auto pipeline = device_.CreateStateObject(describe("Report", "OfTriangles"));
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Severity, MessageSeverity::kWarning);
  EXPECT_EQ(messages_[0].Id.text(), "KA0553");
  EXPECT_THAT(messages_[0].Text, HasSubstr("\"OfTriangles\" declares 8"));
  EXPECT_THAT(messages_[0].Text, HasSubstr("\"Report\" has 12"));
  auto words = trace(*pipeline, "Trace", 10);
  const std::vector<uint32_t> seen(words.begin() + 16, words.begin() + 24);
  EXPECT_EQ(seen, (std::vector<uint32_t>{103, 103, 7, 7, 7, 7, 7, 7}));

  messages_.clear();
  const auto mine = device_.CreateStateObject(describe("Report", "OfMine"));
  ASSERT_TRUE(mine) << mine.error().message;
  EXPECT_TRUE(messages_.empty());
  words = trace(*mine, "Trace", 10);
  EXPECT_EQ(words[16], 220u);
  EXPECT_EQ(words[17], 221u);

  const auto any = device_.CreateStateObject(describe("Report", "OfMine", "AnyOfTriangles"));
  ASSERT_TRUE(any) << any.error().message;
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_THAT(messages_[0].Text, HasSubstr("\"AnyOfTriangles\" declares 8"));
}

TEST_P(Rays, AttributesThatAreReadMustBeThoseThatAreReported) {
  const auto pipeline = device_.CreateStateObject(describe("Report", "ReadingTriangles"));
  ASSERT_FALSE(pipeline);
  EXPECT_EQ(pipeline.error().id.text(), "KA0524");
  EXPECT_THAT(pipeline.error().message, HasSubstr("\"ReadingTriangles\""));
  EXPECT_TRUE(messages_.empty());
}

}  // namespace
