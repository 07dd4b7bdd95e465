// SPDX-License-Identifier: MIT
#include "runtime/embree/exact_pack.h"

#include <algorithm>

#include "runtime/embree/parallel.h"

namespace kaamos::embree {
namespace {

// A node of the tree, which is built only for its leaves.
struct Node {
  Node* children[2];
  uint32_t count;  // number of primitives; 0: not a leaf
  uint32_t primitives[kPackSize];
};

Node* new_node(RTCThreadLocalAllocator allocator) {
  auto* node = static_cast<Node*>(rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node)));
  *node = {};
  return node;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
  const BuilderCallback callback;
  return new_node(allocator);
}

void set_children(void* node, void** children, unsigned count, void*) {
  const BuilderCallback callback;
  for (unsigned i = 0; i < count; ++i) {
    static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
  }
}

void set_bounds(void*, const RTCBounds**, unsigned, void*) {}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  size_t count, void*) {
  const BuilderCallback callback;
  Node* leaf = new_node(allocator);
  leaf->count = static_cast<uint32_t>(count);
  for (size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
  std::sort(leaf->primitives, leaf->primitives + count);
  return leaf;
}

TrianglePack pack_of(const Node& leaf, const float* vertices, const uint32_t* indices) {
  TrianglePack pack = {};
  pack.count = leaf.count;
  for (uint32_t i = 0; i < leaf.count; ++i) {
    pack.primitives[i] = leaf.primitives[i];
    for (int k = 0; k < 3; ++k) {
      const float* v = vertices + 3 * uint64_t{indices[3 * uint64_t{leaf.primitives[i]} + k]};
      for (int axis = 0; axis < 3; ++axis) pack.corners[k][axis][i] = v[axis];
    }
  }
  return pack;
}

// Collects the leaves from left to right, so that packs close in space are close in memory.
void collect(const Node* root, const float* vertices, const uint32_t* indices,
             std::vector<TrianglePack>& packs) {
  std::vector<const Node*> open = {root};
  while (!open.empty()) {
    const Node* node = open.back();
    open.pop_back();
    if (node->count != 0) {
      packs.push_back(pack_of(*node, vertices, indices));
      continue;
    }
    for (const Node* child : {node->children[1], node->children[0]}) {
      if (child != nullptr) open.push_back(child);
    }
  }
}

}  // namespace

std::vector<TrianglePack> build_packs(RTCDevice device, const std::vector<PackInput>& inputs,
                                      RTCBuildQuality quality, const float* vertices,
                                      const uint32_t* indices) {
  std::vector<TrianglePack> packs;
  if (inputs.empty()) return packs;
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(inputs.size());
  for (const PackInput& in : inputs) {
    primitives.push_back({in.lower[0], in.lower[1], in.lower[2], 0, in.upper[0], in.upper[1],
                          in.upper[2], in.primitive});
  }
  RTCBVH tree = rtcNewBVH(device);
  if (tree == nullptr) return packs;
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.byteSize = sizeof(arguments);
  arguments.buildQuality = quality;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = 96;
  arguments.sahBlockSize = kPackSize;
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = kPackSize;
  arguments.bvh = tree;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  const Node* root = nullptr;
  {
    const BuilderRun run;
    root = static_cast<const Node*>(rtcBuildBVH(&arguments));
  }
  if (root != nullptr) collect(root, vertices, indices, packs);
  rtcReleaseBVH(tree);
  return packs;
}

PackFilter fastest_pack_filter() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx") != 0) return filter_pack_avx;
#endif
  return filter_pack_sse2;
}

}  // namespace kaamos::embree
