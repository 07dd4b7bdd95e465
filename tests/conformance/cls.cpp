// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: clusters, and bottom levels of them.
#include "tests/conformance/cls.h"

#include <shaders/top.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace kaamos::conformance::cls {

namespace {

constexpr uint32_t kClusterIdInvalid = 0xFFFFFFFF;  // CLUSTER_ID_INVALID

// What top.hlsl's queries find out about the first ray: candidate, committed, by a hit object.
std::vector<uint32_t> clusters_of_ray(Context& t, const Buffer& top, const Ray& ray) {
  Program program(t, kaamos_shaders_top());
  program.group("Triangles", "Closest", "Any");
  program.scene = top;
  program.rays = t.upload(std::vector<Ray>{ray});
  program.raygen("AskOfClusters");
  program.miss("Miss");
  program.hit("Triangles");
  auto words = program.run(1);
  words.resize(3);
  return words;
}

// The first corner of the triangle that the ray hits, as its closest-hit shader reads it.
std::vector<float> corner_of_ray(Context& t, const Buffer& top, const Ray& ray) {
  Program program(t, kaamos_shaders_top());
  program.group("Triangles", "Closest", "Any");
  program.scene = top;
  program.rays = t.upload(std::vector<Ray>{ray});
  program.raygen("Ask");
  program.miss("Miss");
  program.hit("Triangles");
  const auto words = program.run(1);
  std::vector<float> corner;
  for (int i = 9; i < 12; ++i) corner.push_back(std::bit_cast<float>(words[i]));
  return corner;
}

uint64_t level_with(Context& t, const TrianglesDesc& desc, const std::vector<ClusterArgs>& all) {
  return level_of(t, build(t, desc, all));
}

void counts(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  ClusterArgs none = cluster(t, triangle(5));
  none.TriangleCount = 0;
  ClusterArgs bare = cluster(t, triangle(5));
  bare.VertexCount = 0;
  std::vector<float> vertices;
  std::vector<uint8_t> indices;
  for (uint32_t i = 0; i < 256; ++i) {  // 255 triangles around the first vertex
    vertices.insert(vertices.end(), {i == 0 ? 10.f : 13.f, i == 0 ? 3.f : -3.f, 5 + 0.f});
    if (i != 0) vertices[3 * i] = i % 2 != 0 ? 13 : 7;
    if (i + 1 < 256)
      indices.insert(indices.end(), {0, static_cast<uint8_t>(i), static_cast<uint8_t>(i + 1)});
  }
  indices.insert(indices.end(), {0, 254, 255});
  ClusterArgs full = cluster(t, vertices, indices);
  full.VertexCount = 256;
  t.equal("triangles", full.TriangleCount, 256);
  const Buffer top = top_of(t, level_from(t, std::vector<ClusterArgs>{none, bare, full}));
  own.noted("0, 1 and 256", "");
  t.distance("empty and full", depths_at(t, top, {0, 10}), {-1, 5});
  ClusterArgs more = full;
  more.TriangleCount = 257;
  const auto made = build(t, triangles_desc(2), std::vector<ClusterArgs>{more, full});
  own.noted("257 triangles", "argument 0");
  t.equal("257 triangles", made[0], 0u);
  TrianglesDesc tight = triangles_desc(1);
  tight.Limits.MaxTriangleCountPerCluster = 64;
  tight.Limits.MaxTotalTriangleCount = 64;
  t.equal("more than it was sized for", build(t, tight, std::vector<ClusterArgs>{full})[0], 0u);
  t.holds("a note", !std::exchange(*own.notes, {}).empty());
}

void index_formats(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const std::vector<float> vertices = triangle(5).vertices;
  for (const uint32_t bytes : {1u, 2u, 4u}) {
    for (uint32_t stride = 0; stride <= 4; ++stride) {
      TrianglesDesc desc = triangles_desc(1);
      desc.IndexFormat = static_cast<RtasIndexFormat>(bytes);
      std::vector<uint8_t> memory(16, 0xEE);
      const uint32_t step = stride == 0 ? bytes : stride;
      for (uint32_t i = 0; i < 3; ++i) {
        for (uint32_t k = 0; k < bytes; ++k) {
          if (i * step + k < memory.size())
            memory[i * step + k] = k == 0 ? static_cast<uint8_t>(i) : 0;
        }
      }
      ClusterArgs args = cluster(t, vertices, memory);
      args.TriangleCount = 1;
      args.IndexBufferStride = static_cast<uint16_t>(stride);
      const std::string what = std::to_string(bytes) + " bytes, stride " + std::to_string(stride);
      const uint64_t made = build(t, desc, std::vector<ClusterArgs>{args})[0];
      if (step % bytes != 0) {
        own.noted(what, "multiples of " + std::to_string(bytes));
        continue;
      }
      own.noted(what, "");
      t.distance(what, depths_at(t, top_of(t, level_of(t, std::vector<uint64_t>{made})), {0}), {5});
    }
  }
  ClusterArgs wide = cluster(t, vertices, {0, 1, 2});
  wide.IndexBufferStride = 8;
  build(t, triangles_desc(1), std::vector<ClusterArgs>{wide});
  own.noted("a stride of 8", "more than 4");
  ClusterArgs outside = cluster(t, vertices, {0, 1, 2});
  outside.TriangleCount = 200;
  build(t, triangles_desc(1), std::vector<ClusterArgs>{outside});
  own.noted("indices outside of their buffer", "bytes from there on");
}

void vertex_count(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  std::vector<float> vertices(30, 0);
  const std::vector<float> corners = triangle(5).vertices;
  for (int i = 0; i < 3; ++i) {
    const int at = i == 0 ? 0 : i == 1 ? 5 : 9;
    std::copy_n(&corners[3 * i], 3, &vertices[3 * at]);
  }
  ClusterArgs args = cluster(t, vertices, {0, 5, 9});
  const auto depth = [&] {
    return depths_at(t, top_of(t, level_from(t, std::vector<ClusterArgs>{args})), {0});
  };
  t.distance("10", depth(), {5});
  own.noted("10", "");
  args.VertexCount = 3;
  t.distance("3", depth(), {5});
  own.noted("3", "index 5");
  args.VertexBuffer =
      t.upload(std::vector<float>(vertices.begin(), vertices.begin() + 27)).GetGPUVirtualAddress();
  args.VertexCount = 10;
  t.distance("a buffer that is too small", depth(), {-1});
  own.noted("a buffer that is too small", "never hit");
}

uint16_t half(float value) {  // of a normal number that is exact
  const auto bits = std::bit_cast<uint32_t>(value);
  if (value == 0) return 0;
  return static_cast<uint16_t>((bits >> 16 & 0x8000) | (((bits >> 13) - (112u << 10)) & 0x7FFF));
}

// A triangle at z = 1, or 0 for two components, whose corners every format has exactly.
void vertex_formats(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  using Format = RtasVertexFormat;
  const float corners[3][3] = {{0, 1, 1}, {1, 0, 1}, {0, 0, 1}};
  const auto depth_of = [&](Format format, uint32_t stride, const std::vector<uint8_t>& memory) {
    TrianglesDesc desc = triangles_desc(1);
    desc.VertexFormat = format;
    ClusterArgs args = cluster(t, std::vector<float>(9), {0, 1, 2});
    args.VertexBuffer = t.upload(memory).GetGPUVirtualAddress();
    args.VertexBufferStride = static_cast<uint16_t>(stride);
    Ray ray = ray_at(0.25f, 0.25f);
    ray.origin[2] = -1;
    Standard program(t);
    program.records("Plain", 1);
    const Seen seen = program.trace(top_of(t, level_with(t, desc, {args})), ray);
    return seen.end == kClosestHitRan ? seen.t : -1;
  };
  const auto check = [&](const char* name, Format format, uint32_t components, auto encode,
                         const std::vector<uint32_t>& strides) {
    const uint32_t bytes = components * sizeof(encode(0.f));
    for (uint32_t stride : strides) {
      const uint32_t step = stride == 0 ? bytes : stride;
      std::vector<uint8_t> memory(2 * step + bytes, 0xEE);
      for (uint32_t v = 0; v < 3; ++v) {
        for (uint32_t c = 0; c < components; ++c) {
          const auto value = encode(corners[v][c]);
          std::memcpy(&memory[v * step + c * sizeof(value)], &value, sizeof(value));
        }
      }
      t.distance(std::string(name) + ", stride " + std::to_string(stride),
                 depth_of(format, stride, memory), components == 3 ? 2 : 1);
    }
  };
  const auto same = [](float x) { return x; };
  const auto unorm16 = [](float x) { return static_cast<uint16_t>(x * 65535); };
  const auto snorm16 = [](float x) { return static_cast<int16_t>(x * 32767); };
  const auto unorm8 = [](float x) { return static_cast<uint8_t>(x * 255); };
  const auto snorm8 = [](float x) { return static_cast<int8_t>(x * 127); };
  check("FLOAT32_2", Format::kFloat32x2, 2, same, {0, 8, 12});
  check("FLOAT32_3", Format::kFloat32x3, 3, same, {0, 12, 16, 20});
  check("FLOAT16_2", Format::kFloat16x2, 2, half, {0, 6});
  check("FLOAT16_3", Format::kFloat16x3, 3, half, {0, 6, 8});
  check("UNORM16_2", Format::kUnorm16x2, 2, unorm16, {0, 8});
  check("UNORM16_3", Format::kUnorm16x3, 3, unorm16, {0, 6, 8});
  check("SNORM16_2", Format::kSnorm16x2, 2, snorm16, {0});
  check("SNORM16_3", Format::kSnorm16x3, 3, snorm16, {0, 10});
  check("UNORM8_2", Format::kUnorm8x2, 2, unorm8, {0, 3});
  check("UNORM8_3", Format::kUnorm8x3, 3, unorm8, {0, 3, 5});
  check("SNORM8_2", Format::kSnorm8x2, 2, snorm8, {0});
  check("SNORM8_3", Format::kSnorm8x3, 3, snorm8, {0, 4});
  std::vector<uint8_t> packed(12);
  for (uint32_t v = 0; v < 3; ++v) {
    uint32_t word = 3u << 30;
    for (int c = 0; c < 3; ++c) word |= static_cast<uint32_t>(corners[v][c] * 1023) << 10 * c;
    std::memcpy(&packed[4 * v], &word, 4);
  }
  t.distance("10_10_10_2", depth_of(Format::k10_10_10_2_Unorm, 0, packed), 2);
  own.noted("all formats", "");
  TrianglesDesc desc = triangles_desc(1);
  ClusterArgs odd = cluster(t, triangle(5));
  odd.VertexBufferStride = 14;
  build(t, desc, std::vector<ClusterArgs>{odd});
  own.noted("a stride of 14", "multiples of 4");
}

// A non-negative number of `bits` bits at the end of a stream.
void append_bits(std::vector<uint8_t>& stream, size_t& at, uint32_t value, uint32_t bits) {
  for (uint32_t i = 0; i < bits; ++i, ++at) {
    if (at / 8 == stream.size()) stream.push_back(0);
    stream[at / 8] |= static_cast<uint8_t>((value >> i & 1) << at % 8);
  }
}

std::vector<uint8_t> block_of(const std::vector<uint32_t>& header,
                              const std::vector<uint32_t>& offsets,
                              const std::vector<uint32_t>& bits) {
  std::vector<uint8_t> out(12);
  std::memcpy(out.data(), header.data(), 12);
  std::vector<uint8_t> stream;
  size_t at = 0;
  for (size_t i = 0; i < offsets.size(); ++i) append_bits(stream, at, offsets[i], bits[i % 3]);
  out.insert(out.end(), stream.begin(), stream.end());
  return out;
}

void compressed(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto known =
      block_of({0x00000579, 0xFFFFFB32, 0x00000004}, {5, 10, 17, 2, 3, 4}, {3, 4, 5});
  t.equal("a stream", std::vector<uint32_t>({known[12], known[13], known[14]}), {0xD5, 0xA8, 0x21});
  TrianglesDesc desc = triangles_desc(1, Flags::kAllowDataAccess);
  desc.VertexFormat = RtasVertexFormat::kCompressed1;
  desc.MaxCompressedClusterPositionsSize = 64;
  // Anchors 5, -5 and 4, times 1/4: x from 1.25 on, y from -1.25, z = 4.
  const std::vector<uint32_t> header = {0x0000057D, 0xFFFFFB33, 0x00000404};
  const std::vector<uint32_t> offsets = {0, 0, 12, 8, 0, 12, 0, 8, 12};
  const auto args_of = [&](const std::vector<uint8_t>& block) {
    ClusterArgs args = cluster(t, std::vector<float>(9), {0, 1, 2});
    args.VertexBuffer = t.upload(block).GetGPUVirtualAddress();
    args.VertexBufferStride = 77;
    args.PositionTruncateBitCount = 32;
    return args;
  };
  const auto block = block_of(header, offsets, {4, 4, 5});
  const Buffer top = top_of(t, level_with(t, desc, {args_of(block)}));
  own.noted("a block", "");
  const Ray ray = ray_at(1.5f, -1);
  Standard program(t);
  program.records("Plain", 1);
  t.distance("t", program.trace(top, ray).t, 4);
  t.equal("a corner", corner_of_ray(t, top, ray), {1.25f, -1.25f, 4.f});
  auto cut = block;
  cut.pop_back();
  build(t, desc, std::vector<ClusterArgs>{args_of(cut)});
  own.noted("a block that is cut off", "the block of positions");
  auto zero = block;
  zero[0] = 0;
  build(t, desc, std::vector<ClusterArgs>{args_of(zero)});
  own.noted("an exponent of 0", "exponent");
  desc.MaxCompressedClusterPositionsSize = 16;
  build(t, desc, std::vector<ClusterArgs>{args_of(block)});
  own.noted("a block that is too large", "MaxCompressedClusterPositionsSize");
}

// Six triangles side by side in one cluster.
struct Row {
  std::vector<float> vertices;
  std::vector<uint8_t> indices;
};
Row row_of(uint32_t count) {
  Row row;
  for (uint32_t i = 0; i < count; ++i) {
    const auto one = triangle(5, 10.f * static_cast<float>(i)).vertices;
    row.vertices.insert(row.vertices.end(), one.begin(), one.end());
    for (uint32_t k = 0; k < 3; ++k) row.indices.push_back(static_cast<uint8_t>(3 * i + k));
  }
  return row;
}

void geometry_indices(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Row row = row_of(2);
  const auto seen = [&](const TrianglesDesc& desc, const ClusterArgs& args) {
    const Buffer top = top_of(t, level_with(t, desc, {args}));
    Standard program(t);
    program.records("Counted", 64);
    program.scene = top;
    return program.trace({ray_at(0), ray_at(10)});
  };
  TrianglesDesc desc = triangles_desc(1);
  ClusterArgs args = cluster(t, row.vertices, row.indices);
  args.BaseGeometryIndexAndFlags = 5 | kRtasClusteredGeometryOpaque | 0x3F000000;
  auto found = seen(desc, args);
  t.equal("without an array", std::vector<uint32_t>({found[0].geometry, found[1].geometry}),
          {5, 5});
  t.equal("opaque", std::vector<uint32_t>({found[0].any_hits, found[1].any_hits}), {0, 0});
  args.BaseGeometryIndexAndFlags = 5;
  const std::vector<uint32_t> entries = {0 | kRtasClusteredGeometryOpaque, 77, 3, 77, 11};
  args.GeometryIndexAndFlagsArray = t.upload(entries).GetGPUVirtualAddress();
  args.GeometryIndexAndFlagsArrayStride = 8;
  found = seen(desc, args);
  t.equal("an array", std::vector<uint32_t>({found[0].geometry, found[1].geometry}), {5, 8});
  t.holds("flags of each", found[0].any_hits == 0 && found[1].any_hits != 0);
  desc.GeometryIndexAndFlagsIndexFormat = RtasIndexFormat::kUint8;
  args.GeometryIndexAndFlagsIndexBuffer =
      t.upload(std::vector<uint8_t>{2, 0, 99, 99}).GetGPUVirtualAddress();
  found = seen(desc, args);
  t.equal("indices", std::vector<uint32_t>({found[0].geometry, found[1].geometry}), {16, 5});
  desc.GeometryIndexAndFlagsIndexFormat = RtasIndexFormat::kNone;
  found = seen(desc, args);
  t.equal("without their format", std::vector<uint32_t>({found[0].geometry, found[1].geometry}),
          {5, 8});
  own.noted("all of it", "");
  TrianglesDesc one = desc;
  one.Limits.MaxUniqueGeometryIndexAndFlagsCountPerCluster = 0;
  seen(one, args);
  own.noted("two pairs", "there are 2 pairs");
  desc.Limits.MaxGeometryIndexValue = 7;
  seen(desc, args);
  own.noted("a large index", "MaxGeometryIndexValue is 7");
  desc.Limits.MaxGeometryIndexValue = kRtasMaximumGeometryIndex;
  args.BaseGeometryIndexAndFlags = kRtasMaximumGeometryIndex;
  build(t, desc, std::vector<ClusterArgs>{args});
  own.noted("an index that wraps", "low 24 bits");
  args.GeometryIndexAndFlagsArrayStride = 6;
  build(t, desc, std::vector<ClusterArgs>{args});
  own.noted("a stride of 6", "multiples of 4");
}

void largest_geometry(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const ClusterArgs large = cluster(t, triangle(5), kRtasMaximumGeometryIndex);
  const auto clusters =
      build(t, triangles_desc(2), std::vector<ClusterArgs>{large, cluster(t, triangle(7), 3)});
  own.noted("clusters", "");
  const Buffer addresses = t.upload(clusters);
  const uint64_t first = addresses.GetGPUVirtualAddress();
  const auto levels =
      build(t, level_desc(2, 2), std::vector<LevelArgs>{{1, 0, first}, {1, 0, first + 8}});
  t.distance("the other one", depths_at(t, top_of(t, levels[1]), {0}), {7});
  if (t.target().backend == "vulkan") {
    own.noted("on Vulkan", "KA0794");
    t.equal("on Vulkan", levels[0], 0u);
    return;
  }
  own.noted("levels", "");
  t.equal("GeometryIndex", look(t, top_of(t, levels[0]), {0})[0].geometry,
          kRtasMaximumGeometryIndex);
}

void truncation(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto corner = [&](float x, uint32_t bits) {
    std::vector<float> vertices = triangle(5).vertices;
    vertices[0] = x;
    ClusterArgs args = cluster(t, vertices, {0, 1, 2});
    args.PositionTruncateBitCount = static_cast<uint16_t>(bits);
    const Buffer top =
        top_of(t, level_from(t, std::vector<ClusterArgs>{args}, Flags::kAllowDataAccess));
    return std::bit_cast<uint32_t>(corner_of_ray(t, top, ray_at(0))[0]);
  };
  t.equal("none", corner(1.2345678f, 0), 0x3F9E0651u);
  t.equal("8", corner(1.2345678f, 8), 0x3F9E0600u);
  own.noted("all of it", "");
  std::vector<float> vertices = triangle(5).vertices;
  ClusterArgs args = cluster(t, vertices, {0, 1, 2});
  args.PositionTruncateBitCount = 33;
  TrianglesDesc desc = triangles_desc(1);
  build(t, desc, std::vector<ClusterArgs>{args});
  own.noted("33", "taken as 32");
  args.PositionTruncateBitCount = 3;
  desc.MinPositionTruncateBitCount = 4;
  build(t, desc, std::vector<ClusterArgs>{args});
  own.noted("3", "MinPositionTruncateBitCount is 4");
}

void ids(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Row row = row_of(3);
  ClusterArgs first = cluster(t, row.vertices, row.indices);
  first.ClusterID = 0xFFFFFFFE;
  std::vector<float> moved = row.vertices;
  for (size_t i = 0; i < moved.size(); i += 3) moved[i] += 30;
  ClusterArgs second = cluster(t, moved, row.indices);
  second.ClusterID = 0xFFFFFFFE;
  ClusterArgs third = cluster(t, triangle(5, 60));
  third.ClusterID = 7;
  const Buffer top = top_of(t, level_from(t, std::vector<ClusterArgs>{first, second, third}));
  const auto found = look(t, top, {0, 10, 20, 30, 40, 50, 60});
  std::vector<uint32_t> primitives;
  for (const Seen& seen : found) primitives.push_back(seen.primitive);
  t.equal("PrimitiveIndex", primitives, {0, 1, 2, 0, 1, 2, 0});
  t.equal("ids", clusters_of_ray(t, top, ray_at(40))[1], 0xFFFFFFFEu);
  const auto another = clusters_of_ray(t, top, ray_at(60));
  t.equal("another", std::vector<uint32_t>({another[1], another[2]}), {7, 7});
  own.noted("all of it", "");
}

void inactive(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  Row row = row_of(3);
  row.vertices[9] = std::numeric_limits<float>::quiet_NaN();
  std::copy_n(&row.vertices[18], 3, &row.vertices[21]);
  const Buffer top =
      top_of(t, level_from(t, std::vector<ClusterArgs>{cluster(t, row.vertices, row.indices)}));
  t.distance("one of three", depths_at(t, top, {0, 10, 20}), {5, -1, -1});
  own.noted("all of it", "");
}

// The same triangles in one cluster per geometry, and in many.
void as_a_bottom_level(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  std::vector<Geometry> geometries = meadow();
  for (Geometry& each : geometries) each.transform.clear();
  const auto expected = picture_of_bottom(t, t.bottom_level(geometries));
  std::vector<ClusterArgs> whole;
  std::vector<ClusterArgs> split;
  for (uint32_t g = 0; g < geometries.size(); ++g) {
    whole.push_back(cluster(t, geometries[g], g));
    for (size_t i = 0; i < geometries[g].vertices.size(); i += 18) {
      Geometry part = geometries[g];
      const size_t end = std::min(i + 18, part.vertices.size());
      part.vertices = {geometries[g].vertices.begin() + static_cast<ptrdiff_t>(i),
                       geometries[g].vertices.begin() + static_cast<ptrdiff_t>(end)};
      split.push_back(cluster(t, part, g));
    }
  }
  same_picture(t, "whole", picture(t, top_of(t, level_from(t, whole))), expected);
  auto parts = picture(t, top_of(t, level_from(t, split)));
  for (size_t i = 0; i < parts.size(); ++i) parts[i].primitive = expected[i].primitive;
  same_picture(t, "in parts", parts, expected);
  own.noted("all of it", "");
}

void address_arrays(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto made =
      build(t, triangles_desc(2),
            std::vector<ClusterArgs>{cluster(t, triangle(5)), cluster(t, triangle(6, 10))});
  const auto depths = [&](uint64_t level) { return depths_at(t, top_of(t, level), {0, 10}); };
  t.distance("a null between", depths(level_of(t, {made[0], 0, made[1]})), {5, 6});
  t.distance("none", depths(level_of(t, std::vector<uint64_t>{})), {-1, -1});
  t.distance("in a second one", depths(level_of(t, {made[1]})), {-1, 6});
  LevelArgs args = {2, 24,
                    t.upload(std::vector<uint64_t>{made[0], 1, 2, made[1]}).GetGPUVirtualAddress()};
  t.distance("a stride", depths(build(t, level_desc(), std::vector<LevelArgs>{args})[0]), {5, 6});
  own.noted("all of it", "");
  t.distance("twice", depths(level_of(t, {made[0], made[0]})), {5, -1});
  own.noted("twice", "named twice");
  t.distance("no cluster", depths(level_of(t, {made[0], made[1] + 128})), {5, -1});
  own.noted("no cluster", "no cluster");
  args.ClasAddressStride = 12;
  build(t, level_desc(), std::vector<LevelArgs>{args});
  own.noted("a stride of 12", "multiples of 8");
  args = {1u << 30, 0, args.ClasAddressArray};
  t.equal("more than there are", build(t, level_desc(), std::vector<LevelArgs>{args})[0], 0u);
  t.holds("notes", !std::exchange(*own.notes, {}).empty());
  const auto few = [&](uint32_t total, uint32_t each, const char* words) {
    RtasClasInputsDesc desc = level_desc(1, total);
    desc.MaxClasCountPerArg = each;
    args = {2, 0, t.upload(made).GetGPUVirtualAddress()};
    build(t, desc, std::vector<LevelArgs>{args});
    own.noted(words, words);
  };
  few(1, 2, "MaxTotalClasCount");
  few(2, 1, "MaxClasCountPerArg");
}

void with_classic_levels(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const uint64_t level = level_from(t, std::vector<ClusterArgs>{cluster(t, triangle(5), 0, 9)});
  t.equal("alignment", level % 256, 0u);
  const std::vector<RaytracingInstanceDesc> instances = {
      instance_of(level), conformance::instance(t.bottom_level({triangle(6)}), 10)};
  const Buffer top = t.top_level(instances);
  t.distance("both kinds", depths_at(t, top, {0, 10}), {5, 6});
  t.equal("ClusterID", clusters_of_ray(t, top, ray_at(0))[1], 9u);
  t.equal("no ClusterID", clusters_of_ray(t, top, ray_at(10))[1], kClusterIdInvalid);
  ptl::WriteArgs write = ptl::write({}, 3, 0);
  write.AccelerationStructure = level;
  t.distance("in a partitioned top level",
             depths_at(t, ptl::build_new(t, ptl::small_inputs(), {{write}}), {0}), {5});
  own.noted("all of it", "");
}

void records(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  std::vector<ClusterArgs> all;
  const uint32_t indices[] = {0, 3, 3, 9};
  for (uint32_t i = 0; i < 4; ++i) {
    all.push_back(cluster(t, triangle(5, 10.f * static_cast<float>(i)), indices[i]));
  }
  RaytracingInstanceDesc desc = instance_of(level_from(t, all));
  desc.InstanceContributionToHitGroupIndex = 4;
  Standard program(t);
  program.records("Plain", 32);
  program.scene = t.top_level({desc});
  std::vector<Ray> rays;
  for (int i = 0; i < 4; ++i) {
    rays.push_back(ray_at(10.f * static_cast<float>(i)));
    rays.back().contribution = 1;
    rays.back().multiplier = 2;
  }
  std::vector<uint32_t> found;
  for (const Seen& seen : program.trace(rays)) found.push_back(seen.record);
  t.equal("records", found, {5, 11, 11, 23});
}

void flags_of_triangles(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Row row = row_of(2);
  ClusterArgs args = cluster(t, row.vertices, row.indices);
  args.BaseGeometryIndexAndFlags = 0;
  args.GeometryIndexAndFlagsArray =
      t.upload(std::vector<uint32_t>{kRtasClusteredGeometryOpaque, 0}).GetGPUVirtualAddress();
  Standard program(t);
  program.records("Counted", 1);
  program.scene = top_of(t, level_from(t, std::vector<ClusterArgs>{args}));
  const auto trace = [&](uint32_t flags) {
    std::vector<Ray> rays = {ray_at(0), ray_at(10)};
    for (Ray& ray : rays) ray.flags = flags;
    std::vector<int> out;
    for (const Seen& seen : program.trace(rays)) {
      out.push_back(seen.end != kClosestHitRan ? -1 : seen.any_hits != 0 ? 1 : 0);
    }
    return out;
  };
  t.equal("no flags", trace(0), {0, 1});
  t.equal("FORCE_OPAQUE", trace(0x1), {0, 0});
  t.equal("FORCE_NON_OPAQUE", trace(0x2), {1, 1});
  t.equal("CULL_OPAQUE", trace(0x40), {-1, 1});
  t.equal("CULL_NON_OPAQUE", trace(0x80), {0, -1});
}

void data_access(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  ClusterArgs open = cluster(t, triangle(5));
  ClusterArgs closed = cluster(t, triangle(6, 10));
  closed.ClusterFlags = RtasClusterFlags::kDisallowDataAccess;
  const auto made =
      build(t, triangles_desc(2, Flags::kAllowDataAccess), std::vector<ClusterArgs>{open, closed});
  t.equal("a corner",
          corner_of_ray(t, top_of(t, level_of(t, std::vector<uint64_t>{made[0]})), ray_at(0)),
          std::vector<float>({0, 3, 5}));
  own.noted("one kind", "");
  level_of(t, made);
  own.noted("both kinds", "data access");
}

void rebuilt(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto made =
      build(t, triangles_desc(2),
            std::vector<ClusterArgs>{cluster(t, triangle(5)), cluster(t, triangle(8))});
  const Buffer list = t.upload(std::vector<uint64_t>{made[0]});
  const RtasClasInputsDesc desc = level_desc(1, 1);
  const Batch batch = batch_of(
      t, inputs_of(desc), t.upload(std::vector<LevelArgs>{{1, 0, list.GetGPUVirtualAddress()}}));
  t.accepted("a build", run(t, inputs_of(desc), batch));
  const uint64_t level = addresses_in(t, batch)[0];
  t.distance("first", depths_at(t, top_of(t, level), {0}), {5});
  overwrite(list, std::vector<uint64_t>{made[1]});
  t.accepted("a build in place", run(t, inputs_of(desc), batch));
  t.distance("second", depths_at(t, top_of(t, level), {0}), {8});
  own.noted("all of it", "");
}

}  // namespace

}  // namespace kaamos::conformance::cls

namespace kaamos::conformance {

std::vector<RuleTest> cls_tests() {
  using namespace cls;
  std::vector<RuleTest> all = {{"CLS-01", counts},
                               {"CLS-02", index_formats},
                               {"CLS-03", vertex_count},
                               {"CLS-04, CLS-05", vertex_formats},
                               {"CLS-06, CLS-07, CLS-08, CLS-09, CLS-10", geometry_indices},
                               {"CLS-11", truncation},
                               {"CLS-12, CLS-13, CLS-43, CLS-44, CLS-45", ids},
                               {"CLS-14", inactive},
                               {"CLS-15, CLS-47", as_a_bottom_level},
                               {"CLS-22, CLS-23, CLS-24, CLS-25", compressed},
                               {"CLS-32, CLS-33", address_arrays},
                               {"CLS-34, PTL-19", with_classic_levels},
                               {"CLS-35, CLS-36", records},
                               {"CLS-36", largest_geometry},
                               {"CLS-37", flags_of_triangles},
                               {"CLS-38, TOP-11", data_access},
                               {"CLS-40", rebuilt}};
  for (const auto& more : {memory_tests(), template_tests(), micromap_tests(), copy_tests()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace kaamos::conformance
