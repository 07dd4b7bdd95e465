// SPDX-License-Identifier: MIT
//
// The primitives of a bottom level as the driver gets them: without those that are never hit, in
// the order that suits the driver, and with the map back to the application's numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>

#include "runtime/structures/structure_map.h"
#include "runtime/vulkan/gpu/workarounds.h"
#include "runtime/vulkan/structures/sort.h"

namespace kaamos::vulkan {

struct ListOptions {
  bool sort = true;           // kSortPrimitives
  bool drop_inactive = true;  // kSanitizeNan; drivers detect inactive primitives by a NaN in x
};
ListOptions list_options(const Workarounds& workarounds);

class PrimitiveList {
 public:
  explicit PrimitiveList(ListOptions options) : options_(options) {}

  // Add the geometries in order, then call finish(). Drops triangles that cannot be hit: a NaN in a
  // corner, a coordinate of 1.8e18 or more, two equal indices. [DXR: Inactive primitives and
  // instances] `indices` must be below the number of vertices in `xyz`.
  void add_triangles(std::span<const float> xyz, std::span<const uint32_t> indices);
  // Adds the boxes as a traversal gets them (runtime::padded_bounds).
  void add_boxes(std::span<const rtapi::RaytracingAabb> boxes);
  void finish();

  // SortItem::primitive, in the driver's order.
  std::span<const SortItem> items(size_t geometry) const;
  // spirv::InstanceEntry::primitive_remap; empty if the driver's numbers are the application's.
  std::vector<uint32_t> remap_words() const;
  bool empty() const { return items_.empty(); }
  const runtime::Bounds& bounds() const { return bounds_; }

 private:
  void add(const float lower[3], const float upper[3], uint32_t primitive);

  ListOptions options_;
  std::vector<uint32_t> begins_;
  std::vector<SortItem> items_;
  runtime::Bounds bounds_;
};

}  // namespace kaamos::vulkan
