// SPDX-License-Identifier: MIT
// Samplers of the reference: directions are spread as their densities say (chi-square tests), and
// the densities are those of the equations.
#include <gtest/gtest.h>
#include <rtapi/upload.h>
#include <shaders/path_samples.h>

#include <cstring>
#include <functional>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/reference/host_bsdf_fixture.h"
#include "effects/reference/path_emitters.h"
#include "effects/reference/path_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kSamples = 1 << 18;
constexpr int kRows = 16, kColumns = 16;

// Mirrors SampleConstants of path_samples.hlsl.
struct SampleWords {
  std::uint32_t kind = 0;
  std::uint32_t count = kSamples;
  std::uint32_t seed = 1;
  float base = 0.5f;
  float metallic = 0;
  float roughness = 0.5f;
  float cosine_view = 0.7f;
  float size = 0;
};
enum Kind : std::uint32_t { kMaterial, kFacets, kCone, kSky, kEmitters };

class PathSamplers : public OnBackends {
 protected:
  void SetUp() override {
    OnBackends::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    scene_ = empty_scene(glm::vec3(0.2f), {0, 0, 0}, {0, 0, -1}, 1);
    scene_.sky.zenith = glm::vec3(3.0f);
    scene_.sky.horizon = glm::vec3(0.5f);
    const std::uint32_t dim = add_material(scene_, glm::vec3(0), 0, 1, glm::vec3(1.0f));
    const std::uint32_t bright = add_material(scene_, glm::vec3(0), 0, 1, glm::vec3(4.0f));
    add_thing(scene_, "panel", patch({-1, -1, -2}, {2, 0, 0}, {0, 2, 0.5}, 2, 2), dim);
    add_thing(scene_, "other", patch({1, 0.5, 1}, {0, 1, 0.3}, {0.4, 0, 1}, 1, 1), bright);
    rtapi::DeviceDesc desc;
    desc.Backend = GetParam();
    device_ = test::device_for(desc);
    FrameSettings settings;
    settings.width = settings.height = 8;
    settings.whole_frame = false;
    renderer_ = FrameRenderer::create(device_, scene_, settings).value();
    views_ = renderer_->frame().create_pass_views(device_).value();
    const std::vector<InstanceState> states = evaluate_instances(scene_, 0);
    emitters_ = find_emitters(scene_, states, glm::dvec3(0));
    bind(0, specular_albedo_table());
    bind(1, emitters_.triangles);
    bind(2, emitters_.densities);
    bind(3, emitters_.instances);
    bind(4, sky_bands(scene_.sky));
    for (rtapi::Buffer& result : results_) {
      rtapi::BufferDesc buffer;
      buffer.SizeInBytes = kSamples * sizeof(glm::vec4);
      buffer.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
      buffer.InitialState = rtapi::ResourceStates::kUnorderedAccess;
      result = device_.CreateBuffer(buffer).value();
    }
    for (std::uint32_t u = 0; u < 2; ++u) {
      views_.set_unordered_access(u, results_[u], sizeof(glm::vec4)).value();
    }
    library_ = rtapi::LoadShaderLibrary(kaamos_shaders_path_samples()).value();
  }

  template <class T>
  void bind(std::uint32_t t, const std::vector<T>& values) {
    tables_.push_back(rtapi::CreateUploadBuffer(device_, values, "table").value());
    views_.set_shader_resource(t, tables_.back(), sizeof(T)).value();
  }

  std::vector<glm::vec4> run(const char* shader, const SampleWords& words, std::uint32_t result) {
    const Frame& frame = renderer_->frame();
    const ComputePass pass = ComputePass::create(device_, frame, library_, shader).value();
    renderer_->runner()
        .execute([&](rtapi::CommandList& list) {
          pass.dispatch_groups(list, frame, {}, PassArguments(views_, words), kSamples / 64, 1);
        })
        .value();
    const auto bytes = rtapi::ReadbackBuffer(device_, renderer_->queue(), results_[result]).value();
    std::vector<glm::vec4> out(kSamples);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }

