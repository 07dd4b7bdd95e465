// SPDX-License-Identifier: MIT
#include "effects/denoise/temporal_gradients.h"

#include <algorithm>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

using rtapi::ResourceStates;
using rtapi::Texture;

namespace {

constexpr std::uint32_t kStratum = 3;
constexpr std::uint32_t kLargestPicture = 65535;  // pixels are packed as x + 65536 * y
// Strata between the taps of the filter's passes.
constexpr std::int32_t kSpacings[] = {1, 2};

// The registers of temporal_gradients.hlsl.
constexpr std::uint32_t kPastPositionRegister = 0, kPastNormalRegister = 1, kPastIdsRegister = 2,
                        kMovedPositionRegister = 3, kSamplesRegister = 4, kOrderRegister = 5,
                        kScalarNowRegister = 6, kScalarBeforeRegister = 7, kColorNowRegister = 8,
                        kColorBeforeRegister = 9, kGradientsRegister = 10, kFilteredRegister = 11,
                        kChangesRegister = 12, kPastShadingNormalRegister = 14,
                        kMovedNormalRegister = 15, kMovedShadingNormalRegister = 16;
constexpr std::uint32_t kInstancesRegister = 0;  // t

/// Mirrors GradientConstants of temporal_gradients.hlsl.
struct GradientConstants {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::int32_t signals = 0;
  std::int32_t signal = 0;
  std::int32_t component = -1;
  std::int32_t spacing = 1;
  std::uint32_t pixel_step = 1;
  std::uint32_t pixel_offset = 0;
};

struct PictureAt {
  std::uint32_t u;
  const Texture* texture;
};

// The pictures of a surface that shaders of effects read besides its position and normals.
constexpr FrameTexture kSurfaceTextures[] = {kDepth,    kViewZ,    kBaseColor,
                                             kEmissive, kMaterial, kIds};

rtapi::Result<rtapi::Buffer> create_buffer(const rtapi::Device& device, std::uint64_t bytes,
                                           const char* name, ResourceStates state) {
  rtapi::BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = state;
  desc.Name = name;
  return device.CreateBuffer(desc);
}

void record_copy(rtapi::CommandList& list, const Texture& from, const Texture& into) {
  const auto change = [&](const Texture& texture, ResourceStates before, ResourceStates after) {
    list.ResourceBarrier(rtapi::ResourceBarrier::Transition(texture, before, after));
  };
  change(from, ResourceStates::kUnorderedAccess, ResourceStates::kCopySource);
  change(into, ResourceStates::kUnorderedAccess, ResourceStates::kCopyDest);
  list.CopyResource(into, from);
  change(from, ResourceStates::kCopySource, ResourceStates::kUnorderedAccess);
  change(into, ResourceStates::kCopyDest, ResourceStates::kUnorderedAccess);
}

}  // namespace

rtapi::Result<TemporalGradients> TemporalGradients::create(const rtapi::Device& device,
                                                           const Frame& frame, const GpuScene& gpu,
                                                           const DenoiseLibraries& libraries) {
  if (std::max(frame.width(), frame.height()) > kLargestPicture) {
    return make_error(ErrorId::kGradients, "a picture of " + std::to_string(frame.width()) + " x " +
                                               std::to_string(frame.height()) +
                                               " pixels: " + std::to_string(kLargestPicture) +
                                               " are allowed on a side");
  }
  TemporalGradients out;
  auto past = frame.create_twin(device, gpu);
  if (!past) return past.error();
  out.past_ = std::move(*past);
  out.columns_ = (frame.width() + kStratum - 1) / kStratum;
  out.rows_ = (frame.height() + kStratum - 1) / kStratum;
  out.library_ = libraries.gradients;
  const std::uint64_t strata = std::uint64_t{out.columns_} * out.rows_;
  struct Words {
    rtapi::Buffer* buffer;
    const char* name;
    std::uint64_t words;
    ResourceStates state;
  };
  const Words buffers[] = {
      {&out.samples_, "gradient samples", strata, ResourceStates::kUnorderedAccess},
      {&out.order_, "gradient sample order", strata, ResourceStates::kNonPixelShaderResource},
      {&out.gradients_, "gradients", 2 * kMostGradients * strata, ResourceStates::kUnorderedAccess},
      {&out.filtered_, "filtered gradients", 2 * kMostGradients * strata,
       ResourceStates::kUnorderedAccess}};
  for (const auto& [buffer, name, words, state] : buffers) {
    auto created = create_buffer(device, words * sizeof(std::uint32_t), name, state);
    if (!created) return created.error();
    *buffer = std::move(*created);
  }
  for (const auto& [texture, name, format] :
       {std::tuple(&out.position_, "past position", rtapi::Format::kR32G32B32A32Float),
        std::tuple(&out.normal_, "past normal", rtapi::Format::kR16G16Snorm),
        std::tuple(&out.shading_normal_, "past shading normal", rtapi::Format::kR16G16Snorm),
        std::tuple(&out.changes_[0], "changes", rtapi::Format::kR8G8B8A8Unorm),
        std::tuple(&out.changes_[1], "more changes", rtapi::Format::kR8G8B8A8Unorm)}) {
    const auto created = frame.create_picture(device, name, format);
    if (!created) return created.error();
    *texture = *created;
  }
  for (const auto& [pass, name] :
       {std::pair(&out.pick_, "PickSamples"), std::pair(&out.filter_, "FilterGradients"),
        std::pair(&out.write_, "WriteChanges")}) {
    const auto created = ComputePass::create(device, frame, out.library_, name);
    if (!created) return created.error();
    *pass = *created;
  }
  if (const auto s = out.past_.set_ray_order(device, {}, out.order_); !s) return s.error();
  if (const auto s = out.create_views(device, frame, gpu); !s) return s.error();
  return out;
}

