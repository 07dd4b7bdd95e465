// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace kaamos::vulkan {
namespace {

using Items = std::vector<SortItem>;

Items random_items(uint32_t count, uint32_t seed, int distinct_values) {
  std::mt19937 random(seed);
  Items items(count);
  for (uint32_t i = 0; i < count; ++i) {
    for (float& c : items[i].centre) {
      c = static_cast<float>(static_cast<int>(random() % distinct_values)) - 3.5f;
    }
    items[i].centre[1] *= 3;
    items[i].primitive = i;
  }
  return items;
}

bool equal(const Items& a, const Items& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.primitive == y.primitive && std::equal(x.centre, x.centre + 3, y.centre);
  });
}

// Walks the driver's tree and checks that each node inside one geometry is a median split of its
// items.
void expect_split(const Items& items, uint32_t first, uint32_t last,
                  const std::vector<uint32_t>& begins, uint32_t& nodes) {
  if (first >= last) return;
  const uint32_t mid = (first + last) / 2;
  const auto geometry = [&](uint32_t i) {
    return std::upper_bound(begins.begin(), begins.end(), i) - begins.begin();
  };
  const uint32_t mid_geometry = geometry(mid);
  uint32_t begin = first;
  uint32_t end = last + 1;
  while (geometry(begin) < mid_geometry) ++begin;
  while (geometry(end - 1) > mid_geometry) --end;
  const int axis = longest_axis(std::span(items).subspan(begin, end - begin));
  for (uint32_t left = begin; left <= mid; ++left) {
    for (uint32_t right = mid + 1; right < end; ++right) {
      const SortItem& a = items[left];
      const SortItem& b = items[right];
      ASSERT_TRUE(a.centre[axis] < b.centre[axis] ||
                  (a.centre[axis] == b.centre[axis] && a.primitive < b.primitive))
          << "node " << first << ".." << last << ", items " << left << " and " << right;
    }
  }
  ++nodes;
  expect_split(items, first, mid, begins, nodes);
  expect_split(items, mid + 1, last, begins, nodes);
}

TEST(SortForHalving, EveryNodeOfTheDriversTreeIsAMedianSplit) {
  for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 33u, 100u, 1000u}) {
    for (const int distinct : {1, 4, 1000000}) {
      Items items = random_items(count, count, distinct);
      const std::vector<uint32_t> begins = {0};
      sort_for_halving(items, begins);
      uint32_t nodes = 0;
      expect_split(items, 0, count - 1, begins, nodes);
      EXPECT_EQ(nodes, count - 1);
    }
  }
}

TEST(SortForHalving, IsAPermutationWithinEachGeometry) {
  const std::vector<uint32_t> begins = {0, 0, 10, 11, 300, 700, 700};
  Items items = random_items(777, 5, 50);
  const Items before = items;
  sort_for_halving(items, begins);
  uint32_t nodes = 0;
  expect_split(items, 0, 776, begins, nodes);
  for (size_t g = 0; g < begins.size(); ++g) {
    const uint32_t end = g + 1 < begins.size() ? begins[g + 1] : 777;
    Items part(items.begin() + begins[g], items.begin() + end);
    std::sort(part.begin(), part.end(),
              [](const auto& a, const auto& b) { return a.primitive < b.primitive; });
    EXPECT_TRUE(equal(part, Items(before.begin() + begins[g], before.begin() + end))) << g;
  }
}

TEST(SortForHalving, TheOrderOfTheInputDoesNotMatter) {
  // Large enough for several threads.
  Items sorted = random_items(60000, 1, 100);
  Items shuffled = sorted;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(2));
  const std::vector<uint32_t> begins = {0};
  sort_for_halving(sorted, begins);
  sort_for_halving(shuffled, begins);
  EXPECT_TRUE(equal(sorted, shuffled));
}

TEST(SortForHalving, EmptyListsAreLeftAlone) {
  Items none;
  sort_for_halving(none, {});
  const std::vector<uint32_t> begins = {0, 0};
  sort_for_halving(none, begins);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace kaamos::vulkan
