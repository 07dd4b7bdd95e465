// SPDX-License-Identifier: MIT
//
// Opacity micromaps that rays meet against the rules, or that are not what they were.
#include "tests/checks/world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;

class Micromaps : public World {
 protected:
  DeviceDesc device_desc() const override {
    DeviceDesc desc;
    desc.ShaderModel = kExperimentalShaderModel;  // of queries.hlsl
    return desc;
  }
  void SetUp() override {
    World::SetUp();
    if (IsSkipped()) return;
    build_scene();
    array_.NumOmmHistogramEntries = 1;
    array_.pOmmHistogram = &one_;
    array_.InputBuffer = upload(std::vector<uint32_t>(64), "states").GetGPUVirtualAddress();
    const std::vector<RaytracingOpacityMicromapDesc> descs = {{0, 0, 2}};
    array_.PerOmmDescs = {upload(descs, "descs").GetGPUVirtualAddress(), 8};
    inputs_.Type = RaytracingAccelerationStructureType::kOpacityMicromapArray;
    inputs_.NumDescs = 1;
    inputs_.pOpacityMicromapArrayDesc = &array_;
    micromaps_ = build(inputs_, "micromaps");
    linkage_.OpacityMicromapArray = micromaps_.GetGPUVirtualAddress();
  }
  // A top level with an instance of a linked triangle.
  void build_linked(BuildFlags flags, uint32_t instance_flags) {
    geometries_ = triangles();
    triangles_ = geometries_[0].Triangles;
    geometries_[0].Type = RaytracingGeometryType::kOmmTriangles;
    geometries_[0].OmmTriangles = {&triangles_, &linkage_};
    const Buffer bottom = build(bottom_inputs(geometries_, flags), "leaves");
    RaytracingInstanceDesc desc = instance(bottom);
    desc.Flags = instance_flags;
    top_ = build(top_inputs({desc}), "scene");
  }

  RaytracingOpacityMicromapHistogramEntry one_ = {1, 0,
                                                  RaytracingOpacityMicromapFormat::kOc1_4State};
  RaytracingOpacityMicromapArrayDesc array_;
  BuildRaytracingAccelerationStructureInputs inputs_;
  Buffer micromaps_;
  RaytracingGeometryOmmLinkageDesc linkage_;
  RaytracingGeometryTrianglesDesc triangles_;
  std::vector<RaytracingGeometryDesc> geometries_;
};

TEST_P(Micromaps, WithoutThePipelinesPermission) {
  build_linked(BuildFlags::kNone, 0);
  dispatch(make_tables(pipeline_).desc);
  expect_one("KA0493", {"geometry 0", "\"leaves\"", "kAllowOpacityMicromaps"});
}

TEST_P(Micromaps, WithoutTheQuerysPermission) {
  build_linked(BuildFlags::kAllowDisableOmms, 0);
  query("Plain");
  expect_one("KA0493", {"\"Plain\"", "queries.hlsl:", "geometry 0", "\"leaves\"",
                        "RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS"});
  query("AllowsClusters");
  expect_one("KA0493", {"\"AllowsClusters\"", "\"leaves\""});
  query("AllowsMicromaps");
  expect_none();
  build_linked(BuildFlags::kAllowDisableOmms, 0x20);
  query("Plain");
  expect_none();
}

TEST_P(Micromaps, DisabledWithoutTheBottomLevelsPermission) {
  build_linked(BuildFlags::kAllowDisableOmms, 0x20);
  dispatch(make_tables(pipeline_).desc);
  expect_none();
  build_linked(BuildFlags::kNone, 0x20);
  dispatch(make_tables(pipeline_).desc);
  expect_one("KA0494", {"instance 0", "\"leaves\"", "kAllowDisableOmms"});
}

TEST_P(Micromaps, ReplacedAfterTheyWereLinked) {
  build_linked(BuildFlags::kAllowDisableOmms, 0x20);
  CommandList again = list();
  record_build(again, micromaps_, inputs_);
  ASSERT_TRUE(execute(again).ok());
  dispatch(make_tables(pipeline_).desc);
  expect_one("KA0495", {"\"leaves\"", "\"micromaps\"", "another one has been built there"});
}

INSTANTIATE_TEST_SUITE_P(Embree, Micromaps, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Micromaps, ::testing::Values("vulkan"));

}  // namespace
}  // namespace kaamos::checks::test
