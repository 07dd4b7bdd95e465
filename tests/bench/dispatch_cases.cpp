// SPDX-License-Identifier: MIT
//
// dispatch/...: Mrays/s of DispatchRays against a hand-written loop over the same rays, and a check
// that both found the same.
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fixtures.h"

namespace kaamos::bench {
namespace {

// Both sides may differ where rounding in the ray transform decides.
constexpr double kAllowedDifference = 1e-4;
// At 1,000 km, robust precision moves an instance's rays by some centimetres.
constexpr double kAllowedFarAway = 0.1;

bool is_hit(uint32_t visible) {
  return visible == 0;
}
bool is_hit(const ClosestResult& result) {
  return result.t >= 0;
}
bool is_hit(const ShadedResult& result) {
  return result.t >= 0;
}

// Sums that agree when the hits agree: distances and colours.
double sum_of(uint32_t visible) {
  return visible;
}
double sum_of(const ClosestResult& result) {
  return result.t;
}
double sum_of(const ShadedResult& result) {
  return double{result.t} + result.color[0] + result.color[1] + result.color[2];
}

template <typename T>
void check_same(const std::vector<T>& ours, const std::vector<T>& baseline,
                double allowed_difference) {
  double hits[2] = {0, 0};
  double sums[2] = {0, 0};
  for (size_t i = 0; i < ours.size(); ++i) {
    hits[0] += is_hit(ours[i]) ? 1 : 0;
    hits[1] += is_hit(baseline[i]) ? 1 : 0;
    sums[0] += sum_of(ours[i]);
    sums[1] += sum_of(baseline[i]);
  }
  const double rays = static_cast<double>(ours.size());
  // Allows one ray of a small grid to differ.
  const double allowed = std::max(allowed_difference * rays, 1.0);
  if (std::fabs(hits[0] - hits[1]) > allowed) {
    throw std::runtime_error("results differ: " + std::to_string(hits[0]) + " hits, the baseline " +
                             std::to_string(hits[1]) + ", of " + std::to_string(rays) + " rays");
  }
  if (std::fabs(sums[0] - sums[1]) > 1e-3 * std::fabs(sums[1]) + 8 * allowed) {
    throw std::runtime_error("results differ: the sum over all rays is " + std::to_string(sums[0]) +
                             ", of the baseline " + std::to_string(sums[1]));
  }
}

// Turns times into rates.
template <typename T, typename Baseline>
Line compare(const std::string& name, Fixtures& fixtures, const Measure& measure, DxrScene& scene,
             Program program, const RayGrid& grid, Baseline baseline,
             double allowed_difference = kAllowedDifference) {
  DxrDispatch dispatch(scene, program, grid);
  std::vector<T> expected(grid.rays.size());
  // Repeats short dispatches, so that a run takes some tens of milliseconds.
  const uint64_t rays = grid.rays.size();
  const int repeats = fixtures.options().quick ? 1 : static_cast<int>(1 + 800000 / rays);
  const Pairs times = time_pairs(
      measure,
      [&] {
        for (int i = 0; i < repeats; ++i) dispatch.run();
      },
      [&] {
        for (int i = 0; i < repeats; ++i) baseline(grid, expected);
      });
  check_same(dispatch.results<T>(), expected, allowed_difference);
  const double mrays = 1e-6 * static_cast<double>(rays) * repeats;
  return {name, 1 / times.ratio, mrays / times.ours, mrays / times.baseline, "Mrays/s", true};
}

Case minimal_case(RaySet set) {
  const std::string name = std::string("dispatch/embree/") + name_of(set);
  return {name, [=](Fixtures& f, const Measure& measure) {
            const EmbreeScene& embree = f.embree_scene(false);
            DxrScene& scene = f.dxr_scene(false);
            if (is_visibility(set)) {
              return compare<uint32_t>(
                  name, f, measure, scene, Program::kVisible, f.rays(set),
                  [&](const RayGrid& grid, auto& out) { embree.visible(f.arena(), grid, out); });
            }
            return compare<ClosestResult>(
                name, f, measure, scene, Program::kClosest, f.rays(set),
                [&](const RayGrid& grid, auto& out) { embree.closest(f.arena(), grid, out); });
          }};
}

Case same_tlas_case(RaySet set) {
  const std::string name = std::string("dispatch/same-tlas/") + name_of(set);
  return {name, [=](Fixtures& f, const Measure& measure) {
            const OwnTopLevel& own = f.own_top_level();
            DxrScene& scene = f.scene_of(rtapi::TraversalPrecision::kRobust);
            if (is_visibility(set)) {
              return compare<uint32_t>(
                  name, f, measure, scene, Program::kVisible, f.rays(set),
                  [&](const RayGrid& grid, auto& out) { own.visible(f.arena(), grid, out); });
            }
            return compare<ClosestResult>(
                name, f, measure, scene, Program::kClosest, f.rays(set),
                [&](const RayGrid& grid, auto& out) { own.closest(f.arena(), grid, out); });
          }};
}

// Exact precision against robust, both through DispatchRays, with the lounge and its camera at a
// distance from the origin.
template <typename T>
Line compare_precisions(const std::string& name, Fixtures& f, const Measure& measure,
                        Program program, RaySet set, float distance) {
  using rtapi::TraversalPrecision;
  const RayGrid& grid = f.rays(set, distance);
  DxrDispatch robust(f.scene_of(TraversalPrecision::kRobust, distance), program, grid);
  bool read = false;  // by the warm-up run
  const auto run_robust = [&](const RayGrid&, std::vector<T>& out) {
    robust.run();
    if (!std::exchange(read, true)) out = robust.results<T>();
  };
  return compare<T>(name, f, measure, f.scene_of(TraversalPrecision::kExact, distance), program,
                    grid, run_robust, distance == 0 ? kAllowedDifference : kAllowedFarAway);
}

Case exact_case(RaySet set, float distance, const char* suffix) {
  const std::string name = std::string("exact/embree/") + name_of(set) + suffix;
  return {name, [=](Fixtures& f, const Measure& measure) {
            if (is_visibility(set)) {
              return compare_precisions<uint32_t>(name, f, measure, Program::kVisible, set,
                                                  distance);
            }
            return compare_precisions<ClosestResult>(name, f, measure, Program::kClosest, set,
                                                     distance);
          }};
}

// A checked device against an ordinary one, both through DispatchRays.
template <typename T>
Line compare_checked(const std::string& name, Fixtures& f, const Measure& measure, Program program,
                     RaySet set) {
  const RayGrid& grid = f.rays(set);
  DxrDispatch usual(f.scene_of(rtapi::TraversalPrecision::kRobust), program, grid);
  bool read = false;  // by the warm-up run
  return compare<T>(name, f, measure, f.checked_scene(), program, grid,
                    [&](const RayGrid&, std::vector<T>& out) {
                      usual.run();
                      if (!std::exchange(read, true)) out = usual.results<T>();
                    });
}

Case checked_case(RaySet set) {
  const std::string name = std::string("checked/embree/") + name_of(set);
  return {name, [=](Fixtures& f, const Measure& measure) {
            if (is_visibility(set)) {
              return compare_checked<uint32_t>(name, f, measure, Program::kVisible, set);
            }
            return compare_checked<ClosestResult>(name, f, measure, Program::kClosest, set);
          }};
}

// HitObject::TraceRay and Invoke against TraceRay, both through DispatchRays.
template <typename T>
Line compare_hit_objects(const std::string& name, Fixtures& f, const Measure& measure,
                         Program usual_program, Program program) {
  const RayGrid& grid = f.rays(RaySet::kPrimary);
  DxrScene& scene = f.scene_of(rtapi::TraversalPrecision::kRobust);
  DxrDispatch usual(scene, usual_program, grid);
  bool read = false;  // by the warm-up run
  return compare<T>(name, f, measure, scene, program, grid,
                    [&](const RayGrid&, std::vector<T>& out) {
                      usual.run();
                      if (!std::exchange(read, true)) out = usual.results<T>();
                    });
}

Line hit_objects(Fixtures& f, const Measure& measure) {
  return compare_hit_objects<ClosestResult>("hit-object/embree/primary", f, measure,
                                            Program::kClosest, Program::kHitObject);
}

Line shaded_hit_objects(Fixtures& f, const Measure& measure) {
  return compare_hit_objects<ShadedResult>("hit-object/embree/shaded", f, measure, Program::kShaded,
                                           Program::kShadedHitObject);
}

Line alpha_sun(Fixtures& f, const Measure& measure) {
  const EmbreeScene& embree = f.embree_scene(true);
  return compare<uint32_t>(
      "dispatch/embree/alpha-sun", f, measure, f.dxr_scene(true), Program::kAlphaTested,
      f.rays(RaySet::kSun),
      [&](const RayGrid& grid, auto& out) { embree.visible(f.arena(), grid, out); });
}

Line shaded(Fixtures& f, const Measure& measure) {
  const EmbreeScene& embree = f.embree_scene(false);
  return compare<ShadedResult>(
      "dispatch/embree/shaded", f, measure, f.dxr_scene(false), Program::kShaded,
      f.rays(RaySet::kPrimary),
      [&](const RayGrid& grid, auto& out) { embree.shaded(f.arena(), grid, out); });
}

}  // namespace

std::vector<Case> dispatch_cases() {
  std::vector<Case> cases;
  for (RaySet set : kRaySets) cases.push_back(minimal_case(set));
  cases.push_back({"dispatch/embree/alpha-sun", alpha_sun});
  cases.push_back({"dispatch/embree/shaded", shaded});
  for (RaySet set : kRaySets) cases.push_back(same_tlas_case(set));
  for (RaySet set : kRaySets) cases.push_back(exact_case(set, 0, ""));
  for (RaySet set : kRaySets) cases.push_back(exact_case(set, 1e4f, "-at-1e4"));
  for (RaySet set : kRaySets) cases.push_back(exact_case(set, 1e6f, "-at-1e6"));
  for (RaySet set : kRaySets) cases.push_back(checked_case(set));
  cases.push_back({"hit-object/embree/primary", hit_objects});
  cases.push_back({"hit-object/embree/shaded", shaded_hit_objects});
  return cases;
}

}  // namespace kaamos::bench
