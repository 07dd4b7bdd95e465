// SPDX-License-Identifier: MIT
//
// System values, payloads, recursion, callables, the grid: rules SV-nn, PAY-nn, SO-4n, DSP-nn.
#include <gtest/gtest.h>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

TEST(Sv03And04, RayValuesAreBitEqualAndMatricesAreTheInstances) {
  Harness h;
  h.use_standard_pipeline();
  auto instance = instance_of(h.bottom_level({triangle_at(1)}));
  const float transform[12] = {2, 0, 0.5f, 0.25f, 0, 3, 0, -0.5f, 0, 0, 4, 1};
  std::memcpy(instance.Transform, transform, sizeof(transform));
  auto ray = ray_along_z(h.top_level({instance}), 0.3f, -0.1f);
  ray.ray.direction[0] = 0.01f;
  ray.ray.direction[2] = 1.75f;
  ray.ray.t_min = 0.125f;
  const Payload payload = h.trace(ray);
  ASSERT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(std::memcmp(&payload.values.ray, &ray.ray, sizeof(ray.ray)), 0);
  EXPECT_EQ(std::memcmp(payload.object_to_world, transform, sizeof(transform)), 0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      float product = column == 3 ? payload.world_to_object[4 * row + 3] : 0;
      for (int k = 0; k < 3; ++k) {
        product += payload.world_to_object[4 * row + k] * transform[4 * k + column];
      }
      EXPECT_NEAR(product, row == column ? 1.0f : 0.0f, 1e-6) << row << "," << column;
    }
  }
}

TEST(Sv07, InstanceIndexAndId) {
  Harness h;
  h.use_standard_pipeline();
  auto instance = instance_of(h.bottom_level({triangle_at(3)}));
  instance.InstanceID = 0xFFFFFF;
  instance.InstanceContributionToHitGroupIndex = 3;
  const Payload payload =
      h.trace(ray_along_z(h.top_level({instance_of(0), instance_of(0), instance})));
  EXPECT_EQ(payload.values.instance_index, 2u);
  EXPECT_EQ(payload.values.instance_id, 0xFFFFFFu);
}

TEST(Sv08And09, PrimitiveIndexRestartsInEachGeometry) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput second = triangle_at(5);
  for (Vertex v : triangle_at(3).vertices) second.vertices.push_back({v.x + 10, v.y, v.z});
  const uint64_t scene = h.scene({triangle_at(4), GeometryInput{}, second});
  Payload payload = h.trace(ray_along_z(scene, 10));
  EXPECT_EQ(payload.values.geometry_index, 2u);
  EXPECT_EQ(payload.values.primitive_index, 1u);
  payload = h.trace(ray_along_z(scene, 0));
  EXPECT_EQ(payload.values.geometry_index, 0u);
  EXPECT_EQ(payload.values.primitive_index, 0u);
}

TEST(Sv12, BarycentricsWeighVerticesOneAndTwo) {
  Harness h;
  h.use_standard_pipeline();
  GeometryInput input;
  input.vertices = {{0, 0, 4}, {4, 0, 4}, {0, 8, 4}};
  input.flags = kOpaque;
  const Payload payload = h.trace(ray_along_z(h.scene({input}), 1, 4));
  float uv[2];
  std::memcpy(uv, payload.attributes, 8);
  EXPECT_NEAR(uv[0], 0.25f, 1e-6);
  EXPECT_NEAR(uv[1], 0.5f, 1e-6);
}

// -------------------------------------------------------------------------------------------------
// Recursion

void trace_again(shader::Invocation& invocation, void* data, const void* attributes) {
  auto& payload = *static_cast<Payload*>(data);
  const uint32_t primitive = invocation.ray->primitive_index;
  if (++payload.user < 1000) {
    uint64_t scene;
    std::memcpy(&scene, payload.world_to_object, sizeof(scene));  // stored there by ray generation
    const auto ray = ray_along_z(scene);
    trace_ray(invocation, ray, data);
  }
  EXPECT_EQ(invocation.ray->primitive_index, primitive);
  closest_hit(invocation, data, attributes);
}

