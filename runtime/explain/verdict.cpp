// SPDX-License-Identifier: MIT
#include "runtime/explain/verdict.h"

#include <cstdio>

#include "runtime/backend/ray_flags.h"
#include "runtime/explain/values.h"
#include "runtime/structures/instances.h"

namespace kaamos::explain {
namespace {

using rtapi::CandidateOutcome;
using rtapi::RayFlags;
using runtime::has;

std::string hex2(uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%02x", value);
  return text;
}

bool is_culled_by_face(const Search& search, const Candidate& candidate, const Instance& instance) {
  if (candidate.procedural || (instance.desc.Flags & runtime::kInstanceTriangleCullDisable) != 0) {
    return false;
  }
  return has(search.flags, is_front_face(candidate, instance) ? RayFlags::kCullFrontFacingTriangles
                                                              : RayFlags::kCullBackFacingTriangles);
}

bool is_outside(const Search& search, const Candidate& candidate) {
  const auto t = static_cast<float>(candidate.t);
  // The interval is open for triangles and closed for boxes. [DXR: Ray extents]
  if (candidate.procedural) return candidate.leave < search.t_min || t > search.t_max;
  return !(t > search.t_min && t < search.t_max);
}

}  // namespace

namespace {

// The opacity before instance and ray override it.
Opacity own_opacity(const Candidate& candidate, const Instance& instance, uint32_t ray_flags) {
  const bool in_force = candidate.micromap != runtime::MicromapState::kOfGeometry &&
                        (ray_flags & shader::kRayQueryAllowsMicromaps) != 0 &&
                        (instance.desc.Flags & runtime::kInstanceDisableOmms) == 0;
  if (!in_force) return {candidate.geometry_opaque, false, OpacitySource::kGeometry};
  const bool two_states = has(ray_flags, RayFlags::kForceOmm2State) ||
                          (instance.desc.Flags & runtime::kInstanceForceOmm2State) != 0;
  const auto opacity =
      runtime::opacity_of(candidate.micromap, two_states, candidate.geometry_opaque);
  return {opacity == runtime::Opacity::kOpaque, opacity == runtime::Opacity::kTransparent,
          OpacitySource::kMicromap};
}

}  // namespace

Opacity opacity_of(const Candidate& candidate, const Instance& instance, uint32_t ray_flags) {
  const Opacity own = own_opacity(candidate, instance, ray_flags);
  if (own.transparent) return own;
  if (has(ray_flags, RayFlags::kForceOpaque)) return {true, false, OpacitySource::kRay};
  if (has(ray_flags, RayFlags::kForceNonOpaque)) return {false, false, OpacitySource::kRay};
  const uint32_t flags = instance.desc.Flags;
  if ((flags & runtime::kInstanceForceOpaque) != 0) return {true, false, OpacitySource::kInstance};
  if ((flags & runtime::kInstanceForceNonOpaque) != 0)
    return {false, false, OpacitySource::kInstance};
  return own;
}

bool is_front_face(const Candidate& candidate, const Instance& instance) {
  const bool flipped = (instance.desc.Flags & runtime::kInstanceTriangleFrontCounterclockwise) != 0;
  return candidate.clockwise != flipped;
}

std::optional<CandidateOutcome> refusal(const Search& search, const Candidate& candidate,
                                        const Instance& instance) {
  if ((instance.desc.InstanceMask & search.inclusion_mask) == 0) return CandidateOutcome::kMasked;
  if (has(search.flags,
          candidate.procedural ? RayFlags::kSkipProceduralPrimitives : RayFlags::kSkipTriangles)) {
    return CandidateOutcome::kSkipped;
  }
  if (is_culled_by_face(search, candidate, instance)) return CandidateOutcome::kCulledByFace;
  const Opacity opacity = opacity_of(candidate, instance, search.flags);
  if (opacity.transparent) return CandidateOutcome::kTransparent;
  if (has(search.flags, opacity.opaque ? RayFlags::kCullOpaque : RayFlags::kCullNonOpaque)) {
    return CandidateOutcome::kCulledByOpacity;
  }
  if (is_outside(search, candidate)) return CandidateOutcome::kOutsideRange;
  if (search.ended) return CandidateOutcome::kAfterEndOfSearch;
  if (search.committed) {
    const auto t = static_cast<float>(candidate.t);
    if (candidate.procedural ? t > search.committed_t : !(t < search.committed_t)) {
      return CandidateOutcome::kBehindCommittedHit;
    }
  }
  return std::nullopt;
}

std::string refusal_text(CandidateOutcome outcome, const Search& search, const Candidate& candidate,
                         const Instance& instance) {
  switch (outcome) {
    case CandidateOutcome::kMasked:
      return "InstanceMask " + hex2(instance.desc.InstanceMask) + " & InstanceInclusionMask " +
             hex2(search.inclusion_mask) + " is 0";
    case CandidateOutcome::kSkipped:
      return candidate.procedural ? "SKIP_PROCEDURAL_PRIMITIVES" : "SKIP_TRIANGLES";
    case CandidateOutcome::kCulledByFace:
      return is_front_face(candidate, instance) ? "front face, CULL_FRONT_FACING_TRIANGLES"
                                                : "back face, CULL_BACK_FACING_TRIANGLES";
    case CandidateOutcome::kCulledByOpacity: {
      const Opacity opacity = opacity_of(candidate, instance, search.flags);
      return opacity_text(opacity) + (opacity.opaque ? ", CULL_OPAQUE" : ", CULL_NON_OPAQUE");
    }
    case CandidateOutcome::kTransparent:
      return "transparent by its opacity micromap";
    case CandidateOutcome::kOutsideRange:
      if (static_cast<float>(candidate.t) > search.t_min) {
        return "not in front of TMax " + number_text(search.t_max);
      }
      return "not beyond TMin " + number_text(search.t_min);
    case CandidateOutcome::kAfterEndOfSearch:
      return "the search had ended";
    case CandidateOutcome::kBehindCommittedHit:
      return "not in front of the committed hit at t " + number_text(search.committed_t);
    default:
      return {};
  }
}

std::string opacity_text(const Opacity& opacity) {
  const std::string what = opacity.opaque ? "opaque" : "not opaque";
  switch (opacity.source) {
    case OpacitySource::kGeometry:
      return what + " by the geometry's flags";
    case OpacitySource::kMicromap:
      return what + " by its opacity micromap";
    case OpacitySource::kInstance:
      return what + " by the instance's flags";
    case OpacitySource::kRay:
      return what + " by the ray's flags";
  }
  return what;
}

}  // namespace kaamos::explain
