// SPDX-License-Identifier: MIT
//
// Short ways to move data between the host and resources. Each call creates what it needs, executes
// and waits: for start-up code and tests, not for a frame loop.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <rtapi/device.h>

namespace rtapi {

// An upload-heap buffer that holds a copy of `bytes`.
Result<Buffer> CreateUploadBuffer(const Device& device, std::span<const std::byte> bytes,
                                  std::string name = {});
template <class T>
Result<Buffer> CreateUploadBuffer(const Device& device, const std::vector<T>& elements,
                                  std::string name = {}) {
  return CreateUploadBuffer(device, std::as_bytes(std::span<const T>(elements)), std::move(name));
}

// A default-heap buffer that holds a copy of `bytes`.
Result<Buffer> CreateDefaultBuffer(const Device& device, CommandQueue& queue,
                                   std::span<const std::byte> bytes,
                                   ResourceFlags flags = ResourceFlags::kNone,
                                   std::string name = {});

// The contents of a buffer on any heap.
Result<std::vector<std::byte>> ReadbackBuffer(const Device& device, CommandQueue& queue,
                                              const Buffer& buffer);

// Texels of one subresource, rows from the top, without padding between rows or slices unless
// `row_pitch_bytes` says so.
Status UploadTexture(const Device& device, CommandQueue& queue, const Texture& texture,
                     uint32_t subresource, std::span<const std::byte> texels,
                     uint32_t row_pitch_bytes = 0);
// Rows from the top, without padding.
Result<std::vector<std::byte>> ReadbackTexture(const Device& device, CommandQueue& queue,
                                               const Texture& texture, uint32_t subresource);

}  // namespace rtapi
