// SPDX-License-Identifier: MIT
#include <atomic>
#include <thread>

#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi::testing {
namespace {

class QueueTest : public ::testing::Test {
 protected:
  // A closed list that leaves its name in the log when it executes.
  CommandList Marker(const char* name) {
    CommandList list = device_.CreateCommandList().value();
    list.BeginEvent(name);
    list.EndEvent();
    EXPECT_TRUE(list.Close().ok());
    return list;
  }
  static std::string Executed() {
    std::string names;
    for (const auto& c : null_log().executed) {
      const auto* e = std::get_if<kaamos::runtime::EventCommand>(&c);
      if (e && e->begin) names += e->name;
    }
    return names;
  }
  std::vector<Message> messages_;
  Device device_ =
      CreateNullDevice({.OnMessage = [this](const Message& m) { messages_.push_back(m); }});
  CommandQueue queue_ = device_.CreateCommandQueue().value();
  Fence fence_ = device_.CreateFence(3).value();
};

TEST_F(QueueTest, RunsInOrderAndSignals) {
  EXPECT_EQ(fence_.GetCompletedValue(), 3u);
  EXPECT_OK(queue_.ExecuteCommandLists({Marker("a"), Marker("b")}));
  EXPECT_OK(queue_.Signal(fence_, 5));
  EXPECT_OK(fence_.Wait(5));
  EXPECT_EQ(fence_.GetCompletedValue(), 5u);
  EXPECT_EQ(Executed(), "ab");
}

TEST_F(QueueTest, WaitsForAFenceThatTheHostSignals) {
  EXPECT_OK(queue_.Wait(fence_, 4));
  CommandList list = Marker("a");
  EXPECT_OK(queue_.ExecuteCommandLists({list}));
  EXPECT_EQ(Executed(), "");
  EXPECT_OK(list.Reset());  // submitted work stays as it was
  EXPECT_OK(fence_.Signal(4));
  EXPECT_EQ(Executed(), "a");
}

TEST_F(QueueTest, FencesCallBeforeTheirSignalReturns) {
  std::string calls;
  const auto call_at = [&](uint64_t value, char name) {
    return fence_.CallAt(value, [&calls, name] { calls += name; });
  };
  EXPECT_OK(call_at(3, 'a'));  // reached already
  EXPECT_EQ(calls, "a");
  EXPECT_OK(call_at(5, 'b'));
  EXPECT_OK(call_at(9, 'c'));
  EXPECT_OK(call_at(5, 'd'));
  EXPECT_OK(fence_.Signal(2));  // back
  EXPECT_OK(call_at(3, 'e'));
  EXPECT_EQ(calls, "a");
  EXPECT_OK(fence_.Signal(6));
  EXPECT_EQ(calls, "aebd");
  EXPECT_OK(queue_.Signal(fence_, 1));
  EXPECT_OK(queue_.Signal(fence_, 10));
  EXPECT_EQ(calls, "aebdc");
  EXPECT_OK(fence_.Signal(100));
  EXPECT_EQ(calls, "aebdc");  // once each
  EXPECT_ERROR(Fence().CallAt(1, [] {}), "KA0904");
}

// Each wait counts from when it was submitted. [D3D12: ID3D12CommandQueue::Wait]
TEST_F(QueueTest, AWaitThatWasReachedStaysSoWhenTheFenceGoesBack) {
  Fence gate = device_.CreateFence(0).value();
  EXPECT_OK(queue_.Wait(gate, 1));
  EXPECT_OK(queue_.Wait(fence_, 5));
  EXPECT_OK(queue_.ExecuteCommandLists({Marker("a")}));
  EXPECT_OK(fence_.Signal(6));
  EXPECT_OK(fence_.Signal(0));
  EXPECT_EQ(Executed(), "");
  EXPECT_OK(gate.Signal(1));
  EXPECT_EQ(Executed(), "a");
  EXPECT_OK(queue_.Wait(fence_, 5));  // submitted after the fence went back
  EXPECT_OK(queue_.ExecuteCommandLists({Marker("b")}));
  EXPECT_EQ(Executed(), "a");
  EXPECT_OK(fence_.Signal(5));
  EXPECT_EQ(Executed(), "ab");
}

TEST_F(QueueTest, OneQueueReleasesAnother) {
  CommandQueue other = device_.CreateCommandQueue().value();
  EXPECT_OK(other.Wait(fence_, 9));
  EXPECT_OK(other.ExecuteCommandLists({Marker("second")}));
  EXPECT_OK(queue_.ExecuteCommandLists({Marker("first ")}));
  EXPECT_OK(queue_.Signal(fence_, 9));
  EXPECT_EQ(Executed(), "first second");
}

TEST_F(QueueTest, ManyThreadsSubmit) {
  std::vector<CommandList> lists;
  for (int i = 0; i < 40; ++i) lists.push_back(Marker("x"));
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (size_t i = 0; i < 10; ++i) {
        EXPECT_OK(queue_.ExecuteCommandLists(std::span(&lists[t * 10 + i], 1)));
      }
      EXPECT_OK(queue_.Signal(fence_, 10 + t));
    });
  }
  for (auto& t : threads) t.join();
  EXPECT_OK(queue_.Signal(fence_, 100));
  EXPECT_OK(fence_.Wait(100));
  EXPECT_EQ(Executed().size(), 40u);
}

TEST_F(QueueTest, HostWaitTimesOut) {
  EXPECT_ERROR(fence_.Wait(4, 30), "KA0806", "at 3");
}

TEST_F(QueueTest, ListsMustBeClosedAndSound) {
  CommandList open = device_.CreateCommandList().value();
  EXPECT_ERROR(queue_.ExecuteCommandLists({Marker("a"), open}), "KA0823", "open");
  EXPECT_EQ(Executed(), "");  // all or nothing
  EXPECT_ERROR(queue_.ExecuteCommandLists({CommandList()}), "KA0904");
  CommandList bad = device_.CreateCommandList().value();
  bad.Dispatch(1, 1, 1);
  EXPECT_ERROR(queue_.ExecuteAndWait(bad), "KA0811");
  EXPECT_ERROR(CommandQueue().ExecuteCommandLists({}), "KA0904");
  EXPECT_ERROR(queue_.Signal(Fence(), 1), "KA0904");
  EXPECT_ERROR(queue_.Wait(Fence(), 1), "KA0904");
}

TEST_F(QueueTest, FailureInExecutionRemovesTheDevice) {
  null_log().fail_next_execute =
      Error{{799}, ErrorCode::kFailed, "KA0799 the backend met something"};
  CommandList list = Marker("a");
  CommandList late = Marker("b");
  EXPECT_ERROR(queue_.ExecuteAndWait(list), "KA0799");
  EXPECT_ERROR(device_.GetDeviceRemovedReason(), "KA0799");
  EXPECT_EQ(device_.GetDeviceRemovedReason().error().code, ErrorCode::kDeviceRemoved);
  EXPECT_EQ(fence_.GetCompletedValue(), UINT64_MAX);
  EXPECT_ERROR(fence_.Wait(99), "KA0799");
  EXPECT_ERROR(device_.CreateBuffer({.SizeInBytes = 4}), "KA0799");
  EXPECT_ERROR(queue_.ExecuteCommandLists({late}), "KA0799");
  EXPECT_EQ(Executed(), "a");
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Id.text(), "KA0799");
}

}  // namespace
}  // namespace rtapi::testing
