// SPDX-License-Identifier: MIT
#include "runtime/checks/layer.h"

#include <array>
#include <cstring>
#include <set>
#include <utility>
#include <variant>

#include "runtime/backend/copy_overlap.h"
#include "runtime/backend/indirect.h"
#include "runtime/checks/arguments.h"
#include "runtime/checks/names.h"
#include "runtime/checks/traced_levels.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::checks {
namespace {

using rtapi::HasAny;
using rtapi::ResourceStates;

constexpr size_t kMostProven = 4096;

class Hash {
 public:
  void add(uint64_t value) {
    state_ = (state_ ^ value) * 0x9E3779B97F4A7C15u;
    state_ ^= state_ >> 29;
  }
  void add(const uint8_t* bytes, uint64_t size) {
    uint64_t word = 0;
    for (; size >= 8; size -= 8, bytes += 8) {
      std::memcpy(&word, bytes, 8);
      add(word);
    }
    word = 0;
    std::memcpy(&word, bytes, size);
    add(word);
  }
  uint64_t value() const { return state_; }

 private:
  uint64_t state_ = 0xCBF29CE484222325u;
};

struct NamedTable {
  const char* name;
  rtapi::GpuVirtualAddressRangeAndStride range;
};
std::array<NamedTable, 4> tables_of(const rtapi::DispatchRaysDesc& desc) {
  const auto& first = desc.RayGenerationShaderRecord;
  return {{{"ray generation record", {first.StartAddress, first.SizeInBytes, 0}},
           {"miss table", desc.MissShaderTable},
           {"hit group table", desc.HitGroupTable},
           {"callable table", desc.CallableShaderTable}}};
}

Subresources subresource_of(const runtime::TextureCopyPlace& place) {
  return {place.mip, 1, place.array_element, 1, place.plane, 1};
}

const char* layout_of(const runtime::LinkedShader& shader) {
  const char* layout = shader.code->attribute_layout;
  return layout == nullptr ? "" : layout;
}

}  // namespace

// The creation of a state object already reports sizes that disagree; types that differ but have
// the same size show only here. [DXR: Intersection attributes structure]
void Layer::created(const runtime::LinkedPipeline& pipeline) {
  identifiers_.add(pipeline);
  for (const auto& record : pipeline.records) {
    const runtime::LinkedShader* first = nullptr;
    for (const runtime::LinkedShader* shader :
         {record->intersection, record->any_hit, record->closest_hit}) {
      if (shader == nullptr || shader->code == nullptr || shader->code->attribute_type == 0) {
        continue;
      }
      if (first == nullptr) first = shader;
      if (first->code->attribute_type == shader->code->attribute_type) continue;
      // The creation of the state object warned of it.
      if (first->code->attribute_bytes != shader->code->attribute_bytes) continue;
      const auto with = [](const runtime::LinkedShader& s) {
        const std::string layout = layout_of(s);
        return std::string(stage_name(s.stage)) + " shader " + in_quotes(s.name) +
               (s.code->attribute_type == 1 ? " (reports hits with several types)"
                : layout.empty()            ? ""
                                            : " (" + layout + ")");
      };
      reporter_.report(
          Id::kAttributeMismatch,
          "hit group " + in_quotes(record->name) + ": the attributes of " + with(*first) +
              " and of " + with(*shader) +
              " have different scalars. All shaders of a hit group must use one type.");
      break;
    }
  }
}

void Layer::before(const runtime::Command& command, const std::string& label) {
  labels_.push_back(label);
  reporter_.begin(label);
  hazards_.begin_command(label);
  std::visit([this](const auto& c) { check(c); }, command);
  const bool dispatches = std::holds_alternative<runtime::DispatchRaysCommand>(command) ||
                          std::holds_alternative<runtime::DispatchCommand>(command);
  const bool draws = std::holds_alternative<runtime::DrawCommand>(command);
  if (dispatches || draws) {
    addresses_.set_wrong_views(textures_.before_dispatch(
        dispatches ? ResourceStates::kNonPixelShaderResource : ResourceStates::kAllShaderResource));
  }
}

void Layer::after(const runtime::Command& command, bool succeeded) {
  if (succeeded) std::visit([this](const auto& c) { note(c); }, command);
  instances_.clear();
  contents_.clear();
  missing_.clear();
  reporter_.end();
  // A backend that could not begin the command gets here right away.
  if (!labels_.empty()) labels_.pop_back();
  if (!labels_.empty()) reporter_.begin(labels_.back());
}

