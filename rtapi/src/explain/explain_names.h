// SPDX-License-Identifier: MIT
#pragma once

#include <rtapi/explain.h>

namespace rtapi::detail {

inline const char* stage_name(ShaderStage stage) {
  switch (stage) {
    case ShaderStage::kRayGeneration:
      return "ray generation";
    case ShaderStage::kIntersection:
      return "intersection";
    case ShaderStage::kAnyHit:
      return "any-hit";
    case ShaderStage::kClosestHit:
      return "closest-hit";
    case ShaderStage::kMiss:
      return "miss";
    case ShaderStage::kCallable:
      return "callable";
    default:
      return "shader";
  }
}

inline const char* outcome_name(CandidateOutcome outcome) {
  switch (outcome) {
    case CandidateOutcome::kCommitted:
      return "committed";
    case CandidateOutcome::kReplaced:
      return "committed, then replaced";
    case CandidateOutcome::kIgnored:
      return "ignored";
    case CandidateOutcome::kNotReported:
      return "not hit";
    case CandidateOutcome::kNotCommitted:
      return "not committed";
    case CandidateOutcome::kOffered:
      return "offered";
    case CandidateOutcome::kMasked:
      return "masked";
    case CandidateOutcome::kSkipped:
      return "skipped";
    case CandidateOutcome::kCulledByFace:
      return "culled";
    case CandidateOutcome::kCulledByOpacity:
      return "culled";
    case CandidateOutcome::kOutsideRange:
      return "out of range";
    case CandidateOutcome::kBehindCommittedHit:
      return "behind";
    case CandidateOutcome::kAfterEndOfSearch:
      return "not reached";
    case CandidateOutcome::kTransparent:
      return "transparent";
  }
  return "";
}

}  // namespace rtapi::detail
