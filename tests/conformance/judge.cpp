// SPDX-License-Identifier: MIT
#include "tests/conformance/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace kaamos::conformance {

namespace {

constexpr uint32_t kAcceptFirst = 0x4, kSkipClosest = 0x8;
constexpr double kTie = 2e-4;  // relative: hits closer together than this may swap
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One ray and what the reference says about it.
struct Case {
  Case(const Scene& scene, const Ray& ray_of_case, const Walked& found)
      : records(scene.records), ray(ray_of_case), walked(found), all(candidates(scene, ray)) {
    for (const Candidate& each : all) {
      const Decision decision = decision_of(each);
      certain = certain && each.certain;
      if (decision == kAccept) accepted.push_back(&each);
      if (decision == kAcceptAndEnd) ending.push_back(&each);
    }
  }

  bool first_ends() const { return (ray.flags & kAcceptFirst) != 0; }
  Decision decision_of(const Candidate& candidate) const {
    const Decision out =
        candidate.commits ? kAccept : decide(ray.extra[0], ray.extra[1], candidate.packed());
    return out == kAccept && first_ends() ? kAcceptAndEnd : out;
  }
  const Candidate* find(uint32_t packed) const {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Candidate& each) { return each.packed() == packed; });
    return found == all.end() ? nullptr : &*found;
  }

  const std::vector<GroupKind>& records;
  const Ray& ray;
  const Walked& walked;
  std::vector<Candidate> all;              // nearest first
  std::vector<const Candidate*> accepted;  // those that commit, nearest first
  std::vector<const Candidate*> ending;    // those that commit and end the search
  bool certain = true;
};

std::string name_of(const Candidate& each) {
  char text[120];
  std::snprintf(text, sizeof text, "instance %u geometry %u primitive %u kind %u t %.9g",
                each.instance, each.geometry, each.primitive, each.kind, each.t);
  return text;
}

std::string name_of(uint32_t packed) {
  Candidate each;
  each.instance = packed >> 24;
  each.geometry = packed >> 20 & 15;
  each.primitive = packed >> 8 & 0xFFF;
  each.kind = packed & 0xFF;
  return name_of(each);
}

// Tells whether the candidate must have reached its any-hit shader, in whatever order traversal
// visits it.
bool must_run(const Case& each, const Candidate& candidate) {
  if (candidate.commits || !candidate.certain || !each.ending.empty()) return false;
  for (const Candidate* nearer : each.accepted) {
    if (nearer != &candidate && nearer->t <= candidate.t * (1 + kTie) + kTie) return false;
  }
  return true;
}

std::string judge_events(const Case& each, Coverage& coverage) {
  std::vector<uint32_t> seen;
  float limit = each.ray.t_max;
  for (const Event& event : each.walked.events) {
    const Candidate* candidate = each.find(event.packed);
    if (candidate == nullptr || candidate->commits) {
      return "an any-hit shader ran for " + name_of(event.packed) + ", which is no candidate";
    }
    if (std::count(seen.begin(), seen.end(), event.packed) > 0) {
      return "two any-hit shaders ran for " + name_of(*candidate);
    }
    seen.push_back(event.packed);
    const bool in_interval = candidate->kind < 128 ? event.t >= each.ray.t_min && event.t <= limit
                                                   : event.t > each.ray.t_min && event.t < limit;
    if (!in_interval) return "an any-hit shader ran out of the interval for " + name_of(*candidate);
    if (std::abs(event.t - candidate->t) > 1e-3 * std::max(1.0, candidate->t)) {
      return "RayTCurrent() is " + std::to_string(event.t) + " for " + name_of(*candidate);
    }
    const Decision decision = each.decision_of(*candidate);
    if (decision != kIgnore) limit = event.t;
    if (decision == kAcceptAndEnd && &event != &each.walked.events.back()) {
      return "an any-hit shader ran after the search had ended at " + name_of(*candidate);
    }
  }
  for (const Candidate& candidate : each.all) {
    if (!must_run(each, candidate)) continue;
    ++coverage.required_events;
    if (std::count(seen.begin(), seen.end(), candidate.packed()) == 0) {
      return "no any-hit shader ran for " + name_of(candidate);
    }
  }
  coverage.events += static_cast<uint32_t>(seen.size());
  return "";
}

