// SPDX-License-Identifier: MIT
#include "runtime/vulkan/gpu/gpu.h"

#include <malloc.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/gpu/gpu_features.h"

namespace kaamos::vulkan {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Discrete devices first, processors last.
int rank(const VkPhysicalDeviceProperties& properties) {
  switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 3;
    default:
      return 2;
  }
}

struct Candidates {
  std::vector<VkPhysicalDevice> capable;
  std::string rejected;  // "llvmpipe lacks VK_KHR_ray_tracing_pipeline; ..."
};

Candidates find_candidates(const Instance& instance) {
  Candidates result;
  std::vector<std::pair<int, VkPhysicalDevice>> ranked;
  for (VkPhysicalDevice device : instance.physical_devices()) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    const FeatureChain features(device);
    if (features.missing().empty()) {
      ranked.emplace_back(rank(properties), device);
      continue;
    }
    if (!result.rejected.empty()) result.rejected += "; ";
    result.rejected += std::string(properties.deviceName) + " lacks " + features.missing();
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [unused, device] : ranked) result.capable.push_back(device);
  return result;
}

rtapi::DeviceInfo info_of(const GpuProperties& properties) {
  rtapi::DeviceInfo info;
  info.Backend = "vulkan";
  info.Name = std::string(properties.core.deviceName) + ", " + properties.driver.driverInfo;
  info.Description = std::string("Ray tracing pipelines of Vulkan on ") +
                     properties.core.deviceName + " by " + properties.driver.driverName + " " +
                     properties.driver.driverInfo;
  if (properties.core.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU) {
    info.HardwareThreads = std::max(std::thread::hardware_concurrency(), 1u);
  }
  return info;
}

// lavapipe filters 8-bit textures in 8 bits unless this option of its code generator is set. It
// reads the option when its first device starts, so it is set only during that time, in which no
// other thread should read the environment.
class FilterOption {
 public:
  explicit FilterOption(bool wanted) {
    if (!wanted) return;
    const char* given = std::getenv(kName);
    set_ = true;
    given_ = given != nullptr;
    if (given_) before_ = given;
    setenv(kName, given_ ? (before_ + ",no_aos_sampling").c_str() : "no_aos_sampling", 1);
  }
  ~FilterOption() {
    if (!set_) return;
    if (given_) {
      setenv(kName, before_.c_str(), 1);
    } else {
      unsetenv(kName);
    }
  }
  FilterOption(const FilterOption&) = delete;
  FilterOption& operator=(const FilterOption&) = delete;

 private:
  static constexpr char kName[] = "GALLIVM_PERF";
  bool set_ = false;
  bool given_ = false;
  std::string before_;
};

// Freed memory stays with the process. lavapipe allocates what it keeps of a frame in pieces, which
// would come from the system and go back to it each time.
void keep_heap() {
#ifdef __GLIBC__
  constexpr int kBytes = 1 << 29;
  mallopt(M_TRIM_THRESHOLD, kBytes);
  mallopt(M_TOP_PAD, kBytes / 8);
  mallopt(M_MMAP_THRESHOLD, kBytes);
#endif
}

rtapi::Error no_device(const std::string& why) {
  return runtime::make_error(runtime::Id::kNoVulkanDevice, why + ". " + kWhatToInstall);
}

}  // namespace

std::vector<rtapi::DeviceInfo> Gpu::enumerate() {
  auto instance = Instance::get();
  if (!instance) return {};
  std::vector<rtapi::DeviceInfo> result;
  for (VkPhysicalDevice device : find_candidates(**instance).capable) {
    result.push_back(info_of(read_properties(device)));
  }
  return result;
}

rtapi::Result<std::shared_ptr<Gpu>> Gpu::create(const std::string& name_part) {
  auto instance = Instance::get();
  if (!instance) return instance.error();
  const Candidates candidates = find_candidates(**instance);
  if (candidates.capable.empty()) {
    return no_device(candidates.rejected.empty() ? "no driver is installed" : candidates.rejected);
  }
  const std::string wanted = name_part.empty() ? environment("KAAMOS_VULKAN_DEVICE") : name_part;
  std::string names;
  for (VkPhysicalDevice device : candidates.capable) {
    const std::string name = info_of(read_properties(device)).Name;
    if (name.find(wanted) != std::string::npos) {
      std::shared_ptr<Gpu> gpu(new Gpu);
      if (auto s = gpu->start(*instance, device); !s) return s.error();
      return gpu;
    }
    names += (names.empty() ? "\"" : ", \"") + name + "\"";
  }
  return runtime::make_error(runtime::Id::kNoSuchVulkanDevice,
                             "no device has \"" + wanted + "\" in its name; there are " + names +
                                 " (KAAMOS_VULKAN_DEVICE chooses one by a part of its name).");
}

rtapi::Status Gpu::start(std::shared_ptr<Instance> instance, VkPhysicalDevice physical_device) {
  instance_ = std::move(instance);
  physical_device_ = physical_device;
  properties_ = read_properties(physical_device);
  info_ = info_of(properties_);
  workarounds_ =
      workarounds_for(properties_.driver.driverID, properties_.driver.driverInfo,
                      environment("KAAMOS_VULKAN_DISABLE_WORKAROUNDS"),
                      environment("KAAMOS_VULKAN_ENABLE_WORKAROUNDS"), &unknown_workarounds_);
  if (workarounds_.has(Workaround::kKeepHeap)) keep_heap();
  if (auto s = create_device(); !s) return s;
  vk_.vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
  const VkResult r = create_command_buffer(&pool_, &commands_, &fence_);
  if (r != VK_SUCCESS) return error(r, "starting " + info_.Name);
  return {};
}

