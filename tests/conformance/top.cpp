// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: positions of the triangles that rays hit.
#include <shaders/top.h>

#include <array>
#include <bit>

#include "tests/conformance/compile.h"
#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;
constexpr auto kAccess = BuildFlags::kAllowDataAccess;

using Corners = std::array<float, 9>;

// The slots of top.hlsl.
enum Slot : uint32_t {
  kAnyHit,
  kClosestHit,
  kCandidate,
  kCommitted,
  kObject,
  kObjectOfQuery,
  kInvoked,
  kRay,
  kSlots
};
constexpr const char* kNames[] = {"any-hit shader", "closest-hit shader", "candidate",
                                  "hit of a query", "hit object",         "object of a query",
                                  "Invoke"};

struct Positions : Program {
  explicit Positions(Context& t, const char* entry = "Ask") : Program(t, kaamos_shaders_top()) {
    context_ = &t;
    group("Triangles", "Closest", "Any");
    group("Boxes", "Closest", "", "Boxed");
    share_as(std::string("positions, ") + entry);
    raygen(entry);
    miss("Miss");
  }

  // By ray, then by slot.
  std::vector<std::array<Corners, kSlots>> ask(const Buffer& top_level,
                                               const std::vector<Ray>& list,
                                               const char* hit_group = "Triangles") {
    scene = top_level;
    rays = context_->upload(list);
    hit(hit_group);
    const auto words = run(static_cast<uint32_t>(list.size()));
    std::vector<std::array<Corners, kSlots>> out(list.size());
    std::memcpy(out.data(), words.data(), out.size() * sizeof(out[0]));
    return out;
  }

 private:
  Context* context_;
};

// A ray along z through the middle of a triangle whose normal is not across it.
Ray towards(const Corners& c) {
  Ray ray;
  ray.origin[0] = (c[0] + c[3] + c[6]) / 3;
  ray.origin[1] = (c[1] + c[4] + c[7]) / 3;
  ray.origin[2] = -100;
  return ray;
}

void expect(Context& t, const std::string& what, const Corners& found, const Corners& expected) {
  for (int i = 0; i < 9; ++i) {
    t.equal(what + ", float " + std::to_string(i), std::bit_cast<uint32_t>(found[i]),
            std::bit_cast<uint32_t>(expected[i]));
  }
}

// What every slot but kRay holds of the triangle.
void expect_everywhere(Context& t, const std::string& what, const Buffer& bottom,
                       const Corners& expected) {
  Positions program(t);
  const auto found = program.ask(t.top_level({instance(bottom)}), {towards(expected)})[0];
  for (uint32_t slot = 0; slot < kRay; ++slot) {
    expect(t, what + ", " + kNames[slot], found[slot], expected);
  }
}

// Numbers that no arithmetic gives back.
Corners odd_triangle(int i) {
  const auto x = static_cast<float>(4 * i);
  return {x - 1.1f, -1.3f, 5.7f, x + 0.1f, 1.7f, 6.1f + x / 7, x + 1.3f, -0.9f, 4.3f};
}

Geometry geometry_of(const std::vector<Corners>& triangles) {
  Geometry out;
  out.flags = kNonOpaque;
  for (const Corners& one : triangles) {
    out.vertices.insert(out.vertices.end(), one.begin(), one.end());
  }
  return out;
}

