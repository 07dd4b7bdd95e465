// SPDX-License-Identifier: MIT
//
// A ray tracing pipeline with its tables, and the pipeline that most rules share.
#pragma once

#include <rtapi/shader_table.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/conformance/context.h"

namespace kaamos::shader {
struct LibraryDesc;
}

namespace kaamos::conformance {

inline constexpr char kGlobalSignature[] = "SRV(t0), SRV(t1), UAV(u0)";
// Every record of common.hlsli has this signature.
inline constexpr char kRecordSignature[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 1, num32BitConstants = 4)";

// The structures of common.hlsli.
struct Ray {
  float origin[3] = {0.1f, 0.2f, 0};
  float t_min = 0;
  float direction[3] = {0, 0, 1};
  float t_max = 1000;
  uint32_t flags = 0;
  uint32_t mask = 0xFF;
  uint32_t contribution = 0;
  uint32_t multiplier = 0;
  uint32_t miss = 0;
  uint32_t extra[3] = {};  // arguments for a test's own shaders
};
enum RayEnd : uint32_t { kNothingRan, kClosestHitRan, kMissRan };
struct Seen {
  uint32_t end;  // RayEnd
  uint32_t record;
  uint32_t any_hits;
  uint32_t any_record;
  uint32_t box_record;
  uint32_t instance_index;
  uint32_t instance_id;
  uint32_t geometry;
  uint32_t primitive;
  uint32_t hit_kind;
  uint32_t flags;
  float t;
  float any_t;
  float barycentrics[2];
  uint32_t closest_hits;  // invocations
};
static_assert(sizeof(Ray) == 64 && sizeof(Seen) == 64);
Ray ray_at(float x, float y = 0.2f);

// Size in bytes of the buffer at u0 unless a test wants more, and the word in it that counts
// intersection shaders.
inline constexpr uint32_t kWordBytes = 65536;
inline constexpr uint32_t kIntersectionWord = 32768 / 4;

struct Constants {
  uint32_t ordinal = 0;
  float reported_t = 5;
  uint32_t reported_kind = 7;
  uint32_t unused = 0;
};

class Program {
 public:
  // Empty `exports` export everything in the library. Change `desc` before the first record or run.
  Program(Context& t, const shader::LibraryDesc* library, std::vector<std::string> exports = {},
          const char* global_signature = kGlobalSignature);

  // Adds a hit group; one with an intersection shader is procedural.
  void group(const std::string& name, const std::string& closest, const std::string& any = "",
             const std::string& intersection = "");
  void local(const std::string& signature, const std::vector<std::string>& exports);

  // Creates the pipeline; everything below calls it. Tests of refusals use `try_create`.
  void create();
  rtapi::Result<rtapi::StateObject> try_create() const {
    return context_->device().CreateStateObject(desc);
  }

  // Append records and return their index.
  uint32_t miss(const std::string& name, std::vector<rtapi::LocalArgument> arguments = {});
  uint32_t hit(const std::string& name, std::vector<rtapi::LocalArgument> arguments = {});
  uint32_t callable(const std::string& name, std::vector<rtapi::LocalArgument> arguments = {});
  uint32_t raygen(const std::string& name, std::vector<rtapi::LocalArgument> arguments = {});

  rtapi::DispatchRaysDesc tables();
  // With a miss table of null records, for rays that must hit.
  rtapi::DispatchRaysDesc tables_without_miss();
  // Dispatches and returns all words of u0, which start at zero.
  std::vector<uint32_t> run(const rtapi::DispatchRaysDesc& desc);
  std::vector<uint32_t> run(uint32_t width = 1, uint32_t height = 1, uint32_t depth = 1);

  rtapi::StateObjectDesc desc;
  rtapi::StateObject pipeline;
  rtapi::RootSignature global;
  rtapi::Buffer scene;               // at t0
  rtapi::Buffer rays;                // at t1
  uint64_t word_bytes = kWordBytes;  // size of u0
  // Further root arguments and descriptor heaps.
  std::function<void(rtapi::CommandList&)> bind = {};
  std::vector<rtapi::ShaderTable> shader_tables;  // ray generation, miss, hit, callable

 protected:
  // Later programs on this device with the same name and nothing added to `desc` reuse the
  // pipeline.
  void share_as(const std::string& name);

 private:
  void suit_tier();
  uint32_t add(size_t table, const std::string& name,
               const std::vector<rtapi::LocalArgument>& arguments);
  Context* context_;
  std::string shared_name_ = {};  // empty: not shared
  size_t shared_size_ = 0;        // number of subobjects when it was named
};

// standard.hlsl: hit groups Plain, Counted, Ignored, Box, BoxCounted, BoxIgnored. Hit record i has
// the ordinal i, miss record i has 1000 + i.
class Standard : public Program {
 public:
  explicit Standard(Context& t) : Standard(t, nullptr, {}) {}
  // For a library that includes standard.hlsl; adds some of its exports.
  Standard(Context& t, const shader::LibraryDesc* library, std::vector<std::string> more_exports,
           const char* global_signature = kGlobalSignature);
  void set_pipeline_flags(rtapi::RaytracingPipelineFlags flags);

  uint32_t record(const std::string& group, float reported_t = 5, uint32_t reported_kind = 7);
  void records(const std::string& group, uint32_t count);
  void miss_records(uint32_t count);

  // Adds the ray generation record, and a miss record if there is none.
  std::vector<Seen> trace(const std::vector<Ray>& list);
  Seen trace(const Ray& ray) { return trace(std::vector<Ray>{ray})[0]; }
  Seen trace(const rtapi::Buffer& top_level, const Ray& ray = {});
  void prepare(const std::vector<Ray>& list);
  uint32_t intersections() const { return intersections_; }  // in the last trace

 private:
  Context* context_;
  uint32_t intersections_ = 0;
};

std::vector<Seen> seen_of(const std::vector<uint32_t>& words, size_t count);

}  // namespace kaamos::conformance
