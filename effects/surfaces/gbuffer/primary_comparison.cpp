// SPDX-License-Identifier: MIT
#include "effects/surfaces/gbuffer/primary_comparison.h"

#include <shaders/primary_ids.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

namespace {

constexpr double kDepthJump = 0.01;  // of the nearer one
// Mean distance in pixels by which snapping moves an edge: each end by up to 1/512 along x and y.
constexpr double kEdgeShift = 7.3e-4;
constexpr double kEquilateral = 4.559;  // perimeter of such a triangle over the root of its area

using Corners = std::array<glm::dvec3, 3>;

// The instances as one of the pictures shows them.
std::span<const rtapi::RaytracingInstanceDesc> seen_instances(const GpuScene& gpu, bool is_drawn) {
  return (is_drawn && gpu.drawn_instances ? gpu.drawn_instances : gpu.instances)
      .data<rtapi::RaytracingInstanceDesc>();
}

std::uint32_t mesh_of(const GpuScene& gpu, const rtapi::RaytracingInstanceDesc& desc) {
  return gpu.geometries[desc.InstanceContributionToHitGroupIndex / kRayTypeCount].mesh;
}

// World positions. Skinned meshes are taken in their bind pose, which has the same neighbours.
Corners corners_of(const Scene& scene, const GpuScene& gpu, const SeenTriangle& seen,
                   bool is_drawn) {
  const auto& desc = seen_instances(gpu, is_drawn)[seen.instance - 1];
  const Mesh& mesh = scene.meshes[mesh_of(gpu, desc)];
  Corners out;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const glm::vec4 p(mesh.corner(mesh.geometries[seen.geometry], seen.primitive, i).position, 1);
    for (int row = 0; row < 3; ++row) {
      const float* m = desc.Transform[row];
      out[i][row] = glm::dot(glm::dvec4(m[0], m[1], m[2], m[3]), glm::dvec4(p));
    }
  }
  return out;
}

// A corner of one is at a corner of the other, or so close that only rounding parts them.
bool share_a_corner(const Corners& a, const Corners& b) {
  for (const glm::dvec3& p : a) {
    for (const glm::dvec3& q : b) {
      if (glm::length(p - q) <= 1e-6 * (1 + glm::length(p))) return true;
    }
  }
  return false;
}

// Returns how likely a pixel of a triangle is to flip. An edge is shared by two triangles, so half
// of the perimeter counts. Zero for one that reaches behind the camera: it is large.
double flip_chance(const Corners& corners, const Camera& camera, std::uint32_t height) {
  const double scale = height / (2 * camera.picture_half_height());
  std::array<glm::dvec2, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const double depth = glm::dot(corners[i], camera.forward());
    if (!(depth > 0)) return 0;
    p[i] = glm::dvec2(glm::dot(corners[i], glm::dvec3(camera.camera_to_world[0])),
                      glm::dot(corners[i], glm::dvec3(camera.camera_to_world[1]))) *
           (camera.is_orthographic() ? scale : scale / depth);
  }
  const glm::dvec2 a = p[1] - p[0], b = p[2] - p[0];
  const double area = 0.5 * std::fabs(a.x * b.y - a.y * b.x);
  const double perimeter = glm::length(a) + glm::length(b) + glm::length(p[2] - p[1]);
  return std::min(1.0, kEdgeShift * 0.5 * perimeter / std::max(area, 1e-12));
}

double over(double count, std::uint64_t of) {
  return count / static_cast<double>(std::max<std::uint64_t>(of, 1));
}

}  // namespace

double PrimaryDifference::share() const {
  return over(static_cast<double>(differing()), covered);
}

double PrimaryDifference::pixels_per_triangle() const {
  return over(static_cast<double>(covered), triangles);
}

double PrimaryDifference::expected_share() const {
  return over(expected, covered);
}

double PrimaryDifference::expected_share_of_equals() const {
  return triangles == 0 ? 0.0 : kEdgeShift * 0.5 * kEquilateral / std::sqrt(pixels_per_triangle());
}

