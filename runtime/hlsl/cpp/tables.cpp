// SPDX-License-Identifier: MIT
//
// The tables of a library: what a backend can read from it without running it.
// [kaamos/shader/abi.h]
#include "runtime/hlsl/analysis/read_attributes.h"
#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/cpp/emitter.h"
#include "runtime/hlsl/ir/payload_layout.h"
#include "runtime/hlsl/ir/texture_shape.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

const char* stage_name(uint32_t stage) {
  switch (stage) {
    case kStageRayGeneration:
      return "kRayGeneration";
    case kStageIntersection:
      return "kIntersection";
    case kStageAnyHit:
      return "kAnyHit";
    case kStageClosestHit:
      return "kClosestHit";
    case kStageMiss:
      return "kMiss";
    case kStageCallable:
      return "kCallable";
    case kStageCompute:
      return "kCompute";
    case kStageVertex:
      return "kVertex";
    case kStageGeometry:
      return "kGeometry";
    case kStagePixel:
      return "kPixel";
    default:
      return "kLibrary";
  }
}

const char* binding_type(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::kConstantBuffer:
      return "kConstantBuffer";
    case ResourceKind::kByteAddressBuffer:
    case ResourceKind::kRWByteAddressBuffer:
      return "kRawBuffer";
    case ResourceKind::kStructuredBuffer:
    case ResourceKind::kRWStructuredBuffer:
      return "kStructuredBuffer";
    case ResourceKind::kTextureBuffer:
    case ResourceKind::kBuffer:
    case ResourceKind::kRWBuffer:
      return "kTypedBuffer";
    case ResourceKind::kSampler:
      return "kSampler";
    case ResourceKind::kSamplerComparison:
      return "kComparisonSampler";
    case ResourceKind::kAccelerationStructure:
      return "kAccelerationStructure";
    default:
      return "kTexture";
  }
}

const char* register_class_name(uint8_t register_class) {
  constexpr const char* kNames[] = {"kShaderResource", "kUnorderedAccess", "kConstantBuffer",
                                    "kSampler"};
  return kNames[register_class & 3];
}

}  // namespace

void CppEmitter::emit_calls(size_t index, const ReachedCalls& calls) {
  const auto number = [](uint32_t n) { return std::to_string(n) + "u"; };
  std::string traces;
  for (const shader::TraceCall& t : calls.traces) {
    traces += "{" + number(t.known) + ", " + number(t.binding) + ", " + number(t.ray_flags) + ", " +
              number(t.mask) + ", " + number(t.ray_contribution) + ", " + number(t.multiplier) +
              ", " + number(t.miss_index) + ", " + number(t.line) + ", " + quote(t.file) + "}, ";
  }
  line("static const ks::TraceCall traces_" + std::to_string(index) + "[] = {" + traces + "{}};");
  std::string callables;
  for (const uint32_t n : calls.callables) callables += number(n) + ", ";
  line("static const uint32_t callables_" + std::to_string(index) + "[] = {" + callables + "0u};");
}

std::string CppEmitter::emit_list(const std::string& name, const std::vector<uint32_t>& list) {
  std::string text = "static const uint32_t " + name + "[] = {";
  for (const uint32_t n : list) text += std::to_string(n) + "u, ";
  line(text + "0u};");
  return name + ", " + std::to_string(list.size()) + "u";
}

// Entry points without code: what is known of them before they are linked.
void CppEmitter::emit_unlinked(const EntryPoint& e, const std::string& bindings,
                               const std::string& imports) {
  const auto number = [](uint64_t n) { return std::to_string(n) + "u"; };
  const bool callable = e.stage == kStageCallable;
  const std::string storage = e.payload != nullptr ? "sizeof(" + type(e.payload) + ")" : "0u";
  line("{" + quote(e.name) + ", " + quote(e.function->mangled) +
       ", ks::Stage::" + stage_name(e.stage) + ", nullptr, nullptr, " +
       number(callable ? 0 : e.payload_bytes) + ", " + storage + ", " + number(e.attribute_bytes) +
       ", " + number(callable ? e.payload_bytes : 0) + ", 0u, " +
       number(e.unbounded_payload ? 64u : 0u) + ", " + bindings +
       ", nullptr, 0u, nullptr, 0u, nullptr, 0u, " + quote(value_layout(e.payload)) + ", " +
       quote(value_layout(e.attributes)) + ", " + number(e.attribute_type) + ", nullptr, " +
       (e.root_signature ? quote(*e.root_signature) : "nullptr") + ", nullptr, " + imports + "},");
}

