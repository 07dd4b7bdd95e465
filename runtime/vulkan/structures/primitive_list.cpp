// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/primitive_list.h"

#include <algorithm>
#include <cmath>

#include "runtime/structures/build_inputs.h"
#include "runtime/structures/instances.h"

namespace kaamos::vulkan {
namespace {

enum class Activity { kActive, kInactive, kOutOfRange };

Activity activity(const float* const corners[3]) {
  bool out_of_range = false;
  for (int corner = 0; corner < 3; ++corner) {
    if (std::isnan(corners[corner][0])) return Activity::kInactive;
    for (int i = 0; i < 3; ++i) {
      out_of_range |= !(std::fabs(corners[corner][i]) < runtime::kLargestCoordinate);
    }
  }
  return out_of_range ? Activity::kOutOfRange : Activity::kActive;
}

}  // namespace

ListOptions list_options(const Workarounds& workarounds) {
  return {workarounds.has(Workaround::kSortPrimitives), workarounds.has(Workaround::kSanitizeNan)};
}

void PrimitiveList::add(const float lower[3], const float upper[3], uint32_t primitive) {
  SortItem item;
  item.primitive = primitive;
  for (int i = 0; i < 3; ++i) {
    const float centre = 0.5f * lower[i] + 0.5f * upper[i];
    item.centre[i] = std::isfinite(centre) ? centre : 0;
    bounds_.lower[i] = items_.empty() ? lower[i] : std::min(bounds_.lower[i], lower[i]);
    bounds_.upper[i] = items_.empty() ? upper[i] : std::max(bounds_.upper[i], upper[i]);
  }
  items_.push_back(item);
}

void PrimitiveList::add_triangles(std::span<const float> xyz, std::span<const uint32_t> indices) {
  begins_.push_back(static_cast<uint32_t>(items_.size()));
  items_.reserve(items_.size() + indices.size() / 3);
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const uint32_t* index = &indices[i];
    if (index[0] == index[1] || index[1] == index[2] || index[2] == index[0]) continue;
    const float* const corners[3] = {&xyz[3 * size_t{index[0]}], &xyz[3 * size_t{index[1]}],
                                     &xyz[3 * size_t{index[2]}]};
    const Activity state = activity(corners);
    if (state == Activity::kOutOfRange) continue;
    if (state == Activity::kInactive && options_.drop_inactive) continue;
    float lower[3];
    float upper[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
      lower[axis] = low;
      upper[axis] = high;
    }
    add(lower, upper, static_cast<uint32_t>(i / 3));
  }
}

void PrimitiveList::add_boxes(std::span<const rtapi::RaytracingAabb> boxes) {
  begins_.push_back(static_cast<uint32_t>(items_.size()));
  items_.reserve(items_.size() + boxes.size());
  for (size_t i = 0; i < boxes.size(); ++i) {
    const runtime::PaddedBounds box = runtime::padded_bounds(boxes[i]);
    const bool inactive_for_drivers = std::isnan(boxes[i].MinX);
    if (!box.active && (options_.drop_inactive || !inactive_for_drivers)) continue;
    add(box.lower, box.upper, static_cast<uint32_t>(i));
  }
}

void PrimitiveList::finish() {
  if (options_.sort) sort_for_halving(items_, begins_);
}

std::span<const SortItem> PrimitiveList::items(size_t geometry) const {
  const size_t begin = begins_[geometry];
  const size_t end = geometry + 1 < begins_.size() ? begins_[geometry + 1] : items_.size();
  return std::span(items_).subspan(begin, end - begin);
}

std::vector<uint32_t> PrimitiveList::remap_words() const {
  bool identity = true;
  for (size_t g = 0; g < begins_.size(); ++g) {
    const auto list = items(g);
    for (uint32_t i = 0; i < list.size(); ++i) identity &= list[i].primitive == i;
  }
  if (identity) return {};
  std::vector<uint32_t> words;
  words.reserve(begins_.size() + items_.size());
  for (const uint32_t begin : begins_) {
    words.push_back(static_cast<uint32_t>(begins_.size()) + begin);
  }
  for (const SortItem& item : items_) words.push_back(item.primitive);
  return words;
}

}  // namespace kaamos::vulkan
