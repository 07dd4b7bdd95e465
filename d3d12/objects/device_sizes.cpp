// SPDX-License-Identifier: MIT
// How much room resources take in heaps and in buffers.
#include <utility>

#include "d3d12/objects/device.h"
#include "d3d12/objects/resource.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint64_t kPlacement = D3D12_DEFAULT_RESOURCE_PLACEMENT_ALIGNMENT;

uint64_t round_up(uint64_t value, uint64_t to) {
  return (value + to - 1) / to * to;
}

}  // namespace

rtapi::Result<rtapi::ResourceAllocationInfo> allocation_info(const rtapi::Device& device,
                                                             const D3D12_RESOURCE_DESC1& desc) {
  if (desc.Dimension != D3D12_RESOURCE_DIMENSION_BUFFER) {
    const auto texture = texture_desc(desc);
    if (!texture) return texture.error();
    return rtapi::GetResourceAllocationInfo(device, *texture, desc.Alignment);
  }
  if (desc.Alignment != 0 && desc.Alignment != kPlacement) {
    return make_error(
        ErrorId::kResource,
        "Alignment of a buffer is " + std::to_string(desc.Alignment) + "; it is 0 or 65536.");
  }
  const uint64_t bytes = round_up(std::max<uint64_t>(desc.Width, 1), kPlacement);
  return rtapi::ResourceAllocationInfo{bytes, kPlacement};
}

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo2(
    UINT, UINT count, const D3D12_RESOURCE_DESC1* descs, D3D12_RESOURCE_ALLOCATION_INFO1* infos) {
  D3D12_RESOURCE_ALLOCATION_INFO all = {0, 1};
  for (UINT i = 0; i < count; ++i) {
    const auto info = allocation_info(device_, descs[i]);
    if (!info.ok()) {
      fail(info.error());
      return {UINT64_MAX, kPlacement};
    }
    const uint64_t offset = round_up(all.SizeInBytes, info->Alignment);
    if (infos != nullptr) infos[i] = {offset, info->Alignment, info->SizeInBytes};
    all.SizeInBytes = offset + info->SizeInBytes;
    all.Alignment = std::max(all.Alignment, info->Alignment);
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
