// SPDX-License-Identifier: MIT
//
// The process's connection to Vulkan: created at first use, destroyed with the last device.
#pragma once

#include <volk.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <rtapi/result.h>

namespace kaamos::vulkan {

class Instance {
 public:
  // All devices that exist at the same time share the instance. Errors: KA0950 no loader or driver.
  static rtapi::Result<std::shared_ptr<Instance>> get();
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return handle_; }
  std::vector<VkPhysicalDevice> physical_devices() const;

  // KAAMOS_VULKAN_VALIDATION=1 enables the validation layers. Returns their messages from number
  // *position on, and advances it past the last.
  bool validates() const { return messenger_ != VK_NULL_HANDLE; }
  std::vector<std::string> validation_messages(size_t* position);

 private:
  Instance() = default;
  rtapi::Status start();
  static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                   VkDebugUtilsMessageTypeFlagsEXT types,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                   void* self);

  VkInstance handle_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

// "VK_ERROR_DEVICE_LOST" and the like.
std::string result_name(VkResult result);

// The end of every message about a missing device.
extern const char kWhatToInstall[];

}  // namespace kaamos::vulkan
