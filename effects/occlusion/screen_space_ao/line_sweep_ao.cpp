// SPDX-License-Identifier: MIT
#include "effects/occlusion/screen_space_ao/line_sweep_ao.h"

#include <shaders/line_sweep_ao.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kMostDirections = 64;
constexpr std::uint32_t kLinesInGroup = 64;
constexpr std::uint32_t kFirstPicture = 3;  // register u of the stacks

// Mirrors LineSweepConstants of line_sweep_ao.hlsl.
struct LineSweepConstants {
  std::uint32_t column_wise;
  float slope;
  std::int32_t first_line;
  std::uint32_t backwards;
  std::uint32_t first;
};

// The lines of a direction that cover a picture, and how many they are.
LineSweepConstants lines_of(double angle, const Frame& frame, std::uint32_t& count) {
  const double x = std::cos(angle), y = std::sin(angle);
  LineSweepConstants lines = {};
  lines.column_wise = std::abs(y) > std::abs(x) ? 1 : 0;
  lines.slope = static_cast<float>(lines.column_wise != 0 ? x / y : y / x);
  // Exactly diagonal lines go through the middles of their pixels.
  if (std::abs(std::abs(lines.slope) - 1) < 1e-6f) lines.slope = lines.slope > 0 ? 1.0f : -1.0f;
  if (std::abs(lines.slope) < 1e-6f) lines.slope = 0;
  const std::uint32_t along = lines.column_wise != 0 ? frame.height() : frame.width();
  const std::uint32_t across = lines.column_wise != 0 ? frame.width() : frame.height();
  const auto drift =
      static_cast<std::int32_t>(std::ceil(std::abs(lines.slope) * static_cast<float>(along)));
  lines.first_line = lines.slope > 0 ? -drift : 0;
  count = across + static_cast<std::uint32_t>(drift) + 1;
  return lines;
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> line_sweep_ao_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_line_sweep_ao());
}

rtapi::Result<LineSweepAo> LineSweepAo::create(const rtapi::Device& device, const Frame& frame,
                                               const rtapi::ShaderLibrary& library,
                                               PassViews& views) {
  LineSweepAo out;
  out.views_ = &views;
  const auto pass = ComputePass::create(device, frame, library, "SweepLine");
  if (!pass) return pass.error();
  out.pass_ = *pass;
  const std::pair<const char*, rtapi::Format> kinds[] = {
      {"line stacks", rtapi::Format::kR32G32Float},
      {"line horizons", rtapi::Format::kR32Float},
      {"line sums", rtapi::Format::kR32G32Float}};
  for (std::uint32_t i = 0; i < out.pictures_.size(); ++i) {
    const auto picture = frame.create_picture(device, kinds[i].first, kinds[i].second);
    if (!picture) return picture.error();
    out.pictures_[i] = *picture;
    if (const auto s = views.set_unordered_access(kFirstPicture + i, *picture); !s) {
      return s.error();
    }
  }
  return out;
}

void LineSweepAo::record(rtapi::CommandList& list, const Frame& frame,
                         const PassConstants& constants, const LineSweepSettings& settings) const {
  const std::uint32_t directions = std::clamp(settings.directions, 1u, kMostDirections);
  for (std::uint32_t i = 0; i < directions; ++i) {
    std::uint32_t count = 0;
    LineSweepConstants lines = lines_of(glm::pi<double>() * i / directions, frame, count);
    lines.first = i == 0 ? 1 : 0;
    for (lines.backwards = 0; lines.backwards < 2; ++lines.backwards) {
      pass_.dispatch_groups(list, frame, constants, PassArguments(*views_, lines),
                            (count + kLinesInGroup - 1) / kLinesInGroup, 1);
    }
  }
}

std::uint64_t LineSweepAo::bytes() const {
  std::uint64_t sum = 0;
  for (const rtapi::Texture& picture : pictures_) sum += picture_bytes(picture);
  return sum;
}

}  // namespace kaamos::effects