rtapi::Status TemporalGradients::create_views(const rtapi::Device& device, const Frame& frame,
                                              const GpuScene& gpu) {
  constexpr std::uint32_t kGradientBytes = 2 * sizeof(float);
  for (PassViews* views : {&views_, &even_, &odd_}) {
    const auto created = frame.create_pass_views(device);
    if (!created) return created.error();
    *views = *created;
    const PictureAt pictures[] = {{kPastPositionRegister, &position_},
                                  {kPastNormalRegister, &normal_},
                                  {kPastShadingNormalRegister, &shading_normal_},
                                  {kPastIdsRegister, &past_.texture(kIds)},
                                  {kMovedPositionRegister, &past_.texture(kPosition)},
                                  {kMovedNormalRegister, &past_.texture(kNormal)},
                                  {kMovedShadingNormalRegister, &past_.texture(kShadingNormal)},
                                  {kChangesRegister, &changes_[0]},
                                  {kChangesRegister + 1, &changes_[1]}};
    for (const auto& [u, texture] : pictures) {
      if (const auto s = views->set_unordered_access(u, *texture); !s) return s;
    }
    const auto instances = views->set_shader_resource(kInstancesRegister, gpu.instances,
                                                      sizeof(rtapi::RaytracingInstanceDesc));
    if (!instances) return instances.error();
    const bool is_back = views == &odd_;
    for (const auto& [u, buffer, bytes] :
         {std::tuple(kSamplesRegister, &samples_, std::uint32_t{sizeof(std::uint32_t)}),
          std::tuple(kOrderRegister, &order_, std::uint32_t{sizeof(std::uint32_t)}),
          std::tuple(kGradientsRegister, is_back ? &filtered_ : &gradients_, kGradientBytes),
          std::tuple(kFilteredRegister, is_back ? &gradients_ : &filtered_, kGradientBytes)}) {
      if (const auto s = views->set_unordered_access(u, *buffer, bytes); !s) return s;
    }
  }
  return {};
}

rtapi::Result<std::uint32_t> TemporalGradients::add(const rtapi::Device& device, const Frame& frame,
                                                    const Texture& sum, const Texture& again,
                                                    std::int32_t component) {
  if (signals_.size() == kMostGradients) {
    return make_error(ErrorId::kGradients, std::to_string(kMostGradients + 1) +
                                               " signals whose samples are taken again: " +
                                               std::to_string(kMostGradients) + " are allowed");
  }
  const bool is_scalar = sum.GetDesc().Format == rtapi::Format::kR32Float;
  Signal signal = {.sum = sum, .again = again, .component = component};
  const auto before = frame.create_picture(device, "sum of the frame before", sum.GetDesc().Format);
  if (!before) return before.error();
  signal.before = *before;
  const auto pass =
      ComputePass::create(device, frame, library_, is_scalar ? "CompareScalar" : "CompareColor");
  if (!pass) return pass.error();
  signal.compare = *pass;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  signal.views = *views;
  const PictureAt pictures[] = {
      {is_scalar ? kScalarNowRegister : kColorNowRegister, &again},
      {is_scalar ? kScalarBeforeRegister : kColorBeforeRegister, &signal.before}};
  for (const auto& [u, texture] : pictures) {
    if (const auto s = signal.views.set_unordered_access(u, *texture); !s) return s.error();
  }
  const auto samples =
      signal.views.set_unordered_access(kSamplesRegister, samples_, sizeof(std::uint32_t));
  if (!samples) return samples.error();
  const auto gradients =
      signal.views.set_unordered_access(kGradientsRegister, gradients_, 2 * sizeof(float));
  if (!gradients) return gradients.error();
  signals_.push_back(std::move(signal));
  return static_cast<std::uint32_t>(signals_.size() - 1);
}

