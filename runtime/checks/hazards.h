// SPDX-License-Identifier: MIT
//
// Order and states inside one command list: structures that are used without a UAV barrier after
// they were built, and buffers that are used in a state they are not in. Nothing is checked across
// lists: buffers decay to the common state when a list ends, and D3D12 promotes them from it at the
// first use. [DXR: Synchronizing acceleration structure memory writes/reads; D3D12: implicit state
// transitions]
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
  // Names the command that the next uses belong to: "DispatchRays, command 3".
  void begin_command(const std::string& label) { label_ = label; }
  void barrier(const runtime::BarrierCommand& command);

  // Uses of acceleration structure memory, which UAV barriers order. `what` names the use: "the
  // update's source".
  void read_structure(uint64_t address, uint64_t size_bytes, const std::string& what);
  void write_structure(uint64_t address, uint64_t size_bytes, const std::string& what);
  void use_scratch(uint64_t address, uint64_t size_bytes);

  // Uses of other memory, checked against the state of its buffer. Null and dead addresses are
  // ignored: others report them.
  void use(uint64_t address, rtapi::ResourceStates state, const std::string& what);

 private:
  struct Range {
    uint64_t end = 0;
    std::string what;  // "the result of BuildRaytracingAccelerationStructure, command 0"
  };
  using Ranges = std::map<uint64_t, Range>;
  struct State {
    rtapi::ResourceStates state = rtapi::ResourceStates::kCommon;
    bool promoted = false;  // by a use, not by a barrier
    std::string by;
    bool enhanced = false;  // what an enhanced barrier made it visible to
  };

  void access_barrier(const runtime::BarrierCommand& command);
  static void add(Ranges& ranges, uint64_t begin, uint64_t end, std::string what);
  // Reports the overlapping ranges, then drops them.
  void hold_against(Ranges& ranges, uint64_t begin, uint64_t end, const std::string& what);
  static void drop(Ranges& ranges, uint64_t begin, uint64_t end);

  const runtime::AddressMap& addresses_;
  Reporter& reporter_;
  std::string label_;
  Ranges written_;  // structures written without a barrier since
  Ranges read_;
  Ranges scratch_;
  std::map<uint64_t, State> states_;  // by the address of the buffer
};

std::string state_name(rtapi::ResourceStates state);  // "kCopyDest"

}  // namespace kaamos::checks
