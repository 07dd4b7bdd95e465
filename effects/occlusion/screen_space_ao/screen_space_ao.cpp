// SPDX-License-Identifier: MIT
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"

#include <shaders/crytek_ao.h>
#include <shaders/gtao.h>
#include <shaders/hbao.h>
#include <shaders/hemisphere_ao.h>
#include <shaders/occlusion_filter.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

// Levels 1 to 4 of the depth picture: kLevels and `depths` of gtao.hlsl.
constexpr std::uint32_t kLevels = 4;
constexpr std::uint32_t kFirstLevel = 8;

// Mirrors FilterConstants of occlusion_filter.hlsl.
struct FilterConstants {
  std::int32_t before;
  std::int32_t behind;
  std::uint32_t edge_aware;
  std::uint32_t from;
  std::uint32_t to;
  float power = 1;
  float least = 0;
};
constexpr std::uint32_t kToResult = 2;

const char* entry_point(ScreenSpaceAoKind kind) {
  switch (kind) {
    case ScreenSpaceAoKind::kCrytek:
      return "CrytekOcclusion";
    case ScreenSpaceAoKind::kHemisphere:
      return "HemisphereOcclusion";
    case ScreenSpaceAoKind::kHbao:
      return "HorizonBasedOcclusion";
    case ScreenSpaceAoKind::kGtao:
      return "GroundTruthOcclusion";
  }
  return "";
}

}  // namespace

GtaoConstants accurate_gtao(std::uint32_t slices, std::uint32_t steps) {
  GtaoConstants constants;
  constants.filter_passes = 0;
  constants.slices = slices;
  constants.steps = steps;
  constants.radius_multiplier = 1;
  constants.falloff_range = 0;
  constants.sample_power = 1;
  constants.final_power = 1;
  constants.least = 0;
  constants.least_pixels = 1;
  constants.level_offset = 100;
  constants.normal_flattening = 0;
  constants.pull = 0;
  return constants;
}

rtapi::Result<rtapi::ShaderLibrary> crytek_ao_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_crytek_ao());
}
rtapi::Result<rtapi::ShaderLibrary> hemisphere_ao_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_hemisphere_ao());
}
rtapi::Result<rtapi::ShaderLibrary> hbao_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_hbao());
}
rtapi::Result<rtapi::ShaderLibrary> gtao_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_gtao());
}
rtapi::Result<rtapi::ShaderLibrary> occlusion_filter_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_occlusion_filter());
}

rtapi::Result<ScreenSpaceAo> ScreenSpaceAo::create(const rtapi::Device& device, const Frame& frame,
                                                   ScreenSpaceAoKind kind,
                                                   const rtapi::ShaderLibrary& technique,
                                                   const rtapi::ShaderLibrary& filter,
                                                   PassViews& views) {
  ScreenSpaceAo out;
  out.kind_ = kind;
  out.views_ = &views;
  const auto pass = ComputePass::create(device, frame, technique, entry_point(kind));
  if (!pass) return pass.error();
  out.technique_ = *pass;
  const auto filter_pass = ComputePass::create(device, frame, filter, "FilterOcclusion");
  if (!filter_pass) return filter_pass.error();
  out.filter_ = *filter_pass;
  std::uint32_t u = 1;
  for (rtapi::Texture* picture : {&out.raw_, &out.filtered_}) {
    const auto created =
        frame.create_picture(device, "occlusion " + std::to_string(u), rtapi::Format::kR32Float);
    if (!created) return created.error();
    *picture = *created;
    if (const auto s = views.set_unordered_access(u++, *picture); !s) return s.error();
  }
  if (kind == ScreenSpaceAoKind::kGtao) {
    if (const auto s = out.create_levels(device, frame, technique); !s) return s.error();
  }
  return out;
}

rtapi::Status ScreenSpaceAo::create_levels(const rtapi::Device& device, const Frame& frame,
                                           const rtapi::ShaderLibrary& technique) {
  for (std::uint32_t level = 1; level <= kLevels; ++level) {
    const std::string number = std::to_string(level);
    const auto picture =
        create_picture(device, "depth level " + number, rtapi::Format::kR32Float,
                       std::max(frame.width() >> level, 1u), std::max(frame.height() >> level, 1u));
    if (!picture) return picture.error();
    levels_.push_back(*picture);
    if (const auto s = views_->set_unordered_access(kFirstLevel + level - 1, *picture); !s) {
      return s;
    }
    const auto pass = ComputePass::create(device, frame, technique, "ShrinkDepth" + number);
    if (!pass) return pass.error();
    shrink_.push_back(*pass);
  }
  return {};
}

void ScreenSpaceAo::record(rtapi::CommandList& list, const Frame& frame,
                           const PassConstants& constants,
                           const std::array<std::uint32_t, kPassWords>& words) const {
  const PassArguments arguments(*views_, words);
  for (std::size_t i = 0; i < shrink_.size(); ++i) {
    const rtapi::TextureDesc desc = levels_[i].GetDesc();
    shrink_[i].dispatch(list, frame, constants, arguments, static_cast<std::uint32_t>(desc.Width),
                        desc.Height);
  }
  technique_.dispatch(list, frame, constants, arguments, frame.width(), frame.height());
  // One pass at least, which reaches no other pixel where none is asked for: it writes the result.
  const std::uint32_t passes = words[0];
  GtaoConstants gtao{.final_power = 1, .least = 0};
  if (kind_ == ScreenSpaceAoKind::kGtao)
    std::memcpy(static_cast<void*>(&gtao), words.data(), sizeof gtao);
  const bool is_tile = kind_ != ScreenSpaceAoKind::kGtao;  // of noise, 4 x 4 pixels
  for (std::uint32_t i = 0; i < std::max(passes, 1u); ++i) {
    FilterConstants filter = {2,         is_tile ? 1 : 2,  1,         i % 2,
                              1 - i % 2, gtao.final_power, gtao.least};
    if (passes == 0) filter.before = filter.behind = 0;
    if (i + 1 >= passes) filter.to = kToResult;
    filter_.dispatch(list, frame, constants, PassArguments(*views_, filter), frame.width(),
                     frame.height());
  }
}

std::uint64_t ScreenSpaceAo::bytes() const {
  std::uint64_t sum = picture_bytes(raw_) + picture_bytes(filtered_);
  for (const rtapi::Texture& level : levels_) sum += picture_bytes(level);
  return sum;
}

}  // namespace kaamos::effects
