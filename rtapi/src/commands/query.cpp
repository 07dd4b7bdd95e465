// SPDX-License-Identifier: MIT
//
// Heaps of queries, the commands that write and read them, and predication.
#include <rtapi/query.h>

#include <algorithm>

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

// The types of a heap's queries, for messages.
const char* types_of(QueryHeapType heap) {
  switch (heap) {
    case QueryHeapType::kOcclusion:
      return "kOcclusion (0) or kBinaryOcclusion (1)";
    case QueryHeapType::kTimestamp:
      return "kTimestamp (2)";
    case QueryHeapType::kPipelineStatistics:
      break;
  }
  return "kPipelineStatistics (3)";
}

bool has_type(QueryHeapType heap, QueryType type) {
  switch (type) {
    case QueryType::kOcclusion:
    case QueryType::kBinaryOcclusion:
      return heap == QueryHeapType::kOcclusion;
    case QueryType::kTimestamp:
      return heap == QueryHeapType::kTimestamp;
    case QueryType::kPipelineStatistics:
      return heap == QueryHeapType::kPipelineStatistics;
  }
  return false;
}

// Checks queries `first` to `first + count` of a heap.
Status check_queries(const CommandListImpl& list, const char* call, const QueryHeap& heap,
                     QueryType type, uint32_t first, uint32_t count) {
  if (Status s = CheckHandle(list.device, heap, concat(call, ": heap")); !s.ok()) return s;
  const std::string where = concat(call, ": ", named("query heap", heap.GetDesc().Name));
  if (!has_type(heap.GetDesc().Type, type)) {
    return make_error(Id::kQuery, where, ": type ", static_cast<uint32_t>(type), "; it must be ",
                      types_of(heap.GetDesc().Type));
  }
  const uint32_t total = heap.GetDesc().Count;
  if (first > total || count > total - first) {
    return make_error(Id::kQuery, where, ": queries ", first, "..", uint64_t{first} + count,
                      " do not exist; there are ", total);
  }
  return {};
}

// Returns the first query of the range that has been begun and not ended, or the end.
auto find_open(CommandListImpl& list, const QueryHeap& heap, uint32_t first, uint32_t count) {
  return std::find_if(list.open_queries.begin(), list.open_queries.end(), [&](const auto& open) {
    return open.heap == heap && open.index >= first && open.index - first < count;
  });
}

std::shared_ptr<runtime::CountingQueries> counting(const QueryHeap& heap) {
  return std::static_pointer_cast<runtime::CountingQueries>(heap.impl()->queries);
}

Error query_error(const char* call, const QueryHeap& heap, uint32_t index, const char* what) {
  return make_error(Id::kQuery, call, ": query ", index, " of ",
                    named("query heap", heap.GetDesc().Name), what);
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
  if (desc.Type > QueryHeapType::kPipelineStatistics) {
    return make_error(Id::kQueryHeap, name, " has type ", static_cast<uint32_t>(desc.Type),
                      "; it must be kOcclusion (0), kTimestamp (1) or kPipelineStatistics (2)");
  }
  if (desc.Count == 0 || desc.Count > kMaxQueries) {
    return make_error(Id::kQueryHeap, name, " has ", desc.Count, " queries; it must have 1 to ",
                      kMaxQueries);
  }
  auto queries = impl_->backend->create_query_heap(desc.Type, desc.Count);
  if (!queries.ok()) return queries.error();
  return QueryHeap(
      std::make_shared<QueryHeapImpl>(QueryHeapImpl{impl_, desc, std::move(*queries)}));
}

