// SPDX-License-Identifier: MIT
//
// Runs the command stream in order. Copies, clears and barriers are recorded; whatever the host
// takes part in (tables, builds) first submits everything before it.
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "runtime/backend/indirect.h"
#include "runtime/vulkan/device.h"

namespace kaamos::vulkan {
namespace {

class Executor {
 public:
  explicit Executor(Device& device) : device_(device) {}

  rtapi::Status operator()(const runtime::DispatchRaysCommand& command) {
    return finish(dispatch_rays(device_.dispatch_environment(), command, label("DispatchRays")));
  }
  rtapi::Status operator()(const runtime::DispatchCommand& command) {
    return finish(dispatch_compute(device_.dispatch_environment(), command, label("Dispatch")));
  }
  rtapi::Status operator()(const runtime::ExecuteIndirectCommand& command);
  rtapi::Status operator()(const runtime::BuildCommand& command) {
    return device_.structures().build(device_.stream(), command);
  }
  rtapi::Status operator()(const runtime::EmitPostbuildInfoCommand& command) {
    return device_.structures().emit(device_.stream(), command);
  }
  rtapi::Status operator()(const runtime::CopyAccelerationStructureCommand& command) {
    return device_.structures().copy(device_.stream(), command);
  }
  rtapi::Status operator()(const runtime::CopyBufferCommand& command);
  rtapi::Status operator()(const runtime::CopyTextureCommand& command) {
    if (command.dest.buffer != nullptr) {
      const runtime::TextureCopyPlace& place = command.dest;
      device_.structures().evict(place.buffer->address() + place.offset,
                                 place.buffer->size_bytes() - place.offset);
    }
    return device_.textures().copy(device_.stream(), command);
  }
  rtapi::Status operator()(const runtime::ClearUavCommand& command) {
    if (command.view.kind != shader::DescriptorKind::kTexture) {
      device_.structures().evict(command.view.address, command.view.size_bytes);
    }
    return device_.textures().clear(device_.stream(), command);
  }
  rtapi::Status operator()(const runtime::BarrierCommand&) {
    device_.stream().everything();
    return {};
  }
  rtapi::Status operator()(const runtime::EventCommand& command) {
    if (command.begin) {
      events_.push_back(command.name);
    } else if (!events_.empty()) {
      events_.pop_back();
    }
    return {};
  }

  // Runs the command with checked mode's layer around it.
  rtapi::Status run(const runtime::Command& command);
  void next() { ++index_; }

 private:
  std::string label(const char* what) const {
    std::string text =
        std::string(indirect_ ? "ExecuteIndirect" : what) + ", command " + std::to_string(index_);
    if (!events_.empty()) text += " in \"" + events_.back() + "\"";
    return indirect_ ? runtime::indirect_label(what, *indirect_, text) : text;
  }
  rtapi::Status finish(DispatchResult result) {
    if (auto* observer = device_.context().observer) {
      if (!result.reached.empty()) observer->reached(*running_, result.reached);
      observer->missed(*running_, result.missing);
    }
    warnings_ = std::move(result.warnings);
    device_.add(result.statistics);
    return std::move(result.status);
  }

  Device& device_;
  const runtime::Command* running_ = nullptr;
  size_t index_ = 0;
  std::optional<uint32_t> indirect_;  // which dispatch of an ExecuteIndirect is running
  std::vector<std::string> events_;
  // Warnings of the running dispatch. They come after what checked mode reports, which knows the
  // cause.
  std::vector<DispatchResult::Warning> warnings_;
};

rtapi::Status Executor::run(const runtime::Command& command) {
  running_ = &command;
  auto status = device_.observe(command, label(runtime::command_name(command)));
  if (status) status = std::visit(*this, command);
  if (auto* observer = device_.context().observer) {
    if (status && observer->needs_memory_after(command)) status = device_.stream().flush();
    observer->after(command, status.ok());
  }
  for (const auto& warning : std::exchange(warnings_, {})) device_.warn(warning.id, warning.text);
  return status;
}

rtapi::Status Executor::operator()(const runtime::ExecuteIndirectCommand& command) {
  // Earlier commands may write the arguments.
  if (auto s = device_.stream().flush(); !s) return s;
  const std::string name = label("ExecuteIndirect");
  const auto run_one = [&](const runtime::Command& dispatch, uint32_t index) {
    indirect_ = index;
    auto status = run(dispatch);
    indirect_.reset();
    return status;
  };
  return runtime::execute_indirect(*device_.context().addresses, command, name, run_one);
}

rtapi::Status Executor::operator()(const runtime::CopyBufferCommand& command) {
  if (command.size_bytes == 0) return {};
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
  auto commands = stream.record(label("CopyBufferRegion"));
  if (!commands) return commands.error();
  const GpuBuffer& source = gpu_buffer_of(*command.source);
  const GpuBuffer& dest = gpu_buffer_of(*command.dest);
  const VkBufferCopy region = {source.offset() + from, dest.offset() + to, command.size_bytes};
  device_.gpu().vk().vkCmdCopyBuffer(*commands, source.handle(), dest.handle(), 1, &region);
  return {};
}

}  // namespace

rtapi::Status Device::observe(const runtime::Command& command, const std::string& label) {
  runtime::CommandObserver* observer = context_.observer;
  if (observer == nullptr) return {};
  if (observer->needs_memory(command)) {
    if (auto s = stream_->flush(); !s) return s;
  }
  observer->before(command, label);
  return {};
}

rtapi::Status Device::execute(std::span<const runtime::Command> commands) {
  Executor executor(*this);
  for (const runtime::Command& command : commands) {
    auto s = executor.run(command);
    if (!s) {
      // Earlier recorded work uses objects that may be freed after this.
      if (auto rest = stream_->flush(); !rest) return rest;
      return s;
    }
    executor.next();
  }
  if (auto s = stream_->flush(); !s) return s;
  return validation_status();
}

}  // namespace kaamos::vulkan
