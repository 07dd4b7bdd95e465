// SPDX-License-Identifier: MIT
//
// What must not change a picture, and what no input may do to it, for every alternative of the
// registry: a new row is among them by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "comparing.h"
#include "effects/glass/drawn_glass/drawn_glass.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/occluded_volume.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/occlusion/baked_ao/baked_ao.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"
#include "effects/reflections/planar/planar_reflections.h"
#include "effects/reflections/screen_space/screen_reflections.h"
#include "effects/shadows/filtered_shadow_map/filtered_shadow_map.h"
#include "effects/shadows/hybrid_shadow/hybrid_shadow.h"
#include "effects/shadows/lamp_shadow/lamp_shadow.h"
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"
#include "effects/shadows/shadow_map/shadow_map.h"
#include "room.h"

namespace kaamos::test {
namespace {

using namespace effects;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Change = std::function<void(EffectSettings&, float scale)>;

// Changes the constants of an effect, or the first of them, as `T`.
template <class T>
Change change(void (*apply)(T&, float)) {
  return [apply](EffectSettings& settings, float scale) {
    T constants = settings.get_constants<T>();
    apply(constants, scale);
    std::memcpy(settings.constants.data(), &constants, sizeof constants);
  };
}

// Multiplies the lengths among an effect's constants; EffectSettings::radius is multiplied
// elsewhere. An effect without such constants has no entry. Maps are made small besides.
const std::map<std::string, Change>& lengths() {
  const Change march = change<ScreenReflectionConstants>([](auto& c, float s) {
    c.longest *= s;
    c.shortest *= s;
    c.thickness *= s;
  });
  const Change map = change<ShadowMapConstants>([](auto& c, float s) {
    c.radius *= s;
    c.reach *= s;
    c.size = 128;
  });
  const Change screen_shadow = change<ScreenSpaceShadowConstants>([](auto& c, float s) {
    c.length *= s;
    c.thickness *= s;
  });
  const Change glass = change<DrawnGlassConstants>([](auto& c, float s) {
    c.rays.reflection_length *= s;
    c.rays.depth_scale /= s;
  });
  const Change lamp = change<LampShadowConstants>([](auto& c, float s) {
    c.near_plane *= s;
    c.widest *= s;
    c.soft_from *= s;
  });
  static const std::map<std::string, Change> all = {
      {"ssr", march},
      {"ssr-metres", march},
      {"ssr-line", march},
      {"ssr-masked", march},
      {"ssr-half-masked", march},
      {"ssr-stochastic", march},
      {"ssr-blurred", march},
      {"hybrid-reflections", march},
      {"tiled-reflections", march},
      {"planar", change<PlanarConstants>([](auto& c, float s) { c.longest *= s; })},
      {"sun-map", map},
      {"sun-per-object", map},
      {"sun-pcf", map},
      {"sun-pcss", map},
      {"sun-backprojection", map},
      {"sun-cascades", map},
      {"sun-hybrid",
       [map](EffectSettings& settings, float s) {
         map(settings, s);
         change<HybridShadowConstants>([](auto& c, float by) { c.soft_from *= by; })(settings, s);
       }},
      {"sun-edges", map},
      {"sun-vsm", map},
      {"sun-esm", map},
      {"sun-evsm", map},
      {"sun-convolution", map},
      {"sun-pcss-vsm", map},
      {"sun-pcss-convolution", map},
      {"lamp-pcf", lamp},
      {"lamp-pcss", lamp},
      {"lamp-hybrid", lamp},
      {"screen-contact", screen_shadow},
      {"screen-contact-multisampled", screen_shadow},
      {"screen-contact-multipass", screen_shadow},
      {"screen-sun", screen_shadow},
      {"gi-ray-ao", change<IndirectConstants>([](auto& c, float s) { c.length *= s; })},
      {"gi-screen-ao", change<OccludedVolumeSettings>([](auto& c, float s) { c.radius *= s; })},
      {"baked-ao", change<BakedAoConstants>([](auto& c, float s) { c.texel *= s; })},
      // No length, but all that GTAO can do.
      {"gtao-frames", change<GtaoConstants>([](auto& c, float) { c.multibounce = 1; })},
      {"glass-shadow-map", map},
      {"drawn-glass", glass},
      {"blended-glass", glass},
  };
  return all;
}

// The others are what these tests are about.
bool is_in_all(const Effect& row) {
  return row.alternative_to.empty() && !row.on_request;
}

FrameSettings settings_of(float scale) {
  FrameSettings settings;
  settings.width = 32;
  settings.height = 18;
  settings.seed = 1;
  settings.rows = settings.height;
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  settings.max_pass_views = 2048;
  // A ray that rounding moves may read another cell, and which ones are baked would follow.
  settings.volume.whole = true;
  settings.volume.cell = scale;
  settings.volume.samples = 4;
  settings.volume.bounces = 2;
  settings.volume.seed = 0;
  for (const Effect& row : northlight_effects()) {
    if (is_in_all(row)) continue;
    EffectSettings& effect = settings.effects[row.name];
    effect = row.defaults;
    effect.keep = effect.named = true;
    effect.radius *= scale;
    const auto found = lengths().find(row.name);
    if (found != lengths().end()) found->second(effect, scale);
  }
  add_included(settings.effects, northlight_effects());
  return settings;
}

// The channels of a signal that do not count metres.
FloatImage without_lengths(const FloatImage& picture, const EffectSignal& signal) {
  FloatImage out(picture.width, picture.height, std::min(signal.channels, picture.channels));
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const std::size_t pixel = i / out.channels, channel = i % out.channels;
    // Of hits in the picture, the third is the distance.
    const bool is_length = !signal.is_light && signal.channels == 4 && channel == 2;
    out.values[i] = is_length ? 0 : picture.values[picture.channels * pixel + channel];
  }
  return out;
}

// All alternatives in one frame: by the name of the row and of the signal.
Pictures render_rows(const Scene& scene, float scale = 1) {
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice({}).value(), scene, settings_of(scale)).value();
  renderer->render().value();
  Pictures out;
  for (const Effect& row : northlight_effects()) {
    if (is_in_all(row)) continue;
    for (const EffectSignal& signal : row.signals) {
      out[row.name + ": " + signal.name] =
          without_lengths(renderer->read(signal.name).value(), signal);
    }
  }
  return out;
}

