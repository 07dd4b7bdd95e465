// SPDX-License-Identifier: MIT
// The shared HLSL compiled as C++, with GLM in place of HLSL's vectors. Every function must return
// the values of its twin on the host, and every struct must have the layout of its twin.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <vector>

#include "effects/assets/common/blue_noise.h"
#include "effects/assets/common/ray_origin.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/common/sobol.h"
#include "effects/assets/scene/material.h"
#include "effects/assets/scene/mesh.h"
#include "effects/assets/scene/scene.h"
#include "effects/assets/scene/shapes.h"

namespace hlsl {

using uint = std::uint32_t;
using uint2 = glm::uvec2;
using uint3 = glm::uvec3;
using uint4 = glm::uvec4;
using float2 = glm::vec2;
using float3 = glm::vec3;
using float4 = glm::vec4;
using glm::abs;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::max;
using glm::min;
using glm::normalize;
using std::cos;
using std::sin;
using std::sqrt;

float3 lerp(const float3& a, const float3& b, float t) {
  return glm::mix(a, b, t);
}
uint reversebits(uint x) {
  return kaamos::effects::reverse_bits(x);
}
uint asuint(float x) {
  return std::bit_cast<uint>(x);
}
float asfloat(uint bits) {
  return std::bit_cast<float>(bits);
}

template <glm::length_t N>
glm::vec<N, float> asfloat(const glm::vec<N, uint>& bits) {
  glm::vec<N, float> out;
  std::memcpy(&out, &bits, sizeof out);
  return out;
}

/// The rows of HLSL's floatRxC.
struct float3x3 {
  std::array<float3, 3> rows;
};
struct float3x4 {
  std::array<float4, 3> rows;
  const float4& operator[](std::size_t row) const { return rows[row]; }
  explicit operator float3x3() const {
    return {{float3(rows[0]), float3(rows[1]), float3(rows[2])}};
  }
};
float3x3 abs(const float3x3& m) {
  return {{abs(m.rows[0]), abs(m.rows[1]), abs(m.rows[2])}};
}
float3x4 abs(const float3x4& m) {
  return {{abs(m.rows[0]), abs(m.rows[1]), abs(m.rows[2])}};
}
float3 mul(const float3x3& m, const float3& v) {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}
float3 mul(const float3x4& m, const float4& v) {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}
float3 mul(const float3& v, const float3x3& m) {
  return m.rows[0] * v.x + m.rows[1] * v.y + m.rows[2] * v.z;
}

/// Reads past the end return 0, as through a view.
class ByteAddressBuffer {
 public:
  ByteAddressBuffer(const void* data, std::size_t size)
      : data_(static_cast<const std::uint8_t*>(data)), size_(size) {}
  uint Load(uint offset) const {
    uint word = 0;
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + 4, size_) << "a root SRV has no bounds check";
    if (offset + 4 <= size_) std::memcpy(&word, data_ + offset, 4);
    return word;
  }
  uint2 Load2(uint offset) const { return {Load(offset), Load(offset + 4)}; }
  uint3 Load3(uint offset) const { return uint3(Load2(offset), Load(offset + 8)); }
  uint4 Load4(uint offset) const { return uint4(Load3(offset), Load(offset + 12)); }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

#define precise
#include "effects/shaders/geometry.hlsli"
#include "effects/shaders/material.hlsli"
#include "effects/shaders/sampling.hlsli"
#include "effects/shaders/sky.hlsli"
#undef precise

}  // namespace hlsl

