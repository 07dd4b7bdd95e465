// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/micromap_buffers.h"

#include <cstring>
#include <string>

#include <kaamos/shader/spirv_interface.h>

#include "runtime/backend/errors.h"

namespace kaamos::vulkan {

using runtime::MicromapArray;
using shader::spirv::MicromapEntry;

namespace {

constexpr uint64_t kHeaderBytes = 8;

uint64_t round_up(uint64_t bytes) {
  return (bytes + 3) / 4 * 4;
}

}  // namespace

rtapi::Result<uint64_t> MicromapBuffers::address_of(
    const std::shared_ptr<const MicromapArray>& array) {
  if (array == nullptr) return uint64_t{0};
  Copy& copy = copies_[array.get()];
  if (copy.array.lock() == array) return copy.buffer->address();
  const uint32_t count = array->size();
  uint64_t bytes = kHeaderBytes + uint64_t{count} * sizeof(MicromapEntry);
  for (uint32_t i = 0; i < count; ++i) bytes += round_up(array->bits(i).size());
  if (bytes > UINT32_MAX) {
    return runtime::make_error(runtime::Id::kOutOfMemory,
                               "an opacity micromap array takes " + std::to_string(bytes) +
                                   " bytes; on Vulkan it must take less than 4 GiB.");
  }
  auto buffer = gpu_->create_buffer(bytes, "opacity micromaps");
  if (!buffer) return buffer.error();
  uint8_t* const host = (*buffer)->host();
  std::memcpy(host, &count, sizeof(count));
  uint64_t at = kHeaderBytes + uint64_t{count} * sizeof(MicromapEntry);
  for (uint32_t i = 0; i < count; ++i) {
    const std::span<const uint8_t> bits = array->bits(i);
    const MicromapEntry entry = {static_cast<uint32_t>(at), static_cast<uint16_t>(array->level(i)),
                                 static_cast<uint16_t>(array->format(i))};
    std::memcpy(host + kHeaderBytes + i * sizeof(entry), &entry, sizeof(entry));
    std::memcpy(host + at, bits.data(), bits.size());
    at += round_up(bits.size());
  }
  copy = {array, std::move(*buffer)};
  return copy.buffer->address();
}

void MicromapBuffers::release_unused() {
  std::erase_if(copies_, [](const auto& copy) { return copy.second.array.expired(); });
}

}  // namespace kaamos::vulkan
