// SPDX-License-Identifier: MIT
//
// Resolves of multisampled textures. [D3D12: ResolveSubresourceRegion]
#include <algorithm>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/resources/resource_impl.h"
#include "runtime/backend/copy_overlap.h"

namespace rtapi {

using namespace detail;

namespace {

// What one of the two calls asks for. An empty rectangle is all of the source.
struct Resolve {
  const char* call;
  const Texture& dest;
  uint32_t dest_subresource;
  uint32_t x;
  uint32_t y;
  const Texture& source;
  uint32_t source_subresource;
  const Rect* rect;
  Format format;
  ResolveMode mode;
};

Status check_format(const DeviceImpl& device, const Resolve& resolve) {
  const Format own[] = {resolve.dest.GetDesc().Format, resolve.source.GetDesc().Format};
  const FormatInfo info = GetFormatInfo(resolve.format);
  const auto fail = [&](const char* why) {
    return make_error(Id::kResolve, resolve.call, ": DXGI format ",
                      static_cast<uint32_t>(resolve.format), " for ",
                      named("texture", resolve.source.name()), " with format ",
                      static_cast<uint32_t>(own[1]), " and ", named("texture", resolve.dest.name()),
                      " with format ", static_cast<uint32_t>(own[0]), why);
  };
  if (info.type == FormatClass::kTypeless || info.type == FormatClass::kUnsupported ||
      !castable(own[0], resolve.format) || !castable(own[1], resolve.format)) {
    return fail("; it must be a typed format of the family of both");
  }
  if (HasStencil(resolve.format)) return fail("; formats with stencil are not resolved");
  if (resolve.mode != ResolveMode::kAverage) return {};
  if (info.type == FormatClass::kUint || info.type == FormatClass::kSint) {
    return fail("; integers have no average, use kMin or kMax");
  }
  if (IsDepthFormat(resolve.format)) return fail("; depth has no average, use kMin or kMax");
  if (device.backend->supports_target(resolve.format, false)) return {};
  return fail("; this backend cannot draw to it");
}

Status check_mode(const DeviceImpl& device, const Resolve& resolve) {
  if (resolve.mode == ResolveMode::kDecompress) return {};
  const bool known = resolve.mode <= ResolveMode::kAverage;
  if (known && device.backend->supports_resolve(resolve.mode)) return {};
  return make_error(
      Id::kResolve, resolve.call, ": mode ", static_cast<uint32_t>(resolve.mode),
      known ? ", which this backend does not have; use kAverage (3)" : "; it must be 0 to 3");
}

Status check_samples(const Resolve& resolve) {
  const uint32_t from = resolve.source.GetDesc().SampleDesc.Count;
  const uint32_t to = resolve.dest.GetDesc().SampleDesc.Count;
  const bool keeps = resolve.mode == ResolveMode::kDecompress;
  if (from > 1 && to == (keeps ? from : 1)) return {};
  return make_error(Id::kResolve, resolve.call, ": ", named("texture", resolve.source.name()),
                    " has ", from, " samples and ", named("texture", resolve.dest.name()), " has ",
                    to, "; the source must have several and the destination ",
                    keeps ? "as many" : "one");
}

Status check_subresource(const Resolve& resolve, const Texture& texture, uint32_t subresource) {
  if (subresource < texture.subresource_count()) return {};
  return make_error(Id::kCopyRange, resolve.call, ": subresource ", subresource, " of ",
                    named("texture", texture.name()), " does not exist; there are ",
                    texture.subresource_count());
}

MipExtent extent_of(const Texture& texture, uint32_t subresource) {
  return get_mip_extent(texture.GetDesc(), subresource % texture.GetDesc().MipLevels);
}

// The pixels of the source; both sides hold them.
Result<Rect> pixels_of(const Resolve& resolve) {
  const MipExtent from = extent_of(resolve.source, resolve.source_subresource);
  const MipExtent to = extent_of(resolve.dest, resolve.dest_subresource);
  const Rect whole = {0, 0, static_cast<int32_t>(from.width), static_cast<int32_t>(from.height)};
  const Rect rect = resolve.rect ? *resolve.rect : whole;
  if (rect.right <= rect.left || rect.bottom <= rect.top) return Rect{};
  const auto width = static_cast<uint64_t>(int64_t{rect.right} - rect.left);
  const auto height = static_cast<uint64_t>(int64_t{rect.bottom} - rect.top);
  const bool inside = rect.left >= 0 && rect.top >= 0 && rect.right <= whole.right &&
                      rect.bottom <= whole.bottom && resolve.x + width <= to.width &&
                      resolve.y + height <= to.height;
  if (inside) return rect;
  return make_error(Id::kCopyRange, resolve.call, ": pixels (", rect.left, ", ", rect.top, ") to (",
                    rect.right, ", ", rect.bottom, ") of ", named("texture", resolve.source.name()),
                    " (", from.width, "x", from.height, ") do not fit at (", resolve.x, ", ",
                    resolve.y, ") of ", named("texture", resolve.dest.name()), " (", to.width, "x",
                    to.height, ")");
}

runtime::TextureCopyPlace place_of(const Texture& texture, uint32_t subresource, uint32_t x,
                                   uint32_t y) {
  runtime::TextureCopyPlace place;
  place.texture = texture.impl()->memory;
  place.mip = subresource % texture.GetDesc().MipLevels;
  place.array_element = subresource / texture.GetDesc().MipLevels;
  place.origin[0] = x;
  place.origin[1] = y;
  return place;
}

Status check(const std::shared_ptr<DeviceImpl>& device, const Resolve& resolve) {
  if (Status s = CheckHandle(device, resolve.dest, concat(resolve.call, ": dest")); !s.ok()) {
    return s;
  }
  if (Status s = CheckHandle(device, resolve.source, concat(resolve.call, ": source")); !s.ok()) {
    return s;
  }
  if (Status s = check_samples(resolve); !s.ok()) return s;
  if (Status s = check_subresource(resolve, resolve.dest, resolve.dest_subresource); !s.ok()) {
    return s;
  }
  if (Status s = check_subresource(resolve, resolve.source, resolve.source_subresource); !s.ok()) {
    return s;
  }
  if (Status s = check_mode(*device, resolve); !s.ok()) return s;
  return check_format(*device, resolve);
}

void record(CommandListImpl& list, const Resolve& resolve) {
  if (!list.check_open(resolve.call)) return;
  if (Status s = check(list.device, resolve); !s.ok()) return list.fail(s.error());
  const auto pixels = pixels_of(resolve);
  if (!pixels.ok()) return list.fail(pixels.error());
  if (pixels->right == pixels->left) return;
  runtime::ResolveCommand command;
  command.dest = place_of(resolve.dest, resolve.dest_subresource, resolve.x, resolve.y);
  command.source =
      place_of(resolve.source, resolve.source_subresource, static_cast<uint32_t>(pixels->left),
               static_cast<uint32_t>(pixels->top));
  command.extent[0] = static_cast<uint32_t>(pixels->right - pixels->left);
  command.extent[1] = static_cast<uint32_t>(pixels->bottom - pixels->top);
  if (runtime::same_subresource(command.dest, command.source)) {
    // Decompressed where they are. [D3D12: D3D12_RESOLVE_MODE]
    if (std::equal(command.dest.origin, command.dest.origin + 2, command.source.origin)) return;
    const uint32_t extent[3] = {command.extent[0], command.extent[1], 1};
    if (runtime::overlap(command.dest, command.source, extent)) {
      return list.fail(make_error(Id::kCopyOverlap, resolve.call, ": pixels at (", pixels->left,
                                  ", ", pixels->top, ") overlap those at (", resolve.x, ", ",
                                  resolve.y, ") of the same subresource of ",
                                  named("texture", resolve.source.name())));
    }
  }
  command.format = resolve.format;
  command.mode = resolve.mode;
  list.record(std::move(command));
}

}  // namespace

void CommandList::ResolveSubresource(const Texture& dest, uint32_t dest_subresource,
                                     const Texture& source, uint32_t source_subresource,
                                     Format format) {
  if (!impl_) return;
  const Resolve resolve = {"ResolveSubresource",
                           dest,
                           dest_subresource,
                           0,
                           0,
                           source,
                           source_subresource,
                           nullptr,
                           format,
                           ResolveMode::kAverage};
  const bool sized = dest && source && dest_subresource < dest.subresource_count() &&
                     source_subresource < source.subresource_count();
  if (sized && !(extent_of(dest, dest_subresource) == extent_of(source, source_subresource))) {
    if (!impl_->check_open(resolve.call)) return;
    const MipExtent to = extent_of(dest, dest_subresource);
    const MipExtent from = extent_of(source, source_subresource);
    return impl_->fail(make_error(Id::kResolve, resolve.call, ": ", named("texture", source.name()),
                                  " is ", from.width, "x", from.height, " and ",
                                  named("texture", dest.name()), " is ", to.width, "x", to.height,
                                  "; both must have one size"));
  }
  record(*impl_, resolve);
}

void CommandList::ResolveSubresourceRegion(const Texture& dest, uint32_t dest_subresource,
                                           uint32_t x, uint32_t y, const Texture& source,
                                           uint32_t source_subresource, const Rect* source_rect,
                                           Format format, ResolveMode mode) {
  if (!impl_) return;
  record(*impl_, {"ResolveSubresourceRegion", dest, dest_subresource, x, y, source,
                  source_subresource, source_rect, format, mode});
}

}  // namespace rtapi
