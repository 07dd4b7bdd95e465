// SPDX-License-Identifier: MIT
//
// Runs the command stream in order. Copies, clears and barriers are recorded; whatever the host
// takes part in (tables, builds) first submits everything before it.
#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "runtime/backend/executor.h"
#include "runtime/vulkan/device.h"
#include "runtime/vulkan/textures/resolve.h"

namespace kaamos::vulkan {
namespace {

class Target final : public runtime::CommandTarget {
 public:
  explicit Target(Device& device)
      : device_(device), pass_(device.dispatch_environment(), device.draw_blocks()) {}

  runtime::DispatchOutcome dispatch_rays(const runtime::DispatchRaysCommand& command,
                                         const std::string& label) override {
    if (auto s = finish(); !s) return {s};
    return counted(vulkan::dispatch_rays(device_.dispatch_environment(), command, label));
  }
  runtime::DispatchOutcome dispatch(const runtime::DispatchCommand& command,
                                    const std::string& label) override {
    if (auto s = finish(); !s) return {s};
    return counted(dispatch_compute(device_.dispatch_environment(), command, label));
  }
  rtapi::Status draw(const runtime::DrawCommand& command, const std::string& label) override {
    return counted(pass_.draw(command, label)).status;
  }
  rtapi::Status clear_target(const runtime::ClearTargetCommand& command) override {
    return pass_.clear(command);
  }
  rtapi::Status build(const runtime::BuildCommand& command) override {
    if (auto s = finish(); !s) return s;
    return device_.structures().build(device_.stream(), command);
  }
  rtapi::Status emit_postbuild_info(const runtime::EmitPostbuildInfoCommand& command) override {
    if (auto s = finish(); !s) return s;
    return device_.structures().emit(device_.stream(), command);
  }
  rtapi::Status execute_operations(const runtime::RtasOperationsCommand& command,
                                   const std::string& label) override {
    if (auto s = finish(); !s) return s;
    return device_.structures().execute(device_.stream(), command, label);
  }
  rtapi::Status copy_structure(const runtime::CopyAccelerationStructureCommand& command) override {
    if (auto s = finish(); !s) return s;
    return device_.structures().copy(device_.stream(), command);
  }
  rtapi::Status copy_buffer(const runtime::CopyBufferCommand& command,
                            const std::string& label) override;
  rtapi::Status copy_texture(const runtime::CopyTextureCommand& command) override {
    if (auto s = end_draws(); !s) return s;
    if (command.dest.buffer != nullptr) {
      const runtime::TextureCopyPlace& place = command.dest;
      device_.structures().evict(place.buffer->address() + place.offset,
                                 place.buffer->size_bytes() - place.offset);
    }
    return device_.textures().copy(device_.stream(), command);
  }
  rtapi::Status resolve(const runtime::ResolveCommand& command) override {
    if (auto s = end_draws(); !s) return s;
    return vulkan::resolve(device_.stream(), command);
  }
  rtapi::Status clear(const runtime::ClearUavCommand& command) override {
    if (auto s = end_draws(); !s) return s;
    if (command.view.kind != shader::DescriptorKind::kTexture) {
      device_.structures().evict(command.view.address, command.view.size_bytes);
    }
    return device_.textures().clear(device_.stream(), command);
  }
  rtapi::Status write_timestamp(const runtime::TimestampCommand& command) override {
    if (auto s = end_draws(); !s) return s;
    return Timestamps::write(device_.stream(), command);
  }
  rtapi::Status resolve_timestamps(const runtime::ResolveQueriesCommand& command) override {
    device_.structures().evict(command.dest->address() + command.dest_offset,
                               command.count * sizeof(uint64_t));
    if (auto s = end_draws(); !s) return s;
    return Timestamps::resolve(device_.stream(), command);
  }
  rtapi::Status count_work(const runtime::WorkToCount& what) override {
    if (auto s = finish(); !s) return s;
    pass_.count_work(what);
    return {};
  }
  runtime::WorkCounts counted() const override { return pass_.counted(); }
  rtapi::Status write_buffer(const std::shared_ptr<runtime::BackendBuffer>& dest, uint64_t offset,
                             std::span<const uint8_t> bytes) override;
  rtapi::Status barrier() override {
    pass_.barrier();
    return {};
  }
  rtapi::Status finish() override { return counted(pass_.flush()).status; }

 private:
  runtime::DispatchOutcome counted(CountedOutcome result) {
    device_.add(result.statistics);
    return result;
  }

  // Before commands that may run what waits: draws need a guard when they run.
  rtapi::Status end_draws() { return pass_.waits() ? finish() : rtapi::Status(); }

  Device& device_;
  DrawPass pass_;
};

rtapi::Status Target::copy_buffer(const runtime::CopyBufferCommand& command,
                                  const std::string& label) {
  if (command.size_bytes == 0) return {};
  if (auto s = end_draws(); !s) return s;
  device_.structures().evict(command.dest->address() + command.dest_offset, command.size_bytes);
  const uint64_t from = command.source_offset;
  const uint64_t to = command.dest_offset;
  const bool overlap = command.source == command.dest && from < to + command.size_bytes &&
                       to < from + command.size_bytes;
  CommandStream& stream = device_.stream();
  if (overlap) {
    // Vulkan does not allow overlapping copies, so the host makes them.
    if (auto s = stream.flush(); !s) return s;
    uint8_t* host = command.dest->host();
    std::memmove(host + to, host + from, command.size_bytes);
    return {};
  }
  // Copies in one list happen one after another, as if each waited for the previous one.
  stream.everything();
  auto commands = stream.record(label);
  if (!commands) return commands.error();
  const GpuBuffer& source = gpu_buffer_of(*command.source);
  const GpuBuffer& dest = gpu_buffer_of(*command.dest);
  const VkBufferCopy region = {source.offset() + from, dest.offset() + to, command.size_bytes};
  device_.gpu().vk().vkCmdCopyBuffer(*commands, source.handle(), dest.handle(), 1, &region);
  return {};
}

rtapi::Status Target::write_buffer(const std::shared_ptr<runtime::BackendBuffer>& dest,
                                   uint64_t offset, std::span<const uint8_t> bytes) {
  if (auto s = end_draws(); !s) return s;
  device_.structures().evict(dest->address() + offset, bytes.size());
  CommandStream& stream = device_.stream();
  stream.everything();
  auto commands = stream.record("ResolveQueryData");
  if (!commands) return commands.error();
  const GpuBuffer& buffer = gpu_buffer_of(*dest);
  constexpr size_t kMost = 65536;  // of one vkCmdUpdateBuffer
  for (size_t i = 0; i < bytes.size(); i += kMost) {
    device_.gpu().vk().vkCmdUpdateBuffer(*commands, buffer.handle(), buffer.offset() + offset + i,
                                         std::min(kMost, bytes.size() - i), bytes.data() + i);
  }
  return {};
}

}  // namespace

rtapi::Status Device::execute(std::span<const runtime::Command> commands) {
  Target target(*this);
  rtapi::Status status = runtime::execute(commands, target, context_);
  if (auto s = target.finish(); status && !s) status = s;
  // After an error too: what was recorded before it holds objects that may go now.
  if (auto s = stream_->flush(); !s) return s;
  return status ? validation_status() : status;
}

}  // namespace kaamos::vulkan