bool Layer::needs_memory(const runtime::Command& command) const {
  return needs_memory_after(command) || std::holds_alternative<runtime::DispatchCommand>(command) ||
         std::holds_alternative<runtime::BuildCommand>(command);
}

bool Layer::needs_memory_after(const runtime::Command& command) const {
  return std::holds_alternative<runtime::DispatchRaysCommand>(command) ||
         std::holds_alternative<runtime::ExecuteIndirectCommand>(command) ||
         std::holds_alternative<runtime::DrawCommand>(command);
}

void Layer::keep_tables(const rtapi::DispatchRaysDesc& desc) {
  for (const auto& [name, range] : tables_of(desc)) {
    if (range.SizeInBytes == 0 || !addresses_.contains(range.StartAddress, range.SizeInBytes)) {
      continue;
    }
    Hash hash;
    hash.add(addresses_.host(range.StartAddress), range.SizeInBytes);
    used_tables_.push_back({name, range.StartAddress, range.SizeInBytes, hash.value()});
  }
}

void Layer::hold_tables() {
  if (labels_.size() > 1) return;  // reported with the whole ExecuteIndirect
  for (const UsedTable& table : used_tables_) {
    if (!addresses_.contains(table.address, table.size_bytes)) continue;
    Hash hash;
    hash.add(addresses_.host(table.address), table.size_bytes);
    if (hash.value() == table.hash) continue;
    reporter_.report(Id::kTableWritten,
                     std::string("the ") + table.name + " is " +
                         range_name(addresses_, table.address, table.size_bytes) +
                         ", and these bytes changed while the command ran. Write tables in an "
                         "earlier command, with a barrier between the two.");
  }
  used_tables_.clear();
}

void Layer::check(const runtime::ExecuteIndirectCommand& command) {
  used_tables_.clear();
  hazards_.use(command.arguments->address(), ResourceStates::kIndirectArgument,
               "the buffer of indirect arguments");
  if (command.count != nullptr) {
    hazards_.use(command.count->address(), ResourceStates::kIndirectArgument, "the count");
  }
  draws_.check(command);
  // Mistakes in the arguments are reported when they are used.
  (void)runtime::execute_indirect(
      addresses_, command, label(), [&](const runtime::Command& dispatch, uint32_t) {
        const auto* rays = std::get_if<runtime::DispatchRaysCommand>(&dispatch);
        if (rays != nullptr) keep_tables(rays->desc);
        return rtapi::Status();
      });
}

void Layer::reached(const runtime::Command& command, std::span<const runtime::ReachedFrom> calls) {
  const auto* rays = std::get_if<runtime::DispatchRaysCommand>(&command);
  if (rays == nullptr) {
    for (const runtime::ReachedFrom& each : calls) check_inline_reached(inputs(), each);
    return;
  }
  if (rays->linked == nullptr) return;
  uint64_t all = 0;  // a sum, so that the order does not matter
  for (const auto& [shader, call] : calls) {
    Hash hash;
    hash.add(reinterpret_cast<uintptr_t>(shader));
    hash.add(reinterpret_cast<const uint8_t*>(&call), sizeof(call));
    all += hash.value();
  }
  Hash key;
  key.add(proof_key(*rays));
  key.add(all);
  if (const auto it = proven_.find(key.value()); it != proven_.end()) return check_uses(it->second);
  take(prove_reached(inputs(), *rays, calls), key.value());
}

void Layer::take(ProofResults results, uint64_t key) {
  check_uses(results.uses);
  missing_.insert(missing_.end(), results.missing.begin(), results.missing.end());
  if (!results.good) return;
  if (proven_.size() >= kMostProven) proven_.clear();
  proven_[key] = std::move(results.uses);
}