void CppEmitter::emit_coverage() {
  const auto number = [](uint64_t n) { return std::to_string(n) + "u"; };
  open("static const ks::CoveragePoint points[] = {");
  for (const CoveragePoint& point : module_.coverage) {
    line("{" + number(point.location.file) + ", " + number(point.location.line) + ", " +
         number(point.location.column) + ", " + number(point.arm) + "},");
  }
  line("};");
  --indent_;
  line("static const ks::CoverageDesc coverage = {files, " + number(module_.files.size()) +
       ", points, " + number(module_.coverage.size()) + ", covered};");
}

void CppEmitter::emit_tables() {
  const auto number = [](uint64_t n) { return std::to_string(n) + "u"; };
  open("static const ks::BindingDesc bindings[] = {");
  for (const Binding& b : module_.bindings) {
    line("{" + quote(b.name) + ", ks::RegisterClass::" + register_class_name(b.register_class) +
         ", ks::BindingType::" + binding_type(b.type->resource) + ", " + number(b.register_index) +
         ", " + number(b.space) + ", " + number(b.count) + ", " +
         number(b.size_bytes + texture_shape(*b.type)) + ", " + (b.automatic ? "true" : "false") +
         "},");
  }
  line("{}};");
  --indent_;
  for (size_t i = 0; i < module_.entry_points.size(); ++i) {
    std::string list = "static const uint32_t bindings_" + std::to_string(i) + "[] = {";
    for (const uint32_t binding : module_.entry_points[i].bindings) {
      list += number(binding) + ", ";
    }
    line(list + "0u};");
  }
  std::vector<std::pair<std::string, std::string>> unlinked;
  for (const EntryPoint& e : module_.unlinked_entry_points) {
    const std::string n = std::to_string(unlinked.size());
    const std::string bindings = emit_list("unlinked_bindings_" + n, e.bindings);
    unlinked.emplace_back(bindings, emit_list("unlinked_imports_" + n, e.imports));
  }
  for (size_t i = 0; i < options_.spirv.size(); ++i) {
    if (options_.spirv[i].empty()) continue;
    out_ += "static const uint32_t spirv_" + std::to_string(i) + "[] = {";
    for (const uint32_t word : options_.spirv[i]) {
      out_ += std::to_string(word);
      out_ += ',';
    }
    out_ += "};\n";
  }
  std::vector<ReachedCalls> calls;
  for (size_t i = 0; i < module_.entry_points.size(); ++i) {
    calls.push_back(collect_calls(module_, module_.entry_points[i]));
    emit_calls(i, calls.back());
  }
  for (size_t i = 0; i < module_.library_functions.size(); ++i) {
    std::string list;
    for (const uint32_t caller : module_.library_functions[i].callers)
      list += number(caller) + ", ";
    line("static const uint32_t callers_" + std::to_string(i) + "[] = {" + list + "0u};");
    emit_list("needed_" + std::to_string(i), module_.library_functions[i].imports);
  }
  open("static const ks::ExportDesc exports[] = {");
  for (size_t i = 0; i < module_.entry_points.size(); ++i) {
    const EntryPoint& e = module_.entry_points[i];
    const std::string n = std::to_string(i);
    const bool compute = e.stage == kStageCompute;
    const bool callable = e.stage == kStageCallable;
    const std::string storage = e.payload != nullptr ? "sizeof(" + type(e.payload) + ")" : "0u";
    uint32_t flags = (e.function->may_trace ? 1u : 0u) | (e.function->uses_query ? 32u : 0u) |
                     (e.function->uses_hit_object ? 512u : 0u) | (e.function->may_call ? 2u : 0u) |
                     (e.uses_view_heap ? 4u : 0u) | (e.uses_sampler_heap ? 8u : 0u) |
                     (hit_kind_readers_.count(e.function) != 0 ? 16u : 0u) |
                     (e.unbounded_payload ? 64u : 0u) | (reads_bound_ && !compute ? 128u : 0u) |
                     (e.attributes != nullptr && !reads_attributes(e) ? 256u : 0u);
    line("{" + quote(e.name) + ", " + quote(e.function->mangled) +
         ", ks::Stage::" + stage_name(e.stage) + ", " +
         (compute || e.is_graphics() ? "nullptr" : "reinterpret_cast<ks::AnyFn>(entry_" + n + ")") +
         ", " + (compute ? "&compute_" + n : "nullptr") + ", " +
         number(callable ? 0 : e.payload_bytes) + ", " + storage + ", " +
         number(e.attribute_bytes) + ", " + number(callable ? e.payload_bytes : 0) + ", " +
         number(stack_[e.function]) + ", " + number(flags) + ", bindings_" + n + ", " +
         number(e.bindings.size()) +
         (i < options_.spirv.size() && !options_.spirv[i].empty()
              ? ", spirv_" + n + ", " + number(options_.spirv[i].size())
              : ", nullptr, 0u") +
         ", traces_" + n + ", " + number(calls[i].traces.size()) + ", callables_" + n + ", " +
         number(calls[i].callables.size()) + ", " + quote(value_layout(e.payload)) + ", " +
         quote(value_layout(e.attributes)) + ", " + number(e.attribute_type) +
         (has_row_[i] ? ", row_" + n : ", nullptr") +
         (e.root_signature ? ", " + quote(*e.root_signature) : ", nullptr") +
         (e.is_graphics() ? ", &graphics_" + n : "") + "},");
  }
  for (size_t i = 0; i < unlinked.size(); ++i) {
    emit_unlinked(module_.unlinked_entry_points[i], unlinked[i].first, unlinked[i].second);
  }
  for (size_t i = 0; i < module_.library_functions.size(); ++i) {
    const LibraryFunction& f = module_.library_functions[i];
    line("{" + quote(f.name) + ", " + quote(f.mangled) +
         ", ks::Stage::kLibrary, nullptr, nullptr, 0u, 0u, 0u, 0u, 0u, 0u, nullptr, 0u, nullptr, "
         "0u, "
         "nullptr, 0u, callers_" +
         std::to_string(i) + ", " + number(f.callers.size()) +
         ", nullptr, nullptr, 0u, nullptr, nullptr, nullptr, needed_" + std::to_string(i) + ", " +
         number(f.imports.size()) + ", " + quote(f.signature) + "},");
  }
  line("{}};");
  --indent_;
  open("static const ks::SubobjectDesc subobjects[] = {");
  for (const Subobject& s : module_.subobjects) {
    const auto text = [&](size_t i) {
      return i < s.strings.size() ? quote(s.strings[i]) : std::string("nullptr");
    };
    const auto n = [&](size_t i) { return number(i < s.values.size() ? s.values[i] : 0); };
    line("{" + quote(s.name) + ", " + number(s.type) + ", {" + text(0) + ", " + text(1) + ", " +
         text(2) + "}, {" + n(0) + ", " + n(1) + "}},");
  }
  line("{}};");
  --indent_;
  open("static const ks::ImportDesc imports[] = {");
  for (const Import& import : module_.imports) {
    line("{" + quote(import.name) + ", " + quote(import.mangled) + ", " + quote(import.signature) +
         "},");
  }
  line("{}};");
  --indent_;
  open("static const ks::PrintDesc prints[] = {");
  for (const Print& print : module_.prints) {
    line("{" + number(print.id) + "ll, " + quote(print.format) + ", " + quote(print.arguments) +
         ", " + (print.is_error ? "true" : "false") + "},");
  }
  line("{}};");
  --indent_;
  std::string files = "static const char* const files[] = {";
  for (const std::string& file : module_.files) files += quote(file) + ", ";
  line(files + "nullptr};");
  if (!module_.source.empty()) out_ += source_table(module_);
  line("static const ks::LibraryDesc library = {ks::kAbiVersion, sizeof(ks::LibraryDesc), " +
       quote(module_.name) + ", " + quote(module_.target) + ", exports, " +
       number(module_.entry_points.size() + unlinked.size() + module_.library_functions.size()) +
       ", bindings, " + number(module_.bindings.size()) + ", subobjects, " +
       number(module_.subobjects.size()) + ", " +
       number(options_.flags | (module_.check_access ? 1u : 0u)) + ", files, " +
       number(module_.files.size()) + ", " +
       (module_.source.empty() ? "nullptr, 0u" : "source, sizeof(source) - 1") + ", imports, " +
       number(module_.imports.size()) + ", prints, " + number(module_.prints.size()) + "};");
}

}  // namespace kaamos::hlsl
