// SPDX-License-Identifier: MIT
#include "runtime/backend/indirect.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "runtime/backend/backend.h"
#include "runtime/backend/dispatch_checks.h"
#include "runtime/backend/errors.h"

namespace kaamos::runtime {
namespace {

rtapi::Error refused(const std::string& text) {
  return make_error(Id::kIndirectArguments, text);
}

class Reader {
 public:
  Reader(const AddressMap& addresses, const ExecuteIndirectCommand& command,
         const std::string& label)
      : addresses_(addresses), command_(command), layout_(*command.layout), label_(label) {}

  rtapi::Status run(const RunIndirect& run);

 private:
  const uint8_t* arguments(uint32_t index) const {
    return command_.arguments->host() + command_.arguments_offset +
           uint64_t{index} * layout_.stride_bytes;
  }
  uint32_t count() const;
  bool launches_nothing(uint32_t index) const;
  rtapi::Result<RootBindings> state(uint32_t index) const;
  rtapi::Result<Command> dispatch(uint32_t index) const;
  rtapi::Result<Command> draw(uint32_t index) const;
  rtapi::Status take_views(uint32_t index, DrawState& state) const;
  bool draws() const {
    return layout_.work == IndirectWork::kDraw || layout_.work == IndirectWork::kDrawIndexed;
  }
  rtapi::Error problem(uint32_t index, const std::string& text) const;

