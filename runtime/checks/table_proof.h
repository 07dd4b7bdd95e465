// SPDX-License-Identifier: MIT
//
// The shader tables of a dispatch, proven before it runs: which records any instance, geometry and
// ray type can reach, and whether each holds what it must. Every ray counts as able to miss, and to
// meet each geometry that its mask and flags let through. A TraceRay whose arguments are not
// constants is proven when it has run, of each set of arguments that checked code gave it. Where
// there is no record at all, only a ray that gets there makes it a mistake. [DXR: Shader tables;
// Hit group table indexing]
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/checks/identifiers.h"
#include "runtime/checks/report.h"
#include "runtime/checks/structures.h"

namespace kaamos::checks {

// Whether two root signatures have the same parameters, samplers and flags; rtapi knows.
using SameDefinition = bool (*)(const rtapi::RootSignature&, const rtapi::RootSignature&);

struct ProofInputs {
  const runtime::AddressMap& addresses;
  const Structures& structures;
  const Identifiers& identifiers;
  Reporter& reporter;
  SameDefinition same_definition;
};

// A buffer, texture or structure that a reached shader can read or write.
struct ShaderUse {
  uint64_t address = 0;
  bool structure = false;
  bool texture = false;                                          // `address` is a shader::view_key
  rtapi::ResourceStates state = rtapi::ResourceStates::kCommon;  // of buffers
  std::string what;  // "miss shader \"Miss\", t1 \"sky\""
};

// A record that a ray or call can reach and that is none: past the end of its table, or without an
// identifier that suits. Only those that are reached have to be there. [DXR: Shader tables]
struct MissingRecord {
  runtime::RecordKind kind = runtime::RecordKind::kHitGroup;
  bool past_the_end = false;
  Id id = Id::kRecordOutOfTable;
  uint64_t order = 0;  // among the messages of its proof
  std::string text;

  bool reached(const runtime::MissingRecords& found) const {
    const auto which = static_cast<size_t>(kind);
    return past_the_end ? found.past_the_end[which] : found.unknown[which];
  }
};

struct ProofResults {
  std::vector<ShaderUse> uses;         // of the shaders that can be reached
  std::vector<MissingRecord> missing;  // not reported yet
  bool good = true;                    // nothing was reported, nothing is missing
};

// Reports what is wrong, apart from missing records.
ProofResults prove_tables(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command);

// The same of calls whose arguments are no constants, when they have run.
ProofResults prove_reached(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command,
                           std::span<const runtime::ReachedFrom> calls);

// The structure behind one acceleration structure binding: stands there, is a top level, is not
// stale. `user` says who traces: "ray generation shader \"RayGen\", t0 \"scene\"". False: reported.
bool check_top_level(const ProofInputs& inputs, uint64_t address, const std::string& user);

}  // namespace kaamos::checks
