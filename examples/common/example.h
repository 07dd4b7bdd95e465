// SPDX-License-Identifier: MIT
//
// Everything in an example that is not DXR: the command line, the device, and the picture file.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace example {

struct Setup {
  rtapi::Device device;
  rtapi::CommandQueue queue;
  uint32_t width = 0;
  uint32_t height = 0;
  std::string broken;  // which of the mistakes given to Main to make; "" means none
};

// Renders into a texture of Setup's size with format kR8G8B8A8Unorm. Throws rtapi::ResultError.
using Body = rtapi::Texture (*)(const Setup&);

// Parses `--backend NAME --size WxH --out FILE`, runs `body` and writes its picture to
// "<name>.png"; with `--pixel X,Y` it prints that pixel instead. The device is in checked mode
// (`--unchecked` turns it off): what checked mode reports is printed and makes the exit code 1, as
// an error does. With `breakable` there is also `--break WHAT`. `device` is what the device has
// beside what the command line says. Returns the exit code.
int Main(int argc, char** argv, const char* name, Body body,
         const std::vector<std::string>& breakable = {}, const rtapi::DeviceDesc& device = {});

// A texture that shaders can write, and a heap whose descriptor 0 is its unordered access view.
struct Image {
  rtapi::Texture texture;
  rtapi::DescriptorHeap heap;
};
Image CreateImage(const Setup& setup, uint32_t descriptors = 1);

// A geometry with float3 vertices, and with 32-bit indices unless `indices` is empty. The buffers
// live as long as the result.
struct Mesh {
  rtapi::Buffer vertices;
  rtapi::Buffer indices;
  rtapi::RaytracingGeometryDesc geometry;
};
Mesh CreateMesh(const Setup& setup, const std::vector<float>& positions,
                const std::vector<uint32_t>& indices,
                rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kOpaque);

// An instance of `bottom_level` at a position.
rtapi::RaytracingInstanceDesc Instance(const rtapi::Buffer& bottom_level, float x, float y, float z,
                                       float scale = 1);

}  // namespace example