void every_source(Context& t) {
  std::vector<Corners> all;
  for (int i = 0; i < 12; ++i) all.push_back(odd_triangle(i));
  const Inputs inputs =
      bottom_inputs(t,
                    {geometry_of({all.begin(), all.begin() + 5}), triangle(900, 900),
                     geometry_of({all.begin() + 5, all.end()})},
                    kAccess);
  RaytracingInstanceDesc moved = instance(build_new(t, inputs), 100);
  const Buffer top = t.top_level({instance(t.bottom_level({triangle(900, 900)})), moved});
  std::vector<Ray> list;
  for (const Corners& one : all) {
    list.push_back(towards(one));
    list.back().origin[0] += 100;
  }
  Positions program(t);
  const auto found = program.ask(top, list);
  for (size_t i = 0; i < all.size(); ++i) {
    for (uint32_t slot = 0; slot < kRay; ++slot) {
      expect(t, "triangle " + std::to_string(i) + ", " + kNames[slot], found[i][slot], all[i]);
    }
    // The order of the vertices is that of the barycentrics.
    const Corners& c = all[i];
    const float u = found[i][kRay][3], v = found[i][kRay][4];
    for (int axis = 0; axis < 3; ++axis) {
      t.close("triangle " + std::to_string(i) + ", point hit", found[i][kRay][axis],
              c[axis] + u * (c[3 + axis] - c[axis]) + v * (c[6 + axis] - c[axis]), 2e-5f);
    }
  }
}

void the_model_and_the_stages(Context& t) {
  const auto of = [](const std::string& stage, const std::string& statements,
                     const char* target = "lib_6_10") {
    return compile(shader_of(stage, statements), target, false);
  };
  const std::string call = "words.Store3(0, asuint(TriangleObjectPositions().p1));";
  for (const char* stage : {"anyhit", "closesthit"}) {
    t.accepted(stage, of(stage, call));
    t.accepted(stage + std::string(", its type"),
               of(stage, "BuiltInTrianglePositions at = TriangleObjectPositions();"));
    t.refused(stage + std::string(" in 6.9"), of(stage, call, "lib_6_9"));
  }
  for (const char* stage : {"raygeneration", "intersection", "miss", "callable"}) {
    t.refused(stage, of(stage, call));
  }
  const std::string query =
      "RayQuery<0> q; q.TraceRayInline(scene, 0, 255, ray); q.Proceed();"
      "words.Store3(0, asuint(q.CommittedTriangleObjectPositions().p0));";
  t.accepted("RayQuery", of("miss", query));
  t.refused("RayQuery in 6.9", of("miss", query, "lib_6_9"));
  const std::string object =
      "dx::HitObject h; words.Store3(0, asuint(h.TriangleObjectPositions().p0));";
  t.accepted("HitObject", of("raygeneration", object));
  t.refused("HitObject in 6.9", of("raygeneration", object, "lib_6_9"));
  t.refused("an argument", of("closesthit", "TriangleObjectPositions(0);"));
}

void without_the_flag(Context& t) {
  const Corners corners = odd_triangle(0);
  const bool is_kept = t.target().backend == "embree";  // policy of ours
  expect_everywhere(t, "without the flag", t.bottom_level({geometry_of({corners})}),
                    is_kept ? corners : Corners{});
}

void transforms(Context& t) {
  const Corners corners = odd_triangle(0);
  Geometry geometry = geometry_of({corners});
  geometry.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  expect_everywhere(t, "identity", build_new(t, bottom_inputs(t, {geometry}, kAccess)), corners);
  geometry.transform = {1.7f, 0, 0, 3.3f, 0, 0.9f, 0, -2.1f, 0, 0, 1.1f, 0.7f};
  const Buffer bottom = build_new(t, bottom_inputs(t, {geometry}, kAccess));
  Corners expected;
  for (int i = 0; i < 9; ++i) {
    const auto* row = &geometry.transform[static_cast<size_t>(i % 3) * 4];
    expected[i] = static_cast<float>(double{row[i % 3]} * corners[i] + double{row[3]});
  }
  Positions program(t);
  const auto found = program.ask(t.top_level({instance(bottom)}), {towards(expected)})[0];
  for (uint32_t slot = 0; slot < kRay; ++slot) {
    for (int i = 0; i < 9; ++i) {
      // 2 ulp of the larger term, since the sum may cancel.
      t.close(std::string("scaled, ") + kNames[slot], found[slot][i], expected[i], 1.2e-6f);
    }
  }
}