void CommandList::BeginQuery(const QueryHeap& heap, QueryType type, uint32_t index) {
  if (!impl_ || !impl_->check_open("BeginQuery")) return;
  if (Status s = check_queries(*impl_, "BeginQuery", heap, type, index, 1); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (type == QueryType::kTimestamp) {
    return impl_->fail(query_error("BeginQuery", heap, index,
                                   " is a timestamp, which has no beginning; call EndQuery only"));
  }
  if (find_open(*impl_, heap, index, 1) != impl_->open_queries.end()) {
    return impl_->fail(
        query_error("BeginQuery", heap, index, " has been begun; call EndQuery for it first"));
  }
  impl_->open_queries.push_back({heap, type, index});
  impl_->record(runtime::BeginQueryCommand{counting(heap), index});
}

void CommandList::EndQuery(const QueryHeap& heap, QueryType type, uint32_t index) {
  if (!impl_ || !impl_->check_open("EndQuery")) return;
  if (Status s = check_queries(*impl_, "EndQuery", heap, type, index, 1); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (type == QueryType::kTimestamp) {
    return impl_->record(runtime::TimestampCommand{heap.impl()->queries, index});
  }
  const auto open = find_open(*impl_, heap, index, 1);
  if (open == impl_->open_queries.end()) {
    return impl_->fail(
        query_error("EndQuery", heap, index, " has not been begun in this list; call BeginQuery"));
  }
  if (open->type != type) {
    return impl_->fail(query_error("EndQuery", heap, index, " was begun as one of another type"));
  }
  impl_->open_queries.erase(open);
  impl_->record(runtime::EndQueryCommand{counting(heap), index});
}

void CommandList::ResolveQueryData(const QueryHeap& heap, QueryType type, uint32_t start_index,
                                   uint32_t count, const Buffer& destination,
                                   uint64_t destination_offset_bytes) {
  if (!impl_ || !impl_->check_open("ResolveQueryData")) return;
  if (Status s = check_queries(*impl_, "ResolveQueryData", heap, type, start_index, count);
      !s.ok()) {
    return impl_->fail(s.error());
  }
  if (const auto open = find_open(*impl_, heap, start_index, count);
      open != impl_->open_queries.end()) {
    return impl_->fail(query_error("ResolveQueryData", heap, open->index,
                                   " is not ended; call EndQuery for it first"));
  }
  const uint64_t bytes = count * runtime::query_data_bytes(type);
  if (Status s = check_destination(*impl_, destination, destination_offset_bytes, bytes); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (count == 0) return;
  impl_->record(runtime::ResolveQueriesCommand{heap.impl()->queries, type, start_index, count,
                                               destination.impl()->memory,
                                               destination_offset_bytes});
}

void CommandList::SetPredication(const Resource& resource, uint64_t offset_bytes,
                                 PredicationOp op) {
  if (!impl_ || !impl_->check_open("SetPredication")) return;
  if (std::holds_alternative<Texture>(resource)) {
    return impl_->fail(make_error(
        Id::kPredication, "SetPredication: ", named("texture", std::get<Texture>(resource).name()),
        " has no predicate; pass a buffer"));
  }
  const Buffer buffer =
      std::holds_alternative<Buffer>(resource) ? std::get<Buffer>(resource) : Buffer();
  if (!buffer) {
    impl_->predicated = false;
    return impl_->record(runtime::PredicationCommand{});
  }
  if (Status s = CheckHandle(impl_->device, buffer, "SetPredication: buffer"); !s.ok()) {
    return impl_->fail(s.error());
  }
  if (op > PredicationOp::kNotEqualZero) {
    return impl_->fail(make_error(Id::kPredication, "SetPredication: operation ",
                                  static_cast<uint32_t>(op),
                                  "; it must be kEqualZero (0) or kNotEqualZero (1)"));
  }
  constexpr uint64_t kBytes = sizeof(uint64_t);
  if (offset_bytes % kBytes != 0 || buffer.size() < kBytes ||
      offset_bytes > buffer.size() - kBytes) {
    return impl_->fail(make_error(
        Id::kPredication, "SetPredication: ", named("buffer", buffer.name()), ": bytes ",
        offset_bytes, "..", offset_bytes + kBytes,
        "; the offset must be a multiple of 8, and the buffer has ", buffer.size(), " bytes"));
  }
  impl_->predicated = true;
  impl_->record(runtime::PredicationCommand{buffer.impl()->memory, offset_bytes, op});
}

Result<uint64_t> CommandQueue::GetTimestampFrequency() const {
  if (!impl_) return make_error(Id::kNullHandle, "GetTimestampFrequency on an empty queue handle");
  return impl_->device->backend->timestamp_frequency();
}

}  // namespace rtapi
