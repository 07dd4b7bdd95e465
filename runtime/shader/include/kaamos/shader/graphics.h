// SPDX-License-Identifier: MIT
//
// Vertex, geometry and pixel shaders: what goes into them and comes out, and how they are called.
//
// Every input and output is a column: one 32-bit scalar of kLanes vertices or pixels side by side.
// System values are columns like others. A pixel shader runs two quads of 2 x 2 pixels at a time:
// lanes 0 to 3 are one, (0, 0), (1, 0), (0, 1), (1, 1), lanes 4 to 7 the other.
#pragma once

#include <cstdint>

namespace kaamos::shader {

struct Invocation;
struct ComputeGroup;

inline constexpr int kGraphicsLanes = 8;  // kLanes of abi.h
using Column = uint32_t[kGraphicsLanes];

// Semantics that mean something to the pipeline.
enum class SystemValue : uint8_t {
  kNone,
  kPosition,      // clip space out of a vertex shader, pixels into a pixel shader
  kVertexId,      // vertex shader in
  kInstanceId,    // vertex shader in
  kPrimitiveId,   // geometry shader in and out, pixel shader in
  kIsFrontFace,   // pixel shader in: 0 or 1
  kBarycentrics,  // pixel shader in
  kClipDistance,  // vertex and geometry shader out, pixel shader in; as the next three
  kCullDistance,
  kRenderTargetArrayIndex,
  kViewportArrayIndex,
  kTarget,                 // pixel shader out; semantic_index is the slot
  kDepth,                  // pixel shader out
  kCoverage,               // pixel shader in and out: a bit for each sample
  kStartVertexLocation,    // vertex shader in: of an indexed draw its BaseVertexLocation
  kStartInstanceLocation,  // vertex shader in
  kSampleIndex,            // pixel shader in
  kSampleCount,            // pixel shader in, of no semantic: that of the targets
  kGeometryInstance,       // geometry shader in: SV_GSInstanceID
};

enum class ColumnType : uint8_t { kFloat, kInt, kUint };

// The way in which a pixel shader's input comes from the three vertices.
enum class Interpolation : uint8_t {
  kLinear,         // perspective correct
  kNoPerspective,  // linear on the screen
  kCentroid,       // kLinear, at a place that the triangle covers
  kCentroidNoPerspective,
  kSample,  // kLinear, at the sample: the shader runs once for each
  kSampleNoPerspective,
  kNoInterpolation,  // the bits of the leading vertex
  kSecondVertex,     // the bits of the vertex that SV_Barycentrics.y belongs to
  kThirdVertex,
};
constexpr bool is_at_sample(Interpolation interpolation) {
  return interpolation == Interpolation::kSample ||
         interpolation == Interpolation::kSampleNoPerspective;
}
constexpr bool is_at_centroid(Interpolation interpolation) {
  return interpolation == Interpolation::kCentroid ||
         interpolation == Interpolation::kCentroidNoPerspective;
}
constexpr bool is_no_perspective(Interpolation interpolation) {
  return interpolation == Interpolation::kNoPerspective ||
         interpolation == Interpolation::kCentroidNoPerspective ||
         interpolation == Interpolation::kSampleNoPerspective;
}
constexpr bool is_flat(Interpolation interpolation) {
  return interpolation >= Interpolation::kNoInterpolation;
}

// A scalar or vector that passes into or out of a shader: a row of a matrix and an element of an
// array are one each, with numbers that go up.
struct SignatureElement {
  const char* semantic;     // as written, without the number
  uint32_t semantic_index;  // the number
  SystemValue system_value;
  ColumnType type;
  Interpolation interpolation;  // inputs of pixel shaders
  uint8_t components;           // 1 to 4: columns first_column, first_column + 1, ...
  uint32_t first_column;
  const char* file;  // where it is declared, for messages
  uint32_t line;
};

// Vertices. Lanes that are not active have undefined inputs, and their outputs are not read.
struct VertexLanes {
  const Column* inputs = nullptr;
  Column* outputs = nullptr;
  uint32_t active = 0;  // a bit for each lane
};

// Pixels of one triangle, so that columns that are flat are the same in all lanes. Whole
// quads run: lanes that are in `active` but not in `live` are helpers, which write nothing but what
// derivatives read of them.
struct PixelLanes {
  const Column* inputs = nullptr;
  Column* outputs = nullptr;
  uint32_t active = 0;
  uint32_t live = 0;  // in: covered pixels; out: those of them that were not discarded
};

// The points, lines or triangles that a geometry shader takes and makes. [D3D11.3: 13]
struct GeometryShape {
  uint32_t corners = 0;         // of a primitive that goes in: 1 to 3
  uint32_t output_corners = 0;  // of one that comes out, in strips unless it is 1
  uint32_t most_vertices = 0;   // [maxvertexcount]: 1 to 1024
  uint32_t instances = 1;       // [instance]: 1 to 32 calls for each primitive
};

// The inputs of one primitive: for each corner a row of GraphicsDesc::input_columns words. What is
// not the vertex's own is in the first row.
struct GeometryInputs {
  const uint32_t* rows = nullptr;
  uint32_t columns = 0;
};

// The vertices that a geometry shader emits, a row of GraphicsDesc::output_columns words each.
struct GeometryStream {
  uint32_t* rows = nullptr;  // room for `most` of them
  bool* begins = nullptr;    // whether a vertex is the first of a strip
  uint32_t columns = 0;
  uint32_t most = 0;  // GeometryShape::most_vertices: further ones have no effect
  uint32_t count = 0;
  bool cut = true;  // the next one begins a strip
};

using VertexFn = void (*)(Invocation&, const VertexLanes&);
using GeometryFn = void (*)(Invocation&, const GeometryInputs&, GeometryStream&);
using PixelFn = void (*)(Invocation&, PixelLanes&);
// Runs one lane of a quad on its own fiber: derivatives go through Services::wave, whose wave is
// the quad, of 4 lanes (ComputeGroup::wave_lanes); all active lanes of the quad must run. Clears
// the lane's bit of `live` if it discards.
using PixelThreadFn = void (*)(Invocation&, PixelLanes&, ComputeGroup&, uint32_t lane);

enum GraphicsFlags : uint32_t {
  kGraphicsDiscards = 1,           // can reach discard or clip
  kGraphicsWritesMemory = 2,       // can reach a store or an atomic of an unordered access view
  kGraphicsEarlyDepthStencil = 4,  // [earlydepthstencil]
  kGraphicsReadsQuad = 8,          // can reach a derivative or another operation of a quad
  kGraphicsOrdersPixels = 16,      // has a RasterizerOrdered view
  kGraphicsReadsWave = 32,         // can reach a wave or quad operation other than a derivative
  kGraphicsRunsPerSample = 64,     // reads SV_SampleIndex, or an input at the sample
};

struct GraphicsDesc {
  const SignatureElement* inputs;
  uint32_t input_count;
  uint32_t input_columns;
  const SignatureElement* outputs;
  uint32_t output_count;
  uint32_t output_columns;
  uint32_t flags;                 // GraphicsFlags
  VertexFn vertex;                // vertex shaders
  PixelFn pixel;                  // pixel shaders; null if they run on fibers
  PixelThreadFn pixel_thread;     // null if `pixel` is not
  GeometryFn geometry = nullptr;  // geometry shaders
  GeometryShape shape = {};
};

}  // namespace kaamos::shader
