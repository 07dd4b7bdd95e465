// SPDX-License-Identifier: MIT
// How much room resources take in heaps and in buffers.
#include <utility>

#include "d3d12/objects/device.h"
#include "d3d12/objects/resource.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint64_t kPlacement = D3D12_DEFAULT_RESOURCE_PLACEMENT_ALIGNMENT;
constexpr uint64_t kSmallPlacement = D3D12_SMALL_RESOURCE_PLACEMENT_ALIGNMENT;

uint64_t round_up(uint64_t value, uint64_t to) {
  return (value + to - 1) / to * to;
}

// Bytes of a resource's contents: every sample of every subresource, without padding.
rtapi::Result<uint64_t> content_bytes(const rtapi::Device& device,
                                      const D3D12_RESOURCE_DESC1& desc) {
  if (desc.Dimension == D3D12_RESOURCE_DIMENSION_BUFFER) return uint64_t{desc.Width};
  auto texture = texture_desc(desc);
  if (!texture) return texture.error();
  // A chain of mips that rtapi is to count itself has at most 15 levels.
  const uint32_t slices =
      desc.Dimension == D3D12_RESOURCE_DIMENSION_TEXTURE3D ? 1 : desc.DepthOrArraySize;
  uint32_t mips = desc.MipLevels;
  for (uint32_t side = std::max<uint32_t>({static_cast<uint32_t>(desc.Width), desc.Height, 1});
       desc.MipLevels == 0 && side != 0; side /= 2) {
    ++mips;
  }
  const uint32_t planes = rtapi::HasStencil(rtapi::GetDepthFormat(texture->Format)) ? 2 : 1;
  const uint32_t samples = std::exchange(texture->SampleDesc, {}).Count;
  std::vector<rtapi::PlacedSubresourceFootprint> layouts;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> row_bytes;
  const auto padded = device.GetCopyableFootprints(*texture, 0, mips * slices * planes, 0, &layouts,
                                                   &rows, &row_bytes);
  if (!padded) return padded.error();
  uint64_t bytes = 0;
  for (size_t i = 0; i < layouts.size(); ++i) {
    bytes += row_bytes[i] * rows[i] * layouts[i].Footprint.Depth * samples;
  }
  return bytes;
}

// Tiles of 4 KiB, of sides as equal as they can be, that the most detailed mip takes; of 64 KiB
// with several samples. [D3D12: D3D12_RESOURCE_DESC, Alignment]
uint64_t tiles_of_first_mip(const D3D12_RESOURCE_DESC1& desc) {
  const rtapi::FormatInfo format = rtapi::GetFormatInfo(static_cast<rtapi::Format>(desc.Format));
  const uint64_t block = std::max<uint64_t>(format.block_side, 1);
  const bool volume = desc.Dimension == D3D12_RESOURCE_DIMENSION_TEXTURE3D;
  const int axes = volume ? 3 : desc.Dimension == D3D12_RESOURCE_DIMENSION_TEXTURE1D ? 1 : 2;
  const uint64_t elements[3] = {(desc.Width + block - 1) / block, (desc.Height + block - 1) / block,
                                volume ? desc.DepthOrArraySize : 1ull};
  uint64_t side[3] = {1, 1, 1};
  uint64_t bytes = std::max<uint64_t>(format.bytes, 1) * std::max(desc.SampleDesc.Count, 1u);
  const uint64_t tile = desc.SampleDesc.Count > 1 ? kPlacement : kSmallPlacement;
  for (int axis = 0; bytes < tile; axis = (axis + 1) % axes, bytes *= 2) side[axis] *= 2;
  uint64_t tiles = 1;
  for (int axis = 0; axis < 3; ++axis) tiles *= (elements[axis] + side[axis] - 1) / side[axis];
  return tiles;
}

}  // namespace

