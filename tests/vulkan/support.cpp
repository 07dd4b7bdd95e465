// SPDX-License-Identifier: MIT
#include "tests/vulkan/support.h"

#include <cstdlib>
#include <cstring>
#include <functional>

#if KAAMOS_HAS_VULKAN
#include "runtime/vulkan/gpu/gpu.h"
#endif

namespace kaamos::test {
namespace {

#if KAAMOS_HAS_VULKAN
std::string find_vulkan() {
  // Lives as long as the process, because loading the layers and drivers again takes longer than
  // most tests.
  static const auto* const instance = new auto(vulkan::Instance::get());
  if (!*instance) return instance->error().message;
  const auto gpu = vulkan::Gpu::create();
  return gpu ? "" : gpu.error().message;
}
#else
std::string find_vulkan() {
  rtapi::DeviceDesc desc;
  desc.Backend = "vulkan";
  const auto device = rtapi::CreateDevice(desc);
  return device ? "" : device.error().message;
}
#endif

}  // namespace

std::string why_no_vulkan() {
  static const std::string why = find_vulkan();
  return why;
}

rtapi::Device device_for(const rtapi::DeviceDesc& desc) {
  const rtapi::DeviceDesc plain;
  const bool is_plain = desc.Tier == plain.Tier && desc.ShaderModel == plain.ShaderModel &&
                        desc.IndirectRtasOperations == plain.IndirectRtasOperations &&
                        desc.CollectStatistics == plain.CollectStatistics &&
                        desc.InvalidCalls == plain.InvalidCalls && desc.Checked == plain.Checked &&
                        !desc.PrintThread;
  if (desc.Backend != "vulkan" || !is_plain) return rtapi::CreateDevice(desc).value();
  // Both live as long as the process, like the instance.
  static auto* const told = new std::function<void(const rtapi::Message&)>;
  static auto* const shared = new rtapi::Device;
  *told = desc.OnMessage;
  if (!*shared || !shared->GetDeviceRemovedReason()) {
    rtapi::DeviceDesc telling = desc;
    telling.OnMessage = [](const rtapi::Message& message) {
      if (*told) (*told)(message);
    };
    *shared = rtapi::CreateDevice(telling).value();
  }
  return *shared;
}

bool vulkan_is_required() {
  const char* value = std::getenv("KAAMOS_REQUIRE_VULKAN");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

#if KAAMOS_HAS_VULKAN
ValidationGuard::ValidationGuard() {
  if (auto instance = vulkan::Instance::get()) {
    (*instance)->validation_messages(&position_);
    instance_ = *instance;
  }
}

ValidationGuard::~ValidationGuard() {
  if (instance_ == nullptr) return;
  for (const std::string& message :
       static_cast<vulkan::Instance*>(instance_.get())->validation_messages(&position_)) {
    ADD_FAILURE() << message;
  }
}
#else
ValidationGuard::ValidationGuard() = default;
ValidationGuard::~ValidationGuard() = default;
#endif

std::string why_driver_cannot_compile(const std::string& program) {
#if defined(__x86_64__)
  if (program == "13-hybrid" && !__builtin_cpu_supports("avx512f")) {
    return "LICM: this processor has no AVX-512, and lavapipe takes too long to compile 13-hybrid";
  }
#endif
  return "";
}

}  // namespace kaamos::test