VkResult Gpu::create_command_buffer(VkCommandPool* pool, VkCommandBuffer* commands,
                                    VkFence* fence) const {
  VkCommandPoolCreateInfo info = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  info.queueFamilyIndex = queue_family_;
  VkResult r = vk_.vkCreateCommandPool(device_, &info, nullptr, pool);
  if (r != VK_SUCCESS) return r;
  VkCommandBufferAllocateInfo allocate = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = *pool;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  r = vk_.vkAllocateCommandBuffers(device_, &allocate, commands);
  if (r != VK_SUCCESS) return r;
  const VkFenceCreateInfo fence_info = {VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  return vk_.vkCreateFence(device_, &fence_info, nullptr, fence);
}

rtapi::Status Gpu::create_device() {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, families.data());
  const auto with = [&](VkQueueFlags flags) {
    return std::find_if(families.begin(), families.end(), [&](const VkQueueFamilyProperties& f) {
      return (f.queueFlags & flags) == flags;
    });
  };
  const FeatureChain features(physical_device_);
  features_ = features.optional();
  auto family = with(VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT);
  if (family == families.end()) {
    family = with(VK_QUEUE_COMPUTE_BIT);
    features_.graphics_lacks = "a queue for graphics and compute";
  }
  if (family == families.end()) return no_device(info_.Name + " has no queue for compute");
  queue_family_ = static_cast<uint32_t>(family - families.begin());
  timestamp_bits_ = family->timestampValidBits;
  const float priority = 1;
  VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features.chain();
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<uint32_t>(features.extensions().size());
  info.ppEnabledExtensionNames = features.extensions().data();
  const FilterOption filter_option(workarounds_.has(Workaround::kFilterInFloats));
  const VkResult r = vkCreateDevice(physical_device_, &info, nullptr, &device_);
  if (r != VK_SUCCESS) return error(r, "starting " + info_.Name);
  volkLoadDeviceTable(&vk_, device_);
  return {};
}

Gpu::~Gpu() {
  if (device_ == VK_NULL_HANDLE) return;
  vk_.vkDeviceWaitIdle(device_);
  vk_.vkDestroyFence(device_, fence_, nullptr);
  vk_.vkDestroyCommandPool(device_, pool_, nullptr);
  vk_.vkDestroyDevice(device_, nullptr);
}

uint32_t Gpu::memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted,
                          VkMemoryPropertyFlags liked) const {
  uint32_t best = UINT32_MAX;
  int best_score = -1;
  for (uint32_t i = 0; i < properties_.memory.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = properties_.memory.memoryTypes[i].propertyFlags;
    if ((type_bits >> i & 1) == 0 || (flags & wanted) != wanted) continue;
    const int score = std::popcount(flags & liked);
    if (score > best_score) {
      best = i;
      best_score = score;
    }
  }
  return best;
}

rtapi::Status Gpu::run(const std::function<void(VkCommandBuffer)>& record,
                       const std::string& what) {
  const std::lock_guard lock(run_mutex_);
  VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  VkResult r = vk_.vkResetCommandPool(device_, pool_, 0);
  if (r == VK_SUCCESS) r = vk_.vkBeginCommandBuffer(commands_, &begin);
  if (r != VK_SUCCESS) return error(r, what);
  record(commands_);
  return submit(commands_, fence_, what);
}

rtapi::Status Gpu::submit(VkCommandBuffer commands, VkFence fence, const std::string& what) {
  // The host reads what shaders and copies wrote once the fence is signalled.
  VkMemoryBarrier to_host = {VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  to_host.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT;
  vk_.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                           0, 1, &to_host, 0, nullptr, 0, nullptr);
  VkResult r = vk_.vkEndCommandBuffer(commands);
  VkSubmitInfo submit_info = {VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit_info.commandBufferCount = 1;
  submit_info.pCommandBuffers = &commands;
  if (r == VK_SUCCESS) {
    const std::lock_guard lock(queue_mutex_);
    r = vk_.vkQueueSubmit(queue_, 1, &submit_info, fence);
  }
  if (r == VK_SUCCESS) r = vk_.vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX);
  if (r == VK_SUCCESS) r = vk_.vkResetFences(device_, 1, &fence);
  if (r != VK_SUCCESS) return error(r, what);
  return {};
}

rtapi::Error Gpu::error(VkResult result, const std::string& what) const {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return runtime::make_error(runtime::Id::kVulkanDeviceLost, what + " on " + info_.Name + ".");
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_FRAGMENTATION:
      return runtime::make_error(runtime::Id::kOutOfMemory,
                                 what + " could not be allocated (" + result_name(result) + ").");
    default:
      return runtime::make_error(
          runtime::Id::kVulkanFailed,
          what + " returned " + result_name(result) + " on " + info_.Name + ".");
  }
}

}  // namespace kaamos::vulkan
