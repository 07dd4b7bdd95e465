// SPDX-License-Identifier: MIT
//
// Queries, predication, and the commands that write and read them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <rtapi/query.h>

namespace kaamos::runtime {

class BackendBuffer;

// Remembers by index which queries were ended.
class BackendQueryHeap {
 public:
  explicit BackendQueryHeap(uint32_t count) : written_(count) {}
  virtual ~BackendQueryHeap() = default;

  // Tells whether a query has been ended when commands have run up to the present one. For the
  // thread that executes.
  bool written(uint32_t index) const { return written_[index]; }
  void set_written(uint32_t index) { written_[index] = true; }

 private:
  std::vector<bool> written_;
};

// Sums over the work of a list.
struct WorkCounts {
  uint64_t samples = 0;  // that passed all tests
  rtapi::QueryDataPipelineStatistics statistics = {};

  void add(const WorkCounts& other);
  WorkCounts since(const WorkCounts& earlier) const;
};

// The sums that somebody asks for.
struct WorkToCount {
  bool samples = false;
  bool statistics = false;

  bool any() const { return samples || statistics; }
};

// Queries of draws and dispatches. A query is the difference of two sums, so that queries may
// overlap although a GPU runs one at a time.
class CountingQueries final : public BackendQueryHeap {
 public:
  CountingQueries(rtapi::QueryHeapType type, uint32_t count)
      : BackendQueryHeap(count), type_(type), counts_(count) {}

  rtapi::QueryHeapType type() const { return type_; }
  void begin(uint32_t index, const WorkCounts& now) { counts_[index] = now; }
  void end(uint32_t index, const WorkCounts& now) { counts_[index] = now.since(counts_[index]); }
  // Writes what ResolveQueryData does.
  std::vector<uint8_t> data(rtapi::QueryType type, uint32_t first, uint32_t count) const;

 private:
  rtapi::QueryHeapType type_;
  std::vector<WorkCounts> counts_;  // of a query that runs: those at its beginning
};

// Bytes of a resolved query.
uint64_t query_data_bytes(rtapi::QueryType type);

struct BeginQueryCommand {
  std::shared_ptr<CountingQueries> heap;
  uint32_t index = 0;
};

struct EndQueryCommand {
  std::shared_ptr<CountingQueries> heap;
  uint32_t index = 0;
};

// The time when all earlier commands of the list are done.
struct TimestampCommand {
  std::shared_ptr<BackendQueryHeap> heap;
  uint32_t index = 0;
};

// Copies queries to a buffer; zeros for those that were never ended.
struct ResolveQueriesCommand {
  std::shared_ptr<BackendQueryHeap> heap;  // CountingQueries unless `type` is kTimestamp
  rtapi::QueryType type = rtapi::QueryType::kTimestamp;
  uint32_t first = 0;
  uint32_t count = 0;
  std::shared_ptr<BackendBuffer> dest;
  uint64_t dest_offset = 0;  // a multiple of 8
};

// Leaves out the commands behind it if a value is as `op` says.
struct PredicationCommand {
  std::shared_ptr<BackendBuffer> buffer;  // null: leaves out nothing
  uint64_t offset = 0;                    // bytes, a multiple of 8
  rtapi::PredicationOp op = rtapi::PredicationOp::kEqualZero;
};

}  // namespace kaamos::runtime
