// SPDX-License-Identifier: MIT
/// @file
/// Explains one pixel of a dispatch: every TraceRay, CallShader and RayQuery as a tree, with each
/// candidate along a ray and why it was taken or not. And counts, for every pixel, what rays did.
///
/// Both replay shaders on the CPU, whatever the backend, from the native code (or interpreted code)
/// that every shader library holds. A search of their own, in double precision, finds candidates in
/// what the acceleration structures were built from, and offers them front to back, one of the
/// orders that DXR allows. Where a hit lies on an edge, to the last bit, the dispatch may have
/// decided otherwise. What the replay writes is undone.
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

/// Selects what ExplainPixel explains.
struct ExplainDesc {
  uint32_t Dispatch = 0;  ///< which DispatchRays of the list, from 0; indirect ones do not count
  /// The pixel: its DispatchRaysIndex.
  ///@{
  uint32_t X = 0;
  uint32_t Y = 0;
  uint32_t Z = 0;
  ///@}
  uint32_t MaxCandidatesPerRay = 64;  ///< the nearest are kept
};

/// A scalar, vector or matrix of a payload, of attributes or of callable data.
struct ExplainedValue {
  std::string Name = {};  ///< as in HLSL: "light.color"
  std::string Type = {};  ///< "float3"
  std::string Text = {};  ///< "0.5 0.25 1"
};

/// Explains how a record was chosen.
struct ExplainedRecord {
  std::string Table = {};       ///< "hit group", "miss", "callable", "ray generation"
  uint64_t Index = 0;           ///< in its table
  std::string Arithmetic = {};  ///< "1 (ray) + 2 (multiplier) * 0 (geometry) + 4 (instance)"
  std::string Export = {};      ///< empty: nothing runs
  std::string Reason = {};      ///< why nothing runs: out of bounds, NULL, unknown identifier
};

struct ExplainedCall;

/// One run of a shader.
struct ExplainedShader {
  std::string Name = {};                            ///< as in HLSL
  ShaderStage Stage = ShaderStage::kRayGeneration;  ///< its kind
  ExplainedRecord Record = {};                      ///< why it ran
  std::vector<ExplainedValue> Attributes = {};      ///< of the hit
  /// Payload or callable data, before and after the shader.
  ///@{
  std::vector<ExplainedValue> Before = {};
  std::vector<ExplainedValue> After = {};
  ///@}
  std::vector<ExplainedCall> Calls;  ///< what it asked for, in order
  std::string Result = {};           ///< any-hit: "accepted", "ignored", "accepted, search ended"
};

/// The outcome of a candidate.
enum class CandidateOutcome : uint32_t {
  kCommitted,           ///< opaque, or accepted by a shader
  kReplaced,            ///< was committed until a nearer or later hit took its place
  kIgnored,             ///< by an any-hit shader
  kNotReported,         ///< procedural: no ReportHit was accepted, or there is no shader
  kNotCommitted,        ///< a RayQuery's shader did not commit it
  kOffered,             ///< a RayQuery's shader decided, and did not call Proceed again
  kMasked,              ///< InstanceMask & InstanceInclusionMask is 0
  kSkipped,             ///< SKIP_TRIANGLES, SKIP_PROCEDURAL_PRIMITIVES
  kCulledByFace,        ///< CULL_BACK_FACING_TRIANGLES, CULL_FRONT_FACING_TRIANGLES
  kCulledByOpacity,     ///< CULL_OPAQUE, CULL_NON_OPAQUE
  kOutsideRange,        ///< not in the interval of TMin and TMax
  kBehindCommittedHit,  ///< a nearer hit was committed
  kAfterEndOfSearch,    ///< the search had ended
  kTransparent,         ///< in a transparent part of an opacity micromap
};

/// A primitive that a ray met, or whose box it met.
struct ExplainedCandidate {
  float T = 0;  ///< boxes: where the ray enters
  /// As HLSL's system values of the same names.
  ///@{
  uint32_t InstanceIndex = 0;
  uint32_t InstanceID = 0;
  uint32_t GeometryIndex = 0;
  uint32_t PrimitiveIndex = 0;
  uint32_t ClusterID = 0xFFFFFFFF;  ///< EXPERIMENTAL; CLUSTER_ID_INVALID: in no cluster
  ///@}
  bool Procedural = false;         ///< a box, else a triangle
  bool FrontFace = false;          ///< triangles
  bool Opaque = false;             ///< with the overrides of instance and ray
  float Barycentrics[2] = {0, 0};  ///< triangles: the weights of vertices 1 and 2
  CandidateOutcome Outcome = CandidateOutcome::kBehindCommittedHit;  ///< what became of it
  std::string Reason = {};                                           ///< one sentence
  ExplainedRecord Record = {};                                       ///< its hit record
  std::vector<ExplainedShader> Shaders = {};                         ///< any-hit or intersection
};