struct RecursionJob {
  uint64_t scene;
  Payload* payload;
};

rtapi::Status recurse(Harness& h, uint32_t declared, Payload& payload) {
  PipelineBuilder builder(declared);
  const auto rg = builder.ray_generation([](shader::Invocation& invocation) {
    RecursionJob job;
    std::memcpy(&job, invocation.dispatch->root_arguments, sizeof(job));
    std::memcpy(job.payload->world_to_object, &job.scene, 8);
    trace_ray(invocation, ray_along_z(job.scene), job.payload);
  });
  const auto hit = builder.hit_group(trace_again, nullptr);
  h.set_pipeline(builder, rg);
  h.set_hit_table({{hit, 0}});
  const RecursionJob job = {h.scene({triangle_at(3)}), &payload};
  return h.dispatch(1, 1, 1, &job, sizeof(job));
}

TEST(So47, TraceRayAtTheDeclaredDepthRemovesTheDevice) {
  for (const uint32_t declared : {0u, 1u, 5u, 31u}) {
    Harness h;
    Payload payload;
    const rtapi::Status status = recurse(h, declared, payload);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().id.text(), "KA0890");
    EXPECT_EQ(status.error().code, rtapi::ErrorCode::kDeviceRemoved);
    EXPECT_NE(status.error().message.find("MaxTraceRecursionDepth " + std::to_string(declared)),
              std::string::npos)
        << status.error().message;
    // Shaders ran at all allowed depths.
    EXPECT_EQ(payload.user, declared);
  }
}

TEST(So47, DepthCountsFromRayGeneration) {
  Harness h;
  Payload payload;
  payload.user = 1000 - 3;  // three more traces
  ASSERT_TRUE(recurse(h, 3, payload).ok());
  EXPECT_EQ(payload.calls, 3u);
  EXPECT_EQ(payload.depth, 1u);  // the outermost closest-hit shader ends last
}

struct CallJob {
  uint32_t remaining;
  uint32_t calls;
  uint32_t index[3];
};

void call_again(shader::Invocation& invocation, void* data) {
  auto& job = *static_cast<CallJob*>(data);
  ++job.calls;
  std::memcpy(job.index, invocation.index, sizeof(job.index));
  EXPECT_EQ(invocation.ray, nullptr);
  if (job.remaining-- > 1) {
    CallJob copy = job;
    invocation.dispatch->services->call_shader(invocation, 2, &copy, sizeof(copy));
    job = copy;
  }
}

rtapi::Status call(Harness& h, CallJob& job, uint64_t stack_bytes_each = 0) {
  PipelineBuilder builder(1);
  const auto rg = builder.ray_generation([](shader::Invocation& invocation) {
    CallJob* data;
    std::memcpy(&data, invocation.dispatch->root_arguments, sizeof(data));
    if (invocation.index[0] == 1) {
      invocation.dispatch->services->call_shader(invocation, 2, data, sizeof(*data));
    }
  });
  const auto callable = builder.callable(call_again, stack_bytes_each);
  h.set_pipeline(builder, rg);
  h.set_callable_table({{kNullIdentifier, 0}, {kNullIdentifier, 0}, {callable, 0}});
  CallJob* root = &job;
  return h.dispatch(2, 1, 1, &root, sizeof(root));
}

TEST(So48, CallShaderDoesNotCountAsRecursion) {
  Harness h;
  CallJob job = {40, 0, {9, 9, 9}};
  ASSERT_TRUE(call(h, job).ok());
  EXPECT_EQ(job.calls, 40u);
  EXPECT_EQ(job.index[0], 1u);  // SV-02
  EXPECT_EQ(job.index[1], 0u);
}

