// SPDX-License-Identifier: MIT
// Loops over pixels and triangles see the same in either order, and what rays see.
#include "effects/surfaces/ray_order/loop_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/peter_panning.h"
#include "effects/engine/frame_fixture.h"
#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

// A scene, its loops, and the depth that rays find.
struct LoopStage : FrameStage {
  LoopStage(const std::string& backend, Scene given, std::uint32_t width, std::uint32_t height)
      : FrameStage(std::move(given), width, height, on(backend)) {
    loops = VisibilityLoops::create(device, frame, scene, scene.cameras.front().position(),
                                    loop_order_library().value())
                .value();
  }
  FloatImage see(LoopOrder order) {
    run([&](rtapi::CommandList& list) { loops.dispatch(list, frame, order); });
    return read_picture(device, queue, loops.seen()).value();
  }
  FloatImage depth_by_rays() {
    const RayPass gbuffer = make_pass(gbuffer_pass(gbuffer_library().value()));
    run([&](rtapi::CommandList& list) { gbuffer.dispatch(list, frame, {}, frame.height()); });
    return frame.read(device, queue, kViewZ).value();
  }

  VisibilityLoops loops;
};

class LoopOrders : public test::OnBackends {};

std::string loop_backend(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

INSTANTIATE_TEST_SUITE_P(Backends, LoopOrders, testing::Values("embree", "vulkan"), loop_backend);

// No multiple of a tile.
TEST_P(LoopOrders, SeeTheSameBitForBit) {
  LoopStage stage(GetParam(), make_lounge(), 19, 11);
  const FloatImage raster = stage.see(LoopOrder::kRaster), rays = stage.see(LoopOrder::kRays);
  EXPECT_EQ(raster.values, rays.values);
  std::size_t surfaces = 0;
  for (std::size_t i = 1; i < raster.values.size(); i += 2) surfaces += raster.values[i] != 0;
  EXPECT_GT(surfaces, 19 * 11 * 9 / 10);
}

// A pixel whose ray passes close to a silhouette may show what lies beside it.
TEST_P(LoopOrders, SeeWhatRaysSee) {
  LoopStage stage(GetParam(), make_peter_panning({}), 75, 43);
  const FloatImage seen = stage.see(LoopOrder::kRaster), depth = stage.depth_by_rays();
  std::size_t surfaces = 0, others = 0;
  for (std::size_t i = 0; i < depth.values.size(); ++i) {
    surfaces += depth.values[i] != 0;
    others += std::abs(seen.values[2 * i] - depth.values[i]) > 1e-4f * depth.values[i];
  }
  EXPECT_GT(surfaces, 75 * 43 / 4);
  EXPECT_EQ(others, 0u);
}

}  // namespace
}  // namespace kaamos::effects
