// SPDX-License-Identifier: MIT
#include "effects/reflections/screen_space/hit_comparison.h"

#include <shaders/hit_truth.h>

#include <iomanip>
#include <numeric>
#include <sstream>

#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

namespace {

constexpr const char* kOutcomeNames[kMarchOutcomes] = {
    "no ray", "hit", "off screen", "hidden",       "back-facing",
    "ended",  "sky", "stale",      "out of steps", "not looked for"};
constexpr const char* kTruthNames[kHitTruths] = {"no ray",  "nothing", "seen",
                                                 "outside", "covered", "turned away"};

std::uint64_t sum_of(const std::array<std::uint64_t, kHitTruths>& row) {
  return std::accumulate(row.begin(), row.end(), std::uint64_t{0});
}

RayPassDesc truth_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "truth of screen-space hits";
  desc.library = std::move(library);
  desc.ray_generation = "HitTruth";
  desc.miss[kRayTypeSurface] = "TruthMiss";
  desc.hit[kRayTypeSurface] = {"TruthAnyHit", "TruthHit"};
  desc.payload_bytes = 20;
  return desc;
}

HitConfusion count(const FloatImage& hits, const FloatImage& truth) {
  HitConfusion out;
  for (std::uint32_t y = 0; y < hits.height; ++y) {
    for (std::uint32_t x = 0; x < hits.width; ++x) {
      const auto outcome = static_cast<std::uint32_t>(hits.at(x, y, 3));
      const auto how = static_cast<std::uint32_t>(truth.at(x, y, 1));
      ++out.counts.at(outcome).at(how);
      if (outcome == kHit && truth.at(x, y, 3) != 0) ++out.right.at(how);
    }
  }
  return out;
}

}  // namespace

std::uint64_t HitConfusion::rays() const {
  std::uint64_t sum = 0;
  for (std::uint32_t i = kHit; i < kMarchOutcomes; ++i) sum += sum_of(counts[i]);
  return sum;
}

std::uint64_t HitConfusion::hits() const {
  return sum_of(counts[kHit]);
}

std::uint64_t HitConfusion::correct() const {
  return sum_of(right);
}

std::uint64_t HitConfusion::missed() const {
  std::uint64_t sum = 0;
  for (std::uint32_t i = kOffScreen; i < kMarchOutcomes; ++i) sum += counts[i][kSeen];
  return sum;
}

double HitConfusion::coverage() const {
  return rays() == 0 ? 0.0 : static_cast<double>(hits()) / static_cast<double>(rays());
}

std::string HitConfusion::table() const {
  std::ostringstream out;
  out << std::left << std::setw(14) << "march";
  for (std::uint32_t t = kNothing; t < kHitTruths; ++t) {
    out << std::right << std::setw(12) << kTruthNames[t];
  }
  out << "\n";
  for (std::uint32_t i = kHit; i < kMarchOutcomes; ++i) {
    if (sum_of(counts[i]) == 0) continue;
    out << std::left << std::setw(14) << kOutcomeNames[i];
    for (std::uint32_t t = kNothing; t < kHitTruths; ++t) {
      out << std::right << std::setw(12) << counts[i][t];
    }
    out << "\n";
  }
  out << std::left << std::setw(14) << "right hits";
  for (std::uint32_t t = kNothing; t < kHitTruths; ++t) {
    out << std::right << std::setw(12) << right[t];
  }
  out << "\n";
  return out.str();
}

rtapi::Result<HitComparison> compare_hits(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                          const Frame& frame, const GpuScene& gpu,
                                          const rtapi::Texture& hits,
                                          const ScreenReflectionConstants& constants,
                                          std::uint32_t sample) {
  const auto library = rtapi::LoadShaderLibrary(kaamos_shaders_hit_truth());
  if (!library) return library.error();
  const auto pass = RayPass::create(device, frame, gpu, truth_pass(*library));
  if (!pass) return pass.error();
  const auto truth =
      frame.create_picture(device, "truth of hits", rtapi::Format::kR32G32B32A32Float);
  if (!truth) return truth.error();
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto s = views->set_unordered_access(1, hits); !s) return s.error();
  if (const auto s = views->set_unordered_access(2, *truth); !s) return s.error();
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  pass->dispatch(*list, frame, {.first_sample = sample, .sample_count = 1}, frame.height(),
                 PassArguments(*views, constants));
  if (const auto done = queue.ExecuteAndWait(*list); !done) return done.error();
  auto found = read_picture(device, queue, hits);
  if (!found) return found.error();
  auto known = read_picture(device, queue, *truth);
  if (!known) return known.error();
  return HitComparison{count(*found, *known), std::move(*found), std::move(*known)};
}

}  // namespace kaamos::effects
