// SPDX-License-Identifier: MIT
#include "effects/occlusion/baked_ao/baked_ao.h"

#include <fmt/format.h>
#include <shaders/baked_ao.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <utility>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/ray_pass.h"
#include "effects/engine/scene_draws.h"

namespace kaamos::effects {

namespace {

constexpr const char* kLibrary = "occlusion/baked_ao/baked_ao";
constexpr std::uint32_t kMostCells = 1024;  // along an edge
constexpr std::uint32_t kColumns = 1024;    // of the grid that is dispatched

// Mirrors BakeConstants of baked_ao.hlsl.
struct BakeConstants {
  std::uint32_t rays = 0;
  std::uint32_t texels = 0;
  std::uint32_t columns = kColumns;
  std::uint32_t mask = kMaskBaked;
};

// Mirrors BakedPart of baked_ao.hlsl.
struct BakedPart {
  SceneDraw draw;
  std::uint32_t first_triangle = 0;
  std::uint32_t triangles = 0;
  std::uint32_t sides = 1;
  std::uint32_t padding = 0;
};
static_assert(sizeof(BakedPart) == 128);

// Mirrors BakedGrid of baked_ao.hlsl.
struct BakedGrid {
  std::uint32_t first = 0;
  glm::uvec2 cells{0};
  std::uint32_t part = 0;
  std::uint32_t corner = 0;
};

// A triangle's corner opposite its longest edge, and the two edges that meet there, metres.
struct Sides {
  std::uint32_t corner = 0;
  double first = 0, second = 0;
};

// Those of each triangle of a draw.
void add_sides(const Scene& scene, const GpuGeometry& gpu, const SceneDraw& draw,
               std::vector<Sides>& out) {
  const Mesh& mesh = scene.meshes[gpu.mesh];
  const Geometry& geometry = mesh.geometries[gpu.constants.geometry_id];
  const auto& rows = draw.object_to_world;
  const auto place = [&](std::uint32_t triangle, std::uint32_t corner) {
    const glm::dvec4 at(glm::dvec3(mesh.corner(geometry, triangle, corner).position), 0.0);
    return glm::dvec3(glm::dot(glm::dvec4(rows[0]), at), glm::dot(glm::dvec4(rows[1]), at),
                      glm::dot(glm::dvec4(rows[2]), at));
  };
  for (std::uint32_t triangle = 0; triangle < gpu.index_count / 3; ++triangle) {
    const glm::dvec3 at[] = {place(triangle, 0), place(triangle, 1), place(triangle, 2)};
    // From a corner to the next.
    const double edges[] = {glm::distance(at[0], at[1]), glm::distance(at[1], at[2]),
                            glm::distance(at[2], at[0])};
    const auto longest = static_cast<std::uint32_t>(std::max_element(edges, edges + 3) - edges);
    const std::uint32_t corner = (longest + 2) % 3;
    out.push_back({corner, edges[corner], edges[(corner + 2) % 3]});
  }
}

RayPassDesc bake_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "baked ambient occlusion";
  desc.library = library;
  desc.ray_generation = "BakeOcclusion";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  return desc;
}

class BakedAoPass : public EffectPass {
 public:
  explicit BakedAoPass(const EffectScope& scope)
      : frame_(scope.frame), gpu_(scope.gpu), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope);
  rtapi::Status begin_frame(const Camera&) override {
    place_parts();
    return {};
  }
  void record(rtapi::CommandList& list, const EffectSettings&,
              const PassConstants& constants) override {
    if (constants.radius != baked_radius_) bake(list, constants.radius);
    look_up_.dispatch(list, frame_, constants, PassArguments(views_), frame_.width(),
                      frame_.height());
  }
  std::uint64_t bytes() const override {
    return texels_.size() + grids_.size() + part_buffer_.size() + geometries_.size() +
           instances_.size();
  }

 private:
  void lay_out(const Scene& scene, double texel, std::uint64_t most);
  rtapi::Status create_buffers(const EffectScope& scope);
  void place_parts();
  void bake(rtapi::CommandList& list, float radius);

  const Frame& frame_;
  const GpuScene& gpu_;
  PassViews& views_;
  BakeConstants constants_;
  float baked_radius_ = -1;
  std::vector<BakedPart> parts_;     // in the order of instances
  std::vector<BakedGrid> grids_of_;  // by triangle of all parts; gone once they are on the device
  rtapi::Buffer texels_, grids_, part_buffer_, geometries_, instances_;
  RayPass bake_;
  ComputePass look_up_;
};

rtapi::Status BakedAoPass::create(const EffectScope& scope) {
  const auto settings = scope.settings.get_constants<BakedAoConstants>();
  if (!(settings.texel > 0) || !std::isfinite(settings.texel)) {
    return make_error(
        ErrorId::kSetting,
        fmt::format("BakedAoConstants::texel is {}; choose a length above 0 m", settings.texel));
  }
  constants_.rays = settings.rays;
  lay_out(scope.scene, settings.texel, settings.most_texels);
  if (const auto s = create_buffers(scope); !s) return s;
  const rtapi::ShaderLibrary& library = scope.library(kLibrary);
  auto bake_of = RayPass::create(scope.device, frame_, scope.gpu, bake_pass(library));
  if (!bake_of) return bake_of.error();
  bake_ = std::move(*bake_of);
  const auto look_up = ComputePass::create(scope.device, frame_, library, "LookUpOcclusion");
  if (!look_up) return look_up.error();
  look_up_ = *look_up;
  auto list = scope.device.CreateCommandList();
  if (!list) return list.error();
  bake(*list, scope.settings.radius);
  return scope.queue.ExecuteAndWait(*list);
}