  // Samples in bins of height and angle about an axis, against the integral of `density`.
  void expect_spread(const std::vector<glm::vec4>& samples, double lowest,
                     const std::function<double(const glm::dvec3&)>& density,
                     const std::function<glm::dvec3(const glm::dvec3&)>& to_axes) {
    std::vector<double> counted(kRows * kColumns), expected(kRows * kColumns);
    for (const glm::vec4& sample : samples) {
      const glm::dvec3 d = to_axes(glm::dvec3(sample));
      if (glm::length(d) < 0.5) continue;  // lost below the surface
      ASSERT_NEAR(glm::length(d), 1, 1e-4);
      const double row = (d.z - lowest) / (1 - lowest) * kRows;
      const double column = (std::atan2(d.y, d.x) / (2 * std::numbers::pi) + 0.5) * kColumns;
      const int r = std::clamp(static_cast<int>(row), 0, kRows - 1);
      counted[r * kColumns + std::clamp(static_cast<int>(column), 0, kColumns - 1)] += 1;
    }
    constexpr int kFine = 24;
    for (int r = 0; r < kRows; ++r) {
      for (int c = 0; c < kColumns; ++c) {
        double sum = 0;
        for (int i = 0; i < kFine; ++i) {
          const double z = lowest + (1 - lowest) * (r + (i + 0.5) / kFine) / kRows;
          const double s = std::sqrt(std::max(0.0, 1 - z * z));
          for (int j = 0; j < kFine; ++j) {
            const double phi = 2 * std::numbers::pi * ((c + (j + 0.5) / kFine) / kColumns - 0.5);
            sum += density({s * std::cos(phi), s * std::sin(phi), z});
          }
        }
        expected[r * kColumns + c] = kSamples * sum / (kFine * kFine) * 2 * std::numbers::pi *
                                     (1 - lowest) / (kRows * kColumns);
      }
    }
    double statistic = 0, small_counted = 0, small_expected = 0;
    int bins = 0;
    for (std::size_t i = 0; i < counted.size(); ++i) {
      if (expected[i] < 20) {
        small_counted += counted[i];
        small_expected += expected[i];
        continue;
      }
      // The quadrature of a peak is good to half a per cent.
      const double spread = expected[i] + std::pow(0.005 * expected[i], 2);
      statistic += std::pow(counted[i] - expected[i], 2) / spread;
      ++bins;
    }
    ASSERT_GT(bins, 8);
    EXPECT_LT(statistic, bins + 4.5 * std::sqrt(2.0 * bins)) << bins << " bins";
    EXPECT_LT(std::abs(small_counted - small_expected), 5 * std::sqrt(small_expected + 20) + 20);
  }

  Scene scene_;
  rtapi::Device device_;
  std::unique_ptr<FrameRenderer> renderer_;
  PassViews views_;
  PathEmitters emitters_;
  std::vector<rtapi::Buffer> tables_;
  rtapi::Buffer results_[2];
  rtapi::ShaderLibrary library_;
};

glm::dvec3 as_they_are(const glm::dvec3& v) {
  return v;
}

double facet_density(double alpha, const glm::dvec3& h) {
  const double q = h.z * h.z * (alpha * alpha - 1) + 1;
  return alpha * alpha / (std::numbers::pi * q * q);
}

TEST_P(PathSamplers, FacetsThatTheViewSees) {
  for (const float roughness : {0.4f, 0.7f, 1.0f}) {
    for (const float cosine : {0.15f, 0.8f}) {
      SampleWords words;
      words.kind = kFacets;
      words.roughness = roughness;
      words.cosine_view = cosine;
      const double alpha = static_cast<double>(roughness) * roughness;
      const glm::dvec3 view(std::sqrt(1 - static_cast<double>(cosine) * cosine), 0, cosine);
      const double g1 = 1 / (1 + HostBsdf::lambda(alpha, view));
      expect_spread(
          run("DrawDirections", words, 0), 0,
          [&](const glm::dvec3& h) {
            return g1 * std::max(0.0, glm::dot(view, h)) * facet_density(alpha, h) / view.z;
          },
          as_they_are);
    }
  }
}

TEST_P(PathSamplers, DirectionsOfAMaterial) {
  for (const float metallic : {0.0f, 1.0f}) {
    SampleWords words;
    words.kind = kMaterial;
    words.metallic = metallic;
    words.roughness = 0.6f;
    const auto samples = run("DrawDirections", words, 0);
    const HostBsdf bsdf(std::acos(0.7) * 180 / std::numbers::pi, 0.5, metallic, 0.6);
    const double chance =
        metallic == 1 ? 1.0 : std::clamp(bsdf.albedo / (bsdf.albedo + bsdf.diffuse()), 0.1, 0.9);
    const auto density = [&](const glm::dvec3& light) {
      const double alpha = 0.36;
      const glm::dvec3 h = glm::normalize(bsdf.view + light);
      return (1 - chance) * light.z / std::numbers::pi +
             chance * facet_density(alpha, h) /
                 (4 * bsdf.view.z * (1 + HostBsdf::lambda(alpha, bsdf.view)));
    };
    expect_spread(samples, 0, density, as_they_are);
    for (std::uint32_t i = 0; i < kSamples; i += 997) {
      if (samples[i].w == 0) continue;
      EXPECT_NEAR(samples[i].w, density(glm::dvec3(samples[i])), 2e-3 * samples[i].w + 1e-4);
    }
  }
}