void Layer::missed(const runtime::Command&, const runtime::MissingRecords& records) {
  for (const MissingRecord& each : missing_) {
    if (!each.reached(records)) continue;
    reporter_.report(each.id, Reporter::key_of(each.text), each.order, [&] { return each.text; });
  }
  std::erase_if(missing_, [&](const MissingRecord& each) { return each.reached(records); });
  // The rest is legal, but may still be a mistake: reported once, with the first one as the
  // example.
  if (missing_.empty()) return;
  const std::string& first = missing_.front().text;
  if (noted_.size() >= kMostProven) noted_.clear();
  if (noted_.insert(Reporter::key_of(first)).second) {
    reporter_.report(Id::kRecordNotReached,
                     std::to_string(missing_.size()) +
                         (missing_.size() == 1 ? " record" : " records") +
                         " that rays or calls could reach, but did not. The first: " + first);
  }
  missing_.clear();
}

uint64_t Layer::proof_key(const runtime::DispatchRaysCommand& command) const {
  Hash hash;
  hash.add(reinterpret_cast<uintptr_t>(command.linked.get()));
  hash.add(reinterpret_cast<uintptr_t>(command.state.root_signature.impl().get()));
  hash.add(structures_.version());
  hash.add(addresses_.version());
  hash.add(command.state.root_arguments->bytes.data(), runtime::kRootArgumentBytes);
  for (const auto& heap : {command.state.view_heap, command.state.sampler_heap}) {
    if (heap == nullptr || heap->host() == nullptr) continue;
    hash.add(heap->address());
    hash.add(heap->host(), heap->size_bytes());
  }
  const rtapi::DispatchRaysDesc& desc = command.desc;
  for (const auto& [name, table] : tables_of(desc)) {
    hash.add(table.StartAddress);
    hash.add(table.SizeInBytes);
    hash.add(table.StrideInBytes);
    if (table.SizeInBytes == 0 || !addresses_.contains(table.StartAddress, table.SizeInBytes)) {
      continue;
    }
    hash.add(addresses_.host(table.StartAddress), table.SizeInBytes);
  }
  return hash.value();
}

void Layer::check(const runtime::DispatchRaysCommand& command) {
  if (command.linked == nullptr) return;
  const auto& desc = command.desc;
  if (labels_.size() == 1) {
    used_tables_.clear();
    keep_tables(desc);
  }
  for (const uint64_t table :
       {desc.RayGenerationShaderRecord.StartAddress, desc.MissShaderTable.StartAddress,
        desc.HitGroupTable.StartAddress, desc.CallableShaderTable.StartAddress}) {
    hazards_.use(table, ResourceStates::kNonPixelShaderResource, "a shader table");
  }
  const uint64_t key = proof_key(command);
  if (const auto it = proven_.find(key); it != proven_.end()) return check_uses(it->second);
  take(prove_tables(inputs(), command), key);
}

void Layer::check_uses(const std::vector<ShaderUse>& uses) {
  std::set<uint64_t> levels;
  for (const ShaderUse& use : uses) {
    if (use.texture) {
      if (use.state == ResourceStates::kUnorderedAccess) {
        draws_.targets().written(textures_.texture_of(use.address));
      }
      textures_.use_view(use.address, use.state, use.what, label());
      continue;
    }
    if (!use.structure) {
      hazards_.use(use.address, use.state, use.what);
      continue;
    }
    if (!levels.insert(use.address).second) continue;
    StructureState state;
    const TrackedStructure* top = structures_.find(use.address, state);
    if (top == nullptr || state != StructureState::kAlive) continue;
    hazards_.read_structure(use.address, top->size_bytes, use.what);
    for (const TrackedInstance& instance : top->instances) {
      if (instance.version == 0 || !levels.insert(instance.bottom_level).second) continue;
      if (const uint64_t bytes = bytes_at(instance.bottom_level)) {
        hazards_.read_structure(instance.bottom_level, bytes,
                                use.what + ", one of its bottom levels,");
      }
    }
  }
}

uint64_t Layer::bytes_at(uint64_t address) const {
  StructureState state;
  const TrackedStructure* structure = structures_.find(address, state);
  return structure != nullptr && state == StructureState::kAlive ? structure->size_bytes : 0;
}

