// SPDX-License-Identifier: MIT
//
// One Vulkan device with ray tracing pipelines: what it can do, its memory and its queue. Works
// with any conforming device: sizes, alignments, limits and memory types are queried.
#pragma once

#include <volk.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <rtapi/device.h>
#include <rtapi/result.h>

#include "runtime/backend/heap_memory.h"
#include "runtime/vulkan/gpu/instance.h"
#include "runtime/vulkan/gpu/workarounds.h"

namespace kaamos::vulkan {

// As read from the device; pNext pointers are null.
struct GpuProperties {
  VkPhysicalDeviceProperties core = {};
  VkPhysicalDeviceDriverProperties driver = {};
  VkPhysicalDeviceRayTracingPipelinePropertiesKHR ray_tracing = {};
  VkPhysicalDeviceAccelerationStructurePropertiesKHR acceleration_structure = {};
  VkPhysicalDeviceVulkan11Properties vulkan11 = {};
  VkPhysicalDeviceVulkan12Properties vulkan12 = {};
  VkPhysicalDeviceVulkan13Properties vulkan13 = {};
  VkPhysicalDeviceMemoryProperties memory = {};
};

// Optional features that were found and enabled; required ones are checked when the device is
// created.
struct GpuFeatures {
  bool ray_query = false;  // VK_KHR_ray_query
  bool float64 = false;
  bool int16 = false;
  bool float16 = false;
  bool int8 = false;
  bool storage16 = false;
  bool storage8 = false;
  bool int64_atomics = false;
  bool sample_shading = false;  // shaders may run for each sample
  bool image_cube_array = false;
  bool sampler_anisotropy = false;
  bool image_gather_extended = false;
  bool custom_border_color = false;  // VK_EXT_custom_border_color without format
  bool image_2d_view_of_3d = false;  // VK_EXT_image_2d_view_of_3d, storage images
  bool image_view_min_lod = false;   // VK_EXT_image_view_min_lod
  bool null_descriptor = false;      // VK_EXT_robustness2
  bool sampler_filter_minmax = false;
  bool mirror_clamp_to_edge = false;
  bool pipeline_statistics = false;   // pipelineStatisticsQuery
  bool external_memory_host = false;  // VK_EXT_external_memory_host
  std::string graphics_lacks;         // what graphics pipelines need and the device does not have
};

class CoverageWords;
class Gpu;

// A buffer with its own memory, with every usage that a D3D12 buffer may have. Its address is a
// multiple of 64 KiB: commands must add offset() to their own offset in handle().
class GpuBuffer {
 public:
  ~GpuBuffer();
  GpuBuffer(const GpuBuffer&) = delete;
  GpuBuffer& operator=(const GpuBuffer&) = delete;

  VkBuffer handle() const { return handle_; }
  uint64_t offset() const { return offset_; }
  uint64_t address() const { return address_; }
  uint64_t size_bytes() const { return size_bytes_; }
  // Mapped for as long as the buffer lives; null only if device memory was asked for and the host
  // cannot see it.
  uint8_t* host() const { return host_; }

 private:
  friend class Gpu;
  explicit GpuBuffer(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}

  std::shared_ptr<Gpu> gpu_;
  VkBuffer handle_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  uint64_t offset_ = 0;
  uint64_t address_ = 0;
  uint64_t size_bytes_ = 0;
  uint8_t* host_ = nullptr;
  runtime::MappedPages pages_;  // from which the memory was imported
};

// kAny if everything is written before it is read: pages that nobody touches then cost nothing.
enum class InitialContents : uint8_t { kZero, kAny };

class Gpu : public std::enable_shared_from_this<Gpu> {
  friend class GpuBuffer;

