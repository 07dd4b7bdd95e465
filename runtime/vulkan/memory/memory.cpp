// SPDX-License-Identifier: MIT
#include "runtime/vulkan/memory/memory.h"

#include <mutex>
#include <utility>

namespace kaamos::vulkan {

rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> Memory::create_buffer(
    Gpu& gpu, const rtapi::BufferDesc& desc, std::shared_ptr<Memory> self) {
  // In a buffer for acceleration structures only the headers are ever touched.
  const bool structures =
      desc.InitialState == rtapi::ResourceStates::kRaytracingAccelerationStructure;
  auto made = gpu.create_buffer(desc.SizeInBytes, "buffer \"" + desc.Name + "\"",
                                structures ? InitialContents::kAny : InitialContents::kZero);
  if (!made) return made.error();
  return insert(std::move(self), std::move(*made));
}

rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> Memory::place_buffer(
    Gpu& gpu, const runtime::HeapPlace& place, const rtapi::BufferDesc& desc,
    std::shared_ptr<Memory> self) {
  if (!gpu.imports_pages()) return create_buffer(gpu, desc, std::move(self));
  const std::string what = "buffer \"" + desc.Name + "\"";
  runtime::MappedPages pages = place.map();
  if (!pages) return gpu.error(VK_ERROR_OUT_OF_HOST_MEMORY, what);
  auto made = gpu.place_buffer(std::move(pages), desc.SizeInBytes, what);
  if (!made) return made.error();
  return insert(std::move(self), std::move(*made));
}

std::shared_ptr<runtime::BackendBuffer> Memory::insert(std::shared_ptr<Memory> self,
                                                       std::unique_ptr<GpuBuffer> gpu) {
  auto buffer = std::make_shared<Buffer>(std::move(self), std::move(gpu));
  const std::unique_lock lock(mutex_);
  buffers_[buffer->address()] = &buffer->gpu();
  return buffer;
}

const GpuBuffer* Memory::find(uint64_t address) const {
  const std::shared_lock lock(mutex_);
  auto it = buffers_.upper_bound(address);
  if (it == buffers_.begin()) return nullptr;
  const GpuBuffer* buffer = std::prev(it)->second;
  return address - buffer->address() < buffer->size_bytes() ? buffer : nullptr;
}

uint8_t* Memory::host(uint64_t address, uint64_t size_bytes) const {
  const GpuBuffer* buffer = find(address);
  if (buffer == nullptr || buffer->host() == nullptr) return nullptr;
  const uint64_t offset = address - buffer->address();
  return size_bytes > buffer->size_bytes() - offset ? nullptr : buffer->host() + offset;
}

void Memory::on_buffer_end(std::function<void(uint64_t, uint64_t)> listener) {
  const std::unique_lock lock(mutex_);
  listener_ = std::move(listener);
}

void Memory::erase(const GpuBuffer& buffer) {
  const std::unique_lock lock(mutex_);
  buffers_.erase(buffer.address());
  if (listener_) listener_(buffer.address(), buffer.size_bytes());
}

Buffer::~Buffer() {
  memory_->erase(*gpu_);
}

}  // namespace kaamos::vulkan
