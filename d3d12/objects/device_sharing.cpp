// SPDX-License-Identifier: MIT
// Heaps, resources and fences that other devices of the process open by a handle.
#include <rtapi/heap.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "d3d12/objects/device.h"
#include "d3d12/objects/fence.h"
#include "d3d12/objects/heap.h"
#include "d3d12/objects/resource.h"
#include "d3d12/win32/handles.h"

namespace kaamos::d3d12 {

namespace {

// What a shared handle names. It keeps the object.
struct SharedObject : HandleObject {
  Held<Heap> heap;
  Held<Resource> resource;
  Held<Fence> fence;
};

// Shared objects by the name that the program gave them, as long as a handle is open.
class SharedNames {
 public:
  // False if a living object has the name.
  bool add(const std::wstring& name, const std::shared_ptr<SharedObject>& object) {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<SharedObject>& entry = objects_[name];
    if (!entry.expired()) return false;
    entry = object;
    return true;
  }
  std::shared_ptr<SharedObject> find(const std::wstring& name) {
    const std::lock_guard lock(mutex_);
    const auto it = objects_.find(name);
    return it != objects_.end() ? it->second.lock() : nullptr;
  }

 private:
  std::mutex mutex_;
  std::map<std::wstring, std::weak_ptr<SharedObject>> objects_;
};

SharedNames& shared_names() {
  static auto* names = new SharedNames;  // programs may close handles when statics have ended
  return *names;
}

// The object, if its flags say that it is shared; null otherwise.
std::shared_ptr<SharedObject> shared_object(ID3D12DeviceChild* child) {
  auto shared = std::make_shared<SharedObject>();
  if (auto* heap = dynamic_cast<Heap*>(child); heap != nullptr) {
    if ((heap->GetDesc().Flags & D3D12_HEAP_FLAG_SHARED) == 0) return nullptr;
    shared->heap = Held<Heap>(heap);
  } else if (auto* resource = dynamic_cast<Resource*>(child); resource != nullptr) {
    if (!resource->shared_memory()) return nullptr;
    shared->resource = Held<Resource>(resource);
  } else if (auto* fence = dynamic_cast<Fence*>(child); fence != nullptr) {
    if ((fence->GetCreationFlags() & D3D12_FENCE_FLAG_SHARED) == 0) return nullptr;
    shared->fence = Held<Fence>(fence);
  } else {
    return nullptr;
  }
  return shared;
}

}  // namespace

HRESULT Device::CreateSharedHandle(ID3D12DeviceChild* object, const SECURITY_ATTRIBUTES*,
                                   DWORD access, LPCWSTR name, HANDLE* handle) {
  if (object == nullptr || handle == nullptr) {
    return fail(ErrorId::kNullPointer, "CreateSharedHandle: pObject or pHandle.");
  }
  *handle = nullptr;
  if (access != GENERIC_ALL) {
    return fail(ErrorId::kSharing,
                "CreateSharedHandle: Access is " + std::to_string(access) + "; it is GENERIC_ALL.");
  }
  const std::shared_ptr<SharedObject> shared = shared_object(object);
  if (shared == nullptr) {
    return fail(ErrorId::kSharing,
                "CreateSharedHandle: the object is no heap or committed resource with "
                "D3D12_HEAP_FLAG_SHARED (1), and no fence with D3D12_FENCE_FLAG_SHARED (1).");
  }
  if (name != nullptr && !shared_names().add(name, shared)) {
    fail(ErrorId::kSharing, "CreateSharedHandle: a shared object has the name already.");
    return DXGI_ERROR_NAME_ALREADY_EXISTS;
  }
  *handle = Handles::instance().add(shared);
  return S_OK;
}

HRESULT Device::OpenSharedHandleByName(LPCWSTR name, DWORD, HANDLE* handle) {
  if (name == nullptr || handle == nullptr) {
    return fail(ErrorId::kNullPointer, "OpenSharedHandleByName: Name or pNTHandle.");
  }
  *handle = nullptr;
  const auto shared = shared_names().find(name);
  if (shared == nullptr) {
    return fail(ErrorId::kSharing, "OpenSharedHandleByName: no shared object has the name.");
  }
  *handle = Handles::instance().add(shared);
  return S_OK;
}

HRESULT Device::OpenSharedHandle(HANDLE handle, REFIID riid, void** object) {
  if (object != nullptr) *object = nullptr;
  const auto shared = Handles::instance().find<SharedObject>(handle);
  if (shared == nullptr) {
    return fail(ErrorId::kSharing,
                "OpenSharedHandle: the handle is none of CreateSharedHandle, or it is closed.");
  }
  if (const Held<Fence>& fence = shared->fence) {
    auto opened = rtapi::OpenFence(device_, fence->rtapi_fence());
    if (!opened.ok()) return fail(opened.error());
    return hand_out(new Fence(this, *std::move(opened), fence->GetCreationFlags()), riid, object);
  }
  const Held<Heap>& heap = shared->heap;
  const Held<Resource>& resource = shared->resource;
  auto memory = rtapi::OpenHeap(device_, heap ? heap->rtapi_heap() : resource->shared_memory());
  if (!memory.ok()) return fail(memory.error());
  if (heap) return hand_out(new Heap(this, *std::move(memory), heap->GetDesc()), riid, object);
  D3D12_HEAP_PROPERTIES properties = {};
  D3D12_HEAP_FLAGS flags = {};
  resource->GetHeapProperties(&properties, &flags);
  return make_resource(*this, properties, flags, resource->GetDesc1(), D3D12_RESOURCE_STATE_COMMON,
                       nullptr, {nullptr, *std::move(memory), 0}, riid, object);
}

}  // namespace kaamos::d3d12
