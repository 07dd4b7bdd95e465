// SPDX-License-Identifier: MIT
//
// The questions that the tests of inline ray tracing ask of query.hlsl.
#pragma once

#include <cstring>
#include <vector>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

// The bits of query.hlsl's Ray.contribution.
enum Do : uint32_t {
  kCommitTriangles = 1,
  kCommitBoxes = 2,
  kAbort = 4,
  kTwice = 8,
  kStop = 16,
};
struct Asked {
  uint32_t status;  // Committed
  uint32_t triangles;
  uint32_t boxes;
  uint32_t non_opaque_boxes;
  float t;
  uint32_t instance_index;
  uint32_t instance_id;
  uint32_t contribution;
  uint32_t geometry;
  uint32_t primitive;
  uint32_t front_face;
  uint32_t flags;
  float barycentrics[2];
  uint32_t status_on_the_way;
  uint32_t proceeds;
};
static_assert(sizeof(Asked) == 64);
enum Committed : uint32_t { kNothing, kTriangle, kBox };

enum Flags : uint32_t {
  kForceOpaque = 1,
  kForceNonOpaque = 2,
  kAcceptFirst = 4,
  kCullOpaque = 0x40,
  kCullNonOpaque = 0x80,
  kSkipTriangles = 0x100,
  kSkipBoxes = 0x200,
};

template <class T>
T at(const std::vector<uint32_t>& words, size_t byte_offset) {
  T out;
  std::memcpy(&out, &words[byte_offset / 4], sizeof out);
  return out;
}

// A ray whose query does `what` (Do).
Ray asking(uint32_t what, uint32_t flags = 0, float x = 0);

// One shader of query.hlsl, without hit groups, and no table but its own.
class Query : public Program {
 public:
  Query(Context& t, const char* shader);
  std::vector<uint32_t> run_rays(const rtapi::Buffer& top_level, const std::vector<Ray>& list,
                                 uint32_t width = 1);

 private:
  Context* context_;
};

std::vector<Asked> ask(Context& t, const rtapi::Buffer& top_level, const std::vector<Ray>& list);
Asked ask(Context& t, const rtapi::Buffer& top_level, const Ray& ray);

// The tests of rq_tests about what queries report and where they may live.
std::vector<RuleTest> rq_accessors_tests();

}  // namespace kaamos::conformance
