// SPDX-License-Identifier: MIT
//
// What all checks of a command look at.
#pragma once

#include <rtapi/root_signature.h>

#include "runtime/backend/address_map.h"
#include "runtime/checks/identifiers.h"
#include "runtime/checks/report.h"
#include "runtime/checks/structures.h"

namespace kaamos::checks {

// A function that tells whether two root signatures have the same parameters, samplers and flags;
// rtapi knows.
using SameDefinition = bool (*)(const rtapi::RootSignature&, const rtapi::RootSignature&);

struct ProofInputs {
  const runtime::AddressMap& addresses;
  const Structures& structures;
  const Identifiers& identifiers;
  Reporter& reporter;
  SameDefinition same_definition;
};

}  // namespace kaamos::checks
