// SPDX-License-Identifier: MIT
//
// Compares rays, effects and examples on Vulkan with the same on Embree.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/image/png.h"
#include "effects/assets/image/tonemap.h"
#include "tests/parity/frames.h"
#include "tests/parity/pictures.h"
#include "tests/parity/rays.h"
#include "tests/vulkan/support.h"

namespace kaamos::parity {
// Lets gtest print parameters.
static void PrintTo(const RaySet& set, std::ostream* out) {
  *out << set.scene << " " << set.kind;
}
}  // namespace kaamos::parity

namespace {

namespace fs = std::filesystem;
using namespace kaamos::effects;
using namespace kaamos::parity;

const std::string kBackends[2] = {"embree", "vulkan"};

std::string name_of(std::string text) {
  for (char& c : text) {
    if (c == '-' || c == ' ') c = '_';
  }
  return text;
}

class VulkanRays : public testing::TestWithParam<RaySet> {};

TEST_P(VulkanRays, FindWhatEmbreeFinds) {
  KAAMOS_NEED_VULKAN();
  RaySet set = GetParam();
  HitLimits limits;
  if (const char* full = std::getenv("KAAMOS_FULL"); full != nullptr && *full == '1') {
    set.width = 1600;
    set.height = 900;
    limits.visibility = 1e-5;
  }
  const RayRun run = trace_on_both(set, kBackends);
  ASSERT_GT(run.rays.size(), 1000u);
  const HitDifference difference =
      compare_hits(run.hits[0], run.hits[1], run.picture_width, limits);
  EXPECT_GT(difference.hits, difference.rays / 50);
  EXPECT_EQ(judge(difference), "")
      << describe(difference) << "\nworst:\n  " << difference.worst_text << "\n  "
      << retrace_command(set, difference.worst_ray);
  RecordProperty("difference", describe(difference));
}

INSTANTIATE_TEST_SUITE_P(Sets, VulkanRays,
                         testing::Values(RaySet{"lounge", "primary"}, RaySet{"lounge", "flags"},
                                         RaySet{"lounge", "sun"}, RaySet{"lounge", "ao"},
                                         RaySet{"lounge", "diffuse"}, RaySet{"mixed", "primary"},
                                         RaySet{"mixed", "flags"}, RaySet{"mixed", "diffuse"}),
                         [](const auto& tested) {
                           return tested.param.scene + "_" + tested.param.kind;
                         });

// Shaders' own counts must match the statistics. How often a traversal calls any-hit and
// intersection shaders is up to the traversal.
TEST(VulkanStatistics, CountWhatRan) {
  KAAMOS_NEED_VULKAN();
  for (const std::string& backend : kBackends) {
    Probe probe(backend);
    std::vector<ProbeRay> rays(4096);
    for (size_t i = 0; i < rays.size(); ++i) {
      rays[i].origin[0] = static_cast<float>(i % 64) / 4 - 8;
      rays[i].origin[1] = static_cast<float>(i / 64) / 4 - 8;
      rays[i].origin[2] = -20;
    }
    uint64_t hits = 0;
    for (const HitRecord& hit : probe.trace(rays, 64)) hits += hit.hit;
    const auto statistics = probe.device().GetStatistics();
    EXPECT_GT(hits, 100u) << backend;
    EXPECT_EQ(statistics.TraceRayCalls, rays.size()) << backend;
    EXPECT_EQ(statistics.VisibilityRays, 0u) << backend;
    EXPECT_EQ(statistics.Hits, hits) << backend;
    EXPECT_EQ(statistics.Misses, rays.size() - hits) << backend;
    EXPECT_EQ(statistics.ClosestHitInvocations, hits) << backend;
    EXPECT_EQ(statistics.MissInvocations, rays.size() - hits) << backend;
    EXPECT_GT(statistics.AnyHitInvocations, 0u) << backend;
    EXPECT_GT(statistics.IntersectionInvocations, 0u) << backend;
    EXPECT_EQ(statistics.CallableInvocations, 0u) << backend;
    rays.resize(64);
    for (ProbeRay& ray : rays) ray.flags = 0xC;  // accept the first hit, no closest-hit shader
    rtapi::Device(probe.device()).ResetStatistics();
    probe.trace(rays, 64);
    EXPECT_EQ(probe.device().GetStatistics().VisibilityRays, 64u) << backend;
    EXPECT_EQ(probe.device().GetStatistics().ClosestHitInvocations, 0u) << backend;
  }
}

struct NamedScene {
  const char* name;
  Scene (*make)();
};

// Lets gtest print parameters.
void PrintTo(const NamedScene& scene, std::ostream* out) {
  *out << scene.name;
}

class VulkanEffects : public testing::TestWithParam<NamedScene> {
 protected:
  static std::string where(uint32_t x, uint32_t y) {
    return std::string("worst pixel (") + std::to_string(x) + ", " + std::to_string(y) +
           "): northlight --backend vulkan --size 320x180 --seed 3 --ao-samples 4 --sun-samples 4 "
           "--pixel " +
           std::to_string(x) + "," + std::to_string(y);
  }
};

// The triangle that each pixel sees. VulkanRays compares distances.
std::vector<HitRecord> hits_of(const std::map<FrameTexture, FloatImage>& frame) {
  const FloatImage& ids = frame.at(kIds);
  const FloatImage& depth = frame.at(kViewZ);
  std::vector<HitRecord> hits(size_t{ids.width} * ids.height);
  for (uint32_t y = 0; y < ids.height; ++y) {
    for (uint32_t x = 0; x < ids.width; ++x) {
      HitRecord& hit = hits[size_t{y} * ids.width + x];
      hit.hit = ids.at(x, y, 0) > 0;
      if (hit.hit == 0) continue;
      hit.instance_index = static_cast<uint32_t>(ids.at(x, y, 0));
      hit.primitive = static_cast<uint32_t>(ids.at(x, y, 1));
      hit.t = depth.at(x, y, 0);
    }
  }
  return hits;
}

// Decoded from octahedral form, in which vectors that are close together may be far apart.
FloatImage decoded_normals(const FloatImage& encoded) {
  FloatImage out(encoded.width, encoded.height, 3);
  for (uint32_t y = 0; y < encoded.height; ++y) {
    for (uint32_t x = 0; x < encoded.width; ++x) {
      const float u = encoded.at(x, y, 0);
      const float v = encoded.at(x, y, 1);
      float n[3] = {u, v, 1 - std::abs(u) - std::abs(v)};
      if (n[2] < 0) {
        n[0] = (1 - std::abs(v)) * (u >= 0 ? 1.0f : -1.0f);
        n[1] = (1 - std::abs(u)) * (v >= 0 ? 1.0f : -1.0f);
      }
      const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (uint32_t c = 0; c < 3; ++c) out.at(x, y, c) = n[c] / length;
    }
  }
  return out;
}

TEST_P(VulkanEffects, DrawWhatEmbreeDraws) {
  KAAMOS_NEED_VULKAN();
  const Scene scene = GetParam().make();
  RenderedFrame frames[2];
  FrameRun run;
  for (int i = 0; i < 2; ++i) {
    run.backend = kBackends[i];
    frames[i] = render_frame(scene, run);
  }
  const HitDifference seen =
      compare_hits(hits_of(frames[0].pictures), hits_of(frames[1].pictures), run.width);
  EXPECT_EQ(judge(seen), "") << "ids: " << describe(seen) << "\n"
                             << where(static_cast<uint32_t>(seen.worst_ray % run.width),
                                      static_cast<uint32_t>(seen.worst_ray / run.width));

  const FloatImage& ids_a = frames[0].pictures.at(kIds);
  const FloatImage& ids_b = frames[1].pictures.at(kIds);
  const auto pixels = static_cast<double>(run.width) * run.height;
  struct Layer {
    FrameTexture texture;
    const char* name;
    double allowed;
  };
  // One 8-bit step where the picture has 8 bits: decoding sRGB may be off by half a step [D3D11.3:
  // 3.2.3.6], which decides how the other half is rounded.
  constexpr double kStep = 1.01 / 255;
  const Layer layers[] = {
      {kDepth, "depth", 1e-4},           {kViewZ, "view z", 1e-4},
      {kNormal, "normal", 1e-3},         {kPosition, "position", 1e-4},
      {kBaseColor, "base color", kStep}, {kEmissive, "emissive", 2e-3},
      {kMaterial, "material", kStep},    {kShadingNormal, "shading normal", 2e-3}};
  for (const Layer& layer : layers) {
    const bool is_normal = layer.texture == kNormal || layer.texture == kShadingNormal;
    const auto values = [&](int i) {
      const FloatImage& image = frames[i].pictures.at(layer.texture);
      return is_normal ? decoded_normals(image) : image;
    };
    const LayerDifference difference =
        compare_layers(values(0), values(1), ids_a, ids_b, layer.allowed);
    // Grazing hits differ by more, but they are rare.
    EXPECT_LE(static_cast<double>(difference.above), 1e-3 * pixels)
        << layer.name << ": by up to " << difference.worst << ", "
        << where(difference.worst_x, difference.worst_y);
  }
  for (const auto& [signal, name] :
       {std::pair("ao", "ambient occlusion"), std::pair("sun", "sun shadow")}) {
    if (frames[0].sums.count(signal) == 0) continue;
    const SumDifference difference = compare_sums(
        frames[0].sums.at(signal), frames[1].sums.at(signal), ids_a, ids_b, run.samples);
    EXPECT_EQ(judge(difference), "") << name << ": " << describe(difference) << "\n"
                                     << where(difference.worst_x, difference.worst_y);
  }
  const PictureDifference picture =
      compare_pictures(floats(tonemap(frames[0].pictures.at(kRadiance), scene.exposure)),
                       floats(tonemap(frames[1].pictures.at(kRadiance), scene.exposure)));
  EXPECT_EQ(judge(picture), "") << "frame: " << describe(picture) << "\n"
                                << where(picture.worst_x, picture.worst_y);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, VulkanEffects,
    testing::Values(NamedScene{"lounge", make_lounge},
                    NamedScene{"sphere", [] { return make_sphere_oracle(1.0, 1.5); }},
                    NamedScene{"wall", [] { return make_wall_oracle(2.0); }},
                    NamedScene{"penumbra", [] { return make_penumbra_oracle(2.0, 0.05); }}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(VulkanGlass, DrawsWhatEmbreeDraws) {
  KAAMOS_NEED_VULKAN();
  const Scene scene = make_glass_stack({.thick = true});
  // One layer on its own with its mirrored ray, and the rest blended, so that every shader runs.
  GlassRun seen[2];
  FrameRun run;
  run.width = 96;
  run.height = 54;
  for (int i = 0; i < 2; ++i) {
    run.backend = kBackends[i];
    seen[i] = render_glass(scene, run, deck_layers(1));
  }
  const LayerDifference coverage =
      compare_layers(seen[0].coverage, seen[1].coverage, seen[0].ids, seen[1].ids, 1e-5);
  EXPECT_LE(static_cast<double>(coverage.above), 5e-3 * run.width * run.height)
      << "by up to " << coverage.worst << " at " << coverage.worst_x << "," << coverage.worst_y;
  const PictureDifference picture =
      compare_pictures(floats(tonemap(seen[0].whole, scene.exposure)),
                       floats(tonemap(seen[1].whole, scene.exposure)));
  EXPECT_EQ(judge(picture), "") << describe(picture);
}

class VulkanExamples : public testing::TestWithParam<const char*> {};

TEST_P(VulkanExamples, DrawWhatEmbreeDraws) {
  KAAMOS_NEED_VULKAN();
  const std::string name = GetParam();
  if (const std::string why = kaamos::test::why_driver_cannot_compile(name); !why.empty()) {
    GTEST_SKIP() << why;
  }
  const fs::path folder = fs::path(KAAMOS_BINARY_DIR) / "parity";
  fs::create_directories(folder);
  const std::string program = std::string(KAAMOS_BINARY_DIR) + "/bin/" + name;
  FloatImage pictures[2];
  for (int i = 0; i < 2; ++i) {
    const std::string file = (folder / (name + "-" + kBackends[i] + ".png")).string();
    const std::string command =
        program + " --backend " + kBackends[i] + " --size 320x180 --out " + file + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    const auto picture = read_png(file);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    pictures[i] = floats(picture.value());
  }
  const PictureDifference difference = compare_pictures(pictures[0], pictures[1]);
  EXPECT_EQ(judge(difference), "") << describe(difference) << "\n"
                                   << name << " --backend vulkan --size 320x180 --pixel "
                                   << difference.worst_x << "," << difference.worst_y;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, VulkanExamples,
    testing::Values("00-raygen-only", "01-triangle", "02-instances-and-masks", "03-any-hit-alpha",
                    "04-procedural-spheres", "05-callable-and-recursion", "06-local-root-signature",
                    "07-update-and-compaction", "08-compute", "09-ray-query", "11-triangle-raster",
                    "12-shadow-map", "13-hybrid", "14-reordering", "15-opacity-micromaps",
                    "16-partitioned-top-level", "17-clusters", "18-cluster-detail"),
    [](const auto& tested) { return name_of(tested.param); });

// The largest error of reads between two texels, measured in a process of its own: the driver reads
// its settings once per process, and a child would inherit what this process set.
double sampling_error(const std::string& environment) {
  const std::string command = "env -u GALLIVM_PERF " + environment +
                              " " KAAMOS_BINARY_DIR "/bin/kaamos-parity --sampled 1000";
  FILE* pipe = popen(command.c_str(), "r");
  double error = NAN;
  if (pipe == nullptr || std::fscanf(pipe, "%lf", &error) != 1) error = NAN;
  if (pipe != nullptr) pclose(pipe);
  return error;
}

TEST(VulkanFilters, AreAsExactAsEmbrees) {
  KAAMOS_NEED_VULKAN();
  EXPECT_LT(sampling_error(""), 1e-4);
}

// Workaround FILTER. A driver that fixes this may go below.
TEST(VulkanFilters, HaveEightBitsWithoutTheWorkaround) {
  KAAMOS_NEED_VULKAN();
  const double error = sampling_error("KAAMOS_VULKAN_DISABLE_WORKAROUNDS=FILTER");
  EXPECT_GT(error, 1e-3);
  EXPECT_LT(error, 1e-2);
}

// The whole program, including its files.
TEST(VulkanNorthlight, DrawsWhatEmbreeDraws) {
  KAAMOS_NEED_VULKAN();
  ByteImage pictures[2];
  for (int i = 0; i < 2; ++i) {
    const std::string folder =
        std::string(KAAMOS_BINARY_DIR) + "/parity/northlight-" + kBackends[i];
    const std::string command = std::string(KAAMOS_BINARY_DIR) + "/bin/northlight --backend " +
                                kBackends[i] + " --size 320x180 --out " + folder + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    const auto picture = read_png(folder + "/frame.png");
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    pictures[i] = picture.value();
  }
  const PictureDifference difference = compare_pictures(floats(pictures[0]), floats(pictures[1]));
  EXPECT_EQ(judge(difference), "")
      << describe(difference) << "\nnorthlight --backend vulkan --size 320x180 --pixel "
      << difference.worst_x << "," << difference.worst_y;
}

}  // namespace
