// SPDX-License-Identifier: MIT
//
// northlight --measure, --split and --reference on small pictures: the tables must be readable, and
// the errors must behave as theory says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/assets/common/file.h"
#include "effects/assets/image/csv.h"
#include "effects/assets/image/exr.h"
#include "effects/assets/image/png.h"
#include "effects/assets/image/tonemap.h"
#include "effects/northlight/effects.h"

namespace {

namespace fs = std::filesystem;
using namespace kaamos::effects;

using Row = std::map<std::string, std::string>;

// One folder for each test, because tests may run at the same time.
std::string folder() {
  return std::string(KAAMOS_BINARY_DIR) + "/pictures/" +
         testing::UnitTest::GetInstance()->current_test_info()->name();
}

int northlight(const std::string& arguments) {
  fs::create_directories(folder());
  return std::system((std::string(KAAMOS_BINARY_DIR) +
                      "/bin/northlight --gi-cell 1 --gi-bake-samples 8 --out " + folder() + " " +
                      arguments + " > " + folder() + "/log 2>&1")
                         .c_str());
}

std::string text_of(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes.ok()) return bytes.error().message;
  return std::string(bytes.value().begin(), bytes.value().end());
}

double number(const Row& row, const std::string& column) {
  return std::strtod(row.at(column).c_str(), nullptr);
}

// The path-traced truth takes most of the time, and few tests look at it.
std::vector<Row> measure(const std::string& effect, const std::string& more = "",
                         const std::string& runs = "--repeats 3 --measure-truth 0") {
  std::vector<Row> out;
  const int code = northlight("--measure " + effect + " --size 48x27 --measure-reference 512 " +
                              runs + " " + more);
  EXPECT_EQ(code, 0) << text_of(folder() + "/log");
  const auto table = parse_csv(text_of(folder() + "/measure-" + effect + ".csv"));
  EXPECT_TRUE(table.ok()) << table.error().message;
  if (code != 0 || !table.ok()) return out;
  const std::string svg = text_of(folder() + "/measure-" + effect + ".svg");
  EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  for (const auto& cells : table.value().rows) {
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[table.value().columns[i]] = cells[i];
    EXPECT_GT(number(row, "ms"), 0) << row["setting"];
    EXPECT_LE(number(row, "ms_min"), number(row, "ms")) << row["setting"];
    EXPECT_EQ(row["not_finite"], "0") << row["setting"];
    EXPECT_TRUE(std::isfinite(number(row, "rmse"))) << row["setting"];
    EXPECT_LE(number(row, "ssim"), 1) << row["setting"];
    out.push_back(row);
  }
  return out;
}

std::vector<Row> group(const std::vector<Row>& rows, const std::string& part) {
  std::vector<Row> out;
  for (const Row& row : rows) {
    if (row.at("group").find(part) != std::string::npos) out.push_back(row);
  }
  EXPECT_GE(out.size(), 2u) << part;
  return out;
}

const Row& setting(const std::vector<Row>& rows, const std::string& name) {
  for (const Row& row : rows) {
    if (row.at("setting") == name) return row;
  }
  ADD_FAILURE() << "no setting " << name;
  static const Row none{
      {"rmse", "nan"}, {"energy_ratio", "nan"}, {"variance", "nan"}, {"bias_squared", "nan"}};
  return none;
}

// The exponent of the error as a function of rays: -1/2 for random samples, down to -1 and below
// for well-spread ones.
void expect_convergence(const std::vector<Row>& rows) {
  ASSERT_GE(rows.size(), 2u);
  const double rays = number(rows.back(), "rays") / number(rows.front(), "rays");
  const double slope =
      std::log(number(rows.back(), "rmse") / number(rows.front(), "rmse")) / std::log(rays);
  EXPECT_LT(slope, -0.4);
  EXPECT_GT(slope, -1.2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_LT(number(rows[i], "reference_rmse"), number(rows[i], "rmse")) << i;
    if (i > 0) {
      EXPECT_LT(number(rows[i], "rmse"), number(rows[i - 1], "rmse")) << i;
    }
    EXPECT_NEAR(number(rows[i], "energy_ratio"), 1, 0.2) << i;
    // Without bias, the error is all variance.
    const double variance = number(rows[i], "variance");
    EXPECT_LT(std::abs(number(rows[i], "bias_squared")), 0.5 * variance + 1e-6) << i;
  }
}

