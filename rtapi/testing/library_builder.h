// SPDX-License-Identifier: MIT
//
// Shader libraries written by hand, so that linking can be tested without a compiler. The entry
// points do nothing and are never called.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/shader_library.h>

namespace rtapi::testing {

namespace shader = kaamos::shader;

// Must outlive the libraries made from it.
class LibraryBuilder {
 public:
  explicit LibraryBuilder(std::string name = "test.hlsl", std::string target = "lib_6_6")
      : name_(std::move(name)), target_(std::move(target)) {}

  // Returns the binding's index.
  uint32_t Binding(std::string name, shader::BindingType type, uint32_t reg, uint32_t space = 0,
                   uint32_t count = 1, uint32_t size_bytes = 0, bool uav = false) {
    using T = shader::BindingType;
    using C = shader::RegisterClass;
    const C cls = type == T::kConstantBuffer                             ? C::kConstantBuffer
                  : type == T::kSampler || type == T::kComparisonSampler ? C::kSampler
                  : uav                                                  ? C::kUnorderedAccess
                                                                         : C::kShaderResource;
    bindings_.push_back({Keep(std::move(name)), cls, type, reg, space, count, size_bytes, false});
    return static_cast<uint32_t>(bindings_.size() - 1);
  }

  // Mangled as DXC does for a function without overloads: "\x01?name@@YAXXZ".
  shader::ExportDesc& Export(std::string name, shader::Stage stage,
                             std::vector<uint32_t> bindings = {}) {
    shader::ExportDesc e = {};
    e.mangled_name = Keep("\x01?" + name + "@@YAXXZ");
    e.name = Keep(std::move(name));
    e.stage = stage;
    e.stack_bytes = 100;
    if (stage == shader::Stage::kCompute) {
      e.compute = &kKernel;
    } else if (stage == shader::Stage::kVertex || stage == shader::Stage::kPixel) {
      graphics_.push_back({});
      e.graphics = &graphics_.back();
    } else if (stage != shader::Stage::kLibrary) {
      e.entry = [] {};
    }
    used_.push_back(std::move(bindings));
    e.bindings = used_.back().data();
    e.binding_count = static_cast<uint32_t>(used_.back().size());
    exports_.push_back(e);
    return exports_.back();
  }

  // A vertex or pixel shader with these inputs and outputs; columns are assigned in order.
  shader::ExportDesc& GraphicsExport(std::string name, shader::Stage stage,
                                     std::vector<shader::SignatureElement> inputs,
                                     std::vector<shader::SignatureElement> outputs,
                                     std::vector<uint32_t> bindings = {}) {
    shader::ExportDesc& e = Export(std::move(name), stage, std::move(bindings));
    shader::GraphicsDesc& g = graphics_.back();
    const auto keep = [this](std::vector<shader::SignatureElement> elements, uint32_t& columns) {
      for (shader::SignatureElement& element : elements) {
        element.first_column = columns;
        element.file = name_.c_str();
        columns += element.components;
      }
      elements_.push_back(std::move(elements));
      return elements_.back().data();
    };
    g.input_count = static_cast<uint32_t>(inputs.size());
    g.inputs = keep(std::move(inputs), g.input_columns);
    g.output_count = static_cast<uint32_t>(outputs.size());
    g.outputs = keep(std::move(outputs), g.output_columns);
    g.vertex = [](shader::Invocation&, const shader::VertexLanes&) {};
    g.pixel = [](shader::Invocation&, shader::PixelLanes&) {};
    return e;
  }
  // "float3 COLOR1", for GraphicsExport.
  static shader::SignatureElement Element(const char* semantic, uint32_t index, uint8_t components,
                                          shader::ColumnType type = shader::ColumnType::kFloat,
                                          shader::SystemValue value = shader::SystemValue::kNone) {
    shader::SignatureElement e = {};
    e.semantic = semantic;
    e.semantic_index = index;
    e.system_value = value;
    e.type = type;
    e.interpolation = type == shader::ColumnType::kFloat ? shader::Interpolation::kLinear
                                                         : shader::Interpolation::kNoInterpolation;
    e.components = components;
    e.line = 7;
    return e;
  }

  void Subobject(std::string name, uint32_t type, std::vector<std::string> strings,
                 std::vector<uint32_t> values = {}) {
    shader::SubobjectDesc s = {};
    s.name = Keep(std::move(name));
    s.type = type;
    for (size_t i = 0; i < strings.size() && i < 3; ++i) s.strings[i] = Keep(strings[i]);
    for (size_t i = 0; i < values.size() && i < 2; ++i) s.values[i] = values[i];
    subobjects_.push_back(s);
  }

  shader::LibraryDesc Desc() {
    flat_exports_.assign(exports_.begin(), exports_.end());
    shader::LibraryDesc d = {};
    d.abi_version = shader::kAbiVersion;
    d.struct_bytes = sizeof(shader::LibraryDesc);
    d.name = name_.c_str();
    d.target = target_.c_str();
    d.exports = flat_exports_.data();
    d.export_count = static_cast<uint32_t>(flat_exports_.size());
    d.bindings = bindings_.data();
    d.binding_count = static_cast<uint32_t>(bindings_.size());
    d.subobjects = subobjects_.data();
    d.subobject_count = static_cast<uint32_t>(subobjects_.size());
    return d;
  }

  ShaderLibrary Build() {
    desc_ = Desc();
    return LoadShaderLibrary(&desc_).value();
  }

 private:
  static constexpr shader::ComputeDesc kKernel = {
      {8, 8, 1}, 0, [](shader::Invocation&, shader::ComputeGroup&) {}, nullptr};

  const char* Keep(std::string text) {
    strings_.push_back(std::move(text));
    return strings_.back().c_str();
  }

  std::string name_, target_;
  std::deque<std::string> strings_;
  std::deque<std::vector<uint32_t>> used_;
  std::deque<shader::ExportDesc> exports_;
  std::deque<shader::GraphicsDesc> graphics_;
  std::deque<std::vector<shader::SignatureElement>> elements_;
  std::vector<shader::ExportDesc> flat_exports_;
  std::vector<shader::BindingDesc> bindings_;
  std::vector<shader::SubobjectDesc> subobjects_;
  shader::LibraryDesc desc_ = {};
};

}  // namespace rtapi::testing
