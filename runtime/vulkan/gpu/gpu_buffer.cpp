// SPDX-License-Identifier: MIT
//
// Memory of buffers. Where shaders run on the processor, large buffers are pages of this process,
// which are zero and cost nothing until they are touched. Otherwise it is Vulkan's memory, mapped
// and cleared.
#include <sys/mman.h>

#include <algorithm>
#include <cstring>

#include "runtime/backend/aligned_pages.h"
#include "runtime/backend/errors.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {
namespace {

constexpr uint64_t kAddressAlignment = runtime::kBufferAlignment;
constexpr uint64_t kFromPages = 1024 * 1024;  // smaller buffers are cleared right away

constexpr VkBufferUsageFlags kEveryUsage =
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
    VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
    VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR;

uint64_t rounded(uint64_t bytes) {
  return runtime::round_up(bytes, kAddressAlignment);
}

}  // namespace

rtapi::Result<std::unique_ptr<GpuBuffer>> Gpu::create_buffer(uint64_t size_bytes,
                                                             const std::string& what,
                                                             InitialContents contents) {
  const uint64_t limit =
      std::min(properties_.vulkan13.maxBufferSize, properties_.vulkan11.maxMemoryAllocationSize) -
      2 * kAddressAlignment;
  if (size_bytes > limit) {
    return runtime::make_error(runtime::Id::kVulkanLimit,
                               what + " of " + std::to_string(size_bytes) +
                                   " bytes is too large: " + info_.Name + " allows " +
                                   std::to_string(limit) + " bytes; use several buffers.");
  }
  std::unique_ptr<GpuBuffer> buffer(new GpuBuffer(shared_from_this()));
  buffer->size_bytes_ = size_bytes;
  if (size_bytes >= kFromPages && imports_pages()) {
    const uint64_t bytes = rounded(size_bytes);
    runtime::MappedPages pages(runtime::map_aligned(bytes, PROT_READ | PROT_WRITE), bytes);
    if (pages && import_pages(*buffer, std::move(pages)) == VK_SUCCESS) return buffer;
    release(*buffer);
  }
  VkResult r = allocate(*buffer);
  if (r != VK_SUCCESS) return error(r, what + " of " + std::to_string(size_bytes) + " bytes");
  if (contents == InitialContents::kZero) std::memset(buffer->host_, 0, size_bytes);
  return buffer;
}

rtapi::Result<std::unique_ptr<GpuBuffer>> Gpu::place_buffer(runtime::MappedPages pages,
                                                            uint64_t size_bytes,
                                                            const std::string& what) {
  std::unique_ptr<GpuBuffer> buffer(new GpuBuffer(shared_from_this()));
  buffer->size_bytes_ = size_bytes;
  const VkResult r = import_pages(*buffer, std::move(pages));
  if (r != VK_SUCCESS) return error(r, what + " of " + std::to_string(size_bytes) + " bytes");
  return buffer;
}

bool Gpu::imports_pages() const {
  return properties_.core.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU &&
         features_.external_memory_host;
}

VkResult Gpu::bind_memory(GpuBuffer& buffer, const void* chain, uint32_t type_bits) {
  VkMemoryRequirements needs;
  vk_.vkGetBufferMemoryRequirements(device_, buffer.handle_, &needs);
  VkMemoryAllocateFlagsInfo flags = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
  flags.pNext = chain;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo info = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.pNext = &flags;
  info.allocationSize = std::max(needs.size, buffer.pages_.size_bytes());
  // Only a small part of a graphics card's memory may be visible to the host; try the next best
  // type then.
  VkResult r = VK_ERROR_FEATURE_NOT_PRESENT;
  for (uint32_t types = needs.memoryTypeBits & type_bits; types != 0;) {
    info.memoryTypeIndex = memory_type(
        types, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
        VK_MEMORY_PROPERTY_HOST_CACHED_BIT | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (info.memoryTypeIndex == UINT32_MAX) break;
    r = vk_.vkAllocateMemory(device_, &info, nullptr, &buffer.memory_);
    if (r != VK_ERROR_OUT_OF_DEVICE_MEMORY) break;
    types &= ~(1u << info.memoryTypeIndex);
  }
  if (r != VK_SUCCESS) return r;
  r = vk_.vkBindBufferMemory(device_, buffer.handle_, buffer.memory_, 0);
  if (r != VK_SUCCESS) return r;
  VkBufferDeviceAddressInfo address = {VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
  address.buffer = buffer.handle_;
  const uint64_t start = vk_.vkGetBufferDeviceAddress(device_, &address);
  buffer.address_ = rounded(start);
  buffer.offset_ = buffer.address_ - start;
  return VK_SUCCESS;
}

VkResult Gpu::allocate(GpuBuffer& buffer) {
  VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  // The address is known only afterwards, so leave room to move up to the alignment.
  info.size = std::max<uint64_t>(buffer.size_bytes_, 1) + kAddressAlignment;
  info.usage = kEveryUsage;
  VkResult r = vk_.vkCreateBuffer(device_, &info, nullptr, &buffer.handle_);
  if (r == VK_SUCCESS) r = bind_memory(buffer, nullptr, UINT32_MAX);
  void* mapped = nullptr;
  if (r == VK_SUCCESS) {
    r = vk_.vkMapMemory(device_, buffer.memory_, 0, VK_WHOLE_SIZE, 0, &mapped);
  }
  buffer.host_ = static_cast<uint8_t*>(mapped) + buffer.offset_;
  return r;
}

VkResult Gpu::import_pages(GpuBuffer& buffer, runtime::MappedPages pages) {
  constexpr auto kPages = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
  buffer.pages_ = std::move(pages);
  VkMemoryHostPointerPropertiesEXT types = {VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT};
  VkResult r =
      vk_.vkGetMemoryHostPointerPropertiesEXT(device_, kPages, buffer.pages_.first(), &types);
  VkExternalMemoryBufferCreateInfo external = {
      VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO};
  external.handleTypes = kPages;
  VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.pNext = &external;
  info.size = buffer.pages_.size_bytes();
  info.usage = kEveryUsage;
  if (r == VK_SUCCESS) r = vk_.vkCreateBuffer(device_, &info, nullptr, &buffer.handle_);
  VkImportMemoryHostPointerInfoEXT import = {VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT};
  import.handleType = kPages;
  import.pHostPointer = buffer.pages_.first();
  if (r == VK_SUCCESS) r = bind_memory(buffer, &import, types.memoryTypeBits);
  // An address that is no multiple of 64 KiB cannot be moved within pages that are not larger.
  if (r == VK_SUCCESS && buffer.offset_ != 0) r = VK_ERROR_INVALID_EXTERNAL_HANDLE;
  buffer.host_ = buffer.pages_.first();
  return r;
}

void Gpu::release(GpuBuffer& buffer) {
  vk_.vkDestroyBuffer(device_, buffer.handle_, nullptr);
  vk_.vkFreeMemory(device_, buffer.memory_, nullptr);
  buffer.handle_ = VK_NULL_HANDLE;
  buffer.memory_ = VK_NULL_HANDLE;
  buffer.pages_ = {};
}

GpuBuffer::~GpuBuffer() {
  gpu_->release(*this);
}

}  // namespace kaamos::vulkan