TEST(Measure, AmbientOcclusionConverges) {
  const auto rows = measure("ao");
  expect_convergence(group(rows, "rays per pixel"));
  // The reference is read from its file this time, and the same seeds give the same errors.
  const auto again = measure("ao");
  ASSERT_EQ(rows.size(), again.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("rmse"), again[i].at("rmse"));
    EXPECT_EQ(rows[i].at("flip"), again[i].at("flip"));
  }
}

TEST(Measure, SunConverges) {
  expect_convergence(group(measure("sun"), "rays per pixel"));
}

TEST(Measure, ContactShadowsConvergeAndLongRaysSeeMore) {
  const auto rows = measure("contact");
  expect_convergence(group(rows, "rays of 1 m"));
  const auto lengths = group(rows, "by length");
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    EXPECT_LE(number(lengths[i], "energy_ratio"), number(lengths[i - 1], "energy_ratio"));
    EXPECT_GE(number(lengths[i], "energy_ratio"), 0.98);
  }
  ASSERT_FALSE(lengths.empty());
  EXPECT_LT(number(lengths.back(), "rmse"), number(lengths.front(), "rmse"));
}

TEST(Measure, ReflectionsConvergeAndClampsTakeEnergy) {
  const auto rows = measure("reflections");
  expect_convergence(group(rows, "rays per pixel"));
  // Everything mirrors a wall that is 70 times as bright as white.
  const auto choices =
      group(measure("reflections", "--scene mirror-hall --material \"far wall:emission=200\""),
            "fireflies");
  const auto energy = [&](const std::string& name) {
    return number(setting(choices, name), "energy_ratio");
  };
  EXPECT_NEAR(energy("traced again by a pilot"), energy("kept"), 0.02);
  EXPECT_LT(energy("clamped to 10 x white"), 0.9 * energy("kept"));
  EXPECT_LE(energy("clamped to 2 x white"), energy("clamped to 10 x white"));
  EXPECT_LE(energy("clamped to 10 x white"), energy("clamped to 50 x white"));
}

TEST(Measure, GlassGetsExactWithItsLayers) {
  const auto rows = group(measure("transparent"), "layers that reflect");
  EXPECT_EQ(number(setting(rows, "8 layers"), "rmse"), 0);
  EXPECT_GT(number(setting(rows, "0 layers"), "rmse"), number(setting(rows, "1 layer"), "rmse"));
  EXPECT_GT(number(setting(rows, "1 layer"), "rmse"), number(setting(rows, "3 layers"), "rmse"));
  EXPECT_GT(number(setting(rows, "3 layers"), "rmse"), 0);
}

TEST(Measure, IndirectLightConvergesAndLitHitsRestoreEnergy) {
  const auto rows = measure("gi");
  expect_convergence(group(rows, "rays per pixel"));
  const auto modes = group(rows, "modes");
  EXPECT_LT(number(setting(modes, "hit = black, 16 rays"), "energy_ratio"),
            number(setting(modes, "near-field, 16 rays"), "energy_ratio"));
  EXPECT_LT(number(setting(modes, "the same x AO of 16 rays"), "energy_ratio"),
            number(setting(modes, "volume at the surface"), "energy_ratio"));
}

// The truth shares no code with the effects: rays to the sun and about a surface agree with it,
// shadow maps let light past things.
TEST(Measure, TruthIsBesideTheEffectsOwnReference) {
  const std::string with_truth = "--repeats 3 --measure-truth 64";
  for (const std::string effect : {"ao", "sun"}) {
    for (const Row& row : measure(effect, "", with_truth)) {
      if (number(row, "rays") < 16) continue;
      EXPECT_NEAR(number(row, "truth_energy_ratio"), 1, 0.02) << effect << row.at("setting");
      EXPECT_LT(number(row, "truth_bias_squared"), 2e-4) << effect << row.at("setting");
    }
  }
  const auto lengths = group(measure("contact", "", with_truth), "by length");
  EXPECT_GT(number(lengths.front(), "truth_energy_ratio"),
            number(lengths.back(), "truth_energy_ratio") + 0.05);
  EXPECT_NEAR(number(lengths.back(), "truth_energy_ratio"), 1, 0.1);
}

