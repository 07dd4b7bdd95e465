// SPDX-License-Identifier: MIT
//
// Payload access qualifiers: what the fields of a [raypayload] struct say about the stages.
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
// Of a word behind read( or write(; 0: no such stage.
uint8_t payload_stage(std::string_view word);
// Of an ir::StageBits; ray generation and all others are callers.
uint8_t payload_stage_of(uint32_t stage);

// One field that has qualifiers of its own, at any depth of payload structs in payload structs.
struct PayloadLeaf {
  std::vector<uint32_t> path;  // indices in ir::Struct::fields
  const FieldInfo* field = nullptr;
  PayloadAccessBits access;
  const ir::Type* type = nullptr;
};
// Of a struct with `is_payload`, in the order of declaration.
std::vector<PayloadLeaf> payload_leaves(const StructInfo& structure);

// Every field may be read and written in the stage: nothing needs to be copied apart.
bool all_access(const std::vector<PayloadLeaf>& leaves, uint8_t stage);

}  // namespace kaamos::hlsl
