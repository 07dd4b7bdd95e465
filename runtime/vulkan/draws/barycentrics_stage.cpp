// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/barycentrics_stage.h"

#include <algorithm>
#include <bit>

#include "runtime/vulkan/draws/stage_linkage.h"
#include "runtime/vulkan/spirv/spirv_writer.h"

namespace kaamos::vulkan {
namespace {

using W = SpirvWriter;
using shader::SystemValue;

constexpr uint32_t kGeometryModel = 3;
constexpr uint32_t kCorners = 3;
enum BuiltIn : uint32_t {
  kPosition = 0,
  kClipDistance = 3,
  kCullDistance = 4,
  kPrimitiveId = 7,
  kLayer = 9,
  kViewportIndex = 10,
};
enum Capability : uint32_t {
  kGeometry = 2,
  kClipDistances = 32,
  kCullDistances = 33,
  kMultiViewport = 57,
};
enum ExecutionMode : uint32_t {
  kInvocations = 0,
  kTriangles = 22,
  kOutputVertices = 26,
  kOutputTriangleStrip = 29,
};

class Writer {
 public:
  explicit Writer(const runtime::LinkedGraphics& linked) : linked_(linked) {}
  std::vector<uint32_t> write();

 private:
  // An input of three, and the output that takes one after the other.
  struct Passed {
    uint32_t type = 0;
    uint32_t input = 0;
    uint32_t output = 0;
  };

  uint32_t real() { return w_.global(W::kTypeFloat, {32}); }
  uint32_t integer() { return w_.global(W::kTypeInt, {32, 1}); }
  uint32_t natural() { return w_.global(W::kTypeInt, {32, 0}); }
  uint32_t number(uint32_t value) { return w_.typed_global(W::kConstant, natural(), {value}); }
  uint32_t vector(uint32_t scalar, uint32_t components) {
    return components == 1 ? scalar : w_.global(W::kTypeVector, {scalar, components});
  }
  uint32_t array(uint32_t element, uint32_t count) {
    return w_.global(W::kTypeArray, {element, number(count)});
  }
  uint32_t type_of(const shader::SignatureElement& element);
  Passed pass(uint32_t type, W::Decoration decoration, uint32_t value);
  uint32_t load_corner(const Passed& passed, uint32_t corner);
  void add_index(SystemValue value, BuiltIn built_in, uint32_t limit);
  void emit_corner(uint32_t corner);
  bool is_read(uint32_t output) const;

