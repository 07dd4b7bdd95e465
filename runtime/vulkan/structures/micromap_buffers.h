// SPDX-License-Identifier: MIT
//
// Opacity micromap arrays in memory that shaders read (spirv_interface.h: GeometryMicromaps).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include <rtapi/result.h>

#include "runtime/structures/opacity_micromap.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

// Keeps an array's copy as long as the array lives. Used while no dispatch runs.
class MicromapBuffers {
 public:
  explicit MicromapBuffers(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}
  // The address of the copy, which is made by the first call; 0 for null. Errors: KA0990 out of
  // memory, or an array of 4 GiB.
  rtapi::Result<uint64_t> address_of(const std::shared_ptr<const runtime::MicromapArray>& array);
  // Frees the copies of arrays that are gone.
  void release_unused();

 private:
  struct Copy {
    std::weak_ptr<const runtime::MicromapArray> array;
    std::unique_ptr<GpuBuffer> buffer;
  };
  std::shared_ptr<Gpu> gpu_;
  std::map<const runtime::MicromapArray*, Copy> copies_;
};

}  // namespace kaamos::vulkan
