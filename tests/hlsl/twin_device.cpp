// SPDX-License-Identifier: MIT
#include "twin_device.h"

#include <gtest/gtest.h>

#include <cstring>

namespace kaamos::test {

rtapi::ShaderLibrary TwinDevice::compile(const std::string& source, Compiled& code) const {
  hlsl::FrontendOptions options;
  options.path = "twins.hlsl";
  options.text = source;
  options.native_16bit = true;
  code = is_vulkan() ? compile_vulkan(options) : compile_interpreted(options);
  EXPECT_EQ(code.error, "");
  if (code.library == nullptr) return {};
  return rtapi::LoadShaderLibrary(code.library).value();
}

std::vector<uint32_t> TwinDevice::words(const rtapi::Buffer& buffer) {
  const std::vector<std::byte> bytes = rtapi::ReadbackBuffer(device, queue, buffer).value();
  std::vector<uint32_t> out(bytes.size() / 4);
  std::memcpy(out.data(), bytes.data(), out.size() * 4);
  return out;
}

}  // namespace kaamos::test