// This small a picture with this coarse a volume proves the table alone: how close the frame is to
// the truth is held by tests/numerics/truth_test.cpp.
TEST(Measure, FrameAndItsPartsAgainstTheTruth) {
  const auto rows = measure("frame", "", "--repeats 1 --measure-truth 32");
  for (const std::string part : {"direct", "indirect", "reflection", "whole"}) {
    for (const std::string place : {"first frame", "eighth frame, still", "eighth frame, moving"}) {
      int methods = 0;
      for (const Row& row : rows) {
        if (row.at("group") != part + ", " + place) continue;
        ++methods;
        EXPECT_NEAR(number(row, "energy_ratio"), 1, 0.5) << part << " " << row.at("setting");
      }
      EXPECT_EQ(methods, 6) << part << " " << place;
    }
  }
  EXPECT_LT(number(setting(group(rows, "indirect, eighth frame, still"), "svgf"), "rmse"),
            number(setting(group(rows, "indirect, eighth frame, still"), "raw"), "rmse"));
}

TEST(Measure, DenoisersTradeVarianceForBias) {
  const auto rows = measure("svgf", "--effects ao,gi --seeds 4 --camera-path orbit");
  for (const std::string signal : {"ao", "indirect"}) {
    const auto first = group(rows, signal + ", still, frame 1");
    const auto last = group(rows, signal + ", still, frame 8");
    const Row raw = setting(first, "raw");
    EXPECT_LT(number(setting(first, "gaussian"), "variance"), 0.5 * number(raw, "variance"));
    EXPECT_GT(number(setting(first, "gaussian"), "bias_squared"), 0);
    EXPECT_LT(number(setting(first, "svgf"), "variance"), 0.7 * number(raw, "variance"));
    EXPECT_LT(number(setting(last, "svgf"), "variance"),
              number(setting(first, "svgf"), "variance"));
    for (const std::string at : {", still, frame 1", ", still, frame 8", ", orbit, frame 8"}) {
      const auto frame = group(rows, signal + at);
      for (const std::string method : {"temporal", "svgf", "control"}) {
        EXPECT_LT(number(setting(frame, method), "rmse"),
                  number(setting(frame, "raw"), "rmse") + 0.002)
            << signal << at << " " << method;
      }
    }
  }
}

// Every effect with passes of its own, those without a plan of their own too.
class MeasureEach : public testing::TestWithParam<std::string> {};

TEST_P(MeasureEach, WritesFiniteNumbers) {
  const std::string effect = GetParam();
  const Effect& row = *find_effect(northlight_effects(), effect);
  // The lounge has no particles.
  // A bake of all the lounge's surfaces would take a third of this suite's time.
  const std::string scene = row.needs.particles    ? " --scene sparks"
                            : effect == "baked-ao" ? " --scene matched-box"
                                                   : "";
  ASSERT_EQ(northlight("--measure " + effect + scene +
                       " --size 24x14 --quick --repeats 1 --measure-reference 16 "
                       "--measure-truth 4"),
            0)
      << text_of(folder() + "/log");
  const auto table = parse_csv(text_of(folder() + "/measure-" + effect + ".csv"));
  ASSERT_TRUE(table.ok()) << table.error().message;
  ASSERT_FALSE(table.value().rows.empty());
  std::map<std::string, int> in_group;
  for (const auto& cells : table.value().rows) {
    Row measured;
    for (std::size_t i = 0; i < cells.size(); ++i) measured[table.value().columns[i]] = cells[i];
    EXPECT_LE(++in_group[measured["group"]], 3);
    for (const std::string column : {"ms", "rmse", "ssim", "flip", "energy_ratio"}) {
      EXPECT_TRUE(std::isfinite(number(measured, column))) << column << measured["setting"];
    }
    EXPECT_GT(number(measured, "energy_ratio"), 0) << measured["setting"];
    EXPECT_EQ(measured["not_finite"], "0") << measured["setting"];
    if (row.alternative_to.empty() || row.alternative_to == "transparent") continue;
    EXPECT_EQ(measured["reference"].rfind(row.alternative_to, 0), 0u) << measured["reference"];
  }
}

std::vector<std::string> effects_with_passes() {
  std::vector<std::string> out;
  for (const Effect& row : northlight_effects()) {
    // Filtered maps of 4096 x 4096 texels take half a minute each.
    if (row.library.file.find("filtered_shadow_map") != std::string::npos) continue;
    if (row.pass || row.make) out.push_back(row.name);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(, MeasureEach, testing::ValuesIn(effects_with_passes()),
                         [](const auto& effect) {
                           std::string name = effect.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Split, PutsSettingsSideBySide) {
  for (const std::string name : {"ao", "gi", "near-field", "denoise"}) {
    ASSERT_EQ(northlight("--size 48x27 --split " + name), 0) << text_of(folder() + "/log");
    const auto picture = read_png(folder() + "/split-" + name + ".png");
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture.value().width, 48u);
    EXPECT_EQ(picture.value().height, 27u);
    // A white line from top to bottom, at a third or in the middle.
    const std::uint32_t line = name == "ao" ? 16 : 24;
    for (std::uint32_t y = 0; y < 27; ++y) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        ASSERT_EQ(picture.value().values[(y * 48 + line) * 4 + c], 255) << name;
      }
    }
  }
}

