// SPDX-License-Identifier: MIT
//
// A backend device with shaders written in C++ against the shader ABI. The tests of this folder and
// the conformance tests run on it, without a compiler and without the API layer of rtapi.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "runtime/backend/backend.h"

namespace kaamos::embree::testing {

// -------------------------------------------------------------------------------------------------
// Shaders: they write what happened to a ray into its payload.

inline constexpr uint32_t kSentinel = 0xDEADBEEF;

enum class End : uint32_t { kNothing = 0, kClosestHit = 1, kMiss = 2 };

struct Payload {
  End end = End::kNothing;
  uint32_t calls = 0;           // number of closest-hit and miss shaders
  uint32_t record = kSentinel;  // root constant from the record of the last one
  shader::RaySystemValues values = {};
  float object_to_world[12] = {};
  float world_to_object[12] = {};
  uint32_t attributes[8] = {};
  uint32_t depth = 0;
  uint32_t any_hits = 0;  // any-hit calls
  uint32_t any_hit_record = kSentinel;
  uint32_t any_hit_kind = 0;
  float any_hit_t = 0;
  float smallest_any_hit_t = 1e30f;
  uint32_t any_hit_primitives = 0;  // bit i: an any-hit shader ran for primitive i
  uint32_t user = 0;
};

// These store the system values and the record's constant.
void closest_hit(shader::Invocation& invocation, void* payload, const void* attributes);
void miss(shader::Invocation& invocation, void* payload);
// These count, and answer as their name says.
shader::AnyHitResult any_hit_accept(shader::Invocation&, void* payload, const void*);
shader::AnyHitResult any_hit_ignore(shader::Invocation&, void* payload, const void*);
shader::AnyHitResult any_hit_end(shader::Invocation&, void* payload, const void*);

// Reports Scene::reports in order and stores the answers. One thread only.
struct Report {
  float t;
  uint32_t hit_kind = 0;
  uint32_t attributes[8] = {};
};
struct ReportLog {
  std::vector<Report> reports;
  std::vector<shader::ReportHitResult> results;
  std::vector<float> t_current;  // RayTCurrent after each report
  uint32_t calls = 0;
  std::vector<uint32_t> primitives;
};
ReportLog& report_log();
void report_all(shader::Invocation& invocation);

// -------------------------------------------------------------------------------------------------
// Pipelines and tables

// Builds a linked pipeline by hand.
class PipelineBuilder {
 public:
  explicit PipelineBuilder(uint32_t max_recursion_depth = 1);
  rtapi::ShaderIdentifier ray_generation(shader::RayGenerationFn entry);
  rtapi::ShaderIdentifier miss(shader::MissFn entry);
  rtapi::ShaderIdentifier callable(shader::CallableFn entry, uint64_t stack_bytes = 0);
  // Null functions are absent; with an intersection shader it becomes a procedural group.
  rtapi::ShaderIdentifier hit_group(shader::ClosestHitFn closest_hit, shader::AnyHitFn any_hit,
                                    shader::IntersectionFn intersection = nullptr);
  void set_flags(rtapi::RaytracingPipelineFlags flags) { pipeline_->flags = flags; }
  std::shared_ptr<const runtime::LinkedPipeline> linked() const { return pipeline_; }

 private:
  const runtime::LinkedShader* add_shader(shader::Stage stage, shader::AnyFn entry,
                                          uint64_t stack_bytes = 0,
                                          shader::RayGenerationRowFn row = nullptr);
  rtapi::ShaderIdentifier add_record(runtime::LinkedRecord record);
  std::shared_ptr<runtime::LinkedPipeline> pipeline_;
};

// One record: an identifier (all zero: NULL) and the constant that follows it.
struct Record {
  rtapi::ShaderIdentifier identifier = {};
  uint32_t constant = 0;
};

inline constexpr rtapi::ShaderIdentifier kNullIdentifier = {};

// -------------------------------------------------------------------------------------------------
// Scenes

struct Vertex {
  float x, y, z;
};

// TraceRay's arguments together with its ray.
struct Ray : shader::TraceRayArguments {
  shader::RayDesc ray;
};

struct GeometryInput {
  std::vector<Vertex> vertices;              // triangles
  std::vector<uint32_t> indices;             // empty: not indexed
  std::vector<rtapi::RaytracingAabb> boxes;  // procedural, unless empty
  rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kNone;
  std::vector<float> transform;  // 12 floats, or empty
};

inline constexpr auto kOpaque = rtapi::RaytracingGeometryFlags::kOpaque;
inline constexpr auto kNonOpaque = rtapi::RaytracingGeometryFlags::kNone;

// Succeeds if a triangle's t, which must be representable as a float, is `expected`: to the bit,
// except within 2 ulps where Embree multiplies by a reciprocal that has an error (robust and fast
// precision, CPUs without AVX-512).
::testing::AssertionResult is_distance(float t, float expected);
::testing::AssertionResult is_distance(float t, float expected,
                                       rtapi::TraversalPrecision precision);

// A triangle that a ray along +z hits at (0, 0, z); clockwise as seen from -z, so a front face.
GeometryInput triangle_at(float z, rtapi::RaytracingGeometryFlags flags = kOpaque);
GeometryInput box_at(float z, rtapi::RaytracingGeometryFlags flags = kOpaque);
rtapi::RaytracingInstanceDesc instance_of(uint64_t bottom_level);
// Along +z from (x, y, 0) with t in (0, 100).
Ray ray_along_z(uint64_t top_level, float x = 0, float y = 0);

// Calls TraceRay as a shader would.
void trace_ray(shader::Invocation& invocation, const Ray& ray, void* payload);

class Harness {
 public:
  // In the precision that KAAMOS_TEST_PRECISION names (fast, robust, exact), by default robust.
  explicit Harness(uint32_t threads = 1);
  Harness(uint32_t threads, rtapi::TraversalPrecision precision);
  ~Harness();

