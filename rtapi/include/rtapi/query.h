// SPDX-License-Identifier: MIT
/// @file
/// Queries: when the commands of a list were reached, and what its draws did. [D3D12: Queries]
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
  kOcclusion = 0,           ///< samples that passed the tests of depth and stencil
  kTimestamp = 1,           ///< points in time: uint64_t, in ticks
  kPipelineStatistics = 2,  ///< what draws and dispatches ran
};

/// The kind of a query, and what ResolveQueryData writes for it. [D3D12: D3D12_QUERY_TYPE]
enum class QueryType : uint32_t {
  /// uint64_t: samples of draws that passed the tests of depth and stencil, which they also do
  /// where there is no test. Samples that the pixel shader discards did not. Of kOcclusion.
  kOcclusion = 0,
  kBinaryOcclusion = 1,     ///< uint64_t: 1 if kOcclusion is not 0, else 0; of kOcclusion
  kTimestamp = 2,           ///< uint64_t: ticks; of kTimestamp
  kPipelineStatistics = 3,  ///< QueryDataPipelineStatistics; of kPipelineStatistics
};

/// What draws and dispatches of a query did. Backends may differ where D3D12 allows it: how often a
/// vertex is shaded, and how many triangles clipping makes. DispatchRays counts for nothing.
/// [D3D12: D3D12_QUERY_DATA_PIPELINE_STATISTICS]
struct QueryDataPipelineStatistics {
  uint64_t IAVertices = 0;     ///< vertices that draws asked for, of all instances
  uint64_t IAPrimitives = 0;   ///< triangles that they make
  uint64_t VSInvocations = 0;  ///< runs of the vertex shader
  uint64_t GSInvocations = 0;  ///< runs of the geometry shader
  uint64_t GSPrimitives = 0;   ///< what it made
  uint64_t CInvocations = 0;   ///< triangles that came to clipping
  uint64_t CPrimitives = 0;    ///< triangles that went on from it
  uint64_t PSInvocations = 0;  ///< runs of the pixel shader; without helpers on Embree
  uint64_t HSInvocations = 0;  ///< 0: there are no hull shaders
  uint64_t DSInvocations = 0;  ///< 0: there are no domain shaders
  uint64_t CSInvocations = 0;  ///< threads of Dispatch
};

/// When a predicate leaves commands out, by all 64 bits of its value. [D3D12: D3D12_PREDICATION_OP]
enum class PredicationOp : uint32_t {
  kEqualZero = 0,     ///< where they are 0
  kNotEqualZero = 1,  ///< where they are not 0
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
