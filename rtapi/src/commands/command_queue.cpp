// SPDX-License-Identifier: MIT
#include <rtapi/command_queue.h>

#include <chrono>

#include <rtapi/device.h>
#include <rtapi/heap.h>

#include "rtapi/src/commands/command_queue_impl.h"
#include "rtapi/src/commands/execute_held.h"

namespace rtapi {

namespace detail {

uint64_t FenceValue::get() const {
  std::lock_guard lock(mutex);
  return current;
}

void FenceValue::set(uint64_t value) {
  std::vector<std::function<void()>> reached;
  {
    std::lock_guard lock(mutex);
    current = value;
    const auto end = calls.upper_bound(value);
    for (auto it = calls.begin(); it != end; ++it) reached.push_back(std::move(it->second.reached));
    calls.erase(calls.begin(), end);
  }
  changed.notify_all();
  for (const auto& call : reached) call();
}

void FenceImpl::CallAt(uint64_t at, std::function<void()> reached) {
  bool now = !device->removed().ok();
  {
    std::lock_guard lock(value->mutex);
    now = now || value->current >= at;
    if (!now) value->calls.emplace(at, FenceValue::Call{device.get(), reached});
  }
  if (now) return reached();
  // Removal between the check and here is told by when_removed itself.
  std::call_once(told_of_removal_, [this] {
    device->when_removed([fence = weak_from_this()] {
      if (const auto alive = fence.lock()) alive->DeviceRemoved();
    });
  });
}

void FenceImpl::DeviceRemoved() {
  std::vector<std::function<void()>> own;
  {
    std::lock_guard lock(value->mutex);
    for (auto it = value->calls.begin(); it != value->calls.end();) {
      if (it->second.device != device.get()) {
        ++it;
        continue;
      }
      own.push_back(std::move(it->second.reached));
      it = value->calls.erase(it);
    }
  }
  value->changed.notify_all();
  for (const auto& call : own) call();
}

void CommandQueueImpl::Submit(Operation operation) {
  {
    std::lock_guard lock(mutex_);
    pending_.push_back(std::move(operation));
  }
  Drain();
}

void CommandQueueImpl::WaitFor(FenceImpl& fence, uint64_t value) {
  const auto reached = std::make_shared<std::atomic<bool>>(false);
  Submit(WaitFence{reached});
  fence.CallAt(value, [reached, queue = weak_from_this()] {
    *reached = true;
    if (const auto alive = queue.lock()) alive->Drain();
  });
}

void CommandQueueImpl::Drain() {
  std::unique_lock lock(mutex_);
  if (draining_) {
    again_ = true;
    return;
  }
  draining_ = true;
  do {
    again_ = false;
    while (!pending_.empty()) {
      if (const auto* wait = std::get_if<WaitFence>(&pending_.front())) {
        if (!wait->reached->load()) break;
      }
      const Operation operation = std::move(pending_.front());
      pending_.pop_front();
      lock.unlock();
      Run(operation);
      lock.lock();
    }
  } while (again_);
  draining_ = false;
}

void CommandQueueImpl::Run(const Operation& operation) {
  if (const auto* signal = std::get_if<SignalFence>(&operation)) {
    return signal->fence->value->set(signal->value);
  }
  const auto* execute = std::get_if<Execute>(&operation);
  if (!execute || !device->removed().ok()) return;
  const auto run = [&] {
    if (device->checks) {
      kaamos::checks::compare_uploads(device->addresses, *device->reporter, execute->uploads);
    }
    return execute_commands(*device, *execute->commands);
  };
  // Memory may have been freed while the list waited for a fence, or by another thread.
  if (Status s = execute_held(*device, *execute->uses, run); !s.ok()) device->Remove(s.error());
}

}  // namespace detail

using namespace detail;

uint64_t Fence::GetCompletedValue() const {
  if (!impl_) return 0;
  return impl_->device->removed().ok() ? impl_->value->get() : UINT64_MAX;
}

Status Fence::Signal(uint64_t value) const {
  if (!impl_) return make_error(Id::kNullHandle, "Signal on an empty fence handle");
  impl_->value->set(value);
  return {};
}

Status Fence::CallAt(uint64_t value, std::function<void()> reached) const {
  if (!impl_) return make_error(Id::kNullHandle, "CallAt on an empty fence handle");
  impl_->CallAt(value, std::move(reached));
  return {};
}

Status Fence::Wait(uint64_t value, uint32_t timeout_ms) const {
  if (!impl_) return make_error(Id::kNullHandle, "Wait on an empty fence handle");
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(timeout_ms);
  FenceValue& fence = *impl_->value;
  std::unique_lock lock(fence.mutex);
  while (fence.current < value) {
    // Device removal does not signal the fence, so a waiter looks for it every 20 ms.
    fence.changed.wait_for(lock, std::chrono::milliseconds(20));
    if (fence.current >= value) break;
    if (Status removed = impl_->device->removed(); !removed.ok()) return removed;
    if (timeout_ms != 0 && Clock::now() >= end) {
      return make_error(Id::kFenceWait, "the fence is still at ", fence.current, " after ",
                        timeout_ms, " ms; the wait is for ", value);
    }
  }
  return {};
}

Result<Fence> Device::CreateFence(uint64_t initial_value) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateFence on an empty device handle");
  auto fence = std::make_shared<FenceImpl>();
  fence->device = impl_;
  fence->value = std::make_shared<FenceValue>();
  fence->value->current = initial_value;
  return Fence(std::move(fence));
}

