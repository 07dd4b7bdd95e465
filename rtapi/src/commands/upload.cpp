// SPDX-License-Identifier: MIT
#include <rtapi/upload.h>

#include <cstring>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/device/device_impl.h"

namespace rtapi {

using namespace detail;

namespace {

// A staging buffer, and where the subresource's rows (of texels or blocks) lie in it.
struct Staging {
  Buffer buffer;
  PlacedSubresourceFootprint layout;
  uint64_t rows = 0;
  uint64_t row_bytes = 0;
};

Result<Staging> make_staging(const Device& device, const Texture& texture, uint32_t subresource,
                             HeapType heap) {
  if (!texture) return make_error(Id::kNullHandle, "the texture is an empty handle");
  std::vector<PlacedSubresourceFootprint> layouts;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> row_bytes;
  auto total = device.GetCopyableFootprints(texture.GetDesc(), subresource, 1, 0, &layouts, &rows,
                                            &row_bytes);
  if (!total.ok()) return total.error();
  auto buffer = device.CreateBuffer(
      {.SizeInBytes = *total, .Heap = heap, .Name = texture.name() + " staging"});
  if (!buffer.ok()) return buffer.error();
  return Staging{std::move(*buffer), layouts.front(),
                 uint64_t{rows.front()} * layouts.front().Footprint.Depth, row_bytes.front()};
}

Status check_queue(const Device& device, const CommandQueue& queue) {
  if (!device || !queue) {
    return make_error(Id::kNullHandle, device ? "the queue" : "the device", " is an empty handle");
  }
  return {};
}

// The texture helpers accept textures in any state.
void mark_as_helper(const CommandList& list) {
  for (runtime::Command& command : *list.impl()->commands) {
    if (auto* copy = std::get_if<runtime::CopyTextureCommand>(&command)) copy->any_state = true;
  }
}

}  // namespace

Result<Buffer> CreateUploadBuffer(const Device& device, std::span<const std::byte> bytes,
                                  std::string name) {
  auto buffer = device.CreateBuffer(
      {.SizeInBytes = bytes.size(), .Heap = HeapType::kUpload, .Name = std::move(name)});
  if (buffer.ok()) std::memcpy(buffer->data<std::byte>().data(), bytes.data(), bytes.size());
  return buffer;
}

Result<Buffer> CreateDefaultBuffer(const Device& device, const CommandQueue& queue,
                                   std::span<const std::byte> bytes, ResourceFlags flags,
                                   std::string name) {
  if (Status s = check_queue(device, queue); !s.ok()) return s.error();
  auto staging = CreateUploadBuffer(device, bytes, name + " staging");
  if (!staging.ok()) return staging.error();
  auto buffer =
      device.CreateBuffer({.SizeInBytes = bytes.size(), .Flags = flags, .Name = std::move(name)});
  if (!buffer.ok()) return buffer.error();
  auto list = device.CreateCommandList();
  if (!list.ok()) return list.error();
  list->CopyBufferRegion(*buffer, 0, *staging, 0, bytes.size());
  if (Status s = queue.ExecuteAndWait(*list); !s.ok()) return s.error();
  return buffer;
}

Result<std::vector<std::byte>> ReadbackBuffer(const Device& device, const CommandQueue& queue,
                                              const Buffer& buffer) {
  if (Status s = check_queue(device, queue); !s.ok()) return s.error();
  if (!buffer) return make_error(Id::kNullHandle, "ReadbackBuffer on an empty buffer handle");
  Buffer readable = buffer;
  if (buffer.GetDesc().Heap == HeapType::kDefault) {
    auto staging = device.CreateBuffer({.SizeInBytes = buffer.size(),
                                        .Heap = HeapType::kReadback,
                                        .Name = buffer.name() + " readback"});
    if (!staging.ok()) return staging.error();
    auto list = device.CreateCommandList();
    if (!list.ok()) return list.error();
    list->CopyBufferRegion(*staging, 0, buffer, 0, buffer.size());
    if (Status s = queue.ExecuteAndWait(*list); !s.ok()) return s.error();
    readable = *staging;
  }
  const auto bytes = readable.data<std::byte>();
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

Status UploadTexture(const Device& device, const CommandQueue& queue, const Texture& texture,
                     uint32_t subresource, std::span<const std::byte> texels, uint32_t row_pitch) {
  if (Status s = check_queue(device, queue); !s.ok()) return s;
  auto staging = make_staging(device, texture, subresource, HeapType::kUpload);
  if (!staging.ok()) return staging.error();
  const uint64_t pitch = row_pitch ? row_pitch : staging->row_bytes;
  const uint64_t needed = (staging->rows - 1) * pitch + staging->row_bytes;
  if (pitch < staging->row_bytes || texels.size() < needed) {
    return make_error(Id::kCopyRange, "UploadTexture: ", texels.size(), " bytes in rows of ", pitch,
                      " for subresource ", subresource, " of ", named("texture", texture.name()),
                      ", which has ", staging->rows, " rows of ", staging->row_bytes, " bytes");
  }
  std::byte* out = staging->buffer.data<std::byte>().data();
  for (uint64_t row = 0; row < staging->rows; ++row) {
    std::memcpy(out + row * staging->layout.Footprint.RowPitch, texels.data() + row * pitch,
                staging->row_bytes);
  }
  auto list = device.CreateCommandList();
  if (!list.ok()) return list.error();
  list->CopyTextureRegion({texture, subresource}, 0, 0, 0, {staging->buffer, staging->layout});
  mark_as_helper(*list);
  return queue.ExecuteAndWait(*list);
}

Result<std::vector<std::byte>> ReadbackTexture(const Device& device, const CommandQueue& queue,
                                               const Texture& texture, uint32_t subresource) {
  if (Status s = check_queue(device, queue); !s.ok()) return s.error();
  auto staging = make_staging(device, texture, subresource, HeapType::kReadback);
  if (!staging.ok()) return staging.error();
  auto list = device.CreateCommandList();
  if (!list.ok()) return list.error();
  list->CopyTextureRegion({staging->buffer, staging->layout}, 0, 0, 0, {texture, subresource});
  mark_as_helper(*list);
  if (Status s = queue.ExecuteAndWait(*list); !s.ok()) return s.error();
  std::vector<std::byte> texels(staging->rows * staging->row_bytes);
  const std::byte* in = staging->buffer.data<std::byte>().data();
  for (uint64_t row = 0; row < staging->rows; ++row) {
    std::memcpy(texels.data() + row * staging->row_bytes,
                in + row * staging->layout.Footprint.RowPitch, staging->row_bytes);
  }
  return texels;
}

}  // namespace rtapi
