// SPDX-License-Identifier: MIT
//
// Single rays at one instance of one mesh, through rtapi.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace kaamos::test {

struct ProbeRay {
  glm::vec3 origin{0.0f};
  float t_min = 0.0f;
  glm::vec3 direction{0.0f};
  float t_max = 0.0f;
};

struct ProbeHit {
  float t = 0.0f;  // -1: nothing
  glm::vec2 barycentrics{0.0f};
  std::uint32_t primitive = 0;
};

struct ProbeMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Rows of the instance's transform: rotation and scale left, translation in w.
  glm::mat3x4 transform{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

// One hit per ray. Throws rtapi::ResultError.
std::vector<ProbeHit> probe(const ProbeMesh& mesh, const std::vector<ProbeRay>& rays);

}  // namespace kaamos::test