// The commits that may end the trace, in whatever order traversal visits them.
std::vector<const Candidate*> possible_hits(const Case& each) {
  std::vector<const Candidate*> out = each.ending;
  const double end = each.ending.empty() ? kInfinity : each.ending.front()->t;
  for (const Candidate* hit : each.accepted) {
    const double nearest = each.accepted.front()->t;
    if (hit->t <= nearest * (1 + kTie) + kTie && hit->t < end * (1 + kTie) + kTie) {
      out.push_back(hit);
    }
  }
  return out;
}

std::string compare_hit(const Case& each, const Candidate& hit) {
  const Seen& seen = each.walked.seen;
  if (seen.instance_id != 1000 + hit.instance) return "InstanceID() is that of another instance";
  if (seen.record != hit.record) return "the record is " + std::to_string(seen.record);
  if (std::abs(seen.t - hit.t) > 1e-3 * std::max(1.0, hit.t)) {
    return "RayTCurrent() is " + std::to_string(seen.t);
  }
  if (hit.kind < 128) {
    const bool own =
        seen.box_record == (hit.primitive << 8 | hit.kind) && seen.barycentrics[0] == seen.t;
    return own ? "" : "the attributes are those of another report";
  }
  if (std::abs(seen.barycentrics[0] - hit.u) > 5e-3 ||
      std::abs(seen.barycentrics[1] - hit.v) > 5e-3) {
    return "the barycentrics are " + std::to_string(seen.barycentrics[0]) + ", " +
           std::to_string(seen.barycentrics[1]) + " instead of " + std::to_string(hit.u) + ", " +
           std::to_string(hit.v);
  }
  return "";
}

std::string judge_end(const Case& each, Coverage& coverage) {
  if (!each.certain) return "";
  ++coverage.certain;
  const Seen& seen = each.walked.seen;
  const auto possible = possible_hits(each);
  if (possible.empty()) {
    if (seen.closest_hits > 0) return "a closest-hit shader ran, nothing being hit";
    return seen.end == kMissRan ? "" : "end is " + std::to_string(seen.end) + ", expected a miss";
  }
  ++coverage.hits;
  if (seen.end == kMissRan) return "missed " + name_of(*possible[0]);
  if (seen.end == kNothingRan) {
    for (const Candidate* hit : possible) {
      if (each.records[hit->record] == GroupKind::kNull || (each.ray.flags & kSkipClosest) != 0) {
        return "";
      }
    }
    return "no shader ran at " + name_of(*possible[0]);
  }
  if (seen.closest_hits != 1 || (each.ray.flags & kSkipClosest) != 0) {
    return std::to_string(seen.closest_hits) + " closest-hit shaders ran";
  }
  const uint32_t packed =
      seen.instance_index << 24 | seen.geometry << 20 | seen.primitive << 8 | seen.hit_kind;
  for (const Candidate* hit : possible) {
    if (hit->packed() != packed || each.records[hit->record] == GroupKind::kNull) continue;
    const std::string differs = compare_hit(each, *hit);
    return differs.empty() ? "" : "at " + name_of(*hit) + ": " + differs;
  }
  return "hit " + name_of(packed) + " instead of " + name_of(*possible[0]);
}

}  // namespace

std::string judge_ray(const Scene& scene, const Ray& ray, const Walked& walked,
                      Coverage& coverage) {
  ++coverage.rays;
  const Case each(scene, ray, walked);
  const std::string failure = judge_events(each, coverage);
  return failure.empty() ? judge_end(each, coverage) : failure;
}

Coverage judge(Context& t, const Scene& scene, const std::vector<Ray>& rays,
               const std::vector<Walked>& walked) {
  Coverage out;
  uint32_t wrong = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const std::string failure = judge_ray(scene, rays[i], walked[i], out);
    if (!failure.empty() && ++wrong <= 5) {
      t.fail("ray " + std::to_string(i) + " (flags " + std::to_string(rays[i].flags) +
             "): " + failure);
    }
  }
  if (wrong > 5) t.fail("and " + std::to_string(wrong - 5) + " more rays");
  return out;
}

}  // namespace kaamos::conformance
