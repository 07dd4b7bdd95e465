// SPDX-License-Identifier: MIT
//
// Explains one pixel of a dispatch: every TraceRay, CallShader and RayQuery as a tree, with each
// candidate along a ray and why it was taken or not. And counts, for every pixel, what rays did.
//
// Both replay shaders on the CPU, whatever the backend, from the native code (or interpreted code)
// that every shader library holds. Candidates are found in double precision by an own search of
// what the acceleration structures were built from, and are offered front to back, one of the
// orders that DXR allows. Where a hit lies on an edge, to the last bit, the dispatch may have
// decided otherwise. What the replay writes is undone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/command_list.h>
#include <rtapi/command_queue.h>
#include <rtapi/device.h>
#include <rtapi/raytracing.h>
#include <rtapi/shader_library.h>
#include <rtapi/table_description.h>

namespace rtapi {

struct ExplainDesc {
  uint32_t Dispatch = 0;  // which DispatchRays of the list, from 0
  uint32_t X = 0;         // DispatchRaysIndex
  uint32_t Y = 0;
  uint32_t Z = 0;
  // Of one ray; those that are nearest are kept.
  uint32_t MaxCandidatesPerRay = 64;
};

// A scalar, vector or matrix of a payload, of attributes or of callable data.
struct ExplainedValue {
  std::string Name = {};  // as in HLSL: "light.color"
  std::string Type = {};  // "float3"
  std::string Text = {};  // "0.5 0.25 1"
};

// How a record was chosen.
struct ExplainedRecord {
  std::string Table = {};  // "hit group", "miss", "callable", "ray generation"
  uint64_t Index = 0;
  std::string Arithmetic = {};  // "1 (ray) + 2 (multiplier) * 0 (geometry) + 4 (instance)"
  std::string Export = {};      // empty: nothing runs
  std::string Reason = {};      // why nothing runs: out of bounds, NULL, unknown identifier
};

struct ExplainedCall;

// One run of a shader.
struct ExplainedShader {
  std::string Name = {};
  ShaderStage Stage = ShaderStage::kRayGeneration;
  ExplainedRecord Record = {};
  std::vector<ExplainedValue> Attributes = {};
  std::vector<ExplainedValue> Before = {};  // payload or callable data
  std::vector<ExplainedValue> After = {};
  std::vector<ExplainedCall> Calls;
  std::string Result = {};  // any-hit: "accepted", "ignored", "accepted, search ended"
};

enum class CandidateOutcome : uint32_t {
  kCommitted,           // opaque, or accepted by a shader
  kReplaced,            // was committed until a nearer or later hit took its place
  kIgnored,             // by an any-hit shader
  kNotReported,         // procedural: no ReportHit was accepted, or there is no shader
  kNotCommitted,        // a RayQuery's shader did not commit it
  kOffered,             // a RayQuery's shader decided, and did not call Proceed again
  kMasked,              // InstanceMask & InstanceInclusionMask is 0
  kSkipped,             // SKIP_TRIANGLES, SKIP_PROCEDURAL_PRIMITIVES
  kCulledByFace,        // CULL_BACK_FACING_TRIANGLES, CULL_FRONT_FACING_TRIANGLES
  kCulledByOpacity,     // CULL_OPAQUE, CULL_NON_OPAQUE
  kOutsideRange,        // not in the interval of TMin and TMax
  kBehindCommittedHit,  // a nearer hit was committed
  kAfterEndOfSearch,    // the search had ended
};

struct ExplainedCandidate {
  float T = 0;  // boxes: where the ray enters
  uint32_t InstanceIndex = 0;
  uint32_t InstanceID = 0;
  uint32_t GeometryIndex = 0;
  uint32_t PrimitiveIndex = 0;
  bool Procedural = false;
  bool FrontFace = false;  // triangles
  bool Opaque = false;     // with the overrides of instance and ray
  float Barycentrics[2] = {0, 0};
  CandidateOutcome Outcome = CandidateOutcome::kBehindCommittedHit;
  std::string Reason = {};  // one sentence
  ExplainedRecord Record = {};
  std::vector<ExplainedShader> Shaders = {};  // any-hit or intersection
};

enum class ExplainedCallKind : uint32_t { kTraceRay, kCallShader, kRayQuery, kReportHit };

// What a shader asked for.
struct ExplainedCall {
  ExplainedCallKind Kind = ExplainedCallKind::kTraceRay;
  // TraceRay, RayQuery
  uint32_t Depth = 0;  // TraceRay: of the shaders that it runs
  AddressDescription Scene = {};
  RayFlags Flags = RayFlags::kNone;  // with those of the pipeline
  uint32_t InstanceInclusionMask = 0;
  uint32_t RayContributionToHitGroupIndex = 0;
  uint32_t MultiplierForGeometryContributionToHitGroupIndex = 0;
  uint32_t MissShaderIndex = 0;
  float Origin[3] = {0, 0, 0};
  float TMin = 0;
  float Direction[3] = {0, 0, 0};
  float TMax = 0;
  std::vector<ExplainedCandidate> Candidates = {};  // front to back
  uint64_t CandidatesLeftOut = 0;
  bool Hit = false;
  float HitT = 0;
  // ReportHit: HitT and this.
  uint32_t HitKind = 0;
  std::vector<ExplainedValue> Before = {};  // payload, callable data
  std::vector<ExplainedValue> After = {};
  std::vector<ExplainedShader> Shaders = {};  // closest-hit or miss; callable; any-hit of ReportHit
  std::string Note = {};                      // what else is to be said
};

struct PixelExplanation {
  uint32_t Index[3] = {0, 0, 0};       // DispatchRaysIndex
  uint32_t Dimensions[3] = {0, 0, 0};  // DispatchRaysDimensions
  std::string Backend = {};            // that executes the list
  std::string Executor = {};           // what ran the shaders for this explanation, in words
  std::vector<ExplainedShader> RayGeneration = {};  // one, or none where the record runs nothing
  std::string Removal = {};  // not empty: why the dispatch removes the device at this pixel
};

// What the rays of one pixel did, RayQueries and nested rays included.
struct PixelStatistics {
  uint32_t TraceRayCalls = 0;
  uint32_t RayQueries = 0;
  uint32_t Candidates = 0;  // offered: inside the range, not culled, before the committed hit
  uint32_t AnyHitCalls = 0;
  uint32_t IntersectionCalls = 0;
  uint32_t CallableCalls = 0;
  uint32_t MaxDepth = 0;  // of TraceRay: 1 for rays of the ray generation shader
};

struct DispatchStatistics {
  uint32_t Dimensions[3] = {0, 0, 0};
  std::vector<PixelStatistics> Pixels = {};  // x fastest
  std::string Executor = {};
};

// Executes the list (which is closed if it is open) as ExecuteAndWait does, and explains one
// DispatchRaysIndex of one of its dispatches as it is when that dispatch begins.
// Where the replay ends early (Removal), that is returned and no error: the device says its own.
// Errors: those of ExecuteAndWait; KA0904 an empty handle; KA0916 no such dispatch or index, or
// memory that the host cannot reach.
Result<PixelExplanation> ExplainPixel(CommandQueue& queue, CommandList& list,
                                      const ExplainDesc& desc);
// The same for counts of every index of the dispatch; X, Y and Z do not count. Every pixel is
// replayed on one thread: some 10 microseconds for each ray.
Result<DispatchStatistics> CollectPixelStatistics(CommandQueue& queue, CommandList& list,
                                                  const ExplainDesc& desc = {});

std::string ToText(const PixelExplanation& explanation);
std::string ToJson(const PixelExplanation& explanation);  // UTF-8, indented by two

}  // namespace rtapi
