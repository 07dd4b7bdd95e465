// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/bottom_level.h"

#include <kaamos/shader/spirv_interface.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "runtime/backend/errors.h"
#include "runtime/structures/build_inputs.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/triangle_positions.h"
#include "runtime/vulkan/structures/primitive_list.h"

namespace kaamos::vulkan {

using rtapi::RaytracingGeometryDesc;
using rtapi::RaytracingGeometryType;

// Decodes the inputs, lists and sorts the primitives, copies all to memory that the driver reads,
// and builds.
class BottomLevelBuilder {
 public:
  // `numbers`: by geometry and triangle in a part of clusters; otherwise empty.
  BottomLevelBuilder(std::shared_ptr<Gpu> gpu, std::span<const RaytracingGeometryDesc> geometries,
                     const BottomLevel* update_of, BottomLevel& level,
                     std::span<const std::vector<ClusterNumbers>> numbers = {})
      : gpu_(std::move(gpu)),
        geometries_(geometries),
        update_of_(update_of),
        level_(level),
        numbers_(numbers),
        list_(list_options(gpu_->workarounds())) {}

  rtapi::Status run() {
    if (auto s = decode(); !s) return s;
    list_.finish();
    if (auto s = copy_inputs(); !s) return s;
    return build();
  }

 private:
  struct Decoded {
    std::vector<float> xyz;
    std::vector<uint32_t> indices;
    std::vector<rtapi::RaytracingAabb> boxes;
    uint64_t vertex_offset = 0;  // in the input buffer
    uint64_t list_offset = 0;    // offset of indices or boxes
  };

  bool procedural(size_t g) const {
    return geometries_[g].Type == RaytracingGeometryType::kProceduralPrimitiveAabbs;
  }
  rtapi::Status decode();
  void decode_triangles(size_t g, Decoded& out);
  rtapi::Status copy_inputs();
  StructureGeometry describe(size_t g) const;
  rtapi::Status build();
  rtapi::Status copy_micromap_indices();
  void keep_inputs();
  std::vector<uint32_t> position_words() const;
  std::vector<uint32_t> cluster_remap_words() const;
  std::vector<uint32_t> cluster_words() const;
  uint64_t position_table(bool is_missing, uint64_t offset_bytes) const;

