// SPDX-License-Identifier: MIT
// The debug layer of a device: stored messages, filters, callbacks, and ID3D12DebugDevice.
#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <directx/d3d12sdklayers.h>

#include "d3d12/com/object.h"
#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

/// A message as a queue stores it.
struct StoredMessage {
  D3D12_MESSAGE_CATEGORY category;
  D3D12_MESSAGE_SEVERITY severity;
  D3D12_MESSAGE_ID id;
  std::string text;
};

/// The lists of an INFO_QUEUE_FILTER_DESC, copied.
struct FilterLists {
  std::set<D3D12_MESSAGE_CATEGORY> categories;
  std::set<D3D12_MESSAGE_SEVERITY> severities;
  std::set<D3D12_MESSAGE_ID> ids;

  void add(const D3D12_INFO_QUEUE_FILTER_DESC& desc);
  bool empty() const { return categories.empty() && severities.empty() && ids.empty(); }
};

/// A filter. It lets through everything on an allow list (or everything, where that is empty) that
/// is on no deny list.
struct MessageFilter {
  FilterLists allow;
  FilterLists deny;

  void add(const D3D12_INFO_QUEUE_FILTER& filter);
  bool lets_through(const StoredMessage& message) const;
};

/// A stack of filters, the top one in use.
class FilterStack {
 public:
  MessageFilter& top();
  bool lets_through(const StoredMessage& message) const {
    return filters_.empty() || filters_.back().lets_through(message);
  }
  void push(MessageFilter filter) { filters_.push_back(std::move(filter)); }
  void push_copy() { filters_.push_back(filters_.empty() ? MessageFilter{} : filters_.back()); }
  void pop() {
    if (!filters_.empty()) filters_.pop_back();
  }
  UINT size() const { return static_cast<UINT>(filters_.size()); }
  /// Writes the top filter as GetStorageFilter does: the size first, then structures and arrays.
  HRESULT write(D3D12_INFO_QUEUE_FILTER* filter, SIZE_T* size) const;

 private:
  std::vector<MessageFilter> filters_;
};

