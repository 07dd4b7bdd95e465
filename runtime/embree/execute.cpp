// SPDX-License-Identifier: MIT
//
// Runs the command stream, one command after another. Nothing overlaps, so barriers have nothing to
// do.
#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "runtime/backend/indirect.h"
#include "runtime/embree/acceleration_structure.h"
#include "runtime/embree/device.h"
#include "runtime/embree/texture.h"

namespace kaamos::embree {
namespace {

class Executor {
 public:
  explicit Executor(Device& device) : device_(device) {}

  rtapi::Status operator()(const runtime::DispatchRaysCommand& command) {
    if (auto s = complete_top_levels(device_); !s) return s;
    return finish(dispatch_rays(device_.dispatch_environment(), command, label("DispatchRays")));
  }
  rtapi::Status operator()(const runtime::DispatchCommand& command) {
    if (auto s = complete_top_levels(device_); !s) return s;
    return finish(dispatch_compute(device_.dispatch_environment(), command, label("Dispatch")));
  }
  rtapi::Status operator()(const runtime::ExecuteIndirectCommand& command);
  rtapi::Status operator()(const runtime::BuildCommand& command) { return build(device_, command); }
  rtapi::Status operator()(const runtime::EmitPostbuildInfoCommand& command) {
    return runtime::emit_postbuild_info(device_.structure_environment(), command.desc,
                                        command.sources);
  }
  rtapi::Status operator()(const runtime::CopyAccelerationStructureCommand& command) {
    return copy(device_, command);
  }
  rtapi::Status operator()(const runtime::CopyBufferCommand& command);
  rtapi::Status operator()(const runtime::CopyTextureCommand& command);
  rtapi::Status operator()(const runtime::ClearUavCommand& command);
  rtapi::Status operator()(const runtime::BarrierCommand&) { return {}; }
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
  rtapi::Status finish(DispatchResult result);

  Device& device_;
  const runtime::Command* running_ = nullptr;
  size_t index_ = 0;
  std::optional<uint32_t> indirect_;  // which dispatch of an ExecuteIndirect is running
  std::vector<std::string> events_;
  // Warnings of the running dispatch. They come after what checked mode reports, which knows the
  // cause.
  std::vector<DispatchResult::Warning> warnings_;
};

rtapi::Status Executor::finish(DispatchResult result) {
  if (auto* observer = device_.context().observer) {
    if (!result.reached.empty()) observer->reached(*running_, result.reached);
    observer->missed(*running_, result.missing);
  }
  device_.add_counters(result.counters);
  warnings_ = std::move(result.warnings);
  return std::move(result.status);
}

rtapi::Status Executor::run(const runtime::Command& command) {
  running_ = &command;
  runtime::CommandObserver* observer = device_.context().observer;
  if (observer != nullptr) observer->before(command, label(runtime::command_name(command)));
  auto status = std::visit(*this, command);
  if (observer != nullptr) observer->after(command, status.ok());
  for (const auto& warning : std::exchange(warnings_, {})) device_.warn(warning.id, warning.text);
  return status;
}

rtapi::Status Executor::operator()(const runtime::ExecuteIndirectCommand& command) {
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
  device_.memory().evict(command.dest->address() + command.dest_offset, command.size_bytes);
  std::memmove(command.dest->host() + command.dest_offset,
               command.source->host() + command.source_offset, command.size_bytes);
  return {};
}

// One side of a texture copy, as rows in memory.
struct Rows {
  uint8_t* first = nullptr;
  uint64_t row_pitch = 0;
  uint64_t slice_pitch = 0;
};

uint32_t texel_bytes_of(const runtime::TextureCopyPlace& place) {
  return place.texture ? static_cast<const Texture&>(*place.texture).texel_bytes() : 0;
}

Rows rows_of(const runtime::TextureCopyPlace& place, uint32_t texel_bytes) {
  if (place.texture != nullptr) {
    const auto s =
        static_cast<const Texture&>(*place.texture).subresource(place.mip, place.array_element);
    return {s.at(place.origin, texel_bytes), s.row_pitch, s.slice_pitch};
  }
  uint8_t* first = place.buffer->host() + place.offset + place.origin[2] * place.slice_pitch +
                   uint64_t{place.origin[1]} * place.row_pitch +
                   uint64_t{place.origin[0]} * texel_bytes;
  return {first, place.row_pitch, place.slice_pitch};
}

rtapi::Status Executor::operator()(const runtime::CopyTextureCommand& command) {
  const uint32_t texel_bytes =
      std::max(texel_bytes_of(command.dest), texel_bytes_of(command.source));
  const Rows dest = rows_of(command.dest, texel_bytes);
  const Rows source = rows_of(command.source, texel_bytes);
  for (uint32_t z = 0; z < command.extent[2]; ++z) {
    for (uint32_t y = 0; y < command.extent[1]; ++y) {
      std::memmove(dest.first + z * dest.slice_pitch + y * dest.row_pitch,
                   source.first + z * source.slice_pitch + y * source.row_pitch,
                   uint64_t{command.extent[0]} * texel_bytes);
    }
  }
  return {};
}

rtapi::Status Executor::operator()(const runtime::ClearUavCommand& command) {
  if (command.view.kind != shader::DescriptorKind::kTexture) {
    device_.memory().evict(command.view.address, command.view.size_bytes);
  }
  clear_view(command.view, command.is_float, command.values);
  return {};
}

}  // namespace

rtapi::Status Device::execute(std::span<const runtime::Command> commands) {
  Executor executor(*this);
  for (const runtime::Command& command : commands) {
    if (auto s = executor.run(command); !s) return s;
    executor.next();
  }
  return {};
}

}  // namespace kaamos::embree
