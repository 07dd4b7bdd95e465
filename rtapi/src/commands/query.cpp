// SPDX-License-Identifier: MIT
//
// Heaps of timestamp queries, and the commands that write and read them.
#include <rtapi/query.h>

#include <rtapi/command_queue.h>
#include <rtapi/device.h>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/commands/command_queue_impl.h"
#include "rtapi/src/resources/resource_impl.h"

namespace rtapi {

namespace detail {

struct QueryHeapImpl {
  std::shared_ptr<DeviceImpl> device;
  QueryHeapDesc desc;
  std::shared_ptr<runtime::BackendQueryHeap> queries;
};

}  // namespace detail

using namespace detail;

namespace {

constexpr uint32_t kMaxQueries = 1 << 20;
constexpr uint64_t kResolveAlignment = 8;  // [D3D12: ResolveQueryData]
const QueryHeapDesc kEmptyHeap;

// Checks queries `first` to `first + count` of a heap.
Status check_queries(const CommandListImpl& list, const char* call, const QueryHeap& heap,
                     QueryType type, uint32_t first, uint32_t count) {
  if (Status s = CheckHandle(list.device, heap, concat(call, ": heap")); !s.ok()) return s;
  const std::string where = concat(call, ": ", named("query heap", heap.GetDesc().Name));
  if (type != QueryType::kTimestamp) {
    return make_error(Id::kQuery, where, ": type ", static_cast<uint32_t>(type),
                      "; it must be kTimestamp (2)");
  }
  const uint32_t total = heap.GetDesc().Count;
  if (first > total || count > total - first) {
    return make_error(Id::kQuery, where, ": queries ", first, "..", uint64_t{first} + count,
                      " do not exist; there are ", total);
  }
  return {};
}

Status check_destination(const CommandListImpl& list, const Buffer& buffer, uint64_t offset,
                         uint64_t bytes) {
  if (Status s = CheckHandle(list.device, buffer, "ResolveQueryData: destination"); !s.ok()) {
    return s;
  }
  const std::string where = concat("ResolveQueryData: ", named("buffer", buffer.name()));
  if (buffer.GetDesc().Heap == HeapType::kUpload ||
      buffer.GetDesc().InitialState == ResourceStates::kRaytracingAccelerationStructure) {
    return make_error(
        Id::kQuery, where,
        " is on the upload heap or holds acceleration structures; resolve to a buffer "
        "of the default or readback heap");
  }
  if (offset % kResolveAlignment != 0 || offset > buffer.size() || bytes > buffer.size() - offset) {
    return make_error(Id::kQuery, where, ": bytes ", offset, "..", offset + bytes,
                      "; the offset must be a multiple of 8, and the buffer has ", buffer.size(),
                      " bytes");
  }
  return {};
}

}  // namespace

const QueryHeapDesc& QueryHeap::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyHeap;
}

Result<QueryHeap> Device::CreateQueryHeap(const QueryHeapDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateQueryHeap on an empty device handle");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  const std::string name = named("query heap", desc.Name);
  if (desc.Type != QueryHeapType::kTimestamp) {
    return make_error(Id::kQueryHeap, name, " has type ", static_cast<uint32_t>(desc.Type),
                      "; it must be kTimestamp (1)");
  }
  if (desc.Count == 0 || desc.Count > kMaxQueries) {
    return make_error(Id::kQueryHeap, name, " has ", desc.Count, " queries; it must have 1 to ",
                      kMaxQueries);
  }
  auto queries = impl_->backend->create_query_heap(desc.Count);
  if (!queries.ok()) return queries.error();
  return QueryHeap(
      std::make_shared<QueryHeapImpl>(QueryHeapImpl{impl_, desc, std::move(*queries)}));
}

void CommandList::EndQuery(const QueryHeap& heap, QueryType type, uint32_t index) {
  if (!impl_ || !impl_->check_open("EndQuery")) return;
  if (Status s = check_queries(*impl_, "EndQuery", heap, type, index, 1); !s.ok()) {
    return impl_->fail(s.error());
  }
  impl_->record(runtime::TimestampCommand{heap.impl()->queries, index});
}

void CommandList::ResolveQueryData(const QueryHeap& heap, QueryType type, uint32_t start_index,
                                   uint32_t count, const Buffer& destination,
                                   uint64_t destination_offset_bytes) {
  if (!impl_ || !impl_->check_open("ResolveQueryData")) return;
  if (Status s = check_queries(*impl_, "ResolveQueryData", heap, type, start_index, count);
      !s.ok()) {
    return impl_->fail(s.error());
  }
  const uint64_t bytes = uint64_t{count} * sizeof(uint64_t);
  if (Status s = check_destination(*impl_, destination, destination_offset_bytes, bytes); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (count == 0) return;
  impl_->record(runtime::ResolveTimestampsCommand{heap.impl()->queries, start_index, count,
                                                  destination.impl()->memory,
                                                  destination_offset_bytes});
}

Result<uint64_t> CommandQueue::GetTimestampFrequency() const {
  if (!impl_) return make_error(Id::kNullHandle, "GetTimestampFrequency on an empty queue handle");
  return impl_->device->backend->timestamp_frequency();
}

}  // namespace rtapi
