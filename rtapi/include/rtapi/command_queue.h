// SPDX-License-Identifier: MIT
/// @file
/// Queues and fences.
#pragma once

#include <cstdint>
#include <functional>
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

/// A counter by which queues and the host wait for each other. A copyable handle, thread-safe.
/// [D3D12: ID3D12Fence]
class Fence {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same fence.
  ///@{
  Fence() = default;
  explicit Fence(std::shared_ptr<detail::FenceImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Fence&) const = default;
  ///@}

  /// The present value; 2^64 - 1 once the device is removed, 0 for an empty handle.
  /// [D3D12: ID3D12Fence::GetCompletedValue]
  uint64_t GetCompletedValue() const;
  /// Sets the value from the host. Queues that waited for it go on in this call, on this thread.
  /// [D3D12: ID3D12Fence::Signal]
  /// @errors KA0904 empty handle.
  Status Signal(uint64_t value) const;
  /// Blocks until the fence reaches `value`, for `timeout_ms` milliseconds at most; 0: without end.
  /// [D3D12: ID3D12Fence::SetEventOnCompletion]
  /// @errors KA0904 empty handle; KA0806 the time is up; what Device::GetDeviceRemovedReason says,
  /// if the device is removed meanwhile.
  Status Wait(uint64_t value, uint32_t timeout_ms = 0) const;

  /// Calls `reached` once, when the fence is at `value` or above: in this call if it is so now,
  /// else on the thread that signals it, before its Signal returns, and when the device is removed.
  /// It may call into the library, and is dropped with the fence. [D3D12:
  /// ID3D12Fence::SetEventOnCompletion]
  /// @errors KA0904 empty handle.
  Status CallAt(uint64_t value, std::function<void()> reached) const;

  /// For the library itself.
  const std::shared_ptr<detail::FenceImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::FenceImpl> impl_;
};

/// Executes command lists in the order of submission. A copyable handle, thread-safe. Work runs on
/// the thread that submits it, before the call returns, unless the queue waits for a fence: then on
/// the thread that signals it. Only one queue of a device executes at a time.
/// All calls are const: what changes is the queue, not its handle.
/// [D3D12: ID3D12CommandQueue]
class CommandQueue {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same queue.
  ///@{
  CommandQueue() = default;
  explicit CommandQueue(std::shared_ptr<detail::CommandQueueImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const CommandQueue&) const = default;
  ///@}

  /// Submits lists, which are closed and without error. A list may be reset, and its handle
  /// dropped, at once: the queue keeps the commands. Buffers that commands name by address must
  /// live until the work has begun, see Buffer. If one was freed before this call, nothing is
  /// submitted; if it is freed while the queue waits for a fence, the device is removed.
  /// [D3D12: ID3D12CommandQueue::ExecuteCommandLists]
  /// @errors KA0904 an empty handle; KA0903 a list of another device; KA0856 freed memory; KA0823 a
  /// list that is open or that has errors. Nothing is submitted then. Otherwise what
  /// Device::GetDeviceRemovedReason says: an error met while a list executes removes the device,
  /// see CommandList for the ids.
  Status ExecuteCommandLists(std::span<const CommandList> lists) const;
  /// @overload
  Status ExecuteCommandLists(std::initializer_list<CommandList> lists) const {
    return ExecuteCommandLists(std::span<const CommandList>(lists.begin(), lists.size()));
  }
  /// Sets the fence to `value` when everything submitted so far has completed.
  /// [D3D12: ID3D12CommandQueue::Signal]
  /// @errors KA0904 an empty handle; KA0903 a fence of another device; what
  /// Device::GetDeviceRemovedReason says.
  Status Signal(const Fence& fence, uint64_t value) const;
  /// Makes what is submitted from now on wait until the fence reaches `value`. The call itself does
  /// not wait. [D3D12: ID3D12CommandQueue::Wait]
  /// @errors KA0904 an empty handle; KA0903 a fence of another device; what
  /// Device::GetDeviceRemovedReason says.
  Status Wait(const Fence& fence, uint64_t value) const;

  /// Returns how many ticks of timestamps a second has. [D3D12: GetTimestampFrequency]
  /// @errors KA0904 an empty handle.
  Result<uint64_t> GetTimestampFrequency() const;

  /// Closes the list if it is open, executes it and waits until it has completed.
  /// @errors KA0904 an empty handle; KA0903 a list of another device; the first error of recording;
  /// KA0823 the list was closed with errors; KA0856 freed memory; what
  /// Device::GetDeviceRemovedReason says.
  Status ExecuteAndWait(const CommandList& list) const;

  /// For the library itself.
  const std::shared_ptr<detail::CommandQueueImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::CommandQueueImpl> impl_;
};

}  // namespace rtapi
