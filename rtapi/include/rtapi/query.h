// SPDX-License-Identifier: MIT
/// @file
/// Timestamps: when the commands of a list were reached. [D3D12: Timing]
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace rtapi {

namespace detail {
struct QueryHeapImpl;
}

/// The kind of queries that a heap holds. [D3D12: D3D12_QUERY_HEAP_TYPE]
enum class QueryHeapType : uint32_t {
  kOcclusion = 0,  ///< not offered (KA0744)
  kTimestamp = 1,  ///< points in time: uint64_t, in ticks
};

/// The kind of query that CommandList::EndQuery asks for. [D3D12: D3D12_QUERY_TYPE]
enum class QueryType : uint32_t {
  kOcclusion = 0,        ///< not offered (KA0745)
  kBinaryOcclusion = 1,  ///< not offered (KA0745)
  kTimestamp = 2,        ///< of a heap of kTimestamp
};

/// Describes a heap of queries for Device::CreateQueryHeap. [D3D12: D3D12_QUERY_HEAP_DESC]
struct QueryHeapDesc {
  QueryHeapType Type = QueryHeapType::kTimestamp;  ///< what it holds
  uint32_t Count = 0;                              ///< queries: 1 to 2^20
  uint32_t NodeMask = 0;                           ///< ignored: there is one node
  std::string Name = {};                           ///< for messages
};

/// Keeps what queries found until ResolveQueryData copies it to a buffer. A copyable handle;
/// command lists keep the heap alive. [D3D12: ID3D12QueryHeap]
class QueryHeap {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same heap.
  ///@{
  QueryHeap() = default;
  explicit QueryHeap(std::shared_ptr<detail::QueryHeapImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const QueryHeap&) const = default;
  ///@}

  /// Returns the desc that the heap was created with; a default desc for an empty handle.
  const QueryHeapDesc& GetDesc() const;
  /// For the library itself.
  const std::shared_ptr<detail::QueryHeapImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::QueryHeapImpl> impl_;
};

}  // namespace rtapi