// Textures that are no targets may have 4 KiB if their
// first mip takes up to 16 tiles of that size; multisampled ones have 4 MiB, or 64 KiB if it takes
// up to 64. [D3D12: D3D12_RESOURCE_DESC, Alignment]
rtapi::Result<uint64_t> placement_alignment(const D3D12_RESOURCE_DESC1& desc) {
  const bool plain = desc.Dimension != D3D12_RESOURCE_DIMENSION_BUFFER &&
                     (desc.Flags & (D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET |
                                    D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL)) == 0;
  constexpr uint64_t kMultisampled = D3D12_DEFAULT_MSAA_RESOURCE_PLACEMENT_ALIGNMENT;
  if (desc.SampleDesc.Count > 1) {
    if (desc.Alignment == 0 || desc.Alignment == kMultisampled) return kMultisampled;
    if (desc.Alignment == kPlacement && tiles_of_first_mip(desc) <= kMultisampled / kPlacement) {
      return kPlacement;
    }
    return make_error(ErrorId::kResource,
                      "Alignment is " + std::to_string(desc.Alignment) +
                          " with several samples; it is 0, 4194304, or 65536 for textures whose "
                          "first mip takes up to 64 tiles of 65536 bytes.");
  }
  if (desc.Alignment == 0 || desc.Alignment == kPlacement) return kPlacement;
  if (desc.Alignment == kSmallPlacement && plain &&
      tiles_of_first_mip(desc) <= kPlacement / kSmallPlacement) {
    return kSmallPlacement;
  }
  return make_error(ErrorId::kResource,
                    "Alignment is " + std::to_string(desc.Alignment) +
                        "; it is 0, 65536, or 4096 for textures that are no targets and whose "
                        "first mip takes up to 16 tiles of 4096 bytes.");
}

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo2(
    UINT, UINT count, const D3D12_RESOURCE_DESC1* descs, D3D12_RESOURCE_ALLOCATION_INFO1* infos) {
  D3D12_RESOURCE_ALLOCATION_INFO all = {0, 1};
  for (UINT i = 0; i < count; ++i) {
    const auto bytes = content_bytes(device_, descs[i]);
    const auto alignment = bytes.ok() ? placement_alignment(descs[i]) : bytes;
    if (!alignment.ok()) {
      fail(alignment.error());
      return {UINT64_MAX, kPlacement};
    }
    const uint64_t size = round_up(std::max<uint64_t>(*bytes, 1), *alignment);
    const uint64_t offset = round_up(all.SizeInBytes, *alignment);
    if (infos != nullptr) infos[i] = {offset, *alignment, size};
    all.SizeInBytes = offset + size;
    all.Alignment = std::max(all.Alignment, *alignment);
  }
  all.SizeInBytes = round_up(all.SizeInBytes, all.Alignment);
  return all;
}

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo1(
    UINT visible_mask, UINT count, const D3D12_RESOURCE_DESC* descs,
    D3D12_RESOURCE_ALLOCATION_INFO1* infos) {
  std::vector<D3D12_RESOURCE_DESC1> descs1;
  for (UINT i = 0; i < count; ++i) descs1.push_back(with_sampler_feedback(descs[i]));
  return GetResourceAllocationInfo2(visible_mask, count, descs1.data(), infos);
}

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo(UINT visible_mask, UINT count,
                                                                 const D3D12_RESOURCE_DESC* descs) {
  return GetResourceAllocationInfo1(visible_mask, count, descs, nullptr);
}

void Device::GetCopyableFootprints1(const D3D12_RESOURCE_DESC1* desc, UINT first, UINT count,
                                    UINT64 base_offset, D3D12_PLACED_SUBRESOURCE_FOOTPRINT* layouts,
                                    UINT* row_counts, UINT64* row_sizes, UINT64* total) {
  if (desc == nullptr) return;
  std::vector<rtapi::PlacedSubresourceFootprint> placed;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> bytes;
  rtapi::Result<uint64_t> end = uint64_t{0};
  const bool is_buffer = desc->Dimension == D3D12_RESOURCE_DIMENSION_BUFFER;
  if (const auto checked = check_buffer_desc(*desc); is_buffer && !checked.ok()) {
    end = checked.error();
  } else if (is_buffer) {
    // One row of bytes.
    rtapi::PlacedSubresourceFootprint footprint;
    footprint.Offset = base_offset;
    footprint.Footprint = {rtapi::Format::kUnknown, static_cast<uint32_t>(desc->Width), 1, 1,
                           static_cast<uint32_t>(round_up(desc->Width, 256))};
    placed.push_back(footprint);
    rows.push_back(1);
    bytes.push_back(desc->Width);
    end = desc->Width;
  } else if (auto texture = texture_desc(*desc); !texture) {
    end = texture.error();
  } else {
    texture->SampleDesc = {};  // the layout is that of one sample
    end =
        device_.GetCopyableFootprints(*texture, first, count, base_offset, &placed, &rows, &bytes);
  }
  // D3D12 reports a failure as all bits set.
  if (!end) fail(end.error());
  static_assert(sizeof(rtapi::PlacedSubresourceFootprint) ==
                sizeof(D3D12_PLACED_SUBRESOURCE_FOOTPRINT));
  for (UINT i = 0; i < count; ++i) {
    const bool known = end.ok() && i < placed.size();
    if (layouts != nullptr) {
      std::memset(&layouts[i], 0xFF, sizeof(layouts[i]));
      if (known) std::memcpy(&layouts[i], &placed[i], sizeof(layouts[i]));
    }
    if (row_counts != nullptr) row_counts[i] = known ? rows[i] : UINT32_MAX;
    if (row_sizes != nullptr) row_sizes[i] = known ? bytes[i] : UINT64_MAX;
  }
  if (total != nullptr) *total = end.ok() ? *end : UINT64_MAX;
}

void Device::GetCopyableFootprints(const D3D12_RESOURCE_DESC* desc, UINT first, UINT count,
                                   UINT64 base_offset, D3D12_PLACED_SUBRESOURCE_FOOTPRINT* layouts,
                                   UINT* row_counts, UINT64* row_sizes, UINT64* total) {
  if (desc == nullptr) return;
  const D3D12_RESOURCE_DESC1 desc1 = with_sampler_feedback(*desc);
  GetCopyableFootprints1(&desc1, first, count, base_offset, layouts, row_counts, row_sizes, total);
}

}  // namespace kaamos::d3d12