namespace kaamos::effects {
namespace {

TEST(HlslMirror, RandomNumbersAndSobolPoints) {
  EXPECT_EQ(hlsl::kBlueNoiseSize, kBlueNoiseSize);
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const std::uint32_t a = pcg_hash(i), b = pcg_hash(a);
    ASSERT_EQ(hlsl::PcgHash(i), a);
    ASSERT_EQ(hlsl::HashCombine(a, b), hash_combine(a, b));
    ASSERT_EQ(hlsl::UnitFloat(a), unit_float(a));
    ASSERT_EQ(hlsl::Sobol0(a), sobol_0(a));
    ASSERT_EQ(hlsl::Sobol1(a), sobol_1(a));
    ASSERT_EQ(hlsl::OwenScramble(a, b), owen_scramble(a, b));
    ASSERT_EQ(hlsl::SobolOwen(i, b), sobol_owen(i, b));
  }
}

TEST(HlslMirror, PixelSamples) {
  const std::vector<glm::vec2>& tile = blue_noise_tile();
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const std::uint32_t h = pcg_hash(i), x = h & 4095, y = h >> 20, pair = i % 4, seed = i / 64;
    const std::uint32_t at = hlsl::BlueNoiseIndex({x, y}, pair, seed);
    ASSERT_LT(at, tile.size());
    ASSERT_EQ(hlsl::PixelSample(tile[at], i, pair, seed), pixel_sample(x, y, i, pair, seed));
  }
}

TEST(HlslMirror, Directions) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const glm::vec2 u = sobol_owen(i, 1);
    const glm::vec3 n =
        to_world(sample_cosine_hemisphere(sobol_owen(i, 2)), {0, 0, i & 1 ? 1 : -1});
    const glm::vec3 local = sample_cosine_hemisphere(u);
    ASSERT_EQ(hlsl::SampleDisk(u), sample_disk(u));
    ASSERT_EQ(hlsl::SampleCosineHemisphere(u), local);
    ASSERT_EQ(hlsl::ToWorld(local, n), to_world(local, n));
    ASSERT_EQ(hlsl::SampleSun(u, n, 0.01f), sample_sun(u, n, 0.01f));
  }
}

TEST(HlslMirror, RayOrigins) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto r = [&](std::uint32_t k) { return unit_float(hash_combine(i, k)) * 2.0f - 1.0f; };
    const glm::vec3 a(r(0), r(1), r(2)), b(r(3), r(4), r(5)), c(r(6), r(7), r(8));
    Instance instance;
    instance.transform = translate({r(9) * 100.0, r(10), r(11)}) * rotate_y(r(12) * 3.0) *
                         glm::dmat4(glm::dmat3(0.1 + r(13) * r(13)));
    const glm::mat3x4 to = transform_3x4(instance);
    instance.transform = glm::inverse(instance.transform);
    const glm::mat3x4 back = transform_3x4(instance);
    const glm::vec2 bary(0.3f, 0.25f);
    const SpawnPoint host = make_spawn_point(a, b, c, bary, to, back);
    const hlsl::SpawnPoint shader =
        hlsl::MakeSpawnPoint(a, b, c, bary, {{to[0], to[1], to[2]}}, {{back[0], back[1], back[2]}});
    ASSERT_EQ(shader.position, host.position);
    ASSERT_NEAR(glm::distance(shader.normal, host.normal), 0.0f, 1e-6f);
    // The terms of the bound may be added in another order.
    ASSERT_NEAR(shader.offset, host.offset, 1e-5f * host.offset);
    const glm::vec3 d(r(14), r(15), r(16));
    ASSERT_NEAR(glm::distance(hlsl::SpawnOrigin(shader, d), spawn_origin(host, d)), 0.0f,
                1e-2f * host.offset);
  }
}

