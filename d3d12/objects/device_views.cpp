// SPDX-License-Identifier: MIT
// Descriptor heaps, views and samplers. These calls return nothing in D3D12: what they refuse is
// reported, and the descriptor stays as it was.
#include "d3d12/objects/descriptor_heap.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/resource.h"
#include "d3d12/objects/view_descs.h"

namespace kaamos::d3d12 {

namespace {

rtapi::CpuDescriptorHandle slot(D3D12_CPU_DESCRIPTOR_HANDLE handle) {
  return {handle.ptr};
}

}  // namespace

HRESULT Device::CreateDescriptorHeap(const D3D12_DESCRIPTOR_HEAP_DESC* desc, REFIID riid,
                                     void** heap) {
  if (heap != nullptr) *heap = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateDescriptorHeap: pDesc.");
  auto made =
      device_.CreateDescriptorHeap({.Type = static_cast<rtapi::DescriptorHeapType>(desc->Type),
                                    .NumDescriptors = desc->NumDescriptors,
                                    .Flags = static_cast<rtapi::DescriptorHeapFlags>(desc->Flags)});
  if (!made) return fail(made.error());
  return hand_out(new DescriptorHeap(this, *made, *desc), riid, heap);
}

void Device::CreateConstantBufferView(const D3D12_CONSTANT_BUFFER_VIEW_DESC* desc,
                                      D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  rtapi::ConstantBufferViewDesc view;
  if (desc != nullptr) view = {desc->BufferLocation, desc->SizeInBytes};
  check(device_.CreateConstantBufferView(view, slot(dest)));
}

void Device::CreateShaderResourceView(ID3D12Resource* resource,
                                      const D3D12_SHADER_RESOURCE_VIEW_DESC* desc,
                                      D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  if (desc != nullptr) {
    const auto view = view_desc(*desc);
    if (!view) {
      fail(view.error());
      return;
    }
    check(device_.CreateShaderResourceView(rtapi_resource(resource), *view, slot(dest)));
  } else if (const rtapi::Texture texture = rtapi_texture(resource)) {
    check(device_.CreateShaderResourceView(texture, slot(dest)));
  } else {
    fail(ErrorId::kView,
         "CreateShaderResourceView: pDesc is null, which only a texture's view of "
         "itself may have.");
  }
}

void Device::CreateUnorderedAccessView(ID3D12Resource* resource, ID3D12Resource* counter,
                                       const D3D12_UNORDERED_ACCESS_VIEW_DESC* desc,
                                       D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  if (desc != nullptr) {
    const auto view = view_desc(*desc);
    if (!view) {
      fail(view.error());
    } else if (counter != nullptr) {
      check(device_.CreateUnorderedAccessView(rtapi_resource(resource), rtapi_buffer(counter),
                                              *view, slot(dest)));
    } else {
      check(device_.CreateUnorderedAccessView(rtapi_resource(resource), *view, slot(dest)));
    }
  } else if (const rtapi::Texture texture = rtapi_texture(resource)) {
    check(device_.CreateUnorderedAccessView(texture, slot(dest)));
  } else {
    fail(ErrorId::kView,
         "CreateUnorderedAccessView: pDesc is null, which only a texture's view of "
         "itself may have.");
  }
}

void Device::CreateRenderTargetView(ID3D12Resource* resource,
                                    const D3D12_RENDER_TARGET_VIEW_DESC* desc,
                                    D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  const rtapi::Texture texture = rtapi_texture(resource);
  if (desc == nullptr) {
    check(device_.CreateRenderTargetView(texture, slot(dest)));
    return;
  }
  const auto view = view_desc(*desc);
  check(view.ok() ? device_.CreateRenderTargetView(texture, *view, slot(dest))
                  : rtapi::Status(view.error()));
}

void Device::CreateDepthStencilView(ID3D12Resource* resource,
                                    const D3D12_DEPTH_STENCIL_VIEW_DESC* desc,
                                    D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  const rtapi::Texture texture = rtapi_texture(resource);
  if (desc == nullptr) {
    check(device_.CreateDepthStencilView(texture, slot(dest)));
    return;
  }
  const auto view = view_desc(*desc);
  check(view.ok() ? device_.CreateDepthStencilView(texture, *view, slot(dest))
                  : rtapi::Status(view.error()));
}

void Device::CreateSampler(const D3D12_SAMPLER_DESC* desc, D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  if (desc == nullptr) {
    fail(ErrorId::kNullPointer, "CreateSampler: pDesc.");
    return;
  }
  check(device_.CreateSampler(sampler_desc(*desc), slot(dest)));
}

void Device::CreateSampler2(const D3D12_SAMPLER_DESC2* desc, D3D12_CPU_DESCRIPTOR_HANDLE dest) {
  if (desc == nullptr) {
    fail(ErrorId::kNullPointer, "CreateSampler2: pDesc.");
    return;
  }
  if (desc->Flags != D3D12_SAMPLER_FLAG_NONE) {
    fail(ErrorId::kView,
         "CreateSampler2: Flags is " + std::to_string(desc->Flags) + "; only 0 is offered.");
    return;
  }
  D3D12_SAMPLER_DESC plain = {
      desc->Filter,     desc->AddressU,      desc->AddressV,       desc->AddressW,
      desc->MipLODBias, desc->MaxAnisotropy, desc->ComparisonFunc, {},
      desc->MinLOD,     desc->MaxLOD};
  std::copy_n(desc->FloatBorderColor, 4, plain.BorderColor);
  CreateSampler(&plain, dest);
}

void Device::CopyDescriptorsSimple(UINT count, D3D12_CPU_DESCRIPTOR_HANDLE dest,
                                   D3D12_CPU_DESCRIPTOR_HANDLE source,
                                   D3D12_DESCRIPTOR_HEAP_TYPE type) {
  check(device_.CopyDescriptorsSimple(count, slot(dest), slot(source),
                                      static_cast<rtapi::DescriptorHeapType>(type)));
}

void Device::CopyDescriptors(UINT dest_count, const D3D12_CPU_DESCRIPTOR_HANDLE* dest_starts,
                             const UINT* dest_sizes, UINT source_count,
                             const D3D12_CPU_DESCRIPTOR_HANDLE* source_starts,
                             const UINT* source_sizes, D3D12_DESCRIPTOR_HEAP_TYPE type) {
  if (dest_starts == nullptr || source_starts == nullptr) {
    if (dest_count != 0) fail(ErrorId::kNullPointer, "CopyDescriptors: the starts of the ranges.");
    return;
  }
  // Ranges without sizes are of one descriptor. Both lists name as many in all; if they do not, the
  // smaller total is copied, as D3D12's runtimes do.
  UINT d = 0, s = 0, in_dest = 0, in_source = 0;
  while (d < dest_count && s < source_count) {
    const UINT dest_size = dest_sizes != nullptr ? dest_sizes[d] : 1;
    const UINT source_size = source_sizes != nullptr ? source_sizes[s] : 1;
    const UINT run = std::min(dest_size - in_dest, source_size - in_source);
    if (run != 0) {
      CopyDescriptorsSimple(run, {slot(dest_starts[d]).Offset(in_dest).ptr},
                            {slot(source_starts[s]).Offset(in_source).ptr}, type);
    }
    in_dest += run;
    in_source += run;
    if (in_dest == dest_size) {
      ++d;
      in_dest = 0;
    }
    if (in_source == source_size) {
      ++s;
      in_source = 0;
    }
  }
  if (d != dest_count || s != source_count) {
    report(D3D12_MESSAGE_SEVERITY_WARNING,
           make_error(ErrorId::kView,
                      "CopyDescriptors: the source and destination ranges do not name as many "
                      "descriptors; those that both have are copied."));
  }
}

}  // namespace kaamos::d3d12
