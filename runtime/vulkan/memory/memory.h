// SPDX-License-Identifier: MIT
//
// The application's buffers: which device address is which byte on the host.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <shared_mutex>

#include "runtime/backend/backend.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

class Buffer;

// All live buffers of a device, by address. Thread-safe; outlives them.
class Memory {
 public:
  // Errors: KA0990, KA0956.
  rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> create_buffer(
      Gpu& gpu, const rtapi::BufferDesc& desc, std::shared_ptr<Memory> self);

  // The same in a heap. Errors: KA0990.
  rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> place_buffer(
      Gpu& gpu, const runtime::HeapPlace& place, const rtapi::BufferDesc& desc,
      std::shared_ptr<Memory> self);

  // The bytes [address, address + size_bytes) as the host sees them; null unless they are inside
  // one live buffer. To see what GPU work wrote there, call CommandStream::flush first.
  uint8_t* host(uint64_t address, uint64_t size_bytes) const;

  // The live buffer that has the byte at `address`; null if none has.
  const GpuBuffer* find(uint64_t address) const;

  // The listener is called with the range of every buffer that ends, before its memory is freed;
  // null: none. It must not call back.
  void on_buffer_end(std::function<void(uint64_t address, uint64_t size_bytes)> listener);

 private:
  friend class Buffer;
  std::shared_ptr<runtime::BackendBuffer> insert(std::shared_ptr<Memory> self,
                                                 std::unique_ptr<GpuBuffer> gpu);
  void erase(const GpuBuffer& buffer);

  mutable std::shared_mutex mutex_;
  std::map<uint64_t, const GpuBuffer*> buffers_;
  std::function<void(uint64_t, uint64_t)> listener_;
};

class Buffer final : public runtime::BackendBuffer {
 public:
  Buffer(std::shared_ptr<Memory> memory, std::unique_ptr<GpuBuffer> gpu)
      : memory_(std::move(memory)), gpu_(std::move(gpu)) {}
  ~Buffer() override;

  uint64_t address() const override { return gpu_->address(); }
  uint64_t size_bytes() const override { return gpu_->size_bytes(); }
  uint8_t* host() const override { return gpu_->host(); }
  const GpuBuffer& gpu() const { return *gpu_; }

 private:
  std::shared_ptr<Memory> memory_;
  std::unique_ptr<GpuBuffer> gpu_;
};

// Every BackendBuffer in a command for this backend is a Buffer.
inline const GpuBuffer& gpu_buffer_of(const runtime::BackendBuffer& buffer) {
  return static_cast<const Buffer&>(buffer).gpu();
}

}  // namespace kaamos::vulkan