void Layer::check(const runtime::DispatchCommand& command) {
  if (command.linked == nullptr) return;
  const runtime::LinkedShader& shader = command.linked->shader;
  Arguments arguments;
  arguments.global = command.state.root_arguments->bytes.data();
  arguments.state = &command.state;
  const std::string where = "compute shader " + in_quotes(shader.name);
  check_arguments(inputs(), shader, arguments, where);
  for (uint32_t i = 0; i < shader.slots.size(); ++i) {
    const auto& binding = shader.library->bindings[i];
    if (binding.type != shader::BindingType::kAccelerationStructure || binding.count != 1) continue;
    for (const uint64_t address : structures_behind(shader, i, arguments)) {
      if (address != 0) check_top_level(inputs(), address, where + ", " + binding_name(binding));
    }
  }
  std::vector<ShaderUse> uses;
  collect_uses(shader, arguments, where, uses);
  check_uses(uses);
}

void Layer::check(const runtime::BuildCommand& command) {
  instances_ = structures_.read_instances(command);
  contents_ = check_geometries(inputs(), command);
  check_instances(inputs(), instances_);
  check_update_contents(inputs(), command, contents_);
  const bool update = HasAny(command.flags, runtime::BuildFlags::kPerformUpdate);
  const auto sizes = runtime::estimate_sizes(command);
  const uint64_t scratch =
      update ? sizes.UpdateScratchDataSizeInBytes : sizes.ScratchDataSizeInBytes;
  const uint64_t in_place = bytes_at(command.source);
  const uint64_t dest = update && in_place != 0 ? in_place : sizes.ResultDataMaxSizeInBytes;
  check_ranges(inputs(), command, dest, scratch);

  const auto input = [&](uint64_t address, const char* what) {
    hazards_.use(address, ResourceStates::kNonPixelShaderResource, what);
  };
  for (const auto& geometry : command.geometries) {
    if (geometry.Type == rtapi::RaytracingGeometryType::kTriangles) {
      input(geometry.Triangles.VertexBuffer.StartAddress, "the build's vertex buffer");
      input(geometry.Triangles.IndexBuffer, "the build's index buffer");
      input(geometry.Triangles.Transform3x4, "the build's Transform3x4");
    } else {
      input(geometry.AABBs.AABBs.StartAddress, "the build's buffer of boxes");
    }
  }
  if (command.instance_count != 0) input(command.instance_descs, "the build's instance records");
  if (command.type == rtapi::RaytracingAccelerationStructureType::kOpacityMicromapArray) {
    input(command.micromaps.input_buffer, "the build's micromap states");
    input(command.micromaps.descs.StartAddress, "the build's micromap descs");
  }
  for (const auto& linkage : command.linkages) {
    if (!linkage) continue;
    input(linkage->OpacityMicromapIndexBuffer.StartAddress, "the build's micromap indices");
    if (const uint64_t bytes = bytes_at(linkage->OpacityMicromapArray)) {
      hazards_.read_structure(linkage->OpacityMicromapArray, bytes, "the build's micromap array");
    }
  }
  hazards_.use(command.scratch, ResourceStates::kUnorderedAccess, "the build's scratch memory");
  for (const auto& info : command.postbuild_infos) {
    hazards_.use(info.DestBuffer, ResourceStates::kUnorderedAccess, "the postbuild info");
  }
  hazards_.use_scratch(command.scratch, scratch);
  std::set<uint64_t> levels;
  for (const auto& instance : instances_) {
    if (!levels.insert(instance.AccelerationStructure).second) continue;
    if (const uint64_t bytes = bytes_at(instance.AccelerationStructure)) {
      hazards_.read_structure(instance.AccelerationStructure, bytes,
                              "a bottom level of the top level's build");
    }
  }
  if (update && command.source != command.dest && in_place != 0) {
    hazards_.read_structure(command.source, in_place, "the update's source");
  }
  hazards_.write_structure(command.dest, dest, "the build's destination");
}

void Layer::check(const runtime::EmitPostbuildInfoCommand& command) {
  hazards_.use(command.desc.DestBuffer, ResourceStates::kUnorderedAccess, "the postbuild info");
  for (const uint64_t source : command.sources) {
    if (const uint64_t bytes = bytes_at(source)) {
      hazards_.read_structure(source, bytes, "the postbuild info's source");
    }
  }
}

void Layer::check(const runtime::CopyAccelerationStructureCommand& command) {
  if (const uint64_t bytes = bytes_at(command.source)) {
    hazards_.read_structure(command.source, bytes, "the copy's source");
  }
  using Mode = rtapi::RaytracingAccelerationStructureCopyMode;
  if (command.mode == Mode::kSerialize || command.mode == Mode::kVisualizationDecodeForTools) {
    return hazards_.use(command.dest, ResourceStates::kUnorderedAccess, "the copy's destination");
  }
  // Only the backend knows how much is written.
  hazards_.write_structure(command.dest, 256, "the copy's destination");
}

