// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/sort.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>

namespace kaamos::vulkan {
namespace {

constexpr size_t kParallelItems = 1 << 14;  // below that, a task costs more than it saves

class Sorter {
 public:
  Sorter(std::span<SortItem> items, std::span<const uint32_t> begins)
      : items_(items), begins_(begins) {}

  // Items first..last, both inclusive, the way the driver counts.
  void sort(size_t first, size_t last) const {
    if (first >= last) return;
    const size_t mid = (first + last) / 2;
    divide(first, last, mid);
    if (last - first < kParallelItems) {
      sort(first, mid);
      sort(mid + 1, last);
    } else {
      tbb::parallel_invoke([=, this] { sort(first, mid); }, [=, this] { sort(mid + 1, last); });
    }
  }

 private:
  // Makes first..mid and mid + 1..last the sides of a split, within the geometry that contains mid.
  void divide(size_t first, size_t last, size_t mid) const {
    const auto after = std::upper_bound(begins_.begin(), begins_.end(), mid);
    const size_t begin = std::max<size_t>(first, *std::prev(after));
    const size_t end = after == begins_.end() ? last + 1 : std::min<size_t>(last + 1, *after);
    if (mid + 1 >= end) return;
    const auto part = items_.subspan(begin, end - begin);
    const int axis = longest_axis(part);
    std::nth_element(part.begin(), part.begin() + (mid - begin), part.end(),
                     [axis](const SortItem& a, const SortItem& b) {
                       if (a.centre[axis] != b.centre[axis]) return a.centre[axis] < b.centre[axis];
                       return a.primitive < b.primitive;
                     });
  }

  std::span<SortItem> items_;
  std::span<const uint32_t> begins_;
};

}  // namespace

void sort_for_halving(std::span<SortItem> items, std::span<const uint32_t> geometry_begins) {
  if (!items.empty()) Sorter(items, geometry_begins).sort(0, items.size() - 1);
}

int longest_axis(std::span<const SortItem> items) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float lower[3] = {kInfinity, kInfinity, kInfinity};
  float upper[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (const SortItem& item : items) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], item.centre[i]);
      upper[i] = std::max(upper[i], item.centre[i]);
    }
  }
  int longest = 0;
  for (int i = 1; i < 3; ++i) {
    if (upper[i] - lower[i] > upper[longest] - lower[longest]) longest = i;
  }
  return longest;
}

}  // namespace kaamos::vulkan
