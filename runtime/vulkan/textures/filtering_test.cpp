// SPDX-License-Identifier: MIT
//
// Tests how exactly textures are filtered. [D3D11.3 7.18.8: linear sample addressing]
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "runtime/vulkan/testing/harness.h"
#include "runtime/vulkan/textures/texture.h"

namespace kaamos::vulkan {
namespace {

using testing::Bench;
using testing::PipelineBuilder;

constexpr char kSample[] = R"(
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D images[];
layout(set = 0, binding = 2) uniform sampler samplers[];
layout(buffer_reference, scalar) buffer Floats { vec4 v[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  float u = (0.5 + (i + 0.37) / 256.0) / 2.0;  // from the centre of the first texel to the second's
  Floats(block.arguments[0]).v[i] =
      textureLod(sampler2D(images[uint(block.arguments[1])], samplers[uint(block.arguments[2])]),
                 vec2(u, 0.5), 0);
}
)";

// The largest error on the way from one texel, 0, to the next, 1.
double largest_error(std::shared_ptr<Gpu> gpu) {
  Bench bench(gpu);
  auto textures = TextureStore::create(gpu, bench.descriptors).value();
  rtapi::TextureDesc desc;
  desc.Width = 2;
  desc.Format = rtapi::Format::kR8G8B8A8Unorm;
  const auto texture = textures->create_texture(desc).value();
  const auto upload = bench.buffer(512);
  const uint8_t texels[8] = {0, 0, 0, 0, 255, 255, 255, 255};
  std::memcpy(upload->host(), texels, sizeof(texels));
  runtime::CopyTextureCommand copy;
  copy.dest.texture = texture;
  copy.source.buffer = upload;
  copy.source.row_pitch = 256;
  copy.source.slice_pitch = 256;
  copy.extent[0] = 2;
  copy.extent[1] = copy.extent[2] = 1;
  EXPECT_TRUE(textures->copy(bench.scene.stream(), copy));
  runtime::TextureViewDesc view;
  view.format = desc.Format;
  rtapi::SamplerDesc sampler;
  sampler.AddressU = sampler.AddressV = rtapi::TextureAddressMode::kClamp;
  const uint64_t image = textures->create_view(*texture, view).value();
  const uint64_t filter = textures->create_sampler(sampler).value();
  PipelineBuilder builder;
  const auto pipeline = ComputePipeline::create(bench.layout, builder.compute(kSample)).value();
  const auto out = bench.buffer(256 * 16);
  EXPECT_TRUE(bench.groups(pipeline, 4, 1, 1, {out->address(), image, filter}).status);
  double worst = 0;
  for (int i = 0; i < 256; ++i) {
    float value;
    std::memcpy(&value, out->host() + i * 16, sizeof(value));
    worst = std::max(worst, std::fabs(value - (i + 0.37) / 256));
  }
  return worst;
}

// D3D requires 8 bits for the position between two texels: half of one step is 0.002.
TEST(Filtering, ErrsByLessThanTheStepsOfEightBits) {
  KAAMOS_NEED_GPU(gpu);
  EXPECT_LT(largest_error(gpu), gpu->is_lavapipe() ? 1e-5 : 0.0021);
}

// Run by the next test.
TEST(Filtering, DISABLED_WithoutTheWorkaround) {
  KAAMOS_NEED_GPU(gpu);
  EXPECT_GT(largest_error(gpu), 0.0005);
}

// In a process of its own, because the driver reads its option once per process.
TEST(Filtering, FaultIsStillThere) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) return;
  char path[4096] = {};
  ASSERT_GT(readlink("/proc/self/exe", path, sizeof(path) - 1), 0);
  const std::string command =
      std::string("KAAMOS_VULKAN_DISABLE_WORKAROUNDS=FILTER '") + path +
      "' --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_WithoutTheWorkaround' "
      "> /dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace kaamos::vulkan
