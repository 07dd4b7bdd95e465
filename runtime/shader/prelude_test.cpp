// SPDX-License-Identifier: MIT
//
// The forms that the C++ emitter prints, run against a backend that records its calls.
#include "kaamos/shader/prelude.h"

#include "runtime/shader/test_values.h"

namespace ks = kaamos::shader;

namespace {

struct Asked {
  ks::TraceRayArguments trace = {};
  ks::RayLanes origin_t_min = {};
  ks::RayLanes direction_t_max = {};
  ks::SampleArguments sample = {};
  int32_t coordinates[4] = {};
  ks::Texel stored = {};
  ks::ReportHitResult answer = ks::ReportHitResult::kRejected;
};
Asked asked;

ks::Texel texel(float r, float g, float b, float a) {
  return {{ks::asuint(r), ks::asuint(g), ks::asuint(b), ks::asuint(a)}};
}

const ks::Services kServices = [] {
  ks::Services s = {};
  s.trace_ray = [](ks::Invocation&, const ks::TraceRayArguments& a, void* payload,
                   ks::RayLanes origin_t_min, ks::RayLanes direction_t_max) {
    asked.trace = a;
    asked.origin_t_min = origin_t_min;
    asked.direction_t_max = direction_t_max;
    *static_cast<float*>(payload) = 42;
  };
  s.report_hit = [](ks::Invocation&, float, uint32_t, const void*, uint32_t) {
    return asked.answer;
  };
  s.call_shader = [](ks::Invocation&, uint32_t index, void* data, uint32_t bytes) {
    *static_cast<uint32_t*>(data) = index * 100 + bytes;
  };
  s.sample_level = [](const ks::SampleArguments& a) {
    asked.sample = a;
    return texel(1, 2, 3, 4);
  };
  s.sample_gradient = s.sample_level;
  s.gather = s.sample_level;
  s.gather_compare = s.sample_level;
  s.sample_compare_level = [](const ks::SampleArguments& a) {
    asked.sample = a;
    return 0.25f;
  };
  s.load_texel = [](const ks::Descriptor&, const int32_t c[4]) {
    for (int i = 0; i < 4; ++i) asked.coordinates[i] = c[i];
    return ks::Texel{{0xFFFFFFFFu, 2, 3, 4}};
  };
  s.store_texel = [](const ks::Descriptor&, const int32_t c[4], const ks::Texel& value) {
    for (int i = 0; i < 4; ++i) asked.coordinates[i] = c[i];
    asked.stored = value;
  };
  s.texture_dimensions = [](const ks::Descriptor&, uint32_t mip) {
    return ks::TextureDimensions{256u >> mip, 128u >> mip, 1, 9};
  };
  return s;
}();

struct Ray {
  ks::float3 origin;
  float t_min;
  ks::float3 direction;
  float t_max;
};
struct Payload {
  float value;
  uint32_t more;
};

struct ShaderPrelude : testing::Test {
  ks::DispatchConstants dispatch;
  ks::Invocation invocation;
  ks::Descriptor texture, sampler;
  ShaderPrelude() {
    asked = {};
    dispatch.services = &kServices;
    invocation.dispatch = &dispatch;
    texture.kind = ks::DescriptorKind::kTexture;
  }
};

TEST_F(ShaderPrelude, TraceRayMasksItsArguments) {
  ks::Descriptor scene;
  scene.kind = ks::DescriptorKind::kAccelerationStructure;
  scene.address = 0x1234;
  Payload payload = {};
  const Ray ray{ks::float3{1, 2, 3}, 4, ks::float3{5, 6, 7}, 8};
  ks::trace_ray(invocation, scene, 5u, 0x1FFu, 0x13u, 0x25u, 0x30007u, ray, payload);
  EXPECT_EQ(asked.trace.acceleration_structure, 0x1234u);
  EXPECT_EQ(asked.trace.instance_inclusion_mask, 0xFFu);
  EXPECT_EQ(asked.trace.ray_contribution_to_hit_group_index, 3u);
  EXPECT_EQ(asked.trace.multiplier_for_geometry_contribution, 5u);
  EXPECT_EQ(asked.trace.miss_shader_index, 7u);
  EXPECT_EQ(asked.trace.payload_bytes, sizeof(Payload));
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(asked.origin_t_min[i], static_cast<float>(1 + i));
    EXPECT_EQ(asked.direction_t_max[i], static_cast<float>(5 + i));
  }
  EXPECT_EQ(payload.value, 42.0f);
  ks::trace_ray(invocation, texture, 0u, 0u, 0u, 0u, 0u, ray, payload);
  EXPECT_EQ(asked.trace.acceleration_structure, 0u);
}