Result<Fence> OpenFence(const Device& device, const Fence& fence) {
  if (!device) return make_error(Id::kNullHandle, "OpenFence on an empty device handle");
  if (!fence) return make_error(Id::kNullHandle, "OpenFence of an empty fence handle");
  auto opened = std::make_shared<FenceImpl>();
  opened->device = device.impl();
  opened->value = fence.impl()->value;
  return Fence(std::move(opened));
}

Result<CommandQueue> Device::CreateCommandQueue() const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateCommandQueue on an empty device handle");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  auto queue = std::make_shared<CommandQueueImpl>();
  queue->device = impl_;
  return CommandQueue(std::move(queue));
}

Status CommandQueue::ExecuteCommandLists(std::span<const CommandList> lists) const {
  if (!impl_) return make_error(Id::kNullHandle, "ExecuteCommandLists on an empty queue handle");
  if (Status s = impl_->device->removed(); !s.ok()) return s;
  for (const CommandList& list : lists) {
    if (Status s = CheckHandle(impl_->device, list, "ExecuteCommandLists: a list"); !s.ok()) {
      return s;
    }
    if (list.is_open()) {
      const Error error =
          make_error(Id::kListNotExecutable, "the list is still open; call Close first");
      if (impl_->device->desc.InvalidCalls == InvalidCalls::kDropCall) {
        impl_->device->Remove(error);
        return impl_->device->removed();
      }
      return error;
    }
    if (!list.GetErrors().empty()) {
      return make_error(Id::kListNotExecutable, "recording failed with ", list.GetErrors().size(),
                        " errors; the first is: ", list.GetErrors().front().message);
    }
    if (const auto held = HoldAll(*list.impl()->uses); !held) return held.error();
  }
  for (const CommandList& list : lists) {
    CommandQueueImpl::Execute execute{list.impl()->commands, list.impl()->uses};
    if (impl_->device->checks) {
      execute.uploads =
          kaamos::checks::read_uploads(impl_->device->addresses, *list.impl()->commands);
    }
    impl_->Submit(std::move(execute));
  }
  return impl_->device->removed();
}

Status CommandQueue::Signal(const Fence& fence, uint64_t value) const {
  if (!impl_) return make_error(Id::kNullHandle, "Signal on an empty queue handle");
  if (Status s = CheckHandle(impl_->device, fence, "Signal: the fence"); !s.ok()) return s;
  impl_->Submit(CommandQueueImpl::SignalFence{fence.impl(), value});
  return impl_->device->removed();
}

Status CommandQueue::Wait(const Fence& fence, uint64_t value) const {
  if (!impl_) return make_error(Id::kNullHandle, "Wait on an empty queue handle");
  if (Status s = CheckHandle(impl_->device, fence, "Wait: the fence"); !s.ok()) return s;
  impl_->WaitFor(*fence.impl(), value);
  return impl_->device->removed();
}

Status CommandQueue::ExecuteAndWait(const CommandList& list) const {
  if (!impl_) return make_error(Id::kNullHandle, "ExecuteAndWait on an empty queue handle");
  if (list.is_open()) {
    if (Status s = CommandList(list).Close(); !s.ok()) return s;
  }
  if (Status s = ExecuteCommandLists({list}); !s.ok()) return s;
  auto fence = Device(impl_->device).CreateFence();
  if (!fence.ok()) return fence.error();
  if (Status s = Signal(*fence, 1); !s.ok()) return s;
  if (Status s = fence->Wait(1); !s.ok()) return s;
  return impl_->device->removed();
}

}  // namespace rtapi
