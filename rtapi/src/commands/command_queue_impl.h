// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <variant>
#include <vector>

#include <rtapi/command_queue.h>

#include "rtapi/src/commands/command_list_impl.h"
#include "runtime/checks/uploads.h"

namespace rtapi::detail {

// The value of a fence, which is one on every device that the fence was opened on.
struct FenceValue {
  struct Call {
    const DeviceImpl* device;  // whose fence was waited on
    std::function<void()> reached;
  };

  uint64_t get() const;
  // Sets the value and makes the calls that wait for it, those of queues among them.
  void set(uint64_t value);

  mutable std::mutex mutex;
  std::condition_variable changed;
  uint64_t current = 0;
  std::multimap<uint64_t, Call> calls;  // by value
};

struct FenceImpl : std::enable_shared_from_this<FenceImpl> {
  std::shared_ptr<DeviceImpl> device;
  std::shared_ptr<FenceValue> value;

  void CallAt(uint64_t at, std::function<void()> reached);
  // Makes all calls of its device, of which every fence is past every value.
  void DeviceRemoved();

 private:
  std::once_flag told_of_removal_;
};

// Work runs at once on the thread that submits it, or, if the queue waits for a fence, on the
// thread whose signal ends the wait. A backend uses all cores for one command, so a thread per
// queue would gain nothing and would lose the call stack in a debugger.
struct CommandQueueImpl : std::enable_shared_from_this<CommandQueueImpl> {
  struct Execute {
    std::shared_ptr<const CommandVector> commands;
    std::shared_ptr<const MemoryUses> uses;
    std::vector<kaamos::checks::UploadRange> uploads = {};  // on a checked device: as submitted
  };
  struct SignalFence {
    std::shared_ptr<FenceImpl> fence;
    uint64_t value;
  };
  // Once reached, a wait is over even if the fence goes back before the queue comes to it.
  struct WaitFence {
    std::shared_ptr<std::atomic<bool>> reached;
  };
  using Operation = std::variant<Execute, SignalFence, WaitFence>;

  std::shared_ptr<DeviceImpl> device;

  void Submit(Operation operation);
  // Holds what is submitted from now on until the fence reaches `value`.
  void WaitFor(FenceImpl& fence, uint64_t value);
  void Drain();

 private:
  void Run(const Operation& operation);

  std::mutex mutex_;
  std::deque<Operation> pending_;
  bool draining_ = false;
  bool again_ = false;  // a drain was requested while one was running
};

}  // namespace rtapi::detail
