// SPDX-License-Identifier: MIT
#include "runtime/embree/acceleration_structure.h"

#include <gtest/gtest.h>
#include <rtapi/error_ids.h>

#include <random>

#include "runtime/embree/testing/harness.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/serialized_structure.h"

namespace kaamos::embree {
namespace {

using testing::End;
using testing::GeometryInput;
using testing::Harness;
using testing::instance_of;
using testing::is_distance;
using testing::ray_along_z;
using testing::triangle_at;
using Flags = rtapi::RaytracingAccelerationStructureBuildFlags;
using InfoType = rtapi::RaytracingAccelerationStructurePostbuildInfoType;
using CopyMode = rtapi::RaytracingAccelerationStructureCopyMode;

// t of the hit at the centre of one instance; negative for a miss.
float depth_of(Harness& h, uint64_t bottom_level) {
  const auto payload = h.trace(ray_along_z(h.top_level({instance_of(bottom_level)})));
  return payload.end == End::kClosestHit ? payload.values.t_current : -1;
}

TEST(As03And04, InputsMayGoOnceTheBuildHasRun) {
  Harness h;
  h.use_standard_pipeline();
  for (const Flags flags : {Flags::kNone, Flags::kMinimizeMemory, Flags::kPreferFastBuild,
                            Flags::kAllowUpdate | Flags::kPreferFastTrace}) {
    const auto command = h.bottom_level_command({triangle_at(3)}, flags);
    ASSERT_TRUE(h.execute(command).ok());
    std::memset(reinterpret_cast<void*>(command.geometries[0].Triangles.VertexBuffer.StartAddress),
                0xFF, 36);
    EXPECT_TRUE(is_distance(depth_of(h, command.dest), 3.0f));
  }
}

TEST(As02, InstancesAsArrayOrThroughPointers) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t level = h.bottom_level({triangle_at(3)});
  std::vector<uint64_t> pointers;
  for (uint32_t i = 0; i < 3; ++i) {
    auto instance = instance_of(i == 1 ? level : 0);
    instance.InstanceID = 70 + i;
    pointers.push_back(h.upload(std::vector{instance}));
  }
  auto command = h.top_level_command(std::vector<rtapi::RaytracingInstanceDesc>(3));
  command.instance_layout = rtapi::ElementsLayout::kArrayOfPointers;
  command.instance_descs = h.upload(pointers);
  ASSERT_TRUE(h.execute(command).ok());
  const auto payload = h.trace(ray_along_z(command.dest));
  EXPECT_EQ(payload.values.instance_index, 1u);
  EXPECT_EQ(payload.values.instance_id, 71u);
  pointers[2] = 0x1000;
  command.instance_descs = h.upload(pointers);
  const auto status = h.execute(command);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0796");
}

TEST(As30, ALaterBuildOverAnyPartEndsAStructure) {
  Harness h;
  h.use_standard_pipeline();
  auto block = h.buffer(1 << 16);
  auto command = h.bottom_level_command({triangle_at(3)});
  command.dest = block->address();
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(depth_of(h, block->address()), 3.0f));
  command.dest = block->address() + 256;
  ASSERT_TRUE(h.execute(command).ok());
  h.messages.clear();
  EXPECT_EQ(depth_of(h, block->address()), -1.0f);
  ASSERT_FALSE(h.messages.empty());
  EXPECT_EQ(h.messages[0].Id.text(), "KA0797");
  EXPECT_TRUE(is_distance(depth_of(h, block->address() + 256), 3.0f));
}

TEST(As29, WritingOverItsBytesEndsAStructure) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t level = h.bottom_level({triangle_at(3)});
  const uint64_t scene = h.top_level({instance_of(level)});
  std::memset(reinterpret_cast<void*>(scene), 0, 16);
  EXPECT_EQ(h.trace(ray_along_z(scene)).end, End::kMiss);
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0894");
  // A top level keeps alive what it refers to, so nothing dangles.
  const uint64_t other = h.top_level({instance_of(level)});
  std::memset(reinterpret_cast<void*>(level), 0, 16);
  EXPECT_EQ(h.trace(ray_along_z(other)).end, End::kClosestHit);
}

