// SPDX-License-Identifier: MIT
#include "effects/indirect_diffuse/volume.h"

#include <shaders/volume_bake.h>

#include <algorithm>
#include <chrono>
#include <cstring>

#include "effects/frame/ray_pass.h"
#include "effects/indirect_diffuse/packed_cell.h"

namespace kaamos::effects {

namespace {

using Clock = std::chrono::steady_clock;

// Mirrors BakeConstants in volume_bake.hlsl.
struct BakeConstants {
  std::uint32_t cell_count;
  std::uint32_t first_sample;
  std::uint32_t sample_count;
  std::uint32_t bounces;
  std::uint32_t width;
  std::uint32_t seed;
};

// Mirrors VolumeConstants in indirect_volume.hlsli.
struct VolumeConstants {
  glm::vec3 origin;
  float cell;
  glm::uvec3 bricks;
  std::uint32_t enabled;
  float over_cell;
};
static_assert(sizeof(VolumeConstants) == 36);

constexpr std::uint32_t kGridWidth = 1024;
constexpr double kStepSeconds = 0.25;
// A cell that sees back faces in more than this fraction of its directions lies in a solid.
// [effects-spec B5.1]
constexpr float kMaxBackFaces = 0.25f;

RayPassDesc bake_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "indirect light bake";
  desc.library = library;
  desc.ray_generation = "BakeRayGen";
  desc.miss[kRayTypeSurface] = "PathMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"PathAnyHit", "PathClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 60;
  return desc;
}

// Traces all samples of all cells. A step takes more samples as long as steps are short.
rtapi::Result<Outcome> trace_cells(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                   const Frame& frame, const RayPass& pass, const PassViews& views,
                                   std::uint32_t cell_count, const BakeDesc& desc,
                                   const StepCallback& progress) {
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  const std::uint32_t rows = (cell_count + kGridWidth - 1) / kGridWidth;
  std::uint32_t step = 1;
  for (std::uint32_t first = 0; first < desc.samples;) {
    const std::uint32_t count = std::min(step, desc.samples - first);
    const BakeConstants constants = {cell_count, first, count, desc.bounces, kGridWidth, desc.seed};
    if (const auto reset = list->Reset(); !reset) return reset.error();
    pass.dispatch_grid(*list, frame, {}, kGridWidth, rows, PassArguments(views, constants));
    const auto start = Clock::now();
    if (const auto done = queue.ExecuteAndWait(*list); !done) return done.error();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    step = static_cast<std::uint32_t>(
        std::clamp(step * kStepSeconds / std::max(seconds, 1e-4), 1.0, 2.0 * step));
    first += count;
    if (progress && !progress(static_cast<double>(first) / desc.samples)) return Outcome::kStopped;
  }
  return Outcome::kDone;
}

// Turns sums into means and marks cells in solids.
void normalise(std::vector<VolumeCell>& cells, std::uint32_t samples) {
  const float scale = 1.0f / static_cast<float>(samples);
  for (VolumeCell& cell : cells) {
    for (glm::vec3* value : {&cell.mean, &cell.slope_x, &cell.slope_y, &cell.slope_z}) {
      *value *= scale;
    }
    cell.validity = cell.validity * scale > kMaxBackFaces ? 0.0f : 1.0f;
  }
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> volume_bake_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_volume_bake());
}

rtapi::Result<Outcome> bake_volume(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                   const Frame& frame, const GpuScene& gpu,
                                   const Lighting& lighting, const glm::dvec3& origin,
                                   const rtapi::ShaderLibrary& library, const BakeDesc& desc,
                                   IndirectVolume& volume, const StepCallback& progress) {
  if (volume.cells.empty()) return Outcome::kDone;
  std::vector<glm::vec4> centers;
  for (const glm::dvec3& center : volume.cell_centers()) {
    centers.emplace_back(glm::vec3(center - origin), 0.0f);
  }
  const auto center_buffer = rtapi::CreateUploadBuffer(device, centers, "cell centers");
  if (!center_buffer) return center_buffer.error();
  rtapi::BufferDesc sums_desc;
  sums_desc.SizeInBytes = volume.cells.size() * sizeof(VolumeCell);
  sums_desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  sums_desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  sums_desc.Name = "indirect light sums";
  const auto sums = device.CreateBuffer(sums_desc);
  if (!sums) return sums.error();
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto s = views->set_shader_resource(3, *center_buffer, sizeof(glm::vec4)); !s) {
    return s.error();
  }
  if (const auto s = views->set_unordered_access(0, *sums, sizeof(VolumeCell)); !s) {
    return s.error();
  }
  if (const auto s = lighting.bind(*views); !s) return s.error();
  const auto pass = RayPass::create(device, frame, gpu, bake_pass(library));
  if (!pass) return pass.error();
  const auto cell_count = static_cast<std::uint32_t>(volume.cells.size());
  const auto traced = trace_cells(device, queue, frame, *pass, *views, cell_count, desc, progress);
  if (!is_done(traced)) return traced;
  const auto bytes = rtapi::ReadbackBuffer(device, queue, *sums);
  if (!bytes) return bytes.error();
  std::memcpy(volume.cells.data(), bytes->data(), bytes->size());
  normalise(volume.cells, std::max(desc.samples, 1u));
  return Outcome::kDone;
}

rtapi::Result<GpuVolume> GpuVolume::create(const rtapi::Device& device,
                                           const IndirectVolume& volume, const glm::dvec3& origin) {
  GpuVolume out;
  VolumeConstants constants = {glm::vec3(volume.origin - origin), volume.cell, volume.bricks,
                               volume.cells.empty() ? 0u : 1u, 1.0f / volume.cell};
  // A view needs at least one element, even of an empty volume.
  std::vector<std::uint32_t> starts = volume.brick_starts;
  if (starts.empty()) starts.push_back(kNoBrick);
  std::vector<PackedCell> cells;
  cells.reserve(volume.cells.size() + 1);
  for (const VolumeCell& cell : volume.cells) cells.push_back(pack_cell(cell));
  if (cells.empty()) cells.emplace_back();
  const auto start_buffer = rtapi::CreateUploadBuffer(device, starts, "volume bricks");
  if (!start_buffer) return start_buffer.error();
  const auto cell_buffer = rtapi::CreateUploadBuffer(device, cells, "volume cells");
  if (!cell_buffer) return cell_buffer.error();
  const auto constant_buffer = rtapi::CreateUploadBuffer(
      device, std::vector<VolumeConstants>{constants}, "volume constants");
  if (!constant_buffer) return constant_buffer.error();
  out.brick_starts_ = *start_buffer;
  out.cells_ = *cell_buffer;
  out.constants_ = *constant_buffer;
  out.corner_ = volume.origin;
  return out;
}

void GpuVolume::set_origin(const glm::dvec3& origin) {
  constants_.data<VolumeConstants>()[0].origin = glm::vec3(corner_ - origin);
}

rtapi::Status GpuVolume::bind(PassViews& views) const {
  if (const auto s = views.set_shader_resource(0, brick_starts_, 4); !s) return s;
  if (const auto s = views.set_shader_resource(1, cells_, sizeof(PackedCell)); !s) return s;
  return views.set_shader_resource(2, constants_, sizeof(VolumeConstants));
}

}  // namespace kaamos::effects