void BakedAoPass::lay_out(const Scene& scene, double texel, std::uint64_t most) {
  std::vector<Sides> sides;
  for (const SceneDraw& draw : scene_draws(gpu_, kMaskBaked)) {
    const GpuGeometry& geometry = gpu_.geometries[draw.geometry];
    const auto flags = scene.materials[geometry.constants.material_id].constants.flags;
    BakedPart part;
    part.draw = draw;
    part.first_triangle = static_cast<std::uint32_t>(sides.size());
    part.sides = (flags & kMaterialDoubleSided) != 0 ? 2 : 1;
    add_sides(scene, geometry, draw, sides);
    part.triangles = static_cast<std::uint32_t>(sides.size()) - part.first_triangle;
    parts_.push_back(part);
  }
  // Texels twice as long are a quarter as many. A triangle has one in any case, which does not
  // count.
  for (bool fits = false; !fits; texel *= 2) {
    grids_of_.clear();
    std::uint64_t count = 0, more = 0;
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      for (std::uint32_t i = 0; i < parts_[p].triangles; ++i) {
        const Sides& of = sides[parts_[p].first_triangle + i];
        const glm::uvec2 cells(baked_cells(of.first, texel), baked_cells(of.second, texel));
        grids_of_.push_back({static_cast<std::uint32_t>(count), cells, p, of.corner});
        const std::uint64_t texels = std::uint64_t{cells.x + 1} * (cells.y + 1);
        count += parts_[p].sides * texels;
        more += parts_[p].sides * (texels - 1);
      }
    }
    fits = more <= most;
    constants_.texels = static_cast<std::uint32_t>(count);
  }
}

rtapi::Status BakedAoPass::create_buffers(const EffectScope& scope) {
  std::vector<HitConstants> geometries;
  for (const GpuGeometry& geometry : gpu_.geometries) geometries.push_back(geometry.constants);
  // No buffer is empty.
  if (geometries.empty()) geometries.emplace_back();
  if (grids_of_.empty()) grids_of_.emplace_back();
  const std::vector<BakedPart> parts(std::max<std::size_t>(parts_.size(), 1));
  const std::vector<glm::uvec2> ranges(std::max<std::size_t>(scope.scene.instances.size(), 1));
  const auto upload = [&](rtapi::Buffer& out, const auto& elements, std::uint32_t t,
                          const char* name) -> rtapi::Status {
    const auto buffer = rtapi::CreateUploadBuffer(scope.device, elements, name);
    if (!buffer) return buffer.error();
    out = *buffer;
    return views_.set_shader_resource(t, out, sizeof elements.front());
  };
  if (const auto s = upload(part_buffer_, parts, 0, "baked parts"); !s) return s;
  if (const auto s = upload(geometries_, geometries, 1, "baked geometries"); !s) return s;
  if (const auto s = upload(grids_, grids_of_, 2, "baked grids"); !s) return s;
  if (const auto s = upload(instances_, ranges, 3, "baked instances"); !s) return s;
  grids_of_ = {};
  rtapi::BufferDesc desc;
  desc.SizeInBytes = std::uint64_t{std::max(constants_.texels, 1u)} * sizeof(float);
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  desc.Name = "baked ambient occlusion";
  const auto buffer = scope.device.CreateBuffer(desc);
  if (!buffer) return buffer.error();
  texels_ = *buffer;
  place_parts();
  return views_.set_unordered_access(1, texels_, sizeof(float));
}

void BakedAoPass::place_parts() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, const BakedPart*> baked;
  for (const BakedPart& part : parts_) baked[{part.draw.instance, part.draw.geometry}] = &part;
  const auto ranges = instances_.data<glm::uvec2>();
  const auto parts = part_buffer_.data<BakedPart>();
  std::fill(ranges.begin(), ranges.end(), glm::uvec2(0));
  std::uint32_t count = 0;
  for (const SceneDraw& draw : scene_draws(gpu_, kMaskBaked)) {
    const auto found = baked.find({draw.instance, draw.geometry});
    if (found == baked.end()) continue;  // another level of detail
    parts[count] = *found->second;
    parts[count].draw = draw;
    glm::uvec2& range = ranges[draw.instance];
    if (range.y == 0) range.x = count;
    ++range.y;
    ++count;
  }
}

void BakedAoPass::bake(rtapi::CommandList& list, float radius) {
  baked_radius_ = radius;
  const std::uint32_t rows = (constants_.texels + kColumns - 1) / kColumns;
  if (rows == 0) return;
  bake_.dispatch_grid(list, frame_, {.radius = radius}, kColumns, rows,
                      PassArguments(views_, constants_));
}

}  // namespace

std::uint32_t baked_cells(double edge, double texel) {
  const double parts = std::round(edge / texel);
  if (!(parts > 0)) return 0;
  return static_cast<std::uint32_t>(std::min<double>(parts, kMostCells));
}

rtapi::Result<std::unique_ptr<EffectPass>> make_baked_ao(const EffectScope& scope) {
  return make_pass<BakedAoPass>(scope);
}

rtapi::Result<rtapi::ShaderLibrary> baked_ao_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_baked_ao());
}

}  // namespace kaamos::effects