PrimaryDifference compare_pictures(const Scene& scene, const GpuScene& gpu,
                                   const SeenPictures& pictures) {
  PrimaryDifference out;
  const auto drawn = seen_instances(gpu, true), traced = seen_instances(gpu, false);
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint64_t> sizes;
  for (std::size_t i = 0; i < pictures.traced.size(); ++i) {
    const SeenTriangle &a = pictures.drawn[i], &b = pictures.traced[i];
    ++out.pixels;
    if (b.instance != 0) {
      ++out.covered;
      ++sizes[{b.instance, b.geometry, b.primitive}];
    }
    const bool other_level =
        a.instance != 0 && a.instance == b.instance &&
        mesh_of(gpu, drawn[a.instance - 1]) != mesh_of(gpu, traced[a.instance - 1]);
    if (a.same_triangle(b) && !other_level) continue;
    if (a.instance == 0 || b.instance == 0) {
      ++out.hit_or_not;
    } else if (other_level) {
      ++out.other_levels;
    } else if (std::fabs(a.view_z - b.view_z) > kDepthJump * std::min(a.view_z, b.view_z)) {
      ++out.silhouettes;
    } else if (share_a_corner(corners_of(scene, gpu, a, true), corners_of(scene, gpu, b, false))) {
      ++out.neighbours;
    } else {
      ++out.others;
    }
  }
  out.triangles = sizes.size();
  for (const auto& [id, size] : sizes) {
    const auto& [instance, geometry, primitive] = id;
    const Corners corners = corners_of(scene, gpu, {instance, geometry, primitive}, false);
    out.expected +=
        static_cast<double>(size) * flip_chance(corners, pictures.camera, pictures.height);
  }
  return out;
}

rtapi::Result<std::vector<SeenTriangle>> read_drawn(const rtapi::Device& device,
                                                    rtapi::CommandQueue& queue, const Frame& frame,
                                                    const GpuScene& gpu,
                                                    const RasterGBuffer& raster) {
  const auto bytes = rtapi::ReadbackTexture(device, queue, raster.visibility(), 0);
  if (!bytes) return bytes.error();
  const auto view_z = frame.read(device, queue, kViewZ);
  if (!view_z) return view_z.error();
  std::vector<SeenTriangle> out(view_z->values.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::uint32_t seen[2];
    std::memcpy(seen, bytes->data() + i * sizeof seen, sizeof seen);
    if (seen[0] == 0) continue;
    const SceneDraw& draw = raster.draws()[seen[0] - 1];
    out[i] = {draw.instance + 1, gpu.geometries[draw.geometry].constants.geometry_id, seen[1],
              view_z->values[i]};
  }
  return out;
}

rtapi::Result<std::vector<SeenTriangle>> trace_seen(const rtapi::Device& device,
                                                    rtapi::CommandQueue& queue, const Frame& frame,
                                                    const GpuScene& gpu) {
  const auto library = rtapi::LoadShaderLibrary(kaamos_shaders_primary_ids());
  if (!library) return library.error();
  RayPassDesc desc;
  desc.name = "primary ids";
  desc.library = *library;
  desc.ray_generation = "PrimaryIdsRayGen";
  desc.miss[kRayTypeSurface] = "PrimaryIdsMiss";
  desc.hit[kRayTypeSurface] = {"PrimaryIdsAnyHit", "PrimaryIdsClosestHit"};
  const auto pass = RayPass::create(device, frame, gpu, desc);
  if (!pass) return pass.error();
  const auto picture =
      frame.create_picture(device, "primary ids", rtapi::Format::kR32G32B32A32Uint);
  if (!picture) return picture.error();
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto s = views->set_unordered_access(0, *picture); !s) return s.error();
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  pass->dispatch(*list, frame, {.sample_count = 1}, frame.height(), PassArguments(*views));
  if (const auto s = queue.ExecuteAndWait(*list); !s) return s.error();
  const auto bytes = rtapi::ReadbackTexture(device, queue, *picture, 0);
  if (!bytes) return bytes.error();
  std::vector<SeenTriangle> out(bytes->size() / sizeof(SeenTriangle));
  std::memcpy(out.data(), bytes->data(), out.size() * sizeof(SeenTriangle));
  return out;
}

rtapi::Result<PrimaryDifference> compare_with_rays(const rtapi::Device& device,
                                                   rtapi::CommandQueue& queue, const Frame& frame,
                                                   const Scene& scene, const GpuScene& gpu,
                                                   const Camera& camera,
                                                   const RasterGBuffer& raster) {
  const auto drawn = read_drawn(device, queue, frame, gpu, raster);
  if (!drawn) return drawn.error();
  const auto traced = trace_seen(device, queue, frame, gpu);
  if (!traced) return traced.error();
  return compare_pictures(scene, gpu, {*drawn, *traced, camera, frame.height()});
}

}  // namespace kaamos::effects
