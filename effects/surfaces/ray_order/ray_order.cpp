// SPDX-License-Identifier: MIT
#include "effects/surfaces/ray_order/ray_order.h"
#include "effects/assets/common/errors.h"

#include <shaders/ray_order.h>

#include <string>

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr std::uint32_t kTileWidth = 64;
constexpr std::uint32_t kTileHeight = 128;
constexpr std::uint32_t kLargestSide = 65535;
// The places of the bits of a key. [ray_key.hlsli]
constexpr std::uint32_t kOriginShift = 8, kEndShift = 16;

/// Mirrors SortConstants in ray_order.hlsl.
struct SortConstants {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t shift;
  std::uint32_t first;
};

rtapi::Result<Buffer> create_words(const Device& device, const Frame& frame, const char* name) {
  BufferDesc desc;
  desc.SizeInBytes = std::uint64_t{frame.width()} * frame.height() * sizeof(std::uint32_t);
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  desc.Name = name;
  return device.CreateBuffer(desc);
}

// `from` is null for the first pass.
rtapi::Result<PassViews> create_views(const Device& device, const Frame& frame, const Buffer* from,
                                      const Buffer& to) {
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto set = views->set_unordered_access(0, to, sizeof(std::uint32_t)); !set) {
    return set.error();
  }
  if (from == nullptr) return views;
  if (const auto set = views->set_shader_resource(0, *from, sizeof(std::uint32_t)); !set) {
    return set.error();
  }
  return views;
}

}  // namespace

rtapi::Result<ShaderLibrary> ray_order_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_ray_order());
}

rtapi::Result<RaySorter> RaySorter::create(const Device& device, const Frame& frame,
                                           const ShaderLibrary& library) {
  if (frame.width() > kLargestSide || frame.height() > kLargestSide) {
    return make_error(ErrorId::kRayOrder, "a picture of " + std::to_string(frame.width()) + " x " +
                                              std::to_string(frame.height()) +
                                              " pixels: " + std::to_string(kLargestSide) +
                                              " are allowed on a side");
  }
  RaySorter sorter;
  for (const auto& [buffer, name] :
       {std::pair{&sorter.keys_, "ray keys"}, std::pair{&sorter.order_, "ray order"},
        std::pair{&sorter.between_, "ray order of the first pass"}}) {
    auto created = create_words(device, frame, name);
    if (!created) return created.error();
    *buffer = std::move(*created);
  }
  if (const auto set = frame.set_ray_order(device, sorter.keys_, sorter.order_); !set) {
    return set.error();
  }
  auto pass = ComputePass::create(device, frame, library, "SortRays");
  if (!pass) return pass.error();
  sorter.pass_ = std::move(*pass);
  auto once = create_views(device, frame, nullptr, sorter.order_);
  if (!once) return once.error();
  sorter.once_ = std::move(*once);
  auto first = create_views(device, frame, nullptr, sorter.between_);
  if (!first) return first.error();
  sorter.first_ = std::move(*first);
  auto second = create_views(device, frame, &sorter.between_, sorter.order_);
  if (!second) return second.error();
  sorter.second_ = std::move(*second);
  return sorter;
}

void RaySorter::sort(CommandList& list, const Frame& frame, RayOrder order) const {
  const auto record = [&](const PassViews& views, std::uint32_t shift, std::uint32_t first) {
    const SortConstants constants = {frame.width(), frame.height(), shift, first};
    pass_.dispatch_groups(list, frame, {}, {views, constants},
                          (frame.width() + kTileWidth - 1) / kTileWidth,
                          (frame.height() + kTileHeight - 1) / kTileHeight);
  };
  constexpr auto kWrite = rtapi::ResourceStates::kUnorderedAccess;
  constexpr auto kRead = rtapi::ResourceStates::kNonPixelShaderResource;
  const auto change = [&](const Buffer& buffer, rtapi::ResourceStates from,
                          rtapi::ResourceStates to) {
    list.ResourceBarrier(rtapi::ResourceBarrier::Transition(buffer, from, to));
  };
  // Like every ray pass of the frame, the pass that wrote the keys has the order among its views.
  change(order_, kRead, kWrite);
  if (order == RayOrder::kDirection) {
    record(once_, 0, 1);
  } else {
    // The sort is stable: pixels with equal keys keep the order of the previous pass.
    record(first_, order == RayOrder::kTermination ? kEndShift : 0, 1);
    change(between_, kWrite, kRead);
    record(second_, kOriginShift, 0);
    change(between_, kRead, kWrite);
  }
  change(order_, kWrite, kRead);
}

}  // namespace kaamos::effects