// (-1 or 0, same), (1, ..), (.., 1), at z of a half where there is a third component.
struct FormatCase {
  Format format;
  const char* name;
  std::vector<uint8_t> bytes;  // of three vertices
  Corners expected;
};

template <class T>
std::vector<uint8_t> bytes_of(std::initializer_list<T> values) {
  std::vector<uint8_t> out(values.size() * sizeof(T));
  std::memcpy(out.data(), std::data(values), out.size());
  return out;
}

void vertex_formats(Context& t) {
  const float half16 = 16384 / 32767.0f, half8 = 64 / 127.0f;
  const FormatCase cases[] = {
      {Format::kR32G32Float,
       "R32G32_FLOAT",
       bytes_of<float>({-1.5f, -1, 1.25f, -1, -1, 1.1f}),
       {-1.5f, -1, 0, 1.25f, -1, 0, -1, 1.1f, 0}},
      {Format::kR32G32B32Float,
       "R32G32B32_FLOAT",
       bytes_of<float>({-1.5f, -1, 0.3f, 1.25f, -1, 0.4f, -1, 1.1f, 0.7f}),
       {-1.5f, -1, 0.3f, 1.25f, -1, 0.4f, -1, 1.1f, 0.7f}},
      {Format::kR16G16Float,
       "R16G16_FLOAT",
       bytes_of<uint16_t>({0xBC00, 0xBC00, 0x3C00, 0xBC00, 0xBC00, 0x3C01}),
       {-1, -1, 0, 1, -1, 0, -1, 1 + 1 / 1024.0f, 0}},
      {Format::kR16G16B16A16Float,
       "R16G16B16A16_FLOAT",
       bytes_of<uint16_t>(
           {0xBC00, 0xBC00, 0x3800, 0x7C00, 0x3C00, 0xBC00, 0x3800, 0, 0xBC00, 0x3C00, 0x3400, 0}),
       {-1, -1, 0.5f, 1, -1, 0.5f, -1, 1, 0.25f}},
      {Format::kR16G16Snorm,
       "R16G16_SNORM",
       bytes_of<uint16_t>({0x8000, 0x8001, 0x7FFF, 0x8000, 0x8000, 0x4000}),
       {-1, -1, 0, 1, -1, 0, -1, half16, 0}},
      {Format::kR16G16B16A16Snorm,
       "R16G16B16A16_SNORM",
       bytes_of<uint16_t>(
           {0x8000, 0x8000, 0x4000, 0, 0x7FFF, 0x8000, 0x4000, 0, 0x8000, 0x7FFF, 0x4000, 0}),
       {-1, -1, half16, 1, -1, half16, -1, 1, half16}},
      {Format::kR16G16Unorm,
       "R16G16_UNORM",
       bytes_of<uint16_t>({0, 0, 0xFFFF, 0, 0, 0x8000}),
       {0, 0, 0, 1, 0, 0, 0, 32768 / 65535.0f, 0}},
      {Format::kR10G10B10A2Unorm,
       "R10G10B10A2_UNORM",
       bytes_of<uint32_t>({0x200u << 20, 0x3FFu | 0x200u << 20, 0x3FFu << 10 | 0x200u << 20}),
       {0, 0, 512 / 1023.0f, 1, 0, 512 / 1023.0f, 0, 1, 512 / 1023.0f}},
      {Format::kR8G8Unorm,
       "R8G8_UNORM",
       {0, 0, 0xFF, 0, 0, 0x80},
       {0, 0, 0, 1, 0, 0, 0, 128 / 255.0f, 0}},
      {Format::kR8G8B8A8Unorm,
       "R8G8B8A8_UNORM",
       {0, 0, 0x80, 0, 0xFF, 0, 0x80, 0, 0, 0xFF, 0x80, 0},
       {0, 0, 128 / 255.0f, 1, 0, 128 / 255.0f, 0, 1, 128 / 255.0f}},
      {Format::kR8G8Snorm,
       "R8G8_SNORM",
       {0x80, 0x81, 0x7F, 0x80, 0x80, 0x40},
       {-1, -1, 0, 1, -1, 0, -1, half8, 0}},
      {Format::kR8G8B8A8Snorm,
       "R8G8B8A8_SNORM",
       {0x80, 0x80, 0x40, 0, 0x7F, 0x80, 0x40, 0, 0x80, 0x7F, 0x40, 0},
       {-1, -1, half8, 1, -1, half8, -1, 1, half8}}};
  for (const FormatCase& one : cases) {
    Inputs inputs = bottom_inputs(t, {geometry_of({odd_triangle(0)})}, kAccess);
    auto& triangles = inputs.geometries[0].Triangles;
    triangles.VertexFormat = one.format;
    triangles.VertexBuffer = {t.upload(one.bytes).GetGPUVirtualAddress(), one.bytes.size() / 3};
    expect_everywhere(t, one.name, build_new(t, inputs), one.expected);
  }
  // Indexed, with a vertex that nothing uses.
  Inputs inputs = bottom_inputs(t, {geometry_of({odd_triangle(0), odd_triangle(1)})}, kAccess);
  auto& triangles = inputs.geometries[0].Triangles;
  triangles.IndexFormat = Format::kR16Uint;
  triangles.IndexCount = 3;
  triangles.IndexBuffer = t.upload(std::vector<uint16_t>{5, 3, 4}).GetGPUVirtualAddress();
  const Corners second = odd_triangle(1);
  expect_everywhere(t, "indexed", build_new(t, inputs),
                    {second[6], second[7], second[8], second[0], second[1], second[2], second[3],
                     second[4], second[5]});
}

