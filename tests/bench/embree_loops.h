// SPDX-License-Identifier: MIT
//
// The baselines: what one would write by hand on Embree for the same rays. Robust scenes, Embree's
// own instances, 16 x 16 tiles on oneTBB, denormals flushed, one ray per call.
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/embree/embree_shim.h"
#include "scene_data.h"

namespace kaamos::bench {

// The results that the shaders write; the layouts are those of bench.hlsl. A miss has t = -1.
struct ClosestResult {
  float t;
  uint32_t primitive;
};
struct ShadedResult {
  float color[3];
  float t;
  float normal[3];
  uint32_t material;
};
static_assert(sizeof(ShadedResult) == 32);

// A grid of rays, row by row.
struct RayGrid {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<Ray> rays;
};

// A ray of a frame, and whether it only asks if there is a hit.
struct FrameRay {
  Ray ray;
  bool visibility = false;
};

// Configured like the Embree backend's device.
RTCDevice new_embree_device();

// A geometry with its own copies of a geometry's buffers, not committed.
RTCGeometry new_triangles(RTCDevice device, const MeshData& mesh, const GeometryData& geometry);

class EmbreeScene {
 public:
  // `alpha_tested`: plants get a filter that tests their texture; otherwise everything is opaque.
  EmbreeScene(const SceneData& data, bool alpha_tested);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // The hits of the camera's rays; a ray that misses gets the previous ray's point.
  std::vector<SurfacePoint> surface_points(const RayGrid& primary) const;

  void closest(tbb::task_arena& arena, const RayGrid& grid,
               std::vector<ClosestResult>& results) const;
  // Writes 1 where nothing is hit. Calls the filters if there are any.
  void visible(tbb::task_arena& arena, const RayGrid& grid, std::vector<uint32_t>& results) const;
  void shaded(tbb::task_arena& arena, const RayGrid& grid,
              std::vector<ShadedResult>& results) const;

  // Traces the rays in order, 256 to a task, and returns how many hit something.
  uint64_t trace(tbb::task_arena& arena, const std::vector<FrameRay>& rays) const;

  // Paths of one diffuse material under a sun: at each of `bounces` + 1 surfaces a ray to a point
  // of its disk, then on in a cosine-weighted direction. `primary`: a ray for each pixel, from
  // which `samples` paths start. Returns the mean light of all paths, and in `lit` which part of
  // their first surfaces sees the sun.
  struct PathScene {
    float albedo;
    float to_sun[3];
    float tan_sun_radius;
    float sun_irradiance;
    uint32_t bounces;
  };
  double paths(tbb::task_arena& arena, const RayGrid& primary, uint32_t samples,
               const PathScene& paths, double& lit) const;

  // The data that the filter needs.
  struct GeometryUse {
    const EmbreeScene* scene;
    const MeshData* mesh;
    const GeometryData* geometry;
  };
  bool is_open(const GeometryUse& use, uint32_t primitive, float u, float v) const;

 private:
  RTCScene build_mesh(const MeshData& mesh, bool alpha_tested);
  void shade(const RTCRayHit& hit, ShadedResult& result) const;

  const SceneData& data_;
  std::vector<MaterialData> materials_;
  std::vector<std::unique_ptr<GeometryUse>> uses_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace kaamos::bench
