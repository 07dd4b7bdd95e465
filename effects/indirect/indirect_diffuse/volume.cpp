// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/volume.h"

#include <algorithm>
#include <cstring>
#include <utility>

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
  std::uint32_t counts_reads;
};
static_assert(sizeof(VolumeConstants) == 40);

}  // namespace

std::uint64_t volume_bytes(const IndirectVolume& volume) {
  return volume.cells.size() * sizeof(PackedCell) + volume.brick_starts.size() * 4;
}

rtapi::Result<GpuVolume> GpuVolume::create(const rtapi::Device& device,
                                           const IndirectVolume& volume, const glm::dvec3& origin,
                                           bool counts_reads) {
  GpuVolume out;
  VolumeConstants constants = {
      glm::vec3(volume.origin - origin), volume.cell,        volume.bricks,
      volume.cells.empty() ? 0u : 1u,    1.0f / volume.cell, counts_reads ? 1u : 0u};
  // A view needs at least one element, even of an empty volume.
  std::vector<std::uint32_t> starts = volume.brick_starts;
  if (starts.empty()) starts.push_back(kNoBrick);
  const std::vector<PackedCell> cells(std::max<std::size_t>(volume.cells.size(), 1));
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
  rtapi::BufferDesc reads;
  reads.SizeInBytes = (counts_reads ? cells.size() : 1) * sizeof(std::uint32_t);
  reads.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  reads.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  reads.Name = "volume reads";
  const auto read_buffer = device.CreateBuffer(reads);
  if (!read_buffer) return read_buffer.error();
  out.reads_ = *read_buffer;
  out.taken_.resize(volume.cells.size());
  out.set_cells(volume);
  return out;
}

void GpuVolume::set_origin(const glm::dvec3& origin) {
  constants_.data<VolumeConstants>()[0].origin = glm::vec3(corner_ - origin);
}

void GpuVolume::set_cells(const IndirectVolume& volume) {
  auto packed = cells_.data<PackedCell>().begin();
  for (const VolumeCell& cell : volume.cells) *packed++ = pack_cell(cell);
}

rtapi::Result<std::vector<std::uint32_t>> GpuVolume::take_reads(const rtapi::Device& device,
                                                                rtapi::CommandQueue& queue) {
  const auto bytes = rtapi::ReadbackBuffer(device, queue, reads_);
  if (!bytes) return bytes.error();
  std::vector<std::uint32_t> reads(taken_.size());
  std::memcpy(reads.data(), bytes->data(), reads.size() * sizeof(std::uint32_t));
  for (std::size_t i = 0; i < reads.size(); ++i) reads[i] -= std::exchange(taken_[i], reads[i]);
  return reads;
}

rtapi::Status GpuVolume::bind(PassViews& views) const {
  if (const auto s = views.set_shader_resource(0, brick_starts_, 4); !s) return s;
  if (const auto s = views.set_shader_resource(1, cells_, sizeof(PackedCell)); !s) return s;
  if (const auto s = views.set_shader_resource(2, constants_, sizeof(VolumeConstants)); !s) {
    return s;
  }
  return views.set_unordered_access(15, reads_, sizeof(std::uint32_t));
}

}  // namespace kaamos::effects
