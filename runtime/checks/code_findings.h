// SPDX-License-Identifier: MIT
//
// Puts into words what the shaders of checked libraries found. The backends hand over a CheckReport
// and where it came from.
#pragma once

#include <cstdint>

#include <kaamos/shader/abi.h>
#include <rtapi/raytracing.h>

#include "runtime/backend/address_map.h"
#include "runtime/backend/linked_pipeline.h"
#include "runtime/checks/report.h"

namespace kaamos::checks {

struct CodePlace {
  const runtime::LinkedShader* shader = nullptr;  // null: unknown
  uint32_t index[3] = {0, 0, 0};                  // DispatchRaysIndex, or the thread group
  uint32_t dimensions[3] = {1, 1, 1};
  const rtapi::DispatchRaysDesc* tables = nullptr;  // null: Dispatch
};

// `count`: how many invocations this one stands for.
void report_finding(Reporter& reporter, const runtime::AddressMap& addresses,
                    const CodePlace& place, const shader::CheckReport& report, uint64_t count = 1);

}  // namespace kaamos::checks
