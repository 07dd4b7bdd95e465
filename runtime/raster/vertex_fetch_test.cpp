// SPDX-License-Identifier: MIT
//
// Tests what vertex buffers give the columns of a vertex shader: RAS-11, RAS-13 to RAS-15.
#include "runtime/raster/vertex_fetch.h"

#include <gtest/gtest.h>

#include <bit>

namespace kaamos::raster {
namespace {

using rtapi::Format;

struct Fetch {
  runtime::LinkedGraphics linked;
  runtime::DrawState state;
  Draw draw;
  shader::Column columns[8];

  void bind(uint32_t slot, std::span<const uint8_t> bytes, uint32_t stride) {
    draw.vertex_buffers[slot] = bytes;
    state.vertex_buffers[slot].StrideInBytes = stride;
  }
  // Values are undefined before.
  void read(std::vector<uint32_t> ids, uint32_t instance = 0) {
    draw.linked = &linked;
    draw.state = &state;
    for (auto& column : columns) {
      for (uint32_t& lane : column) lane = 0xDEADBEEF;
    }
    VertexFetch fetch;
    fetch.bind(draw);
    fetch.read(instance, ids.data(), static_cast<uint32_t>(ids.size()), columns);
  }
  std::array<float, 4> floats(int lane) {
    std::array<float, 4> out;
    for (int c = 0; c < 4; ++c) out[c] = std::bit_cast<float>(columns[c][lane]);
    return out;
  }
  std::array<uint32_t, 4> bits(int lane) {
    return {columns[0][lane], columns[1][lane], columns[2][lane], columns[3][lane]};
  }
};

template <class T>
std::span<const uint8_t> bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)};
}

TEST(RasterFetch, ConvertsLikeAView) {  // RAS-13
  Fetch fetch;
  const std::vector<int16_t> values = {-32768, 32767, 0, 0};
  fetch.linked.elements = {{0, 0, Format::kR16G16Snorm, false, 0, 0, 4}};
  fetch.bind(0, bytes_of(values), 4);
  fetch.read({0, 1});
  EXPECT_EQ(fetch.floats(0), (std::array<float, 4>{-1, 1, 0, 1}));
  EXPECT_EQ(fetch.floats(1), (std::array<float, 4>{0, 0, 0, 1}));
  // Integers get an integer 1.
  fetch.linked.elements[0].format = Format::kR16G16Uint;
  fetch.read({0});
  EXPECT_EQ(fetch.bits(0), (std::array<uint32_t, 4>{32768, 32767, 0, 1}));
  fetch.linked.elements[0].format = Format::kR8G8B8A8Unorm;
  fetch.read({0});
  EXPECT_EQ(fetch.floats(0), (std::array<float, 4>{0, 128.0f / 255, 1, 127.0f / 255}));
  // Fewer components are read than the format has.
  fetch.linked.elements[0].components = 2;
  fetch.read({0});
  EXPECT_EQ(fetch.columns[2][0], 0xDEADBEEFu);
}

TEST(RasterFetch, ElementsBeyondTheViewAreZero) {  // RAS-14
  Fetch fetch;
  const std::vector<float> values = {1, 2, 3, 4, 5};
  fetch.linked.elements = {{0, 0, Format::kR32G32Float, false, 0, 0, 4}};
  fetch.bind(0, bytes_of(values), 8);
  fetch.read({1, 2, 0xFFFFFFFF});
  EXPECT_EQ(fetch.floats(0), (std::array<float, 4>{3, 4, 0, 1}));
  EXPECT_EQ(fetch.floats(1), (std::array<float, 4>{0, 0, 0, 1}));
  EXPECT_EQ(fetch.floats(2), (std::array<float, 4>{0, 0, 0, 1}));
  // Nothing is bound: not even the default.
  fetch.linked.elements[0].slot = 3;
  fetch.read({0});
  EXPECT_EQ(fetch.floats(0), (std::array<float, 4>{0, 0, 0, 0}));
  // A view without bytes is bound.
  fetch.bind(3, {reinterpret_cast<const uint8_t*>(values.data()), 0}, 8);
  fetch.read({0});
  EXPECT_EQ(fetch.floats(0), (std::array<float, 4>{0, 0, 0, 1}));
}

TEST(RasterFetch, StridesNeedNotFitElements) {  // RAS-15
  Fetch fetch;
  const std::vector<float> values = {0, 0, 0, 0, 4, 5, 6, 7, 8};
  fetch.linked.elements = {{0, 16, Format::kR32G32B32A32Float, false, 0, 0, 4}};
  fetch.bind(0, bytes_of(values), 4);
  fetch.read({0, 1, 2});
  EXPECT_EQ(fetch.floats(0), (std::array<float, 4>{4, 5, 6, 7}));
  EXPECT_EQ(fetch.floats(1), (std::array<float, 4>{5, 6, 7, 8}));
  EXPECT_EQ(fetch.floats(2), (std::array<float, 4>{0, 0, 0, 0}));
  fetch.bind(0, bytes_of(values), 0);
  fetch.read({0, 77});
  EXPECT_EQ(fetch.floats(1), (std::array<float, 4>{4, 5, 6, 7}));
}

TEST(RasterFetch, InstancesStep) {  // RAS-11
  Fetch fetch;
  const std::vector<float> values = {0, 10, 20, 30, 40};
  fetch.linked.elements = {{0, 0, Format::kR32Float, true, 2, 0, 1}};
  fetch.bind(0, bytes_of(values), 4);
  fetch.draw.arguments.StartInstanceLocation = 1;
  fetch.draw.arguments.StartIndexLocation = 3;
  const float expected[4] = {10, 10, 20, 20};
  for (uint32_t instance = 0; instance < 4; ++instance) {
    fetch.read({5}, instance);
    EXPECT_EQ(fetch.floats(0)[0], expected[instance]);
    fetch.linked.elements[0].step_rate = 0;
    fetch.read({5}, instance);
    EXPECT_EQ(fetch.floats(0)[0], 10.0f);
    fetch.linked.elements[0].step_rate = 2;
  }
}

}  // namespace
}  // namespace kaamos::raster
