// SPDX-License-Identifier: MIT
//
// Tests what queries record, and what is refused.
#include <rtapi/query.h>

#include "rtapi/testing/command_list_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;

class QueryTest : public CommandListTest {
 protected:
  QueryTest() {
    heap_ = device_.CreateQueryHeap({.Count = 8, .Name = "times"}).value();
    buffer_ = MakeBuffer(64);
  }
  Status Resolve(uint32_t first, uint32_t count, uint64_t offset, const Buffer& buffer,
                 QueryType type = QueryType::kTimestamp) {
    return Record([&](CommandList& list) {
      list.ResolveQueryData(heap_, type, first, count, buffer, offset);
    });
  }

  QueryHeap heap_;
  Buffer buffer_;
};

TEST_F(QueryTest, HeapsAreChecked) {
  EXPECT_ERROR(device_.CreateQueryHeap({.Count = 0}), "KA0744", "1 to 1048576");
  EXPECT_ERROR(device_.CreateQueryHeap({.Count = (1 << 20) + 1}), "KA0744", "1048577");
  EXPECT_ERROR(device_.CreateQueryHeap({.Type = static_cast<QueryHeapType>(3), .Count = 1}),
               "KA0744", "type 3");
  EXPECT_ERROR(Device().CreateQueryHeap({.Count = 1}), "KA0904");
  EXPECT_EQ(heap_.GetDesc().Count, 8u);
  EXPECT_EQ(QueryHeap().GetDesc().Count, 0u);
  EXPECT_FALSE(QueryHeap());
}

TEST_F(QueryTest, CommandsAreRecorded) {
  list_.EndQuery(heap_, QueryType::kTimestamp, 7);
  list_.ResolveQueryData(heap_, QueryType::kTimestamp, 1, 7, buffer_, 8);
  list_.ResolveQueryData(heap_, QueryType::kTimestamp, 8, 0, buffer_, 64);  // nothing
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_EQ(null_log().executed.size(), 2u);
  EXPECT_EQ(Executed<runtime::TimestampCommand>(0).index, 7u);
  const auto& resolve = Executed<runtime::ResolveQueriesCommand>(1);
  EXPECT_EQ(resolve.heap, Executed<runtime::TimestampCommand>(0).heap);
  EXPECT_EQ(resolve.first, 1u);
  EXPECT_EQ(resolve.count, 7u);
  EXPECT_EQ(resolve.dest_offset, 8u);
  EXPECT_EQ(queue_.GetTimestampFrequency().value(), 1000u);
  EXPECT_ERROR(CommandQueue().GetTimestampFrequency(), "KA0904");
}

TEST_F(QueryTest, QueriesAreChecked) {
  const auto end = [&](const QueryHeap& heap, QueryType type, uint32_t index) {
    return Record([&](CommandList& list) { list.EndQuery(heap, type, index); });
  };
  EXPECT_ERROR(end(heap_, QueryType::kTimestamp, 8), "KA0745", "times", "there are 8");
  EXPECT_ERROR(end(heap_, QueryType::kOcclusion, 0), "KA0745", "kTimestamp (2)");
  EXPECT_ERROR(end({}, QueryType::kTimestamp, 0), "KA0904");
  const Device other = CreateNullDevice();
  EXPECT_ERROR(end(other.CreateQueryHeap({.Count = 1}).value(), QueryType::kTimestamp, 0),
               "KA0903");
}

TEST_F(QueryTest, DestinationsAreChecked) {
  EXPECT_OK(Resolve(0, 8, 0, buffer_));
  EXPECT_OK(Resolve(0, 8, 0, MakeBuffer(64, HeapType::kReadback)));
  EXPECT_ERROR(Resolve(0, 8, 8, buffer_), "KA0745", "8..72", "64 bytes");
  EXPECT_ERROR(Resolve(0, 1, 4, buffer_), "KA0745", "multiple of 8");
  EXPECT_ERROR(Resolve(0, 1, ~uint64_t{7}, buffer_), "KA0745");
  EXPECT_ERROR(Resolve(4, 5, 0, buffer_), "KA0745", "4..9");
  EXPECT_ERROR(Resolve(0, 1, 0, buffer_, QueryType::kBinaryOcclusion), "KA0745", "type 1");
  EXPECT_ERROR(Resolve(0, 1, 0, MakeBuffer(64, HeapType::kUpload)), "KA0745", "upload heap");
  EXPECT_ERROR(Resolve(0, 1, 0, {}), "KA0904");
}

TEST_F(QueryTest, QueriesOfDrawsAreRecorded) {
  const QueryHeap heap =
      device_.CreateQueryHeap({.Type = QueryHeapType::kPipelineStatistics, .Count = 4}).value();
  constexpr QueryType kType = QueryType::kPipelineStatistics;
  const Buffer large = MakeBuffer(256);
  list_.BeginQuery(heap, kType, 2);
  list_.BeginQuery(heap, kType, 3);
  list_.EndQuery(heap, kType, 2);
  list_.EndQuery(heap, kType, 3);
  list_.ResolveQueryData(heap, kType, 2, 2, large, 80);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_EQ(Executed<runtime::BeginQueryCommand>(1).index, 3u);
  EXPECT_EQ(Executed<runtime::EndQueryCommand>(2).index, 2u);
  EXPECT_EQ(Executed<runtime::ResolveQueriesCommand>(4).type, kType);
  // 88 bytes each.
  EXPECT_ERROR(
      Record([&](CommandList& list) { list.ResolveQueryData(heap, kType, 0, 3, large, 0); }),
      "KA0745", "0..264");
}

// Queries and predicates that a program drops leave the rest of the list alone.
TEST_F(QueryTest, ErrorsOfQueriesNameTheQuery) {
  const QueryHeap heap =
      device_.CreateQueryHeap({.Type = QueryHeapType::kOcclusion, .Count = 4, .Name = "boxes"})
          .value();
  EXPECT_ERROR(Record([&](CommandList& list) { list.BeginQuery(heap, QueryType::kOcclusion, 3); }),
               "KA0745", "query 3", "boxes", "not ended");
  EXPECT_ERROR(
      Record([&](CommandList& list) { list.EndQuery(heap, QueryType::kBinaryOcclusion, 1); }),
      "KA0745", "query 1", "boxes", "not been begun");
  EXPECT_ERROR(Record([&](CommandList& list) {
                 list.SetPredication(buffer_, 60, PredicationOp::kEqualZero);
               }),
               "KA0829", "60..68", "64 bytes");
}

}  // namespace
}  // namespace rtapi::testing
