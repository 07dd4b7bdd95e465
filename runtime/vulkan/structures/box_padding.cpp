// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/box_padding.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace kaamos::vulkan {
namespace {

struct Box {
  float lower[3];
  float upper[3];
};
struct Header {
  Box bounds;
  uint32_t serialized_bytes;
  uint32_t instances;
  uint32_t leaves_offset;
  uint32_t reserved;
};
static_assert(sizeof(Header) == 40);
// A child is the offset of a node; bit 0 is set for inner nodes.
constexpr uint32_t kNoChild = 0xFFFFFFFFu;
struct Node {
  Box boxes[2];
  uint32_t children[2];
};
static_assert(sizeof(Node) == 56);

constexpr float kRelativePadding = 1e-6f;
// A tree farther from the origin than this many of its own sizes is left alone: the padding would
// be large compared with its triangles. The driver's triangle test, which rounds in world units,
// would then be the larger fault, and with more candidates it finds more wrong hits.
constexpr float kMostSizesOut = 100;

template <typename T>
T read(std::span<const uint8_t> bytes, uint64_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

bool is_inside(const Box& inner, const Box& outer) {
  for (int i = 0; i < 3; ++i) {
    // Written so that NaN counts as outside.
    if (!(inner.lower[i] >= outer.lower[i] && inner.upper[i] <= outer.upper[i] &&
          inner.lower[i] <= inner.upper[i])) {
      return false;
    }
  }
  return true;
}

bool is_as_expected(std::span<const uint8_t> bytes, const Header& header, uint64_t inner_nodes) {
  for (uint64_t n = 0; n < inner_nodes; ++n) {
    const Node node = read<Node>(bytes, sizeof(Header) + n * sizeof(Node));
    for (int i = 0; i < 2; ++i) {
      const uint32_t child = node.children[i];
      if (child == kNoChild) continue;
      if (!is_inside(node.boxes[i], header.bounds)) return false;
      const bool inner = (child & 1) != 0;
      const uint32_t offset = child & ~1u;
      if (inner && (offset < sizeof(Header) || offset >= header.leaves_offset ||
                    (offset - sizeof(Header)) % sizeof(Node) != 0)) {
        return false;
      }
      if (!inner && (offset < header.leaves_offset || offset >= bytes.size())) return false;
    }
  }
  return true;
}

}  // namespace

bool pad_boxes(std::span<uint8_t> structure, uint64_t leaves) {
  if (leaves == 0 || structure.size() < sizeof(Header)) return leaves == 0;
  const Header header = read<Header>(structure, 0);
  const uint64_t inner_nodes = std::max<uint64_t>(leaves - 1, 1);
  if (header.leaves_offset != sizeof(Header) + inner_nodes * sizeof(Node) ||
      header.leaves_offset >= structure.size() || !is_as_expected(structure, header, inner_nodes)) {
    return false;
  }
  float largest = 0;
  float size = 0;
  for (int i = 0; i < 3; ++i) {
    largest =
        std::max({largest, std::fabs(header.bounds.lower[i]), std::fabs(header.bounds.upper[i])});
    size = std::max(size, header.bounds.upper[i] - header.bounds.lower[i]);
  }
  if (largest > kMostSizesOut * size) return true;
  const float padding = kRelativePadding * largest;
  for (uint64_t n = 0; n < inner_nodes; ++n) {
    const uint64_t offset = sizeof(Header) + n * sizeof(Node);
    Node node = read<Node>(structure, offset);
    for (Box& box : node.boxes) {
      for (int i = 0; i < 3; ++i) {
        box.lower[i] -= padding;
        box.upper[i] += padding;
      }
    }
    std::memcpy(structure.data() + offset, &node, sizeof(node));
  }
  return true;
}

}  // namespace kaamos::vulkan