TEST(As29, FreeingTheBufferEndsAStructure) {
  Harness h;
  h.use_standard_pipeline();
  auto command = h.bottom_level_command({triangle_at(3)});
  auto block = h.buffer(1 << 21);
  command.dest = block->address();
  ASSERT_TRUE(h.execute(command).ok());
  h.free(block);
  EXPECT_EQ(depth_of(h, command.dest), -1.0f);
}

TEST(As55, AnUpdateInPlaceMovesTheGeometry) {
  Harness h;
  h.use_standard_pipeline();
  for (const Flags flags : {Flags::kAllowUpdate, Flags::kAllowUpdate | Flags::kPreferFastBuild,
                            Flags::kAllowUpdate | Flags::kMinimizeMemory}) {
    auto command = h.bottom_level_command({triangle_at(3), triangle_at(9)}, flags);
    ASSERT_TRUE(h.execute(command).ok());
    command.flags = flags | Flags::kPerformUpdate;
    command.source = command.dest;
    for (const float z : {5.0f, 4.0f, 2.0f, 8.0f}) {
      command.geometries[0] = h.geometry(triangle_at(z));
      ASSERT_TRUE(h.execute(command).ok());
      EXPECT_TRUE(is_distance(depth_of(h, command.dest), z));
    }
  }
}

TEST(As55, AnUpdateElsewhereLeavesTheSourceAsItWas) {
  Harness h;
  h.use_standard_pipeline();
  auto indexed = triangle_at(3);
  indexed.indices = {0, 1, 2};
  auto command = h.bottom_level_command({indexed}, Flags::kAllowUpdate);
  ASSERT_TRUE(h.execute(command).ok());
  command.source = command.dest;
  command.dest = h.buffer(1 << 16)->address();
  command.flags = Flags::kAllowUpdate | Flags::kPerformUpdate;
  indexed = triangle_at(6);
  indexed.indices = {2, 2, 2};  // an update does not read the indices again
  command.geometries = {h.geometry(indexed)};
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(depth_of(h, command.source), 3.0f));
  EXPECT_TRUE(is_distance(depth_of(h, command.dest), 6.0f));
}

TEST(As57And61, ManyUpdatesOfBoxesAndTriangles) {
  Harness h;
  h.use_standard_pipeline(nullptr, testing::report_all);
  auto boxes = h.bottom_level_command({testing::box_at(3)}, Flags::kAllowUpdate);
  auto triangles = h.bottom_level_command({triangle_at(3)}, Flags::kAllowUpdate);
  ASSERT_TRUE(h.execute(boxes).ok());
  ASSERT_TRUE(h.execute(triangles).ok());
  for (auto* command : {&boxes, &triangles}) {
    command->flags = command->flags | Flags::kPerformUpdate;
    command->source = command->dest;
  }
  const auto box = h.buffer(24);
  const auto vertices = h.buffer(36);
  boxes.geometries[0].AABBs.AABBs.StartAddress = box->address();
  triangles.geometries[0].Triangles.VertexBuffer.StartAddress = vertices->address();
  for (int i = 0; i < 200; ++i) {
    const float z = 1 + 0.1f * static_cast<float>((i * 37) % 200);
    std::memcpy(box->host(), testing::box_at(z).boxes.data(), 24);
    std::memcpy(vertices->host(), triangle_at(z).vertices.data(), 36);
    ASSERT_TRUE(h.execute(boxes).ok());
    ASSERT_TRUE(h.execute(triangles).ok());
  }
  const float last = 1 + 0.1f * static_cast<float>((199 * 37) % 200);
  EXPECT_TRUE(is_distance(depth_of(h, triangles.dest), last));
  testing::report_log() = {};
  testing::report_log().reports = {{last, 1, {}}};
  EXPECT_EQ(depth_of(h, boxes.dest), last);
}