const Pictures& room_rows() {
  static const Pictures pictures = render_rows(make_room());
  return pictures;
}

// Rows, or single pictures of them, that a test leaves out, with the reason.
using Exceptions = std::map<std::string, std::string>;

std::string row_of(const std::string& picture) {
  return picture.substr(0, picture.find(':'));
}

// Every picture has `least` decibels and more, 200 for the same bytes. Those of rows that are left
// out have less, so that no exception outlives its reason.
void expect_same(const std::string& what, const Pictures& now, const Pictures& reference,
                 double least, const Exceptions& but = {}) {
  for (const auto& [name, image] : reference) {
    auto left_out = but.find(name);
    if (left_out == but.end()) left_out = but.find(row_of(name));
    const bool is_equal = now.at(name).values == image.values;
    const double db = is_equal ? 200 : std::min(decibels(now.at(name), image), 199.0);
    if (left_out == but.end()) {
      EXPECT_GE(db, least) << what << ": " << name << ", " << pixels_off(now.at(name), image, 1e-3)
                           << " pixels are off by more than a thousandth";
    } else {
      EXPECT_LT(db, least) << what << ": " << name << " is the same in spite of "
                           << left_out->second;
    }
  }
}

// [metamorphic_test.cpp: PowersOfTwoChangeNoBit] A row that fails has a length of its own: make it
// relative to the scene, or, where it is among the row's constants, add these to lengths().
TEST(Alternatives, PowersOfTwoChangeNoBit) {
  for (const double s : {0x1p-10, 0x1p10}) {
    expect_same("times " + std::to_string(s),
                render_rows(scaled({make_room(), {}}, s).scene, static_cast<float>(s)), room_rows(),
                200);
  }
}

TEST(Alternatives, DistanceFromTheOriginChangesNoBit) {
  const std::string grid = "its map's texels, which keep to a grid of the world";
  Exceptions maps;
  for (const char* row : {"sun-map", "sun-per-object", "sun-pcf", "sun-pcss", "sun-backprojection",
                          "sun-cascades", "sun-hybrid", "sun-convolution", "sun-vsm", "sun-esm",
                          "sun-evsm", "sun-pcss-vsm", "sun-pcss-convolution"}) {
    maps[row] = grid;
  }
  maps["sun-edges: sun_edges_places"] = grid;  // what is seen is the same
  expect_same("moved by 1e4 m", render_rows(moved(make_room(), {1e4, -1e4, 1e4})), room_rows(), 200,
              maps);
}

TEST(Alternatives, OrderOfMeshesAndTrianglesChangesRoundingOnly) {
  expect_same("triangles reordered", render_rows(reordered(make_room())), room_rows(), 60);
  Scene backwards = make_room();
  std::reverse(backwards.instances.begin(), backwards.instances.end());
  expect_same("instances reversed", render_rows(backwards), room_rows(), 200);
}

// [contained_test.cpp: BrokenMaterialsAreBlackOnes]
TEST(Alternatives, BrokenMaterialsAreBlackOnes) {
  const auto with_metal = [](float v) {
    Scene scene = make_room();
    MaterialConstants& metal = scene.materials[kRoomMetal].constants;
    metal.base_color = glm::vec4(v, v, v, 1);
    metal.emissive = glm::vec3(v);
    metal.metallic = metal.roughness = v;
    return scene;
  };
  const Pictures zero = render_rows(with_metal(0));
  for (const float broken : {kNan, -kInfinity}) {
    expect_same(std::to_string(broken), render_rows(with_metal(broken)), zero, 200);
  }
  EXPECT_EQ(not_finite(render_rows(with_metal(kInfinity))), "");
}

TEST(Alternatives, BrokenLightsAndVerticesStayFinite) {
  Scene lit = make_room();
  lit.lights[0].color = glm::vec3(kNan);
  lit.lights[1].position.x = kInfinity;
  lit.sun->irradiance = glm::vec3(1, kNan, kInfinity);
  lit.sky.zenith = glm::vec3(kInfinity, 0, kNan);
  EXPECT_EQ(not_finite(render_rows(lit)), "") << "lights";
  Scene turned_away = make_room();
  turned_away.sun->direction_to_sun = glm::vec3(kNan);
  EXPECT_EQ(not_finite(render_rows(turned_away)), "") << "the sun's direction";
  Scene bent = make_room();
  for (Mesh& mesh : bent.meshes) {
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
      mesh.vertices[i].normal = glm::vec3(kNan);
      mesh.vertices[i].tangent = glm::vec4(kInfinity);
      if (mesh.name == "card") mesh.vertices[i].uv = glm::vec2(kNan);
    }
  }
  EXPECT_EQ(not_finite(render_rows(bent)), "") << "vertices";
}

}  // namespace
}  // namespace kaamos::test