rtapi::Result<Texture> TemporalGradients::keep(const rtapi::Device& device, const Frame& frame,
                                               const Texture& picture) {
  const auto before =
      frame.create_picture(device, "picture of the frame before", picture.GetDesc().Format);
  if (!before) return before;
  kept_.emplace_back(picture, *before);
  return before;
}

void TemporalGradients::record_samples(rtapi::CommandList& list, const Frame& frame,
                                       std::uint32_t step, std::uint32_t offset) const {
  const GradientConstants constants = {.columns = static_cast<std::int32_t>(columns_),
                                       .rows = static_cast<std::int32_t>(rows_),
                                       .signals = static_cast<std::int32_t>(signals_.size()),
                                       .pixel_step = step,
                                       .pixel_offset = offset};
  const auto change = [&](ResourceStates before, ResourceStates after) {
    list.ResourceBarrier(rtapi::ResourceBarrier::Transition(order_, before, after));
  };
  change(ResourceStates::kNonPixelShaderResource, ResourceStates::kUnorderedAccess);
  pick_.dispatch(list, frame, {}, {views_, constants}, columns_, rows_);
  change(ResourceStates::kUnorderedAccess, ResourceStates::kNonPixelShaderResource);
}

void TemporalGradients::record_again(rtapi::CommandList& list, const RayPass& pass,
                                     PassConstants constants,
                                     const PassArguments& arguments) const {
  constants.sorted = 1;  // in the order of the samples
  constants.first_row = 0;
  constants.accumulate = 0;
  constants.again = 1;
  pass.dispatch_grid(list, past_, constants, columns_, rows_, arguments);
}

void TemporalGradients::record_changes(rtapi::CommandList& list, const Frame& frame) const {
  GradientConstants constants = {.columns = static_cast<std::int32_t>(columns_),
                                 .rows = static_cast<std::int32_t>(rows_),
                                 .signals = static_cast<std::int32_t>(signals_.size())};
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    constants.signal = static_cast<std::int32_t>(i);
    constants.component = signals_[i].component;
    signals_[i].compare.dispatch(list, frame, {}, {signals_[i].views, constants}, columns_, rows_);
  }
  bool is_back = false;
  for (const std::int32_t spacing : kSpacings) {
    constants.spacing = spacing;
    filter_.dispatch(list, frame, {}, {is_back ? odd_ : even_, constants}, columns_, rows_);
    is_back = !is_back;
  }
  static_assert(std::size(kSpacings) % 2 == 0, "the last pass writes where `views_` reads");
  write_.dispatch(list, frame, {}, {views_, constants}, frame.width(), frame.height());
}

void TemporalGradients::record_keep(rtapi::CommandList& list, const Frame& frame) {
  for (const FrameTexture texture : kSurfaceTextures) {
    record_copy(list, frame.texture(texture), past_.texture(texture));
  }
  record_copy(list, frame.texture(kPosition), position_);
  record_copy(list, frame.texture(kNormal), normal_);
  record_copy(list, frame.texture(kShadingNormal), shading_normal_);
  for (const auto& [picture, before] : kept_) record_copy(list, picture, before);
  for (const Signal& signal : signals_) record_copy(list, signal.sum, signal.before);
  has_past_ = true;
}

std::uint64_t TemporalGradients::bytes() const {
  std::uint64_t sum = samples_.size() + order_.size() + gradients_.size() + filtered_.size();
  for (const Texture* picture :
       {&position_, &normal_, &shading_normal_, &changes_[0], &changes_[1]}) {
    sum += picture_bytes(*picture);
  }
  for (const auto& [picture, before] : kept_) sum += picture_bytes(before);
  for (std::uint32_t i = 0; i < kFrameTextureCount; ++i) {
    sum += picture_bytes(past_.texture(static_cast<FrameTexture>(i)));
  }
  for (const Signal& signal : signals_) {
    sum += picture_bytes(signal.before) + picture_bytes(signal.again);
  }
  return sum;
}

}  // namespace kaamos::effects
