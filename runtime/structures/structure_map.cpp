// SPDX-License-Identifier: MIT
#include "runtime/structures/structure_map.h"

#include <cstring>
#include <mutex>
#include <utility>

#include "runtime/structures/build_inputs.h"

namespace kaamos::runtime {
namespace {

struct Header {
  uint64_t magic;
  uint64_t id;
};
constexpr uint64_t kMagic = 0x53414B414D4F5341;

bool has_header(const AccelerationStructure& structure, uint64_t id) {
  Header header;
  std::memcpy(&header, structure.host, sizeof(header));
  return header.magic == kMagic && header.id == id;
}

}  // namespace

GeometryShape shape_of(const rtapi::RaytracingGeometryDesc& desc, uint32_t index) {
  using rtapi::HasAny;
  GeometryShape shape;
  shape.type = desc.Type;
  shape.index = index;
  shape.opaque = HasAny(desc.Flags, rtapi::RaytracingGeometryFlags::kOpaque);
  shape.no_duplicate_any_hit =
      HasAny(desc.Flags, rtapi::RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation);
  shape.primitives = static_cast<uint32_t>(primitive_count(desc));
  if (desc.Type == rtapi::RaytracingGeometryType::kTriangles) {
    shape.vertex_format = desc.Triangles.VertexFormat;
    shape.index_format = desc.Triangles.IndexFormat;
    shape.transformed = desc.Triangles.Transform3x4 != 0;
    shape.vertices = desc.Triangles.VertexCount;
  }
  return shape;
}

void StructureMap::place(AccelerationStructure structure) {
  const uint64_t address = structure.address;
  const std::unique_lock lock(mutex_);
  evict_locked(address, structure.size_bytes);
  const Header header = {kMagic, next_id_++};
  std::memcpy(structure.host, &header, sizeof(header));
  if (structure.bottom_level) ++owners_[structure.bottom_level.get()];
  if (structure.missing != 0) ++incomplete_;
  link_locked(structure);
  structures_[address] = {header.id,
                          std::make_shared<const AccelerationStructure>(std::move(structure))};
}

void StructureMap::link_locked(const AccelerationStructure& placed) {
  for (const auto& linkage : placed.linkages) {
    if (linkage == nullptr || linkage->array != nullptr || linkage->address == 0) continue;
    const auto it = structures_.find(linkage->address);
    if (it != structures_.end() && has_header(*it->second.structure, it->second.id)) {
      linkage->array = it->second.structure->micromaps;
    }
  }
  if (placed.micromaps == nullptr) return;
  for (const auto& [address, other] : structures_) {
    for (const auto& linkage : other.structure->linkages) {
      if (linkage != nullptr && linkage->array == nullptr && linkage->address == placed.address) {
        linkage->array = placed.micromaps;
      }
    }
  }
}

void StructureMap::evict(uint64_t address, uint64_t size_bytes) {
  const std::unique_lock lock(mutex_);
  evict_locked(address, size_bytes);
}

void StructureMap::evict_locked(uint64_t address, uint64_t size_bytes) {
  auto it = structures_.lower_bound(address);
  if (it != structures_.begin()) {
    const auto before = std::prev(it);
    if (address - before->first < before->second.structure->size_bytes) it = before;
  }
  while (it != structures_.end() && (it->first < address || it->first - address < size_bytes)) {
    if (const BottomLevelBase* level = it->second.structure->bottom_level.get()) {
      const auto owner = owners_.find(level);
      if (--owner->second == 0) owners_.erase(owner);
    }
    if (it->second.structure->missing != 0) --incomplete_;
    it = structures_.erase(it);
  }
}

std::shared_ptr<const AccelerationStructure> StructureMap::find(uint64_t address) const {
  Placed placed;
  {
    const std::shared_lock lock(mutex_);
    const auto it = structures_.find(address);
    if (it == structures_.end()) return nullptr;
    placed = it->second;
  }
  // Not under the lock, because memory that the application has freed meanwhile faults here.
  return has_header(*placed.structure, placed.id) ? placed.structure : nullptr;
}

bool StructureMap::is_shared(const BottomLevelBase* level) const {
  const std::shared_lock lock(mutex_);
  const auto owner = owners_.find(level);
  return owner != owners_.end() && owner->second > 1;
}

template <class Condition>
std::vector<std::shared_ptr<const AccelerationStructure>> StructureMap::all_with(
    Condition condition) const {
  const std::shared_lock lock(mutex_);
  std::vector<std::shared_ptr<const AccelerationStructure>> found;
  for (const auto& [address, placed] : structures_) {
    if (!condition(*placed.structure) || !has_header(*placed.structure, placed.id)) continue;
    found.push_back(placed.structure);
  }
  return found;
}

std::vector<std::shared_ptr<const AccelerationStructure>> StructureMap::top_levels() const {
  return all_with([](const auto& structure) { return structure.top_level != nullptr; });
}

std::vector<std::shared_ptr<const AccelerationStructure>> StructureMap::incomplete() const {
  if (incomplete_ == 0) return {};
  return all_with([](const auto& structure) { return structure.missing != 0; });
}

}  // namespace kaamos::runtime