TEST(So46, AFullPipelineStackRemovesTheDevice) {
  Harness h;
  h.set_pipeline_stack_bytes(1000);
  CallJob job = {10, 0, {}};
  EXPECT_TRUE(call(h, job, 100).ok());
  job = {11, 0, {}};
  const auto status = call(h, job, 100);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0891");
  EXPECT_NE(status.error().message.find("the shader stack is used up"), std::string::npos);
  // The device of this harness still works: only rtapi refuses calls after a removal.
  job = {10, 0, {}};
  EXPECT_TRUE(call(h, job, 100).ok());
}

TEST(Pay06, ChangesByIgnoredAnyHitShadersPersist) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore);
  const Payload payload = h.trace(ray_along_z(
      h.scene({triangle_at(1, kNonOpaque), triangle_at(2, kNonOpaque), triangle_at(3, kOpaque)})));
  EXPECT_EQ(payload.any_hits, 2u);
  EXPECT_EQ(payload.end, End::kClosestHit);
}

TEST(Pay07AndFlg36AndRoot19, ANestedTraceHasItsOwnPayloadFlagsAndRecord) {
  Harness h;
  PipelineBuilder builder(2);
  const auto rg = builder.ray_generation(trace_job);
  const auto outer = builder.hit_group(
      [](shader::Invocation& invocation, void* data, const void* attributes) {
        Payload inner;
        auto ray = ray_along_z(0);
        ray.ray_flags = 1;
        ray.miss_shader_index = 1;
        trace_ray(invocation, ray, &inner);
        EXPECT_EQ(inner.end, End::kMiss);
        EXPECT_EQ(inner.record, 501u);
        EXPECT_EQ(inner.values.ray_flags, 1u);
        EXPECT_EQ(inner.depth, 2u);
        EXPECT_EQ(static_cast<Payload*>(data)->calls, 0u);
        closest_hit(invocation, data, attributes);
      },
      nullptr);
  const auto missed = builder.miss(miss);
  h.set_pipeline(builder, rg);
  h.set_hit_table({{outer, 400}});
  h.set_miss_table({{missed, 500}, {missed, 501}});
  auto ray = ray_along_z(h.scene({triangle_at(3)}));
  ray.ray_flags = 2;
  const Payload payload = h.trace(ray);
  EXPECT_EQ(payload.end, End::kClosestHit);
  EXPECT_EQ(payload.record, 400u);
  EXPECT_EQ(payload.values.ray_flags, 2u);
  EXPECT_EQ(payload.depth, 1u);
}

// -------------------------------------------------------------------------------------------------
// The grid

void count_cell(shader::Invocation& invocation) {
  uint32_t* cells;
  std::memcpy(&cells, invocation.dispatch->root_arguments, sizeof(cells));
  const uint32_t* size = invocation.dispatch->dimensions;
  ++cells[(uint64_t{invocation.index[2]} * size[1] + invocation.index[1]) * size[0] +
          invocation.index[0]];
}

TEST(Dsp02And03, EachCellRunsOnce) {
  Harness h(2);
  PipelineBuilder builder;
  const auto rg = builder.ray_generation(count_cell);
  h.set_pipeline(builder, rg);
  const uint32_t sizes[][3] = {{1, 1, 1},    {17, 33, 1}, {1000, 1, 1}, {1, 777, 1}, {3, 5, 70},
                               {1, 1, 1000}, {300, 2, 3}, {0, 5, 5},    {5, 0, 1},   {4, 4, 0}};
  for (const auto& size : sizes) {
    std::vector<uint32_t> cells(size_t{size[0]} * size[1] * size[2] + 1, 0);
    const uint32_t* root = cells.data();
    ASSERT_TRUE(h.dispatch(size[0], size[1], size[2], &root, sizeof(root)).ok());
    for (size_t i = 0; i + 1 < cells.size(); ++i) ASSERT_EQ(cells[i], 1u) << size[0] << " " << i;
    EXPECT_EQ(cells.back(), 0u);
  }
}

}  // namespace
}  // namespace kaamos::embree::testing
