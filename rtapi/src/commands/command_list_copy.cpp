// SPDX-License-Identifier: MIT
//
// Barriers, copies and clears.
#include <cstring>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/resources/resource_impl.h"
#include "runtime/backend/copy_overlap.h"

namespace rtapi {

using namespace detail;

namespace {

template <class T>
bool is(const Resource& r) {
  return std::holds_alternative<T>(r);
}

Status check_resource(const std::shared_ptr<DeviceImpl>& device, const Resource& resource,
                      std::string_view what) {
  if (const auto* b = std::get_if<Buffer>(&resource)) return CheckHandle(device, *b, what);
  if (const auto* t = std::get_if<Texture>(&resource)) return CheckHandle(device, *t, what);
  return make_error(Id::kNullHandle, what, " is empty");
}

std::string name_of(const Resource& resource) {
  if (const auto* b = std::get_if<Buffer>(&resource)) return named("buffer", b->name());
  if (const auto* t = std::get_if<Texture>(&resource)) return named("texture", t->name());
  return "no resource";
}

Status check_transition(const ResourceBarrier& barrier) {
  const std::string name = name_of(barrier.Resource);
  if (barrier.StateBefore == barrier.StateAfter) {
    return make_error(Id::kBarrier, name, ": transition from state ",
                      hex(static_cast<uint32_t>(barrier.StateBefore)), " to itself");
  }
  const auto structure = ResourceStates::kRaytracingAccelerationStructure;
  const auto* buffer = std::get_if<Buffer>(&barrier.Resource);
  const bool holds_structures = buffer && buffer->GetDesc().InitialState == structure;
  if (holds_structures || HasAny(barrier.StateBefore | barrier.StateAfter, structure)) {
    return make_error(Id::kAccelerationStructureTransition, name,
                      ": a buffer keeps the state kRaytracingAccelerationStructure for life; order "
                      "builds and traces with UAV barriers");
  }
  if (buffer && !runtime::has_free_state(buffer->GetDesc().Heap)) {
    return make_error(Id::kBarrier, name, ": upload and readback buffers cannot leave their state");
  }
  const auto* texture = std::get_if<Texture>(&barrier.Resource);
  const uint32_t count = texture ? texture->subresource_count() : 1;
  if (barrier.Subresource != kResourceBarrierAllSubresources && barrier.Subresource >= count) {
    return make_error(Id::kBarrier, name, ": subresource ", barrier.Subresource,
                      " does not exist; there are ", count);
  }
  return {};
}

// One side of a texture copy: source or destination.
struct CopySide {
  runtime::TextureCopyPlace place;
  uint32_t size[3] = {0, 0, 0};  // texels of the subresource or footprint
  uint32_t samples = 1;
  Format format = Format::kUnknown;   // of the plane
  Format texture = Format::kUnknown;  // of the whole texture; kUnknown for buffers
  std::string name;

