// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/volume.h"

#include "effects/indirect/indirect_diffuse/packed_cell.h"

namespace kaamos::effects {

namespace {

// Mirrors VolumeConstants in indirect_volume.hlsli.
struct VolumeConstants {
  glm::vec3 origin;
  float cell;
  glm::uvec3 bricks;
  std::uint32_t enabled;
  float over_cell;
};
static_assert(sizeof(VolumeConstants) == 36);

}  // namespace

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
