// SPDX-License-Identifier: MIT
//
// Do indices and vertices of a draw lie inside their views? [RAS-07, RAS-14]
#pragma once

#include <string>

#include "runtime/backend/address_map.h"
#include "runtime/backend/draw_commands.h"
#include "runtime/checks/report.h"

namespace kaamos::checks {

// Reads the index buffer. `who` begins the messages.
void check_vertex_inputs(const runtime::AddressMap& addresses, Reporter& reporter,
                         const runtime::DrawCommand& command, const std::string& who);

}  // namespace kaamos::checks
