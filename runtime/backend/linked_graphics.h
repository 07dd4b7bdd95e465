// SPDX-License-Identifier: MIT
//
// A graphics pipeline as linking leaves it: which element of a vertex buffer feeds which input,
// which output of the vertex shader which input of the pixel shader. Immutable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <kaamos/shader/graphics.h>
#include <rtapi/graphics_pipeline.h>

#include "runtime/backend/linked_pipeline.h"

namespace kaamos::runtime {

inline constexpr uint32_t kNoColumn = 0xFFFFFFFFu;

// An input of the vertex shader that a vertex buffer feeds.
struct LinkedElement {
  uint32_t slot = 0;
  uint32_t offset_bytes = 0;  // from the start of a vertex
  rtapi::Format format = rtapi::Format::kUnknown;
  bool per_instance = false;
  uint32_t step_rate = 0;     // per instance; 0: all use the first element
  uint32_t first_column = 0;  // of the vertex shader's inputs
  uint8_t components = 0;
};

// Columns of the pixel shader that columns of the last shader before it feed.
struct LinkedVarying {
  uint32_t vertex_column = 0;  // of the outputs of LinkedGraphics::vertices_desc()
  uint32_t pixel_column = 0;   // of the pixel shader's inputs
  uint8_t components = 0;
  shader::Interpolation interpolation = shader::Interpolation::kLinear;
};

// Columns of the geometry shader's inputs that columns of the vertex shader feed.
struct LinkedCorner {
  uint32_t vertex_column = 0;
  uint32_t geometry_column = 0;
  uint8_t components = 0;
};

// First columns of what the pipeline itself reads or writes; kNoColumn: the shader does not have
// it. Out: of the vertex shader, or of the geometry shader if there is one.
struct VertexSystemColumns {
  uint32_t vertex_id = kNoColumn;             // in
  uint32_t instance_id = kNoColumn;           // in
  uint32_t start_vertex = kNoColumn;          // in
  uint32_t start_instance = kNoColumn;        // in
  uint32_t position = kNoColumn;              // out
  uint32_t target_array_index = kNoColumn;    // out
  uint32_t viewport_array_index = kNoColumn;  // out
  std::vector<uint32_t> clip_distances;       // out: a column each
  std::vector<uint32_t> cull_distances;       // out: a column each
  uint32_t primitive_id = kNoColumn;          // out, of a geometry shader
};
// First columns of a geometry shader's inputs.
struct GeometrySystemColumns {
  uint32_t primitive_id = kNoColumn;
  uint32_t instance = kNoColumn;
};
struct PixelSystemColumns {
  uint32_t position = kNoColumn;       // in, 4 columns, by the components below
  uint32_t primitive_id = kNoColumn;   // in
  uint32_t is_front_face = kNoColumn;  // in
  uint32_t barycentrics = kNoColumn;   // in, 3 columns or fewer
  uint32_t coverage_in = kNoColumn;
  uint32_t coverage_out = kNoColumn;
  uint32_t sample_index = kNoColumn;  // in
  uint32_t sample_count = kNoColumn;  // in
  bool barycentrics_no_perspective = false;
  shader::Interpolation position_place = shader::Interpolation::kLinear;  // where in the pixel
  shader::Interpolation barycentrics_place = shader::Interpolation::kLinear;
  uint8_t position_components = 0;
  uint8_t barycentric_components = 0;
  uint32_t depth = kNoColumn;  // out
  struct Target {
    uint32_t first_column = kNoColumn;
    uint8_t components = 0;
  };
  Target targets[rtapi::kSimultaneousRenderTargetCount];  // out
};

struct LinkedGraphics {
  std::string name;
  LinkedShader vertex;
  LinkedShader geometry;  // code is null: none
  LinkedShader pixel;     // code is null: none
  VertexSystemColumns vertex_columns;
  GeometrySystemColumns geometry_columns;
  PixelSystemColumns pixel_columns;
  std::vector<LinkedElement> elements;
  std::vector<LinkedCorner> corners;
  std::vector<LinkedVarying> varyings;
  // Fixed state, checked. One blend desc for each target, whatever IndependentBlendEnable was.
  rtapi::RenderTargetBlendDesc blend[rtapi::kSimultaneousRenderTargetCount];
  bool blends_two_sources = false;  // SV_Target1 is the second source of target 0
  rtapi::PrimitiveTopologyType topology = rtapi::PrimitiveTopologyType::kTriangle;
  rtapi::RasterizerDesc rasterizer;
  rtapi::DepthStencilDesc depth_stencil;
  uint32_t sample_mask = 0xFFFFFFFFu;
  uint32_t samples = 1;
  bool alpha_to_coverage = false;
  rtapi::IndexBufferStripCutValue strip_cut = rtapi::IndexBufferStripCutValue::kDisabled;
  rtapi::Format target_formats[rtapi::kSimultaneousRenderTargetCount] = {};
  uint32_t target_count = 0;
  rtapi::Format depth_format = rtapi::Format::kUnknown;

  bool has_pixel() const { return pixel.code != nullptr; }
  bool has_geometry() const { return geometry.code != nullptr; }
  const shader::GraphicsDesc& vertex_desc() const { return *vertex.code->graphics; }
  const shader::GraphicsDesc& geometry_desc() const { return *geometry.code->graphics; }
  // Those that there are. Backends number them in this order.
  std::vector<const LinkedShader*> shaders() const {
    std::vector<const LinkedShader*> out = {&vertex};
    if (has_pixel()) out.push_back(&pixel);
    if (has_geometry()) out.push_back(&geometry);
    return out;
  }
  // The last shader before the rasterizer, whose vertices it takes.
  const LinkedShader& vertices() const { return has_geometry() ? geometry : vertex; }
  const shader::GraphicsDesc& vertices_desc() const { return *vertices().code->graphics; }
  // What is drawn.
  rtapi::PrimitiveTopologyType drawn() const {
    constexpr rtapi::PrimitiveTopologyType kTypes[] = {rtapi::PrimitiveTopologyType::kPoint,
                                                       rtapi::PrimitiveTopologyType::kLine,
                                                       rtapi::PrimitiveTopologyType::kTriangle};
    return has_geometry() ? kTypes[geometry_desc().shape.output_corners - 1] : topology;
  }
  const shader::GraphicsDesc& pixel_desc() const { return *pixel.code->graphics; }
};

}  // namespace kaamos::runtime