TEST(HlslMirror, TrianglesAndAttributes) {
  Mesh mesh;
  for (const std::uint32_t count : {5u, 70000u}) {
    std::vector<Vertex> vertices(count);
    for (std::uint32_t v = 0; v < count; ++v) {
      vertices[v].position = glm::vec3(static_cast<float>(v), 1, 2);
      vertices[v].normal = glm::vec3(3, static_cast<float>(v), 5);
      vertices[v].tangent = glm::vec4(6, 7, 8, static_cast<float>(v));
      vertices[v].uv = glm::vec2(static_cast<float>(v), 9);
    }
    // With an odd number of triangles, the last 16-bit one ends in the middle of a word.
    const std::vector<std::uint32_t> indices = {0, 1, 2, 4, 3, 2, count - 1, 0, 4};
    mesh.add_geometry(vertices, indices, 0, false);
  }
  for (const Geometry& g : mesh.geometries) {
    const std::size_t index_bytes = (std::size_t{g.index_count} * g.index_size_bytes + 3) / 4 * 4;
    const hlsl::ByteAddressBuffer indices(mesh.indices.data() + g.index_offset_bytes, index_bytes);
    const hlsl::ByteAddressBuffer vertices(mesh.vertices.data() + g.first_vertex,
                                           g.vertex_count * sizeof(Vertex));
    HitConstants constants;
    constants.index_size_bytes = g.index_size_bytes;
    hlsl::HitConstants hit;
    static_assert(sizeof hit == sizeof constants);
    std::memcpy(&hit, &constants, sizeof hit);
    for (std::uint32_t t = 0; t < 3; ++t) {
      const hlsl::uint3 triangle = hlsl::LoadTriangle(indices, hit.index_size_bytes, t);
      for (std::uint32_t k = 0; k < 3; ++k)
        EXPECT_EQ(triangle[static_cast<int>(k)], mesh.index(g, 3 * t + k));
      const glm::vec2 corner(0, 1);
      const Vertex& expected = mesh.corner(g, t, 2);
      EXPECT_EQ(hlsl::LoadUv(vertices, hit, triangle, corner), expected.uv);
      EXPECT_EQ(hlsl::LoadNormal(vertices, hit, triangle, corner), expected.normal);
      EXPECT_EQ(hlsl::LoadTangent(vertices, hit, triangle, corner), expected.tangent);
      EXPECT_EQ(hlsl::LoadVertexFloat3(vertices, hit.vertex_stride, 0, triangle.z),
                expected.position);
    }
  }
}

// A vertex with a colour is a Vertex, its VertexColor and a rest.
TEST(HlslMirror, VertexColors) {
  struct ColoredVertex {
    Vertex vertex;
    VertexColor color;
    std::uint32_t rest[2];
  };
  static_assert(sizeof(ColoredVertex) == kColoredVertexStride);
  static_assert(offsetof(hlsl::HitConstants, color_offset) == offsetof(HitConstants, color_offset));
  std::vector<ColoredVertex> all(3);
  all[0].color = {65535, 0, 13107, 65535};
  all[1].color = {0, 65535, 13107, 65535};
  all[2].color = {0, 0, 13107, 0};
  const hlsl::ByteAddressBuffer vertices(all.data(), all.size() * sizeof(ColoredVertex));
  hlsl::HitConstants hit = {};
  hit.vertex_stride = kColoredVertexStride;
  hit.color_offset = sizeof(Vertex);
  EXPECT_EQ(hlsl::LoadColor(vertices, hit, {0, 1, 2}, {1, 0}), glm::vec4(0, 1, 0.2f, 1));
  const glm::vec4 mixed = hlsl::LoadColor(vertices, hit, {0, 1, 2}, {0.25f, 0.25f});
  EXPECT_LT(glm::distance(mixed, glm::vec4(0.5f, 0.25f, 0.2f, 0.75f)), 1e-6f);
}

TEST(HlslMirror, SkyRadiance) {
  const Sky sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.8f, 0.9f}, {0.3f, 0.2f, 0.1f}};
  for (std::uint32_t i = 0; i < 1000; ++i) {
    glm::vec3 d = sample_cosine_hemisphere(sobol_owen(i, 1));
    d = glm::vec3(d.x, i & 1 ? d.z : -d.z, d.y);
    ASSERT_EQ(hlsl::SkyRadiance(sky.zenith, sky.horizon, sky.ground, d), sky_radiance(sky, d));
  }
  EXPECT_EQ(sky_radiance(sky, {0, 1, 0}), sky.zenith);
  EXPECT_EQ(sky_radiance(sky, {1, 0, 0}), sky.horizon);
  EXPECT_EQ(sky_radiance(sky, {0, -1, 0}), sky.ground);
}

