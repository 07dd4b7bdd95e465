// SPDX-License-Identifier: MIT
#include "d3d12/objects/graphics_command_list.h"

#include "d3d12/com/text.h"
#include "d3d12/objects/bundle.h"
#include "d3d12/objects/descriptor_heap.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/pipeline_objects.h"
#include "d3d12/objects/resource.h"
#include "d3d12/objects/state_object.h"

namespace kaamos::d3d12 {

// ---------------------------------------------------------------------------------------------
// Life

GraphicsCommandList::GraphicsCommandList(ID3D12Device* device, rtapi::CommandList list,
                                         D3D12_COMMAND_LIST_TYPE type, CommandAllocator* allocator)
    : DeviceChild(device), list_(std::move(list)), type_(type), allocator_(allocator) {}

GraphicsCommandList::~GraphicsCommandList() {
  drop_allocator();
}

void GraphicsCommandList::drop_allocator() {
  if (allocator_) allocator_->end();
  allocator_ = Held<CommandAllocator>();
}

void GraphicsCommandList::refuse(ErrorId id, const std::string& detail) {
  const HRESULT result = fail(id, detail);
  if (SUCCEEDED(refused_)) refused_ = result;
}

// D3D12 returns one code for all that went wrong while the list recorded; the messages tell the
// rest.
HRESULT GraphicsCommandList::Close() {
  drop_allocator();
  if (!list_.is_open()) {
    fail(ErrorId::kCommandList, "ID3D12GraphicsCommandList::Close: the list is closed.");
    return E_FAIL;
  }
  for (; open_events_ != 0; --open_events_) list_.EndEvent();
  const std::vector<rtapi::Error> errors = list_.GetErrors();
  const rtapi::Status status = list_.Close();
  for (const rtapi::Error& error : errors) report(D3D12_MESSAGE_SEVERITY_ERROR, error);
  const HRESULT refused = std::exchange(refused_, S_OK);
  if (status.ok()) return refused;
  return errors.empty() ? fail(status.error()) : to_hresult(status.error().code);
}

HRESULT GraphicsCommandList::Reset(ID3D12CommandAllocator* allocator,
                                   ID3D12PipelineState* initial_state) {
  if (allocator == nullptr) {
    return fail(ErrorId::kNullPointer, "ID3D12GraphicsCommandList::Reset: pAllocator.");
  }
  if (list_.is_open() && allocator_) {
    fail(ErrorId::kCommandList,
         "ID3D12GraphicsCommandList::Reset: the list is open. Close it first.");
    return E_FAIL;
  }
  auto* taken = static_cast<CommandAllocator*>(allocator);
  if (taken->type() != type_) {
    return fail(ErrorId::kCommandList,
                "ID3D12GraphicsCommandList::Reset: the allocator is of type " +
                    std::to_string(taken->type()) + ", the list of type " + std::to_string(type_) +
                    ".");
  }
  if (!taken->begin()) {
    return fail(ErrorId::kCommandList,
                "ID3D12GraphicsCommandList::Reset: another list of the allocator records.");
  }
  allocator_ = Held(taken);
  if (const rtapi::Status status = list_.Reset(); !status) {
    drop_allocator();
    return fail(status.error());
  }
  refused_ = S_OK;
  if (initial_state != nullptr) SetPipelineState(initial_state);
  return S_OK;
}

void GraphicsCommandList::ClearState(ID3D12PipelineState* pipeline) {
  list_.ClearState(pipeline != nullptr ? rtapi_pipeline(pipeline) : rtapi::PipelineState());
}

HRESULT Device::CreateCommandList(UINT, D3D12_COMMAND_LIST_TYPE type,
                                  ID3D12CommandAllocator* allocator,
                                  ID3D12PipelineState* initial_state, REFIID riid, void** list) {
  if (list != nullptr) *list = nullptr;
  if (allocator == nullptr) {
    return fail(ErrorId::kNullPointer, "CreateCommandList: pCommandAllocator.");
  }
  auto* taken = static_cast<CommandAllocator*>(allocator);
  if (type > D3D12_COMMAND_LIST_TYPE_COPY || taken->type() != type) {
    return fail(ErrorId::kCommandList,
                "CreateCommandList: type " + std::to_string(type) + " with an allocator of type " +
                    std::to_string(taken->type()) +
                    "; both are the same, DIRECT (0), BUNDLE (1), COMPUTE (2) or COPY (3).");
  }
  if (!taken->begin()) {
    return fail(ErrorId::kCommandList, "CreateCommandList: another list of the allocator records.");
  }
  if (type == D3D12_COMMAND_LIST_TYPE_BUNDLE) {
    auto* bundle = new Bundle(this, taken);
    if (initial_state != nullptr) bundle->SetPipelineState(initial_state);
    return hand_out(bundle, riid, list);
  }
  auto made = device_.CreateCommandList();
  if (!made) {
    taken->end();
    return fail(made.error());
  }
  auto* object = new GraphicsCommandList(this, *made, type, taken);
  if (initial_state != nullptr) object->SetPipelineState(initial_state);
  return hand_out(object, riid, list);
}

HRESULT Device::CreateCommandList1(UINT, D3D12_COMMAND_LIST_TYPE type, D3D12_COMMAND_LIST_FLAGS,
                                   REFIID riid, void** list) {
  if (list != nullptr) *list = nullptr;
  if (type > D3D12_COMMAND_LIST_TYPE_COPY) {
    return fail(ErrorId::kCommandList,
                "CreateCommandList1: type " + std::to_string(type) +
                    "; it is DIRECT (0), BUNDLE (1), COMPUTE (2) or COPY (3).");
  }
  if (type == D3D12_COMMAND_LIST_TYPE_BUNDLE) {
    return hand_out(new Bundle(this, nullptr), riid, list);
  }
  auto made = device_.CreateCommandList();
  if (!made) return fail(made.error());
  if (const rtapi::Status status = made->Close(); !status) return fail(status.error());
  return hand_out(new GraphicsCommandList(this, *made, type, nullptr), riid, list);
}

// ---------------------------------------------------------------------------------------------
// State

void GraphicsCommandList::SetPipelineState(ID3D12PipelineState* pipeline) {
  list_.SetPipelineState(rtapi_pipeline(pipeline));
}

void GraphicsCommandList::SetPipelineState1(ID3D12StateObject* state_object) {
  list_.SetPipelineState1(state_object != nullptr
                              ? static_cast<StateObject*>(state_object)->rtapi_state_object()
                              : rtapi::StateObject{});
}

void GraphicsCommandList::SetDescriptorHeaps(UINT count, ID3D12DescriptorHeap* const* heaps) {
  if (count != 0 && heaps == nullptr) {
    refuse(ErrorId::kNullPointer, "SetDescriptorHeaps: ppDescriptorHeaps.");
    return;
  }
  std::vector<rtapi::DescriptorHeap> set;
  for (UINT i = 0; i < count; ++i) {
    set.push_back(heaps[i] != nullptr ? static_cast<DescriptorHeap*>(heaps[i])->rtapi_heap()
                                      : rtapi::DescriptorHeap{});
  }
  list_.SetDescriptorHeaps(std::span<const rtapi::DescriptorHeap>(set));
}

void GraphicsCommandList::ResourceBarrier(UINT count, const D3D12_RESOURCE_BARRIER* barriers) {
  if (count != 0 && barriers == nullptr) {
    refuse(ErrorId::kNullPointer, "ResourceBarrier: pBarriers.");
    return;
  }
  std::vector<rtapi::ResourceBarrier> recorded;
  for (UINT i = 0; i < count; ++i) {
    const D3D12_RESOURCE_BARRIER& barrier = barriers[i];
    // A split barrier takes place at its end.
    if ((barrier.Flags & D3D12_RESOURCE_BARRIER_FLAG_BEGIN_ONLY) != 0) continue;
    switch (barrier.Type) {
      case D3D12_RESOURCE_BARRIER_TYPE_TRANSITION:
        // D3D12's debug layer warns, and the barrier does nothing.
        if (barrier.Transition.StateBefore == barrier.Transition.StateAfter) {
          report(D3D12_MESSAGE_SEVERITY_WARNING,
                 make_error(ErrorId::kBarrier, "pBarriers[" + std::to_string(i) +
                                                   "]: StateBefore and StateAfter are both " +
                                                   std::to_string(barrier.Transition.StateAfter) +
                                                   "; leave it out."));
          break;
        }
        recorded.push_back(rtapi::ResourceBarrier::Transition(
            rtapi_resource(barrier.Transition.pResource),
            static_cast<rtapi::ResourceStates>(barrier.Transition.StateBefore),
            static_cast<rtapi::ResourceStates>(barrier.Transition.StateAfter),
            barrier.Transition.Subresource));
        break;
      case D3D12_RESOURCE_BARRIER_TYPE_UAV:
        recorded.push_back(rtapi::ResourceBarrier::Uav(rtapi_resource(barrier.UAV.pResource)));
        break;
      case D3D12_RESOURCE_BARRIER_TYPE_ALIASING:
        recorded.push_back(
            rtapi::ResourceBarrier::Aliasing(rtapi_resource(barrier.Aliasing.pResourceBefore),
                                             rtapi_resource(barrier.Aliasing.pResourceAfter)));
        break;
      default:
        refuse(ErrorId::kBarrier, "pBarriers[" + std::to_string(i) + "].Type is " +
                                      std::to_string(barrier.Type) + "; it is 0, 1 or 2.");
    }
  }
  list_.ResourceBarrier(std::span<const rtapi::ResourceBarrier>(recorded));
}

// ---------------------------------------------------------------------------------------------
// Root arguments

void GraphicsCommandList::SetComputeRootSignature(ID3D12RootSignature* root_signature) {
  list_.SetComputeRootSignature(rtapi_root_signature(root_signature));
}
void GraphicsCommandList::SetGraphicsRootSignature(ID3D12RootSignature* root_signature) {
  list_.SetGraphicsRootSignature(rtapi_root_signature(root_signature));
}
void GraphicsCommandList::SetComputeRootDescriptorTable(UINT parameter,
                                                        D3D12_GPU_DESCRIPTOR_HANDLE base) {
  list_.SetComputeRootDescriptorTable(parameter, {base.ptr});
}
void GraphicsCommandList::SetGraphicsRootDescriptorTable(UINT parameter,
                                                         D3D12_GPU_DESCRIPTOR_HANDLE base) {
  list_.SetGraphicsRootDescriptorTable(parameter, {base.ptr});
}
void GraphicsCommandList::SetComputeRoot32BitConstant(UINT parameter, UINT value, UINT offset) {
  list_.SetComputeRoot32BitConstant(parameter, value, offset);
}
void GraphicsCommandList::SetGraphicsRoot32BitConstant(UINT parameter, UINT value, UINT offset) {
  list_.SetGraphicsRoot32BitConstant(parameter, value, offset);
}
void GraphicsCommandList::SetComputeRoot32BitConstants(UINT parameter, UINT count,
                                                       const void* values, UINT offset) {
  list_.SetComputeRoot32BitConstants(parameter, count, values, offset);
}
void GraphicsCommandList::SetGraphicsRoot32BitConstants(UINT parameter, UINT count,
                                                        const void* values, UINT offset) {
  list_.SetGraphicsRoot32BitConstants(parameter, count, values, offset);
}
void GraphicsCommandList::SetComputeRootConstantBufferView(UINT parameter,
                                                           D3D12_GPU_VIRTUAL_ADDRESS address) {
  list_.SetComputeRootConstantBufferView(parameter, address);
}
void GraphicsCommandList::SetGraphicsRootConstantBufferView(UINT parameter,
                                                            D3D12_GPU_VIRTUAL_ADDRESS address) {
  list_.SetGraphicsRootConstantBufferView(parameter, address);
}
void GraphicsCommandList::SetComputeRootShaderResourceView(UINT parameter,
                                                           D3D12_GPU_VIRTUAL_ADDRESS address) {
  list_.SetComputeRootShaderResourceView(parameter, address);
}
void GraphicsCommandList::SetGraphicsRootShaderResourceView(UINT parameter,
                                                            D3D12_GPU_VIRTUAL_ADDRESS address) {
  list_.SetGraphicsRootShaderResourceView(parameter, address);
}
void GraphicsCommandList::SetComputeRootUnorderedAccessView(UINT parameter,
                                                            D3D12_GPU_VIRTUAL_ADDRESS address) {
  list_.SetComputeRootUnorderedAccessView(parameter, address);
}
void GraphicsCommandList::SetGraphicsRootUnorderedAccessView(UINT parameter,
                                                             D3D12_GPU_VIRTUAL_ADDRESS address) {
  list_.SetGraphicsRootUnorderedAccessView(parameter, address);
}

// ---------------------------------------------------------------------------------------------
// Dispatches and events

void GraphicsCommandList::Dispatch(UINT x, UINT y, UINT z) {
  list_.Dispatch(x, y, z);
}

void GraphicsCommandList::ExecuteIndirect(ID3D12CommandSignature* signature, UINT max_count,
                                          ID3D12Resource* arguments, UINT64 arguments_offset,
                                          ID3D12Resource* count, UINT64 count_offset) {
  list_.ExecuteIndirect(rtapi_signature(signature), max_count, rtapi_buffer(arguments),
                        arguments_offset, rtapi_buffer(count), count_offset);
}

void GraphicsCommandList::ExecuteBundle(ID3D12GraphicsCommandList* bundle) {
  if (bundle == nullptr || bundle->GetType() != D3D12_COMMAND_LIST_TYPE_BUNDLE) {
    refuse(ErrorId::kCommandList, "ExecuteBundle: pCommandList is no bundle.");
    return;
  }
  const auto* calls = static_cast<const Bundle*>(bundle);
  if (calls->is_open()) {
    refuse(ErrorId::kCommandList, "ExecuteBundle: the bundle is open. Close it first.");
    return;
  }
  calls->execute(this);
}

// PIX's headers pass a wide string as metadata 0 and a narrow one as 1; other numbers mean
// encodings of PIX's own. [pix.h: PIXBeginEvent]
void GraphicsCommandList::BeginEvent(UINT metadata, const void* data, UINT size) {
  std::string name = "event";
  if (data != nullptr && metadata == 0) {
    const auto* text = static_cast<const wchar_t*>(data);
    name = to_utf8(std::wstring(text, size / sizeof(wchar_t)).c_str());
  } else if (data != nullptr && metadata == 1) {
    name = std::string(static_cast<const char*>(data), size).c_str();
  }
  list_.BeginEvent(std::move(name));
  ++open_events_;
}

// D3D12 takes unbalanced events; rtapi does not.
void GraphicsCommandList::EndEvent() {
  if (open_events_ == 0) return;
  --open_events_;
  list_.EndEvent();
}

}  // namespace kaamos::d3d12