  runtime::BackendDevice& device() { return *device_; }
  runtime::AddressMap& addresses() { return addresses_; }

  // Buffers live as long as the harness, or until free().
  std::shared_ptr<runtime::BackendBuffer> buffer(uint64_t bytes);
  void free(std::shared_ptr<runtime::BackendBuffer>& buffer);
  template <typename T>
  uint64_t upload(const std::vector<T>& values) {
    auto block = buffer(values.empty() ? 1 : values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(block->host(), values.data(), values.size() * sizeof(T));
    return block->address();
  }

  rtapi::RaytracingGeometryDesc geometry(const GeometryInput& input);
  runtime::BuildCommand bottom_level_command(
      const std::vector<GeometryInput>& geometries,
      rtapi::RaytracingAccelerationStructureBuildFlags flags =
          rtapi::RaytracingAccelerationStructureBuildFlags::kNone);
  runtime::BuildCommand top_level_command(
      const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  // These return the address; 0 and a failed expectation if the build fails.
  uint64_t bottom_level(const std::vector<GeometryInput>& geometries,
                        rtapi::RaytracingAccelerationStructureBuildFlags flags =
                            rtapi::RaytracingAccelerationStructureBuildFlags::kNone);
  uint64_t top_level(const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  // A top level with one instance of one bottom level with these geometries.
  uint64_t scene(const std::vector<GeometryInput>& geometries, uint32_t instance_flags = 0);

  // The next dispatches use tables of this pipeline.
  void set_pipeline(const PipelineBuilder& builder, rtapi::ShaderIdentifier ray_generation);
  void set_hit_table(const std::vector<Record>& records, uint64_t stride_bytes = 64);
  void set_miss_table(const std::vector<Record>& records, uint64_t stride_bytes = 64);
  void set_callable_table(const std::vector<Record>& records, uint64_t stride_bytes = 64);
  rtapi::DispatchRaysDesc& desc() { return desc_; }
  void set_pipeline_stack_bytes(uint64_t bytes) { pipeline_stack_bytes_ = bytes; }

  // Runs ray generation with the bytes at `root` as the root arguments.
  rtapi::Status dispatch(uint32_t width, uint32_t height, uint32_t depth, const void* root,
                         size_t root_bytes);

  // The usual pipeline: `closest_hit`, `miss` and this any-hit shader; a table of 64 identical hit
  // groups whose constants are their indices, and 8 miss records with constants of 1000 + index.
  void use_standard_pipeline(shader::AnyHitFn any_hit = nullptr,
                             shader::IntersectionFn intersection = nullptr,
                             uint32_t max_recursion_depth = 1);
  // Traces the rays, one cell each, and returns their payloads.
  std::vector<Payload> trace(const std::vector<Ray>& rays);
  Payload trace(const Ray& ray) { return trace(std::vector{ray}).front(); }

  rtapi::Status execute(runtime::Command command);

  std::vector<rtapi::Message> messages;

 private:
  rtapi::GpuVirtualAddressRangeAndStride table(const std::vector<Record>& records,
                                               uint64_t stride_bytes);
  runtime::AddressMap addresses_;
  runtime::Context context_;
  std::unique_ptr<runtime::BackendDevice> device_;
  std::vector<std::shared_ptr<runtime::BackendBuffer>> buffers_;
  std::shared_ptr<runtime::BackendPipeline> pipeline_;
  rtapi::DispatchRaysDesc desc_;
  uint64_t pipeline_stack_bytes_ = 0;
};

// The ray generation shader of Harness::trace. If KAAMOS_TEST_ROWS is set, the pipelines of
// PipelineBuilder run it through trace_jobs.
void trace_job(shader::Invocation& invocation);
// The same for a row: rays with equal arguments go together, to Services::trace_rays.
void trace_jobs(shader::Invocation& invocation, uint32_t count);

}  // namespace kaamos::embree::testing
