// SPDX-License-Identifier: MIT
// Messages go to the standard error stream, which on Linux stands for a debugger's output window,
// and to the info queue of the device that they are of.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include <directx/d3d12.h>

#include <rtapi/result.h>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

/// The HRESULT of an error's family.
HRESULT to_hresult(rtapi::ErrorCode code);

/// A function that gets messages, on any thread.
using MessageSink = std::function<void(D3D12_MESSAGE_SEVERITY, const rtapi::Error&)>;

/// The messages of one device, or those of the calls that have none (process_reporter). The
/// environment variable KAAMOS_D3D12_MESSAGES says which of them are printed: "none", "errors" (the
/// default), or "all". Thread-safe.
class Reporter {
 public:
  Reporter() = default;
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  /// Sends a message to every sink, and prints it if it is severe enough.
  void report(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error);
  /// Reports the warning that shaders are interpreted. The process prints the first one unless
  /// nothing is printed at all: a program that runs a hundred times slower says why.
  void report_interpreted(const rtapi::Error& error);

  /// Reports an error and returns its HRESULT.
  ///@{
  HRESULT fail(const rtapi::Error& error);
  HRESULT fail(ErrorId id, const std::string& detail);
  ///@}
  /// S_OK, or as above.
  HRESULT check(const rtapi::Status& status);
  /// Reports KA4000 for a method that this library does not have,
  /// "ID3D12Device5::CreateMetaCommand" (a literal), once for each method. Returns E_NOTIMPL.
  HRESULT missing(const char* method);

  /// Prints what a program asked for, unless nothing is printed at all.
  void print(D3D12_MESSAGE_SEVERITY severity, const std::string& text) const;
  /// While muted, nothing is printed; sinks still get every message.
  ///@{
  void mute(bool muted) { muted_ = muted; }
  bool muted() const { return muted_; }
  ///@}

  /// Adds a sink and returns what removes it. Removing waits until the sink's call on another
  /// thread is over; a sink may remove itself.
  ///@{
  uint64_t add_sink(MessageSink sink);
  void remove_sink(uint64_t id);
  ///@}

 private:
  struct Sink {
    explicit Sink(MessageSink called) : call(std::move(called)) {}
    std::recursive_mutex mutex;
    bool removed = false;
    const MessageSink call;
  };

  void send(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error);

  std::atomic<bool> muted_{false};
  std::mutex mutex_;
  std::map<uint64_t, std::shared_ptr<Sink>> sinks_;
  uint64_t next_sink_ = 1;
  std::set<std::string_view> missing_;  // what has been told
};

/// That of calls without a device: D3D12CreateDevice, serialized root signatures, compilers,
/// factories, windows. No info queue has its messages.
Reporter& process_reporter();

}  // namespace kaamos::d3d12
