// SPDX-License-Identifier: MIT
#include "tests/vulkan/support.h"

#include <cstdlib>
#include <cstring>

#if KAAMOS_HAS_VULKAN
#include "runtime/vulkan/instance.h"
#endif

namespace kaamos::test {

std::string why_no_vulkan() {
  rtapi::DeviceDesc desc;
  desc.Backend = "vulkan";
  const auto device = rtapi::CreateDevice(desc);
  return device ? "" : device.error().message;
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

}  // namespace kaamos::test
