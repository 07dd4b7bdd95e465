// SPDX-License-Identifier: MIT
/// @file
/// Views of what a pass reads and writes besides the frame's own pictures: registers t0.. and u0..
/// of space3, and constants in b0 of space3. With these an effect brings its own pictures and
/// buffers, and no other effect's shaders depend on them.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace kaamos::effects {

/// Registers of space3 that one pass has: t0 to t15, u0 to u31, and both together.
///@{
inline constexpr std::uint32_t kPassShaderResources = 16;
inline constexpr std::uint32_t kPassUnorderedAccess = 32;
inline constexpr std::uint32_t kPassViews = kPassShaderResources + kPassUnorderedAccess;
///@}
/// Words of constants b0, space3.
inline constexpr std::uint32_t kPassWords = 24;

/// A block of descriptors in the heap of a frame, made by Frame::create_pass_views. What is not set
/// must not be read.
class PassViews {
 public:
  /// No block; a pass without views.
  PassViews() = default;
  /// The block of kPassViews descriptors from slot `first` of a heap on.
  PassViews(rtapi::Device device, rtapi::DescriptorHeap heap, std::uint32_t first)
      : device_(std::move(device)), heap_(std::move(heap)), first_(first) {}

  /// Register t, 0 to 15: the whole texture. It must outlive the dispatches. `format`: of a
  /// typeless one's family.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status set_shader_resource(std::uint32_t t, const rtapi::Texture& texture,
                                    rtapi::Format format = rtapi::Format::kUnknown);
  /// Register t, 0 to 15: a whole structured buffer of elements of `stride` bytes. It must outlive
  /// the dispatches.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status set_shader_resource(std::uint32_t t, const rtapi::Buffer& buffer,
                                    std::uint32_t stride);
  /// Register t, 0 to 15: part of a texture, or a texture as a cube. It must outlive the
  /// dispatches.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status set_shader_resource(std::uint32_t t, const rtapi::Texture& texture,
                                    const rtapi::ShaderResourceViewDesc& view);
  /// Register u, 0 to 31: mip 0 of a texture. It must outlive the dispatches.
  /// @errors those of rtapi::Device::CreateUnorderedAccessView.
  rtapi::Status set_unordered_access(std::uint32_t u, const rtapi::Texture& texture);
  /// Register u, 0 to 31: a whole structured buffer of elements of `stride` bytes. It must outlive
  /// the dispatches.
  /// @errors those of rtapi::Device::CreateUnorderedAccessView.
  rtapi::Status set_unordered_access(std::uint32_t u, const rtapi::Buffer& buffer,
                                     std::uint32_t stride);
  /// Register u, 0 to 31: part of a texture. It must outlive the dispatches.
  /// @errors those of rtapi::Device::CreateUnorderedAccessView.
  rtapi::Status set_unordered_access(std::uint32_t u, const rtapi::Texture& texture,
                                     const rtapi::UnorderedAccessViewDesc& view);
  /// Records that zero is written to a picture of floats, which register u holds.
  void clear(rtapi::CommandList& list, std::uint32_t u, const rtapi::Texture& texture) const;
  /// Bytes of the pictures and buffers that the views name.
  std::uint64_t bytes() const;
  /// Their first descriptor, for FrameRootParameter::kRootPassViews.
  rtapi::GpuDescriptorHandle table() const { return heap_.GetGPUDescriptorHandle(first_); }

 private:
  rtapi::Device device_;
  rtapi::DescriptorHeap heap_;
  std::uint32_t first_ = 0;
  std::array<std::uint64_t, kPassViews> bytes_{};  // per view
};

/// Arguments of one dispatch that only its pass knows.
struct PassArguments {
  const PassViews* views = nullptr;               ///< null: the pass has none
  std::array<std::uint32_t, kPassWords> words{};  ///< constants b0, space3

  /// No views, and constants of 0.
  PassArguments() = default;
  /// Views alone.
  explicit PassArguments(const PassViews& pass_views) : views(&pass_views) {}
  /// Views, and `constants` as the pass's cbuffer b0, space3 has them: up to kPassWords words,
  /// which are copied.
  template <class T>
  PassArguments(const PassViews& pass_views, const T& constants) : views(&pass_views) {
    static_assert(sizeof(T) <= sizeof(words));
    std::memcpy(words.data(), &constants, sizeof(T));
  }
};

}  // namespace kaamos::effects
