// SPDX-License-Identifier: MIT
//
// Inactive and degenerate primitives, and updates that make them active or inactive.
#include <algorithm>
#include <limits>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A bottom level that can be updated, in one instance.
class Updatable {
 public:
  Updatable(Context& t, const Geometry& geometry) : context_(&t) {
    inputs_.Type = RaytracingAccelerationStructureType::kBottomLevel;
    inputs_.Flags = RaytracingAccelerationStructureBuildFlags::kAllowUpdate;
    inputs_.NumDescs = 1;
    take(geometry);
    bottom_level_ = t.build(inputs_);
  }

  Buffer scene() { return context_->top_level({instance(bottom_level_)}); }

  void update(const Geometry& geometry) {
    Context& t = *context_;
    take(geometry);
    const auto sizes = t.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs_).value();
    BuildRaytracingAccelerationStructureDesc build;
    build.Inputs = inputs_;
    build.Inputs.Flags = static_cast<RaytracingAccelerationStructureBuildFlags>(
        static_cast<uint32_t>(inputs_.Flags) |
        static_cast<uint32_t>(RaytracingAccelerationStructureBuildFlags::kPerformUpdate));
    build.DestAccelerationStructureData = bottom_level_.GetGPUVirtualAddress();
    build.SourceAccelerationStructureData = bottom_level_.GetGPUVirtualAddress();
    build.ScratchAccelerationStructureData =
        t.zeros(std::max<uint64_t>(sizes.UpdateScratchDataSizeInBytes, 256)).GetGPUVirtualAddress();
    CommandList list = t.device().CreateCommandList().value();
    list.BuildRaytracingAccelerationStructure(build);
    t.queue().ExecuteAndWait(list).value();
  }

 private:
  void take(const Geometry& geometry) {
    desc_ = {};
    desc_.Flags = geometry.flags;
    if (geometry.boxes.empty()) {
      desc_.Triangles.VertexFormat = Format::kR32G32B32Float;
      desc_.Triangles.VertexCount = static_cast<uint32_t>(geometry.vertices.size() / 3);
      desc_.Triangles.VertexBuffer = {context_->upload(geometry.vertices).GetGPUVirtualAddress(),
                                      12};
    } else {
      desc_.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
      desc_.AABBs.AABBCount = geometry.boxes.size();
      desc_.AABBs.AABBs = {context_->upload(geometry.boxes).GetGPUVirtualAddress(), 24};
    }
    inputs_.pGeometryDescs = &desc_;
  }

  Context* context_;
  RaytracingGeometryDesc desc_ = {};
  BuildRaytracingAccelerationStructureInputs inputs_;
  Buffer bottom_level_;
};

Geometry side_by_side(std::initializer_list<Geometry> all) {
  Geometry out;
  for (const Geometry& each : all) {
    out.vertices.insert(out.vertices.end(), each.vertices.begin(), each.vertices.end());
    out.boxes.insert(out.boxes.end(), each.boxes.begin(), each.boxes.end());
  }
  return out;
}

Geometry collapsed(Geometry triangle) {
  for (size_t i = 3; i < 9; ++i) triangle.vertices[i] = triangle.vertices[i % 3];
  return triangle;
}

// DXR leaves this open; here such a triangle or box is inactive too.
void a_nan_beside_x(Context& t) {
  Standard program(t);
  program.record("Plain");
  Geometry geometry;
  for (size_t i = 0; i < 7; ++i) {
    Geometry one = triangle(5, 10.0f * static_cast<float>(i));
    if (i < 6) one.vertices[3 * (i % 3) + 1 + i / 3] = kNan;
    geometry = side_by_side({geometry, one});
  }
  program.scene = t.scene({geometry});
  std::vector<Ray> rays;
  for (int i = 0; i < 7; ++i) rays.push_back(ray_at(10.0f * static_cast<float>(i)));
  const auto seen = program.trace(rays);
  for (size_t i = 0; i < 6; ++i) t.equal("end at such a triangle", seen[i].end, kMissRan);
  t.equal("PrimitiveIndex() of the other", seen[6].primitive, 6u);
  t.equal("end at the other", seen[6].end, kClosestHitRan);

  Standard boxes(t);
  boxes.record("Box");
  Geometry with_nan;
  for (size_t i = 0; i < 6; ++i) {
    RaytracingAabb one = box(5, 10.0f * static_cast<float>(i)).boxes[0];
    if (i < 5) (&one.MinX)[i + 1] = kNan;
    with_nan.boxes.push_back(one);
  }
  rays.resize(6);
  boxes.scene = t.scene({with_nan});
  const auto met = boxes.trace(rays);
  t.equal("end at the box without NaN", met[5].end, kClosestHitRan);
  t.equal("its PrimitiveIndex()", met[5].primitive, 5u);
}

// Vertices with 2 or 4 components of these bit patterns; rays go straight through the middle.
template <class T>
void expect_active(Context& t, const std::string& what, Format format,
                   const std::vector<T>& vertices, uint32_t stride, float x, float y) {
  RaytracingGeometryDesc desc;
  desc.Flags = RaytracingGeometryFlags::kOpaque;
  desc.Triangles.VertexFormat = format;
  desc.Triangles.VertexCount = 3;
  desc.Triangles.VertexBuffer = {t.upload(vertices).GetGPUVirtualAddress(), stride};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &desc;
  Standard program(t);
  program.record("Plain");
  Ray ray;
  ray.origin[0] = x;
  ray.origin[1] = y;
  ray.origin[2] = -3;
  const Seen seen = program.trace(t.top_level({instance(t.build(inputs))}), ray);
  t.equal("end of " + what, seen.end, kClosestHitRan);
}

