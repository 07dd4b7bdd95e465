// SPDX-License-Identifier: MIT
// Filtered shadow maps against closed forms, percentage-closer filtering and ray traced shadows,
// and how each fails.
#include "effects/shadows/filtered_shadow_map/filtered_shadow_map.h"

#include <algorithm>
#include <cmath>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/staging.h"
#include "effects/shadows/shadow_map/map_fixture.h"

namespace kaamos::effects {
namespace {

using Constants = FilteredShadowMapConstants;

const std::vector<std::string> kTechniques = {
    "sun-vsm", "sun-esm", "sun-evsm", "sun-convolution", "sun-pcss-vsm", "sun-pcss-convolution"};

bool is_pcss(const std::string& name) {
  return name.find("pcss") != std::string::npos;
}

std::string layer_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// Changes what a row has, of filtered maps only.
MapFrame::Change with(const std::function<void(Constants&)>& change) {
  return [=](const std::string& name, EffectSettings& settings) {
    if (std::find(kTechniques.begin(), kTechniques.end(), name) == kTechniques.end()) return;
    auto constants = settings.get_constants<Constants>();
    change(constants);
    settings.set_constants(constants);
  };
}

constexpr double kFloorY = 0.15;

// A metre from the highest thing to the lowest one, with the sun straight above: depths are shares
// of what maps reach over. A floor at 0.85; what casts shadows on it is added.
Scene start_stack() {
  Scene scene = start_scene("stack");
  scene.sun = default_sun();
  scene.sun->direction_to_sun = {0, 1, 0};
  scene.sun->angular_radius = 0;
  const std::uint32_t paint = add_paint(scene, "grey", glm::vec3(0.5f));
  add_floor(scene, "floor", {-0.25, -0.25}, {0.25, 0.25}, kFloorY, paint);
  add_floor(scene, "lowest", {-0.25, -0.25}, {-0.24, -0.24}, 0.0, paint);
  add_floor(scene, "highest", {0.24, 0.24}, {0.25, 0.25}, 1.0, paint);
  return scene;
}

// Two sheets at depths 0.2 and 0.8, which meet over x = 0 and cover all of the sun.
Scene two_occluders() {
  Scene scene = start_stack();
  add_floor(scene, "upper", {-0.2, -0.1}, {0, 0.1}, 0.8, 0);
  add_floor(scene, "lower", {0, -0.1}, {0.2, 0.1}, 0.2, 0);
  add_view(scene, "below", {0, 0.195, 0.07}, {0, 0.15, 0}, 1.0);
  return scene;
}

constexpr double kHalf = 0.03;  // of the filter's width
constexpr double kTexel = 0.5 / 256;
constexpr double kDepths[2] = {0.2, 0.8};
constexpr double kReceiver = 1 - kFloorY;

double chebyshev(double share, double a, double b, double at) {
  const double mean = share * a + (1 - share) * b;
  const double variance = share * a * a + (1 - share) * b * b - mean * mean;
  return at <= mean ? 1.0 : variance / (variance + (at - mean) * (at - mean));
}

// As Step in filtered_shadow_map.hlsl, from the equation. [Annen et al. 2007]
double step(double away, int terms, double damping) {
  double sum = 0.5;
  for (int k = 1; k <= terms; ++k) {
    const double c = 3.14159265358979 * (2 * k - 1);
    sum += 2 / c * std::exp(-damping * k * k / (terms * terms)) * std::sin(c * away);
  }
  return sum;
}

// Returns what each technique says where the upper sheet covers `share` of its filter.
double two_occluder_oracle(const std::string& name, double share, const Constants& c) {
  const auto mean = [&](const auto& f) {
    return share * f(kDepths[0]) + (1 - share) * f(kDepths[1]);
  };
  const double at = kReceiver;
  if (name == "sun-esm") {
    return mean([&](double z) { return std::exp(c.exponent * (z - at)); });
  }
  if (name == "sun-evsm") {
    const auto front = [&](double z) { return std::exp(c.exponent * (2 * z - 1)); };
    const auto back = [&](double z) { return -std::exp(-c.back_exponent * (2 * z - 1)); };
    return std::min(chebyshev(share, front(kDepths[0]), front(kDepths[1]), front(at)),
                    chebyshev(share, back(kDepths[0]), back(kDepths[1]), back(at)));
  }
  if (name == "sun-convolution") {
    const int terms = static_cast<int>(c.terms);
    const double offset = c.offset / (2 * terms);
    const double sum = mean([&](double z) { return step(z - at + offset, terms, c.damping); });
    return std::clamp(sum / step(offset, terms, c.damping), 0.0, 1.0);
  }
  return chebyshev(share, kDepths[0], kDepths[1], at);
}

class FilteredShadowMaps : public test::OnBackends {};

std::string filtered_backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

INSTANTIATE_TEST_SUITE_P(Backends, FilteredShadowMaps, testing::Values("embree", "vulkan"),
                         filtered_backend_name);

void expect_two_occluders(const std::string& backend) {
  const std::vector<std::string> names = {"sun-vsm", "sun-esm", "sun-evsm", "sun-convolution"};
  Constants used[4];
  MapFrame frame(
      two_occluders(), names,
      [&](const std::string& name, EffectSettings& settings) {
        auto constants = settings.get_constants<Constants>();
        constants.map.size = 256;
        constants.map.radius = static_cast<float>(kHalf);
        constants.map.constant_bias = constants.map.slope_bias = 0;
        settings.set_constants(constants);
        used[std::find(names.begin(), names.end(), name) - names.begin()] = constants;
      },
      1, 32, 18, backend);
  // A share is known to a texel of the map.
  const double texel = kTexel / (2 * kHalf);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const FloatImage lit = frame.read(layer_of(names[i]));
    int count = 0;
    for (const std::size_t pixel : frame.floor()) {
      const glm::dvec3 p = frame.position(pixel);
      if (std::abs(p.z) > 0.06 || std::abs(p.x) > 0.15) continue;
      const double share = std::clamp((kHalf - p.x) / (2 * kHalf), 0.0, 1.0);
      double least = 1, most = 0;
      for (int k = -10; k <= 10; ++k) {
        const double near = std::clamp(share + 0.1 * k * texel, 0.0, 1.0);
        const double said = two_occluder_oracle(names[i], near, used[i]);
        least = std::min(least, said);
        most = std::max(most, said);
      }
      const double said = lit.values[lit.channels * pixel];
      EXPECT_GT(said, least - 0.01) << names[i] << " at " << p.x;
      EXPECT_LT(said, most + 0.01) << names[i] << " at " << p.x;
      ++count;
    }
    EXPECT_GT(count, 300) << names[i];
  }
  const auto brightest = [&](const char* layer) {
    const FloatImage lit = frame.read(layer);
    float out = 0;
    for (const std::size_t pixel : frame.floor()) {
      const glm::dvec3 p = frame.position(pixel);
      if (std::abs(p.z) > 0.06 || std::abs(p.x) > kTexel) continue;
      out = std::max(out, lit.values[lit.channels * pixel]);
    }
    return out;
  };
  // Where the two sheets cover half of the sun each, together all of it, variance lets 0.42 of it
  // through, the others next to nothing. [Donnelly & Lauritzen 2006]
  EXPECT_NEAR(brightest("sun_vsm"), 0.42, 0.04);
  for (const char* layer : {"sun_esm", "sun_evsm", "sun_convolution"}) {
    EXPECT_LT(brightest(layer), 0.02) << layer;
  }
}

TEST_P(FilteredShadowMaps, SayBelowTwoOccludersWhatTheirEquationsSay) {
  expect_two_occluders(GetParam());
}

// A sheet over the floor, at 0.95 over x = -0.2 and at 0.2 over x = 0.2: all is shadow.
constexpr double kSlope = -0.75 / 0.4;
double sheet_gap(double x) {
  return 0.2 + kSlope * (x - 0.2) - kFloorY;
}

Scene tilted_sheet() {
  Scene scene = start_stack();
  add_thing(scene, "sheet", patch({-0.2, 0.95, 0.2}, {0.4, -0.75, 0}, {0, 0, -0.4}, 1, 1), 0);
  add_view(scene, "below", {-0.19, 0.55, 0}, {0.02, 0.15, 0}, 1.0);
  return scene;
}

struct Rings {
  double mean = 0;     // light on the floor, far from contact
  double contact = 0;  // and where the sheet is near
};

Rings rings(std::uint32_t terms, float damping) {
  MapFrame frame(tilted_sheet(), {"sun-convolution"}, with([&](Constants& c) {
                   c.map.size = 256;
                   c.map.radius = 0;
                   c.map.constant_bias = c.map.slope_bias = 0;
                   c.terms = terms;
                   c.damping = damping;
                 }),
                 1, 64, 36, "embree");
  const FloatImage lit = frame.read("sun_convolution");
  Rings out;
  int far = 0, near = 0;
  double worst = 0;
  for (const std::size_t pixel : frame.floor()) {
    const glm::dvec3 p = frame.position(pixel);
    if (std::abs(p.x) > 0.18 || std::abs(p.z) > 0.18) continue;
    const double value = lit.values[lit.channels * pixel], gap = sheet_gap(p.x);
    const double offset = 1.0 / (2 * terms);
    const double oracle = std::clamp(step(offset - gap / 1.002, static_cast<int>(terms), damping) /
                                         step(offset, static_cast<int>(terms), damping),
                                     0.0, 1.0);
    worst = std::max(worst, std::abs(value - oracle));
    (gap > 0.25 ? out.mean : out.contact) += value;
    ++(gap > 0.25 ? far : near);
  }
  out.mean /= far;
  out.contact /= near;
  EXPECT_LT(worst, 0.005) << "against the series itself";
  EXPECT_GT(std::min(far, near), 100);
  return out;
}

// A series of few terms lets light through far from contact, where it rings, and at contact, within
// half its step. Damping trades one for the other. [Annen et al. 2007]
TEST(FilteredShadowMap, SeriesRing) {
  const Rings four = rings(4, 0), eight = rings(8, 0), sixteen = rings(16, 0);
  EXPECT_GT(four.mean, 3 * sixteen.mean);
  EXPECT_GT(four.mean, eight.mean);
  EXPECT_GT(four.contact, 10 * sixteen.contact);
  const Rings damped = rings(16, 1);
  EXPECT_LT(damped.mean, sixteen.mean);
  EXPECT_GT(rings(4, 1).contact, four.contact);
}

Scene small_floor(const PeterPanningDesc& desc) {
  Scene scene = make_peter_panning(desc);
  scene.instances[0].transform[0] *= 0.1;
  scene.instances[0].transform[2] *= 0.1;
  return scene;
}

// All but PCSS filter over the same square: they come nearer to percentage-closer filtering than to
// what rays see, PCSS nearer to rays.
TEST(FilteredShadowMap, ApproximatePcfNotRays) {
  std::vector<std::string> names = {"sun", "sun-map"};
  names.insert(names.end(), kTechniques.begin(), kTechniques.end());
  MapFrame frame(
      small_floor({}), names,
      [](const std::string& name, EffectSettings& settings) {
        if (name == "sun-map") {
          settings.set_constants(
              ShadowMapConstants{.method = kShadowMapPcf,
                                 .flags = kShadowMapGrid | kShadowMapReceiverPlane,
                                 .size = 1024,
                                 .constant_bias = 0.5f,
                                 .slope_bias = 0,
                                 .radius = 0.03f,
                                 .taps = 64});
        } else if (name != "sun") {
          auto constants = settings.get_constants<Constants>();
          constants.map.size = 1024;
          constants.map.radius = is_pcss(name) ? 0.5f : 0.03f;
          settings.set_constants(constants);
        }
      },
      64, 64, 36, "embree");
  for (const std::string& name : kTechniques) {
    const double pcf = frame.difference("sun_map", layer_of(name));
    const double rays = frame.difference("sun", layer_of(name));
    if (is_pcss(name))
      EXPECT_LT(rays, pcf);
    else
      EXPECT_LT(pcf, rays) << name;
  }
}

// Below a sheet a metre above the floor the penumbra is as wide as it has to be; in a quarter of
// that, contact is within the step of the series. One width fits neither.
TEST(FilteredShadowMap, PcssFollowsThePenumbraOfASheet) {
  constexpr PeterPanningDesc kWideSun = {.angular_radius = 0.04};
  const auto error = [&](const std::string& name, int part, std::uint32_t terms) {
    Scene scene = make_peter_panning(kWideSun);
    scene.instances[0].transform[0] *= 0.1;
    scene.instances[0].transform[2] *= 0.1;
    const double z = kSheetPartZ[part];
    scene.cameras.front().camera_to_world =
        look_at({kSheetShadowX, 0.7, z}, {kSheetShadowX, 0, z}, {0, 0, -1});
    MapFrame frame(scene, {name}, with([&](Constants& c) {
                     c.map.size = 1024;
                     c.terms = terms;
                   }),
                   1, 64, 36, "embree");
    const FloatImage said = frame.read(layer_of(name));
    double sum = 0;
    int count = 0;
    for (const std::size_t i : frame.floor()) {
      const glm::dvec3 p = frame.position(i);
      if (std::abs(p.z - z) > 0.1 || std::abs(p.x - kSheetShadowX) > 0.25) continue;
      const double off = said.values[said.channels * i] - sheet_visibility(kWideSun, part, p.x);
      sum += off * off;
      ++count;
    }
    return std::sqrt(sum / count);
  };
  EXPECT_LT(error("sun-pcss-convolution", 2, 16), 0.7 * error("sun-convolution", 2, 16));
}

}  // namespace
}  // namespace kaamos::effects
