// SPDX-License-Identifier: MIT
//
// Order and states inside one command list: structures that are used without a UAV barrier after
// they were built, buffers that are used in another state than they are in. Across lists nothing is
// held against anything: buffers decay to the common state when a list ends, and D3D12 promotes
// them from it at the first use. [DXR: Synchronizing acceleration structure memory writes/reads;
// D3D12: implicit state transitions]
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "runtime/backend/address_map.h"
#include "runtime/backend/commands.h"
#include "runtime/checks/report.h"

namespace kaamos::checks {

class Hazards {
 public:
  Hazards(const runtime::AddressMap& addresses, Reporter& reporter)
      : addresses_(addresses), reporter_(reporter) {}

  void begin_list();
  // What the next uses belong to: "DispatchRays, command 3".
  void begin_command(const std::string& label) { label_ = label; }
  void barrier(const runtime::BarrierCommand& command);

  // Memory of acceleration structures, ordered by UAV barriers. `what` names the use: "the update's
  // source".
  void read_structure(uint64_t address, uint64_t size_bytes, const std::string& what);
  void write_structure(uint64_t address, uint64_t size_bytes, const std::string& what);
  void use_scratch(uint64_t address, uint64_t size_bytes);

  // Other memory, by the state of its buffer. Null and dead addresses are others' business.
  void use(uint64_t address, rtapi::ResourceStates state, const std::string& what);

  bool has_pending() const { return !written_.empty(); }

 private:
  struct Range {
    uint64_t end = 0;
    std::string what;  // "the result of BuildRaytracingAccelerationStructure, command 0"
  };
  using Ranges = std::map<uint64_t, Range>;
  struct State {
    rtapi::ResourceStates state = rtapi::ResourceStates::kCommon;
    bool promoted = false;  // by a use, not by a transition
    std::string by;
  };

  static void add(Ranges& ranges, uint64_t begin, uint64_t end, std::string what);
  // Reports and drops what overlaps.
  void hold_against(Ranges& ranges, uint64_t begin, uint64_t end, const std::string& what);
  static void drop(Ranges& ranges, uint64_t begin, uint64_t end);

  const runtime::AddressMap& addresses_;
  Reporter& reporter_;
  std::string label_;
  Ranges written_;  // structures; without a barrier since
  Ranges read_;
  Ranges scratch_;
  std::map<uint64_t, State> states_;  // by the address of the buffer
};

std::string state_name(rtapi::ResourceStates state);  // "kCopyDest"

}  // namespace kaamos::checks
