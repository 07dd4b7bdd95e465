// SPDX-License-Identifier: MIT
//
// The baseline of vulkan/...: the least Vulkan program for the same rays, on the same driver, with
// the triangles in the order that it is given. One hit group without records, results straight from
// the payload, rows alternating between the halves of the picture as the backend's do.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "embree_loops.h"
#include "scene_data.h"

namespace kaamos::bench {

// Positions of a mesh and, for each of its geometries, the indices of its triangles.
struct HandMesh {
  std::vector<float> positions;
  std::vector<std::vector<uint32_t>> geometries;
};

// The meshes of the scene, with their triangles in the order in which the backend would pass them
// to the driver, or (`sorted` false) in the scene's order.
std::vector<HandMesh> hand_meshes(const SceneData& data, bool sorted);
// Sorts the triangles of one mesh.
void sort_for_driver(HandMesh& mesh);

// Throws std::runtime_error with what failed.
class HandVulkan {
 public:
  HandVulkan(const std::vector<HandMesh>& meshes, const std::vector<InstanceData>& instances);
  ~HandVulkan();

  // Uploads rays; the calls below trace them.
  void set_rays(const RayGrid& grid);
  void closest();
  void visible();
  std::vector<ClosestResult> closest_results() const;
  std::vector<uint32_t> visible_results() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kaamos::bench