void updates(Context& t) {
  constexpr BuildFlags kFlags = kAccess | BuildFlags::kAllowUpdate;
  const auto inputs = [&](int i) {
    return bottom_inputs(t, {geometry_of({odd_triangle(i)})}, kFlags);
  };
  const Buffer bottom = build_new(t, inputs(0));
  expect_everywhere(t, "before", bottom, odd_triangle(0));
  t.accepted("in place", update(t, inputs(3), bottom, bottom));
  expect_everywhere(t, "in place", bottom, odd_triangle(3));
  const Buffer other = memory_for(t, inputs(0));
  t.accepted("to another place", update(t, inputs(2), other, bottom));
  expect_everywhere(t, "to another place", other, odd_triangle(2));
  expect_everywhere(t, "its source", bottom, odd_triangle(3));
}

void copies(Context& t) {
  const Corners corners = odd_triangle(2);
  const Buffer bottom = build_new(
      t, bottom_inputs(t, {geometry_of({corners})}, kAccess | BuildFlags::kAllowCompaction));
  expect_everywhere(t, "a clone", copy_new(t, bottom, CopyMode::kClone), corners);
  expect_everywhere(t, "a compacted copy", copy_new(t, bottom, CopyMode::kCompact), corners);
  const Buffer saved = copy_new(t, bottom, CopyMode::kSerialize);
  expect_everywhere(t, "a deserialized copy", copy_new(t, saved, CopyMode::kDeserialize), corners);
}

void what_is_no_triangle(Context& t) {
  Geometry one = box(5);
  one.flags = kNonOpaque;
  const Buffer boxes = build_new(t, bottom_inputs(t, {one}, kAccess));
  {
    Positions program(t);
    Ray ray;
    const auto found = program.ask(t.top_level({instance(boxes)}), {ray}, "Boxes")[0];
    for (const Slot slot : {kClosestHit, kCommitted, kObject, kObjectOfQuery, kInvoked}) {
      expect(t, std::string("a box, ") + kNames[slot], found[slot], {});
    }
    // Its attributes are its own.
    t.equal("barycentrics of the box", found[kRay][3], 7.0f);
  }
  {
    Positions program(t);
    Ray ray = ray_at(500);
    const auto found = program.ask(t.top_level({instance(boxes)}), {ray}, "Boxes")[0];
    for (const Slot slot : {kCommitted, kObject, kObjectOfQuery}) {
      expect(t, std::string("a miss, ") + kNames[slot], found[slot], {});
    }
  }
  Positions program(t, "AskOfNothing");
  const auto found = program.ask(t.top_level({instance(boxes)}), {Ray()}, "Boxes")[0];
  expect(t, "MakeNop", found[kObject], {});
  expect(t, "MakeMiss", found[kObjectOfQuery], {});
}

