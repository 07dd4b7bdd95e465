// SPDX-License-Identifier: MIT
// What a pass reads and writes besides the frame's own pictures: registers t0.. and u0.. of space3,
// and constants in b0 of space3. With these an effect brings its own pictures and buffers, and no
// other effect's shaders depend on them.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace kaamos::effects {

inline constexpr std::uint32_t kPassShaderResources = 16;  ///< t0..t15 of space3
inline constexpr std::uint32_t kPassUnorderedAccess = 32;  ///< u0..u31 of space3
inline constexpr std::uint32_t kPassViews = kPassShaderResources + kPassUnorderedAccess;
inline constexpr std::uint32_t kPassWords = 24;  ///< of constants b0, space3

/// A block of descriptors in the heap of a frame, made by Frame::create_pass_views. What is not set
/// must not be read.
class PassViews {
 public:
  PassViews() = default;
  PassViews(rtapi::Device device, rtapi::DescriptorHeap heap, std::uint32_t first)
      : device_(std::move(device)), heap_(std::move(heap)), first_(first) {}

  rtapi::Status set_shader_resource(std::uint32_t t, const rtapi::Texture& texture);
  /// A structured buffer.
  rtapi::Status set_shader_resource(std::uint32_t t, const rtapi::Buffer& buffer,
                                    std::uint32_t stride);
  rtapi::Status set_unordered_access(std::uint32_t u, const rtapi::Texture& texture);
  /// A structured buffer.
  rtapi::Status set_unordered_access(std::uint32_t u, const rtapi::Buffer& buffer,
                                     std::uint32_t stride);
  /// Records that zero is written to a picture of floats, which register u holds.
  void clear(rtapi::CommandList& list, std::uint32_t u, const rtapi::Texture& texture) const;
  /// Of the pictures and buffers that the views name.
  std::uint64_t bytes() const;
  rtapi::GpuDescriptorHandle table() const { return heap_.GetGPUDescriptorHandle(first_); }

 private:
  rtapi::Device device_;
  rtapi::DescriptorHeap heap_;
  std::uint32_t first_ = 0;
  std::array<std::uint64_t, kPassViews> bytes_{};  // per view
};

/// Arguments of one dispatch that only its pass knows.
struct PassArguments {
  const PassViews* views = nullptr;  ///< null: the pass has none
  std::array<std::uint32_t, kPassWords> words{};

  PassArguments() = default;
  explicit PassArguments(const PassViews& pass_views) : views(&pass_views) {}
  /// `constants`: as the pass's cbuffer b0, space3 has them.
  template <class T>
  PassArguments(const PassViews& pass_views, const T& constants) : views(&pass_views) {
    static_assert(sizeof(T) <= sizeof(words));
    std::memcpy(words.data(), &constants, sizeof(T));
  }
};

}  // namespace kaamos::effects
