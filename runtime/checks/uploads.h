// SPDX-License-Identifier: MIT
//
// Memory in upload heaps that draws read: the application must not write it from
// ExecuteCommandLists on until the list has run.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/backend/address_map.h"
#include "runtime/backend/commands.h"
#include "runtime/checks/report.h"

namespace kaamos::checks {

struct UploadRange {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint64_t hash = 0;
  std::string what;  // "draw 3, pipeline \"gbuffer\": the vertex buffer of slot 0"
};

// Returns what the draws of a list read as vertices, indices and root descriptors, as it is now.
std::vector<UploadRange> read_uploads(const runtime::AddressMap& addresses,
                                      std::span<const runtime::Command> commands);
// Reports those that have changed since.
void compare_uploads(const runtime::AddressMap& addresses, Reporter& reporter,
                     std::span<const UploadRange> ranges);

}  // namespace kaamos::checks
