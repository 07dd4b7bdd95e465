// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/draw_queries.h"

namespace kaamos::vulkan {
namespace {

// Results come in the order of these bits. Our own geometry shader counts, too.
// [barycentrics_stage.h]
constexpr VkQueryPipelineStatisticFlags kStatistics =
    VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT |
    VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_PRIMITIVES_BIT |
    VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
    VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT;

struct StatisticsResult {
  uint64_t primitives, vertices, geometry, emitted, clipped, after_clipping, pixels;
};

constexpr VkQueryResultFlags kResult = VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT;

}  // namespace

DrawQueries::~DrawQueries() {
  for (const Pools& pools : pools_) {
    gpu_.vk().vkDestroyQueryPool(gpu_.device(), pools.samples, nullptr);
    gpu_.vk().vkDestroyQueryPool(gpu_.device(), pools.statistics, nullptr);
  }
}

rtapi::Status DrawQueries::create_pools() {
  Pools& pools = pools_.emplace_back();
  VkQueryPoolCreateInfo info = {VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryCount = kQueries;
  info.queryType = VK_QUERY_TYPE_OCCLUSION;
  VkResult r = gpu_.vk().vkCreateQueryPool(gpu_.device(), &info, nullptr, &pools.samples);
  if (r == VK_SUCCESS && gpu_.features().pipeline_statistics) {
    info.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
    info.pipelineStatistics = kStatistics;
    r = gpu_.vk().vkCreateQueryPool(gpu_.device(), &info, nullptr, &pools.statistics);
  }
  return r == VK_SUCCESS ? rtapi::Status() : gpu_.error(r, "queries of draws");
}

rtapi::Status DrawQueries::prepare(VkCommandBuffer commands) {
  const size_t pool = queries_.size() / kQueries;
  if (pool == pools_.size()) {
    if (auto s = create_pools(); !s) return s;
  }
  if (queries_.size() % kQueries != 0) return {};
  for (const VkQueryPool one : {pools_[pool].samples, pools_[pool].statistics}) {
    if (one != VK_NULL_HANDLE) gpu_.vk().vkCmdResetQueryPool(commands, one, 0, kQueries);
  }
  return {};
}

void DrawQueries::begin(VkCommandBuffer commands) {
  const auto query = static_cast<uint32_t>(queries_.size());
  const Pools& pools = pools_[query / kQueries];
  queries_.push_back(what_);
  if (what_.samples) {
    gpu_.vk().vkCmdBeginQuery(commands, pools.samples, query % kQueries,
                              VK_QUERY_CONTROL_PRECISE_BIT);
  }
  if (what_.statistics) {
    gpu_.vk().vkCmdBeginQuery(commands, pools.statistics, query % kQueries, 0);
  }
}

void DrawQueries::end(VkCommandBuffer commands) {
  const auto query = static_cast<uint32_t>(queries_.size() - 1);
  const Pools& pools = pools_[query / kQueries];
  if (queries_[query].samples) {
    gpu_.vk().vkCmdEndQuery(commands, pools.samples, query % kQueries);
  }
  if (queries_[query].statistics) {
    gpu_.vk().vkCmdEndQuery(commands, pools.statistics, query % kQueries);
  }
}

rtapi::Status DrawQueries::read(uint32_t query, runtime::WorkCounts& sums) const {
  const Pools& pools = pools_[query / kQueries];
  const auto get = [&](VkQueryPool pool, auto& result) {
    return gpu_.vk().vkGetQueryPoolResults(gpu_.device(), pool, query % kQueries, 1, sizeof result,
                                           &result, sizeof result, kResult);
  };
  runtime::WorkCounts found;
  VkResult r = VK_SUCCESS;
  if (queries_[query].samples) r = get(pools.samples, found.samples);
  StatisticsResult statistics = {};
  if (r == VK_SUCCESS && queries_[query].statistics) r = get(pools.statistics, statistics);
  if (r != VK_SUCCESS) return gpu_.error(r, "reading a query");
  found.statistics.IAPrimitives = statistics.primitives;
  found.statistics.VSInvocations = statistics.vertices;
  found.statistics.GSInvocations = statistics.geometry;
  found.statistics.GSPrimitives = statistics.emitted;
  found.statistics.CInvocations = statistics.clipped;
  found.statistics.CPrimitives = statistics.after_clipping;
  found.statistics.PSInvocations = statistics.pixels;
  sums.add(found);
  return {};
}

rtapi::Status DrawQueries::read(runtime::WorkCounts& sums) {
  for (uint32_t query = 0; query < queries_.size(); ++query) {
    if (auto s = read(query, sums); !s) return s;
  }
  queries_.clear();
  return {};
}

}  // namespace kaamos::vulkan