TEST_P(PathSamplers, ConeOfALamp) {
  for (const float sine : {0.9f, 0.05f}) {
    SampleWords words;
    words.kind = kCone;
    words.size = sine;
    const double height = 1 - std::sqrt(1 - static_cast<double>(sine) * sine);
    const auto samples = run("DrawDirections", words, 0);
    EXPECT_NEAR(samples[0].w, 1 / (2 * std::numbers::pi * height), 1e-4 * samples[0].w);
    const double density = 1 / (2 * std::numbers::pi * height);
    expect_spread(
        samples, 1 - height, [&](const glm::dvec3&) { return density; }, as_they_are);
  }
}

TEST_P(PathSamplers, DirectionsToTheSky) {
  SampleWords words;
  words.kind = kSky;
  const auto samples = run("DrawDirections", words, 0);
  const std::vector<float> bands = sky_bands(scene_.sky);
  // y is up in the scene, z here.
  expect_spread(
      samples, -1,
      [&](const glm::dvec3& d) {
        const auto band =
            std::min(static_cast<std::uint32_t>((d.z + 1) * 0.5 * kSkyBands), kSkyBands - 1);
        return (bands[band + 1] - bands[band]) * kSkyBands / (4 * std::numbers::pi);
      },
      [](const glm::dvec3& d) { return glm::dvec3(d.x, -d.z, d.y); });
}

// By area and brightness: how often each panel is met, and where.
TEST_P(PathSamplers, PointsOfEmitters) {
  SampleWords words;
  words.kind = kEmitters;
  words.size = static_cast<float>(emitters_.triangles.size());
  const auto samples = run("DrawDirections", words, 0);
  // Density of direction d: that of the triangle it meets, from the origin.
  const auto density = [&](const glm::dvec3& d) {
    double sum = 0;
    for (const PathEmitter& triangle : emitters_.triangles) {
      const glm::dvec3 e1(triangle.edge1), e2(triangle.edge2), p(triangle.corner);
      const glm::dvec3 normal = glm::cross(e1, e2);
      const double facing = glm::dot(normal, d);
      if (std::abs(facing) < 1e-12) continue;
      const double t = glm::dot(normal, p) / facing;
      const glm::dvec3 at = d * t - p;
      const double area2 = glm::dot(normal, normal);
      const double a = glm::dot(glm::cross(at, e2), normal) / area2;
      const double b = glm::dot(glm::cross(e1, at), normal) / area2;
      if (t <= 0 || a < 0 || b < 0 || a + b > 1) continue;
      sum += emitters_.densities[triangle.material] * t * t * std::sqrt(area2) / std::abs(facing);
    }
    return sum;
  };
  for (std::uint32_t i = 0; i < kSamples; i += 997) {
    const double expected = density(glm::normalize(glm::dvec3(samples[i])));
    // On the diagonal of a panel rounding may find both triangles or none.
    if (expected == 0 || expected > 1.5 * samples[i].w) continue;
    EXPECT_NEAR(samples[i].w, expected, 2e-3 * expected);
  }
  std::uint32_t on_panel = 0;
  for (const glm::vec4& sample : samples) on_panel += sample.z < 0 ? 1 : 0;
  const double panel = std::sqrt(4 + 0.25) * 2 * 1.0;
  const double other = glm::length(glm::cross(glm::dvec3(0, 1, 0.3), glm::dvec3(0.4, 0, 1))) * 4.0;
  const double share = panel / (panel + other);
  EXPECT_NEAR(on_panel / static_cast<double>(kSamples), share,
              5 * std::sqrt(share * (1 - share) / kSamples));
}

// The frame's material model was written apart from this one. They are the same function but for
// the tables of the specular lobe's albedo, whose grids differ, and for a mirror's highlights of
// the sun, which the reference does not have.
TEST_P(PathSamplers, MaterialOfTheFrameIsTheSame) {
  for (const float metallic : {0.0f, 0.5f, 1.0f}) {
    for (const float roughness : {0.1f, 0.3f, 0.65f, 1.0f}) {
      for (const float cosine : {0.05f, 0.4f, 0.95f}) {
        SampleWords words;
        words.base = 0.8f;
        words.metallic = metallic;
        words.roughness = roughness;
        words.cosine_view = cosine;
        double worst = 0, worst_diffuse = 0;
        for (const glm::vec4& value : run("CompareMaterials", words, 1)) {
          const double reference = static_cast<double>(value.x) + value.y;
          // In a peak rounding of the half vector counts.
          worst = std::max(worst, std::abs(value.z - reference) - 0.002 * value.y);
          worst_diffuse = std::max(worst_diffuse, static_cast<double>(value.x));
        }
        EXPECT_LT(worst, 0.006 * worst_diffuse + 1e-4)
            << metallic << " " << roughness << " " << cosine;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, PathSamplers, testing::Values("embree", "vulkan"), backend_of);

}  // namespace
}  // namespace kaamos::effects
