// SPDX-License-Identifier: MIT
//
// Runs a recorded command list on a backend: the labels of messages, events, ExecuteIndirect,
// checked mode's layer around each command, and the order in which findings are reported are the
// same for all backends.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <rtapi/result.h>

#include "runtime/backend/backend.h"
#include "runtime/backend/commands.h"
#include "runtime/backend/errors.h"

namespace kaamos::runtime {

// The outcome of a dispatch. An error removes the device.
struct DispatchOutcome {
  rtapi::Status status;
  // Something that ran, or did not, unlike what the application may have meant.
  struct Warning {
    Id id;
    std::string text;
  };
  std::vector<Warning> warnings = {};
  // Only on checked devices.
  std::vector<ReachedFrom> reached = {};
  MissingRecords missing = {};
};

// A backend's work for each command. `label` names the command in messages.
class CommandTarget {
 public:
  virtual ~CommandTarget() = default;
  virtual DispatchOutcome dispatch_rays(const DispatchRaysCommand& command,
                                        const std::string& label) = 0;
  virtual DispatchOutcome dispatch(const DispatchCommand& command, const std::string& label) = 0;
  virtual rtapi::Status draw(const DrawCommand& command, const std::string& label) = 0;
  virtual rtapi::Status clear_target(const ClearTargetCommand& command) = 0;
  virtual rtapi::Status build(const BuildCommand& command) = 0;
  virtual rtapi::Status emit_postbuild_info(const EmitPostbuildInfoCommand& command) = 0;
  virtual rtapi::Status copy_structure(const CopyAccelerationStructureCommand& command) = 0;
  virtual rtapi::Status execute_operations(const RtasOperationsCommand& command,
                                           const std::string& label) = 0;
  virtual rtapi::Status copy_buffer(const CopyBufferCommand& command, const std::string& label) = 0;
  virtual rtapi::Status copy_texture(const CopyTextureCommand& command) = 0;
  virtual rtapi::Status resolve(const ResolveCommand& command) = 0;
  virtual rtapi::Status clear(const ClearUavCommand& command) = 0;
  virtual rtapi::Status write_timestamp(const TimestampCommand& command) = 0;
  virtual rtapi::Status resolve_timestamps(const ResolveQueriesCommand& command) = 0;
  // From now on, draws add to these sums; everything earlier is done when it returns.
  virtual rtapi::Status count_work(const WorkToCount& what) = 0;
  // The sums of all draws that were counted, and are done.
  virtual WorkCounts counted() const = 0;
  // Writes bytes from the host, a multiple of 4, when all earlier commands are done.
  virtual rtapi::Status write_buffer(const std::shared_ptr<BackendBuffer>& dest, uint64_t offset,
                                     std::span<const uint8_t> bytes) = 0;
  virtual rtapi::Status barrier() = 0;
  // Returns when all earlier commands are done, so that the host sees what they wrote.
  virtual rtapi::Status finish() = 0;
};

// The commands in order, up to the first error or the removal of the device. The last ones need not
// be done yet: see finish().
rtapi::Status execute(std::span<const Command> commands, CommandTarget& target,
                      const Context& context);

}  // namespace kaamos::runtime
