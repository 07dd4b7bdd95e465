// SPDX-License-Identifier: MIT
//
// Proves the shader tables of a dispatch before it runs: which records any instance, geometry and
// ray type can reach, and whether each contains what it must. Every ray is assumed able to miss,
// and to hit each geometry that its mask and flags let through. A TraceRay whose arguments are not
// constants is checked after it has run, with each set of arguments that checked code recorded.
// Where there is no record at all, it is only a mistake if a ray gets there. [DXR: Shader tables;
// Hit group table indexing]
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/checks/proof_inputs.h"

namespace kaamos::checks {

// A buffer, texture or structure that a reached shader can read or write.
struct ShaderUse {
  uint64_t address = 0;
  bool structure = false;
  bool texture = false;                                          // `address` is a shader::view_key
  rtapi::ResourceStates state = rtapi::ResourceStates::kCommon;  // for buffers
  std::string what;  // "miss shader \"Miss\", t1 \"sky\""
};

// A record that a ray or call can reach but that is missing: past the end of its table, or without
// a suitable identifier. Only records that are actually reached have to exist. [DXR: Shader tables]
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
  std::vector<ShaderUse> uses;         // by all shaders that can be reached
  std::vector<MissingRecord> missing;  // not reported yet
  bool good = true;                    // nothing was reported, nothing is missing
};

// Reports everything that is wrong except missing records.
ProofResults prove_tables(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command);

// The same for calls whose arguments are not constants, after they have run.
ProofResults prove_reached(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command,
                           std::span<const runtime::ReachedFrom> calls);

}  // namespace kaamos::checks
