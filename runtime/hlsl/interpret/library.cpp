// SPDX-License-Identifier: MIT
//
// The tables of an interpreted library.
#include <kaamos/shader/abi.h>
#include <kaamos/shader/coverage.h>

#include <deque>

#include "runtime/hlsl/analysis/read_attributes.h"
#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/interpret/closure.h"
#include "runtime/hlsl/ir/payload_layout.h"
#include "runtime/hlsl/ir/texture_shape.h"

namespace kaamos::hlsl {

using namespace interpret;

struct InterpretedLibrary::Tables {
  std::unique_ptr<Program> program;
  std::vector<std::unique_ptr<Closure>> closures;
  std::vector<shader::BindingDesc> bindings;
  std::vector<shader::ExportDesc> exports;
  std::vector<shader::SubobjectDesc> subobjects;
  std::vector<shader::ImportDesc> imports;
  std::vector<shader::PrintDesc> prints;
  std::deque<shader::ComputeDesc> compute;
  std::deque<shader::GraphicsDesc> graphics;
  std::deque<std::vector<shader::SignatureElement>> signatures;
  std::deque<std::string> layouts;
  std::deque<ReachedCalls> calls;
  std::vector<const char*> files;
  shader::LibraryDesc library = {};
  std::vector<shader::CoveragePoint> points;
  shader::CoverageDesc coverage = {};
};

namespace {

shader::Stage stage_of(uint32_t stage) {
  switch (stage) {
    case ir::kStageRayGeneration:
      return shader::Stage::kRayGeneration;
    case ir::kStageIntersection:
      return shader::Stage::kIntersection;
    case ir::kStageAnyHit:
      return shader::Stage::kAnyHit;
    case ir::kStageClosestHit:
      return shader::Stage::kClosestHit;
    case ir::kStageMiss:
      return shader::Stage::kMiss;
    case ir::kStageCallable:
      return shader::Stage::kCallable;
    case ir::kStageCompute:
      return shader::Stage::kCompute;
    case ir::kStageVertex:
      return shader::Stage::kVertex;
    case ir::kStageGeometry:
      return shader::Stage::kGeometry;
    case ir::kStagePixel:
      return shader::Stage::kPixel;
    default:
      return shader::Stage::kLibrary;
  }
}

shader::BindingType binding_type_of(ir::ResourceKind kind) {
  switch (kind) {
    case ir::ResourceKind::kConstantBuffer:
      return shader::BindingType::kConstantBuffer;
    case ir::ResourceKind::kByteAddressBuffer:
    case ir::ResourceKind::kRWByteAddressBuffer:
      return shader::BindingType::kRawBuffer;
    case ir::ResourceKind::kStructuredBuffer:
    case ir::ResourceKind::kRWStructuredBuffer:
      return shader::BindingType::kStructuredBuffer;
    case ir::ResourceKind::kTextureBuffer:
    case ir::ResourceKind::kBuffer:
    case ir::ResourceKind::kRWBuffer:
      return shader::BindingType::kTypedBuffer;
    case ir::ResourceKind::kSampler:
      return shader::BindingType::kSampler;
    case ir::ResourceKind::kSamplerComparison:
      return shader::BindingType::kComparisonSampler;
    case ir::ResourceKind::kAccelerationStructure:
      return shader::BindingType::kAccelerationStructure;
    default:
      return shader::BindingType::kTexture;
  }
}

shader::BindingDesc describe(const ir::Binding& b) {
  return {b.name.c_str(),
          static_cast<shader::RegisterClass>(b.register_class & 3),
          binding_type_of(b.type->resource),
          b.register_index,
          b.space,
          b.count,
          b.size_bytes + ir::texture_shape(*b.type),
          b.automatic};
}

shader::SubobjectDesc describe(const ir::Subobject& s) {
  shader::SubobjectDesc out = {};
  out.name = s.name.c_str();
  out.type = s.type;
  for (size_t i = 0; i < 3 && i < s.strings.size(); ++i) out.strings[i] = s.strings[i].c_str();
  for (size_t i = 0; i < 2 && i < s.values.size(); ++i) out.values[i] = s.values[i];
  return out;
}

shader::ComputeDesc describe_compute(const EntryCode& code, uint32_t shared_bytes,
                                     shader::AnyFn function) {
  const ir::EntryPoint& entry = *code.entry;
  shader::ComputeDesc out = {{entry.thread_group[0], entry.thread_group[1], entry.thread_group[2]},
                             shared_bytes,
                             nullptr,
                             nullptr};
  out.has_waves = entry.function->has_waves;
  out.least_wave_lanes = entry.least_wave_lanes;
  out.most_wave_lanes = entry.most_wave_lanes;
  if (entry.function->has_barrier || entry.function->has_waves) {
    out.thread = reinterpret_cast<shader::ComputeThreadFn>(function);
  } else {
    out.group = reinterpret_cast<shader::ComputeGroupFn>(function);
  }
  return out;
}

std::vector<shader::SignatureElement> describe(const std::vector<ir::SignatureElement>& elements,
                                               const ir::Module& module) {
  std::vector<shader::SignatureElement> out;
  for (const ir::SignatureElement& e : elements) {
    const bool placed = e.location.line != 0 && e.location.file < module.files.size();
    out.push_back({e.semantic.c_str(), e.semantic_index, e.system_value, e.type, e.interpolation,
                   e.components, e.first_column,
                   placed ? module.files[e.location.file].c_str() : nullptr, e.location.line});
  }
  return out;
}

uint32_t column_count(const std::vector<shader::SignatureElement>& elements) {
  return elements.empty() ? 0 : elements.back().first_column + elements.back().components;
}

shader::GraphicsDesc describe_graphics(const ir::EntryPoint& entry,
                                       const std::vector<shader::SignatureElement>& inputs,
                                       const std::vector<shader::SignatureElement>& outputs,
                                       shader::AnyFn function) {
  shader::GraphicsDesc out = {};
  out.inputs = inputs.data();
  out.input_count = static_cast<uint32_t>(inputs.size());
  out.input_columns = column_count(inputs);
  out.outputs = outputs.data();
  out.output_count = static_cast<uint32_t>(outputs.size());
  out.output_columns = column_count(outputs);
  out.flags = entry.graphics_flags;
  if (entry.stage == ir::kStageVertex) {
    out.vertex = reinterpret_cast<shader::VertexFn>(function);
  } else if (entry.stage == ir::kStageGeometry) {
    out.geometry = reinterpret_cast<shader::GeometryFn>(function);
    out.shape = entry.geometry;
  } else if (entry.function->has_waves) {
    out.pixel_thread = reinterpret_cast<shader::PixelThreadFn>(function);
  } else {
    out.pixel = reinterpret_cast<shader::PixelFn>(function);
  }
  return out;
}

void set_imports(shader::ExportDesc& out, const std::vector<uint32_t>& imports) {
  out.imports = imports.data();
  out.import_count = static_cast<uint32_t>(imports.size());
}

// Returns what is known of an entry point without its code.
shader::ExportDesc describe(const ir::EntryPoint& entry) {
  const bool callable = entry.stage == ir::kStageCallable;
  shader::ExportDesc out = {};
  out.name = entry.name.c_str();
  out.mangled_name = entry.function->mangled.c_str();
  out.stage = stage_of(entry.stage);
  out.payload_bytes = callable ? 0 : entry.payload_bytes;
  out.attribute_bytes = entry.attribute_bytes;
  out.attribute_type = entry.attribute_type;
  out.callable_data_bytes = callable ? entry.payload_bytes : 0;
  if (entry.unbounded_payload) out.flags |= shader::kExportQualifiedPayload;
  if (entry.root_signature) out.root_signature = entry.root_signature->c_str();
  out.bindings = entry.bindings.data();
  out.binding_count = static_cast<uint32_t>(entry.bindings.size());
  set_imports(out, entry.imports);
  return out;
}

shader::ExportDesc describe(const EntryCode& code) {
  const ir::EntryPoint& entry = *code.entry;
  shader::ExportDesc out = describe(entry);
  out.payload_storage_bytes = code.payload_bytes;
  out.stack_bytes = code.code->stack_bytes + code.static_bytes;
  out.flags |=
      (entry.function->may_trace ? shader::kExportTraces : 0u) |
      (entry.function->uses_query ? shader::kExportUsesRayQuery : 0u) |
      (entry.function->uses_hit_object ? shader::kExportUsesHitObject : 0u) |
      (entry.function->may_call ? shader::kExportCalls : 0u) |
      (entry.uses_view_heap ? shader::kExportUsesViewHeap : 0u) |
      (entry.uses_sampler_heap ? shader::kExportUsesSamplerHeap : 0u) |
      (code.code->reads_hit_kind ? shader::kExportReadsHitKind : 0u) |
      (entry.attributes != nullptr && !reads_attributes(entry) ? shader::kExportIgnoresAttributes
                                                               : 0u);
  return out;
}

}  // namespace

InterpretedLibrary::InterpretedLibrary() : tables_(std::make_unique<Tables>()) {}
InterpretedLibrary::~InterpretedLibrary() = default;

const shader::LibraryDesc& InterpretedLibrary::desc() const {
  return tables_->library;
}
const shader::CoverageDesc* InterpretedLibrary::coverage() const {
  return tables_->points.empty() ? nullptr : &tables_->coverage;
}

Result<std::shared_ptr<const InterpretedLibrary>> InterpretedLibrary::create(
    std::shared_ptr<const ir::Module> module, const InterpretOptions& options) {
  std::shared_ptr<InterpretedLibrary> out(new InterpretedLibrary);
  Tables& tables = *out->tables_;
  const ir::Module& m = *module;
  tables.program = make_program(std::move(module), options);
  if (!tables.program->error.empty()) {
    return Failure{m.name + " cannot be interpreted: " + tables.program->error};
  }
  for (const EntryCode& code : tables.program->entries) {
    auto closure = Closure::create(*tables.program, code);
    if (closure == nullptr) {
      return Failure{
          "the system gives no executable memory for functions made at run time; use a C++ "
          "compiler instead of the interpreter"};
    }
    shader::ExportDesc desc = describe(code);
    if (code.entry->stage == ir::kStageCompute) {
      desc.compute = &tables.compute.emplace_back(
          describe_compute(code, tables.program->shared_bytes, closure->function()));
    } else if (code.entry->is_graphics()) {
      const auto& inputs = tables.signatures.emplace_back(describe(code.entry->inputs, m));
      const auto& outputs = tables.signatures.emplace_back(describe(code.entry->outputs, m));
      desc.graphics = &tables.graphics.emplace_back(
          describe_graphics(*code.entry, inputs, outputs, closure->function()));
    } else {
      desc.entry = closure->function();
    }
    const auto& spirv = tables.program->options.spirv;
    if (const size_t i = tables.exports.size(); i < spirv.size()) {
      desc.spirv = spirv[i].data();
      desc.spirv_words = static_cast<uint32_t>(spirv[i].size());
    }
    const ReachedCalls& calls = tables.calls.emplace_back(collect_calls(m, *code.entry));
    desc.trace_calls = calls.traces.data();
    desc.trace_call_count = static_cast<uint32_t>(calls.traces.size());
    desc.payload_layout = tables.layouts.emplace_back(value_layout(code.entry->payload)).c_str();
    desc.attribute_layout =
        tables.layouts.emplace_back(value_layout(code.entry->attributes)).c_str();
    desc.callable_indices = calls.callables.data();
    desc.callable_index_count = static_cast<uint32_t>(calls.callables.size());
    tables.exports.push_back(desc);
    tables.closures.push_back(std::move(closure));
  }
  for (const ir::EntryPoint& entry : m.unlinked_entry_points) {
    shader::ExportDesc& desc = tables.exports.emplace_back(describe(entry));
    desc.payload_layout = tables.layouts.emplace_back(value_layout(entry.payload)).c_str();
    desc.attribute_layout = tables.layouts.emplace_back(value_layout(entry.attributes)).c_str();
  }
  for (const ir::LibraryFunction& f : m.library_functions) {
    shader::ExportDesc desc = {};
    desc.name = f.name.c_str();
    desc.mangled_name = f.mangled.c_str();
    desc.stage = shader::Stage::kLibrary;
    desc.callable_indices = f.callers.data();
    desc.callable_index_count = static_cast<uint32_t>(f.callers.size());
    desc.signature = f.signature.c_str();
    set_imports(desc, f.imports);
    tables.exports.push_back(desc);
  }
  for (const ir::Binding& b : m.bindings) tables.bindings.push_back(describe(b));
  for (const ir::Subobject& s : m.subobjects) tables.subobjects.push_back(describe(s));
  for (const ir::Print& print : m.prints) {
    tables.prints.push_back(
        {print.id, print.format.c_str(), print.arguments.c_str(), print.is_error});
  }
  for (const ir::Import& import : m.imports) {
    tables.imports.push_back(
        {import.name.c_str(), import.mangled.c_str(), import.signature.c_str()});
  }
  for (const std::string& file : m.files) tables.files.push_back(file.c_str());
  const auto count = [](const auto& list) { return static_cast<uint32_t>(list.size()); };
  tables.library = {shader::kAbiVersion,     sizeof(shader::LibraryDesc), m.name.c_str(),
                    m.target.c_str(),        tables.exports.data(),       count(tables.exports),
                    tables.bindings.data(),  count(tables.bindings),      tables.subobjects.data(),
                    count(tables.subobjects)};
  tables.library.flags =
      shader::kLibraryInterpreted | (m.check_access ? shader::kLibraryChecked : 0u);
  tables.library.files = tables.files.data();
  tables.library.file_count = count(tables.files);
  tables.library.prints = tables.prints.data();
  tables.library.print_count = count(tables.prints);
  tables.library.imports = tables.imports.data();
  tables.library.import_count = count(tables.imports);
  for (const ir::CoveragePoint& point : m.coverage) {
    tables.points.push_back(
        {point.location.file, point.location.line, point.location.column, point.arm});
  }
  tables.coverage = {tables.files.data(), count(tables.files), tables.points.data(),
                     count(tables.points), tables.program->covered.get()};
  if (!m.source.empty()) {
    tables.library.source = m.source.data();
    tables.library.source_bytes = m.source.size();
  }
  return std::shared_ptr<const InterpretedLibrary>(std::move(out));
}

}  // namespace kaamos::hlsl
