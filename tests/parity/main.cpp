// SPDX-License-Identifier: MIT
//
// kaamos-parity: traces a set of rays on two backends and reports the differences; with --ray,
// prints everything known about that ray.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "tests/parity/rays.h"
#include "tests/parity/sampled.h"

using namespace kaamos::parity;

int main(int argc, char** argv) {
  RaySet set{"lounge", "primary"};
  std::string backends[2] = {"embree", "vulkan"};
  std::string size = "480x270";
  int64_t ray = -1;
  CLI::App app("kaamos-parity: the same rays on two backends");
  app.add_option("--scene", set.scene, "lounge, mixed, or a glTF file")->capture_default_str();
  app.add_option("--rays", set.kind, "primary, flags, sun, ao, diffuse")->capture_default_str();
  app.add_option("--size", size, "size of the picture that the rays begin with")
      ->capture_default_str();
  app.add_option("--seed", set.seed, "seed of random rays")->capture_default_str();
  app.add_option("--first", backends[0], "the backend to compare with")->capture_default_str();
  app.add_option("--second", backends[1], "the backend to be compared")->capture_default_str();
  app.add_option("--ray", ray, "the number of one ray: show what both backends found");
  std::vector<float> from;
  std::vector<float> along;
  ProbeRay given;
  app.add_option("--from", from, "trace one ray of your own: x y z, from the camera")->expected(3);
  app.add_option("--along", along, "its direction: x y z")->expected(3);
  app.add_option("--t-min", given.t_min, "its TMin")->capture_default_str();
  app.add_option("--t-max", given.t_max, "its TMax")->capture_default_str();
  app.add_option("--flags", given.flags, "its ray flags")->capture_default_str();
  app.add_option("--mask", given.mask, "its instance mask")->capture_default_str();
  uint32_t sampled = 0;
  app.add_option("--sampled", sampled,
                 "instead of rays: the largest error of this many reads between two texels");
  CLI11_PARSE(app, argc, argv);
  if (std::sscanf(size.c_str(), "%ux%u", &set.width, &set.height) != 2 || set.width == 0) {
    std::fprintf(stderr, "kaamos-parity: --size %s is not a size, like 480x270\n", size.c_str());
    return 2;
  }
  if (!from.empty() && !along.empty()) {
    for (size_t i = 0; i < 3; ++i) {
      given.origin[i] = from[i];
      given.direction[i] = along[i];
    }
    set.kind = "given";
    set.width = set.height = 1;
    set.given = {given};
    ray = 0;
  }
  try {
    if (sampled != 0) {
      const auto values = sample_between_texels(backends[1], sampled);
      double worst = 0;
      for (uint32_t i = 0; i < sampled; ++i) {
        worst = std::max(worst, std::fabs(values[i] - (i + 0.5) / sampled));
      }
      std::printf("%.9g\n", worst);
      return 0;
    }
    const RayRun run = trace_on_both(set, backends);
    if (ray >= 0) {
      const auto i = static_cast<size_t>(ray);
      if (i >= run.rays.size()) {
        std::fprintf(stderr, "kaamos-parity: there are %zu rays\n", run.rays.size());
        return 2;
      }
      const ProbeRay& r = run.rays[i];
      std::printf(
          "ray %zu: from %.9g %.9g %.9g along %.9g %.9g %.9g, t %.9g to %.9g, flags 0x%x, "
          "mask 0x%x\n",
          i, double{r.origin[0]}, double{r.origin[1]}, double{r.origin[2]}, double{r.direction[0]},
          double{r.direction[1]}, double{r.direction[2]}, double{r.t_min}, double{r.t_max}, r.flags,
          r.mask);
      for (int b = 0; b < 2; ++b) {
        std::printf("%s: %s\n", backends[b].c_str(), describe(run.hits[b][i]).c_str());
      }
      return 0;
    }
    const HitDifference difference = compare_hits(run.hits[0], run.hits[1], run.picture_width);
    std::printf("%s\n", describe(difference).c_str());
    if (difference.worst_change != HitChange::kNone) {
      std::printf(
          "worst, ray %llu:\n  %s\n  %s\n", static_cast<unsigned long long>(difference.worst_ray),
          difference.worst_text.c_str(), retrace_command(set, difference.worst_ray).c_str());
    }
    const std::string verdict = judge(difference);
    if (!verdict.empty()) std::printf("too much: %s\n", verdict.c_str());
    return verdict.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kaamos-parity: %s\n", error.what());
    return 1;
  }
}
