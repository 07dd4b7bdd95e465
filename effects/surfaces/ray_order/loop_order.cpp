// SPDX-License-Identifier: MIT
#include "effects/surfaces/ray_order/loop_order.h"

#include <rtapi/upload.h>
#include <shaders/loop_order.h>

#include <glm/glm.hpp>
#include <vector>

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kTile = 8;           // pixels on a side, of one thread
constexpr std::uint32_t kTilesPerGroup = 8;  // side by side

/// Mirrors Corners in loop_order.hlsl.
struct Corners {
  glm::vec3 corners[3];
};
static_assert(sizeof(Corners) == 36);

/// Mirrors LoopConstants in loop_order.hlsl.
struct LoopConstants {
  std::uint32_t triangle_count;
  std::uint32_t pixels_inside;
  std::uint32_t width;
  std::uint32_t height;
};

std::vector<Corners> seen_triangles(const Scene& scene, const glm::dvec3& camera) {
  std::vector<Corners> out;
  for (const Instance& instance : scene.instances) {
    if ((instance.mask & ~kMaskTransparent) == 0) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const Geometry& geometry : mesh.geometries) {
      for (std::uint32_t i = 0; i < geometry.index_count / 3; ++i) {
        Corners triangle;
        for (std::uint32_t k = 0; k < 3; ++k) {
          const glm::dvec4 corner(glm::dvec3(mesh.corner(geometry, i, k).position), 1.0);
          triangle.corners[k] = glm::vec3(glm::dvec3(instance.transform * corner) - camera);
        }
        out.push_back(triangle);
      }
    }
  }
  return out;
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> loop_order_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_loop_order());
}

rtapi::Result<VisibilityLoops> VisibilityLoops::create(const rtapi::Device& device,
                                                       const Frame& frame, const Scene& scene,
                                                       const glm::dvec3& camera,
                                                       const rtapi::ShaderLibrary& library) {
  VisibilityLoops out;
  std::vector<Corners> triangles = seen_triangles(scene, camera);
  out.triangle_count_ = static_cast<std::uint32_t>(triangles.size());
  if (triangles.empty()) triangles.emplace_back();  // a buffer has at least a byte
  const auto buffer = rtapi::CreateUploadBuffer(device, triangles, "triangles of the loops");
  if (!buffer) return buffer.error();
  out.triangles_ = *buffer;
  const auto seen = frame.create_picture(device, "seen by the loops", rtapi::Format::kR32G32Float);
  if (!seen) return seen.error();
  out.seen_ = *seen;
  const auto pass = ComputePass::create(device, frame, library, "FindSeen");
  if (!pass) return pass.error();
  out.pass_ = *pass;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  if (const auto s = out.views_.set_shader_resource(0, out.triangles_, sizeof(Corners)); !s) {
    return s.error();
  }
  if (const auto s = out.views_.set_unordered_access(0, out.seen_); !s) return s.error();
  return out;
}

void VisibilityLoops::dispatch(rtapi::CommandList& list, const Frame& frame,
                               LoopOrder order) const {
  const LoopConstants constants = {triangle_count_, order == LoopOrder::kRaster ? 1u : 0u,
                                   frame.width(), frame.height()};
  const auto parts = [](std::uint32_t whole, std::uint32_t part) {
    return (whole + part - 1) / part;
  };
  pass_.dispatch_groups(list, frame, {}, PassArguments(views_, constants),
                        parts(frame.width(), kTile * kTilesPerGroup), parts(frame.height(), kTile));
}

}  // namespace kaamos::effects
