// SPDX-License-Identifier: MIT
//
// Random scenes and rays, and the program whose any-hit shaders log every call.
#pragma once

#include <random>
#include <vector>

#include "tests/conformance/reference.h"

namespace kaamos::conformance {

struct Random {
  explicit Random(uint32_t seed) : engine(seed) {}
  // Gives the same numbers with every standard library, unlike its distributions.
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
  bool null_groups = false;  // and some groups without any-hit shaders
  bool boxes = true;
};
// Bottom levels of triangles and of boxes, in rotated, mirrored, sheared and scaled instances.
// Every geometry has NO_DUPLICATE_ANYHIT_INVOCATION.
Scene random_scene(Random& random, const SceneOptions& options);
// Rays from around the scene at points on its primitives; some miss. Each takes one of `flags`.
std::vector<Ray> random_rays(Random& random, const Scene& scene, uint32_t count, Mode mode,
                             const std::vector<uint32_t>& flags = {0});

// One run of an any-hit shader.
struct Event {
  uint32_t packed;  // Candidate::packed()
  float t;          // RayTCurrent()
};
struct Walked {
  Seen seen;
  std::vector<Event> events;
};

// The program for this library, with groups for Scene's records.
inline constexpr uint32_t kEventsPerRay = 48;
class Walker : public Standard {
 public:
  explicit Walker(Context& t);
  void build(const Scene& description);
  std::vector<Walked> walk(const std::vector<Ray>& rays);
  // Returns how many any-hit shaders ran for each ray, in a scene whose record 0 is "Ignored".
  std::vector<uint32_t> count(const std::vector<Ray>& rays);
  // Any-hit shaders in the last walk that overlapped another one of their ray, or ran after its
  // end.
  uint32_t faults() const { return faults_; }

 private:
  uint32_t faults_ = 0;
  Context* context_;
};

}  // namespace kaamos::conformance