void normalised_vertices_are_active(Context& t) {
  // (-1, -1), (1, -1), (0, 1); -32768 also means -1.
  expect_active<int16_t>(t, "R16G16_SNORM", Format::kR16G16Snorm,
                         {-32768, -32768, 32767, -32768, 0, 32767}, 4, -0.98f, -0.99f);
  expect_active<int16_t>(
      t, "R16G16B16A16_SNORM", Format::kR16G16B16A16Snorm,
      {-32768, -32768, -32768, -32768, 32767, -32768, -32768, -32768, 0, 32767, -32768, -32768}, 8,
      -0.98f, -0.99f);
  expect_active<int8_t>(t, "R8G8_SNORM", Format::kR8G8Snorm, {-128, -128, 127, -128, 0, 127}, 2,
                        -0.98f, -0.99f);
  expect_active<uint16_t>(t, "R16G16_UNORM", Format::kR16G16Unorm,
                          {0x7E00, 0, 0xFFFF, 0, 0, 0xFFFF}, 4, 0.5f, 0.1f);
}

void degenerate_ones_count(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.record("Box", 5);
  const Geometry last = triangle(5);
  Geometry line = triangle(5);
  for (size_t i = 0; i < 3; ++i) line.vertices[3 * i] = 0;
  Geometry point = box(5);
  point.boxes[0] = {0.1f, 0.2f, 5, 0.1f, 0.2f, 5};
  const Buffer degenerate = t.bottom_level({collapsed(triangle(5)), line});
  program.scene =
      t.top_level({instance(degenerate),
                   instance(t.bottom_level({side_by_side({collapsed(triangle(5)), line, last})})),
                   instance(t.bottom_level({side_by_side({point, box(5)})}), 10, 1)});
  const auto seen = program.trace({ray_at(0), ray_at(10.5f)});
  t.equal("InstanceIndex() behind a degenerate instance", seen[0].instance_index, 1u);
  t.equal("PrimitiveIndex() behind degenerate triangles", seen[0].primitive, 2u);
  t.equal("PrimitiveIndex() behind a degenerate box", seen[1].primitive, 1u);
  t.equal("end at the box", seen[1].end, kClosestHitRan);
}

// Boxes may be enlarged, so nothing can be demanded of rays near the point.
void inverted_boxes(Context& t) {
  Standard program(t);
  program.record("Box", 5);
  Geometry inverted = box(5);
  std::swap(inverted.boxes[0].MinX, inverted.boxes[0].MaxX);
  Updatable structure(t, side_by_side({inverted, box(5, 100)}));
  program.scene = structure.scene();
  const std::vector<Ray> rays = {ray_at(0.8f), ray_at(100), ray_at(50, 40)};
  auto seen = program.trace(rays);
  t.equal("end at the box beside it", seen[1].end, kClosestHitRan);
  t.equal("end far from both", seen[2].end, kMissRan);
  structure.update(side_by_side({box(5), box(5, 100)}));
  program.scene = structure.scene();
  seen = program.trace(rays);
  t.equal("end once an update has mended it", seen[0].end, kClosestHitRan);
  // Repaired, and alone: index 0 is hit.
  Updatable alone(t, inverted);
  alone.update(box(5));
  program.scene = alone.scene();
  t.equal("end of the only box, mended", program.trace(rays)[0].end, kClosestHitRan);
}

void updates_collapse_and_restore(Context& t) {
  Standard program(t);
  program.record("Plain");
  const Geometry both = side_by_side({triangle(5), triangle(5, 10)});
  const Geometry one = side_by_side({collapsed(triangle(5)), triangle(5, 10)});
  const std::vector<Ray> rays = {ray_at(0), ray_at(10)};
  for (const bool starts_collapsed : {false, true}) {
    Updatable structure(t, starts_collapsed ? one : both);
    for (int step = 0; step < 3; ++step) {
      const bool is_collapsed = starts_collapsed == (step % 2 == 0);
      if (step > 0) structure.update(is_collapsed ? one : both);
      program.scene = structure.scene();
      const auto seen = program.trace(rays);
      t.equal("end, step " + std::to_string(step), seen[0].end,
              is_collapsed ? kMissRan : kClosestHitRan);
      t.equal("PrimitiveIndex() of the other", seen[1].primitive, 1u);
    }
  }
}

// DXR leaves this open; here an update decides again which primitives are active.
void updates_change_activity(Context& t) {
  Standard program(t);
  program.record("Plain");
  Geometry inactive = triangle(5);
  inactive.vertices[0] = kNan;
  const Geometry both = side_by_side({triangle(5), triangle(5, 10)});
  const Geometry one = side_by_side({inactive, triangle(5, 10)});
  const std::vector<Ray> rays = {ray_at(0), ray_at(10)};
  for (const bool starts_inactive : {false, true}) {
    Updatable structure(t, starts_inactive ? one : both);
    structure.update(starts_inactive ? both : one);
    program.scene = structure.scene();
    const auto seen = program.trace(rays);
    t.equal(starts_inactive ? "end of one made active" : "end of one made inactive", seen[0].end,
            starts_inactive ? kClosestHitRan : kMissRan);
    t.equal("end of the other", seen[1].end, kClosestHitRan);
    t.equal("PrimitiveIndex() of the other", seen[1].primitive, 1u);
  }
}

}  // namespace

std::vector<RuleTest> trv_inactive_tests() {
  return {{"TRV-59", a_nan_beside_x, "KA0473"},
          {"TRV-60", normalised_vertices_are_active},
          {"TRV-61", updates_change_activity, "KA0470"},
          {"TRV-62", degenerate_ones_count},
          {"TRV-65", inverted_boxes},
          {"TRV-66", updates_collapse_and_restore}};
}

}  // namespace kaamos::conformance
