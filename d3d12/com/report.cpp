// SPDX-License-Identifier: MIT
#include "d3d12/com/report.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

namespace kaamos::d3d12 {

namespace {

// Removing waits until the sink's call on another thread is over; a sink may remove itself.
struct Sink {
  explicit Sink(MessageSink called) : call(std::move(called)) {}
  std::recursive_mutex mutex;
  bool removed = false;
  const MessageSink call;
};

struct Sinks {
  std::mutex mutex;
  std::map<uint64_t, std::shared_ptr<Sink>> sinks;
  uint64_t next = 1;
  int muted = 0;
  bool printed_once = false;  // that shaders are interpreted
};

Sinks& all_sinks() {
  static Sinks* sinks = new Sinks;  // lives on: programs release global devices after main
  return *sinks;
}

// Which messages are printed: those at least this severe. Severities count downwards.
int printed_severity() {
  const char* setting = std::getenv("KAAMOS_D3D12_MESSAGES");
  const std::string_view text = setting != nullptr ? setting : "errors";
  if (text == "none") return -1;
  return text == "all" ? D3D12_MESSAGE_SEVERITY_MESSAGE : D3D12_MESSAGE_SEVERITY_ERROR;
}

const char* severity_name(D3D12_MESSAGE_SEVERITY severity) {
  switch (severity) {
    case D3D12_MESSAGE_SEVERITY_CORRUPTION:
      return "CORRUPTION";
    case D3D12_MESSAGE_SEVERITY_ERROR:
      return "ERROR";
    case D3D12_MESSAGE_SEVERITY_WARNING:
      return "WARNING";
    case D3D12_MESSAGE_SEVERITY_INFO:
      return "INFO";
    case D3D12_MESSAGE_SEVERITY_MESSAGE:
      break;
  }
  return "MESSAGE";
}

// How often a process prints a message that is not severe enough.
enum class Printed { kNever, kOnce };

void send(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error, Printed otherwise) {
  Sinks& all = all_sinks();
  std::vector<std::shared_ptr<Sink>> sinks;
  {
    // One message at a time, so that lines of several threads do not mix.
    std::lock_guard lock(all.mutex);
    const int least = printed_severity();
    const bool once = otherwise == Printed::kOnce && least >= 0 && !all.printed_once;
    if (all.muted == 0 && (severity <= least || once)) {
      std::fprintf(stderr, "D3D12 %s: %s\n", severity_name(severity), error.message.c_str());
      if (otherwise == Printed::kOnce) all.printed_once = true;
    }
    for (auto& [id, sink] : all.sinks) sinks.push_back(sink);
  }
  // Without the lock: a callback may meet another error, or release its device.
  for (const auto& sink : sinks) {
    std::lock_guard lock(sink->mutex);
    if (!sink->removed) sink->call(severity, error);
  }
}

}  // namespace

HRESULT to_hresult(rtapi::ErrorCode code) {
  switch (code) {
    case rtapi::ErrorCode::kInvalidArgument:
      return E_INVALIDARG;
    case rtapi::ErrorCode::kInvalidCall:
      return DXGI_ERROR_INVALID_CALL;
    case rtapi::ErrorCode::kOutOfMemory:
      return E_OUTOFMEMORY;
    case rtapi::ErrorCode::kUnsupported:
      return DXGI_ERROR_UNSUPPORTED;
    case rtapi::ErrorCode::kNotFound:
      return DXGI_ERROR_NOT_FOUND;
    case rtapi::ErrorCode::kDeviceRemoved:
      return DXGI_ERROR_DEVICE_REMOVED;
    case rtapi::ErrorCode::kFailed:
      break;
  }
  return E_FAIL;
}

void report(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) {
  send(severity, error, Printed::kNever);
}

void report_interpreted(const rtapi::Error& error) {
  send(D3D12_MESSAGE_SEVERITY_WARNING, error, Printed::kOnce);
}

void print(D3D12_MESSAGE_SEVERITY severity, const std::string& text) {
  Sinks& all = all_sinks();
  std::lock_guard lock(all.mutex);
  if (all.muted == 0 && printed_severity() >= 0) {
    std::fprintf(stderr, "D3D12 %s: %s\n", severity_name(severity), text.c_str());
  }
}

void mute_output(bool muted) {
  Sinks& all = all_sinks();
  std::lock_guard lock(all.mutex);
  all.muted += muted ? 1 : -1;
}

HRESULT fail(const rtapi::Error& error) {
  report(D3D12_MESSAGE_SEVERITY_ERROR, error);
  return to_hresult(error.code);
}

HRESULT fail(ErrorId id, const std::string& detail) {
  return fail(make_error(id, detail));
}

HRESULT check(const rtapi::Status& status) {
  return status.ok() ? S_OK : fail(status.error());
}

uint64_t add_sink(MessageSink sink) {
  Sinks& all = all_sinks();
  std::lock_guard lock(all.mutex);
  all.sinks.emplace(all.next, std::make_shared<Sink>(std::move(sink)));
  return all.next++;
}

void remove_sink(uint64_t id) {
  std::shared_ptr<Sink> sink;
  {
    Sinks& all = all_sinks();
    std::lock_guard lock(all.mutex);
    const auto found = all.sinks.find(id);
    if (found == all.sinks.end()) return;
    sink = found->second;
    all.sinks.erase(found);
  }
  std::lock_guard lock(sink->mutex);
  sink->removed = true;
}

}  // namespace kaamos::d3d12
