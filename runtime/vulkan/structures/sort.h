// SPDX-License-Identifier: MIT
//
// Lavapipe's build does not choose a tree: it halves the list of primitives in the order in which
// it gets them, so the order is the tree. The same goes for instances. This sorts them so that each
// half is one side of a median split; a shuffled mesh then traces hundreds of times faster.
#pragma once

#include <cstdint>
#include <span>

namespace kaamos::vulkan {

struct SortItem {
  float centre[3] = {0, 0, 0};  // finite
  uint32_t primitive = 0;       // position in the application's geometry; breaks ties
};

// Orders the primitives of each geometry; `geometry_begins` has the first item of each, ascending,
// from 0. The driver's node for items first..last has the children first..mid and mid + 1..last
// with mid = (first + last) / 2, over all geometries of the list. Where mid falls into a geometry,
// the items of the node that belong to it are split there, on the longest axis of their centres.
// The result depends only on the set of items, not on their order or on the number of threads.
void sort_for_halving(std::span<SortItem> items, std::span<const uint32_t> geometry_begins);

// The axis along which the centres extend most; on a tie the first.
int longest_axis(std::span<const SortItem> items);

}  // namespace kaamos::vulkan
