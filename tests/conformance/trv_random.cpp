// SPDX-License-Identifier: MIT
//
// Random scenes against the reference, one test for each group of rules.
#include "tests/conformance/judge.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

struct Options {
  uint32_t seed = 1;
  SceneOptions scene = {};
  Mode mode = kIgnoreAll;
  std::vector<uint32_t> flags = {0};  // each ray takes one of these
  void (*change)(Random& random, Ray& ray) = nullptr;
};

Coverage walk_and_judge(Context& t, const Options& options) {
  Random random(options.seed);
  const Scene scene = random_scene(random, options.scene);
  std::vector<Ray> rays = random_rays(random, scene, 400, options.mode, options.flags);
  for (Ray& ray : rays) {
    if (options.change != nullptr) options.change(random, ray);
  }
  Walker walker(t);
  walker.build(scene);
  const Coverage out = judge(t, scene, rays, walker.walk(rays));
  t.equal("any-hit shaders beside another of their ray, or after its end", walker.faults(), 0u);
  t.holds("rounding cannot turn most rays", 10 * out.certain > 6 * out.rays);
  return out;
}

// All hits are ignored: each primitive that a ray crosses must show up, exactly once.
void every_primitive_once(Context& t) {
  const Coverage coverage = walk_and_judge(t, {});
  t.holds("hundreds of primitives were crossed", coverage.required_events > 500);
  t.equal("hits", coverage.hits, 0u);
}

void some_are_accepted(Context& t) {
  Options options;
  options.seed = 2;
  options.scene.opaque = options.scene.null_groups = true;
  options.mode = kAcceptSome;
  const Coverage coverage = walk_and_judge(t, options);
  t.holds("many rays hit", coverage.hits > 100);
  t.holds("many any-hit shaders ran", coverage.required_events > 100);
}

void some_end_the_search(Context& t) {
  Options options;
  options.seed = 3;
  options.scene.opaque = options.scene.null_groups = true;
  options.mode = kEndSome;
  options.flags = {0, 0x4, 0x8, 0xC};
  const Coverage coverage = walk_and_judge(t, options);
  t.holds("many rays hit", coverage.hits > 100);
  t.holds("many any-hit shaders ran", coverage.events > 100);
}

void opacity_culling_and_masks(Context& t) {
  Options options;
  options.seed = 4;
  options.scene.opaque = options.scene.null_groups = options.scene.instance_flags = true;
  options.mode = kAcceptSome;
  options.flags = {0,     0x1,  0x2,  0x10, 0x20, 0x40,  0x80,  0x100,
                   0x200, 0x11, 0x22, 0x50, 0xA0, 0x210, 0x108, 0x24};
  options.change = [](Random& random, Ray& ray) {
    if (random.chance(0.5)) ray.mask = random.below(0x1FF);
  };
  const Coverage coverage = walk_and_judge(t, options);
  t.holds("many rays hit", coverage.hits > 60);
  t.holds("many any-hit shaders ran", coverage.required_events > 60);
}

void intervals(Context& t) {
  Options options;
  options.seed = 5;
  options.mode = kAcceptSome;
  options.change = [](Random& random, Ray& ray) {
    // The target is at 1 / stretch, between 0.5 and 20.
    ray.t_min = random.chance(0.5) ? random.between(0, 2) : 0;
    ray.t_max = ray.t_min + random.between(0.1f, 6);
  };
  const Coverage coverage = walk_and_judge(t, options);
  t.holds("many rays hit", coverage.hits > 60);
  t.holds("many any-hit shaders ran", coverage.required_events > 60);
}

}  // namespace

std::vector<RuleTest> trv_random_tests() {
  return {{"TRV-01, TRV-02, TRV-11, TRV-15, TRV-24, TRV-25, TRV-31, SV-07, SV-08",
           every_primitive_once},
          {"TRV-05, TRV-20, TRV-21, TRV-22, TRV-26, TRV-28, TRV-45", some_are_accepted},
          {"TRV-23, TRV-24, TRV-25, TRV-26, TRV-45, FLG-32, FLG-33, FLG-35", some_end_the_search},
          {"FLG-12, FLG-16, FLG-21, FLG-22, FLG-23, FLG-24, FLG-25, FLG-26, FLG-30",
           opacity_culling_and_masks},
          {"TRV-03, TRV-04", intervals}};
}

}  // namespace kaamos::conformance
