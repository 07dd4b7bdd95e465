// SPDX-License-Identifier: MIT
#include "runtime/raster/testing/scene.h"

#include <atomic>
#include <cstring>
#include <thread>

#include "runtime/shader/float_mode.h"

namespace kaamos::raster::testing {
namespace {

constexpr uint8_t kPattern = 0xA5;

uint32_t bytes_of(rtapi::Format format) {
  switch (format) {
    case rtapi::Format::kD16Unorm:
      return 2;
    case rtapi::Format::kD24UnormS8Uint:
    case rtapi::Format::kD32Float:
      return 4;
    case rtapi::Format::kD32FloatS8X24Uint:
      return 8;
    default:
      return rtapi::GetFormatInfo(format).bytes;
  }
}

class TestThread : public ShaderThread {
 public:
  TestThread(const TestWorkers::Vertices& vertices, const TestWorkers::Pixels& pixels)
      : vertices_(vertices), pixels_(pixels) {}
  void vertices(uint32_t draw, const shader::VertexLanes& lanes) override {
    vertices_(draw, lanes);
  }
  void primitive(uint32_t, const shader::GeometryInputs&, shader::GeometryStream&) override {}
  void pixels(uint32_t draw, shader::PixelLanes& lanes) override { pixels_(draw, lanes); }

