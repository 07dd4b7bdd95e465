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
#include <utility>

#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

// Levels 1 to 4 of the depth picture: kLevels and `depths` of gtao.hlsl.
constexpr std::uint32_t kLevels = 4;
constexpr std::uint32_t kFirstLevel = 8;

// Mirrors FilterConstants of occlusion_filter.hlsl.
struct FilterConstants {
  std::int32_t before = 0;
  std::int32_t behind = 0;
  std::uint32_t edge_aware = 1;
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  float power = 1;
  float least = 0;
  std::int32_t step = 1;
  std::uint32_t takes_turns = 0;
  std::uint32_t multibounce = 0;
  std::uint32_t bent = 0;
  float fresh = 1;
  std::uint32_t has_history = 0;
};
constexpr std::uint32_t kToResult = 2;

// The registers of pictures that only some constants need.
constexpr std::uint32_t kRawBent = 14, kFilteredBent = 15, kBefore = 6, kNow = 7, kBentBefore = 12,
                        kBentNow = 13;

template <class Constants>
Constants constants_of(const std::array<std::uint32_t, kPassWords>& words) {
  Constants out;
  static_assert(sizeof out <= sizeof words);
  std::memcpy(static_cast<void*>(&out), words.data(), sizeof out);
  return out;
}

// What follows the search for occluders, by the technique's constants.
FilterConstants filter_constants(ScreenSpaceAoKind kind,
                                 const std::array<std::uint32_t, kPassWords>& words) {
  FilterConstants out;
  bool is_tile = true;  // of noise, 4 x 4 pixels
  bool is_half = false;
  if (kind == ScreenSpaceAoKind::kGtao) {
    const auto gtao = constants_of<GtaoConstants>(words);
    is_tile = gtao.rotations > 0;
    is_half = gtao.half_resolution != 0;
    out.power = gtao.final_power;
    out.least = gtao.least;
    out.multibounce = gtao.multibounce;
    out.bent = gtao.bent_normals;
    out.fresh = gtao.fresh;
  }
  if (kind == ScreenSpaceAoKind::kHbao) {
    const auto hbao = constants_of<HbaoConstants>(words);
    is_half = hbao.half_resolution != 0;
    out.fresh = hbao.fresh;
  }
  out.step = is_half ? 2 : 1;
  out.takes_turns = out.fresh < 1 ? 1 : 0;
  const std::uint32_t passes = words[0];
  out.before = passes == 0 ? 0 : 2;
  out.behind = passes == 0 ? 0 : is_tile ? 1 : 2;
  return out;
}

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

