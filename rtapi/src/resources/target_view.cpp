// SPDX-License-Identifier: MIT
#include "rtapi/src/resources/target_view.h"

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/resources/resource_impl.h"

namespace rtapi {

namespace detail {

namespace {

// The request that both kinds of views make, before "all the rest" is resolved.
struct AskedTarget {
  Format format;
  bool whole;        // all elements of mip 0
  bool one_element;  // element 0 of a mip
  bool multisampled;
  ResourceDimension dimension;  // of the texture; not for a whole one
  TargetSlices slices;
};

const char* name_of(ResourceDimension dimension) {
  if (dimension == ResourceDimension::kTexture1D) return "1-D";
  return dimension == ResourceDimension::kTexture3D ? "3-D" : "2-D";
}

Status check_texture(const std::shared_ptr<DeviceImpl>& device, const Texture& texture,
                     bool depth_stencil) {
  if (Status s = CheckHandle(device, texture, "the viewed texture"); !s.ok()) return s;
  const ResourceFlags needed =
      depth_stencil ? ResourceFlags::kAllowDepthStencil : ResourceFlags::kAllowRenderTarget;
  if (HasAny(texture.GetDesc().Flags, needed)) return {};
  return make_error(Id::kTargetView, named("texture", texture.name()), " was created without ",
                    depth_stencil ? "kAllowDepthStencil" : "kAllowRenderTarget",
                    "; add the flag to its TextureDesc");
}

Status check_format(const DeviceImpl& device, const Texture& texture, bool depth_stencil,
                    Format format) {
  const TextureDesc& desc = texture.GetDesc();
  const FormatInfo info = GetFormatInfo(format);
  const bool fits = castable(desc.Format, format);
  const bool right_kind = depth_stencil
                              ? IsDepthFormat(format)
                              : !IsDepthFormat(format) && info.type != FormatClass::kTypeless &&
                                    info.type != FormatClass::kUnsupported;
  if (!fits || !right_kind) {
    return make_error(Id::kTargetView, "view format ", static_cast<uint32_t>(format), " of ",
                      named("texture", desc.Name), " with format ",
                      static_cast<uint32_t>(desc.Format), "; it must be ",
                      depth_stencil
                          ? "the depth format"
                          : "a typed format, FLOAT only for FLOAT and no SNORM for UNORM,",
                      " of that family");
  }
  if (device.backend->supports_target(format, false)) return {};
  return make_error(Id::kTargetFormat, "view format ", static_cast<uint32_t>(format), " of ",
                    named("texture", desc.Name), ", which this backend cannot draw to");
}

Result<runtime::TargetView> resolve(const Texture& texture, const AskedTarget& asked) {
  const TextureDesc& desc = texture.GetDesc();
  if (!asked.whole && asked.multisampled != (desc.SampleDesc.Count > 1)) {
    return make_error(Id::kSampleMismatch, named("texture", desc.Name), " has ",
                      desc.SampleDesc.Count, " samples and a view dimension ",
                      asked.multisampled ? "with" : "without", " MS");
  }
  const std::string name = named("texture", desc.Name);
  if (!asked.whole && asked.dimension != desc.Dimension) {
    return make_error(Id::kTargetView, name, " is a ", name_of(desc.Dimension),
                      " texture, and the view's dimension is of ", name_of(asked.dimension),
                      " ones");
  }
  TargetSlices slices = asked.whole ? TargetSlices() : asked.slices;
  if (asked.one_element) {
    slices.FirstArraySlice = 0;
    slices.ArraySize = 1;
  }
  if (slices.MipSlice >= desc.MipLevels) {
    return make_error(Id::kTargetView, "mip ", slices.MipSlice, " is outside ", name,
                      ", which has ", desc.MipLevels, " mips");
  }
  const MipExtent extent = get_mip_extent(desc, slices.MipSlice);
  const bool is_volume = desc.Dimension == ResourceDimension::kTexture3D;
  const uint32_t total = is_volume ? extent.depth : detail::array_size(desc);
  const uint32_t left = slices.FirstArraySlice < total ? total - slices.FirstArraySlice : 0;
  if (slices.ArraySize == 0xFFFFFFFFu) slices.ArraySize = left;
  if (slices.ArraySize == 0 || slices.ArraySize > left) {
    return make_error(Id::kTargetView, is_volume ? "slices " : "array elements ",
                      slices.FirstArraySlice, "..",
                      uint64_t{slices.FirstArraySlice} + slices.ArraySize, " are outside ", name,
                      ", which has ", total, is_volume ? " in that mip" : "");
  }
  runtime::TargetView view;
  view.format = asked.format;
  view.mip = slices.MipSlice;
  view.first_slice = slices.FirstArraySlice;
  view.slice_count = slices.ArraySize;
  view.width = extent.width;
  view.height = extent.height;
  view.samples = desc.SampleDesc.Count;
  view.is_volume = is_volume;
  return view;
}

Result<TargetSlot*> find_target(const DeviceImpl& device, CpuDescriptorHandle handle,
                                bool depth_stencil, const std::string& where) {
  const auto slot = device.find_slot(handle);
  const DescriptorHeapType type =
      depth_stencil ? DescriptorHeapType::kDsv : DescriptorHeapType::kRtv;
  if (slot && slot->type == type) return slot->target;
  return make_error(Id::kTargetHandle, where, ": handle ", hex(handle.ptr), describe_heap(slot),
                    "; it must be in one of ", depth_stencil ? "kDsv" : "kRtv");
}

Status write_target(const std::shared_ptr<DeviceImpl>& device, const Texture& texture,
                    const AskedTarget& asked_as_given, bool depth_stencil, DsvFlags flags,
                    CpuDescriptorHandle dest) {
  const std::string call = depth_stencil ? "CreateDepthStencilView" : "CreateRenderTargetView";
  if (!device) return make_error(Id::kNullHandle, call, " on an empty device");
  auto slot = find_target(*device, dest, depth_stencil, call);
  if (!slot.ok()) return slot.error();
  AskedTarget asked = asked_as_given;
  TargetSlot value;
  value.written = true;
  if (!texture) {
    value.is_null = true;
    value.view.format = asked.format;
    **slot = std::move(value);
    return {};
  }
  if (Status s = check_texture(device, texture, depth_stencil); !s.ok()) return s;
  const Format own = texture.GetDesc().Format;
  if (asked.format == Format::kUnknown) asked.format = depth_stencil ? GetDepthFormat(own) : own;
  if (Status s = check_format(*device, texture, depth_stencil, asked.format); !s.ok()) return s;
  auto view = resolve(texture, asked);
  if (!view.ok()) return view.error();
  value.view = *view;
  value.view.read_only_depth = HasAny(flags, DsvFlags::kReadOnlyDepth);
  value.view.read_only_stencil = HasAny(flags, DsvFlags::kReadOnlyStencil);
  value.texture = texture.impl();
  value.texture_name = texture.name();
  **slot = std::move(value);
  return {};
}

}  // namespace

Result<ReadTarget> read_target_slot(const DeviceImpl& device, CpuDescriptorHandle handle,
                                    bool depth_stencil, const std::string& where) {
  auto found = find_target(device, handle, depth_stencil, where);
  if (!found.ok()) return found.error();
  const TargetSlot& slot = **found;
  if (!slot.written) {
    return make_error(Id::kTargetHandle, where, ": no view was made at handle ", hex(handle.ptr));
  }
  ReadTarget out{slot.view, slot.texture, slot.texture_name};
  if (slot.is_null) return out;
  const auto texture = slot.texture.lock();
  if (!texture) {
    return make_error(Id::kTargetHandle, where, ": handle ", hex(handle.ptr), " is a view of ",
                      named("texture", slot.texture_name), ", which was freed");
  }
  out.view.texture = texture->memory;
  return out;
}

}  // namespace detail

using namespace detail;

Status Device::CreateRenderTargetView(const Texture& texture, const RenderTargetViewDesc& desc,
                                      CpuDescriptorHandle dest) const {
  using enum RtvDimension;
  const RtvDimension dimension = desc.ViewDimension;
  if (dimension > kTexture3D || (dimension != kUnknown && dimension < kTexture1D)) {
    return make_error(Id::kTargetView, "view dimension ", static_cast<uint32_t>(dimension),
                      "; it must be kUnknown or one of textures, 2 to 8");
  }
  AskedTarget asked = {
      desc.Format,
      dimension == kUnknown,
      dimension == kTexture1D || dimension == kTexture2D || dimension == kTexture2DMS,
      dimension == kTexture2DMS || dimension == kTexture2DMSArray,
      ResourceDimension::kTexture2D,
      desc.Texture2DArray};
  if (dimension == kTexture1D || dimension == kTexture1DArray) {
    asked.dimension = ResourceDimension::kTexture1D;
  }
  if (dimension == kTexture3D) asked.dimension = ResourceDimension::kTexture3D;
  return write_target(impl_, texture, asked, false, DsvFlags::kNone, dest);
}

Status Device::CreateRenderTargetView(const Texture& texture, CpuDescriptorHandle dest) const {
  return CreateRenderTargetView(texture, RenderTargetViewDesc(), dest);
}

Status Device::CreateDepthStencilView(const Texture& texture, const DepthStencilViewDesc& desc,
                                      CpuDescriptorHandle dest) const {
  if (desc.ViewDimension > DsvDimension::kTexture2DMSArray ||
      (desc.ViewDimension != DsvDimension::kUnknown &&
       desc.ViewDimension < DsvDimension::kTexture2D)) {
    return make_error(Id::kTargetView, "view dimension ", static_cast<uint32_t>(desc.ViewDimension),
                      "; it must be kUnknown, kTexture2D, kTexture2DArray, kTexture2DMS or "
                      "kTexture2DMSArray");
  }
  constexpr DsvFlags kKnown = DsvFlags::kReadOnlyDepth | DsvFlags::kReadOnlyStencil;
  if ((desc.Flags & ~kKnown) != DsvFlags::kNone) {
    return make_error(Id::kTargetView, "undefined flags ", hex(static_cast<uint32_t>(desc.Flags)));
  }
  const AskedTarget asked = {desc.Format,
                             desc.ViewDimension == DsvDimension::kUnknown,
                             desc.ViewDimension == DsvDimension::kTexture2D ||
                                 desc.ViewDimension == DsvDimension::kTexture2DMS,
                             desc.ViewDimension >= DsvDimension::kTexture2DMS,
                             ResourceDimension::kTexture2D,
                             desc.Texture2DArray};
  return write_target(impl_, texture, asked, true, desc.Flags, dest);
}

Status Device::CreateDepthStencilView(const Texture& texture, CpuDescriptorHandle dest) const {
  return CreateDepthStencilView(texture, DepthStencilViewDesc(), dest);
}

}  // namespace rtapi
