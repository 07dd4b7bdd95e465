// SPDX-License-Identifier: MIT
#include "d3d12/objects/info_queue.h"

#include <csignal>
#include <cstring>

#include "d3d12/objects/message_ids.h"

namespace kaamos::d3d12 {

// ---------------------------------------------------------------------------------------------
// Filters

void FilterLists::add(const D3D12_INFO_QUEUE_FILTER_DESC& desc) {
  categories.insert(desc.pCategoryList, desc.pCategoryList + desc.NumCategories);
  severities.insert(desc.pSeverityList, desc.pSeverityList + desc.NumSeverities);
  ids.insert(desc.pIDList, desc.pIDList + desc.NumIDs);
}

void MessageFilter::add(const D3D12_INFO_QUEUE_FILTER& filter) {
  allow.add(filter.AllowList);
  deny.add(filter.DenyList);
}

bool MessageFilter::lets_through(const StoredMessage& message) const {
  const auto lists = [](const auto& set, auto value) { return set.empty() || set.contains(value); };
  return lists(allow.categories, message.category) && lists(allow.severities, message.severity) &&
         lists(allow.ids, message.id) && !deny.categories.contains(message.category) &&
         !deny.severities.contains(message.severity) && !deny.ids.contains(message.id);
}

MessageFilter& FilterStack::top() {
  if (filters_.empty()) filters_.emplace_back();
  return filters_.back();
}

HRESULT FilterStack::write(D3D12_INFO_QUEUE_FILTER* filter, SIZE_T* size) const {
  if (size == nullptr) return E_INVALIDARG;
  const MessageFilter top = filters_.empty() ? MessageFilter{} : filters_.back();
  const auto numbers = [](const FilterLists& lists) {
    return lists.categories.size() + lists.severities.size() + lists.ids.size();
  };
  static_assert(sizeof(D3D12_MESSAGE_CATEGORY) == 4 && sizeof(D3D12_MESSAGE_SEVERITY) == 4 &&
                sizeof(D3D12_MESSAGE_ID) == 4);
  const SIZE_T needed =
      sizeof(D3D12_INFO_QUEUE_FILTER) + 4 * (numbers(top.allow) + numbers(top.deny));
  const SIZE_T room = *size;
  *size = needed;
  if (filter == nullptr) return S_OK;
  if (room < needed) return DXGI_ERROR_MORE_DATA;
  *filter = {};
  auto* next = reinterpret_cast<std::byte*>(filter + 1);
  const auto copy = [&]<class T>(const std::set<T>& values, UINT& count, T*& list) {
    count = static_cast<UINT>(values.size());
    list = values.empty() ? nullptr : reinterpret_cast<T*>(next);
    for (T value : values) {
      std::memcpy(next, &value, sizeof(T));
      next += sizeof(T);
    }
  };
  for (auto [lists, desc] :
       {std::pair{&top.allow, &filter->AllowList}, std::pair{&top.deny, &filter->DenyList}}) {
    copy(lists->categories, desc->NumCategories, desc->pCategoryList);
    copy(lists->severities, desc->NumSeverities, desc->pSeverityList);
    copy(lists->ids, desc->NumIDs, desc->pIDList);
  }
  return S_OK;
}

// ---------------------------------------------------------------------------------------------
// Storage

void InfoQueue::listen_to(std::shared_ptr<Reporter> reporter) {
  reporter_ = std::move(reporter);
  sink_ = reporter_->add_sink([this](D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) {
    const MessageKind kind = message_kind(error.id);
    store({kind.category, severity, kind.id, error.message});
  });
}

InfoQueue::~InfoQueue() {
  if (reporter_ != nullptr) reporter_->remove_sink(sink_);
}

void InfoQueue::store(StoredMessage message) {
  const StoredMessage told = message;
  std::vector<Callback> callbacks;
  bool breaks = false;
  {
    std::lock_guard lock(mutex_);
    const bool passes = storage_.lets_through(message);
    for (const auto& [cookie, callback] : callbacks_) {
      if (passes || callback.ignores_filters) callbacks.push_back(callback);
    }
    breaks =
        passes && (break_categories_.contains(message.category) ||
                   break_severities_.contains(message.severity) || break_ids_.contains(message.id));
    keep(std::move(message), passes);
  }
  // Without the lock: a callback may unregister itself, or meet another error.
  for (const Callback& callback : callbacks) {
    callback.function(told.category, told.severity, told.id, told.text.c_str(), callback.context);
  }
  if (breaks) std::raise(SIGTRAP);
}

void InfoQueue::keep(StoredMessage message, bool passes) {
  ++(passes ? allowed_ : denied_);
  if (!passes) return;
  if (limit_ == 0) {  // 2^64 - 1: no limit
    ++discarded_;
    return;
  }
  while (messages_.size() >= limit_) {
    messages_.pop_front();
    ++discarded_;
  }
  messages_.push_back(std::move(message));
}

HRESULT InfoQueue::SetMessageCountLimit(UINT64 limit) {
  std::lock_guard lock(mutex_);
  limit_ = limit;
  while (messages_.size() > limit_) {
    messages_.pop_front();
    ++discarded_;
  }
  return S_OK;
}

void InfoQueue::ClearStoredMessages() {
  std::lock_guard lock(mutex_);
  messages_.clear();
}

HRESULT InfoQueue::GetMessage(UINT64 index, D3D12_MESSAGE* message, SIZE_T* size) {
  if (size == nullptr) return E_INVALIDARG;
  std::lock_guard lock(mutex_);
  // The index counts what the retrieval filter lets through.
  const StoredMessage* found = nullptr;
  for (const StoredMessage& m : messages_) {
    if (!retrieval_.lets_through(m)) continue;
    if (index-- == 0) {
      found = &m;
      break;
    }
  }
  if (found == nullptr) return E_INVALIDARG;
  const SIZE_T room = *size;
  *size = sizeof(D3D12_MESSAGE) + found->text.size() + 1;
  if (message == nullptr) return S_FALSE;
  if (room < *size) return E_INVALIDARG;
  char* text = reinterpret_cast<char*>(message + 1);
  std::memcpy(text, found->text.c_str(), found->text.size() + 1);
  *message = {found->category, found->severity, found->id, text, found->text.size() + 1};
  return S_OK;
}

UINT64 InfoQueue::GetNumMessagesAllowedByStorageFilter() {
  std::lock_guard lock(mutex_);
  return allowed_;
}
UINT64 InfoQueue::GetNumMessagesDeniedByStorageFilter() {
  std::lock_guard lock(mutex_);
  return denied_;
}
UINT64 InfoQueue::GetNumStoredMessages() {
  std::lock_guard lock(mutex_);
  return messages_.size();
}
UINT64 InfoQueue::GetNumStoredMessagesAllowedByRetrievalFilter() {
  std::lock_guard lock(mutex_);
  UINT64 count = 0;
  for (const StoredMessage& m : messages_) count += retrieval_.lets_through(m) ? 1 : 0;
  return count;
}
UINT64 InfoQueue::GetNumMessagesDiscardedByMessageCountLimit() {
  std::lock_guard lock(mutex_);
  return discarded_;
}
UINT64 InfoQueue::GetMessageCountLimit() {
  std::lock_guard lock(mutex_);
  return limit_;
}

// ---------------------------------------------------------------------------------------------
// Filters of the queue

HRESULT InfoQueue::AddStorageFilterEntries(D3D12_INFO_QUEUE_FILTER* filter) {
  if (filter == nullptr) return E_INVALIDARG;
  std::lock_guard lock(mutex_);
  storage_.top().add(*filter);
  return S_OK;
}
HRESULT InfoQueue::GetStorageFilter(D3D12_INFO_QUEUE_FILTER* filter, SIZE_T* size) {
  std::lock_guard lock(mutex_);
  return storage_.write(filter, size);
}
void InfoQueue::ClearStorageFilter() {
  std::lock_guard lock(mutex_);
  storage_.top() = {};
}
HRESULT InfoQueue::PushEmptyStorageFilter() {
  std::lock_guard lock(mutex_);
  storage_.push({});
  return S_OK;
}
HRESULT InfoQueue::PushCopyOfStorageFilter() {
  std::lock_guard lock(mutex_);
  storage_.push_copy();
  return S_OK;
}
HRESULT InfoQueue::PushStorageFilter(D3D12_INFO_QUEUE_FILTER* filter) {
  if (filter == nullptr) return E_INVALIDARG;
  MessageFilter pushed;
  pushed.add(*filter);
  std::lock_guard lock(mutex_);
  storage_.push(std::move(pushed));
  return S_OK;
}
void InfoQueue::PopStorageFilter() {
  std::lock_guard lock(mutex_);
  storage_.pop();
}
UINT InfoQueue::GetStorageFilterStackSize() {
  std::lock_guard lock(mutex_);
  return storage_.size();
}

HRESULT InfoQueue::AddRetrievalFilterEntries(D3D12_INFO_QUEUE_FILTER* filter) {
  if (filter == nullptr) return E_INVALIDARG;
  std::lock_guard lock(mutex_);
  retrieval_.top().add(*filter);
  return S_OK;
}
HRESULT InfoQueue::GetRetrievalFilter(D3D12_INFO_QUEUE_FILTER* filter, SIZE_T* size) {
  std::lock_guard lock(mutex_);
  return retrieval_.write(filter, size);
}
void InfoQueue::ClearRetrievalFilter() {
  std::lock_guard lock(mutex_);
  retrieval_.top() = {};
}
HRESULT InfoQueue::PushEmptyRetrievalFilter() {
  std::lock_guard lock(mutex_);
  retrieval_.push({});
  return S_OK;
}
HRESULT InfoQueue::PushCopyOfRetrievalFilter() {
  std::lock_guard lock(mutex_);
  retrieval_.push_copy();
  return S_OK;
}
HRESULT InfoQueue::PushRetrievalFilter(D3D12_INFO_QUEUE_FILTER* filter) {
  if (filter == nullptr) return E_INVALIDARG;
  MessageFilter pushed;
  pushed.add(*filter);
  std::lock_guard lock(mutex_);
  retrieval_.push(std::move(pushed));
  return S_OK;
}
void InfoQueue::PopRetrievalFilter() {
  std::lock_guard lock(mutex_);
  retrieval_.pop();
}
UINT InfoQueue::GetRetrievalFilterStackSize() {
  std::lock_guard lock(mutex_);
  return retrieval_.size();
}

// ---------------------------------------------------------------------------------------------
// Messages of the program, breaks, callbacks

HRESULT InfoQueue::AddMessage(D3D12_MESSAGE_CATEGORY category, D3D12_MESSAGE_SEVERITY severity,
                              D3D12_MESSAGE_ID id, LPCSTR text) {
  if (text == nullptr) return E_INVALIDARG;
  store({category, severity, id, text});
  return S_OK;
}

HRESULT InfoQueue::AddApplicationMessage(D3D12_MESSAGE_SEVERITY severity, LPCSTR text) {
  return AddMessage(D3D12_MESSAGE_CATEGORY_APPLICATION_DEFINED, severity,
                    D3D12_MESSAGE_ID_STRING_FROM_APPLICATION, text);
}

namespace {

template <class T>
void set_break(std::set<T>& breaks, T value, BOOL enable) {
  if (enable) {
    breaks.insert(value);
  } else {
    breaks.erase(value);
  }
}

}  // namespace

HRESULT InfoQueue::SetBreakOnCategory(D3D12_MESSAGE_CATEGORY category, BOOL enable) {
  std::lock_guard lock(mutex_);
  set_break(break_categories_, category, enable);
  return S_OK;
}
HRESULT InfoQueue::SetBreakOnSeverity(D3D12_MESSAGE_SEVERITY severity, BOOL enable) {
  std::lock_guard lock(mutex_);
  set_break(break_severities_, severity, enable);
  return S_OK;
}
HRESULT InfoQueue::SetBreakOnID(D3D12_MESSAGE_ID id, BOOL enable) {
  std::lock_guard lock(mutex_);
  set_break(break_ids_, id, enable);
  return S_OK;
}
BOOL InfoQueue::GetBreakOnCategory(D3D12_MESSAGE_CATEGORY category) {
  std::lock_guard lock(mutex_);
  return break_categories_.contains(category);
}
BOOL InfoQueue::GetBreakOnSeverity(D3D12_MESSAGE_SEVERITY severity) {
  std::lock_guard lock(mutex_);
  return break_severities_.contains(severity);
}
BOOL InfoQueue::GetBreakOnID(D3D12_MESSAGE_ID id) {
  std::lock_guard lock(mutex_);
  return break_ids_.contains(id);
}

void InfoQueue::SetMuteDebugOutput(BOOL mute) {
  reporter_->mute(mute != FALSE);
}
BOOL InfoQueue::GetMuteDebugOutput() {
  return reporter_->muted();
}

HRESULT InfoQueue::RegisterMessageCallback(D3D12MessageFunc callback,
                                           D3D12_MESSAGE_CALLBACK_FLAGS flags, void* context,
                                           DWORD* cookie) {
  if (callback == nullptr || cookie == nullptr) return E_INVALIDARG;
  std::lock_guard lock(mutex_);
  *cookie = next_cookie_++;
  callbacks_[*cookie] = {callback, (flags & D3D12_MESSAGE_CALLBACK_IGNORE_FILTERS) != 0, context};
  return S_OK;
}

HRESULT InfoQueue::UnregisterMessageCallback(DWORD cookie) {
  std::lock_guard lock(mutex_);
  return callbacks_.erase(cookie) != 0 ? S_OK : E_INVALIDARG;
}

}  // namespace kaamos::d3d12
