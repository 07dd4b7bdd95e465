// SPDX-License-Identifier: MIT
//
// Payload access qualifiers: which stages may read and write the fields of a [raypayload] struct.
// [DXR: Payload access qualifiers]
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/hlsl/check/types.h"

namespace kaamos::hlsl {

enum PayloadStageBits : uint8_t {
  kPayloadCaller = 1,
  kPayloadClosestHit = 2,
  kPayloadMiss = 4,
  kPayloadAnyHit = 8,
};
constexpr uint8_t kPayloadStages[] = {kPayloadCaller, kPayloadClosestHit, kPayloadMiss,
                                      kPayloadAnyHit};

// "closesthit", as in read(closesthit).
const char* payload_stage_name(uint8_t stage);
// The stage that a word in read(...) or write(...) names; 0 if there is none.
uint8_t payload_stage(std::string_view word);
// For one ir::StageBits value; ray generation and all other stages are callers.
uint8_t payload_stage_of(uint32_t stage);

// A field with qualifiers of its own, at any depth of nested payload structs.
struct PayloadLeaf {
  std::vector<uint32_t> path;  // indices in ir::Struct::fields
  const FieldInfo* field = nullptr;
  PayloadAccessBits access;
  const ir::Type* type = nullptr;
};
// The struct must have `is_payload`. In the order of declaration.
std::vector<PayloadLeaf> payload_leaves(const StructInfo& structure);

// Whether the stage may read and write every field, so that nothing needs a separate copy.
bool all_access(const std::vector<PayloadLeaf>& leaves, uint8_t stage);

}  // namespace kaamos::hlsl