 public:
  // The devices that can run this backend, best first; may be empty.
  static std::vector<rtapi::DeviceInfo> enumerate();
  // The first device whose name contains `name_part`, or KAAMOS_VULKAN_DEVICE from the environment
  // if that is empty. Errors: KA0950 no such device, KA0951 validation layers requested but
  // missing, KA0952 the device could not be started.
  static rtapi::Result<std::shared_ptr<Gpu>> create(const std::string& name_part = "");
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  VkDevice device() const { return device_; }
  VkPhysicalDevice physical_device() const { return physical_device_; }
  const VolkDeviceTable& vk() const { return vk_; }
  Instance& instance() const { return *instance_; }
  const rtapi::DeviceInfo& info() const { return info_; }
  const GpuProperties& properties() const { return properties_; }
  const GpuFeatures& features() const { return features_; }
  // Valid bits of the queue's timestamps; 0: it has none.
  uint32_t timestamp_bits() const { return timestamp_bits_; }
  const Workarounds& workarounds() const { return workarounds_; }
  // Names in the environment's lists of workarounds that do not exist.
  const std::vector<std::string>& unknown_workarounds() const { return unknown_workarounds_; }
  // What shaders of libraries with coverage write to; null: nothing listens. It belongs to the
  // backend's device, because buffers keep this one alive.
  CoverageWords* coverage() const { return coverage_; }
  void set_coverage(CoverageWords* coverage) { coverage_ = coverage; }
  bool is_lavapipe() const { return properties_.driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE; }

  // Visible to the host. `what` names it in messages. Errors: KA0990 out of memory, KA0956 larger
  // than the device allows.
  rtapi::Result<std::unique_ptr<GpuBuffer>> create_buffer(
      uint64_t size_bytes, const std::string& what,
      InitialContents contents = InitialContents::kZero);
  // The same of pages that lie in a heap, as they are; not called unless imports_pages(). Errors:
  // KA0990.
  rtapi::Result<std::unique_ptr<GpuBuffer>> place_buffer(runtime::MappedPages pages,
                                                         uint64_t size_bytes,
                                                         const std::string& what);
  // Whether the device's memory can be pages of this process: it runs on the processor.
  bool imports_pages() const;
  // For images: a memory type among `type_bits` that has all of `wanted` and as much of `liked` as
  // possible; UINT32_MAX if there is none.
  uint32_t memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted,
                       VkMemoryPropertyFlags liked = 0) const;

  // Records, submits, and returns when all is done. For one thread at a time. Errors: KA0955 the
  // device was lost (the message says what was running); KA0990.
  rtapi::Status run(const std::function<void(VkCommandBuffer)>& record, const std::string& what);

  // For those who record themselves [command_stream.h]: a pool with one command buffer, and a
  // fence. The caller destroys pool and fence, even after a failure.
  VkResult create_command_buffer(VkCommandPool* pool, VkCommandBuffer* commands,
                                 VkFence* fence) const;
  // Ends and submits what was recorded, waits, and resets the fence. Thread-safe. Errors: as run.
  rtapi::Status submit(VkCommandBuffer commands, VkFence fence, const std::string& what);

  // The error for a failed call: KA0955 for a lost device, KA0990 for memory, otherwise KA0952.
  rtapi::Error error(VkResult result, const std::string& what) const;

 private:
  Gpu() = default;
  rtapi::Status start(std::shared_ptr<Instance> instance, VkPhysicalDevice physical_device);
  rtapi::Status create_device();
  // [gpu_buffer.cpp]
  VkResult allocate(GpuBuffer& buffer);
  VkResult import_pages(GpuBuffer& buffer, runtime::MappedPages pages);
  VkResult bind_memory(GpuBuffer& buffer, const void* chain, uint32_t type_bits);
  void release(GpuBuffer& buffer);

  std::shared_ptr<Instance> instance_;
  VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VolkDeviceTable vk_ = {};
  rtapi::DeviceInfo info_;
  GpuProperties properties_;
  GpuFeatures features_;
  Workarounds workarounds_;
  std::vector<std::string> unknown_workarounds_;
  CoverageWords* coverage_ = nullptr;
  uint32_t queue_family_ = 0;
  uint32_t timestamp_bits_ = 0;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queue_mutex_;
  std::mutex run_mutex_;  // guards the members below
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

}  // namespace kaamos::vulkan