  const runtime::LinkedGraphics& linked_;
  SpirvWriter w_;
  std::vector<Passed> passed_;
  // An index out of range is 0.
  struct Index {
    Passed written;
    uint32_t built_in = 0;
    uint32_t limit = 0;
  };
  std::vector<Index> indices_;
  // One corner's value for all.
  struct Shared {
    Passed from;
    uint32_t corner = 0;
    uint32_t output = 0;
  };
  std::vector<Shared> shared_;
  uint32_t primitive_in_ = 0, primitive_out_ = 0, barycentrics_ = 0;
};

uint32_t Writer::type_of(const shader::SignatureElement& element) {
  const uint32_t scalar = element.type == shader::ColumnType::kFloat ? real()
                          : element.type == shader::ColumnType::kInt ? integer()
                                                                     : natural();
  return vector(scalar, element.components);
}

Writer::Passed Writer::pass(uint32_t type, W::Decoration decoration, uint32_t value) {
  const Passed passed = {type, w_.variable(W::kInput, array(type, kCorners)),
                         w_.variable(W::kOutput, type)};
  w_.decorate(passed.input, decoration, value);
  w_.decorate(passed.output, decoration, value);
  return passed;
}

uint32_t Writer::load_corner(const Passed& passed, uint32_t corner) {
  const uint32_t pointer = w_.global(W::kTypePointer, {W::kInput, passed.type});
  const uint32_t place = w_.compute(W::kAccessChain, pointer, {passed.input, number(corner)});
  return w_.compute(W::kLoad, passed.type, {place});
}

bool Writer::is_read(uint32_t output) const {
  const uint32_t column = linked_.vertex_desc().outputs[output].first_column;
  return std::any_of(linked_.varyings.begin(), linked_.varyings.end(),
                     [&](const runtime::LinkedVarying& v) { return v.vertex_column == column; });
}

// The vertex shader has written the index to a location, too.
void Writer::add_index(SystemValue value, BuiltIn built_in, uint32_t limit) {
  const shader::GraphicsDesc& vertex = linked_.vertex_desc();
  for (uint32_t i = 0; i < vertex.output_count; ++i) {
    if (vertex.outputs[i].system_value != value) continue;
    Index index;
    index.written = pass(type_of(vertex.outputs[i]), W::kLocation, i);
    index.built_in = w_.variable(W::kOutput, integer());
    index.limit = limit;
    w_.decorate(index.built_in, W::kBuiltIn, built_in);
    indices_.push_back(index);
  }
}

void Writer::emit_corner(uint32_t corner) {
  for (const Passed& passed : passed_) {
    w_.run(W::kStore, {passed.output, load_corner(passed, corner)});
  }
  for (const Shared& shared : shared_) {
    w_.run(W::kStore, {shared.output, load_corner(shared.from, shared.corner)});
  }
  for (const Index& index : indices_) {
    const uint32_t value = load_corner(index.written, corner);
    w_.run(W::kStore, {index.written.output, value});
    const uint32_t bits =
        index.written.type == natural() ? value : w_.compute(W::kBitcast, natural(), {value});
    const uint32_t inside =
        w_.compute(W::kULessThan, w_.global(W::kTypeBool, {}), {bits, index.limit});
    const uint32_t chosen = w_.compute(W::kSelect, natural(), {inside, bits, number(0)});
    w_.run(W::kStore, {index.built_in, w_.compute(W::kBitcast, integer(), {chosen})});
  }
  w_.run(W::kStore, {primitive_out_, w_.compute(W::kLoad, integer(), {primitive_in_})});
  const uint32_t zero = w_.typed_global(W::kConstant, real(), {0});
  const uint32_t one = w_.typed_global(W::kConstant, real(), {std::bit_cast<uint32_t>(1.0f)});
  w_.run(W::kStore,
         {barycentrics_, w_.typed_global(W::kConstantComposite, vector(real(), 3),
                                         {corner == 0 ? one : zero, corner == 1 ? one : zero,
                                          corner == 2 ? one : zero})});
  w_.run(W::kEmitVertex, {});
}

std::vector<uint32_t> Writer::write() {
  const runtime::VertexSystemColumns& columns = linked_.vertex_columns;
  w_.capability(kGeometry);
  w_.mode(kTriangles, {});
  w_.mode(kInvocations, {1});
  w_.mode(kOutputTriangleStrip, {});
  w_.mode(kOutputVertices, {kCorners});
  passed_.push_back(pass(vector(real(), 4), W::kBuiltIn, kPosition));
  const auto pass_distances = [&](size_t count, Capability capability, BuiltIn built_in) {
    if (count == 0) return;
    w_.capability(capability);
    passed_.push_back(pass(array(real(), static_cast<uint32_t>(count)), W::kBuiltIn, built_in));
  };
  pass_distances(columns.clip_distances.size(), kClipDistances, kClipDistance);
  pass_distances(columns.cull_distances.size(), kCullDistances, kCullDistance);
  const shader::GraphicsDesc& vertex = linked_.vertex_desc();
  for (uint32_t i = 0; i < vertex.output_count; ++i) {
    const SystemValue value = vertex.outputs[i].system_value;
    const bool index =
        value == SystemValue::kRenderTargetArrayIndex || value == SystemValue::kViewportArrayIndex;
    if (value == SystemValue::kPosition || index || !is_read(i)) continue;
    passed_.push_back(pass(type_of(vertex.outputs[i]), W::kLocation, i));
    for (const VertexAttribute& attribute : vertex_attributes(linked_)) {
      if (attribute.output != i) continue;
      const Passed& from = passed_.back();
      shared_.push_back({from, attribute.vertex, w_.variable(W::kOutput, from.type)});
      w_.decorate(shared_.back().output, W::kLocation, attribute.location);
    }
  }
  add_index(SystemValue::kRenderTargetArrayIndex, kLayer, w_.spec_constant(natural(), 0, 1));
  if (columns.viewport_array_index != runtime::kNoColumn) w_.capability(kMultiViewport);
  add_index(SystemValue::kViewportArrayIndex, kViewportIndex,
            number(rtapi::kViewportAndScissorRectCount));
  primitive_in_ = w_.variable(W::kInput, integer());
  primitive_out_ = w_.variable(W::kOutput, integer());
  w_.decorate(primitive_in_, W::kBuiltIn, kPrimitiveId);
  w_.decorate(primitive_out_, W::kBuiltIn, kPrimitiveId);
  barycentrics_ = w_.variable(W::kOutput, vector(real(), 3));
  w_.decorate(barycentrics_, W::kLocation, barycentrics_location(linked_));
  for (uint32_t corner = 0; corner < kCorners; ++corner) emit_corner(corner);
  w_.run(W::kEndPrimitive, {});
  return w_.module(kGeometryModel);
}

}  // namespace

std::vector<uint32_t> barycentrics_code(const runtime::LinkedGraphics& linked) {
  return Writer(linked).write();
}

}  // namespace kaamos::vulkan
