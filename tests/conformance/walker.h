// SPDX-License-Identifier: MIT
//
// Random scenes and rays, and the program that logs every any-hit shader in them.
#pragma once

#include <random>
#include <vector>

#include "tests/conformance/reference.h"

namespace kaamos::conformance {

struct Random {
  explicit Random(uint32_t seed) : engine(seed) {}
  // The same on every standard library, unlike its distributions.
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(engine() % end); }
  bool chance(double p) { return engine() < p * 4294967296.0; }
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(engine() >> 8) * 0x1p-24f;
  }
  std::mt19937 engine;
};

struct SceneOptions {
  bool instance_flags = false;
  bool opaque = false;       // some geometries
  bool null_groups = false;  // and groups without any-hit shaders
  bool boxes = true;
};
// Bottom levels of triangles and of boxes, instanced with rotations, mirrored, sheared and scaled.
// Every geometry has NO_DUPLICATE_ANYHIT_INVOCATION.
Scene random_scene(Random& random, const SceneOptions& options);
// At points on the scene's primitives, from around it; some miss. Of `flags` each picks one.
std::vector<Ray> random_rays(Random& random, const Scene& scene, uint32_t count, Mode mode,
                             const std::vector<uint32_t>& flags = {0});

// An any-hit shader that ran.
struct Event {
  uint32_t packed;  // Candidate::packed()
  float t;          // RayTCurrent()
};
struct Walked {
  Seen seen;
  std::vector<Event> events;
};

// The library, and groups for Scene's records.
inline constexpr uint32_t kEventsPerRay = 48;
class Walker : public Standard {
 public:
  explicit Walker(Context& t);
  void build(const Scene& description);
  std::vector<Walked> walk(const std::vector<Ray>& rays);
  // How many any-hit shaders ran for each ray, in a scene whose record 0 is "Ignored".
  std::vector<uint32_t> count(const std::vector<Ray>& rays);
  // In the last walk: any-hit shaders that ran beside another of their ray, or after its end.
  uint32_t faults() const { return faults_; }

 private:
  uint32_t faults_ = 0;
  Context* context_;
};

}  // namespace kaamos::conformance