TEST_F(ShaderPrelude, ReportHitEndsTheShaderOnEndSearchOnly) {
  bool ended = false;
  EXPECT_FALSE(ks::report_hit(invocation, ended, 1.0f, 0u, ks::float2{}));
  asked.answer = ks::ReportHitResult::kAccepted;
  EXPECT_TRUE(ks::report_hit(invocation, ended, 1.0f, 0u, ks::float2{}));
  EXPECT_FALSE(ended);
  asked.answer = ks::ReportHitResult::kEndSearch;
  EXPECT_TRUE(ks::report_hit(invocation, ended, 1.0f, 0u, ks::float2{}));
  EXPECT_TRUE(ended);
}

TEST_F(ShaderPrelude, CallShaderPassesTheDatasSize) {
  uint32_t data[3] = {};
  ks::call_shader(invocation, 7u, data);
  EXPECT_EQ(data[0], 712u);
}

TEST_F(ShaderPrelude, SamplesPassWhatWasWritten) {
  const auto c = ks::sample_level<ks::float4>(invocation, texture, sampler, ks::float2{0.25f, 0.5f},
                                              3.0f, ks::int2{1, -2});
  ks::expect_components(c, {1, 2, 3, 4});
  EXPECT_EQ(asked.sample.texture, &texture);
  EXPECT_EQ(asked.sample.coordinates[1], 0.5f);
  EXPECT_EQ(asked.sample.coordinates[2], 0.0f);
  EXPECT_EQ(asked.sample.lod, 3.0f);
  EXPECT_EQ(asked.sample.offset[1], -2);
  ks::expect_components(
      ks::sample_gradient<ks::half2>(invocation, texture, sampler, ks::float3{1, 2, 3},
                                     ks::float3{4, 5, 6}, ks::float3{7, 8, 9}),
      {1, 2});
  EXPECT_EQ(asked.sample.ddx[2], 6.0f);
  EXPECT_EQ(asked.sample.ddy[0], 7.0f);
  EXPECT_EQ(ks::sample_compare_level<float>(invocation, texture, sampler, ks::float2{}, 0.5f, 1.0f),
            0.25f);
  EXPECT_EQ(asked.sample.comparison, 0.5f);
  EXPECT_EQ(asked.sample.lod, 1.0f);
  ks::gather<ks::float4>(invocation, texture, sampler, ks::float2{}, 2u);
  EXPECT_EQ(asked.sample.component, 2u);
  ks::gather_compare<ks::float4>(invocation, texture, sampler, ks::float2{}, 0.75f, 3);
  EXPECT_EQ(asked.sample.comparison, 0.75f);
  EXPECT_EQ(asked.sample.offset[0], 3);
}

TEST_F(ShaderPrelude, TexelsConvertToTheirHlslType) {
  const auto at = ks::texel_coordinates(ks::uint2{3, 4}, 5, ks::int2{-1, 10});
  ks::expect_components(at, {2, 14, 0, 5});
  ks::expect_components(ks::texel_coordinates_1d_array(ks::int2{3, 4}, 0), {3, 0, 4, 0});
  ks::expect_components(ks::texel_coordinates(7u, 0), {7, 0, 0, 0});
  ks::expect_components(ks::load_texel<ks::int2>(invocation, texture, at), {-1, 2});
  ks::expect_components(ks::load_texel<ks::uint2>(invocation, texture, at), {4294967295.0, 2});
  EXPECT_EQ(asked.coordinates[1], 14);
  ks::store_texel(invocation, texture, at, ks::float2{1.5f, 2});
  EXPECT_EQ(asked.stored.bits[0], ks::asuint(1.5f));
  EXPECT_EQ(asked.stored.bits[2], 0u);
  ks::store_texel(invocation, texture, at, ks::half{0x3C00});
  EXPECT_EQ(asked.stored.bits[0], ks::asuint(1.0f));
  ks::store_texel(invocation, texture, at, int16_t{-1});
  EXPECT_EQ(asked.stored.bits[0], 0xFFFFFFFFu);
}

TEST_F(ShaderPrelude, DimensionsByKind) {
  ks::expect_components(ks::dimensions(invocation, texture, 2u), {64, 32, 1, 9});
  ks::Descriptor buffer;
  ks::expect_components(ks::dimensions(invocation, buffer, 0u), {0, 0, 0, 0});
  buffer.kind = ks::DescriptorKind::kStructuredBuffer;
  buffer.stride_bytes = 12;
  buffer.size_bytes = 120;
  ks::expect_components(ks::dimensions(invocation, buffer, 0u), {10, 12, 0, 0});
  buffer.kind = ks::DescriptorKind::kRawBuffer;
  EXPECT_EQ(ks::dimensions(invocation, buffer, 0u)[0], 120u);
  buffer.size_bytes = ~uint64_t{0};
  EXPECT_EQ(ks::dimensions(invocation, buffer, 0u)[0], 0xFFFFFFFFu);
}

}  // namespace
