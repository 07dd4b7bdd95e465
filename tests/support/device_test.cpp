// SPDX-License-Identifier: MIT
#include <chrono>
#include <thread>

#include "tests/support/harness.h"

namespace {

using namespace rtapi;
using namespace kaamos::support;
using Clock = std::chrono::steady_clock;

KAAMOS_CALLS(Devices);

TEST_P(Devices, RemoveDevice) {
  Rays rays;
  rays.ray_generation = "TakeLong";
  const StateObject pipeline = device_.CreateStateObject(describe(rays)).value();
  ShaderTable table(pipeline);
  table.AddRecord(rays.ray_generation).value();
  table.Build(device_).value();
  DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = table.GetRecord(0);
  desc.Width = kCount;
  const auto list_of = [&](uint32_t dispatches) {
    CommandList list = device_.CreateCommandList().value();
    bind(list);
    list.SetPipelineState1(pipeline);
    for (uint32_t i = 0; i < dispatches; ++i) list.DispatchRays(desc);
    return list;
  };
  const Clock::time_point start = Clock::now();
  queue_.ExecuteAndWait(list_of(20)).value();
  const Clock::duration of_20 = Clock::now() - start;

  std::thread remover([&] {
    std::this_thread::sleep_for(of_20);
    EXPECT_TRUE(device_.RemoveDevice().ok());
  });
  const Clock::time_point long_start = Clock::now();
  const Status status = queue_.ExecuteAndWait(list_of(2000));
  remover.join();
  EXPECT_LT(Clock::now() - long_start, 50 * of_20);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0917");
  EXPECT_EQ(status.error().code, ErrorCode::kDeviceRemoved);
  EXPECT_EQ(device_.GetDeviceRemovedReason().error().message, status.error().message);
  EXPECT_TRUE(device_.RemoveDevice().ok());
  EXPECT_EQ(device_.CreateBuffer({.SizeInBytes = 16}).error().id.text(), "KA0917");
}

}  // namespace