// Each step shows the same strip of the same frame, so that light only adds up.
TEST(Split, LightingAddsAStepAtATime) {
  ASSERT_EQ(northlight("--size 192x54 --split lighting"), 0) << text_of(folder() + "/log");
  const auto picture = read_png(folder() + "/split-lighting.png");
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const ByteImage& image = picture.value();
  const auto value = [&](std::size_t step, std::size_t x, std::size_t y) {
    return static_cast<int>(image.values[(y * 192 + step * 48 + x) * image.channels + 1]);
  };
  double mean[4] = {}, grain[4] = {};
  int darker = 0;  // pixels in which indirect light takes light away
  for (std::size_t y = 0; y < 54; ++y) {
    for (std::size_t x = 2; x < 48; ++x) {  // past the line between steps
      for (std::size_t step = 0; step < 4; ++step) {
        mean[step] += value(step, x, y) / (54.0 * 46.0);
        grain[step] += std::abs(value(step, x, y) - value(step, x - 1, y)) / (54.0 * 46.0);
      }
      darker += value(1, x, y) < value(0, x, y) ? 1 : 0;
    }
  }
  EXPECT_EQ(darker, 0);
  EXPECT_GT(mean[1], mean[0] + 4);
  EXPECT_GT(mean[2], mean[1] + 0.5);
  EXPECT_NEAR(mean[3], mean[2], 0.1 * mean[2]);
  EXPECT_LT(grain[3], 0.8 * grain[2]);
}

// Rays are as long as the options say, and a layer of light is written as the frame shows light.
TEST(Options, ReachReflectionsAndTheirPicture) {
  const std::string arguments = "--scene mirror-hall --size 48x27 --effects reflections ";
  const auto longest = [&](const std::string& more) {
    EXPECT_EQ(northlight(arguments + more), 0) << text_of(folder() + "/log");
    const auto file = read_exr(folder() + "/frame.exr");
    const ExrLayer* layer = find_layer(file.value(), "reflection");
    float out = 0;
    for (std::size_t i = 3; i < layer->image.values.size(); i += 4) {
      out = std::max(out, layer->image.values[i]);
    }
    return out;
  };
  EXPECT_GT(longest(""), 3.5f);
  EXPECT_LE(longest("--reflection-length 2.5 --reflection-length-rough 1 --fireflies keep"), 2.5f);
  const auto file = read_exr(folder() + "/frame.exr");
  const ExrLayer* layer = find_layer(file.value(), "reflection");
  FloatImage light(48, 27, 3);
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    light.values[i] = layer->image.values[i / 3 * 4 + i % 3];
  }
  const auto picture = read_png(folder() + "/reflection.png");
  ASSERT_TRUE(picture.ok());
  const ByteImage expected = tonemap(light, make_mirror_hall().exposure);
  for (std::size_t pixel = 0; pixel < 48u * 27u; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(picture.value().values[pixel * picture.value().channels + c],
                  expected.values[pixel * 3 + c], 2);
    }
  }
}

TEST(Reference, IsALayerOfEachEffect) {
  ASSERT_EQ(northlight("--size 48x27 --effects all,ao --reference 32"), 0)
      << text_of(folder() + "/log");
  const auto file = read_exr(folder() + "/frame.exr");
  ASSERT_TRUE(file.ok()) << file.error().message;
  for (const std::string name : {"ao", "sun", "contact", "indirect", "reflection"}) {
    const ExrLayer* layers[3] = {find_layer(file.value(), name),
                                 find_layer(file.value(), name + "_denoised"),
                                 find_layer(file.value(), name + "_reference")};
    ASSERT_TRUE(layers[0] != nullptr && layers[1] != nullptr && layers[2] != nullptr) << name;
    double difference = 0;
    for (std::uint32_t y = 0; y < 27; ++y) {
      for (std::uint32_t x = 0; x < 48; ++x) {
        difference += std::abs(layers[0]->image.at(x, y) - layers[2]->image.at(x, y));
      }
    }
    EXPECT_GT(difference, 0) << name << ": a reference has other samples";
  }
  EXPECT_NE(find_layer(file.value(), "radiance_reference"), nullptr);
}

}  // namespace
