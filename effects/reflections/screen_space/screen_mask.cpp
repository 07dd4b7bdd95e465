// SPDX-License-Identifier: MIT
#include "effects/reflections/screen_space/screen_mask.h"

#include <shaders/screen_mask.h>

#include <iterator>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kBlock = 8;  // pixels along a side
constexpr std::uint32_t kDepthBounds = 2, kPixels = 3, kPixelCount = 4, kGroups = 5,
                        kMarks = 6;  // u, space3
constexpr std::uint32_t kWidestDilation = 64;

rtapi::Result<rtapi::Buffer> create_words(const rtapi::Device& device, std::uint64_t count,
                                          const char* name) {
  rtapi::BufferDesc desc;
  desc.SizeInBytes = count * sizeof(std::uint32_t);
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  desc.Name = name;
  return device.CreateBuffer(desc);
}

class MaskedReflections : public EffectPass {
 public:
  explicit MaskedReflections(const EffectScope& scope)
      : device_(scope.device),
        frame_(scope.frame),
        views_(scope.views),
        blocks_x_((scope.frame.width() + kBlock - 1) / kBlock),
        blocks_y_((scope.frame.height() + kBlock - 1) / kBlock) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto constants = scope.settings.get_constants<ScreenMaskConstants>();
    auto inputs = ScreenInputs::create(scope, constants.screen);
    if (!inputs) return inputs.error();
    inputs_ = std::move(*inputs);
    const auto& library = scope.library("reflections/screen_space/screen_mask");
    if (constants.dilation > kWidestDilation) {
      return make_error(ErrorId::kScreenReflections,
                        "ScreenMaskConstants::dilation is " + std::to_string(constants.dilation) +
                            "; choose at most " + std::to_string(kWidestDilation));
    }
    constexpr const char* kEntries[] = {"BoundDepths",    "ClearMarks",  "MarkPixels",
                                        "ClassifyPixels", "CountGroups", "MarchPixels"};
    ComputePass* const passes[] = {&bound_, &clear_, &mark_, &classify_, &count_, &march_};
    for (std::size_t i = 0; i < std::size(kEntries); ++i) {
      auto pass = ComputePass::create(device_, frame_, library, kEntries[i]);
      if (!pass) return pass.error();
      *passes[i] = std::move(*pass);
    }
    const auto signature = device_.CreateCommandSignature(
        {.ByteStride = 12, .ArgumentDescs = {{.Type = rtapi::IndirectArgumentType::kDispatch}}},
        {});
    if (!signature) return signature.error();
    signature_ = *signature;
    if (const auto s = create_buffers(); !s) return s;
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override { return inputs_.begin_frame(camera); }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    const PassArguments arguments(views_, settings.constants);
    if (settings.get_constants<ScreenMaskConstants>().half_mask != 0) {
      const std::uint32_t width = half(frame_.width()), height = half(frame_.height());
      clear_.dispatch(list, frame_, constants, arguments, width, height);
      mark_.dispatch(list, frame_, constants, arguments, width, height);
    } else {
      bound_.dispatch(list, frame_, constants, arguments, blocks_x_, blocks_y_);
    }
    classify_.dispatch(list, frame_, constants, arguments, frame_.width(), frame_.height());
    count_.dispatch_groups(list, frame_, constants, arguments, 1, 1);
    const auto transition = [&](rtapi::ResourceStates from, rtapi::ResourceStates to) {
      list.ResourceBarrier(rtapi::ResourceBarrier::Transition(groups_, from, to));
    };
    transition(rtapi::ResourceStates::kUnorderedAccess, rtapi::ResourceStates::kIndirectArgument);
    march_.dispatch_indirect(list, frame_, constants, arguments, signature_, groups_);
    transition(rtapi::ResourceStates::kIndirectArgument, rtapi::ResourceStates::kUnorderedAccess);
  }

  std::uint64_t bytes() const override {
    return picture_bytes(bounds_) + pixels_.size() + pixel_count_.size() + groups_.size() +
           marks_.size() + inputs_.bytes();
  }

 private:
  static std::uint32_t half(std::uint32_t pixels) { return (pixels + 1) / 2; }

  rtapi::Status create_buffers() {
    const auto bounds = create_picture(device_, "depths of blocks",
                                       rtapi::Format::kR32G32B32A32Float, blocks_x_, blocks_y_);
    if (!bounds) return bounds.error();
    bounds_ = *bounds;
    const auto pixels = create_words(device_, std::uint64_t{frame_.width()} * frame_.height(),
                                     "pixels to march for");
    if (!pixels) return pixels.error();
    pixels_ = *pixels;
    const auto pixel_count = create_words(device_, 1, "number of pixels to march for");
    if (!pixel_count) return pixel_count.error();
    pixel_count_ = *pixel_count;
    const auto groups = create_words(device_, 3, "groups to march for");
    if (!groups) return groups.error();
    groups_ = *groups;
    const auto marks =
        create_words(device_, std::uint64_t{half(frame_.width())} * half(frame_.height()), "marks");
    if (!marks) return marks.error();
    marks_ = *marks;
    if (const auto s = views_.set_unordered_access(kMarks, marks_, 4); !s) return s;
    if (const auto s = views_.set_unordered_access(kDepthBounds, bounds_); !s) return s;
    if (const auto s = views_.set_unordered_access(kPixels, pixels_, 4); !s) return s;
    if (const auto s = views_.set_unordered_access(kPixelCount, pixel_count_, 4); !s) return s;
    return views_.set_unordered_access(kGroups, groups_, 4);
  }

  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  std::uint32_t blocks_x_, blocks_y_;
  ComputePass bound_, clear_, mark_, classify_, count_, march_;
  rtapi::CommandSignature signature_;
  rtapi::Texture bounds_;
  rtapi::Buffer pixels_, pixel_count_, groups_, marks_;
  ScreenInputs inputs_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> screen_mask_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_screen_mask());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_masked_reflections(const EffectScope& scope) {
  return make_pass<MaskedReflections>(scope);
}

}  // namespace kaamos::effects
