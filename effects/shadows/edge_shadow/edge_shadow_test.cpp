// SPDX-License-Identifier: MIT
// Rays at the edges of shadows alone, against rays everywhere.
#include "effects/shadows/edge_shadow/edge_shadow.h"

#include "effects/shadows/shadow_map/map_fixture.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kRays = 16;

EdgeShadowConstants constants_of(std::uint32_t size, float margin = 1.5f) {
  EdgeShadowConstants constants;
  constants.map = {.flags = kShadowMapReceiverPlane,
                   .size = size,
                   .constant_bias = 0.5f,
                   .slope_bias = 0.0f,
                   .radius = 0.3f,
                   .taps = 64};
  constants.margin = margin;
  return constants;
}

// The scene of legs, sheets and contacts, with both effects.
MapFrame look(const EdgeShadowConstants& constants, const std::string& backend = "embree",
              const PeterPanningDesc& desc = {}) {
  return MapFrame(
      make_peter_panning(desc), {"sun", "sun-edges"},
      [&](const std::string& name, EffectSettings& settings) {
        if (name != "sun-edges") return;
        settings.samples = kRays;
        settings.set_constants(constants);
      },
      kRays, MapFrame::kWidth, MapFrame::kHeight, backend);
}

struct Counts {
  std::uint64_t lit = 0, dark = 0, edge = 0;
  std::uint64_t wrong = 0;  // of those without rays
  double rays = 0;
};

Counts count(MapFrame& frame) {
  const FloatImage sun = frame.read("sun"), own = frame.read("sun_edges"),
                   places = frame.read("sun_edges_places");
  Counts out;
  for (const std::size_t i : frame.surfaces()) {
    const auto place = static_cast<EdgePlace>(places.values[places.channels * i]);
    const float rays = sun.values[sun.channels * i], said = own.values[own.channels * i];
    out.rays += places.values[places.channels * i + 1];
    if (place == EdgePlace::kEdge) {
      ++out.edge;
      EXPECT_EQ(said, rays) << i << ": the same rays";
      continue;
    }
    ++(place == EdgePlace::kLit ? out.lit : out.dark);
    EXPECT_EQ(said, place == EdgePlace::kLit ? 1.0f : 0.0f) << i;
    out.wrong += said != rays;
  }
  return out;
}

class EdgeShadows : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, EdgeShadows, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// At edges it is what rays are, bit for bit; elsewhere almost always.
TEST_P(EdgeShadows, RaysGoToEdgesAndHardlyAnyIsMissed) {
  MapFrame frame = look(constants_of(2048), GetParam());
  const Counts found = count(frame);
  EXPECT_GT(found.edge, 100u);
  EXPECT_GT(found.dark, 20u);
  EXPECT_LT(found.edge, found.lit);
  EXPECT_LT(found.wrong, (found.lit + found.dark) / 200);
}

// Only this backend counts rays.
TEST(EdgeShadow, TracesAsManyRaysAsItSays) {
  MapFrame frame = look(constants_of(1024));
  const Counts found = count(frame);
  const std::uint64_t traced = frame.renderer->run("sun-edges", kRays).value().rays;
  EXPECT_EQ(static_cast<double>(traced), found.rays);
  const std::uint64_t everywhere = frame.renderer->run("sun", kRays).value().rays;
  EXPECT_LT(traced, everywhere / 2);
}

// A coarser map is wrong by more: what is thinner than its texels is lost. A wider margin costs
// rays and misses less.
TEST(EdgeShadow, CoarseMapsMissAndMarginsMend) {
  MapFrame fine = look(constants_of(2048)), coarse = look(constants_of(128)),
           bare = look(constants_of(128, 0)), wide = look(constants_of(128, 6));
  const Counts a = count(fine), b = count(coarse), c = count(bare), d = count(wide);
  EXPECT_GT(b.wrong, a.wrong);
  EXPECT_GT(c.wrong, b.wrong);
  EXPECT_LT(d.wrong, b.wrong);
  EXPECT_GT(d.edge, b.edge);
}

TEST(EdgeShadow, ExtremesAreHardOrRefused) {
  PeterPanningDesc point_sun;
  point_sun.angular_radius = 0;
  MapFrame hard = look(constants_of(1024), "embree", point_sun);
  EXPECT_GT(count(hard).edge, 10u) << "within the margin";

  FrameSettings settings;
  settings.width = settings.height = 8;
  settings.effects = choose_effects({"sun-edges"});
  settings.effects["sun-edges"].set_constants(constants_of(64, -1));
  const Scene scene = make_peter_panning({});
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  const auto refused = renderer->render();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("margin is -1"), std::string::npos)
      << refused.error().message;
}

}  // namespace
}  // namespace kaamos::effects
