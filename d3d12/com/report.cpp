// SPDX-License-Identifier: MIT
#include "d3d12/com/report.h"

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace kaamos::d3d12 {

namespace {

// The standard error stream, which all reporters share.
struct Output {
  std::mutex mutex;           // so that lines of several threads do not mix
  bool printed_once = false;  // that shaders are interpreted
};

// Returns an object that is never destroyed, because programs release global devices after main.
template <class T>
T& immortal() {
  static T* const object = new T;
  return *object;
}

// Messages at least this severe are printed. Severities count downwards.
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

void print_line(D3D12_MESSAGE_SEVERITY severity, const std::string& text) {
  std::fprintf(stderr, "D3D12 %s: %s\n", severity_name(severity), text.c_str());
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

void Reporter::report(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) {
  if (!muted_ && severity <= printed_severity()) {
    std::lock_guard lock(immortal<Output>().mutex);
    print_line(severity, error.message);
  }
  send(severity, error);
}

void Reporter::report_interpreted(const rtapi::Error& error) {
  const int least = printed_severity();
  if (!muted_ && least >= 0) {
    Output& output = immortal<Output>();
    std::lock_guard lock(output.mutex);
    if (D3D12_MESSAGE_SEVERITY_WARNING <= least || !output.printed_once) {
      print_line(D3D12_MESSAGE_SEVERITY_WARNING, error.message);
    }
    output.printed_once = true;
  }
  send(D3D12_MESSAGE_SEVERITY_WARNING, error);
}

void Reporter::send(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) {
  std::vector<std::shared_ptr<Sink>> sinks;
  {
    std::lock_guard lock(mutex_);
    for (auto& [id, sink] : sinks_) sinks.push_back(sink);
  }
  // Without the lock: a callback may meet another error, or release its device.
  for (const auto& sink : sinks) {
    std::lock_guard lock(sink->mutex);
    if (!sink->removed) sink->call(severity, error);
  }
}

HRESULT Reporter::fail(const rtapi::Error& error) {
  report(D3D12_MESSAGE_SEVERITY_ERROR, error);
  return to_hresult(error.code);
}

HRESULT Reporter::fail(ErrorId id, const std::string& detail) {
  return fail(make_error(id, detail));
}

HRESULT Reporter::check(const rtapi::Status& status) {
  return status.ok() ? S_OK : fail(status.error());
}

HRESULT Reporter::missing(const char* method) {
  {
    std::lock_guard lock(mutex_);
    if (!missing_.insert(method).second) return E_NOTIMPL;
  }
  fail(ErrorId::kMissing, std::string(method) + " is not implemented; the call did nothing.");
  return E_NOTIMPL;
}

void Reporter::print(D3D12_MESSAGE_SEVERITY severity, const std::string& text) const {
  if (muted_ || printed_severity() < 0) return;
  std::lock_guard lock(immortal<Output>().mutex);
  print_line(severity, text);
}

uint64_t Reporter::add_sink(MessageSink sink) {
  std::lock_guard lock(mutex_);
  sinks_.emplace(next_sink_, std::make_shared<Sink>(std::move(sink)));
  return next_sink_++;
}

void Reporter::remove_sink(uint64_t id) {
  std::shared_ptr<Sink> sink;
  {
    std::lock_guard lock(mutex_);
    const auto found = sinks_.find(id);
    if (found == sinks_.end()) return;
    sink = found->second;
    sinks_.erase(found);
  }
  std::lock_guard lock(sink->mutex);
  sink->removed = true;
}

Reporter& process_reporter() {
  return immortal<Reporter>();
}

}  // namespace kaamos::d3d12
