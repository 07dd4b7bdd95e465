// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: cluster templates, clusters that are made of them, and moves.
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "tests/conformance/cls.h"

namespace kaamos::conformance::cls {

namespace {

using TemplateDesc = RtasClusterTemplateTrianglesInputsDesc;
using InstantiateDesc = RtasInstantiateClusterTemplateInputsDesc;
using TemplateArgs = RtasBuildClusterTemplatesFromTrianglesArgs;
using InstantiateArgs = RtasInstantiateClusterTemplatesArgs;
using MoveArgs = RtasMoveClusterObjectsArgs;
using Format = RtasVertexFormat;
using Addresses = std::vector<uint64_t>;

TemplateDesc template_desc(Format format = Format::kFloat32x3) {
  const TrianglesDesc like = triangles_desc();
  TemplateDesc desc;
  desc.Limits = like.Limits;
  desc.VertexInstantiationFormat = format;
  return desc;
}

InstantiateDesc instantiate_desc(Format format = Format::kFloat32x3) {
  InstantiateDesc desc;
  desc.Limits = triangles_desc().Limits;
  desc.VertexSourceFormat = format;
  return desc;
}

TemplateArgs template_of(const ClusterArgs& args) {
  TemplateArgs out;
  out.TrianglesArgs = args;
  out.TrianglesArgs.VertexBuffer = 0;
  return out;
}

InstantiateArgs instance(Context& t, uint64_t from, const std::vector<float>& vertices) {
  InstantiateArgs args;
  args.ClusterTemplate = from;
  args.VertexBuffer = {t.upload(vertices).GetGPUVirtualAddress(), 0};
  return args;
}

uint64_t one_template(Context& t, const TemplateArgs& args,
                      const TemplateDesc& desc = template_desc()) {
  return build(t, desc, std::vector<TemplateArgs>{args})[0];
}
uint64_t one_instance(Context& t, const InstantiateArgs& args,
                      const InstantiateDesc& desc = instantiate_desc()) {
  return build(t, desc, std::vector<InstantiateArgs>{args})[0];
}
Buffer top_of_cluster(Context& t, uint64_t made) {
  return top_of(t, level_of(t, Addresses{made}));
}

void templates(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const ClusterArgs args = cluster(t, triangle(5), 7, 0xFFFFFFFE);
  TemplateDesc desc = template_desc();
  const uint64_t plain = one_template(t, template_of(args));
  t.equal("alignment", plain % kRtasClusterTemplateByteAlignment, 0u);
  TemplateArgs hinted = template_of(args);
  hinted.TrianglesArgs.VertexBuffer = t.upload(std::vector<float>(9, 1e30f)).GetGPUVirtualAddress();
  desc.VertexHintFormat = Format::kFloat32x3;
  const uint64_t with_hint = one_template(t, hinted, desc);
  for (const uint64_t from : {plain, with_hint}) {
    const auto made =
        build(t, instantiate_desc(),
              std::vector<InstantiateArgs>{instance(t, from, triangle(5).vertices),
                                           instance(t, from, triangle(8, 10).vertices)});
    t.distance("two instances", depths_at(t, top_of(t, level_of(t, made)), {0, 10}), {5, 8});
  }
  own.notes->clear();
  t.distance("a template in a bottom level", depths_at(t, top_of_cluster(t, plain), {0}), {-1});
  own.noted("a template in a bottom level", "no cluster");
  t.equal("no template", one_instance(t, instance(t, plain + 32, triangle(5).vertices)), 0u);
  own.noted("no template", "no cluster template");
}

void offsets(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const uint64_t from = one_template(t, template_of(cluster(t, triangle(5), 7, 0xFFFFFFFE)));
  InstantiateArgs args = instance(t, from, triangle(5).vertices);
  const auto geometry = [&](int32_t offset) {
    args.GeometryIndexOffset = offset;
    return look(t, top_of_cluster(t, one_instance(t, args)), {0})[0].geometry;
  };
  t.equal("0", geometry(0), 7u);
  t.equal("-7", geometry(-7), 0u);
  t.equal("5", geometry(5), 12u);
  own.noted("offsets", "");
  args.GeometryIndexOffset = -8;
  one_instance(t, args);
  own.noted("-8", "geometry index is -1");
  args.GeometryIndexOffset = 2;
  InstantiateDesc desc = instantiate_desc();
  desc.Limits.MaxGeometryIndexValue = 8;
  one_instance(t, args, desc);
  own.noted("a small limit", "geometry index is 9");
}

void box_limits(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  TemplateArgs args = template_of(cluster(t, triangle(5)));
  const Buffer box = t.upload(std::vector<float>{-3, -3, 5, 3, 3, 5, 0, 0, 0, 0});
  args.InstantiationBoundingBoxLimit = box.GetGPUVirtualAddress();
  const uint64_t from = one_template(t, args);
  overwrite(box, std::vector<float>(6, 0));  // read when the template was built
  t.distance(
      "on the border",
      depths_at(t, top_of_cluster(t, one_instance(t, instance(t, from, triangle(5).vertices))),
                {0}),
      {5});
  own.noted("on the border", "");
  one_instance(t, instance(t, from, triangle(6).vertices));
  own.noted("outside", "InstantiationBoundingBoxLimit");
  args.InstantiationBoundingBoxLimit += 4;
  t.equal("misaligned", one_template(t, args), 0u);
  own.noted("misaligned", "multiple of 32");
}

// As a cluster that is built from the converted positions; the template may go first.
void like_direct_builds(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  std::vector<Geometry> geometries = meadow();
  const Geometry& whole = geometries[0];
  ClusterArgs args = cluster(t, whole);
  args.PositionTruncateBitCount = 12;
  const auto expected = picture(t, top_of(t, level_from(t, std::vector<ClusterArgs>{args})));
  const TemplateDesc desc = template_desc();
  const Buffer arguments = t.upload(std::vector<TemplateArgs>{template_of(args)});
  const Batch batch = batch_of(t, inputs_of(desc), arguments, 8);
  Batch counted = batch;
  counted.data.IndirectArgumentArraySize =
      t.upload(std::vector<uint32_t>{1}).GetGPUVirtualAddress();
  t.accepted("a template", run(t, inputs_of(desc), counted));
  const uint64_t made = one_instance(t, instance(t, addresses_in(t, batch)[0], whole.vertices));
  const Buffer top = top_of_cluster(t, made);
  overwrite(arguments, std::vector<TemplateArgs>(1));
  t.accepted("another template in its place", run(t, inputs_of(desc), counted));
  same_picture(t, "an instance", picture(t, top), expected);
  own.noted("all of it", "");
}

// Expects that a triangle made of a template begins at this x: it is hit beyond, and not before.
void expect_x(Context& t, const std::string& what, Format source, Format stored,
              const std::vector<uint8_t>& memory, float expected, uint32_t header = 0) {
  TemplateArgs args = template_of(cluster(t, std::vector<float>(9), {0, 1, 2}));
  if (stored == Format::kCompressed1) args.Compressed1TemplateHeader = header;
  const uint64_t from = one_template(t, args, template_desc(stored));
  InstantiateArgs made;
  made.ClusterTemplate = from;
  made.VertexBuffer = {t.upload(memory).GetGPUVirtualAddress(), 0};
  const Buffer top = top_of_cluster(t, one_instance(t, made, instantiate_desc(source)));
  // The triangle is (x, -1, 0), (x, 1, 0), (x + something, 0, 0).
  const float step = std::max(std::fabs(expected), 0.25f) * 0x1p-16f;
  const auto hits = [&](float x) {
    Ray ray;
    ray.origin[0] = x;
    ray.origin[1] = 0;
    ray.origin[2] = -1;
    Standard program(t);
    program.records("Plain", 1);
    return program.trace(top, ray).end == kClosestHitRan;
  };
  t.holds(what + ": inside", hits(expected + step));
  t.holds(what + ": outside", !hits(expected - step));
}

std::vector<uint8_t> bytes_of(const std::vector<float>& floats) {
  std::vector<uint8_t> out(4 * floats.size());
  std::memcpy(out.data(), floats.data(), out.size());
  return out;
}

void conversions(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto from_floats = [&](const char* what, Format stored, float x, float expected,
                               uint32_t header = 0) {
    expect_x(t, what, Format::kFloat32x3, stored,
             bytes_of({x, -1, 0, x, 1, 0, expected + 0.5f, 0, 0}), expected, header);
  };
  from_floats("same", Format::kFloat32x3, 0.3f, 0.3f);
  from_floats("SNORM8", Format::kSnorm8x3, 0.5f, 64 / 127.f);
  from_floats("-SNORM8", Format::kSnorm8x3, -0.5f, -64 / 127.f);
  from_floats("SNORM16", Format::kSnorm16x3, 0.3f, 9830 / 32767.f);
  from_floats("clamped", Format::kSnorm8x3, -3, -1);
  from_floats("FLOAT16", Format::kFloat16x3, 1 + 0x1.8p-11f, 1);
  from_floats("-FLOAT16", Format::kFloat16x3, -1 - 0x1.ep-11f, -1);
  own.noted("none of them", "");
  // Steps of 1/4, 8 bits each.
  const uint32_t quarters = 125 | 7 << 8 | 7 << 12 | 7 << 16;
  from_floats("COMPRESSED1", Format::kCompressed1, 0.375f, 0.5f, quarters);
  from_floats("-COMPRESSED1", Format::kCompressed1, -0.375f, -0.25f, quarters);
  from_floats("a tie", Format::kCompressed1, 0.125f, 0.25f, quarters);
  from_floats("a tie below", Format::kCompressed1, -0.125f, 0, quarters);
  own.noted("none of them", "");
  from_floats("beyond 3 bits", Format::kCompressed1, 100, 100, 125 | 7 << 8 | 2 << 12 | 7 << 16);
  own.noted("beyond 3 bits", "clamped");
}

// Blocks that fit the template's header stay as they are.
void compressed_sources(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  // e 120, anchors 0, -128, 0, 8 bits each, steps of 1/128: x = 20/128.
  const auto block = [](uint32_t bits) {
    std::vector<uint32_t> header = {120, 0xFFFF8000u | (bits - 1) | (bits - 1) << 4, bits - 1};
    std::vector<uint8_t> out(12);
    std::memcpy(out.data(), header.data(), 12);
    const uint32_t offsets[9] = {20, 0, 0, 20, 255, 0, 200, 128, 0};
    size_t at = 0;
    for (const uint32_t offset : offsets) {
      for (uint32_t i = 0; i < bits; ++i, ++at) {
        if (12 + at / 8 == out.size()) out.push_back(0);
        out.back() |= static_cast<uint8_t>((offset >> i & 1) << at % 8);
      }
    }
    return out;
  };
  const uint32_t coarse = 124 | 7 << 8 | 7 << 12 | 7 << 16;  // steps of 1/8
  expect_x(t, "8 bits", Format::kCompressed1, Format::kCompressed1, block(8), 20 / 128.f, coarse);
  expect_x(t, "9 bits", Format::kCompressed1, Format::kCompressed1, block(9), 1 / 8.f, coarse);
  own.noted("both", "");
}

template <class Args>
Addresses move(Context& t, RtasClusterMovesDesc desc, const std::vector<Args>& args, uint64_t to) {
  const Buffer arguments = t.upload(args);
  Batch batch = batch_of(t, inputs_of(desc), arguments, static_cast<uint32_t>(args.size()));
  if (to != 0) batch.data.BatchResultData = to;
  t.accepted("a move", run(t, inputs_of(desc), batch));
  return addresses_in(t, batch);
}

RtasClusterMovesDesc moves_desc(uint32_t count, RtasMoveOperationType type) {
  RtasClusterMovesDesc desc;
  desc.MaxArgCount = count;
  desc.Type = type;
  desc.MaxBytesMoved = 1 << 16;
  return desc;
}

void moves(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  constexpr auto kCluster = RtasMoveOperationType::kClusterLevelAccelerationStructure;
  const auto made =
      build(t, triangles_desc(2),
            std::vector<ClusterArgs>{cluster(t, triangle(5)), cluster(t, triangle(6, 10))});
  const std::vector<MoveArgs> args = {{made[1]}, {made[0]}};
  RtasClusterMovesDesc desc = moves_desc(2, kCluster);
  t.equal("prebuild",
          t.device().GetRTASOperationPrebuildInfo(inputs_of(desc)).ResultDataMaxSizeInBytes, 0u);
  const uint64_t to = t.structure_memory(1 << 16).GetGPUVirtualAddress();
  const Addresses moved = move(t, desc, args, to);
  const auto depths = [&](const Addresses& clusters) {
    return depths_at(t, top_of(t, level_of(t, clusters)), {0, 10});
  };
  t.distance("copies", depths(moved), {5, 6});
  t.distance("sources", depths(made), {5, 6});
  RtasClusterMovesDesc sizes = desc;
  sizes.Mode = Mode::kGetSizes;
  const Batch batch = batch_of(t, inputs_of(sizes), t.upload(args), 2);
  t.accepted("sizes", run(t, inputs_of(sizes), batch));
  const auto found = sizes_in(t, batch);
  t.equal("packed", moved, Addresses({to, to + found[0]}));
  own.noted("clusters", "");
  const uint64_t level = level_of(t, made);
  desc = moves_desc(1, RtasMoveOperationType::kClusterBottomLevelAccelerationStructure);
  const Addresses copied = move(t, desc, std::vector<MoveArgs>{{level}},
                                t.structure_memory(1 << 16).GetGPUVirtualAddress());
  t.distance("a bottom level", depths_at(t, top_of(t, copied[0]), {0, 10}), {5, 6});
  own.noted("a bottom level", "");
  const uint64_t classic = t.bottom_level({triangle(5)}).GetGPUVirtualAddress();
  t.equal("a classic bottom level", move(t, desc, std::vector<MoveArgs>{{classic}}, to)[0], 0u);
  own.noted("a classic bottom level", "no bottom level of clusters");
  desc = moves_desc(1, RtasMoveOperationType::kClusterTemplate);
  const uint64_t from = one_template(t, template_of(cluster(t, triangle(5))));
  const uint64_t second = move(t, desc, std::vector<MoveArgs>{{from}},
                               t.structure_memory(1 << 16).GetGPUVirtualAddress())[0];
  t.distance(
      "a template",
      depths_at(t, top_of_cluster(t, one_instance(t, instance(t, second, triangle(9).vertices))),
                {0}),
      {9});
  own.noted("a template", "");
}

// Twenty clusters one slot up and down, in one operation.
void overlapping_moves(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  constexpr auto kCluster = RtasMoveOperationType::kClusterLevelAccelerationStructure;
  constexpr uint32_t kCount = 20;
  std::vector<ClusterArgs> all;
  std::vector<float> places;
  std::vector<float> depths;
  for (uint32_t i = 0; i < kCount; ++i) {
    places.push_back(10.f * static_cast<float>(i));
    depths.push_back(static_cast<float>(5 + i));
    all.push_back(cluster(t, triangle(depths[i], places[i])));
  }
  RtasClusterMovesDesc desc = moves_desc(kCount, kCluster);
  std::vector<MoveArgs> args;
  for (const uint64_t made : build(t, triangles_desc(kCount), all)) args.push_back({made});
  const uint64_t memory = t.structure_memory(1 << 17).GetGPUVirtualAddress();
  for (const uint64_t to : {memory + 256, memory + 512, memory + 256}) {
    const Addresses moved = move(t, desc, args, to);
    t.equal("the first", moved[0], to);
    t.distance("moved", depths_at(t, top_of(t, level_of(t, moved)), places), depths);
    for (uint32_t i = 0; i < kCount; ++i) args[i] = {moved[i]};
  }
  own.noted("overlaps", "");
  desc.Flags = RtasClusterMoveOperationFlags::kNoOverlap;
  desc.MaxArgCount = 1;
  move(t, desc, std::vector<MoveArgs>{args[0]}, memory + 384);
  own.noted("kNoOverlap", "kNoOverlap");
  desc = moves_desc(1, kCluster);
  desc.MaxBytesMoved = 128;
  t.equal("more than MaxBytesMoved", move(t, desc, std::vector<MoveArgs>{args[5]}, memory)[0], 0u);
  t.holds("notes", !std::exchange(*own.notes, {}).empty());
  desc.Flags = static_cast<RtasClusterMoveOperationFlags>(4);
  t.refused("an undefined flag",
            record(t, [&](CommandList& list) { add_operation(list, inputs_of(desc), Batch{}); }),
            "KA0748");
}

}  // namespace

std::vector<RuleTest> template_tests() {
  return {{"CLS-27", templates},
          {"CLS-29", offsets},
          {"CLS-28", box_limits},
          {"CLS-30", like_direct_builds},
          {"CLS-48, CLS-49, CLS-51", conversions},
          {"CLS-50", compressed_sources},
          {"IND-28, IND-29, IND-31, IND-32", moves},
          {"IND-30", overlapping_moves}};
}

}  // namespace kaamos::conformance::cls
