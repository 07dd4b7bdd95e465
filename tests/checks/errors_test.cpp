// SPDX-License-Identifier: MIT
//
// Errors that only show when a command executes, in any mode: they end the list with their text.
#include <cstring>

#include "tests/checks/world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;
using CopyMode = RaytracingAccelerationStructureCopyMode;

class Errors : public World {
 protected:
  void expect_error(CommandList& commands, const std::string& id,
                    const std::vector<std::string>& parts) {
    const Status status = execute(commands);
    ASSERT_FALSE(status.ok());
    const std::string text = status.error().message;
    EXPECT_EQ(status.error().id.text(), id) << text;
    EXPECT_EQ(text.substr(0, id.size()), id) << text;
    for (const std::string& part : parts) {
      EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in: " << text;
    }
  }
  // Large enough for any structure here.
  Buffer copy_of(const Buffer& source, const std::string& name) {
    return buffer(source.size(), name, true);
  }
};

TEST_P(Errors, UpdateOfAnotherShape) {
  const Buffer level = build(bottom_inputs(triangles(), BuildFlags::kAllowUpdate), "floor");
  CommandList commands = list();
  record_build(commands, level,
               bottom_inputs(triangles(2), BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate),
               level.GetGPUVirtualAddress());
  expect_error(commands, "KA0793", {"there are 2 geometries", "was built with 1"});
}

TEST_P(Errors, UpdateOfAStructureThatDoesNotAllowIt) {
  const Buffer level = build(bottom_inputs(triangles()), "floor");
  CommandList commands = list();
  record_build(commands, level,
               bottom_inputs(triangles(), BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate),
               level.GetGPUVirtualAddress());
  expect_error(commands, "KA0793",
               {"the structure at byte 0 of buffer \"floor\" (", "was built without ALLOW_UPDATE"});
}

TEST_P(Errors, CompactionOfAStructureThatDoesNotAllowIt) {
  const Buffer level = build(bottom_inputs(triangles()), "floor");
  CommandList commands = list();
  commands.CopyRaytracingAccelerationStructure(copy_of(level, "compact").GetGPUVirtualAddress(),
                                               level.GetGPUVirtualAddress(), CopyMode::kCompact);
  expect_error(commands, "KA0796",
               {"at byte 0 of buffer \"floor\" (", "was built without ALLOW_COMPACTION"});
}

TEST_P(Errors, CopyIntoTooLittleMemory) {
  const Buffer level = build(bottom_inputs(triangles()), "floor");
  CommandList commands = list();
  commands.CopyRaytracingAccelerationStructure(buffer(256, "small", true).GetGPUVirtualAddress(),
                                               level.GetGPUVirtualAddress(), CopyMode::kClone);
  expect_error(commands, "KA0795",
               {"an acceleration structure needs", "at byte 0 of buffer \"small\" (256 bytes)",
                "has 256 from there on"});
}

TEST_P(Errors, CopyOverItsSource) {
  const Buffer level = build(bottom_inputs(triangles()), "floor");
  const Buffer both = buffer(level.size() + 256, "both", true);
  CommandList commands = list();
  commands.CopyRaytracingAccelerationStructure(both.GetGPUVirtualAddress(),
                                               level.GetGPUVirtualAddress(), CopyMode::kClone);
  commands.ResourceBarrier(ResourceBarrier::Uav(both));
  commands.CopyRaytracingAccelerationStructure(both.GetGPUVirtualAddress() + 256,
                                               both.GetGPUVirtualAddress(), CopyMode::kClone);
  expect_error(commands, "KA0796",
               {"at byte 0 of buffer \"both\"", "overlaps its copy at byte 256 of buffer \"both\"",
                "Copy into other memory"});
}

INSTANTIATE_TEST_SUITE_P(Embree, Errors, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Errors, ::testing::Values("vulkan"));

}  // namespace
}  // namespace kaamos::checks::test
