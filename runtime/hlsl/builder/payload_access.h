// SPDX-License-Identifier: MIT
//
// Payload access qualifiers: which stages may read and write the fields of a payload, and the
// copies that follow from it. A stage sees a payload as a working copy of its own: the fields that
// it may read are copied in, and those that it may write are copied back. DXR leaves all other
// fields undefined; here they are zero. [DXR: Payload access qualifiers, Detailed semantics]
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

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

// The stages that may read and write a field.
struct PayloadAccessBits {
  uint8_t read = 0;  // PayloadStageBits
  uint8_t write = 0;
};

// A hit object splits one TraceRay into two calls: what other stages may read, or write, counts as
// the caller's, too. [DXR: HitObject, interaction with payload access qualifiers]
struct PayloadRoles {
  uint8_t reads = 0;  // PayloadStageBits
  uint8_t writes = 0;
};
PayloadAccessBits as_caller(PayloadAccessBits access, PayloadRoles roles);

// A field with qualifiers of its own, at any depth of nested payload structs.
struct PayloadLeaf {
  std::vector<uint32_t> path;  // indices in ir::Struct::fields
  std::string_view name;
  PayloadAccessBits access;
  const ir::Type* type = nullptr;
};
// Those of a struct, in the order of declaration.
using PayloadLeaves = std::vector<PayloadLeaf>;

PayloadLeaves as_caller(PayloadLeaves leaves, PayloadRoles roles);

// Returns whether the stage may read and write every field, so that nothing needs a separate copy.
bool all_access(const PayloadLeaves& leaves, uint8_t stage);

// The statements that trace with a payload object of its own: what the caller may not write does
// not reach the stages, and what it may not read does not come back. `trace` is the kTraceRay.
ir::Block trace_with_copy(IrBuilder& build, ir::Stmt* trace, const ir::Variable* payload,
                          const PayloadLeaves& leaves);

// A function that makes the working copy of the stage, of PayloadStageBits, and calls `body` with
// it. `body` takes the payload first; it gives its mangled name to the wrapper.
ir::Function* make_payload_wrapper(ir::Module& module, IrBuilder& build, ir::Function* body,
                                   const PayloadLeaves& leaves, uint8_t stage);

}  // namespace kaamos::hlsl
