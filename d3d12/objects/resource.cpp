// SPDX-License-Identifier: MIT
#include "d3d12/objects/resource.h"

#include <algorithm>

#include <cstring>

#include <rtapi/upload.h>

#include "d3d12/objects/device.h"

namespace kaamos::d3d12 {

Resource::Resource(ID3D12Device* device, rtapi::Resource resource, const D3D12_RESOURCE_DESC1& desc,
                   const D3D12_HEAP_PROPERTIES& heap, D3D12_HEAP_FLAGS heap_flags,
                   const HeapPlace& place)
    : DeviceChild(device),
      resource_(std::move(resource)),
      desc_(desc),
      heap_(heap),
      heap_flags_(heap_flags),
      placed_in_(place.heap),
      shared_memory_(place.heap == nullptr ? place.memory : rtapi::Heap{}) {
  if (heap_.CreationNodeMask == 0) heap_.CreationNodeMask = 1;
  if (heap_.VisibleNodeMask == 0) heap_.VisibleNodeMask = 1;
  if (const rtapi::Texture texture = this->texture()) {
    desc_.MipLevels = texture.GetDesc().MipLevels;  // 0 asked for the full chain
  }
}

rtapi::Buffer Resource::buffer() const {
  const auto* buffer = std::get_if<rtapi::Buffer>(&resource_);
  return buffer != nullptr ? *buffer : rtapi::Buffer{};
}

rtapi::Texture Resource::texture() const {
  const auto* texture = std::get_if<rtapi::Texture>(&resource_);
  return texture != nullptr ? *texture : rtapi::Texture{};
}

bool Resource::cpu_sees_texels() const {
  return heap_.Type == D3D12_HEAP_TYPE_CUSTOM &&
         heap_.CPUPageProperty != D3D12_CPU_PAGE_PROPERTY_NOT_AVAILABLE;
}

// Mapped memory stays mapped, so that ranges and the count of Unmap do not matter. `*data` is not
// touched by a call that fails.
HRESULT Resource::Map(UINT subresource, const D3D12_RANGE* read_range, void** data) {
  const rtapi::Buffer buffer = this->buffer();
  if (!buffer) {
    // Texels of an unknown layout are read and written by the two calls below. [D3D12: Map]
    if (data == nullptr && cpu_sees_texels() && subresource < texture().subresource_count()) {
      return S_OK;
    }
    return fail(ErrorId::kMap,
                "texture \"" + texture().name() +
                    "\": only textures of custom heaps that the CPU sees are mapped, "
                    "with a null ppData.");
  }
  if (subresource != 0) {
    return fail(ErrorId::kMap, "buffer \"" + buffer.name() + "\": subresource " +
                                   std::to_string(subresource) + "; a buffer has only 0.");
  }
  if (read_range != nullptr && read_range->End > buffer.size()) {
    return fail(ErrorId::kMap, "buffer \"" + buffer.name() + "\": pReadRange ends at byte " +
                                   std::to_string(read_range->End) + " of " +
                                   std::to_string(buffer.size()) + ".");
  }
  const auto mapped = buffer.Map();
  if (!mapped) return fail(mapped.error());
  if (data != nullptr) *data = mapped->data();
  return S_OK;
}

HRESULT Resource::WriteToSubresource(UINT subresource, const D3D12_BOX* box, const void* source,
                                     UINT row_pitch, UINT slice_pitch) {
  return move_texels("WriteToSubresource", subresource, box, [&](const TexelRows& rows) {
    for (uint64_t z = 0; z < rows.slices; ++z) {
      for (uint64_t y = 0; y < rows.count; ++y) {
        std::memcpy(rows.at(y, z),
                    static_cast<const std::byte*>(source) + z * slice_pitch + y * row_pitch,
                    rows.bytes);
      }
    }
    return true;
  });
}

HRESULT Resource::ReadFromSubresource(void* dest, UINT row_pitch, UINT slice_pitch,
                                      UINT subresource, const D3D12_BOX* box) {
  return move_texels("ReadFromSubresource", subresource, box, [&](const TexelRows& rows) {
    for (uint64_t z = 0; z < rows.slices; ++z) {
      for (uint64_t y = 0; y < rows.count; ++y) {
        std::memcpy(static_cast<std::byte*>(dest) + z * slice_pitch + y * row_pitch, rows.at(y, z),
                    rows.bytes);
      }
    }
    return false;
  });
}

// Reads the whole subresource, lets `move` read or write rows of the box, and writes it back if
// they were written. In elements: blocks of block-compressed formats.
HRESULT Resource::move_texels(const char* call, UINT subresource, const D3D12_BOX* box,
                              const std::function<bool(const TexelRows&)>& move) {
  const rtapi::Texture texture = this->texture();
  if (!texture || !cpu_sees_texels() || subresource >= texture.subresource_count()) {
    return fail(ErrorId::kMap, std::string(call) + ": subresource " + std::to_string(subresource) +
                                   " of no texture of a custom heap that the CPU sees.");
  }
  const rtapi::Device& device = rtapi_device(this->device());
  std::vector<rtapi::PlacedSubresourceFootprint> layouts;
  std::vector<uint32_t> row_counts;
  std::vector<uint64_t> row_bytes;
  const auto total = device.GetCopyableFootprints(texture.GetDesc(), subresource, 1, 0, &layouts,
                                                  &row_counts, &row_bytes);
  if (!total) return fail(total.error());
  const rtapi::FormatInfo format = rtapi::GetFormatInfo(texture.GetDesc().Format);
  const rtapi::SubresourceFootprint& whole = layouts[0].Footprint;
  const UINT side = format.block_side;
  const D3D12_BOX all = {0, 0, 0, whole.Width, whole.Height, whole.Depth};
  const D3D12_BOX& b = box != nullptr ? *box : all;
  const bool inside = b.left <= b.right && b.right <= all.right && b.top <= b.bottom &&
                      b.bottom <= all.bottom && b.front <= b.back && b.back <= all.back &&
                      b.left % side == 0 && b.top % side == 0;
  // One empty side with others that are not is no box; an empty one moves nothing.
  const int empty_sides = (b.left == b.right) + (b.top == b.bottom) + (b.front == b.back);
  if (!inside || empty_sides == 1 || empty_sides == 2) {
    return fail(ErrorId::kMap, std::string(call) + ": the box (" + std::to_string(b.left) + ", " +
                                   std::to_string(b.top) + ", " + std::to_string(b.front) +
                                   ") to (" + std::to_string(b.right) + ", " +
                                   std::to_string(b.bottom) + ", " + std::to_string(b.back) +
                                   ") is not within " + std::to_string(all.right) + "x" +
                                   std::to_string(all.bottom) + "x" + std::to_string(all.back) +
                                   " texels, or empty on some sides only.");
  }
  if (empty_sides == 3) return S_OK;
  auto queue = device.CreateCommandQueue();
  if (!queue) return fail(queue.error());
  auto texels = rtapi::ReadbackTexture(device, *queue, texture, subresource);
  if (!texels) return fail(texels.error());
  TexelRows rows;
  rows.row_pitch = row_bytes[0];
  rows.slice_pitch = row_bytes[0] * row_counts[0];
  rows.first = texels->data() + b.front * rows.slice_pitch + b.top / side * rows.row_pitch +
               uint64_t{b.left} / side * format.bytes;
  rows.bytes = uint64_t{(b.right - b.left + side - 1) / side} * format.bytes;
  rows.count = (b.bottom - b.top + side - 1) / side;
  rows.slices = b.back - b.front;
  if (!move(rows)) return S_OK;
  return check(rtapi::UploadTexture(device, *queue, texture, subresource, *texels));
}

D3D12_RESOURCE_DESC Resource::GetDesc() {
  return {desc_.Dimension, desc_.Alignment, desc_.Width,      desc_.Height, desc_.DepthOrArraySize,
          desc_.MipLevels, desc_.Format,    desc_.SampleDesc, desc_.Layout, desc_.Flags};
}

D3D12_GPU_VIRTUAL_ADDRESS Resource::GetGPUVirtualAddress() {
  return buffer().GetGPUVirtualAddress();
}

HRESULT Resource::GetHeapProperties(D3D12_HEAP_PROPERTIES* properties, D3D12_HEAP_FLAGS* flags) {
  if (properties != nullptr) *properties = heap_;
  if (flags != nullptr) *flags = heap_flags_;
  return S_OK;
}

void Resource::rename(const std::string& name) {
  if (auto* buffer = std::get_if<rtapi::Buffer>(&resource_)) buffer->SetName(name);
  if (auto* texture = std::get_if<rtapi::Texture>(&resource_)) texture->SetName(name);
}

D3D12_RESOURCE_DESC1 with_sampler_feedback(const D3D12_RESOURCE_DESC& desc) {
  return {desc.Dimension,        desc.Alignment, desc.Width,  desc.Height,
          desc.DepthOrArraySize, desc.MipLevels, desc.Format, desc.SampleDesc,
          desc.Layout,           desc.Flags,     {}};
}

rtapi::Status check_buffer_desc(const D3D12_RESOURCE_DESC1& desc) {
  if (desc.Layout != D3D12_TEXTURE_LAYOUT_ROW_MAJOR || desc.Height != 1 ||
      desc.DepthOrArraySize != 1 || desc.MipLevels != 1 || desc.Format != DXGI_FORMAT_UNKNOWN ||
      desc.SampleDesc.Count != 1) {
    return make_error(
        ErrorId::kResource,
        "a buffer has Layout ROW_MAJOR (1), Height, DepthOrArraySize, MipLevels and "
        "SampleDesc.Count 1, and Format UNKNOWN (0); here: " +
            std::to_string(desc.Layout) + ", " + std::to_string(desc.Height) + ", " +
            std::to_string(desc.DepthOrArraySize) + ", " + std::to_string(desc.MipLevels) + ", " +
            std::to_string(desc.SampleDesc.Count) + ", " + std::to_string(desc.Format) + ".");
  }
  constexpr UINT kOfTextures =
      D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL | D3D12_RESOURCE_FLAG_ALLOW_SIMULTANEOUS_ACCESS;
  if ((desc.Flags & kOfTextures) != 0) {
    return make_error(ErrorId::kResource,
                      "a buffer's Flags are " + std::to_string(desc.Flags) +
                          "; ALLOW_DEPTH_STENCIL (2) and ALLOW_SIMULTANEOUS_ACCESS (32) are for "
                          "textures.");
  }
  if ((desc.Flags & D3D12_RESOURCE_FLAG_RAYTRACING_ACCELERATION_STRUCTURE) != 0 &&
      (desc.Flags & D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS) == 0) {
    return make_error(ErrorId::kResource,
                      "a buffer's Flags are " + std::to_string(desc.Flags) +
                          "; RAYTRACING_ACCELERATION_STRUCTURE (256) needs ALLOW_UNORDERED_ACCESS "
                          "(4), too.");
  }
  return {};
}

namespace {

// Whether a texture may be of rows that follow each other: one that adapters share. Nobody sees the
// rows, since such textures are not mapped. [D3D12: D3D12_RESOURCE_FLAG_ALLOW_CROSS_ADAPTER]
bool is_cross_adapter(const D3D12_RESOURCE_DESC1& desc) {
  return (desc.Flags & D3D12_RESOURCE_FLAG_ALLOW_CROSS_ADAPTER) != 0 &&
         desc.Dimension == D3D12_RESOURCE_DIMENSION_TEXTURE2D && desc.MipLevels == 1 &&
         desc.DepthOrArraySize == 1 && desc.SampleDesc.Count <= 1;
}

}  // namespace

rtapi::Result<rtapi::TextureDesc> texture_desc(const D3D12_RESOURCE_DESC1& desc) {
  if (desc.Width > UINT32_MAX) {
    return make_error(ErrorId::kResource,
                      "Width is " + std::to_string(desc.Width) + "; textures have up to 16384.");
  }
  const bool is_open = desc.Layout == D3D12_TEXTURE_LAYOUT_UNKNOWN ||
                       desc.Layout == D3D12_TEXTURE_LAYOUT_64KB_UNDEFINED_SWIZZLE ||
                       (desc.Layout == D3D12_TEXTURE_LAYOUT_ROW_MAJOR && is_cross_adapter(desc));
  if (!is_open) {
    return make_error(
        ErrorId::kResource,
        "Layout is " + std::to_string(desc.Layout) +
            "; textures are of D3D12_TEXTURE_LAYOUT_UNKNOWN (0) here, or of ROW_MAJOR "
            "(1) with ALLOW_CROSS_ADAPTER, two dimensions, one mip and one sample. "
            "Copy rows through an upload or readback buffer.");
  }
  rtapi::TextureDesc out;
  out.Dimension = static_cast<rtapi::ResourceDimension>(desc.Dimension);
  out.Width = static_cast<uint32_t>(desc.Width);
  out.Height = desc.Height;
  out.DepthOrArraySize = desc.DepthOrArraySize;
  out.MipLevels = desc.MipLevels;
  out.Format = static_cast<rtapi::Format>(desc.Format);
  out.SampleDesc = {std::max(desc.SampleDesc.Count, 1u), desc.SampleDesc.Quality};
  // Flags about sharing and simultaneous access change nothing where one queue executes at a time.
  out.Flags = static_cast<rtapi::ResourceFlags>(desc.Flags & 0xF);
  return out;
}

}  // namespace kaamos::d3d12