  std::shared_ptr<Gpu> gpu_;
  std::span<const RaytracingGeometryDesc> geometries_;
  const BottomLevel* update_of_;
  BottomLevel& level_;
  std::span<const std::vector<ClusterNumbers>> numbers_;
  PrimitiveList list_;
  std::vector<Decoded> decoded_;
  std::unique_ptr<GpuBuffer> inputs_;
};

rtapi::Status BottomLevelBuilder::decode() {
  for (size_t g = 0; g < geometries_.size(); ++g) {
    const RaytracingGeometryDesc& desc = geometries_[g];
    if (auto s = runtime::check_primitive_count(desc, static_cast<uint32_t>(g)); !s) return s;
    Decoded& out = decoded_.emplace_back();
    if (!procedural(g)) {
      decode_triangles(g, out);
      list_.add_triangles(out.xyz, out.indices);
      continue;
    }
    out.boxes.reserve(desc.AABBs.AABBCount);
    for (uint64_t i = 0; i < desc.AABBs.AABBCount; ++i) {
      out.boxes.push_back(runtime::aabb_at(desc.AABBs, i));
    }
    list_.add_boxes(out.boxes);
  }
  return {};
}

void BottomLevelBuilder::decode_triangles(size_t g, Decoded& out) {
  const auto& desc = geometries_[g].Triangles;
  const uint64_t primitives = runtime::primitive_count(geometries_[g]);
  if (primitives == 0 || desc.VertexCount == 0) return;
  out.xyz.resize(3 * uint64_t{desc.VertexCount});
  runtime::decode_vertices(desc, out.xyz.data());
  if (update_of_ != nullptr && desc.IndexFormat != rtapi::Format::kUnknown) {
    out.indices = update_of_->inputs_[g].indices;
    return;
  }
  out.indices.resize(3 * primitives);
  level_.out_of_range_triangles_ += runtime::decode_indices(desc, out.indices.data());
}

rtapi::Status BottomLevelBuilder::copy_inputs() {
  uint64_t bytes = 0;
  for (size_t g = 0; g < geometries_.size(); ++g) {
    Decoded& in = decoded_[g];
    in.vertex_offset = bytes;
    bytes += in.xyz.size() * sizeof(float);
    bytes = (bytes + 15) / 16 * 16;
    in.list_offset = bytes;
    bytes += list_.items(g).size() * (procedural(g) ? sizeof(VkAabbPositionsKHR) : 12);
    bytes = (bytes + 47) / 48 * 48;  // so that the next array begins at a whole vertex
  }
  auto buffer = gpu_->create_buffer(bytes, "inputs of a bottom level", InitialContents::kAny);
  if (!buffer) return buffer.error();
  inputs_ = std::move(*buffer);
  for (size_t g = 0; g < geometries_.size(); ++g) {
    const Decoded& in = decoded_[g];
    std::copy(in.xyz.begin(), in.xyz.end(),
              reinterpret_cast<float*>(inputs_->host() + in.vertex_offset));
    uint8_t* out = inputs_->host() + in.list_offset;
    for (const SortItem& item : list_.items(g)) {
      if (procedural(g)) {
        const runtime::PaddedBounds box = runtime::padded_bounds(in.boxes[item.primitive]);
        std::memcpy(out, box.lower, 12);
        std::memcpy(out + 12, box.upper, 12);
        out += 24;
      } else {
        std::memcpy(out, &in.indices[3 * size_t{item.primitive}], 12);
        out += 12;
      }
    }
  }
  return {};
}

StructureGeometry BottomLevelBuilder::describe(size_t g) const {
  const Decoded& in = decoded_[g];
  StructureGeometry result;
  result.range.primitiveCount = static_cast<uint32_t>(list_.items(g).size());
  VkAccelerationStructureGeometryKHR& geometry = result.geometry;
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  if (level_.shapes_[g].opaque) geometry.flags |= VK_GEOMETRY_OPAQUE_BIT_KHR;
  if (level_.shapes_[g].no_duplicate_any_hit) {
    geometry.flags |= VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
  }
  if (procedural(g)) {
    geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
    auto& aabbs = geometry.geometry.aabbs;
    aabbs.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR;
    aabbs.data.deviceAddress = inputs_->address() + in.list_offset;
    aabbs.stride = sizeof(VkAabbPositionsKHR);
    return result;
  }
  geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
  auto& triangles = geometry.geometry.triangles;
  triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
  triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
  triangles.vertexStride = 12;
  const uint64_t vertices = in.xyz.size() / 3;
  triangles.maxVertex = static_cast<uint32_t>(vertices == 0 ? 0 : vertices - 1);
  triangles.indexType = VK_INDEX_TYPE_UINT32;
  triangles.indexData.deviceAddress = inputs_->address() + in.list_offset;
  triangles.vertexData.deviceAddress = inputs_->address();
  if (gpu_->workarounds().has(Workaround::kFirstVertexInAddress)) {
    triangles.vertexData.deviceAddress += in.vertex_offset;
  } else {
    result.range.firstVertex = static_cast<uint32_t>(in.vertex_offset / 12);
    triangles.maxVertex += result.range.firstVertex;
  }
  return result;
}

rtapi::Status BottomLevelBuilder::build() {
  std::vector<StructureGeometry> geometries;
  for (size_t g = 0; g < geometries_.size(); ++g) geometries.push_back(describe(g));
  const bool clustered = !numbers_.empty();
  const std::vector<uint32_t> remap = clustered ? cluster_remap_words() : list_.remap_words();
  std::vector<uint32_t> words = remap;
  const std::vector<uint32_t> positions = clustered ? cluster_words() : position_words();
  if (clustered && words.size() % 2 != 0) words.push_back(0);  // marks need addresses of 8 bytes
  const uint64_t positions_offset = words.size() * sizeof(uint32_t);
  words.insert(words.end(), positions.begin(), positions.end());
  auto structure =
      VulkanStructure::build(gpu_, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, level_.flags_,
                             geometries, words.size() * sizeof(uint32_t));
  if (!structure) return structure.error();
  level_.structure_ = std::move(*structure);
  level_.held_bytes_ = level_.structure_->size_bytes() + words.size() * sizeof(uint32_t);
  if (!words.empty()) {
    std::memcpy(level_.structure_->extra_host(), words.data(), words.size() * sizeof(uint32_t));
  }
  if (!remap.empty()) level_.remap_ = level_.structure_->extra_address();
  level_.position_table_ = position_table(positions.empty(), positions_offset);
  level_.empty_ = list_.empty();
  level_.bounds_ = list_.bounds();
  if (!clustered) keep_inputs();  // the level that it is a part of has them
  return copy_micromap_indices();
}

rtapi::Status BottomLevelBuilder::copy_micromap_indices() {
  uint64_t count = 0;
  bool linked = false;
  for (const auto& linkage : level_.linkages_) {
    if (linkage == nullptr) continue;
    count += linkage->indices.size();
    linked = true;
  }
  if (!linked) return {};
  auto buffer = gpu_->create_buffer(std::max<uint64_t>(count, 1) * sizeof(int32_t),
                                    "micromap indices of a bottom level");
  if (!buffer) return buffer.error();
  uint8_t* out = (*buffer)->host();
  for (const auto& linkage : level_.linkages_) {
    if (linkage == nullptr) continue;
    const uint64_t bytes = linkage->indices.size() * sizeof(int32_t);
    if (bytes != 0) std::memcpy(out, linkage->indices.data(), bytes);
    out += bytes;
  }
  level_.held_bytes_ += count * sizeof(int32_t);
  level_.micromap_indices_ = std::move(*buffer);
  return {};
}

// spirv_interface.h: position tables. Empty if shaders may not read them.
std::vector<uint32_t> BottomLevelBuilder::position_words() const {
  std::vector<uint32_t> words;
  if (!HasAny(level_.flags_, runtime::BuildFlags::kAllowDataAccess)) return words;
  if (geometries_.empty() || procedural(0)) return words;
  words.resize(geometries_.size());
  for (size_t g = 0; g < geometries_.size(); ++g) {
    words[g] = static_cast<uint32_t>(words.size());
    const Decoded& in = decoded_[g];
    for (const uint32_t vertex : in.indices) {
      for (int axis = 0; axis < 3; ++axis) {
        words.push_back(std::bit_cast<uint32_t>(in.xyz[3 * size_t{vertex} + axis]));
      }
    }
  }
  return words;
}

// spirv_interface.h: InstanceEntry::primitive_remap.
std::vector<uint32_t> BottomLevelBuilder::cluster_remap_words() const {
  std::vector<uint32_t> words(geometries_.size());
  for (size_t g = 0; g < geometries_.size(); ++g) {
    words[g] = static_cast<uint32_t>(words.size());
    for (const SortItem& item : list_.items(g)) {
      words.push_back(numbers_[g][item.primitive].primitive_index);
    }
  }
  return words;
}

// spirv_interface.h: kClusterTable.
std::vector<uint32_t> BottomLevelBuilder::cluster_words() const {
  const bool readable = HasAny(level_.flags_, runtime::BuildFlags::kAllowDataAccess);
  std::vector<uint32_t> words((geometries_.size() + 1) / 2 * 2);
  for (size_t g = 0; g < geometries_.size(); ++g) {
    words[g] = static_cast<uint32_t>(words.size());
    const Decoded& in = decoded_[g];
    for (const SortItem& item : list_.items(g)) {
      words.push_back(numbers_[g][item.primitive].cluster_id);
      if (!readable) words.push_back(0);
      for (int corner = 0; readable && corner < 3; ++corner) {
        const size_t vertex = in.indices[3 * size_t{item.primitive} + corner];
        for (int axis = 0; axis < 3; ++axis) {
          words.push_back(std::bit_cast<uint32_t>(in.xyz[3 * vertex + axis]));
        }
      }
    }
  }
  return words;
}

uint64_t BottomLevelBuilder::position_table(bool is_missing, uint64_t offset_bytes) const {
  if (!numbers_.empty()) {
    const bool readable = HasAny(level_.flags_, runtime::BuildFlags::kAllowDataAccess);
    return (level_.structure_->extra_address() + offset_bytes) | shader::spirv::kClusterTable |
           (readable ? 0 : shader::spirv::kPositionsNotKept);
  }
  if (!is_missing) return level_.structure_->extra_address() + offset_bytes;
  const bool has_triangles = !geometries_.empty() && !procedural(0);
  return has_triangles ? shader::spirv::kPositionsNotKept : 0;
}

void BottomLevelBuilder::keep_inputs() {
  for (size_t g = 0; g < geometries_.size(); ++g) {
    BottomLevel::Inputs& kept = level_.inputs_.emplace_back();
    kept.xyz = std::move(decoded_[g].xyz);
    kept.boxes = std::move(decoded_[g].boxes);
    if (!procedural(g) && geometries_[g].Triangles.IndexFormat != rtapi::Format::kUnknown) {
      kept.indices = std::move(decoded_[g].indices);
    }
    level_.held_bytes_ += kept.xyz.size() * sizeof(float) + kept.indices.size() * sizeof(uint32_t) +
                          kept.boxes.size() * sizeof(rtapi::RaytracingAabb);
  }
}

uint64_t BottomLevel::micromap_indices(size_t geometry) const {
  if (linkage(geometry) == nullptr) return 0;
  uint64_t before = 0;
  for (size_t g = 0; g < geometry; ++g) {
    if (linkages_[g] != nullptr) before += linkages_[g]->indices.size();
  }
  return micromap_indices_->address() + before * sizeof(int32_t);
}

rtapi::Result<std::shared_ptr<BottomLevel>> BottomLevel::build(
    const std::shared_ptr<Gpu>& gpu, std::span<const RaytracingGeometryDesc> geometries,
    runtime::BuildFlags flags, std::span<const std::shared_ptr<runtime::MicromapLinkage>> linkages,
    const BottomLevel* update_of, std::span<const runtime::GeometryShape> shapes) {
  std::shared_ptr<BottomLevel> level(new BottomLevel);
  level->flags_ = flags & ~runtime::BuildFlags::kPerformUpdate;
  for (uint32_t g = 0; g < geometries.size(); ++g) {
    level->shapes_.push_back(runtime::shape_of(geometries[g], g));
    level->shapes_.back().linked = g < linkages.size() && linkages[g] != nullptr;
  }
  level->linkages_.assign(linkages.begin(), linkages.end());
  if (auto s = BottomLevelBuilder(gpu, geometries, update_of, *level).run(); !s) return s.error();
  if (!shapes.empty()) level->shapes_.assign(shapes.begin(), shapes.end());
  return level;
}

namespace {

RaytracingGeometryDesc desc_of(const runtime::ClusteredGeometry& geometry) {
  RaytracingGeometryDesc desc;
  desc.Flags = geometry.flags;
  auto& triangles = desc.Triangles;
  triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
  triangles.VertexCount = static_cast<uint32_t>(geometry.xyz.size() / 3);
  triangles.VertexBuffer = {reinterpret_cast<uint64_t>(geometry.xyz.data()), 12};
  triangles.IndexFormat = rtapi::Format::kR32Uint;
  triangles.IndexCount = static_cast<uint32_t>(geometry.indices.size());
  triangles.IndexBuffer = reinterpret_cast<uint64_t>(geometry.indices.data());
  return desc;
}

// A part of clusters while its triangles are collected. In the order of the driver's numbers.
using PartGeometries = std::vector<runtime::ClusteredGeometry>;

// What the triangles of a part have in common. Those with the same linkage that have the same
// geometry index and PrimitiveIndex are in as many layers.
struct PartKey {
  uint32_t flags = 0;
  const runtime::MicromapLinkage* linkage = nullptr;
  uint32_t layer = 0;
  auto operator<=>(const PartKey&) const = default;
};
struct Part {
  PartGeometries geometries;
  std::shared_ptr<const runtime::MicromapLinkage> linked_by;
};

// Vertices that triangles share within a cluster are the part's, too, where `vertices` maps them.
void append_triangle(runtime::ClusteredGeometry& to, const runtime::ClusteredGeometry& from,
                     uint32_t triangle, std::unordered_map<uint32_t, uint32_t>& vertices) {
  for (uint32_t corner = 0; corner < 3; ++corner) {
    const uint32_t index = from.indices[3 * size_t{triangle} + corner];
    const auto [at, is_new] = vertices.try_emplace(index, static_cast<uint32_t>(to.xyz.size() / 3));
    if (is_new) {
      const float* xyz = &from.xyz[3 * size_t{index}];
      to.xyz.insert(to.xyz.end(), xyz, xyz + 3);
    }
    to.indices.push_back(at->second);
  }
  const uint32_t number = from.primitive_index[triangle];
  to.primitive_index.push_back(number);
  to.cluster_id.push_back(from.cluster_id[triangle]);
  if (from.linkage == nullptr) return;
  if (to.linkage == nullptr) to.linkage = std::make_shared<runtime::MicromapLinkage>();
  auto& indices = to.linkage->indices;  // by PrimitiveIndex
  if (indices.size() <= number) {
    indices.resize(size_t{number} + 1, static_cast<int32_t>(runtime::SpecialIndex::kClusterSkip));
  }
  indices[number] = from.linkage->indices[triangle];
}

std::map<PartKey, Part> parts_of(std::span<const runtime::ClusteredGeometry> geometries) {
  std::map<PartKey, Part> parts;
  std::map<std::tuple<const runtime::MicromapLinkage*, uint32_t, uint32_t>, uint32_t> layers;
  for (const runtime::ClusteredGeometry& geometry : geometries) {
    std::map<Part*, std::unordered_map<uint32_t, uint32_t>> vertices;
    for (uint32_t i = 0; i < geometry.triangles(); ++i) {
      PartKey key = {static_cast<uint32_t>(geometry.flags), geometry.linkage.get(), 0};
      if (key.linkage != nullptr) {
        key.layer = layers[{key.linkage, geometry.geometry_index, geometry.primitive_index[i]}]++;
      }
      Part& part = parts[key];
      part.linked_by = geometry.linkage;
      PartGeometries& in = part.geometries;
      for (auto g = static_cast<uint32_t>(in.size()); g <= geometry.geometry_index; ++g) {
        in.emplace_back().geometry_index = g;
      }
      in[geometry.geometry_index].flags = geometry.flags;
      append_triangle(in[geometry.geometry_index], geometry, i, vertices[&part]);
    }
  }
  return parts;
}

}  // namespace

// `geometries` are in the order of the driver's numbers.
rtapi::Result<std::shared_ptr<BottomLevel>> BottomLevel::build_part(
    const std::shared_ptr<Gpu>& gpu, std::vector<runtime::ClusteredGeometry> geometries,
    std::shared_ptr<const runtime::MicromapLinkage> linked_by, runtime::BuildFlags flags) {
  std::shared_ptr<BottomLevel> part(new BottomLevel);
  part->flags_ = flags;
  std::vector<RaytracingGeometryDesc> descs;
  std::vector<std::vector<ClusterNumbers>> numbers;
  for (const runtime::ClusteredGeometry& geometry : geometries) {
    descs.push_back(desc_of(geometry));
    part->shapes_.push_back(runtime::shape_of(geometry));
    auto& of_geometry = numbers.emplace_back();
    for (uint32_t i = 0; i < geometry.triangles(); ++i) {
      of_geometry.push_back({geometry.primitive_index[i], geometry.cluster_id[i]});
    }
    if (linked_by == nullptr) continue;
    part->linkages_.push_back(geometry.linkage);
    part->linked_by_.push_back(linked_by);
  }
  if (auto s = BottomLevelBuilder(gpu, descs, nullptr, *part, numbers).run(); !s) return s.error();
  return part;
}

std::shared_ptr<const runtime::MicromapArray> BottomLevel::micromap_array(size_t geometry) const {
  if (linkage(geometry) == nullptr) return nullptr;
  return linked_by_.empty() ? linkage(geometry)->array : linked_by_[geometry]->array;
}

rtapi::Result<std::shared_ptr<BottomLevel>> BottomLevel::build_clustered(
    const std::shared_ptr<Gpu>& gpu, std::vector<runtime::ClusteredGeometry> geometries,
    runtime::BuildFlags flags) {
  for (const runtime::ClusteredGeometry& geometry : geometries) {
    if (geometry.geometry_index <= kMaxGeometryIndex) continue;
    return runtime::make_error(
        runtime::Id::kTooManyElements,
        "a cluster has geometry index " + std::to_string(geometry.geometry_index) +
            "; on Vulkan it must be at most " + std::to_string(kMaxGeometryIndex) + ".");
  }
  auto parts = parts_of(geometries);
  if (parts.size() > kMaxParts) {
    return runtime::make_error(runtime::Id::kTooManyElements,
                               "a bottom level of clusters with opacity micromaps, " +
                                   std::to_string(parts.size()) +
                                   " of which have the same geometry index; on Vulkan at most " +
                                   std::to_string(kMaxParts) + " may.");
  }
  std::shared_ptr<BottomLevel> level(new BottomLevel);
  level->flags_ = flags & ~runtime::BuildFlags::kAllowUpdate;
  for (auto& [key, part] : parts) {
    auto built = build_part(gpu, std::move(part.geometries), part.linked_by, level->flags_);
    if (!built) return built.error();
    if ((*built)->empty()) continue;
    level->held_bytes_ += (*built)->held_bytes();
    level->parts_.push_back(std::move(*built));
  }
  level->keep_clusters(std::move(geometries));
  return level;
}

void BottomLevel::keep_clusters(std::vector<runtime::ClusteredGeometry> geometries) {
  for (const auto& part : parts_) {
    for (int axis = 0; axis < 3; ++axis) {
      const runtime::Bounds& bounds = part->bounds_;
      bounds_.lower[axis] =
          empty_ ? bounds.lower[axis] : std::min(bounds_.lower[axis], bounds.lower[axis]);
      bounds_.upper[axis] =
          empty_ ? bounds.upper[axis] : std::max(bounds_.upper[axis], bounds.upper[axis]);
    }
    empty_ = false;
  }
  clusters_.set(geometries);
  for (runtime::ClusteredGeometry& geometry : geometries) {
    shapes_.push_back(runtime::shape_of(geometry));
    linkages_.push_back(geometry.linkage);
    inputs_.push_back({std::move(geometry.xyz), std::move(geometry.indices), {}});
  }
  positions_ = runtime::positions_of(*this, flags_);
  clusters_.refer_to(positions_);
}

}  // namespace kaamos::vulkan