/// ID3D12InfoQueue1 over the messages of one device.
class InfoQueue : public ID3D12InfoQueueEntries {
 public:
  HRESULT STDMETHODCALLTYPE SetMessageCountLimit(UINT64 limit) override;
  void STDMETHODCALLTYPE ClearStoredMessages() override;
  HRESULT STDMETHODCALLTYPE GetMessage(UINT64 index, D3D12_MESSAGE* message, SIZE_T* size) override;
  UINT64 STDMETHODCALLTYPE GetNumMessagesAllowedByStorageFilter() override;
  UINT64 STDMETHODCALLTYPE GetNumMessagesDeniedByStorageFilter() override;
  UINT64 STDMETHODCALLTYPE GetNumStoredMessages() override;
  UINT64 STDMETHODCALLTYPE GetNumStoredMessagesAllowedByRetrievalFilter() override;
  UINT64 STDMETHODCALLTYPE GetNumMessagesDiscardedByMessageCountLimit() override;
  UINT64 STDMETHODCALLTYPE GetMessageCountLimit() override;
  HRESULT STDMETHODCALLTYPE AddStorageFilterEntries(D3D12_INFO_QUEUE_FILTER* filter) override;
  HRESULT STDMETHODCALLTYPE GetStorageFilter(D3D12_INFO_QUEUE_FILTER* filter,
                                             SIZE_T* size) override;
  void STDMETHODCALLTYPE ClearStorageFilter() override;
  HRESULT STDMETHODCALLTYPE PushEmptyStorageFilter() override;
  HRESULT STDMETHODCALLTYPE PushCopyOfStorageFilter() override;
  HRESULT STDMETHODCALLTYPE PushStorageFilter(D3D12_INFO_QUEUE_FILTER* filter) override;
  void STDMETHODCALLTYPE PopStorageFilter() override;
  UINT STDMETHODCALLTYPE GetStorageFilterStackSize() override;
  HRESULT STDMETHODCALLTYPE AddRetrievalFilterEntries(D3D12_INFO_QUEUE_FILTER* filter) override;
  HRESULT STDMETHODCALLTYPE GetRetrievalFilter(D3D12_INFO_QUEUE_FILTER* filter,
                                               SIZE_T* size) override;
  void STDMETHODCALLTYPE ClearRetrievalFilter() override;
  HRESULT STDMETHODCALLTYPE PushEmptyRetrievalFilter() override;
  HRESULT STDMETHODCALLTYPE PushCopyOfRetrievalFilter() override;
  HRESULT STDMETHODCALLTYPE PushRetrievalFilter(D3D12_INFO_QUEUE_FILTER* filter) override;
  void STDMETHODCALLTYPE PopRetrievalFilter() override;
  UINT STDMETHODCALLTYPE GetRetrievalFilterStackSize() override;
  HRESULT STDMETHODCALLTYPE AddMessage(D3D12_MESSAGE_CATEGORY category,
                                       D3D12_MESSAGE_SEVERITY severity, D3D12_MESSAGE_ID id,
                                       LPCSTR text) override;
  HRESULT STDMETHODCALLTYPE AddApplicationMessage(D3D12_MESSAGE_SEVERITY severity,
                                                  LPCSTR text) override;
  HRESULT STDMETHODCALLTYPE SetBreakOnCategory(D3D12_MESSAGE_CATEGORY category,
                                               BOOL enable) override;
  HRESULT STDMETHODCALLTYPE SetBreakOnSeverity(D3D12_MESSAGE_SEVERITY severity,
                                               BOOL enable) override;
  HRESULT STDMETHODCALLTYPE SetBreakOnID(D3D12_MESSAGE_ID id, BOOL enable) override;
  BOOL STDMETHODCALLTYPE GetBreakOnCategory(D3D12_MESSAGE_CATEGORY category) override;
  BOOL STDMETHODCALLTYPE GetBreakOnSeverity(D3D12_MESSAGE_SEVERITY severity) override;
  BOOL STDMETHODCALLTYPE GetBreakOnID(D3D12_MESSAGE_ID id) override;
  void STDMETHODCALLTYPE SetMuteDebugOutput(BOOL mute) override;
  BOOL STDMETHODCALLTYPE GetMuteDebugOutput() override;
  HRESULT STDMETHODCALLTYPE RegisterMessageCallback(D3D12MessageFunc callback,
                                                    D3D12_MESSAGE_CALLBACK_FLAGS flags,
                                                    void* context, DWORD* cookie) override;
  HRESULT STDMETHODCALLTYPE UnregisterMessageCallback(DWORD cookie) override;

 protected:
  ~InfoQueue() override;
  /// Stores messages from now on; once.
  void listen_to(std::shared_ptr<Reporter> reporter);

 private:
  struct Callback {
    D3D12MessageFunc function;
    bool ignores_filters;
    void* context;
  };

  void store(StoredMessage message);
  void keep(StoredMessage message, bool passes);

  mutable std::recursive_mutex mutex_;
  std::deque<StoredMessage> messages_;
  FilterStack storage_;
  FilterStack retrieval_;
  UINT64 limit_ = 1024;
  UINT64 allowed_ = 0;
  UINT64 denied_ = 0;
  UINT64 discarded_ = 0;
  std::set<D3D12_MESSAGE_CATEGORY> break_categories_;
  std::set<D3D12_MESSAGE_SEVERITY> break_severities_;
  std::set<D3D12_MESSAGE_ID> break_ids_;
  std::map<DWORD, Callback> callbacks_;
  DWORD next_cookie_ = 1;
  std::shared_ptr<Reporter> reporter_;
  uint64_t sink_ = 0;
};

/// ID3D12DebugDevice2.
class DebugDevice : public ID3D12DebugDeviceEntries {
 public:
  HRESULT STDMETHODCALLTYPE SetFeatureMask(D3D12_DEBUG_FEATURE mask) override {
    features_ = mask;
    return S_OK;
  }
  D3D12_DEBUG_FEATURE STDMETHODCALLTYPE GetFeatureMask() override { return features_; }

 private:
  D3D12_DEBUG_FEATURE features_ = D3D12_DEBUG_FEATURE_NONE;
};

}  // namespace kaamos::d3d12
