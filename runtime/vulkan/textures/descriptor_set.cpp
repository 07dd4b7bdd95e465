// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/descriptor_set.h"

#include <algorithm>
#include <string>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/backend/errors.h"

namespace kaamos::vulkan {
namespace {

static_assert(static_cast<uint32_t>(BindlessArray::kSampledImages) ==
              shader::spirv::kSampledImageBinding);
static_assert(static_cast<uint32_t>(BindlessArray::kStorageImages) ==
              shader::spirv::kStorageImageBinding);
static_assert(static_cast<uint32_t>(BindlessArray::kSamplers) == shader::spirv::kSamplerBinding);

// Plenty for a scene, two for each view. lavapipe keeps the whole arrays in memory, at 256 bytes
// for each element, and writes all of them when a device is made.
constexpr uint32_t kSampledImages = 32768;
constexpr uint32_t kStorageImages = 8192;
constexpr uint32_t kSamplers = 4000;  // a D3D12 heap has 2048

constexpr VkDescriptorType kTypes[3] = {
    VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLER};
constexpr const char* kNames[3] = {"sampled texture views", "storage texture views", "samplers"};

}  // namespace

rtapi::Result<std::shared_ptr<DescriptorSet>> DescriptorSet::create(std::shared_ptr<Gpu> gpu) {
  std::shared_ptr<DescriptorSet> set(new DescriptorSet(std::move(gpu)));
  if (auto s = set->start(); !s) return s.error();
  return set;
}

rtapi::Status DescriptorSet::start() {
  const VkPhysicalDeviceVulkan12Properties& limits = gpu_->properties().vulkan12;
  arrays_[0].size = std::min({kSampledImages, limits.maxDescriptorSetUpdateAfterBindSampledImages,
                              limits.maxPerStageDescriptorUpdateAfterBindSampledImages});
  arrays_[1].size = std::min({kStorageImages, limits.maxDescriptorSetUpdateAfterBindStorageImages,
                              limits.maxPerStageDescriptorUpdateAfterBindStorageImages});
  arrays_[2].size = std::min({kSamplers, limits.maxDescriptorSetUpdateAfterBindSamplers,
                              limits.maxPerStageDescriptorUpdateAfterBindSamplers,
                              gpu_->properties().core.limits.maxSamplerAllocationCount});
  const uint32_t all = limits.maxPerStageUpdateAfterBindResources;
  if (arrays_[0].size > all / 2 || arrays_[1].size > all / 2 - arrays_[2].size) {
    arrays_[0].size = std::min(arrays_[0].size, all / 2);
    arrays_[1].size = std::min(arrays_[1].size, all / 2 - std::min(arrays_[2].size, all / 4));
  }
  arrays_[2].each = arrays_[2].next = 1;
  VkDescriptorSetLayoutBinding bindings[3] = {};
  VkDescriptorPoolSize sizes[3] = {};
  VkDescriptorBindingFlags flags[3];
  for (uint32_t i = 0; i < 3; ++i) {
    bindings[i].binding = i;
    bindings[i].descriptorType = kTypes[i];
    bindings[i].descriptorCount = arrays_[i].size;
    bindings[i].stageFlags = VK_SHADER_STAGE_ALL;
    sizes[i] = {kTypes[i], arrays_[i].size};
    flags[i] =
        VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT | VK_DESCRIPTOR_BINDING_UPDATE_AFTER_BIND_BIT;
  }
  VkDescriptorSetLayoutBindingFlagsCreateInfo binding_flags = {
      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO};
  binding_flags.bindingCount = 3;
  binding_flags.pBindingFlags = flags;
  VkDescriptorSetLayoutCreateInfo layout = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  layout.pNext = &binding_flags;
  layout.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_UPDATE_AFTER_BIND_POOL_BIT;
  layout.bindingCount = 3;
  layout.pBindings = bindings;
  const VolkDeviceTable& vk = gpu_->vk();
  VkResult r = vk.vkCreateDescriptorSetLayout(gpu_->device(), &layout, nullptr, &layout_);
  VkDescriptorPoolCreateInfo pool = {VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.flags = VK_DESCRIPTOR_POOL_CREATE_UPDATE_AFTER_BIND_BIT;
  pool.maxSets = 1;
  pool.poolSizeCount = 3;
  pool.pPoolSizes = sizes;
  if (r == VK_SUCCESS) r = vk.vkCreateDescriptorPool(gpu_->device(), &pool, nullptr, &pool_);
  VkDescriptorSetAllocateInfo allocate = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &layout_;
  if (r == VK_SUCCESS) r = vk.vkAllocateDescriptorSets(gpu_->device(), &allocate, &set_);
  if (r != VK_SUCCESS) return gpu_->error(r, "the descriptor set");
  return {};
}

DescriptorSet::~DescriptorSet() {
  gpu_->vk().vkDestroyDescriptorPool(gpu_->device(), pool_, nullptr);
  gpu_->vk().vkDestroyDescriptorSetLayout(gpu_->device(), layout_, nullptr);
}

rtapi::Result<uint32_t> DescriptorSet::add_sampled_images(VkImageView view,
                                                          VkImageView other_form) {
  return add(BindlessArray::kSampledImages, {VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL},
             other_form);
}

rtapi::Result<uint32_t> DescriptorSet::add_storage_images(VkImageView view,
                                                          VkImageView other_form) {
  return add(BindlessArray::kStorageImages, {VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL},
             other_form);
}

rtapi::Result<uint32_t> DescriptorSet::add_sampler(VkSampler sampler) {
  return add(BindlessArray::kSamplers, {sampler, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED},
             VK_NULL_HANDLE);
}

rtapi::Result<uint32_t> DescriptorSet::add(BindlessArray which, const VkDescriptorImageInfo& image,
                                           VkImageView other_form) {
  const std::lock_guard lock(mutex_);
  Array& array = arrays_[static_cast<uint32_t>(which)];
  uint32_t index = array.next;
  if (array.next + array.each <= array.size) {
    array.next += array.each;
  } else if (!array.free.empty()) {
    index = array.free.front();
    array.free.pop_front();
  } else {
    return runtime::make_error(runtime::Id::kVulkanLimit,
                               "too many " + std::string(kNames[static_cast<uint32_t>(which)]) +
                                   " alive: the Vulkan backend has room for " +
                                   std::to_string(array.size / array.each - 1) +
                                   "; free textures that are no longer used.");
  }
  write(which, index, image);
  if (array.each == 2 && (other_form != VK_NULL_HANDLE || gpu_->features().null_descriptor)) {
    write(which, index + 1, {VK_NULL_HANDLE, other_form, VK_IMAGE_LAYOUT_GENERAL});
  }
  return index;
}

void DescriptorSet::write(BindlessArray which, uint32_t index, const VkDescriptorImageInfo& image) {
  VkWriteDescriptorSet update = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  update.dstSet = set_;
  update.dstBinding = static_cast<uint32_t>(which);
  update.dstArrayElement = index;
  update.descriptorCount = 1;
  update.descriptorType = kTypes[static_cast<uint32_t>(which)];
  update.pImageInfo = &image;
  gpu_->vk().vkUpdateDescriptorSets(gpu_->device(), 1, &update, 0, nullptr);
}

void DescriptorSet::remove(BindlessArray array, uint32_t index) {
  const std::lock_guard lock(mutex_);
  if (array != BindlessArray::kSamplers && gpu_->features().null_descriptor) {
    write(array, index, {VK_NULL_HANDLE, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL});
    write(array, index + 1, {VK_NULL_HANDLE, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL});
  }
  arrays_[static_cast<uint32_t>(array)].free.push_back(index);
}

}  // namespace kaamos::vulkan