 private:
  const TestWorkers::Vertices& vertices_;
  const TestWorkers::Pixels& pixels_;
};

}  // namespace

TestTexture::TestTexture(rtapi::Format format_, uint32_t width_, uint32_t height_, uint32_t slices_)
    : format(format_),
      width(width_),
      height(height_),
      slices(slices_),
      texel_bytes_(bytes_of(format_)),
      row_pitch_(uint64_t{width_} * texel_bytes_ + 64),
      bytes_(row_pitch_ * (height_ + 1) * slices_, kPattern) {
  for (uint32_t slice = 0; slice < slices; ++slice) {
    for (uint32_t y = 0; y < height; ++y) {
      std::memset(texel(0, y, slice), 0, size_t{width} * texel_bytes_);
    }
  }
}

Surface TestTexture::surface() {
  return {bytes_.data(), row_pitch_, row_pitch_ * (height + 1), width, height, slices,
          format,        false};
}

uint8_t* TestTexture::texel(uint32_t x, uint32_t y, uint32_t slice) {
  return bytes_.data() + (uint64_t{slice} * (height + 1) + y) * row_pitch_ + x * texel_bytes_;
}

bool TestTexture::padding_is_intact() const {
  for (size_t i = 0; i < bytes_.size(); ++i) {
    const uint64_t row = i / row_pitch_;
    const bool texels = row % (height + 1) < height && i % row_pitch_ < width * texel_bytes_;
    if (!texels && bytes_[i] != kPattern) return false;
  }
  return true;
}

void TestWorkers::run(uint32_t count, Task task, const void* context) {
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    const shader::FloatMode mode;
    TestThread thread(vertices_, pixels_);
    for (uint32_t i = next++; i < count; i = next++) task(context, i, thread);
  };
  std::vector<std::thread> others;
  for (uint32_t i = 1; i < threads_; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

Scene::Scene(uint32_t width_, uint32_t height_, uint32_t attributes)
    : width(width_), height(height_), columns(4 + attributes) {
  linked.name = "test";
  vertex_desc.input_columns = vertex_desc.output_columns = columns;
  vertex_code.graphics = &vertex_desc;
  pixel_code.graphics = &pixel_desc;
  linked.vertex.code = &vertex_code;
  linked.vertex_columns.position = 0;
  linked.rasterizer.CullMode = rtapi::CullMode::kNone;
  linked.depth_stencil.DepthFunc = rtapi::ComparisonFunc::kAlways;
  constexpr rtapi::Format kFormats[] = {rtapi::Format::kR32Float, rtapi::Format::kR32G32Float,
                                        rtapi::Format::kR32G32B32Float,
                                        rtapi::Format::kR32G32B32A32Float};
  for (uint32_t c = 0; c < columns; c += 4) {
    const auto components = static_cast<uint8_t>(columns - c < 4 ? columns - c : 4);
    linked.elements.push_back({0, c * 4, kFormats[components - 1], false, 0, c, components});
  }
  state.viewports[0] = {0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
  state.scissors[0] = {0, 0, 16384, 16384};
  state.viewport_count = state.scissor_count = 1;
  state.topology = rtapi::PrimitiveTopology::kTriangleList;
  state.vertex_buffers[0].StrideInBytes = columns * 4;
}

TestTexture& Scene::add_target(rtapi::Format format, uint32_t slices) {
  color.push_back(std::make_unique<TestTexture>(format, width, height, slices));
  return *color.back();
}

TestTexture& Scene::add_depth(rtapi::Format format, uint32_t slices) {
  depth = std::make_unique<TestTexture>(format, width, height, slices);
  return *depth;
}

uint32_t Scene::add_varying(uint32_t vertex_column, uint32_t components,
                            shader::Interpolation interpolation) {
  const uint32_t column = pixel_desc.input_columns;
  pixel_desc.input_columns += components;
  linked.varyings.push_back(
      {vertex_column, column, static_cast<uint8_t>(components), interpolation});
  return column;
}

uint32_t Scene::add_pixel_input(uint32_t& column, uint32_t components) {
  column = pixel_desc.input_columns;
  pixel_desc.input_columns += components;
  if (&column == &linked.pixel_columns.position) {
    linked.pixel_columns.position_components = static_cast<uint8_t>(components);
  }
  if (&column == &linked.pixel_columns.barycentrics) {
    linked.pixel_columns.barycentric_components = static_cast<uint8_t>(components);
  }
  return column;
}

void Scene::shade(std::function<void(shader::PixelLanes&)> pixel_shader, uint32_t flags) {
  pixel = std::move(pixel_shader);
  linked.pixel.code = &pixel_code;
  pixel_desc.flags = flags;
  for (uint32_t i = 0; i < color.size(); ++i) {
    if (linked.pixel_columns.targets[i].first_column != runtime::kNoColumn) continue;
    linked.pixel_columns.targets[i] = {pixel_desc.output_columns, 4};
    pixel_desc.output_columns += 4;
  }
}

void Scene::shade_constant(float r, float g, float b, float a) {
  shade([this, r, g, b, a](shader::PixelLanes& lanes) {
    const float values[4] = {r, g, b, a};
    for (const auto& target : linked.pixel_columns.targets) {
      if (target.first_column == runtime::kNoColumn) continue;
      for (uint32_t c = 0; c < target.components; ++c) {
        for (uint32_t& lane : lanes.outputs[target.first_column + c]) lane = as_bits(values[c]);
      }
    }
  });
}

void Scene::shade_columns(uint32_t column, uint32_t components) {
  shade([this, column, components](shader::PixelLanes& lanes) {
    const uint32_t first = linked.pixel_columns.targets[0].first_column;
    for (uint32_t c = 0; c < 4; ++c) {
      for (int i = 0; i < shader::kGraphicsLanes; ++i) {
        lanes.outputs[first + c][i] = c < components ? lanes.inputs[column + c][i] : 0;
      }
    }
  });
}

uint32_t Scene::depth_output() {
  linked.pixel_columns.depth = pixel_desc.output_columns++;
  return linked.pixel_columns.depth;
}

uint32_t Scene::vertex(float x, float y, float z, float w, std::vector<float> attributes) {
  const auto number = static_cast<uint32_t>(floats.size() / columns);
  floats.insert(floats.end(), {x, y, z, w});
  attributes.resize(columns - 4);
  floats.insert(floats.end(), attributes.begin(), attributes.end());
  return number;
}

uint32_t Scene::vertex_px(float x, float y, float z, std::vector<float> attributes) {
  const float half_width = static_cast<float>(width) * 0.5f;
  const float half_height = static_cast<float>(height) * 0.5f;
  return vertex(x / half_width - 1, 1 - y / half_height, z, 1, std::move(attributes));
}

void Scene::triangle_px(float x0, float y0, float x1, float y1, float x2, float y2, float z) {
  vertex_px(x0, y0, z);
  vertex_px(x1, y1, z);
  vertex_px(x2, y2, z);
}

void Scene::quad_px(float left, float top, float right, float bottom, float z) {
  triangle_px(left, top, right, top, left, bottom, z);
  triangle_px(left, bottom, right, top, right, bottom, z);
}

void Scene::quad(float left, float top, float right, float bottom, float z, float w) {
  for (const auto& [x, y] : {std::pair{left, top},
                             {right, top},
                             {left, bottom},
                             {left, bottom},
                             {right, top},
                             {right, bottom}}) {
    vertex(x, y, z, w);
  }
}

void Scene::set_indices(std::vector<uint32_t> values, bool sixteen_bits) {
  index_count = static_cast<uint32_t>(values.size());
  state.index_buffer.Format = sixteen_bits ? rtapi::Format::kR16Uint : rtapi::Format::kR32Uint;
  index_bytes.clear();
  for (const uint32_t value : values) {
    for (int byte = 0; byte < (sixteen_bits ? 2 : 4); ++byte) {
      index_bytes.push_back(static_cast<uint8_t>(value >> 8 * byte));
    }
  }
}

Targets Scene::targets() {
  Targets out;
  for (size_t i = 0; i < color.size(); ++i) {
    if (color[i]) out.color[i] = color[i]->surface();
  }
  if (depth) out.depth = depth->surface();
  return out;
}

Draw Scene::draw() {
  Draw out;
  out.linked = &linked;
  out.state = &state;
  out.indexed = index_count != 0;
  out.arguments.IndexCountPerInstance =
      out.indexed ? index_count : static_cast<uint32_t>(floats.size() / columns);
  out.arguments.InstanceCount = instances;
  out.vertex_buffers[0] = {reinterpret_cast<const uint8_t*>(floats.data()), floats.size() * 4};
  out.indices = index_bytes;
  return out;
}

TestWorkers Scene::workers(uint32_t threads) {
  return TestWorkers(
      threads,
      [this](uint32_t, const shader::VertexLanes& lanes) {
        for (uint32_t c = 0; c < vertex_desc.output_columns && c < vertex_desc.input_columns; ++c) {
          std::memcpy(lanes.outputs[c], lanes.inputs[c], sizeof(shader::Column));
        }
        if (more_vertex) more_vertex(lanes);
      },
      [this](uint32_t, shader::PixelLanes& lanes) { pixel(lanes); });
}

void Scene::run(uint32_t threads, const RasterizerOptions& options) {
  Rasterizer rasterizer(options);
  TestWorkers test_workers = workers(threads);
  const Draw one = draw();
  rasterizer.draw(targets(), {&one, 1}, test_workers);
}

uint32_t texels_other_than(TestTexture& texture, float expected) {
  return texture.width * texture.height * texture.slices - texture.count(expected);
}

}  // namespace kaamos::raster::testing