void Layer::check(const runtime::CopyBufferCommand& command) {
  if (command.size_bytes == 0) return;
  hazards_.use(command.source->address() + command.source_offset, ResourceStates::kCopySource,
               "the copy's source");
  hazards_.use(command.dest->address() + command.dest_offset, ResourceStates::kCopyDest,
               "the copy's destination");
}

void Layer::check(const runtime::CopyTextureCommand& command) {
  if (command.any_state) return;
  if (command.source.texture != nullptr) {
    textures_.use(command.source.texture.get(), subresource_of(command.source),
                  ResourceStates::kCopySource, "the texture copy's source", label());
  }
  if (command.dest.texture != nullptr) {
    textures_.use(command.dest.texture.get(), subresource_of(command.dest),
                  ResourceStates::kCopyDest, "the texture copy's destination", label());
  }
  if (command.source.buffer != nullptr) {
    hazards_.use(command.source.buffer->address(), ResourceStates::kCopySource,
                 "the texture copy's source");
  }
  if (command.dest.buffer != nullptr) {
    hazards_.use(command.dest.buffer->address(), ResourceStates::kCopyDest,
                 "the texture copy's destination");
  }
}

void Layer::check(const runtime::ResolveQueriesCommand& command) {
  hazards_.use(command.dest->address() + command.dest_offset, ResourceStates::kCopyDest,
               "the buffer of queries");
}

void Layer::check(const runtime::PredicationCommand& command) {
  if (command.buffer == nullptr) return;
  hazards_.use(command.buffer->address() + command.offset, ResourceStates::kPredication,
               "the predicate");
}

void Layer::check(const runtime::ResolveCommand& command) {
  textures_.use(command.source.texture.get(), subresource_of(command.source),
                ResourceStates::kResolveSource, "the resolve's source", label());
  // Beside itself, it is in the state of the source.
  if (runtime::same_subresource(command.dest, command.source)) return;
  textures_.use(command.dest.texture.get(), subresource_of(command.dest),
                ResourceStates::kResolveDest, "the resolve's destination", label());
}

void Layer::check(const runtime::ClearUavCommand& command) {
  if (command.view.kind == shader::DescriptorKind::kTexture) {
    return textures_.use_view(shader::view_key(command.view.address, true),
                              ResourceStates::kUnorderedAccess, "the view to clear", label());
  }
  hazards_.use(command.view.address, ResourceStates::kUnorderedAccess, "the view to clear");
}

void Layer::note(const runtime::BuildCommand& command) {
  const uint64_t size = runtime::estimate_sizes(command).ResultDataMaxSizeInBytes;
  structures_.built(command, size, std::move(contents_), instances_);
}

void Layer::note(const runtime::CopyAccelerationStructureCommand& command) {
  // Only the backend knows what size compaction leaves; the first 256 bytes are there in any case.
  const bool compact = command.mode == rtapi::RaytracingAccelerationStructureCopyMode::kCompact;
  structures_.copied(command, compact ? 256 : 0);
}

void Layer::note(const runtime::CopyBufferCommand& command) {
  if (command.size_bytes == 0) return;
  structures_.written(command.dest->address() + command.dest_offset, command.size_bytes);
}

void Layer::note(const runtime::ResolveQueriesCommand& command) {
  structures_.written(command.dest->address() + command.dest_offset,
                      command.count * runtime::query_data_bytes(command.type));
}

void Layer::note(const runtime::CopyTextureCommand& command) {
  draws_.targets().written(command.dest.texture);
  if (command.dest.buffer == nullptr) return;
  structures_.written(command.dest.buffer->address() + command.dest.offset,
                      command.dest.buffer->size_bytes() - command.dest.offset);
}

void Layer::note(const runtime::ClearUavCommand& command) {
  if (command.view.kind == shader::DescriptorKind::kTexture) {
    draws_.targets().written(textures_.texture_of(shader::view_key(command.view.address, true)));
    return;
  }
  structures_.written(command.view.address, command.view.size_bytes);
}

}  // namespace kaamos::checks
