// SPDX-License-Identifier: MIT
#include "runtime/backend/queries.h"

#include <cstring>

namespace kaamos::runtime {
namespace {

using Statistics = rtapi::QueryDataPipelineStatistics;

template <class F>
void each_member(Statistics& to, const Statistics& from, const F& f) {
  for (uint64_t Statistics::*const member :
       {&Statistics::IAVertices, &Statistics::IAPrimitives, &Statistics::VSInvocations,
        &Statistics::GSInvocations, &Statistics::GSPrimitives, &Statistics::CInvocations,
        &Statistics::CPrimitives, &Statistics::PSInvocations, &Statistics::HSInvocations,
        &Statistics::DSInvocations, &Statistics::CSInvocations}) {
    f(to.*member, from.*member);
  }
}

}  // namespace

void WorkCounts::add(const WorkCounts& other) {
  samples += other.samples;
  each_member(statistics, other.statistics, [](uint64_t& to, uint64_t from) { to += from; });
}

WorkCounts WorkCounts::since(const WorkCounts& earlier) const {
  WorkCounts difference = *this;
  difference.samples -= earlier.samples;
  each_member(difference.statistics, earlier.statistics,
              [](uint64_t& to, uint64_t from) { to -= from; });
  return difference;
}

uint64_t query_data_bytes(rtapi::QueryType type) {
  return type == rtapi::QueryType::kPipelineStatistics ? sizeof(Statistics) : sizeof(uint64_t);
}

std::vector<uint8_t> CountingQueries::data(rtapi::QueryType type, uint32_t first,
                                           uint32_t count) const {
  const uint64_t bytes = query_data_bytes(type);
  std::vector<uint8_t> out(count * bytes);
  for (uint32_t i = 0; i < count; ++i) {
    if (!written(first + i)) continue;
    const WorkCounts& counts = counts_[first + i];
    if (type == rtapi::QueryType::kPipelineStatistics) {
      std::memcpy(out.data() + i * bytes, &counts.statistics, bytes);
      continue;
    }
    const uint64_t samples =
        type == rtapi::QueryType::kBinaryOcclusion ? counts.samples != 0 : counts.samples;
    std::memcpy(out.data() + i * bytes, &samples, bytes);
  }
  return out;
}

}  // namespace kaamos::runtime
