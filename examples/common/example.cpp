// SPDX-License-Identifier: MIT
#include "example.h"

#include "effects/assets/image/png.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <string>

namespace example {
namespace {

using namespace rtapi;

bool ParseSize(const std::string& text, uint32_t& width, uint32_t& height) {
  unsigned w = 0;
  unsigned h = 0;
  int end = 0;
  if (std::sscanf(text.c_str(), "%ux%u%n", &w, &h, &end) != 2 ||
      static_cast<size_t>(end) != text.size() || w == 0 || h == 0 || w > 16384 || h > 16384) {
    return false;
  }
  width = w;
  height = h;
  return true;
}

// Prints a pixel's value, for comparing backends.
int PrintPixel(const char* name, const Setup& setup, const std::string& text,
               const kaamos::effects::ByteImage& image) {
  unsigned x = 0;
  unsigned y = 0;
  if (std::sscanf(text.c_str(), "%u,%u", &x, &y) != 2 || x >= image.width || y >= image.height) {
    std::fprintf(stderr, "%s: --pixel %s is outside the picture: give x,y within %ux%u\n", name,
                 text.c_str(), image.width, image.height);
    return 2;
  }
  const uint8_t* value = image.values.data() + (size_t{y} * image.width + x) * 4;
  std::printf("%s: pixel (%u, %u) on %s: %u %u %u %u\n", name, x, y,
              setup.device.GetInfo().Name.c_str(), value[0], value[1], value[2], value[3]);
  return 0;
}

}  // namespace

int Main(int argc, char** argv, const char* name, Body body,
         const std::vector<std::string>& breakable, const DeviceDesc& device) {
  std::string backend = "embree";
  std::string size = "640x360";
  std::string out = std::string(name) + ".png";
  std::string pixel;
  std::string broken;
  bool unchecked = false;
  CLI::App app(std::string(name) + ", an example of Kaamos");
  app.add_option("--backend", backend, "which backend runs it: embree or vulkan")
      ->capture_default_str();
  app.add_option("--size", size, "width and height of the picture")->capture_default_str();
  app.add_option("--out", out, "the picture file, a PNG")->capture_default_str();
  app.add_option("--pixel", pixel, "x,y: print that pixel instead of writing the picture");
  app.add_flag("--unchecked", unchecked, "turn checked mode off: faster, but reports nothing");
  if (!breakable.empty()) {
    app.add_option("--break", broken, "make this mistake, to see what checked mode says")
        ->check(CLI::IsMember(breakable));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;  // --help gives 0
  }

  Setup setup;
  setup.broken = broken;
  // Messages may come from any thread.
  std::atomic<uint32_t> findings = 0;
  if (!ParseSize(size, setup.width, setup.height)) {
    std::fprintf(stderr,
                 "%s: --size %s is not a size: give width and height of 1 to 16384, like 640x360\n",
                 name, size.c_str());
    return 2;
  }
  try {
    DeviceDesc desc = device;
    desc.Backend = backend;
    desc.Checked = !unchecked;
    desc.OnMessage = [&findings](const Message& message) {
      std::fprintf(stderr, "%s\n", message.Text.c_str());
      if (message.Severity == MessageSeverity::kError) ++findings;
    };
    setup.device = CreateDevice(desc).value();
    setup.queue = setup.device.CreateCommandQueue().value();
    const Texture picture = body(setup);
    if (findings > 0) {
      std::fprintf(stderr, "%s: stopped because of what checked mode reported above\n", name);
      return 1;
    }
    const std::vector<std::byte> texels =
        ReadbackTexture(setup.device, setup.queue, picture, 0).value();
    kaamos::effects::ByteImage image{setup.width, setup.height, 4, {}};
    image.values.resize(texels.size());
    std::memcpy(image.values.data(), texels.data(), texels.size());
    if (!pixel.empty()) return PrintPixel(name, setup, pixel, image);
    if (const auto written = kaamos::effects::write_png(out, image); !written.ok()) {
      std::fprintf(stderr, "%s: %s\n", name, written.error().message.c_str());
      return 1;
    }
    std::printf("%s: %ux%u on %s -> %s\n", name, setup.width, setup.height,
                setup.device.GetInfo().Name.c_str(), out.c_str());
    return 0;
  } catch (const ResultError& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

Image CreateImage(const Setup& setup, uint32_t descriptors) {
  Image image;
  image.texture = setup.device
                      .CreateTexture({.Width = setup.width,
                                      .Height = setup.height,
                                      .Format = Format::kR8G8B8A8Unorm,
                                      .Flags = ResourceFlags::kAllowUnorderedAccess,
                                      .InitialState = ResourceStates::kUnorderedAccess,
                                      .Name = "image"})
                      .value();
  image.heap = setup.device
                   .CreateDescriptorHeap({.NumDescriptors = descriptors,
                                          .Flags = DescriptorHeapFlags::kShaderVisible,
                                          .Name = "descriptors"})
                   .value();
  setup.device
      .CreateUnorderedAccessView(image.texture, image.heap.GetCPUDescriptorHandleForHeapStart())
      .value();
  return image;
}

Mesh CreateMesh(const Setup& setup, const std::vector<float>& positions,
                const std::vector<uint32_t>& indices, RaytracingGeometryFlags flags) {
  Mesh mesh;
  mesh.vertices = CreateUploadBuffer(setup.device, positions, "vertices").value();
  mesh.geometry.Type = RaytracingGeometryType::kTriangles;
  mesh.geometry.Flags = flags;
  mesh.geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  mesh.geometry.Triangles.VertexCount = static_cast<uint32_t>(positions.size() / 3);
  mesh.geometry.Triangles.VertexBuffer = {mesh.vertices.GetGPUVirtualAddress(), 12};
  if (!indices.empty()) {
    mesh.indices = CreateUploadBuffer(setup.device, indices, "indices").value();
    mesh.geometry.Triangles.IndexFormat = Format::kR32Uint;
    mesh.geometry.Triangles.IndexCount = static_cast<uint32_t>(indices.size());
    mesh.geometry.Triangles.IndexBuffer = mesh.indices.GetGPUVirtualAddress();
  }
  return mesh;
}

RaytracingInstanceDesc Instance(const Buffer& bottom_level, float x, float y, float z,
                                float scale) {
  RaytracingInstanceDesc instance;
  const float place[3] = {x, y, z};
  for (int row = 0; row < 3; ++row) {
    instance.Transform[row][row] = scale;
    instance.Transform[row][3] = place[row];
  }
  instance.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  return instance;
}

}  // namespace example
