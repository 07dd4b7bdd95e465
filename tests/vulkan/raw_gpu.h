// SPDX-License-Identifier: MIT
//
// The least Vulkan that a program needs which traces rays or draws, without anything of
// runtime/vulkan. The driver's stress test and the hand-written baselines of tests/bench use it. A
// call that fails throws std::runtime_error with the call's name, which is fine for standalone
// programs.
#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace raw {

// Every buffer has every usage, is host-visible and stays mapped.
struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint8_t* data = nullptr;
  template <class T>
  T* as() const {
    return reinterpret_cast<T*>(data);
  }
};

struct Image {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
};

struct Accel {
  VkAccelerationStructureKHR handle = VK_NULL_HANDLE;
  Buffer memory;
  Buffer scratch;
  uint64_t address = 0;
};

// The inputs of a build besides the geometries; `counts` holds the number of primitives of each
// geometry.
struct AccelInput {
  VkAccelerationStructureTypeKHR type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  VkBuildAccelerationStructureFlagsKHR flags = 0;
  std::vector<VkAccelerationStructureGeometryKHR> geometries;
  std::vector<uint32_t> counts;
};

struct Stage {
  VkShaderStageFlagBits stage = VK_SHADER_STAGE_RAYGEN_BIT_KHR;
  const std::vector<uint32_t>* spirv = nullptr;
  std::vector<std::pair<uint32_t, uint32_t>> constants;  // id, value
};

// Indices of stages; -1 means none.
struct Group {
  int general = -1;
  int closest_hit = -1;
  int any_hit = -1;
  int intersection = -1;
};

struct Pipeline {
  VkPipeline pipeline = VK_NULL_HANDLE;
  std::vector<uint8_t> handles;  // handle_size bytes for each group
};

class Gpu {
 public:
  // Takes the first device with ray tracing pipelines. Throws if there is none.
  explicit Gpu(bool validation = false);
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  Buffer buffer(uint64_t size_bytes);
  void free(Buffer& buffer);
  // Layout: GENERAL.
  Image image(VkFormat format, uint32_t width, uint32_t height);   // for shaders
  Image target(VkFormat format, uint32_t width, uint32_t height);  // for draws; depth: D32 only
  void free(Image& image);

  // Records, submits and waits. Throws after a minute. Any thread may call it.
  void run(const std::function<void(VkCommandBuffer)>& record);

  // A structure large enough for `input`, not yet built.
  Accel accel(const AccelInput& input);
  void build(VkCommandBuffer list, const Accel& accel, const AccelInput& input,
             bool update = false);
  void free(Accel& accel);

  // own_stack: vkCmdSetRayTracingPipelineStackSizeKHR sets the stack size.
  Pipeline pipeline(const std::vector<Stage>& stages, const std::vector<Group>& groups,
                    uint32_t recursion, bool own_stack = false);
  VkPipeline compute(const Stage& stage);
  void free(VkPipeline pipeline);

  VkDevice device() const { return device_; }
  VkPipelineLayout layout() const { return layout_; }
  VkDescriptorSet descriptors() const { return set_; }
  uint32_t handle_size() const { return handle_size_; }
  const std::string& name() const { return name_; }
  // Messages of the validation layers, if they are on.
  const std::vector<std::string>& messages() const { return messages_; }

  // Sampled images at binding 0, storage images at 1, samplers at 2; unbounded, updated after bind.
  static constexpr uint32_t kDescriptors = 4096;

 private:
  void open_instance(bool validation);
  void choose_device();
  void open_device();
  void create_layout();
  Image make_image(VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage,
                   VkImageAspectFlags aspect);
  uint32_t memory_type(uint32_t allowed, VkMemoryPropertyFlags wanted) const;

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  uint32_t handle_size_ = 32;
  uint32_t scratch_alignment_ = 256;
  std::string name_;
  std::vector<std::string> messages_;
  std::mutex queue_mutex_;
};

// Compiles GLSL to SPIR-V for Vulkan 1.3. Throws with the compiler's message.
std::vector<uint32_t> compile(VkShaderStageFlagBits stage, const std::string& glsl);

VkAccelerationStructureGeometryKHR triangles(uint64_t vertices, uint32_t vertex_count,
                                             uint64_t indices, VkGeometryFlagsKHR flags);
VkAccelerationStructureGeometryKHR boxes(uint64_t boxes, VkGeometryFlagsKHR flags);
VkAccelerationStructureGeometryKHR instances(uint64_t instances);

}  // namespace raw
