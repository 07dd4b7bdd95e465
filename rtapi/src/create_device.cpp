// SPDX-License-Identifier: MIT
//
// Puts a device together: its backend, and in checked mode the layer that reads its lists.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <rtapi/device.h>

#include "rtapi/src/backends.h"
#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "runtime/backend/errors.h"
#include "runtime/coverage/collector.h"

namespace rtapi {

namespace {

std::atomic<uint32_t> g_device_count{0};

Status check_desc(const DeviceDesc& desc) {
  using detail::Id;
  if (desc.Precision > TraversalPrecision::kExact) {
    return detail::make_error(Id::kDeviceDesc, "Precision is ",
                              static_cast<uint32_t>(desc.Precision),
                              "; it must be kFast, kRobust or kExact");
  }
  if (Status s = detail::check_device_level(desc); !s.ok()) return s;
  if (desc.Threads > 4096) {
    return detail::make_error(Id::kDeviceDesc, "Threads is ", desc.Threads,
                              "; it must be 0 (all threads of the machine) to 4096");
  }
  const uint32_t lanes = desc.WaveLanes;
  if (lanes != 0 && lanes != 4 && lanes != 8 && lanes != 16 && lanes != 32) {
    return detail::make_error(Id::kDeviceDesc, "WaveLanes is ", lanes,
                              "; it must be 4, 8, 16, 32, or 0 (8 lanes)");
  }
  return {};
}

std::optional<std::array<uint32_t, 3>> print_thread_of_environment() {
  const char* text = std::getenv("KAAMOS_PRINT_THREAD");
  std::array<uint32_t, 3> thread = {};
  if (text == nullptr || std::sscanf(text, "%u,%u,%u", &thread[0], &thread[1], &thread[2]) < 1) {
    return std::nullopt;
  }
  return thread;
}

}  // namespace

std::vector<DeviceInfo> EnumerateDevices() {
  std::vector<DeviceInfo> devices;
  for (const auto* factory : detail::backends()) {
    for (auto& info : factory->enumerate()) devices.push_back(std::move(info));
  }
  return devices;
}

Result<Device> CreateDevice(const DeviceDesc& desc) {
  using namespace detail;
  if (Status s = check_desc(desc); !s.ok()) return s.error();
  const auto known = detail::backends();
  if (known.empty()) {
    return make_error(Id::kNoBackend,
                      "this build has no backend; install libembree-dev and run CMake again");
  }
  auto it = std::find_if(known.begin(), known.end(),
                         [&](const runtime::BackendFactory* f) { return desc.Backend == f->name; });
  if (it == known.end()) {
    std::string names;
    for (const auto* f : known) names += concat(names.empty() ? "" : ", ", in_quotes(f->name));
    return make_error(Id::kUnknownBackend, in_quotes(desc.Backend), "; this build has ", names);
  }
  auto impl = std::make_shared<DeviceImpl>();
  impl->desc = desc;
  impl->tag = ++g_device_count;
  impl->context.addresses = &impl->addresses;
  impl->context.stopped = &impl->is_removed();
  // The backend is a member of the device: the pointer outlives it.
  if (!impl->desc.PrintThread) impl->desc.PrintThread = print_thread_of_environment();
  impl->context.message = [raw = impl.get()](const Message& message) {
    if (raw->desc.OnMessage) return raw->desc.OnMessage(message);
    const auto id = static_cast<runtime::Id>(message.Id.number);
    if (id == runtime::Id::kShaderPrint || id == runtime::Id::kShaderError) {
      std::fprintf(stderr, "%s\n", message.Text.c_str());
    }
  };
  if (desc.Checked) {
    impl->reporter = std::make_unique<kaamos::checks::Reporter>(impl->context.message);
    bool (*same_root_signature)(const RootSignature&, const RootSignature&) =
        &detail::same_definition;
    impl->checks = std::make_unique<kaamos::checks::Layer>(impl->addresses, *impl->reporter,
                                                           same_root_signature);
    impl->context.reporter = impl->reporter.get();
    impl->context.observer = impl->checks.get();
  }
  auto backend = (*it)->create(desc, impl->context);
  if (!backend.ok()) return backend.error();
  impl->backend = std::move(*backend);
  if (const std::string problem = kaamos::coverage::begin(); !problem.empty()) {
    impl->report(MessageSeverity::kWarning, make_error(Id::kCoverageFile, problem));
  }
  return Device(std::move(impl));
}

}  // namespace rtapi