  // Texels to an element along an axis: more than one in blocks.
  uint32_t step(int axis) const { return axis < 2 ? GetFormatInfo(format).block_side : 1u; }
  uint32_t elements(int axis) const { return (size[axis] + step(axis) - 1) / step(axis); }
};

Result<CopySide> resolve_texture_side(const TextureCopyLocation& location, const char* which) {
  const Texture& texture = std::get<Texture>(location.pResource);
  const TextureDesc& desc = texture.GetDesc();
  CopySide side;
  side.name = concat(which, " ", named("texture", desc.Name));
  if (location.SubresourceIndex >= texture.subresource_count()) {
    return make_error(Id::kCopyRange, side.name, ": subresource ", location.SubresourceIndex,
                      " does not exist; there are ", texture.subresource_count());
  }
  side.place.texture = texture.impl()->memory;
  const SubresourcePlace place = subresource_place(desc, location.SubresourceIndex);
  side.place.mip = place.mip;
  side.place.array_element = place.array_element;
  side.place.plane = place.plane;
  const MipExtent extent = get_mip_extent(desc, side.place.mip);
  side.size[0] = extent.width;
  side.size[1] = extent.height;
  side.size[2] = extent.depth;
  side.samples = desc.SampleDesc.Count;
  side.format = runtime::plane_format(desc.Format, place.plane);
  side.texture = desc.Format;
  return side;
}

Result<CopySide> resolve_buffer_side(const TextureCopyLocation& location, const char* which) {
  const Buffer& buffer = std::get<Buffer>(location.pResource);
  const SubresourceFootprint& f = location.PlacedFootprint.Footprint;
  CopySide side;
  side.name = concat(which, " ", named("buffer", buffer.name()));
  const uint64_t offset = location.PlacedFootprint.Offset;
  const FormatInfo format = GetFormatInfo(f.Format);
  const uint64_t element = format.bytes;
  if (element == 0 || f.Width == 0 || f.Height == 0 || f.Depth == 0) {
    return make_error(Id::kCopyFootprint, side.name, ": the footprint has ", f.Width, "x", f.Height,
                      "x", f.Depth, " texels of format ", static_cast<uint32_t>(f.Format),
                      element == 0 ? ", which cannot be copied" : "; no size may be 0");
  }
  if (f.Width % format.block_side != 0 || f.Height % format.block_side != 0) {
    return make_error(Id::kCopyBlocks, side.name, ": the footprint has ", f.Width, "x", f.Height,
                      " texels of block-compressed format ", static_cast<uint32_t>(f.Format),
                      "; both must be multiples of ", int{format.block_side});
  }
  const uint64_t row_bytes = f.Width / format.block_side * element;
  if (offset % kTextureDataPlacementAlignment != 0 ||
      f.RowPitch % kTextureDataPitchAlignment != 0 || f.RowPitch < row_bytes) {
    return make_error(
        Id::kCopyFootprint, side.name, ": offset ", offset, " and row pitch ", f.RowPitch,
        " for rows of ", row_bytes,
        " bytes; the offset must be a multiple of 512, the pitch a multiple of 256 and "
        "at least ",
        row_bytes);
  }
  // Each factor is checked by itself, so that the product cannot overflow.
  const uint32_t slice_rows = f.Height / format.block_side;
  const uint64_t rows = uint64_t{slice_rows} * f.Depth;
  const uint64_t size = buffer.size();
  const bool fits = offset <= size && rows - 1 <= size / f.RowPitch &&
                    (rows - 1) * f.RowPitch + row_bytes <= size - offset;
  if (!fits) {
    return make_error(Id::kCopyRange, side.name, ": a footprint of ", rows, " rows of ", f.RowPitch,
                      " bytes from byte ", offset, " does not fit its ", size, " bytes");
  }
  side.place.buffer = buffer.impl()->memory;
  side.place.offset = offset;
  side.place.row_pitch = f.RowPitch;
  side.place.slice_pitch = uint64_t{f.RowPitch} * slice_rows;
  side.size[0] = f.Width;
  side.size[1] = f.Height;
  side.size[2] = f.Depth;
  side.format = f.Format;
  return side;
}

Result<CopySide> resolve_side(const std::shared_ptr<DeviceImpl>& device,
                              const TextureCopyLocation& location, const char* which) {
  if (Status s = check_resource(device, location.pResource, which); !s.ok()) return s.error();
  const bool texture = is<Texture>(location.pResource);
  if (texture != (location.Type == TextureCopyType::kSubresourceIndex)) {
    return make_error(Id::kCopyFormat, which, " is ", texture ? "a texture" : "a buffer",
                      ", its Type says otherwise");
  }
  return texture ? resolve_texture_side(location, which) : resolve_buffer_side(location, which);
}

// Formats of one family; or one of blocks and one of integers with as many bytes in an element.
// [D3D11.3 5.6: format conversion by copies]
bool can_copy(Format a, Format b) {
  if (format_family(a) == format_family(b)) return true;
  const FormatInfo one = GetFormatInfo(a), other = GetFormatInfo(b);
  if (one.bytes != other.bytes || (one.block_side == 1) == (other.block_side == 1)) return false;
  const FormatClass plain = one.block_side == 1 ? one.type : other.type;
  return plain == FormatClass::kUint || plain == FormatClass::kSint ||
         plain == FormatClass::kTypeless;
}

// Depth of 24 bits is no number of 32 bits: textures of another family do not take it.
bool splits_depth(const CopySide& to, const CopySide& from) {
  const auto has_24_bits = [](const CopySide& side) {
    return runtime::plane_bytes(side.texture, side.place.plane).count == 3;
  };
  return to.place.texture != nullptr && from.place.texture != nullptr &&
         (has_24_bits(to) || has_24_bits(from)) &&
         format_family(to.texture) != format_family(from.texture);
}

Status check_copy_formats(const CopySide& to, const CopySide& from) {
  if (can_copy(to.format, from.format) && !splits_depth(to, from)) return {};
  const FormatInfo a = GetFormatInfo(to.format), b = GetFormatInfo(from.format);
  return make_error(
      Id::kCopyFormat, "CopyTextureRegion: ", from.name, " has format ",
      static_cast<uint32_t>(from.format), " and ", to.name, " has format ",
      static_cast<uint32_t>(to.format), "; both must belong to one format family",
      a.block_side == b.block_side ? "" : ", or blocks go with integers of the same bytes");
}

Status check_copy_samples(const CopySide& to, const CopySide& from) {
  if (to.samples == from.samples) return {};
  return make_error(Id::kSampleMismatch, "CopyTextureRegion: ", from.name, " has ", from.samples,
                    " samples and ", to.name, " has ", to.samples,
                    "; both must have as many, or be resolved");
}

// Checks that no edge of a box, nor the place that it goes to, lies between blocks. The far edge
// may also be that of the subresource.
Status check_block_edges(const CopySide& side, int axis, uint32_t first, uint32_t last) {
  const uint32_t step = side.step(axis);
  if (first % step == 0 && (last % step == 0 || last == side.size[axis])) return {};
  return make_error(
      Id::kCopyBlocks, "CopyTextureRegion: on axis ", axis, ", texels ", first, "..", last, " of ",
      side.name, " (format ", static_cast<uint32_t>(side.format), ", size ", side.size[axis],
      ") are not whole blocks; both must be multiples of ", step, ", or the second the size");
}

Status check_copy_heaps(const Buffer& dest, const Buffer& source) {
  if (dest.GetDesc().Heap == HeapType::kUpload) {
    return make_error(Id::kCopyHeap, "dest ", named("buffer", dest.name()),
                      " is on the upload heap, which commands cannot write");
  }
  if (source.GetDesc().Heap == HeapType::kReadback) {
    return make_error(Id::kCopyHeap, "source ", named("buffer", source.name()),
                      " is on the readback heap, which commands cannot read");
  }
  const auto structure = ResourceStates::kRaytracingAccelerationStructure;
  for (const Buffer* b : {&dest, &source}) {
    if (b->GetDesc().InitialState == structure) {
      return make_error(Id::kCopyHeap, named("buffer", b->name()),
                        " holds acceleration structures; use CopyRaytracingAccelerationStructure");
    }
  }
  return {};
}

}  // namespace

void CommandList::ResourceBarrier(std::span<const rtapi::ResourceBarrier> barriers) {
  if (!impl_ || !impl_->check_open("ResourceBarrier")) return;
  for (const auto& barrier : barriers) {
    if (barrier.Type > ResourceBarrierType::kUav) {
      impl_->fail(make_error(Id::kBarrier, "type ", static_cast<uint32_t>(barrier.Type),
                             "; it must be kTransition, kAliasing or kUav"));
      continue;
    }
    const bool transition = barrier.Type == ResourceBarrierType::kTransition;
    Status s;
    if (transition || !is<std::monostate>(barrier.Resource)) {
      s = check_resource(impl_->device, barrier.Resource, "ResourceBarrier: the resource");
    }
    if (s.ok() && !is<std::monostate>(barrier.ResourceAfter)) {
      s = check_resource(impl_->device, barrier.ResourceAfter, "ResourceBarrier: the one after");
    }
    if (s.ok() && transition) s = check_transition(barrier);
    if (!s.ok()) {
      impl_->fail(s.error());
      continue;
    }
    runtime::BarrierCommand command;
    command.kind = transition ? runtime::BarrierCommand::Kind::kTransition
                              : runtime::BarrierCommand::Kind::kUav;
    if (barrier.Type == ResourceBarrierType::kAliasing) {  // between any two resources
      impl_->record(std::move(command));
      continue;
    }
    if (const auto* b = std::get_if<Buffer>(&barrier.Resource)) command.buffer = b->impl()->memory;
    if (const auto* t = std::get_if<Texture>(&barrier.Resource)) {
      command.texture = t->impl()->memory;
      command.subresource = barrier.Subresource;
    }
    command.before = barrier.StateBefore;
    command.after = barrier.StateAfter;
    impl_->record(std::move(command));
  }
}

void CommandList::CopyBufferRegion(const Buffer& dest, uint64_t dest_offset, const Buffer& source,
                                   uint64_t source_offset, uint64_t size) {
  if (!impl_ || !impl_->check_open("CopyBufferRegion")) return;
  if (Status s = CheckHandle(impl_->device, dest, "CopyBufferRegion: dest"); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (Status s = CheckHandle(impl_->device, source, "CopyBufferRegion: source"); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (Status s = check_copy_heaps(dest, source); !s.ok()) return impl_->fail(s.error());
  auto outside = [size](const Buffer& b, uint64_t offset) {
    return offset > b.size() || size > b.size() - offset;
  };
  if (outside(dest, dest_offset) || outside(source, source_offset)) {
    const bool at_dest = outside(dest, dest_offset);
    const Buffer& b = at_dest ? dest : source;
    return impl_->fail(make_error(Id::kCopyRange, "CopyBufferRegion: ", size, " bytes from byte ",
                                  at_dest ? dest_offset : source_offset, " on do not fit in ",
                                  at_dest ? "dest " : "source ", named("buffer", b.name()),
                                  ", which has ", b.size(), " bytes"));
  }
  const bool overlap =
      dest == source && dest_offset < source_offset + size && source_offset < dest_offset + size;
  if (overlap && size != 0) {
    return impl_->fail(make_error(Id::kCopyOverlap, "CopyBufferRegion: ", size, " bytes from byte ",
                                  source_offset, " to byte ", dest_offset, " of ",
                                  named("buffer", dest.name())));
  }
  if (size == 0) return;
  impl_->record(runtime::CopyBufferCommand{dest.impl()->memory, dest_offset, source.impl()->memory,
                                           source_offset, size});
}

void CommandList::CopyTextureRegion(const TextureCopyLocation& dest, uint32_t x, uint32_t y,
                                    uint32_t z, const TextureCopyLocation& source, const Box* box) {
  if (!impl_ || !impl_->check_open("CopyTextureRegion")) return;
  auto to = resolve_side(impl_->device, dest, "dest");
  if (!to.ok()) return impl_->fail(to.error());
  auto from = resolve_side(impl_->device, source, "source");
  if (!from.ok()) return impl_->fail(from.error());
  if (!to->place.texture && !from->place.texture) {
    return impl_->fail(make_error(Id::kCopyFormat,
                                  "CopyTextureRegion: both sides are buffers; use "
                                  "CopyBufferRegion"));
  }
  if (Status s = check_copy_formats(*to, *from); !s.ok()) return impl_->fail(s.error());
  if (Status s = check_copy_samples(*to, *from); !s.ok()) return impl_->fail(s.error());
  const Box whole = {0, 0, 0, from->size[0], from->size[1], from->size[2]};
  const Box& b = box ? *box : whole;
  const uint32_t first[3] = {b.left, b.top, b.front};
  const uint32_t last[3] = {b.right, b.bottom, b.back};
  const uint32_t target[3] = {x, y, z};
  runtime::CopyTextureCommand command;
  for (int i = 0; i < 3; ++i) {
    if (last[i] <= first[i]) return;  // empty boxes copy nothing [D3D12: CopyTextureRegion]
    if (Status s = check_block_edges(*from, i, first[i], last[i]); !s.ok()) {
      return impl_->fail(s.error());
    }
    if (Status s = check_block_edges(*to, i, target[i], to->size[i]); !s.ok()) {
      return impl_->fail(s.error());
    }
    // From here on in elements.
    const uint32_t end = (last[i] - 1) / from->step(i) + 1;
    from->place.origin[i] = first[i] / from->step(i);
    to->place.origin[i] = target[i] / to->step(i);
    command.extent[i] = end - from->place.origin[i];
    if (end > from->elements(i) || to->place.origin[i] > to->elements(i) ||
        command.extent[i] > to->elements(i) - to->place.origin[i]) {
      return impl_->fail(make_error(Id::kCopyRange, "CopyTextureRegion: on axis ", i, ", texels ",
                                    first[i], "..", last[i], " of ", from->name, " (size ",
                                    from->size[i], ") do not fit at ", target[i], " of ", to->name,
                                    " (size ", to->size[i], ")"));
    }
  }
  if (runtime::overlap(to->place, from->place, command.extent)) {
    return impl_->fail(make_error(Id::kCopyOverlap, "CopyTextureRegion: texels ", first[0], "..",
                                  last[0], " x ", first[1], "..", last[1], " x ", first[2], "..",
                                  last[2], " overlap those at ", x, ", ", y, ", ", z,
                                  " of the same subresource of ", to->name));
  }
  command.dest = std::move(to->place);
  command.source = std::move(from->place);
  impl_->record(std::move(command));
}

void CommandList::CopyResource(const Resource& dest, const Resource& source) {
  if (!impl_ || !impl_->check_open("CopyResource")) return;
  for (const Resource* r : {&dest, &source}) {
    if (Status s = check_resource(impl_->device, *r,
                                  r == &dest ? "CopyResource: dest" : "CopyResource: source");
        !s.ok()) {
      return impl_->fail(s.error());
    }
  }
  if (is<Buffer>(dest) && is<Buffer>(source)) {
    const Buffer& to = std::get<Buffer>(dest);
    const Buffer& from = std::get<Buffer>(source);
    if (to.size() != from.size()) {
      return impl_->fail(make_error(Id::kCopyFormat, "CopyResource: ", name_of(dest), " has ",
                                    to.size(), " bytes, but ", name_of(source), " has ",
                                    from.size()));
    }
    return CopyBufferRegion(to, 0, from, 0, to.size());
  }
  if (!is<Texture>(dest) || !is<Texture>(source)) {
    return impl_->fail(make_error(Id::kCopyFormat, "CopyResource: ", name_of(dest), " and ",
                                  name_of(source), " must both be buffers or both be textures"));
  }
  const TextureDesc& a = std::get<Texture>(dest).GetDesc();
  const TextureDesc& b = std::get<Texture>(source).GetDesc();
  bool same_size = a.MipLevels == b.MipLevels && a.DepthOrArraySize == b.DepthOrArraySize;
  // Blocks may go to texels: the other texture then has a quarter of the size.
  const bool same_blocks = GetFormatInfo(a.Format).block_side == GetFormatInfo(b.Format).block_side;
  for (uint32_t mip = 0; same_size && mip < a.MipLevels; ++mip) {
    same_size = same_blocks ? get_mip_extent(a, mip) == get_mip_extent(b, mip)
                            : get_mip_elements(a, mip) == get_mip_elements(b, mip);
  }
  if (a.Dimension != b.Dimension || !same_size) {
    return impl_->fail(make_error(Id::kCopyFormat, "CopyResource: ", name_of(dest), " and ",
                                  name_of(source), " differ in dimension, size or mip levels"));
  }
  const uint32_t count = std::get<Texture>(dest).subresource_count();
  for (uint32_t i = 0; i < count; ++i) {
    CopyTextureRegion({std::get<Texture>(dest), i}, 0, 0, 0, {std::get<Texture>(source), i});
  }
}

namespace {

// Finds the view that the CPU handle names, and checks that it fits the resource. The GPU handle
// is for drivers that read it from a heap: it must be in one that shaders see.
Result<runtime::ClearUavCommand> resolve_clear(CommandListImpl& list, GpuDescriptorHandle gpu,
                                               CpuDescriptorHandle cpu, const Resource& resource,
                                               std::span<const Rect> rects) {
  const auto slot = list.device->find_slot(cpu);
  if (!slot || slot->type != DescriptorHeapType::kCbvSrvUav) {
    return make_error(Id::kClearView, "the CPU handle ", hex(cpu.ptr),
                      " is not in a live CBV/SRV/UAV heap");
  }
  const auto seen = list.device->find_slot(gpu);
  if (!seen || seen->type != DescriptorHeapType::kCbvSrvUav) {
    return make_error(Id::kClearView, "the GPU handle ", hex(gpu.ptr),
                      " is not in a CBV/SRV/UAV heap that shaders see");
  }
  runtime::ClearUavCommand command;
  std::memcpy(&command.view, slot->slot, sizeof command.view);
  command.whole = rects.empty();
  if (command.view.kind == shader::DescriptorKind::kNull) return command;
  if (command.view.access != shader::DescriptorAccess::kUnorderedAccess) {
    return make_error(Id::kClearView, "the descriptor is not an unordered access view");
  }
  if (Status s = check_resource(list.device, resource, "the cleared resource"); !s.ok()) {
    return s.error();
  }
  const bool texture_view = command.view.kind == shader::DescriptorKind::kTexture;
  if (texture_view != is<Texture>(resource)) {
    return make_error(Id::kClearView, "the descriptor is a view of a ",
                      texture_view ? "texture" : "buffer", ", but the resource is ",
                      name_of(resource));
  }
  if (const auto* buffer = std::get_if<Buffer>(&resource)) {
    const uint64_t offset = command.view.address - buffer->GetGPUVirtualAddress();
    if (offset > buffer->size() || command.view.size_bytes > buffer->size() - offset) {
      return make_error(Id::kClearView, "the view is not of ", name_of(resource));
    }
    command.resource = buffer->impl()->memory;
  } else {
    command.resource = std::get<Texture>(resource).impl()->memory;
  }
  for (const Rect& rect : rects) {
    const Rect cut = {std::max(rect.left, 0), std::max(rect.top, 0), rect.right, rect.bottom};
    if (cut.left < cut.right && cut.top < cut.bottom) command.rects.push_back(cut);
  }
  return command;
}

void record_clear(CommandListImpl& list, const char* call, bool is_float, GpuDescriptorHandle gpu,
                  CpuDescriptorHandle cpu, const Resource& resource, const void* values,
                  std::span<const Rect> rects) {
  if (!list.check_open(call)) return;
  auto command = resolve_clear(list, gpu, cpu, resource, rects);
  if (!command.ok()) return list.fail(command.error());
  if (!values) return list.fail(make_error(Id::kClearView, call, ": values is a null pointer"));
  if (command->view.kind == shader::DescriptorKind::kNull) return;
  if (!command->whole && command->rects.empty()) return;
  command->is_float = is_float;
  std::memcpy(command->values, values, sizeof command->values);
  list.record(std::move(*command));
}

}  // namespace

void CommandList::ClearUnorderedAccessViewUint(GpuDescriptorHandle gpu, CpuDescriptorHandle cpu,
                                               const Resource& resource, const uint32_t values[4],
                                               std::span<const Rect> rects) {
  if (!impl_) return;
  record_clear(*impl_, "ClearUnorderedAccessViewUint", false, gpu, cpu, resource, values, rects);
}

void CommandList::ClearUnorderedAccessViewFloat(GpuDescriptorHandle gpu, CpuDescriptorHandle cpu,
                                                const Resource& resource, const float values[4],
                                                std::span<const Rect> rects) {
  if (!impl_) return;
  record_clear(*impl_, "ClearUnorderedAccessViewFloat", true, gpu, cpu, resource, values, rects);
}

// The values wait in a buffer of the upload heap, and are copied in order.
void CommandList::WriteBufferImmediate(std::span<const WriteBufferImmediateParameter> parameters,
                                       std::span<const WriteBufferImmediateMode> modes) {
  if (!impl_ || !impl_->check_open("WriteBufferImmediate")) return;
  if (parameters.empty()) return;
  if (!modes.empty() && modes.size() != parameters.size()) {
    return impl_->fail(make_error(Id::kWriteImmediate, "WriteBufferImmediate: ", modes.size(),
                                  " modes for ", parameters.size(), " values"));
  }
  for (const WriteBufferImmediateMode mode : modes) {
    if (mode > WriteBufferImmediateMode::kMarkerOut) {
      return impl_->fail(make_error(Id::kWriteImmediate, "WriteBufferImmediate: mode ",
                                    static_cast<uint32_t>(mode), "; it must be 0, 1 or 2"));
    }
  }
  std::vector<std::shared_ptr<runtime::BackendBuffer>> targets;
  std::vector<uint64_t> offsets;
  for (const auto& [dest, value] : parameters) {
    const auto found = impl_->device->addresses.find(dest);
    const auto owner = found ? found->owner.lock() : nullptr;
    if (dest % sizeof value != 0 || !owner || found->heap == HeapType::kUpload ||
        !impl_->device->addresses.contains(dest, sizeof value)) {
      return impl_->fail(
          make_error(Id::kWriteImmediate, "WriteBufferImmediate: value ", targets.size(),
                     " goes to ", hex(dest), " in ", impl_->device->describe_address(dest),
                     "; it must be a multiple of 4 in a buffer of the default or readback heap"));
    }
    targets.push_back(std::static_pointer_cast<const BufferImpl>(owner)->memory);
    offsets.push_back(dest - found->address);
  }
  const auto values = Device(impl_->device)
                          .CreateBuffer({.SizeInBytes = parameters.size() * sizeof(uint32_t),
                                         .Heap = HeapType::kUpload});
  if (!values.ok()) return impl_->fail(values.error());
  for (size_t i = 0; i < parameters.size(); ++i) {
    const uint64_t from = i * sizeof(uint32_t);
    std::memcpy(values->impl()->memory->host() + from, &parameters[i].Value, sizeof(uint32_t));
    runtime::CopyBufferCommand command;
    command.dest = targets[i];
    command.dest_offset = offsets[i];
    command.source = values->impl()->memory;
    command.source_offset = from;
    command.size_bytes = sizeof(uint32_t);
    command.immediate = true;
    impl_->record(std::move(command));
  }
}

}  // namespace rtapi
