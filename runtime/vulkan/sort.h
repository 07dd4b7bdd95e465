// SPDX-License-Identifier: MIT
//
// Lavapipe builds no tree of its own choice: it halves the list of primitives in the order in which
// it gets them, so that the order is the tree; instances likewise. This brings them into the order
// in which each half is one side of a median split: on a shuffled mesh hundreds of times faster to
// trace.
#pragma once

#include <cstdint>
#include <span>

namespace kaamos::vulkan {

struct SortItem {
  float centre[3] = {0, 0, 0};  // finite
  uint32_t primitive = 0;       // position in the application's geometry; decides ties
};

// Orders the primitives of each geometry; `geometry_begins` has the first item of each, ascending,
// from 0. The driver's node of items first..last has the children first..mid and mid + 1..last with
// mid = (first + last) / 2, over all geometries of the list; where mid falls into a geometry, the
// items of the node that belong to it are divided there, on the longest axis of their centres. The
// result depends on the set of items alone, not on their order or on the number of threads.
void sort_for_halving(std::span<SortItem> items, std::span<const uint32_t> geometry_begins);

// The axis on which the centres extend most; the first of equals.
int longest_axis(std::span<const SortItem> items);

}  // namespace kaamos::vulkan
