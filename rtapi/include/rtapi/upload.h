// SPDX-License-Identifier: MIT
/// @file
/// Short ways to move data between the host and resources. Each call creates what it needs,
/// executes and waits: for start-up code and tests, not for a frame loop.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <rtapi/device.h>

namespace rtapi {

/// A new upload-heap buffer that holds a copy of `bytes`, at least 1. Nothing is executed.
/// @errors those of Device::CreateBuffer: KA0904 an empty device, KA0905 no bytes or more than
/// 2^40, KA0990 no memory.
Result<Buffer> CreateUploadBuffer(const Device& device, std::span<const std::byte> bytes,
                                  std::string name = {});
/// A new upload-heap buffer that holds the bytes of `elements`, one after the other.
/// @errors as of the overload for bytes: KA0904, KA0905, KA0990.
template <class T>
Result<Buffer> CreateUploadBuffer(const Device& device, const std::vector<T>& elements,
                                  std::string name = {}) {
  return CreateUploadBuffer(device, std::as_bytes(std::span<const T>(elements)), std::move(name));
}

/// A new default-heap buffer that holds a copy of `bytes`, at least 1, made by a copy on `queue`.
/// `flags` and `name` are the buffer's.
/// @errors KA0904 an empty handle; those of Device::CreateBuffer, KA0905, KA0906, KA0990; those of
/// CommandQueue::ExecuteAndWait.
Result<Buffer> CreateDefaultBuffer(const Device& device, const CommandQueue& queue,
                                   std::span<const std::byte> bytes,
                                   ResourceFlags flags = ResourceFlags::kNone,
                                   std::string name = {});

/// The contents of a buffer on any heap, size() bytes. Those of the default heap are copied on
/// `queue`, behind all work that was submitted to it; others are read at once.
/// @errors KA0904 an empty handle; KA0903 a buffer or queue of another device; KA0821 a buffer of
/// acceleration structures; KA0990 no memory; those of CommandQueue::ExecuteAndWait.
Result<std::vector<std::byte>> ReadbackBuffer(const Device& device, const CommandQueue& queue,
                                              const Buffer& buffer);

/// Fills one subresource of a texture, in whatever state it is: `texels` are its rows from the top,
/// slice after slice, `row_pitch_bytes` from row to row; 0: rows follow each other without padding.
/// Texels are in the texture's format; if it is block-compressed, rows are of whole blocks.
/// @errors KA0904 an empty handle; KA0903 a texture or queue of another device; KA0817 no such
/// subresource, too few texels, or a pitch shorter than a row; KA0990 no memory; those of
/// CommandQueue::ExecuteAndWait.
Status UploadTexture(const Device& device, const CommandQueue& queue, const Texture& texture,
                     uint32_t subresource, std::span<const std::byte> texels,
                     uint32_t row_pitch_bytes = 0);
/// Reads one subresource of a texture, in whatever state it is: its rows from the top, slice after
/// slice, without padding, in the texture's format; rows of whole blocks if it is block-compressed.
/// @errors KA0904 an empty handle; KA0903 a texture or queue of another device; KA0817 no such
/// subresource; KA0990 no memory; those of CommandQueue::ExecuteAndWait.
Result<std::vector<std::byte>> ReadbackTexture(const Device& device, const CommandQueue& queue,
                                               const Texture& texture, uint32_t subresource);

}  // namespace rtapi
