// SPDX-License-Identifier: MIT
//
// Single rays at one instance of one mesh, through rtapi.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>

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
  float t = 0.0f;  // -1: no hit
  glm::vec2 barycentrics{0.0f};
  std::uint32_t primitive = 0;
};

struct ProbeMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Rows of the instance's transform: rotation and scale in xyz, translation in w.
  glm::mat3x4 transform{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

// A device with one mesh to trace rays at. All functions throw rtapi::ResultError.
class RayProbe {
 public:
  explicit RayProbe(const rtapi::DeviceDesc& desc = {});
  void set_mesh(const ProbeMesh& mesh);
  // One hit for each ray.
  std::vector<ProbeHit> hits(const std::vector<ProbeRay>& rays);
  // For each ray, how many triangles an any-hit shader that ignores all of them is called for.
  std::vector<std::uint32_t> triangle_counts(const std::vector<ProbeRay>& rays);

 private:
  std::vector<ProbeHit> run(const rtapi::ShaderTable& ray_generation,
                            const std::vector<ProbeRay>& rays);

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_signature_;
  rtapi::StateObject pipeline_;
  rtapi::ShaderTable hits_, counts_, miss_, groups_;
  rtapi::Buffer bottom_level_;
  rtapi::Buffer top_level_;
};

// Uses a RayProbe for this mesh alone.
std::vector<ProbeHit> probe(const ProbeMesh& mesh, const std::vector<ProbeRay>& rays);

}  // namespace kaamos::test
