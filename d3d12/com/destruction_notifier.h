// SPDX-License-Identifier: MIT
// ID3DDestructionNotifier: calls that a program wants made when an object is destroyed.
#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

/// The notifier of one object: part of it, with its identity and reference count. Thread-safe.
class DestructionNotifier final : public ID3DDestructionNotifierEntries {
 public:
  /// `owner`: the object that this is a part of.
  explicit DestructionNotifier(IUnknown* owner) : owner_(owner) {}

  HRESULT STDMETHODCALLTYPE QueryInterface(REFIID riid, void** object) override {
    return owner_->QueryInterface(riid, object);
  }
  ULONG STDMETHODCALLTYPE AddRef() override { return owner_->AddRef(); }
  ULONG STDMETHODCALLTYPE Release() override { return owner_->Release(); }

  /// A call gets an id, from 1 on, where the program asks for one.
  HRESULT STDMETHODCALLTYPE RegisterDestructionCallback(PFN_DESTRUCTION_CALLBACK call, void* data,
                                                        UINT* id) override {
    if (call == nullptr) return DXGI_ERROR_INVALID_CALL;
    std::lock_guard lock(mutex_);
    calls_.push_back({id != nullptr ? next_id_++ : 0, call, data});
    if (id != nullptr) *id = calls_.back().id;
    return S_OK;
  }

  HRESULT STDMETHODCALLTYPE UnregisterDestructionCallback(UINT id) override {
    std::lock_guard lock(mutex_);
    const auto removed =
        id != 0 ? std::erase_if(calls_, [id](const Call& c) { return c.id == id; }) : 0;
    return removed != 0 ? S_OK : DXGI_ERROR_NOT_FOUND;
  }

  /// Makes the calls, oldest first: the object is being destroyed.
  void destroyed() {
    std::unique_lock lock(mutex_);
    const std::vector<Call> calls = std::exchange(calls_, {});
    lock.unlock();
    for (const Call& call : calls) call.function(call.data);
  }

 private:
  struct Call {
    UINT id;  // 0: none, so that it stays
    PFN_DESTRUCTION_CALLBACK function;
    void* data;
  };

  Reporter& reporter() const override { return process_reporter(); }

  IUnknown* owner_;
  std::mutex mutex_;
  std::vector<Call> calls_;
  UINT next_id_ = 1;
};

}  // namespace kaamos::d3d12
