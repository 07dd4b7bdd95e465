// SPDX-License-Identifier: MIT
//
// Triangles one behind the other along z, a box beside them, and the pipeline and tables for
// explain.hlsl.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/explain.h>
#include <rtapi/rtapi.h>

#include <string>
#include <vector>

namespace kaamos::explain_test {

// Seen from (0.25, 0.25, 0) along z: two leaves with holes at t 1 and 2, an instance with another
// mask at 3, a back face at 4, the wall at 5, a triangle behind it at 6, one beyond TMax at 7. At x
// = 10.25 a procedural box from z 2 to 4.
class Scene : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override;
  // A new list with the 4 x 1 x 1 dispatch.
  rtapi::CommandList record();
  // results[x].
  std::vector<float> results();
  rtapi::TableDescription describe_tables();

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::StateObject pipeline_;
  rtapi::Buffer vertices_, boxes_, colors_, results_, zeros_;
  rtapi::Buffer triangle_, leaf_, box_, top_level_;
  rtapi::DescriptorHeap heap_;
  rtapi::Buffer tables_[4];
  rtapi::DispatchRaysDesc dispatch_;

 private:
  void build_structures();
  void build_pipeline();
  void build_tables();
};

#define KAAMOS_EXPLAIN_SUITE(suite)                                              \
  class suite : public kaamos::explain_test::Scene {};                           \
  INSTANTIATE_TEST_SUITE_P(Backends, suite, testing::Values("embree", "vulkan"), \
                           [](const auto& tested) { return std::string(tested.param); })

}  // namespace kaamos::explain_test