GtaoConstants gtao_over_frames() {
  GtaoConstants constants;
  constants.slices = 1;
  constants.steps = 6;
  constants.half_resolution = 1;
  constants.rotations = 6;
  constants.fresh = 1.0f / 6;
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

rtapi::Result<ScreenSpaceAo> ScreenSpaceAo::create(
    const rtapi::Device& device, const Frame& frame, ScreenSpaceAoKind kind,
    const rtapi::ShaderLibrary& technique, const rtapi::ShaderLibrary& filter, PassViews& views,
    const std::array<std::uint32_t, kPassWords>& words) {
  ScreenSpaceAo out;
  out.kind_ = kind;
  out.views_ = &views;
  const auto pass = ComputePass::create(device, frame, technique, entry_point(kind));
  if (!pass) return pass.error();
  out.technique_ = *pass;
  for (const auto& [made, name] :
       {std::pair(&out.filter_, "FilterOcclusion"), std::pair(&out.upscale_, "UpscaleOcclusion"),
        std::pair(&out.accumulate_, "AccumulateOcclusion")}) {
    const auto filter_pass = ComputePass::create(device, frame, filter, name);
    if (!filter_pass) return filter_pass.error();
    *made = *filter_pass;
  }
  if (const auto s = out.create_pictures(device, frame, words); !s) return s.error();
  if (kind == ScreenSpaceAoKind::kGtao) {
    if (const auto s = out.create_levels(device, frame, technique); !s) return s.error();
  }
  return out;
}

rtapi::Status ScreenSpaceAo::create_pictures(const rtapi::Device& device, const Frame& frame,
                                             const std::array<std::uint32_t, kPassWords>& words) {
  const FilterConstants constants = filter_constants(kind_, words);
  const bool is_bent = constants.bent != 0, is_mean = constants.fresh < 1;
  constexpr auto kScalar = rtapi::Format::kR32Float, kFour = rtapi::Format::kR32G32B32A32Float;
  struct Picture {
    rtapi::Texture* texture;
    const char* name;
    rtapi::Format format;
    std::uint32_t u;
    bool is_wanted;
  };
  const Picture pictures[] = {
      {&raw_, "occlusion 1", kScalar, 1, true},
      {&filtered_, "occlusion 2", kScalar, 2, true},
      {&raw_bent_, "bent normals 1", kFour, kRawBent, is_bent},
      {&filtered_bent_, "bent normals 2", kFour, kFilteredBent, is_bent},
      {&history_[0], "occlusion history 1", kFour, kNow, is_mean},
      {&history_[1], "occlusion history 2", kFour, kBefore, is_mean},
      {&bent_history_[0], "bent normal history 1", kFour, kBentNow, is_mean && is_bent},
      {&bent_history_[1], "bent normal history 2", kFour, kBentBefore, is_mean && is_bent},
  };
  for (const auto& [texture, name, format, u, is_wanted] : pictures) {
    if (!is_wanted) continue;
    const auto created = frame.create_picture(device, name, format);
    if (!created) return created.error();
    *texture = *created;
    if (const auto s = views_->set_unordered_access(u, *texture); !s) return s;
  }
  return {};
}

rtapi::Status ScreenSpaceAo::bind_history() {
  struct Binding {
    std::uint32_t u;
    const rtapi::Texture* texture;
  };
  const Binding bindings[] = {{kNow, &history_[newest_]},
                              {kBefore, &history_[1 - newest_]},
                              {kBentNow, &bent_history_[newest_]},
                              {kBentBefore, &bent_history_[1 - newest_]}};
  for (const auto& [u, texture] : bindings) {
    if (!*texture) continue;
    if (const auto s = views_->set_unordered_access(u, *texture); !s) return s;
  }
  return {};
}

rtapi::Status ScreenSpaceAo::begin_frame() {
  if (!is_recorded_) return {};
  is_recorded_ = false;
  has_history_ = true;
  newest_ = 1 - newest_;
  return bind_history();
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
                           const std::array<std::uint32_t, kPassWords>& words) {
  const PassArguments arguments(*views_, words);
  for (std::size_t i = 0; i < shrink_.size(); ++i) {
    const rtapi::TextureDesc desc = levels_[i].GetDesc();
    shrink_[i].dispatch(list, frame, constants, arguments, static_cast<std::uint32_t>(desc.Width),
                        desc.Height);
  }
  FilterConstants filter = filter_constants(kind_, words);
  filter.has_history = has_history_ ? 1 : 0;
  const auto step = static_cast<std::uint32_t>(filter.step);
  const std::uint32_t width = (frame.width() + step - 1) / step;
  const std::uint32_t height = (frame.height() + step - 1) / step;
  technique_.dispatch(list, frame, constants, arguments, width, height);

  const bool is_mean = filter.fresh < 1;
  const auto run = [&](const ComputePass& pass, bool is_last, std::uint32_t w, std::uint32_t h) {
    filter.to = is_last ? kToResult : 1 - filter.from;
    pass.dispatch(list, frame, constants, PassArguments(*views_, filter), w, h);
    filter.from = 1 - filter.from;
  };
  const bool is_upscaled = step > 1;
  const std::uint32_t passes = words[0];
  // The last pass writes the result. Where it is the filter, it reaches no other pixel if no pass
  // is asked for.
  const bool ends_here = !is_upscaled && !is_mean;
  const std::uint32_t count = ends_here ? std::max(passes, 1u) : passes;
  for (std::uint32_t i = 0; i < count; ++i) {
    run(filter_, ends_here && i + 1 == count, width, height);
  }
  if (is_upscaled) run(upscale_, !is_mean, frame.width(), frame.height());
  if (is_mean) run(accumulate_, true, frame.width(), frame.height());
  is_recorded_ = true;
}

std::uint64_t ScreenSpaceAo::bytes() const {
  std::uint64_t sum = picture_bytes(raw_) + picture_bytes(filtered_);
  for (const rtapi::Texture* texture : {&raw_bent_, &filtered_bent_, &history_[0], &history_[1],
                                        &bent_history_[0], &bent_history_[1]}) {
    if (*texture) sum += picture_bytes(*texture);
  }
  for (const rtapi::Texture& level : levels_) sum += picture_bytes(level);
  return sum;
}

}  // namespace kaamos::effects
