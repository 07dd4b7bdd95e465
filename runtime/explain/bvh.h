// SPDX-License-Identifier: MIT
//
// A bounding volume hierarchy in double precision that finds every box along a whole ray. Simple
// rather than fast: explanations need all candidates, in front of the hit and behind it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace kaamos::explain {

struct Box {
  double lower[3] = {1, 1, 1};
  double upper[3] = {-1, -1, -1};  // inverted: an empty box, which is never found

  bool empty() const { return !(lower[0] <= upper[0]); }
  void add(const Box& other) {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], other.lower[i]);
      upper[i] = std::max(upper[i], other.upper[i]);
    }
  }
};

struct Ray {
  double origin[3];
  double direction[3];
};

// Clips the line to the box; false if it misses.
inline bool clip(const Ray& ray, const Box& box, double& enter, double& leave) {
  enter = -std::numeric_limits<double>::infinity();
  leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (ray.direction[i] == 0) {
      if (ray.origin[i] < box.lower[i] || ray.origin[i] > box.upper[i]) return false;
      continue;
    }
    double a = (box.lower[i] - ray.origin[i]) / ray.direction[i];
    double b = (box.upper[i] - ray.origin[i]) / ray.direction[i];
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    leave = std::min(leave, b);
  }
  return enter <= leave;
}

class Bvh {
 public:
  void build(std::vector<Box> boxes) {
    boxes_ = std::move(boxes);
    order_.clear();
    for (uint32_t i = 0; i < boxes_.size(); ++i) {
      if (!boxes_[i].empty()) order_.push_back(i);
    }
    nodes_.clear();
    if (!order_.empty()) split(0, static_cast<uint32_t>(order_.size()));
  }
  Box bounds() const { return nodes_.empty() ? Box{} : nodes_[0].box; }

  // Calls found(index) for each box that the forward half of the line hits, in any order.
  template <class Found>
  void visit(const Ray& ray, Found&& found) const {
    if (nodes_.empty()) return;
    uint32_t stack[64];
    uint32_t depth = 0;
    stack[depth++] = 0;
    while (depth != 0) {
      const Node& node = nodes_[stack[--depth]];
      double enter, leave;
      if (!clip(ray, node.box, enter, leave) || leave < 0) continue;
      if (node.count == 0) {
        stack[depth++] = node.left;
        stack[depth++] = node.right;
        continue;
      }
      for (uint32_t i = 0; i < node.count; ++i) found(order_[node.first + i]);
    }
  }

 private:
  static constexpr uint32_t kLeaf = 4;
  struct Node {
    Box box;
    uint32_t left = 0, right = 0;
    uint32_t first = 0, count = 0;  // leaves
  };

  // Splits at the median of the centres along the longest side, so the tree is never deeper than
  // 32.
  uint32_t split(uint32_t first, uint32_t end) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box box, centres;
    for (uint32_t i = first; i < end; ++i) {
      box.add(boxes_[order_[i]]);
      Box centre;
      for (int axis = 0; axis < 3; ++axis) {
        centre.lower[axis] = centre.upper[axis] = centre_of(order_[i], axis);
      }
      centres.add(centre);
    }
    nodes_[index].box = box;
    if (end - first <= kLeaf) {
      nodes_[index].first = first;
      nodes_[index].count = end - first;
      return index;
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (centres.upper[i] - centres.lower[i] > centres.upper[axis] - centres.lower[axis]) axis = i;
    }
    const uint32_t middle = first + (end - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) {
                       return std::pair(centre_of(a, axis), a) < std::pair(centre_of(b, axis), b);
                     });
    const uint32_t left = split(first, middle);
    const uint32_t right = split(middle, end);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }
  double centre_of(uint32_t box, int axis) const {
    return 0.5 * (boxes_[box].lower[axis] + boxes_[box].upper[axis]);
  }

  std::vector<Box> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace kaamos::explain
