// SPDX-License-Identifier: MIT
//
// Checked mode's layer over a backend: reads the command stream as it executes, and holds each
// command against what stands in GPU memory at that moment.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/backend.h"
#include "runtime/checks/build_checks.h"
#include "runtime/checks/hazards.h"
#include "runtime/checks/identifiers.h"
#include "runtime/checks/report.h"
#include "runtime/checks/structures.h"
#include "runtime/checks/table_proof.h"

namespace kaamos::checks {

class Layer : public runtime::CommandObserver {
 public:
  Layer(const runtime::AddressMap& addresses, Reporter& reporter)
      : addresses_(addresses),
        reporter_(reporter),
        structures_(addresses),
        hazards_(addresses, reporter) {}

  // A state object was made.
  void created(const runtime::LinkedPipeline& pipeline) { identifiers_.add(pipeline); }

  // The next commands are those of another list.
  void begin_list() { hazards_.begin_list(); }

  void before(const runtime::Command& command, const std::string& label) override;
  void after(const runtime::Command& command, bool succeeded) override;
  bool needs_memory(const runtime::Command& command) const override;

 private:
  void check(const runtime::DispatchRaysCommand& command);
  void check(const runtime::DispatchCommand& command);
  void check(const runtime::BuildCommand& command);
  void check(const runtime::EmitPostbuildInfoCommand& command);
  void check(const runtime::CopyAccelerationStructureCommand& command);
  void check(const runtime::CopyBufferCommand& command);
  void check(const runtime::CopyTextureCommand& command);
  void check(const runtime::BarrierCommand& command) { hazards_.barrier(command); }
  template <class T>
  void check(const T&) {}

  void note(const runtime::BuildCommand& command);
  void note(const runtime::CopyAccelerationStructureCommand& command);
  void note(const runtime::CopyBufferCommand& command);
  void note(const runtime::CopyTextureCommand& command);
  void note(const runtime::ClearUavCommand& command);
  template <class T>
  void note(const T&) {}

  // Order and states of what shaders use.
  void check_uses(const std::vector<ShaderUse>& uses);
  uint64_t bytes_at(uint64_t address) const;  // of the structure there

  // What a proof depended on: while it is the same, a table that was proven stays proven.
  uint64_t proof_key(const runtime::DispatchRaysCommand& command) const;
  ProofInputs inputs() const { return {addresses_, structures_, identifiers_, reporter_}; }

  const runtime::AddressMap& addresses_;
  Reporter& reporter_;
  Structures structures_;
  Hazards hazards_;
  Identifiers identifiers_;
  std::vector<GeometryContents> contents_;                // of the build under way
  std::vector<rtapi::RaytracingInstanceDesc> instances_;  // of the build under way
  std::unordered_map<uint64_t, std::vector<ShaderUse>> proven_;
};

}  // namespace kaamos::checks
