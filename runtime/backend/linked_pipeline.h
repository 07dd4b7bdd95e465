// SPDX-License-Identifier: MIT
//
// The result of linking state objects and compute pipelines: everything a backend needs to run
// them, with names resolved, root arguments assigned and sizes checked. Immutable.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/root_signature.h>
#include <rtapi/shader_library.h>
#include <rtapi/state_object.h>

namespace kaamos::runtime {

// One export of a library, as one state object uses it.
struct LinkedShader {
  std::string name;  // in the state object
  shader::Stage stage = shader::Stage::kLibrary;
  const shader::ExportDesc* code = nullptr;
  const shader::LibraryDesc* library = nullptr;
  // One per binding of the library, for Invocation::slots; kUnbound for bindings that the export
  // does not use.
  std::vector<shader::BindingSlot> slots;
  uint32_t local_argument_bytes = 0;  // a record is at least 32 bytes larger
  uint64_t stack_bytes = 0;
  // Keep the code and the static samplers alive; each may be empty.
  rtapi::ShaderLibrary library_owner;
  rtapi::RootSignature global_root_signature;
  rtapi::RootSignature local_root_signature;
};

// kNone: no identifier of this pipeline.
enum class RecordKind : uint8_t { kRayGeneration, kMiss, kCallable, kHitGroup, kNone };

// The record that an identifier stands for. Absent shaders are null.
struct LinkedRecord {
  rtapi::ShaderIdentifier identifier = {};
  std::string name;
  RecordKind kind = RecordKind::kMiss;
  rtapi::HitGroupType hit_group_type = rtapi::HitGroupType::kTriangles;
  const LinkedShader* shader = nullptr;  // ray generation, miss, callable
  const LinkedShader* any_hit = nullptr;
  const LinkedShader* closest_hit = nullptr;
  const LinkedShader* intersection = nullptr;
  uint32_t local_argument_bytes = 0;
  // The export's own: a hit group without shaders has one too. May be empty.
  rtapi::RootSignature local_root_signature;
};

// Bytes 0..3 of an identifier are its index, never 0. The rest makes it unique in the process, so
// that comparing all of it exposes bytes that are not an identifier of this pipeline.
class IdentifierTable {
 public:
  void insert(const LinkedRecord* record) {
    uint32_t index = index_of(record->identifier.data());
    if (records_.empty()) first_ = index;
    if (index < first_) {
      records_.insert(records_.begin(), first_ - index, nullptr);
      first_ = index;
    }
    if (index - first_ >= records_.size()) records_.resize(index - first_ + 1);
    records_[index - first_] = record;
  }
  // Null for the NULL identifier, and for bytes that are not an identifier of this pipeline.
  // `identifier` points to 32 readable bytes, aligned to 4.
  const LinkedRecord* find(const uint8_t* identifier) const {
    uint32_t slot = index_of(identifier) - first_;
    if (slot >= records_.size()) return nullptr;
    const LinkedRecord* record = records_[slot];
    if (!record || std::memcmp(record->identifier.data(), identifier, 32) != 0) return nullptr;
    return record;
  }

 private:
  static uint32_t index_of(const uint8_t* identifier) {
    uint32_t index;
    std::memcpy(&index, identifier, sizeof index);
    return index;
  }
  uint32_t first_ = 0;
  std::vector<const LinkedRecord*> records_;
};

inline bool is_null_identifier(const uint8_t* identifier) {
  static constexpr uint8_t kZero[32] = {};
  return std::memcmp(identifier, kZero, 32) == 0;
}

// A ray tracing pipeline (never a collection). Pointers inside it point into the same object, or
// into objects that it keeps alive.
struct LinkedPipeline {
  std::string name;
  uint32_t max_payload_bytes = 0;
  uint32_t max_attribute_bytes = 0;
  uint32_t max_recursion_depth = 0;
  rtapi::RaytracingPipelineFlags flags = rtapi::RaytracingPipelineFlags::kNone;
  std::vector<std::unique_ptr<const LinkedShader>> shaders;
  std::vector<std::unique_ptr<const LinkedRecord>> records;
  IdentifierTable identifiers;
  std::vector<std::shared_ptr<const void>> keep_alive;  // collections and parents
};

struct LinkedCompute {
  LinkedShader shader;  // code->compute is not null
};

}  // namespace kaamos::runtime
