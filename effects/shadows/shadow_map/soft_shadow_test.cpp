// SPDX-License-Identifier: MIT
// Filtered shadow maps against the closed form of penumbras: two sheets at different heights, whose
// shadows end on one line. [survey 5.1.3, 5.1.4]
#include <algorithm>
#include <array>
#include <cmath>

#include "effects/shadows/shadow_map/map_fixture.h"

namespace kaamos::effects {
namespace {

constexpr PeterPanningDesc kWideSun = {.angular_radius = 0.04};

// Looks down at one part of the line.
Scene sheets(int part, const PeterPanningDesc& desc = kWideSun) {
  Scene scene = make_peter_panning(desc);
  scene.instances[0].transform[0] *= 0.1;
  scene.instances[0].transform[2] *= 0.1;
  const double z = kSheetPartZ[part];
  scene.cameras.front().camera_to_world =
      look_at({kSheetShadowX, 0.7, z}, {kSheetShadowX, 0, z}, {0, 0, -1});
  return scene;
}

// Tells whether the floor's point lies where one part's edge alone decides how much of the sun is
// seen: farther on the sheet's other edge does, too.
bool is_by_edge(const glm::dvec3& p, int part) {
  return std::abs(p.z - kSheetPartZ[part]) < 0.1 && std::abs(p.x - kSheetShadowX) < 0.25;
}

// Root mean square of what a layer says about the part of the line, less the closed form.
double line_error(MapFrame& frame, int part, const std::string& layer,
                  const PeterPanningDesc& desc = kWideSun) {
  const FloatImage said = frame.read(layer);
  double sum = 0;
  int count = 0;
  for (const std::size_t i : frame.floor()) {
    const glm::dvec3 p = frame.position(i);
    if (!is_by_edge(p, part)) continue;
    const double off = said.values[said.channels * i] - sheet_visibility(desc, part, p.x);
    sum += off * off;
    ++count;
  }
  EXPECT_GT(count, 200);
  return std::sqrt(sum / count);
}

std::array<double, 3> line_errors(const std::string& name, const std::string& layer,
                                  const ShadowMapConstants& constants) {
  std::array<double, 3> errors{};
  for (int part = 0; part < 3; ++part) {
    MapFrame frame(sheets(part), {name}, &constants, 64);
    errors[part] = line_error(frame, part, layer);
  }
  return errors;
}

constexpr ShadowMapConstants kPcss = {.method = kShadowMapPcss,
                                      .flags = kShadowMapReceiverPlane,
                                      .constant_bias = 0.5f,
                                      .slope_bias = 0.0f,
                                      .radius = 0.3f,
                                      .taps = 64,
                                      .blocker_taps = 36};

ShadowMapConstants pcf(float radius, std::uint32_t flags = kShadowMapReceiverPlane) {
  ShadowMapConstants constants = kPcss;
  constants.method = kShadowMapPcf;
  constants.radius = radius;
  constants.flags = flags;
  return constants;
}

// A filter of one width is right where penumbras are that wide, and nowhere else.
TEST(SoftShadow, OneWidthFitsOnePenumbra) {
  const double sine = std::sin(kWideSun.sun_elevation), tangent = std::tan(kWideSun.angular_radius);
  const auto low =
      line_errors("sun-pcf", "sun_pcf", pcf(static_cast<float>(tangent * kSheetHeights[0] / sine)));
  const auto high =
      line_errors("sun-pcf", "sun_pcf", pcf(static_cast<float>(tangent * kSheetHeights[1] / sine)));
  EXPECT_LT(low[0], 0.03);
  EXPECT_GT(low[2], 3 * low[0]);
  EXPECT_LT(high[2], 0.03);
  EXPECT_GT(high[0], 3 * high[2]);
}

// The width that follows from the mean depth of what casts the shadow is right below each sheet;
// below both it is that of neither.
TEST(SoftShadow, WidthFollowsOneOccluderAndNotTwo) {
  const auto error = line_errors("sun-pcss", "sun_pcss", kPcss);
  EXPECT_LT(error[0], 0.05);
  EXPECT_LT(error[2], 0.05);
  EXPECT_GT(error[1], 1.5 * std::max(error[0], error[2]));
  const auto rays = line_errors("sun", "sun", kPcss);
  for (const double off : rays) EXPECT_LT(off, 0.03);
  const auto hard = line_errors("sun-map", "sun_map", {});
  for (int part = 0; part < 3; ++part) EXPECT_LT(error[part], hard[part]) << part;
}

// Below one flat sheet the squares of the map's texels are the sheet, and the sum is its part of
// the sun; below two that overlap, what both hide counts twice. [Guennebaud et al. 2006; Atty et
// al. 2006]
TEST(SoftShadow, BackprojectionSumsWhatTexelsHide) {
  ShadowMapConstants constants = kPcss;
  constants.method = kShadowMapBackprojection;
  const auto error = line_errors("sun-backprojection", "sun_backprojection", constants);
  const auto pcss = line_errors("sun-pcss", "sun_pcss", kPcss);
  for (const int part : {0, 2}) EXPECT_LT(error[part], 0.7 * pcss[part]) << part;
  EXPECT_GT(error[1], 4 * error[2]);
  MapFrame frame(sheets(1), {"sun-backprojection"}, &constants);
  const FloatImage said = frame.read("sun_backprojection");
  int darker = 0, brighter = 0;
  for (const std::size_t i : frame.floor()) {
    const glm::dvec3 p = frame.position(i);
    if (!is_by_edge(p, 1)) continue;
    const double off = said.values[said.channels * i] - sheet_visibility(kWideSun, 1, p.x);
    darker += off < -0.05;
    brighter += off > 0.05;
  }
  EXPECT_GT(brighter, 50);
  EXPECT_LT(darker, brighter / 10);
}

// A sun that is a point: what one texel says.
TEST(SoftShadow, PointSunIsHard) {
  constexpr PeterPanningDesc kPoint = {.angular_radius = 0};
  MapFrame frame(sheets(1, kPoint), {"sun-map", "sun-pcss"}, &kPcss);
  // Both rows have the constants, and so the method: the hard map needs its own.
  ShadowMapConstants hard = kPcss;
  hard.method = kShadowMapHard;
  MapFrame other(sheets(1, kPoint), {"sun-map"}, &hard);
  EXPECT_EQ(frame.read("sun_pcss").values, other.read("sun_map").values);
}

// The inner penumbra stays in the hard shadow, is dark no later than the whole one, and falls from
// the line on over half the width: [Story 2015]
TEST(SoftShadow, InnerPenumbraStaysInTheHardShadow) {
  ShadowMapConstants inner = kPcss, hard = kPcss;
  inner.flags |= kShadowMapInnerPenumbra;
  hard.method = kShadowMapHard;
  MapFrame a(sheets(2), {"sun-pcss"}, &inner), b(sheets(2), {"sun-pcss"}, &kPcss),
      c(sheets(2), {"sun-map"}, &hard);
  const FloatImage in = a.read("sun_pcss"), whole = b.read("sun_pcss"), edge = c.read("sun_map");
  double sum = 0;
  int soft = 0, deeper = 0;
  for (const std::size_t i : a.floor()) {
    const float said = in.values[4 * i];
    if (edge.values[4 * i] == 1) {
      EXPECT_EQ(said, 1) << i;
    }
    EXPECT_GE(said, whole.values[4 * i]) << i;
    EXPECT_EQ(said == 0, whole.values[4 * i] == 0) << i;
    const glm::dvec3 p = a.position(i);
    if (!is_by_edge(p, 2)) continue;
    const double truth = std::min(1.0, 2 * sheet_visibility(kWideSun, 2, p.x));
    sum += std::pow(said - truth, 2);
    soft += said > 0 && said < 1;
    ++deeper;
  }
  EXPECT_GT(soft, 20);
  // Twice the contrast, and so twice PCSS's error, which is 0.034 here.
  EXPECT_LT(std::sqrt(sum / deeper), 0.07);
}

// More sun, less light where a part of it is hidden from half on, and more where less is.
TEST(SoftShadow, GrowsWithTheSun) {
  std::vector<double> lit;
  for (const double radius : {0.0, 0.01, 0.02, 0.04}) {
    const PeterPanningDesc desc = {.angular_radius = radius};
    MapFrame frame(sheets(2, desc), {"sun-pcss"}, &kPcss);
    const FloatImage said = frame.read("sun_pcss");
    double partly = 0;
    for (const std::size_t i : frame.floor()) {
      partly += said.values[4 * i] > 0.02 && said.values[4 * i] < 0.98;
    }
    lit.push_back(partly);
  }
  EXPECT_EQ(lit[0], 0.0);
  for (int i = 1; i < 4; ++i) EXPECT_GT(lit[i], 1.3 * lit[i - 1]) << i;
}

// A square of taps says nearly what a disk of as many says.
TEST(SoftShadow, SquareAndDiskAgree) {
  const ShadowMapConstants disk = pcf(0.05f);
  const ShadowMapConstants square =
      pcf(0.05f * 0.886f, kShadowMapReceiverPlane | kShadowMapGrid);  // of the same area
  MapFrame a(sheets(0), {"sun-pcf"}, &disk), b(sheets(0), {"sun-pcf"}, &square);
  const FloatImage round = a.read("sun_pcf"), straight = b.read("sun_pcf");
  double sum = 0;
  for (const std::size_t i : a.floor()) {
    sum += std::pow(round.values[4 * i] - straight.values[4 * i], 2);
  }
  EXPECT_LT(std::sqrt(sum / a.floor().size()), 0.05);
}

// In a scene of 60 m a map over all of it has texels of 6 cm. Four cascades of a quarter as many
// texels are finer near the camera, and as good as it gets far away.
TEST(Cascades, BeatOneMapOfAsManyTexels) {
  const Scene scene = make_peter_panning({});
  ShadowMapConstants one = kPcss, four = kPcss;
  one.size = 1024;
  four.size = 512;
  four.cascades = 4;
  MapFrame a(scene, {"sun", "sun-pcss"}, &one, 64), b(scene, {"sun", "sun-cascades"}, &four, 64);
  const double coarse = a.difference("sun", "sun_pcss"), fine = b.difference("sun", "sun_cascades");
  EXPECT_LT(fine, 0.7 * coarse);
}

// A blend band goes from one cascade over into the next: without it, only pixels in bands change.
TEST(Cascades, BlendOnlyInTheirBands) {
  Scene scene = make_peter_panning({});
  ShadowMapConstants sharp = kPcss, blended = kPcss;
  sharp.size = blended.size = 128;
  sharp.cascades = blended.cascades = 3;
  sharp.blend = 0;
  blended.blend = 0.3f;
  MapFrame a(scene, {"sun-cascades"}, &sharp), b(scene, {"sun-cascades"}, &blended);
  const FloatImage x = a.read("sun_cascades"), y = b.read("sun_cascades");
  std::size_t changed = 0;
  for (std::size_t i = 0; i < x.values.size(); i += 4) changed += x.values[i] != y.values[i];
  EXPECT_GT(changed, 3u);
  EXPECT_LT(changed, x.values.size() / 4 / 3);
}

}  // namespace
}  // namespace kaamos::effects