TEST(As60To62, AnUpdateThatChangesMoreIsAnError) {
  Harness h;
  const auto update = [&](Flags built, Flags flags, auto change) {
    auto command = h.bottom_level_command({triangle_at(3)}, built);
    EXPECT_TRUE(h.execute(command).ok());
    command.flags = flags | Flags::kPerformUpdate;
    command.source = command.dest;
    change(command);
    return h.execute(command);
  };
  const auto nothing = [](auto&) {};
  EXPECT_TRUE(update(Flags::kAllowUpdate, Flags::kAllowUpdate, nothing).ok());
  EXPECT_FALSE(update(Flags::kNone, Flags::kAllowUpdate, nothing).ok());
  EXPECT_FALSE(
      update(Flags::kAllowUpdate, Flags::kAllowUpdate | Flags::kPreferFastTrace, nothing).ok());
  const auto fails = [&](auto change) {
    const auto status = update(Flags::kAllowUpdate, Flags::kAllowUpdate, change);
    return !status.ok() && status.error().id == rtapi::error_ids::backend::kUpdate;
  };
  EXPECT_TRUE(fails([](auto& c) { c.geometries[0].Triangles.VertexCount = 2; }));
  EXPECT_TRUE(fails([](auto& c) { c.geometries[0].Flags = testing::kNonOpaque; }));
  EXPECT_TRUE(fails([](auto& c) { c.geometries.push_back(c.geometries[0]); }));
  EXPECT_TRUE(fails([&](auto& c) {
    c.geometries[0].Triangles.Transform3x4 =
        h.upload(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  }));
  EXPECT_TRUE(fails([&](auto& c) { c.geometries[0] = h.geometry(testing::box_at(3)); }));
  EXPECT_TRUE(fails([&](auto& c) { c.source = h.buffer(256)->address(); }));
}

TEST(As64And65, ATopLevelUpdateRedefinesEverything) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t near_level = h.bottom_level({triangle_at(3)});
  const uint64_t far_level = h.bottom_level({triangle_at(7)});
  auto command = h.top_level_command({instance_of(0), instance_of(far_level)});
  command.flags = Flags::kAllowUpdate;
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(h.trace(ray_along_z(command.dest)).values.t_current, 7.0f));
  command.source = command.dest;
  command.flags = command.flags | Flags::kPerformUpdate;
  command.instance_descs = h.upload(std::vector{instance_of(near_level), instance_of(0)});
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(h.trace(ray_along_z(command.dest)).values.t_current, 3.0f));
  command.instance_count = 1;
  EXPECT_FALSE(h.execute(command).ok());
}

uint64_t info_of(Harness& h, uint64_t structure, InfoType type) {
  const auto out = h.buffer(16);
  runtime::EmitPostbuildInfoCommand command;
  command.desc = {out->address(), type};
  command.sources = {structure};
  EXPECT_TRUE(h.execute(command).ok());
  uint64_t value;
  std::memcpy(&value, out->host(), sizeof(value));
  return value;
}

