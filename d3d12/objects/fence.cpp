// SPDX-License-Identifier: MIT
#include "d3d12/objects/fence.h"

#include <windows.h>

#include <thread>

#include "d3d12/objects/device.h"

namespace kaamos::d3d12 {

namespace {

HANDLE duplicate(HANDLE handle) {
  HANDLE out = nullptr;
  const HANDLE process = GetCurrentProcess();
  DuplicateHandle(process, handle, process, &out, 0, FALSE, DUPLICATE_SAME_ACCESS);
  return out;
}

}  // namespace

// Work runs in the call that submits it, so that the value is nearly always reached by now. Only a
// queue that waits for a fence leaves something to wait for, and then a thread does.
HRESULT Fence::SetEventOnCompletion(UINT64 value, HANDLE event) {
  if (event == nullptr) return check(fence_.Wait(value));
  if (fence_.GetCompletedValue() >= value) {
    SetEvent(event);
    return S_OK;
  }
  // The program may close its handle before the value is reached.
  const HANDLE kept = duplicate(event);
  if (kept == nullptr) return fail(ErrorId::kWin32, "SetEventOnCompletion: hEvent is no event.");
  std::thread([fence = fence_, dropped = dropped_, value, kept] {
    constexpr uint32_t kTurnMs = 50;
    while (!fence.Wait(value, kTurnMs).ok()) {
      // A removed device sets its fences to 2^64 - 1.
      if (fence.GetCompletedValue() >= value) break;
      if (*dropped) {
        CloseHandle(kept);
        return;
      }
    }
    SetEvent(kept);
    CloseHandle(kept);
  }).detach();
  return S_OK;
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
  const bool any = (flags & D3D12_MULTIPLE_FENCE_WAIT_FLAG_ANY) != 0;
  std::vector<std::pair<rtapi::Fence, UINT64>> waits;
  for (UINT i = 0; i < count; ++i) {
    if (fences[i] == nullptr) {
      return fail(ErrorId::kNullPointer,
                  "SetEventOnMultipleFenceCompletion: ppFences[" + std::to_string(i) + "].");
    }
    waits.emplace_back(static_cast<Fence*>(fences[i])->rtapi_fence(), values[i]);
  }
  const auto reached = [any](const auto& all) {
    size_t done = 0;
    for (const auto& [fence, value] : all) done += fence.GetCompletedValue() >= value ? 1 : 0;
    return any ? done != 0 : done == all.size();
  };
  const auto wait = [reached, any](const auto& all) {
    constexpr uint32_t kTurnMs = 5;
    while (!reached(all)) {
      for (const auto& [fence, value] : all) {
        if (fence.GetCompletedValue() < value) {
          (void)fence.Wait(value, kTurnMs);
          if (any) break;
        }
      }
    }
  };
  if (event == nullptr) {
    wait(waits);
    return S_OK;
  }
  if (reached(waits)) {
    SetEvent(event);
    return S_OK;
  }
  const HANDLE kept = duplicate(event);
  if (kept == nullptr) {
    return fail(ErrorId::kWin32, "SetEventOnMultipleFenceCompletion: hEvent is no event.");
  }
  std::thread([waits, wait, kept] {
    wait(waits);
    SetEvent(kept);
    CloseHandle(kept);
  }).detach();
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
