// SPDX-License-Identifier: MIT
// Reflections that are found in the picture, against the same rays through the scene.
#include "effects/reflections/screen_space/screen_reflections.h"

#include <gtest/gtest.h>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/reflections/screen_space/screen_fixture.h"
#include "effects/reflections/screen_space/screen_mask.h"

namespace kaamos::effects {
namespace {

constexpr const char* kEmbree = "embree";

struct March {
  const char* effect;
  const char* signal;
  ScreenReflectionConstants constants;
};
const March kPixels = {"ssr", "ssr", march_of_pixels()};
const March kMetres = {"ssr-metres", "ssr_metres", march_of_metres()};
const March kLine = {"ssr-line", "ssr_line", march_of_line()};

March with_sky(March march) {
  march.constants.fallback = ScreenFallback::kSky;
  return march;
}

std::unique_ptr<FrameRenderer> render(const std::string& backend, const Scene& scene,
                                      const March& march) {
  auto renderer = make_screen_renderer(
      backend, scene, march.effect, march.constants,
      [&](EffectSettings& settings) { settings.set_constants(march.constants); });
  renderer->render().value();
  return renderer;
}

HitComparison look(const std::string& backend, const Scene& scene, const March& march) {
  const auto renderer = render(backend, scene, march);
  return compare(*renderer, march.signal, march.constants);
}

class ScreenReflections : public test::OnBackends {};

double part(std::uint64_t of, std::uint64_t all) {
  return static_cast<double>(of) / static_cast<double>(all);
}

// The hits of a march are what the ray hits, but for halos.
TEST_P(ScreenReflections, MostHitsAreWhatTheRaysHit) {
  const HitComparison found = look(GetParam(), make_screen_boxes(), with_sky(kPixels));
  EXPECT_GT(found.confusion.hits(), 100u);
  EXPECT_GT(part(found.confusion.correct(), found.confusion.hits()), 0.85);
  // Nearly all of what the picture shows is found.
  EXPECT_GT(part(found.confusion.correct(), found.confusion.correct() + found.confusion.missed()),
            0.85);
}

TEST(ScreenMarches, StrictHitsLeaveNoDoubt) {
  March strict = with_sky(kPixels);
  strict.constants.strict = 1;
  strict.constants.thickness = 0.02f;
  const HitComparison found = look(kEmbree, make_screen_boxes(), strict);
  EXPECT_GT(found.confusion.hits(), 100u);
  EXPECT_GT(part(found.confusion.correct(), found.confusion.hits()), 0.97);
}

TEST(ScreenMarches, ThickSurfacesHaveHalos) {
  March thin = with_sky(kPixels), thick = thin;
  thin.constants.thickness = 0.05f;
  thick.constants.thickness = 2;
  const std::uint64_t few = look(kEmbree, make_screen_boxes(), thin).confusion.false_hits();
  const std::uint64_t many = look(kEmbree, make_screen_boxes(), thick).confusion.false_hits();
  EXPECT_GT(many, 2 * few);
}

// [GDC 2018 talk]
TEST(ScreenMarches, FewSamplesMissWhatLiesBetweenThem) {
  March line = kLine;
  line.constants.steps = 8;
  const HitConfusion few = look(kEmbree, make_screen_boxes(), line).confusion;
  const HitConfusion all = look(kEmbree, make_screen_boxes(), with_sky(kPixels)).confusion;
  EXPECT_GT(few.missed(), 2 * all.missed());
  March metres = with_sky(kMetres);
  metres.constants.steps = 8;
  metres.constants.step_thickness = 0;
  EXPECT_GT(look(kEmbree, make_screen_boxes(), metres).confusion.missed(), 2 * all.missed());
}

// Where a step is longer than surfaces are thick, most points are too far behind what the ray
// crosses. The place where it does tells. [survey 6.2]
TEST(ScreenMarches, AStepIsRefinedBeforeThicknessIsTested) {
  March metres = with_sky(kMetres);  // steps of 0.3 m
  metres.constants.thickness = 0.02f;
  metres.constants.step_thickness = 0;
  const HitConfusion found = look(kEmbree, make_screen_boxes(), metres).confusion;
  EXPECT_GT(part(found.correct(), found.correct() + found.missed()), 0.75);
  EXPECT_GT(part(found.correct(), found.hits()), 0.95);
  metres.constants.refinements = 0;
  const HitConfusion points = look(kEmbree, make_screen_boxes(), metres).confusion;
  EXPECT_LT(part(points.correct(), points.correct() + points.missed()), 0.3);
}

// A halved step ends in a pixel whose depth is that of its middle: its plane is what the ray hits.
TEST(ScreenMarches, RefinedHitsLieOnThePlanesOfPixels) {
  const HitConfusion found = look(kEmbree, make_mirror_hall(), with_sky(kMetres)).confusion;
  EXPECT_GT(part(found.correct(), found.hits()), 0.65);
  EXPECT_GT(part(found.correct(), found.correct() + found.missed()), 0.8);
}

// Surfaces without any thickness are met by no point; as thick as a step is deep, they are.
TEST(ScreenMarches, SurfacesAreAsThickAsAStepIsDeep) {
  March metres = with_sky(kMetres);
  metres.constants.thickness = 0;
  metres.constants.step_thickness = 0;
  EXPECT_EQ(look(kEmbree, make_screen_boxes(), metres).confusion.hits(), 0u);
  metres.constants.step_thickness = 1;
  for (const std::uint32_t refinements : {0u, 6u}) {
    metres.constants.refinements = refinements;
    const HitConfusion found = look(kEmbree, make_screen_boxes(), metres).confusion;
    EXPECT_GT(part(found.correct(), found.correct() + found.missed()), 0.75) << refinements;
    EXPECT_GT(part(found.correct(), found.hits()), 0.9) << refinements;
  }
}

// Northlight's has no fallback: what is off the picture is missing, and black. [GDC 2018 talk]
TEST(ScreenMarches, WhatThePictureDoesNotShowIsMissing) {
  const auto renderer = render(kEmbree, make_mirror_hall(), kLine);
  const HitComparison found = compare(*renderer, kLine.signal, kLine.constants);
  std::uint64_t outside = 0;
  for (const auto& row : found.confusion.counts) outside += row[kOutside];
  EXPECT_GT(outside, found.confusion.rays() / 12);
  // Half a pixel beyond the border a pixel still shows the same surface.
  EXPECT_LT(found.confusion.right[kOutside], outside / 50);
  EXPECT_EQ(found.confusion.right[kNothing], 0u);
  const FloatImage seen = renderer->read(kLine.signal).value();
  for (std::uint32_t y = 0; y < seen.height; ++y) {
    for (std::uint32_t x = 0; x < seen.width; ++x) {
      if (found.hits.at(x, y, 3) == static_cast<float>(kHit)) continue;
      ASSERT_EQ(seen.at(x, y, 0), 0.0f) << x << ", " << y;
    }
  }
}

// The wall is a mirror, which is black in a frame without reflections.
TEST(ScreenMarches, ThePreviousFrameHasReflectionsItself) {
  Scene scene = make_screen_boxes();
  scene.materials[1] = scene.materials[0];
  March march = with_sky(kPixels);
  const auto of_wall = [&](ScreenSource source) {
    march.constants.source = source;
    const auto renderer = render(kEmbree, scene, march);
    renderer->render().value();
    const HitComparison found = compare(*renderer, march.signal, march.constants);
    const FloatImage seen = renderer->read(march.signal).value();
    double sum = 0;
    for (std::uint32_t y = 0; y < seen.height; ++y) {
      for (std::uint32_t x = 0; x < seen.width; ++x) {
        // The floor shows the wall, which is instance 1.
        if (found.truth.at(x, y, 2) == 2.0f && found.truth.at(x, y, 3) != 0) {
          sum += seen.at(x, y, 0);
        }
      }
    }
    return sum;
  };
  const double now = of_wall(ScreenSource::kCurrentFrame);
  const double before = of_wall(ScreenSource::kPreviousFrame);
  EXPECT_GT(before, 2 * now + 1);
}

// The camera turns away and back: what comes into the picture was not in the one before.
TEST(ScreenMarches, WhatThePreviousFrameDidNotShowIsStale) {
  const Scene scene = make_screen_boxes();
  March march = with_sky(kPixels);
  march.constants.source = ScreenSource::kPreviousFrame;
  const auto renderer = render(kEmbree, scene, march);
  FrameMoment moment;
  moment.camera = scene.cameras.front();
  moment.index = 1;
  const auto stale = [&] {
    renderer->begin_frame(moment).value();
    renderer->render().value();
    const HitComparison found = compare(*renderer, march.signal, march.constants);
    std::uint64_t sum = 0;
    for (const std::uint64_t count : found.confusion.counts[kStale]) sum += count;
    return sum;
  };
  EXPECT_EQ(stale(), 0u) << "the camera stands still";
  moment.index = 2;
  moment.camera.camera_to_world = look_at(glm::dvec3(0, 1.5, 6), glm::dvec3(-9, 0.8, 0));
  stale();
  moment.index = 3;
  moment.camera = scene.cameras.front();
  EXPECT_GT(stale(), 5u);
  moment.index = 4;
  moment.cut = true;
  EXPECT_EQ(stale(), 0u) << "after a cut light is taken from this frame";
}

// Recall 1: the picture is the same with the mask as without it. [survey 6.2]
TEST(ScreenMarches, TheMaskMissesNothing) {
  for (const Scene& scene : {make_screen_boxes(), make_mirror_hall()}) {
    March thick_steps = with_sky(kPixels);
    thick_steps.constants.stride = 3;
    thick_steps.constants.step_thickness = 1;
    for (const March& march : {with_sky(kPixels), thick_steps, with_sky(kMetres), kLine}) {
      const auto plain = render(kEmbree, scene, march);
      ScreenMaskConstants mask;
      mask.screen = march.constants;
      const auto masked =
          make_screen_renderer(kEmbree, scene, "ssr-masked", march.constants,
                               [&](EffectSettings& settings) { settings.set_constants(mask); });
      masked->render().value();
      EXPECT_EQ(masked->read("ssr_masked").value().values, plain->read(march.signal).value().values)
          << scene.name << ", " << march.effect;
      const HitConfusion all = compare(*plain, march.signal, march.constants).confusion;
      const HitConfusion some = compare(*masked, "ssr_masked", march.constants).confusion;
      EXPECT_EQ(some.hits(), all.hits());
      std::uint64_t left_out = 0;
      for (const std::uint64_t count : some.counts[kNotLookedFor]) left_out += count;
      EXPECT_GT(left_out, 0u) << scene.name << ", " << march.effect << ": saves nothing";
    }
  }
}

// Marks of half the resolution miss some of what is found, the less the wider they are, and save
// rays. What is looked for is found as without them. [Wronski 2014]
TEST(ScreenMarches, WiderMarksMissLess) {
  for (const Scene& scene : {make_screen_boxes(), make_mirror_hall()}) {
    const March march = with_sky(kPixels);
    const auto plain = render(kEmbree, scene, march);
    const FloatImage all = plain->read(march.signal).value();
    const std::uint64_t hits = compare(*plain, march.signal, march.constants).confusion.hits();
    std::uint64_t found_before = 0, left_out_before = ~std::uint64_t{0};
    for (const std::uint32_t dilation : {0u, 2u, 8u}) {
      ScreenMaskConstants mask;
      mask.screen = march.constants;
      mask.half_mask = 1;
      mask.dilation = dilation;
      const auto marked =
          make_screen_renderer(kEmbree, scene, "ssr-half-masked", march.constants,
                               [&](EffectSettings& settings) { settings.set_constants(mask); });
      marked->render().value();
      const HitComparison some = compare(*marked, "ssr_half_masked", march.constants);
      const FloatImage own = marked->read("ssr_half_masked").value();
      std::uint64_t left_out = 0;
      for (std::uint32_t y = 0; y < own.height; ++y) {
        for (std::uint32_t x = 0; x < own.width; ++x) {
          if (some.hits.at(x, y, 3) == static_cast<float>(kNotLookedFor)) {
            ++left_out;
          } else {
            ASSERT_EQ(own.at(x, y, 0), all.at(x, y, 0)) << x << ", " << y;
          }
        }
      }
      EXPECT_GE(some.confusion.hits(), found_before);
      EXPECT_LE(left_out, left_out_before);
      if (dilation > 0) {
        EXPECT_GT(part(some.confusion.hits(), hits), 0.97) << scene.name;
      }
      found_before = some.confusion.hits();
      left_out_before = left_out;
    }
  }
}

TEST(ScreenMarches, ExtremesStayFinite) {
  Scene scene = make_screen_boxes();
  scene.cameras.front().camera_to_world = look_at(glm::dvec3(0, 0.02, 6), glm::dvec3(0, 0.02, 0));
  for (const float thickness : {0.0f, 1e30f, -1.0f}) {
    for (March march : {with_sky(kPixels), with_sky(kMetres), kLine}) {
      march.constants.thickness = thickness;
      const auto renderer = render(kEmbree, scene, march);
      for (const float value : renderer->read(march.signal).value().values) {
        ASSERT_TRUE(std::isfinite(value)) << march.effect << ", " << thickness;
      }
    }
  }
  const auto one = make_screen_renderer(
      kEmbree, scene, "ssr", march_of_pixels(), [](EffectSettings&) {}, 1, 1);
  one->render().value();
  for (const float value : one->read("ssr").value().values) ASSERT_TRUE(std::isfinite(value));
}

TEST(ScreenReflectionSettings, WrongOnesAreRefused) {
  ScreenReflectionConstants constants;
  EXPECT_TRUE(check_screen_reflections(constants).ok());
  constants.steps = 0;
  EXPECT_NE(check_screen_reflections(constants).error().message.find("KA3071"), std::string::npos);
  constants = {};
  constants.stride = 0.5f;
  EXPECT_FALSE(check_screen_reflections(constants).ok());
  constants = {};
  constants.refinements = 33;
  EXPECT_FALSE(check_screen_reflections(constants).ok());
  constants = {};
  constants.march = static_cast<ScreenMarch>(3);
  EXPECT_FALSE(check_screen_reflections(constants).ok());
}

INSTANTIATE_TEST_SUITE_P(Backends, ScreenReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
