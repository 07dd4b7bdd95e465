// SPDX-License-Identifier: MIT
//
// Checked mode's layer on top of a backend: reads the command stream as it executes, and checks
// each command against what is in GPU memory at that moment.
#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/checks/build_checks.h"
#include "runtime/checks/draws.h"
#include "runtime/checks/hazards.h"
#include "runtime/checks/identifiers.h"
#include "runtime/checks/report.h"
#include "runtime/checks/structures.h"
#include "runtime/checks/table_proof.h"
#include "runtime/checks/texture_states.h"

namespace kaamos::checks {

class Layer : public runtime::CommandObserver {
 public:
  Layer(runtime::AddressMap& addresses, Reporter& reporter, SameDefinition same_definition)
      : addresses_(addresses),
        reporter_(reporter),
        same_definition_(same_definition),
        structures_(addresses),
        hazards_(addresses, reporter),
        textures_(reporter),
        draws_(addresses, reporter, textures_) {}

  // Called when a state object is made.
  void created(const runtime::LinkedPipeline& pipeline);
  void created(const runtime::LinkedGraphics& pipeline) { draws_.created(pipeline); }
  TextureStates& textures() { return textures_; }

  // The commands that follow belong to another list.
  void begin_list() {
    hazards_.begin_list();
    textures_.begin_list();
    draws_.begin_list();
  }
  // They have all run.
  void end_list() { draws_.end_list(); }

  void before(const runtime::Command& command, const std::string& label) override;
  void after(const runtime::Command& command, bool succeeded) override;
  bool needs_memory(const runtime::Command& command) const override;
  bool needs_memory_after(const runtime::Command& command) const override;
  void reached(const runtime::Command& command,
               std::span<const runtime::ReachedFrom> calls) override;
  void missed(const runtime::Command& command, const runtime::MissingRecords& records) override;
  void drawn(const runtime::DrawCommand& command, const runtime::DrawCounts& counts) override {
    draws_.drawn(command, counts);
  }

 private:
  void check(const runtime::DispatchRaysCommand& command);
  void check(const runtime::DispatchCommand& command);
  void check(const runtime::ExecuteIndirectCommand& command);
  void check(const runtime::BuildCommand& command);
  void check(const runtime::EmitPostbuildInfoCommand& command);
  void check(const runtime::CopyAccelerationStructureCommand& command);
  void check(const runtime::RtasOperationsCommand& command);
  void check_partitioned(const runtime::RtasOperation& operation);
  void check_batch(const runtime::RtasOperation& operation);
  void check(const runtime::CopyBufferCommand& command);
  void check(const runtime::CopyTextureCommand& command);
  void check(const runtime::ResolveCommand& command);
  void check(const runtime::ClearUavCommand& command);
  void check(const runtime::ResolveQueriesCommand& command);
  void check(const runtime::PredicationCommand& command);
  void check(const runtime::DrawCommand& command);
  void check(const runtime::ClearTargetCommand& command) {
    draws_.targets().check(command, label());
  }
  void check(const runtime::BarrierCommand& command) {
    hazards_.barrier(command);
    textures_.barrier(command, label());
  }
  template <class T>
  void check(const T&) {}

  void note(const runtime::BuildCommand& command);
  void note(const runtime::CopyAccelerationStructureCommand& command);
  void note(const runtime::RtasOperationsCommand& command);
  void note(const runtime::CopyBufferCommand& command);
  void note(const runtime::CopyTextureCommand& command);
  void note(const runtime::ResolveCommand& command) {
    draws_.targets().written(command.dest.texture);
  }
  void note(const runtime::ClearUavCommand& command);
  void note(const runtime::ResolveQueriesCommand& command);
  void note(const runtime::DrawCommand& command) { draws_.targets().note(command); }
  void note(const runtime::ClearTargetCommand& command) { draws_.targets().note(command); }
  void note(const runtime::DispatchRaysCommand&) { hold_tables(); }
  void note(const runtime::ExecuteIndirectCommand&) { hold_tables(); }
  template <class T>
  void note(const T&) {}

  // Takes over what a proof found; a proof that found nothing wrong is remembered under its key.
  void take(ProofResults results, uint64_t key);
  // Checks order and states of what shaders use.
  void check_uses(const std::vector<ShaderUse>& uses);
  // Takes out what the shaders of a draw read although it is a target, and reports it.
  void check_feedback(const runtime::DrawCommand& command, std::vector<ShaderUse>& uses);
  uint64_t bytes_at(uint64_t address) const;  // of the structure there

  // Tables must not change while they are used.
  void keep_tables(const rtapi::DispatchRaysDesc& desc);
  void hold_tables();
  const std::string& label() const { return labels_.back(); }

  // A hash of everything that a proof depends on: while it stays the same, so does the verdict.
  uint64_t proof_key(const runtime::DispatchRaysCommand& command) const;
  ProofInputs inputs() const {
    return {addresses_, structures_, identifiers_, reporter_, same_definition_};
  }

  runtime::AddressMap& addresses_;
  Reporter& reporter_;
  SameDefinition same_definition_;
  Structures structures_;
  Hazards hazards_;
  TextureStates textures_;
  Draws draws_;
  Identifiers identifiers_;
  std::vector<GeometryContents> contents_;                // of the build under way
  std::vector<rtapi::RaytracingInstanceDesc> instances_;  // of the build under way
  std::unordered_map<uint64_t, std::vector<ShaderUse>> proven_;
  std::vector<MissingRecord> missing_;  // of the dispatch under way
  std::set<uint64_t> noted_;            // missing records that nothing reached, by their text
  std::vector<std::string> labels_;     // of the command, and of the ExecuteIndirect around it
  struct UsedTable {
    const char* name = "";
    uint64_t address = 0;
    uint64_t size_bytes = 0;
    uint64_t hash = 0;
  };
  std::vector<UsedTable> used_tables_;
};

}  // namespace kaamos::checks
