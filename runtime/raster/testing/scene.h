// SPDX-License-Identifier: MIT
//
// A draw for tests of this folder: shaders are C++ functions, vertices are floats that the vertex
// shader passes on.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/raster/rasterizer.h"

namespace kaamos::raster::testing {

// A texture with rows that are longer than they need to be; what is between them keeps a pattern.
class TestTexture {
 public:
  TestTexture(rtapi::Format format, uint32_t width, uint32_t height, uint32_t slices = 1);

  Surface surface();
  uint8_t* texel(uint32_t x, uint32_t y, uint32_t slice = 0);
  // The first bytes of a texel as a T.
  template <class T>
  T at(uint32_t x, uint32_t y, uint32_t slice = 0) {
    T value;
    std::memcpy(&value, texel(x, y, slice), sizeof(T));
    return value;
  }
  template <class T>
  void set(uint32_t x, uint32_t y, T value, uint32_t slice = 0) {
    std::memcpy(texel(x, y, slice), &value, sizeof(T));
  }
  template <class T>
  void fill(T value) {
    for (uint32_t slice = 0; slice < slices; ++slice) {
      for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) set(x, y, value, slice);
      }
    }
  }
  // Counts the texels that begin with this value.
  template <class T>
  uint32_t count(T value) {
    uint32_t found = 0;
    for (uint32_t slice = 0; slice < slices; ++slice) {
      for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) found += at<T>(x, y, slice) == value ? 1 : 0;
      }
    }
    return found;
  }
  bool padding_is_intact() const;
  const std::vector<uint8_t>& bytes() const { return bytes_; }

  const rtapi::Format format;
  const uint32_t width, height, slices;

 private:
  uint32_t texel_bytes_;
  uint64_t row_pitch_;
  std::vector<uint8_t> bytes_;
};

// Threads that run tasks, each with a copy of the shaders.
class TestWorkers : public Workers {
 public:
  using Vertices = std::function<void(uint32_t draw, const shader::VertexLanes&)>;
  using Pixels = std::function<void(uint32_t draw, shader::PixelLanes&)>;

  TestWorkers(uint32_t threads, Vertices vertices, Pixels pixels)
      : threads_(threads), vertices_(std::move(vertices)), pixels_(std::move(pixels)) {}
  void run(uint32_t count, Task task, const void* context) override;

 private:
  uint32_t threads_;
  Vertices vertices_;
  Pixels pixels_;
};

inline float as_float(uint32_t bits) {
  return std::bit_cast<float>(bits);
}
inline uint32_t as_bits(float value) {
  return std::bit_cast<uint32_t>(value);
}

// One draw and its targets. Vertices are `columns` floats each: x, y, z, w, then attributes; the
// vertex shader passes them on in columns of the same numbers.
class Scene {
 public:
  explicit Scene(uint32_t width = 256, uint32_t height = 256, uint32_t attributes = 0);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  TestTexture& add_target(rtapi::Format format, uint32_t slices = 1);
  TestTexture& add_depth(rtapi::Format format, uint32_t slices = 1);
  // Columns that the pixel shader gets; returns the first.
  uint32_t add_varying(uint32_t vertex_column, uint32_t components,
                       shader::Interpolation interpolation = shader::Interpolation::kLinear);
  uint32_t add_pixel_input(uint32_t& column, uint32_t components = 1);
  // The pixel shader: columns are those of add_varying() and add_pixel_input(), and four for each
  // target. Without a call of this the draw has none.
  void shade(std::function<void(shader::PixelLanes&)> pixel, uint32_t flags = 0);
  // Every target gets these four values.
  void shade_constant(float r, float g, float b, float a);
  // Target 0 gets consecutive pixel columns, the first `components` of them.
  void shade_columns(uint32_t column, uint32_t components);
  uint32_t depth_output();  // makes the pixel shader write SV_Depth; returns its column

  // Appends a vertex; returns its number. Coordinates of vertex_px are pixels of the target.
  uint32_t vertex(float x, float y, float z, float w, std::vector<float> attributes = {});
  uint32_t vertex_px(float x, float y, float z = 0.5f, std::vector<float> attributes = {});
  void triangle_px(float x0, float y0, float x1, float y1, float x2, float y2, float z = 0.5f);
  void quad_px(float left, float top, float right, float bottom, float z = 0.5f);  // two triangles
  void quad(float left, float top, float right, float bottom, float z, float w = 1);
  void clear_vertices() { floats.clear(); }
  void set_indices(std::vector<uint32_t> values, bool sixteen_bits = false);

  Targets targets();
  Draw draw();  // of all vertices or indices
  TestWorkers workers(uint32_t threads);
  void run(uint32_t threads = 1, const RasterizerOptions& options = {});

  uint32_t width, height, columns;
  runtime::LinkedGraphics linked;
  runtime::DrawState state;
  std::vector<float> floats;
  std::vector<uint8_t> index_bytes;
  uint32_t index_count = 0;  // 0: not indexed
  uint32_t instances = 1;
  // Called after the pass-through.
  std::function<void(const shader::VertexLanes&)> more_vertex;
  std::vector<std::unique_ptr<TestTexture>> color;  // null: a gap
  std::unique_ptr<TestTexture> depth;

  shader::GraphicsDesc vertex_desc{};
  shader::GraphicsDesc pixel_desc{};
  shader::ExportDesc vertex_code{};
  shader::ExportDesc pixel_code{};
  std::function<void(shader::PixelLanes&)> pixel;
};

// Counts the texels that hold another float.
uint32_t texels_other_than(TestTexture& texture, float expected);

}  // namespace kaamos::raster::testing