TEST(As43And44And71And72, ClonesAndCompaction) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput many;
  many.flags = testing::kOpaque;
  for (int i = 0; i < 5000; ++i) {
    for (const auto& v : triangle_at(3 + 0.001f * static_cast<float>(i)).vertices) {
      many.vertices.push_back(v);
    }
  }
  auto command = h.bottom_level_command({many}, Flags::kAllowCompaction | Flags::kAllowUpdate);
  const auto out = h.buffer(8);
  command.postbuild_infos = {{out->address(), InfoType::kCompactedSize}};
  ASSERT_TRUE(h.execute(command).ok());
  uint64_t compacted;
  std::memcpy(&compacted, out->host(), sizeof(compacted));
  const uint64_t current = info_of(h, command.dest, InfoType::kCurrentSize);
  EXPECT_EQ(compacted, info_of(h, command.dest, InfoType::kCompactedSize));  // AS-26
  EXPECT_LE(compacted, current);
  EXPECT_GT(compacted, 5000u * 36);

  runtime::CopyAccelerationStructureCommand copy;
  copy.source = command.dest;
  copy.dest = h.buffer(compacted)->address();
  copy.mode = CopyMode::kCompact;
  ASSERT_TRUE(h.execute(copy).ok());
  EXPECT_EQ(info_of(h, copy.dest, InfoType::kCurrentSize), compacted);
  EXPECT_TRUE(is_distance(depth_of(h, copy.dest), 3.0f));

  // After an update in place the source has moved and the copy has not; then the copy outlives the
  // source.
  for (auto& v : many.vertices) v.z += 10;
  command.geometries = {h.geometry(many)};
  command.flags = command.flags | Flags::kPerformUpdate;
  command.source = command.dest;
  command.postbuild_infos.clear();
  ASSERT_TRUE(h.execute(command).ok());
  EXPECT_TRUE(is_distance(depth_of(h, command.dest), 13.0f));
  EXPECT_TRUE(is_distance(depth_of(h, copy.dest), 3.0f));
  std::memset(reinterpret_cast<void*>(command.dest), 0, 16);
  EXPECT_TRUE(is_distance(depth_of(h, copy.dest), 3.0f));

  copy.mode = CopyMode::kClone;
  copy.source = copy.dest;
  copy.dest = h.buffer(compacted)->address();
  ASSERT_TRUE(h.execute(copy).ok());
  EXPECT_TRUE(is_distance(depth_of(h, copy.dest), 3.0f));
}

TEST(As72, CompactionNeedsItsFlag) {
  Harness h;
  runtime::CopyAccelerationStructureCommand copy;
  copy.source = h.bottom_level({triangle_at(3)});
  copy.dest = h.buffer(4096)->address();
  copy.mode = CopyMode::kCompact;
  EXPECT_FALSE(h.execute(copy).ok());
  copy.mode = CopyMode::kClone;
  copy.source = h.buffer(4096)->address();
  EXPECT_FALSE(h.execute(copy).ok());
}

void add_triangle(GeometryInput& input, float z, float x) {
  for (auto vertex : triangle_at(z).vertices) {
    vertex.x += x;
    input.vertices.push_back(vertex);
  }
}

TEST(As73And74, DeserializedStructuresTraceAndUpdateAlike) {
  Harness h;
  h.use_standard_pipeline();
  for (const Flags flags : {Flags::kNone, Flags::kAllowUpdate, Flags::kPreferFastBuild}) {
    GeometryInput input = triangle_at(3);
    add_triangle(input, 5, 10);
    input.indices = {3, 4, 5, 0, 1, 2};
    const auto command = h.bottom_level_command({input, GeometryInput{}}, flags);
    ASSERT_TRUE(h.execute(command).ok());
    const auto bytes = h.buffer(info_of(h, command.dest, InfoType::kSerialization));
    runtime::CopyAccelerationStructureCommand copy;
    copy.source = command.dest;
    copy.dest = bytes->address();
    copy.mode = CopyMode::kSerialize;
    ASSERT_TRUE(h.execute(copy).ok());
    copy.source = copy.dest;
    copy.dest = h.buffer(1 << 16)->address();
    copy.mode = CopyMode::kDeserialize;
    ASSERT_TRUE(h.execute(copy).ok());
    EXPECT_TRUE(is_distance(depth_of(h, copy.dest), 3.0f));
    EXPECT_EQ(info_of(h, copy.dest, InfoType::kCurrentSize),
              info_of(h, command.dest, InfoType::kCurrentSize));
    if (flags != Flags::kAllowUpdate) continue;
    auto moved = input;
    for (auto& vertex : moved.vertices) vertex.z += 4;
    auto update = h.bottom_level_command({moved, GeometryInput{}}, flags | Flags::kPerformUpdate);
    update.source = update.dest = copy.dest;
    ASSERT_TRUE(h.execute(update).ok());
    EXPECT_TRUE(is_distance(depth_of(h, copy.dest), 7.0f));
    EXPECT_TRUE(is_distance(depth_of(h, command.dest), 3.0f));
  }
}

