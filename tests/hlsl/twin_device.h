// SPDX-License-Identifier: MIT
//
// A device that runs HLSL given as text: the CPU's with the interpreter, which gives the expected
// results, or Vulkan's.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "executors.h"

namespace kaamos::test {

struct TwinDevice {
  explicit TwinDevice(const std::string& backend)
      : device(rtapi::CreateDevice({.Backend = backend}).value()),
        queue(device.CreateCommandQueue().value()) {}

  bool is_vulkan() const { return device.GetDesc().Backend == "vulkan"; }

  // The library lives as long as `code`. A failed compilation fails the test.
  rtapi::ShaderLibrary compile(const std::string& source, Compiled& code) const;

  rtapi::Buffer output(uint64_t size_bytes) const {
    return device
        .CreateBuffer(
            {.SizeInBytes = size_bytes, .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess})
        .value();
  }

  // The words in a buffer.
  std::vector<uint32_t> words(const rtapi::Buffer& buffer);

  rtapi::Device device;
  rtapi::CommandQueue queue;
};

}  // namespace kaamos::test