void flags(Context& t) {
  const Corners corners = odd_triangle(1);
  for (uint32_t bits = 0; bits < 32; ++bits) {
    if ((bits & 12) == 12) continue;
    const auto other = static_cast<BuildFlags>(bits);
    expect_everywhere(t, "flags " + std::to_string(bits),
                      build_new(t, bottom_inputs(t, {geometry_of({corners})}, other | kAccess)),
                      corners);
  }
  t.refused(
      "a top level",
      t.device().GetRaytracingAccelerationStructurePrebuildInfo(top_inputs(t, {}, kAccess).desc()),
      "KA0548");
  for (const BuildFlags lost : {BuildFlags::kNone, kAccess}) {
    Context own(t.target());
    const auto inputs = [&](BuildFlags access) {
      return bottom_inputs(own, {geometry_of({corners})}, BuildFlags::kAllowUpdate | access);
    };
    const Buffer bottom = build_new(own, inputs(lost));
    t.refused("an update that changes it",
              update(own, inputs(lost == kAccess ? BuildFlags::kNone : kAccess), bottom, bottom),
              "KA0793");
  }
  DeviceDesc desc = t.target().device_desc();
  desc.ShaderModel = kHighestShaderModel;
  const Device old = CreateDevice(desc).value();
  t.refused("shader model 6.9",
            old.GetRaytracingAccelerationStructurePrebuildInfo(
                bottom_inputs(t, {geometry_of({corners})}, kAccess).desc()),
            "KA0548");
  StateObjectDesc library;
  library.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_top()).value(), {}});
  t.refused("a library of 6.10 there", old.CreateStateObject(library), "KA0544");
}

void no_clusters(Context& t) {
  constexpr uint32_t kInvalid = 0xFFFFFFFF;
  const Buffer top = t.top_level({instance(t.bottom_level({geometry_of({odd_triangle(0)})}))});
  Positions program(t, "AskOfClusters");
  program.scene = top;
  program.rays = t.upload(std::vector<Ray>{towards(odd_triangle(0))});
  t.equal("of the query's candidate, its hit, and its object", std::vector<uint32_t>(3, kInvalid),
          [&] {
            const auto words = program.run(1);
            return std::vector<uint32_t>(words.begin(), words.begin() + 3);
          }());
  Positions traces(t);
  const auto found = traces.ask(
      t.top_level(
          {instance(build_new(t, bottom_inputs(t, {geometry_of({odd_triangle(0)})}, kAccess)))}),
      {towards(odd_triangle(0))})[0];
  t.equal("ClusterID()", std::bit_cast<uint32_t>(found[kRay][5]), kInvalid);
}

}  // namespace

std::vector<RuleTest> top_tests() {
  return {{"TOP-01, TOP-02, TOP-05", every_source},
          {"TOP-03", the_model_and_the_stages},
          {"TOP-04", without_the_flag, "KA0414"},
          {"TOP-06", transforms},
          {"TOP-07", vertex_formats},
          {"TOP-08", updates},
          {"TOP-09", copies},
          {"TOP-10", what_is_no_triangle, "KA0413"},
          {"TOP-12", flags},
          {"CLS-43, CLS-44, CLS-45", no_clusters}};
}

}  // namespace kaamos::conformance