TEST(As32, ATopLevelMayComeBeforeItsBottomLevels) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t level = h.bottom_level({triangle_at(3)});
  const uint64_t top = h.top_level({instance_of(0), instance_of(level)});
  const auto save = [&](uint64_t source) {
    runtime::CopyAccelerationStructureCommand copy;
    copy.source = source;
    copy.dest = h.buffer(4096)->address();
    copy.mode = CopyMode::kSerialize;
    EXPECT_TRUE(h.execute(copy).ok());
    return copy.dest;
  };
  const uint64_t level_bytes = save(level);
  const uint64_t top_bytes = save(top);
  runtime::CopyAccelerationStructureCommand copy;
  copy.mode = CopyMode::kDeserialize;
  copy.source = top_bytes;
  const uint64_t new_level = h.buffer(1 << 16)->address();
  const uint64_t new_top = h.buffer(1 << 16)->address();
  std::memcpy(h.addresses().host(top_bytes) + 64, &new_level, 8);
  copy.dest = new_top;
  ASSERT_TRUE(h.execute(copy).ok());
  EXPECT_TRUE(h.messages.empty());
  EXPECT_EQ(h.trace(ray_along_z(new_top)).end, End::kMiss);
  EXPECT_EQ(h.trace(ray_along_z(new_top)).end, End::kMiss);
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0797");
  copy.source = level_bytes;
  copy.dest = new_level;
  ASSERT_TRUE(h.execute(copy).ok());
  const auto payload = h.trace(ray_along_z(new_top));
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.values.instance_index, 1u);
  const uint64_t nowhere = 0x1000;
  std::memcpy(h.addresses().host(top_bytes) + 64, &nowhere, 8);
  copy.source = top_bytes;
  copy.dest = new_top;
  const auto status = h.execute(copy);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0789");
  EXPECT_NE(status.error().message.find("instance 1"), std::string::npos);
}

TEST(As73, TooSmallADestinationIsAnError) {
  Harness h;
  runtime::CopyAccelerationStructureCommand copy;
  copy.source = h.bottom_level({triangle_at(3)});
  copy.dest = h.buffer(64)->address();
  for (const CopyMode mode : {CopyMode::kSerialize, CopyMode::kVisualizationDecodeForTools}) {
    copy.mode = mode;
    const auto status = h.execute(copy);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().id.text(), "KA0795");
  }
}

