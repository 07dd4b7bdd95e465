// SPDX-License-Identifier: MIT
#include "d3d12/objects/fence.h"

#include <windows.h>

#include <atomic>
#include <memory>

#include "d3d12/objects/device.h"

namespace kaamos::d3d12 {

namespace {

HANDLE duplicate(HANDLE handle) {
  HANDLE out = nullptr;
  const HANDLE process = GetCurrentProcess();
  DuplicateHandle(process, handle, process, &out, 0, FALSE, DUPLICATE_SAME_ACCESS);
  return out;
}

// An event that a fence sets; closes its handle with the last copy.
class EventSignal {
 public:
  explicit EventSignal(HANDLE event) : event_(event, [](HANDLE handle) { CloseHandle(handle); }) {}
  void set() const { SetEvent(event_.get()); }

 private:
  std::shared_ptr<void> event_;
};

}  // namespace

HRESULT Fence::SetEventOnCompletion(UINT64 value, HANDLE event) {
  if (event == nullptr) return check(fence_.Wait(value));
  // The program may close its handle before the value is reached.
  const HANDLE kept = duplicate(event);
  if (kept == nullptr) return fail(ErrorId::kWin32, "SetEventOnCompletion: hEvent is no event.");
  return check(fence_.CallAt(value, [signal = EventSignal(kept)] { signal.set(); }));
}

HRESULT Device::CreateFence(UINT64 initial_value, D3D12_FENCE_FLAGS flags, REFIID riid,
                            void** fence) {
  if (fence != nullptr) *fence = nullptr;
  auto made = device_.CreateFence(initial_value);
  if (!made) return fail(made.error());
  return hand_out(new Fence(this, *made, flags), riid, fence);
}

HRESULT Device::SetEventOnMultipleFenceCompletion(ID3D12Fence* const* fences, const UINT64* values,
                                                  UINT count, D3D12_MULTIPLE_FENCE_WAIT_FLAGS flags,
                                                  HANDLE event) {
  if (count == 0 || fences == nullptr || values == nullptr) {
    return fail(ErrorId::kNullPointer, "SetEventOnMultipleFenceCompletion: no fences or values.");
  }
  if (static_cast<UINT>(flags) > D3D12_MULTIPLE_FENCE_WAIT_FLAG_ANY) {
    fail(ErrorId::kWin32, "SetEventOnMultipleFenceCompletion: Flags is " + std::to_string(flags) +
                              "; it is 0 (ALL) or 1 (ANY).");
    return E_INVALIDARG;
  }
  for (UINT i = 0; i < count; ++i) {
    if (fences[i] == nullptr) {
      return fail(ErrorId::kNullPointer,
                  "SetEventOnMultipleFenceCompletion: ppFences[" + std::to_string(i) + "].");
    }
  }
  const HANDLE kept =
      event != nullptr ? duplicate(event) : CreateEvent(nullptr, TRUE, FALSE, nullptr);
  if (kept == nullptr) {
    return fail(ErrorId::kWin32, "SetEventOnMultipleFenceCompletion: hEvent is no event.");
  }
  const EventSignal signal(kept);
  // How many fences must still reach their value.
  const bool any = (flags & D3D12_MULTIPLE_FENCE_WAIT_FLAG_ANY) != 0;
  const auto left = std::make_shared<std::atomic<UINT>>(any ? 1 : count);
  for (UINT i = 0; i < count; ++i) {
    const auto reached = [left, signal] {
      if (left->fetch_sub(1) == 1) signal.set();
    };
    if (const HRESULT result =
            check(static_cast<Fence*>(fences[i])->rtapi_fence().CallAt(values[i], reached));
        FAILED(result)) {
      return result;
    }
  }
  if (event == nullptr) WaitForSingleObject(kept, INFINITE);
  return S_OK;
}

HRESULT Device::EnqueueMakeResident(D3D12_RESIDENCY_FLAGS, UINT, ID3D12Pageable* const*,
                                    ID3D12Fence* fence, UINT64 value) {
  if (fence == nullptr) return fail(ErrorId::kNullPointer, "EnqueueMakeResident: pFenceToSignal.");
  return fence->Signal(value);
}

HRESULT Device::SetBackgroundProcessingMode(D3D12_BACKGROUND_PROCESSING_MODE,
                                            D3D12_MEASUREMENTS_ACTION, HANDLE event, BOOL* more) {
  if (event != nullptr) SetEvent(event);
  if (more != nullptr) *more = FALSE;
  return S_OK;
}

}  // namespace kaamos::d3d12
