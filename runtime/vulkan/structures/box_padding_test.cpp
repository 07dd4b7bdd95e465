// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/box_padding.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <random>

#include "runtime/vulkan/testing/ray_caster.h"

namespace kaamos::vulkan {
namespace {

using testing::CastRay;
using testing::GeometryInput;
using testing::instance_of;
using testing::RayCaster;
using testing::SceneHarness;

constexpr int kCells = 40;

// A flat grid, whose boxes have no height; x and y run over [0, kCells] * kCell.
constexpr float kCell = 0.37f;
constexpr float kHeight = 5.1f;

GeometryInput grid() {
  GeometryInput mesh;
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      mesh.xyz.insert(mesh.xyz.end(),
                      {kCell * static_cast<float>(x), kCell * static_cast<float>(y), kHeight});
    }
  }
  for (uint32_t y = 0; y < kCells; ++y) {
    for (uint32_t x = 0; x < kCells; ++x) {
      const uint32_t i = y * (kCells + 1) + x;
      mesh.indices.insert(mesh.indices.end(),
                          {i, i + 1, i + kCells + 1, i + 1, i + kCells + 2, i + kCells + 1});
    }
  }
  return mesh;
}

// Counts misses among rays in all directions to points on inner edges of the grid.
uint32_t misses(const std::shared_ptr<Gpu>& gpu) {
  SceneHarness h(gpu);
  RayCaster caster(h);
  const uint64_t scene = h.top_level({instance_of(h.bottom_level({grid()}))});
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<float>(random() % 65536) / 65536.0f; };
  std::vector<CastRay> rays(40000);
  for (CastRay& ray : rays) {
    const int x = 1 + static_cast<int>(random() % (kCells - 2));
    const int y = 1 + static_cast<int>(random() % (kCells - 2));
    const float along = number();
    const int dx = static_cast<int>(random() % 2);
    const float target[3] = {kCell * (static_cast<float>(x) + along * static_cast<float>(dx)),
                             kCell * (static_cast<float>(y) + along * static_cast<float>(1 - dx)),
                             kHeight};
    const float origin[3] = {target[0] + 3 * number() - 1.5f, target[1] + 3 * number() - 1.5f,
                             -number()};
    for (int i = 0; i < 3; ++i) {
      ray.origin[i] = origin[i];
      ray.direction[i] = target[i] - origin[i];
    }
  }
  uint32_t count = 0;
  for (const auto& hit : caster.cast(scene, rays)) count += hit.t < 0;
  return count;
}

TEST(Workarounds, B4RaysAtSharedEdgesSlipThrough) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "only lavapipe has this fault";
  setenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS", "B4", 1);
  const auto plain = *Gpu::create();
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  EXPECT_GT(misses(plain), 0u);
  if (!gpu->workarounds().has(Workaround::kPadBoxes)) {
    GTEST_SKIP() << "not a driver whose trees are known";
  }
  EXPECT_EQ(misses(gpu), 0u);
}

// A tree of one leaf, in a box of edge 1 whose lower corner is at (x, x, x).
std::vector<uint8_t> tree_at(float x) {
  struct {
    float bounds[6];
    uint32_t sizes[4] = {0, 0, 96, 0};  // the third: where the leaves begin
    float boxes[12] = {};
    uint32_t children[2] = {96, 0xFFFFFFFFu};
    uint32_t leaf[16] = {};
  } tree;
  static_assert(sizeof(tree) == 160);
  for (int i = 0; i < 6; ++i) tree.bounds[i] = tree.boxes[i] = i < 3 ? x : x + 1;
  std::vector<uint8_t> out(sizeof(tree));
  std::memcpy(out.data(), &tree, sizeof(tree));
  return out;
}

TEST(PadBoxes, OnlyNearTheOrigin) {
  const auto is_padded = [](float x) {
    std::vector<uint8_t> bytes = tree_at(x);
    EXPECT_TRUE(pad_boxes(bytes, 1));
    float lower;
    std::memcpy(&lower, bytes.data() + 40, sizeof(lower));
    EXPECT_LE(lower, x);
    return lower < x;
  };
  EXPECT_TRUE(is_padded(0));
  EXPECT_TRUE(is_padded(-50));
  EXPECT_TRUE(is_padded(90));
  EXPECT_FALSE(is_padded(1000));
  EXPECT_FALSE(is_padded(-1e6f));
}

TEST(PadBoxes, LeavesAloneWhatItDoesNotKnow) {
  std::vector<uint8_t> bytes(512, 0);
  EXPECT_TRUE(pad_boxes({bytes.data(), 0}, 0));
  EXPECT_FALSE(pad_boxes(bytes, 2));
  bytes[32] = 96;  // the offset of the leaves, correct for two
  // Children that are not nodes.
  bytes[88] = bytes[92] = 33;
  const std::vector<uint8_t> before = bytes;
  EXPECT_FALSE(pad_boxes(bytes, 2));
  EXPECT_FALSE(pad_boxes(bytes, 3));
  EXPECT_FALSE(pad_boxes(bytes, uint64_t{1} << 40));
  EXPECT_EQ(bytes, before);
}

}  // namespace
}  // namespace kaamos::vulkan