// Whatever passes the format checks gets built, whatever its numbers are; the rest is an error.
TEST(As74, SealedDamageIsAnErrorOrBuilds) {
  Harness h;
  h.use_standard_pipeline();
  std::mt19937 random(9);
  GeometryInput input = triangle_at(3);
  add_triangle(input, 5, 10);
  input.indices = {0, 1, 2, 3, 4, 5};
  const uint64_t level = h.bottom_level({input, triangle_at(4)});
  const uint64_t boxes = h.bottom_level({testing::box_at(4)});
  const uint64_t top = h.top_level({instance_of(level), instance_of(0), instance_of(boxes)});
  const auto dest = h.buffer(65536);
  uint32_t built = 0;
  for (const uint64_t source : {level, boxes, top}) {
    runtime::CopyAccelerationStructureCommand copy;
    const auto saved = h.buffer(8192);
    copy.source = source;
    copy.dest = saved->address();
    copy.mode = CopyMode::kSerialize;
    ASSERT_TRUE(h.execute(copy));
    rtapi::SerializedRaytracingAccelerationStructureHeader header;
    std::memcpy(&header, saved->host(), sizeof(header));
    const auto size = static_cast<size_t>(header.SerializedSizeInBytesIncludingHeader);
    const std::vector<uint8_t> bytes(saved->host(), saved->host() + size);
    copy.source = saved->address();
    copy.dest = dest->address();
    copy.mode = CopyMode::kDeserialize;
    for (int round = 0; round < 200; ++round) {
      std::memcpy(saved->host(), bytes.data(), size);
      for (uint32_t n = round == 0 ? 0 : 1 + random() % 3; n > 0; --n) {
        saved->host()[56 + random() % (size - 56)] ^= static_cast<uint8_t>(1u << random() % 8);
      }
      runtime::seal_serialized(std::span(saved->host(), size));
      const auto status = h.execute(copy);
      if (!status) {
        EXPECT_EQ(status.error().id.text().substr(0, 4), "KA07") << status.error().message;
        continue;
      }
      ++built;
      const uint64_t scene = source == top ? copy.dest : h.top_level({instance_of(copy.dest)});
      h.trace(ray_along_z(scene));
    }
  }
  EXPECT_GT(built, 100u);
}

TEST(As41, SizesGrowWithEveryCount) {
  Harness h;
  const auto size = [&](uint32_t vertices, uint32_t indices, size_t geometries, Flags flags) {
    rtapi::RaytracingGeometryDesc desc;
    desc.Triangles.VertexCount = vertices;
    desc.Triangles.IndexCount = indices;
    desc.Triangles.IndexFormat = indices != 0 ? rtapi::Format::kR32Uint : rtapi::Format::kUnknown;
    runtime::BuildCommand inputs;
    inputs.type = rtapi::RaytracingAccelerationStructureType::kBottomLevel;
    inputs.flags = flags;
    inputs.geometries.assign(geometries, desc);
    return h.device().prebuild_info(inputs).ResultDataMaxSizeInBytes;
  };
  for (const Flags flags : {Flags::kNone, Flags::kAllowUpdate, Flags::kMinimizeMemory}) {
    EXPECT_LE(size(100, 300, 1, flags), size(200, 300, 1, flags));
    EXPECT_LT(size(100, 300, 1, flags), size(100, 600, 1, flags));
    EXPECT_LT(size(100, 300, 1, flags), size(100, 300, 2, flags));
    EXPECT_EQ(size(100, 300, 1, flags) % 256, 0u);
  }
}

TEST(Build, TooSmallADestinationIsAnError) {
  Harness h;
  auto command = h.bottom_level_command({triangle_at(3)});
  command.dest = h.buffer(16)->address();
  const auto status = h.execute(command);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0795");
}

TEST(TopLevel, UnusableInstancesAreInactiveWithAMessage) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t level = h.bottom_level({triangle_at(3)});
  auto flat = instance_of(level);
  flat.Transform[2][2] = 0;
  auto lost = instance_of(h.buffer(64)->address());
  const auto payload = h.trace(ray_along_z(h.top_level({flat, lost, instance_of(level)})));
  EXPECT_EQ(payload.values.instance_index, 2u);
  ASSERT_EQ(h.messages.size(), 2u);
  EXPECT_NE(h.messages[0].Text.find("instance 0"), std::string::npos);
  EXPECT_NE(h.messages[0].Text.find("singular"), std::string::npos);
}

TEST(InvertTransform, RoundTrips) {
  const float matrix[12] = {1, 2, 0, 5, 0, 1, -3, 6, 4, 0, 1, -7};
  float inverse[12];
  float back[12];
  ASSERT_TRUE(runtime::invert_transform(matrix, inverse));
  ASSERT_TRUE(runtime::invert_transform(inverse, back));
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(matrix[i], back[i], 1e-5);
  const float singular[12] = {1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0};
  EXPECT_FALSE(runtime::invert_transform(singular, inverse));
}

}  // namespace
}  // namespace kaamos::embree