/// The kind of call that a shader made.
enum class ExplainedCallKind : uint32_t { kTraceRay, kCallShader, kRayQuery, kReportHit, kInvoke };

/// One call of a shader, and what came of it.
struct ExplainedCall {
  ExplainedCallKind Kind = ExplainedCallKind::kTraceRay;  ///< which of the members count
  uint32_t Depth = 0;                ///< TraceRay, Invoke: of the shaders that it runs, from 1
  AddressDescription Scene = {};     ///< TraceRay, RayQuery: the top level
  RayFlags Flags = RayFlags::kNone;  ///< with those of the pipeline
  /// Arguments of TraceRay or TraceRayInline.
  ///@{
  uint32_t InstanceInclusionMask = 0;
  uint32_t RayContributionToHitGroupIndex = 0;
  uint32_t MultiplierForGeometryContributionToHitGroupIndex = 0;
  uint32_t MissShaderIndex = 0;
  float Origin[3] = {0, 0, 0};
  float TMin = 0;
  float Direction[3] = {0, 0, 0};
  float TMax = 0;
  ///@}
  std::vector<ExplainedCandidate> Candidates = {};  ///< front to back
  uint64_t CandidatesLeftOut = 0;                   ///< past MaxCandidatesPerRay
  bool Hit = false;                                 ///< whether one was committed
  float HitT = 0;                                   ///< of the committed or reported hit
  uint32_t HitKind = 0;                             ///< ReportHit
  /// Payload or callable data, before and after the call.
  ///@{
  std::vector<ExplainedValue> Before = {};
  std::vector<ExplainedValue> After = {};
  ///@}
  /// The shaders that ran at its end: closest-hit or miss; callable; any-hit of ReportHit.
  std::vector<ExplainedShader> Shaders = {};
  std::string Note = {};  ///< what else is to be said
};

/// The result of ExplainPixel: a tree of shaders and their calls.
struct PixelExplanation {
  uint32_t Index[3] = {0, 0, 0};       ///< DispatchRaysIndex
  uint32_t Dimensions[3] = {0, 0, 0};  ///< DispatchRaysDimensions
  std::string Backend = {};            ///< that executes the list
  std::string Executor = {};           ///< what ran the shaders for this explanation, in words
  std::vector<ExplainedShader> RayGeneration = {};  ///< one, or none where the record runs nothing
  std::string Removal = {};  ///< not empty: why the dispatch removes the device at this pixel
};

/// Counts of what the rays of one pixel did, RayQueries and nested rays included.
struct PixelStatistics {
  uint32_t TraceRayCalls = 0;  ///< at any depth
  uint32_t RayQueries = 0;     ///< TraceRayInline calls
  uint32_t Candidates = 0;     ///< offered: inside the range, not culled, before the committed hit
  uint32_t AnyHitCalls = 0;    ///< any-hit shaders that ran
  uint32_t IntersectionCalls = 0;  ///< intersection shaders that ran
  uint32_t CallableCalls = 0;      ///< callable shaders that ran
  uint32_t MaxDepth = 0;           ///< of TraceRay: 1 for rays of the ray generation shader
};

/// The counts of CollectPixelStatistics.
struct DispatchStatistics {
  uint32_t Dimensions[3] = {0, 0, 0};        ///< DispatchRaysDimensions
  std::vector<PixelStatistics> Pixels = {};  ///< Dimensions product of them, x fastest
  std::string Executor = {};                 ///< what ran the shaders, in words
};

/// Executes a list as CommandQueue::ExecuteAndWait does (it is closed if it is open), and explains
/// one pixel of one of its dispatches, as memory is when that dispatch begins. Takes the replay of
/// one pixel, some 10 microseconds for each ray, and a copy of every buffer that shaders may write.
/// If the replay ends early, Removal says why and no error is returned: the device says its own.
/// @errors KA0903, KA0904 an empty handle or a list of another device; the first error of
/// recording; KA0856 memory that the list uses was freed; KA0916 no such dispatch or index, or
/// memory that the host cannot reach; what Device::GetDeviceRemovedReason says.
Result<PixelExplanation> ExplainPixel(const CommandQueue& queue, const CommandList& list,
                                      const ExplainDesc& desc);
/// Executes a list in the same way and counts what the rays of every pixel of one dispatch did; X,
/// Y and Z of `desc` do not count. Every pixel is replayed on one thread: some 10 microseconds for
/// each ray.
/// @errors as of ExplainPixel: KA0856, KA0903, KA0904, KA0916, recording, removal.
Result<DispatchStatistics> CollectPixelStatistics(const CommandQueue& queue,
                                                  const CommandList& list,
                                                  const ExplainDesc& desc = {});

/// An explanation as lines of text for a terminal, what is nested indented.
std::string ToText(const PixelExplanation& explanation);
/// An explanation as JSON: UTF-8, indented by two.
std::string ToJson(const PixelExplanation& explanation);

}  // namespace rtapi
