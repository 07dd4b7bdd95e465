// SPDX-License-Identifier: MIT
#include "runtime/vulkan/gpu/instance.h"
#include "runtime/backend/errors.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace kaamos::vulkan {

const char kWhatToInstall[] =
    "Install mesa-vulkan-drivers 24.3 or newer, which brings one for every processor (Debian 12: "
    "apt-get install -t bookworm-backports mesa-vulkan-drivers).";

namespace {

constexpr char kValidationLayer[] = "VK_LAYER_KHRONOS_validation";

bool validation_wanted() {
  const char* value = std::getenv("KAAMOS_VULKAN_VALIDATION");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

bool has_layer(const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, name) == 0;
  });
}

rtapi::Error no_vulkan(const std::string& why) {
  return runtime::make_error(runtime::Id::kNoVulkanDevice, why + ". " + kWhatToInstall);
}

}  // namespace

rtapi::Result<std::shared_ptr<Instance>> Instance::get() {
  static std::mutex mutex;
  static std::weak_ptr<Instance> shared;
  const std::lock_guard lock(mutex);
  if (auto living = shared.lock()) return living;
  std::shared_ptr<Instance> made(new Instance);
  if (auto s = made->start(); !s) return s.error();
  shared = made;
  return made;
}

rtapi::Status Instance::start() {
  if (volkInitialize() != VK_SUCCESS) {
    return no_vulkan("the loader libvulkan.so.1 (Debian: libvulkan1) is not there");
  }
  if (volkGetInstanceVersion() < VK_API_VERSION_1_3) {
    return no_vulkan("the loader libvulkan.so.1 is older than Vulkan 1.3");
  }
  const bool validation = validation_wanted();
  if (validation && !has_layer(kValidationLayer)) {
    return runtime::make_error(
        runtime::Id::kNoValidationLayer,
        "KAAMOS_VULKAN_VALIDATION is 1, but the layer VK_LAYER_KHRONOS_validation is not "
        "installed (Debian: vulkan-validationlayers).");
  }
  const char* const layers[] = {kValidationLayer};
  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pEngineName = "Kaamos";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  info.enabledLayerCount = info.enabledExtensionCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = layers;
  info.ppEnabledExtensionNames = extensions;
  if (const VkResult r = vkCreateInstance(&info, nullptr, &handle_); r != VK_SUCCESS) {
    return no_vulkan(r == VK_ERROR_INCOMPATIBLE_DRIVER
                         ? "no driver is installed"
                         : "vkCreateInstance returned " + result_name(r));
  }
  volkLoadInstanceOnly(handle_);
  if (!validation) return {};
  VkDebugUtilsMessengerCreateInfoEXT messenger = {
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = on_message;
  messenger.pUserData = this;
  // volk's own pointers are those of the instance that the process loaded last.
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(handle_, "vkCreateDebugUtilsMessengerEXT"));
  create(handle_, &messenger, nullptr, &messenger_);
  return {};
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(handle_, messenger_, nullptr);
  }
  if (handle_ != VK_NULL_HANDLE) vkDestroyInstance(handle_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
  uint32_t count = 0;
  vkEnumeratePhysicalDevices(handle_, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(handle_, &count, devices.data());
  devices.resize(count);
  return devices;
}

VkBool32 Instance::on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                              VkDebugUtilsMessageTypeFlagsEXT,
                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
  auto& instance = *static_cast<Instance*>(self);
  // Writes to an attachment without a format go nowhere, as D3D12 has it for a null view. Of
  // outputs of another type than their target's, which D3D12 takes, KA0725 has warned.
  const std::string_view text = data->pMessage;
  if (text.find("InterfaceTypeMismatch") != text.npos &&
      (text.find("VK_FORMAT_UNDEFINED") != text.npos ||
       text.find("does not match fragment shader output type") != text.npos)) {
    return VK_FALSE;
  }
  const std::lock_guard lock(instance.mutex_);
  instance.messages_.emplace_back(text);
  return VK_FALSE;
}

std::vector<std::string> Instance::validation_messages(size_t* position) {
  const std::lock_guard lock(mutex_);
  const size_t first = std::min(*position, messages_.size());
  *position = messages_.size();
  return {messages_.begin() + static_cast<ptrdiff_t>(first), messages_.end()};
}

std::string result_name(VkResult result) {
  switch (result) {
    case VK_SUCCESS:
      return "VK_SUCCESS";
    case VK_TIMEOUT:
      return "VK_TIMEOUT";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
      return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "VK_ERROR_FORMAT_NOT_SUPPORTED";
    case VK_ERROR_FRAGMENTATION:
      return "VK_ERROR_FRAGMENTATION";
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
}

}  // namespace kaamos::vulkan
