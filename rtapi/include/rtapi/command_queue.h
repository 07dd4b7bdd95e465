// SPDX-License-Identifier: MIT
//
// Queues and fences.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>

#include <rtapi/command_list.h>
#include <rtapi/result.h>

namespace rtapi {

namespace detail {
struct CommandQueueImpl;
struct FenceImpl;
}  // namespace detail

class Fence {
 public:
  Fence() = default;
  explicit Fence(std::shared_ptr<detail::FenceImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Fence&) const = default;

  uint64_t GetCompletedValue() const;  // ~0 once the device is removed, as in D3D12
  Status Signal(uint64_t value);       // from the host
  // Blocks until the fence reaches `value`. Error: KA0806 if the device is removed, or if nothing
  // that is submitted would ever signal it within `timeout_ms` (0: no limit).
  Status Wait(uint64_t value, uint32_t timeout_ms = 0) const;

  const std::shared_ptr<detail::FenceImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::FenceImpl> impl_;
};

// Executes in the order of submission. Thread-safe.
class CommandQueue {
 public:
  CommandQueue() = default;
  explicit CommandQueue(std::shared_ptr<detail::CommandQueueImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const CommandQueue&) const = default;

  // Lists are closed, without error. They may be reset after the work has completed.
  Status ExecuteCommandLists(std::span<const CommandList> lists);
  Status ExecuteCommandLists(std::initializer_list<CommandList> lists) {
    return ExecuteCommandLists(std::span<const CommandList>(lists.begin(), lists.size()));
  }
  Status Signal(const Fence& fence, uint64_t value);
  Status Wait(const Fence& fence, uint64_t value);  // later work waits for the fence

  // Closes the list if it is open, executes it and waits. The error is that of recording, or the
  // reason why the device was removed.
  Status ExecuteAndWait(CommandList& list);

  const std::shared_ptr<detail::CommandQueueImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::CommandQueueImpl> impl_;
};

}  // namespace rtapi
