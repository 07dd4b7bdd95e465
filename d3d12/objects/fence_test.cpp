// SPDX-License-Identifier: MIT
#include <thread>

#include "d3d12/objects/d3d12_fixture.h"

namespace kaamos::d3d12 {
namespace {

class FenceCalls : public D3d12Test {
 protected:
  ComPtr<ID3D12Fence> fence(UINT64 value) {
    ComPtr<ID3D12Fence> out;
    EXPECT_EQ(device_->CreateFence(value, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(out.GetAddressOf())),
              S_OK);
    return out;
  }
};

TEST_F(FenceCalls, AnEventIsSetOnceTheValueIsReached) {
  const auto fence = this->fence(3);
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  ASSERT_EQ(fence->SetEventOnCompletion(3, event), S_OK);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_OBJECT_0);
  ASSERT_EQ(fence->SetEventOnCompletion(4, event), S_OK);
  EXPECT_EQ(WaitForSingleObject(event, 20), WAIT_TIMEOUT);
  ASSERT_EQ(fence->Signal(4), S_OK);
  EXPECT_EQ(WaitForSingleObject(event, 60000), WAIT_OBJECT_0);
  CloseHandle(event);
}

TEST_F(FenceCalls, TheProgramMayCloseItsHandleBeforehand) {
  const auto fence = this->fence(0);
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  ASSERT_EQ(fence->SetEventOnCompletion(1, event), S_OK);
  CloseHandle(event);
  ASSERT_EQ(fence->Signal(1), S_OK);
  EXPECT_TRUE(messages().empty());
}

TEST_F(FenceCalls, AQueueThatWaitsLetsTheEventWaitToo) {
  const auto gate = fence(0), done = fence(0);
  ASSERT_EQ(queue_->Wait(gate.Get(), 1), S_OK);
  ASSERT_EQ(queue_->Signal(done.Get(), 7), S_OK);
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  ASSERT_EQ(done->SetEventOnCompletion(7, event), S_OK);
  EXPECT_EQ(WaitForSingleObject(event, 20), WAIT_TIMEOUT);
  std::thread other([&] { gate->Signal(1); });
  EXPECT_EQ(WaitForSingleObject(event, 60000), WAIT_OBJECT_0);
  other.join();
  EXPECT_EQ(done->GetCompletedValue(), 7u);
  CloseHandle(event);
}

TEST_F(FenceCalls, SeveralFencesAllOrAny) {
  ComPtr<ID3D12Device1> device;
  ASSERT_EQ(device_.As(&device), S_OK);
  const auto a = fence(0), b = fence(2);
  ID3D12Fence* const fences[] = {a.Get(), b.Get()};
  const UINT64 values[] = {1, 2};
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  ASSERT_EQ(device->SetEventOnMultipleFenceCompletion(fences, values, 2,
                                                      D3D12_MULTIPLE_FENCE_WAIT_FLAG_ANY, event),
            S_OK);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_OBJECT_0);
  ASSERT_EQ(device->SetEventOnMultipleFenceCompletion(fences, values, 2,
                                                      D3D12_MULTIPLE_FENCE_WAIT_FLAG_ALL, event),
            S_OK);
  EXPECT_EQ(WaitForSingleObject(event, 20), WAIT_TIMEOUT);
  a->Signal(1);
  EXPECT_EQ(WaitForSingleObject(event, 60000), WAIT_OBJECT_0);
  CloseHandle(event);
}

// No thread stands between them: WaitForSingleObject does not wait.
TEST_F(FenceCalls, SignalSetsEventsBeforeItReturns) {
  const auto fence = this->fence(0);
  HANDLE events[4];
  for (UINT64 i = 0; i < 4; ++i) {
    events[i] = CreateEvent(nullptr, FALSE, FALSE, nullptr);
    ASSERT_EQ(fence->SetEventOnCompletion(i + 1, events[i]), S_OK);
  }
  ASSERT_EQ(fence->Signal(2), S_OK);
  ASSERT_EQ(fence->Signal(1), S_OK);  // back: what was set stays set
  for (UINT64 i = 0; i < 4; ++i) {
    EXPECT_EQ(WaitForSingleObject(events[i], 0), i < 2 ? WAIT_OBJECT_0 : WAIT_TIMEOUT) << i;
  }
  EXPECT_EQ(fence->GetCompletedValue(), 1u);
  ASSERT_EQ(queue_->Signal(fence.Get(), 4), S_OK);
  for (int i = 2; i < 4; ++i) EXPECT_EQ(WaitForSingleObject(events[i], 0), WAIT_OBJECT_0) << i;
  for (const HANDLE event : events) CloseHandle(event);
}

TEST_F(FenceCalls, SeveralFencesSetTheirEventWithTheLastOne) {
  ComPtr<ID3D12Device1> device;
  ASSERT_EQ(device_.As(&device), S_OK);
  const auto a = fence(0), b = fence(0);
  ID3D12Fence* const fences[] = {a.Get(), b.Get()};
  const UINT64 values[] = {1, 2};
  const HANDLE all = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  const HANDLE any = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  ASSERT_EQ(device->SetEventOnMultipleFenceCompletion(fences, values, 2,
                                                      D3D12_MULTIPLE_FENCE_WAIT_FLAG_ALL, all),
            S_OK);
  ASSERT_EQ(device->SetEventOnMultipleFenceCompletion(fences, values, 2,
                                                      D3D12_MULTIPLE_FENCE_WAIT_FLAG_ANY, any),
            S_OK);
  b->Signal(2);
  EXPECT_EQ(WaitForSingleObject(all, 0), WAIT_TIMEOUT);
  EXPECT_EQ(WaitForSingleObject(any, 0), WAIT_OBJECT_0);
  a->Signal(1);
  EXPECT_EQ(WaitForSingleObject(all, 0), WAIT_OBJECT_0);
  EXPECT_EQ(WaitForSingleObject(any, 0), WAIT_TIMEOUT);  // set once
  EXPECT_EQ(device->SetEventOnMultipleFenceCompletion(
                fences, values, 2, static_cast<D3D12_MULTIPLE_FENCE_WAIT_FLAGS>(2), all),
            E_INVALIDARG);
  CloseHandle(all);
  CloseHandle(any);
}

TEST_F(FenceCalls, RemovalSetsEvents) {
  const auto fence = this->fence(0);
  const HANDLE event = CreateEvent(nullptr, FALSE, FALSE, nullptr);
  ASSERT_EQ(fence->SetEventOnCompletion(1, event), S_OK);
  ID3D12CommandList* lists[] = {list_.Get()};
  queue_->ExecuteCommandLists(1, lists);  // it is open
  EXPECT_EQ(device_->GetDeviceRemovedReason(), DXGI_ERROR_INVALID_CALL);
  EXPECT_EQ(WaitForSingleObject(event, 0), WAIT_OBJECT_0);
  EXPECT_EQ(fence->GetCompletedValue(), UINT64_MAX);
  CloseHandle(event);
}

}  // namespace
}  // namespace kaamos::d3d12