TEST(HlslMirror, MaterialLayout) {
  using Shader = hlsl::MaterialConstants;
  static_assert(sizeof(Shader) == sizeof(MaterialConstants));
  static_assert(offsetof(Shader, emissive) == offsetof(MaterialConstants, emissive));
  static_assert(offsetof(Shader, metallic) == offsetof(MaterialConstants, metallic));
  static_assert(offsetof(Shader, roughness) == offsetof(MaterialConstants, roughness));
  static_assert(offsetof(Shader, alpha_cutoff) == offsetof(MaterialConstants, alpha_cutoff));
  static_assert(offsetof(Shader, normal_scale) == offsetof(MaterialConstants, normal_scale));
  static_assert(offsetof(Shader, flags) == offsetof(MaterialConstants, flags));
  static_assert(offsetof(Shader, image) == offsetof(MaterialConstants, image));
  static_assert(offsetof(Shader, sampler_id) == offsetof(MaterialConstants, sampler));
  static_assert(offsetof(Shader, uv_matrix) == offsetof(MaterialConstants, uv_matrix));
  static_assert(offsetof(Shader, uv_offset) == offsetof(MaterialConstants, uv_offset));
  static_assert(offsetof(Shader, one_texel_level) == offsetof(MaterialConstants, one_texel_level));
  EXPECT_EQ(hlsl::kBaseColorTexture, kBaseColorTexture);
  EXPECT_EQ(hlsl::kMetallicRoughnessTexture, kMetallicRoughnessTexture);
  EXPECT_EQ(hlsl::kNormalTexture, kNormalTexture);
  EXPECT_EQ(hlsl::kEmissiveTexture, kEmissiveTexture);
  EXPECT_EQ(hlsl::kMaterialMask, kMaterialMask);
  EXPECT_EQ(hlsl::kMaterialBlend, kMaterialBlend);
  EXPECT_EQ(hlsl::kMaterialDoubleSided, kMaterialDoubleSided);
  EXPECT_EQ(hlsl::kMaterialAlphaTested, kMaterialAlphaTested);
  EXPECT_EQ(hlsl::kMaterialUnlit, kMaterialUnlit);
  EXPECT_EQ(hlsl::kNoTexture, kNoTexture);
}

TEST(HlslMirror, MaterialFunctions) {
  hlsl::MaterialConstants m = {};
  m.base_color = glm::vec4(1, 1, 1, 0.5f);
  m.alpha_cutoff = 0.4f;
  m.uv_matrix[2] = glm::vec4(0, 3, -2, 0);
  m.uv_offset[2] = glm::vec2(0.25f, 0.5f);
  EXPECT_EQ(hlsl::MaterialUv(m, 2, {1, 10}), glm::vec2(30.25f, -1.5f));
  EXPECT_FALSE(hlsl::IsOpen(m, 0.0f)) << "not alpha tested";
  m.flags = kMaterialAlphaTested;
  EXPECT_TRUE(hlsl::IsOpen(m, 0.79f));
  EXPECT_FALSE(hlsl::IsOpen(m, 0.81f));
  const glm::vec3 n(0, 0, 1), t(1, 0, 0);
  EXPECT_EQ(hlsl::ApplyNormalTexture({0.5f, 0.5f, 1.0f}, 1.0f, n, t, 1.0f), n);
  const glm::vec3 up = hlsl::ApplyNormalTexture({0.5f, 1.0f, 0.5f}, 1.0f, n, t, 1.0f);
  EXPECT_NEAR(up.y, 1.0f, 1e-6f);
  const glm::vec3 down = hlsl::ApplyNormalTexture({0.5f, 1.0f, 0.5f}, 1.0f, n, t, -1.0f);
  EXPECT_NEAR(down.y, -1.0f, 1e-6f);
}

}  // namespace
}  // namespace kaamos::effects