  const AddressMap& addresses_;
  const ExecuteIndirectCommand& command_;
  const IndirectLayout& layout_;
  const std::string& label_;
};

rtapi::Error Reader::problem(uint32_t index, const std::string& text) const {
  const uint64_t address = command_.arguments->address() + command_.arguments_offset +
                           uint64_t{index} * layout_.stride_bytes;
  return refused(text + " (" + indirect_label("indirect command", index, label_) +
                 "; its arguments start at " + describe_address(addresses_, address) + ")");
}

// Clamped to the number of commands that the application gave. [D3D12: ExecuteIndirect]
uint32_t Reader::count() const {
  if (command_.count == nullptr) return command_.max_count;
  uint32_t count;
  std::memcpy(&count, command_.count->host() + command_.count_offset, sizeof(count));
  return std::min(count, command_.max_count);
}

// If so, the rest of the command does not matter: a shader that drops it may write only zeros.
bool Reader::launches_nothing(uint32_t index) const {
  const uint8_t* source = arguments(index) + layout_.work_offset;
  if (layout_.work == IndirectWork::kDispatchRays) {
    source += offsetof(rtapi::DispatchRaysDesc, Width);
  }
  uint32_t size[3];
  std::memcpy(size, source, sizeof(size));
  return size[0] == 0 || size[1] == 0 || (!draws() && size[2] == 0);
}

rtapi::Result<RootBindings> Reader::state(uint32_t index) const {
  RootBindings state = command_.state;
  if (layout_.root_arguments.empty()) return state;
  auto values = std::make_shared<RootArguments>(*command_.state.root_arguments);
  for (const IndirectArgument& argument : layout_.root_arguments) {
    if (uint64_t{argument.dest_offset} + argument.size_bytes > kRootArgumentBytes) continue;
    uint8_t* dest = values->bytes.data() + argument.dest_offset;
    std::memcpy(dest, arguments(index) + argument.source_offset, argument.size_bytes);
    if (argument.root_parameter < 64)
      state.set_parameters |= uint64_t{1} << argument.root_parameter;
    if (argument.view_alignment == 0) continue;
    uint64_t address;
    std::memcpy(&address, dest, sizeof(address));
    if (address == 0) continue;  // a null view
    if (address % argument.view_alignment != 0 || addresses_.bytes_from(address) == 0) {
      return problem(index, "root parameter " + std::to_string(argument.root_parameter) + " is " +
                                describe_address(addresses_, address) +
                                "; it must be in a live buffer, at a multiple of " +
                                std::to_string(argument.view_alignment));
    }
  }
  state.root_arguments = std::move(values);
  return state;
}

rtapi::Result<Command> Reader::dispatch(uint32_t index) const {
  auto given = state(index);
  if (!given) return given.error();
  const uint8_t* source = arguments(index) + layout_.work_offset;
  DispatchProblem found;
  Command out;
  if (layout_.work == IndirectWork::kDispatchRays) {
    DispatchRaysCommand rays;
    rays.pipeline = command_.pipeline;
    rays.state = std::move(*given);
    rays.linked = command_.linked;
    rays.pipeline_stack_bytes = command_.pipeline_stack_bytes;
    std::memcpy(&rays.desc, source, sizeof(rays.desc));
    found = check_dispatch_rays(addresses_, rays.desc);
    out.emplace<DispatchRaysCommand>(std::move(rays));
  } else {
    DispatchCommand groups;
    groups.pipeline = command_.pipeline;
    groups.state = std::move(*given);
    groups.linked = command_.linked_compute;
    std::memcpy(groups.groups, source, sizeof(groups.groups));
    found = check_dispatch(groups.groups);
    out.emplace<DispatchCommand>(std::move(groups));
  }
  if (found.fault != DispatchFault::kNone) return problem(index, found.text);
  return out;
}

// [RAS-148]
rtapi::Status Reader::take_views(uint32_t index, DrawState& state) const {
  for (const IndirectBufferView& view : layout_.buffer_views) {
    const uint8_t* source = arguments(index) + view.source_offset;
    rtapi::VertexBufferView vertices;
    rtapi::IndexBufferView indices;
    std::memcpy(&vertices, source, sizeof(vertices));
    std::memcpy(&indices, source, sizeof(indices));
    const std::string name =
        view.of_indices ? "the index buffer" : "vertex buffer " + std::to_string(view.slot);
    const uint64_t address = vertices.BufferLocation;
    if (address != 0 &&
        !addresses_.contains(address, std::max<uint64_t>(vertices.SizeInBytes, 1))) {
      return problem(index, name + " is " + std::to_string(vertices.SizeInBytes) + " bytes at " +
                                describe_address(addresses_, address) +
                                "; they must be inside one live buffer");
    }
    if (!view.of_indices) {
      constexpr uint32_t kMaxStride = 2048;
      if (vertices.StrideInBytes > kMaxStride) {
        return problem(index, name + " has a stride of " + std::to_string(vertices.StrideInBytes) +
                                  " bytes; it may be 0 to 2048");
      }
      state.vertex_buffers[view.slot] = vertices;
      continue;
    }
    const bool small = indices.Format == rtapi::Format::kR16Uint;
    if (address != 0 &&
        ((!small && indices.Format != rtapi::Format::kR32Uint) || address % (small ? 2 : 4) != 0)) {
      return problem(index, name + " has DXGI format " +
                                std::to_string(static_cast<uint32_t>(indices.Format)) +
                                " and is at " + describe_address(addresses_, address) +
                                "; it must be R16_UINT or R32_UINT, aligned to its size");
    }
    state.index_buffer = indices;
  }
  return {};
}

rtapi::Result<Command> Reader::draw(uint32_t index) const {
  auto given = state(index);
  if (!given) return given.error();
  DrawCommand draw;
  draw.pipeline = command_.pipeline;
  draw.linked = command_.linked_graphics;
  draw.bindings = std::move(*given);
  draw.state = command_.draw_state;
  if (!layout_.buffer_views.empty()) {
    auto state = std::make_shared<DrawState>(*command_.draw_state);
    if (auto s = take_views(index, *state); !s) return s.error();
    draw.state = std::move(state);
  }
  draw.indexed = layout_.work == IndirectWork::kDrawIndexed;
  const uint8_t* source = arguments(index) + layout_.work_offset;
  if (draw.indexed) {
    std::memcpy(&draw.arguments, source, sizeof(draw.arguments));
  } else {
    rtapi::DrawArguments plain;
    std::memcpy(&plain, source, sizeof(plain));
    draw.arguments = {plain.VertexCountPerInstance, plain.InstanceCount, plain.StartVertexLocation,
                      0, plain.StartInstanceLocation};
  }
  Command out;
  out.emplace<DrawCommand>(std::move(draw));
  return out;
}

rtapi::Status Reader::run(const RunIndirect& run) {
  if (command_.arguments->host() == nullptr ||
      (command_.count != nullptr && command_.count->host() == nullptr)) {
    return refused("the host cannot read the buffer; use an upload heap (" + label_ + ")");
  }
  const uint32_t commands = count();
  for (uint32_t i = 0; i < commands; ++i) {
    if (launches_nothing(i)) continue;
    auto each = draws() ? draw(i) : dispatch(i);
    if (!each) return each.error();
    if (auto s = run(*each, i); !s) return s;
  }
  return {};
}

}  // namespace

rtapi::Status execute_indirect(const AddressMap& addresses, const ExecuteIndirectCommand& command,
                               const std::string& label, const RunIndirect& run) {
  return Reader(addresses, command, label).run(run);
}

std::string indirect_label(const char* what, uint32_t index, const std::string& label) {
  return std::string(what) + " " + std::to_string(index) + " of " + label;
}

}  // namespace kaamos::runtime
