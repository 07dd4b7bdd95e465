// SPDX-License-Identifier: MIT
//
// Finds where a shader reads a payload field that has no value at that point, and where what it
// writes is lost. [DXR: Payload access qualifiers]
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// A payload that is passed to TraceRay or Invoke, and the place where that happens.
struct TracePayload {
  const ir::Variable* variable = nullptr;
  const ir::Struct* structure = nullptr;
  SourcePlace place = 0;
  PayloadRoles roles = {};
};

struct PayloadFacts {
  std::unordered_map<const ir::Struct*, PayloadLeaves> structs;  // those with access qualifiers
  // The places where the source names a field of a payload struct, and where it passes one to
  // TraceRay.
  std::unordered_map<const ir::Expr*, SourcePlace> accesses;
  std::unordered_map<const ir::Stmt*, TracePayload> traces;
};

enum class PayloadFault : uint8_t {
  kDropped,      // written by a stage that may not
  kDataLoss,     // not written on some path, and may have been before
  kNotReturned,  // read after TraceRay, which does not return it
  kUndefined,    // read by a stage that may not
  kNotPassed,    // written before TraceRay, which does not pass it
};

class PayloadReport {
 public:
  virtual ~PayloadReport() = default;
  // `stage` of PayloadStageBits.
  virtual void payload_fault(PayloadFault fault, SourcePlace place, std::string_view field,
                             uint8_t stage) = 0;
};

// `function` is that of an entry point of the stage, of ir::StageBits. `payload` is the struct that
// it takes first, in `parameter`, if that has access qualifiers; else null.
void check_payload_uses(const PayloadFacts& facts, const ir::Function& function, uint32_t stage,
                        const ir::Struct* payload, SourcePlace parameter, PayloadReport& report);

}  // namespace kaamos::hlsl
