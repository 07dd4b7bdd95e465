// SPDX-License-Identifier: MIT
#include "runtime/checks/vertex_inputs.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "runtime/backend/linked_graphics.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

using rtapi::IndexBufferStripCutValue;
using runtime::LinkedElement;

std::string number(uint64_t value) {
  return std::to_string(value);
}

class InputCheck {
 public:
  InputCheck(const runtime::AddressMap& addresses, Reporter& reporter,
             const runtime::DrawCommand& command, const std::string& who)
      : addresses_(addresses),
        reporter_(reporter),
        command_(command),
        linked_(*command.linked),
        state_(*command.state),
        who_(who) {}

  void run() {
    if (command_.indexed) check_cut();
    if (command_.indexed) read_indices();
    for (const LinkedElement& element : linked_.elements) check(element);
  }

 private:
  void report(Id id, const std::string& text) { reporter_.report(id, who_ + ": " + text); }
  std::optional<uint32_t> cut() const {
    if (!runtime::is_strip(state_.topology)) return std::nullopt;
    switch (linked_.strip_cut) {
      case IndexBufferStripCutValue::k0xFFFF:
        return 0xFFFFu;
      case IndexBufferStripCutValue::k0xFFFFFFFF:
        return 0xFFFFFFFFu;
      default:
        return std::nullopt;
    }
  }

  void check_cut() {
    if (linked_.strip_cut == IndexBufferStripCutValue::kDisabled) return;
    const bool small_cut = linked_.strip_cut == IndexBufferStripCutValue::k0xFFFF;
    const char* name = small_cut ? "k0xFFFF" : "k0xFFFFFFFF";
    if (!cut()) {
      return report(Id::kStripCut, std::string("IBStripCutValue is ") + name +
                                       ", but the topology is a list, which nothing cuts. "
                                       "Set it to kDisabled, or draw a strip.");
    }
    const bool small = state_.index_buffer.Format == rtapi::Format::kR16Uint;
    if (state_.index_buffer.BufferLocation == 0 || small == small_cut) return;
    report(Id::kStripCut,
           std::string("IBStripCutValue is ") + name + ", but indices are " +
               (small ? "R16_UINT, of which none has this value: nothing cuts the strip"
                      : "R32_UINT: index 65535 cuts the strip, 0xFFFFFFFF does not") +
               ". Use " + (small ? "k0xFFFF" : "k0xFFFFFFFF") + " with these indices.");
  }

  void read_indices() {
    const rtapi::IndexBufferView& view = state_.index_buffer;
    const uint64_t first = command_.arguments.StartIndexLocation;
    const uint64_t count = command_.arguments.IndexCountPerInstance;
    if (view.BufferLocation == 0) {
      report(Id::kIndexOutOfBounds, "no index buffer is set, so that all " + number(count) +
                                        " indices are 0. Call IASetIndexBuffer.");
      return;
    }
    const uint32_t bytes = view.Format == rtapi::Format::kR16Uint ? 2 : 4;
    const uint64_t held = view.SizeInBytes / bytes;
    if (first + count > held) {
      report(Id::kIndexOutOfBounds,
             "indices " + number(first) + ".." + number(first + count) +
                 " are used, but the view has " + number(held) + " (" +
                 range_name(addresses_, view.BufferLocation, view.SizeInBytes) +
                 "); those beyond read 0. Is SizeInBytes in bytes, and the format right?");
    }
    if (!addresses_.contains(view.BufferLocation, std::max<uint64_t>(view.SizeInBytes, 1))) return;
    const uint8_t* data = addresses_.host(view.BufferLocation);
    const auto skipped = cut();
    for (uint64_t i = first; i < std::min(first + count, held); ++i) {
      uint32_t index = 0;
      std::memcpy(&index, data + i * bytes, bytes);
      if (skipped && index == *skipped) continue;
      indices_.push_back({i, index});
    }
  }

  std::string view_name(const LinkedElement& element) const {
    const rtapi::VertexBufferView& view = state_.vertex_buffers[element.slot];
    return "slot " + number(element.slot) + " is " +
           range_name(addresses_, view.BufferLocation, view.SizeInBytes) + ", stride " +
           number(view.StrideInBytes);
  }

  void check(const LinkedElement& element) {
    const rtapi::VertexBufferView& view = state_.vertex_buffers[element.slot];
    if (view.BufferLocation == 0) {
      report(Id::kVertexSlotUnbound,
             "the vertex shader reads slot " + number(element.slot) +
                 ", which has no vertex buffer; it reads 0. Call IASetVertexBuffers for it.");
      return;
    }
    const rtapi::FormatInfo format = rtapi::GetFormatInfo(element.format);
    const uint64_t component =
        format.channel_bits == 0 ? 4 : std::min<uint64_t>(4, std::max(1, format.channel_bits / 8));
    const uint64_t misaligned =
        (view.BufferLocation | view.StrideInBytes | element.offset_bytes) % component;
    if (misaligned != 0) {
      report(Id::kVertexLayout,
             view_name(element) + ", and the element at byte " + number(element.offset_bytes) +
                 " of a vertex has components of " + number(component) +
                 " bytes; address, stride and offset must be multiples of that.");
    }
    const rtapi::DrawIndexedArguments& arguments = command_.arguments;
    const bool several = element.per_instance
                             ? arguments.InstanceCount > 1 && element.step_rate != 0
                             : arguments.IndexCountPerInstance > 1;
    if (view.StrideInBytes == 0 && several) {
      report(Id::kVertexStride, view_name(element) +
                                    ": every vertex reads the first element. Pass the size of a "
                                    "vertex as StrideInBytes, if that is not meant.");
    }
    check_bounds(element, view, format.bytes);
  }

  bool inside(const LinkedElement& element, const rtapi::VertexBufferView& view, uint64_t bytes,
              uint32_t vertex) const {
    const uint64_t end = uint64_t{vertex} * view.StrideInBytes + element.offset_bytes + bytes;
    return end <= view.SizeInBytes;
  }

  void check_bounds(const LinkedElement& element, const rtapi::VertexBufferView& view,
                    uint64_t bytes) {
    const rtapi::DrawIndexedArguments& arguments = command_.arguments;
    const auto outside = [&](const std::string& what, uint32_t vertex, uint64_t count,
                             uint64_t total) {
      const uint64_t end = uint64_t{vertex} * view.StrideInBytes + element.offset_bytes + bytes;
      const uint64_t least = element.offset_bytes + bytes;
      const uint64_t held = view.StrideInBytes == 0 || view.SizeInBytes < least
                                ? 0
                                : (view.SizeInBytes - least) / view.StrideInBytes + 1;
      report(Id::kVertexOutOfBounds,
             what + " ends at byte " + number(end) + " of slot " + number(element.slot) + ", but " +
                 view_name(element) + ": room for " + number(held) + "; " + number(count) + " of " +
                 number(total) +
                 " are outside and read 0. Check the indices, the stride and SizeInBytes.");
    };
    if (element.per_instance) {
      const uint32_t step =
          element.step_rate == 0 ? 0 : (arguments.InstanceCount - 1) / element.step_rate;
      const uint32_t last = arguments.StartInstanceLocation + step;
      if (inside(element, view, bytes, last)) return;
      uint32_t first = arguments.StartInstanceLocation;
      while (inside(element, view, bytes, first)) ++first;
      return outside("element " + number(first) + " of instance data", first, last - first + 1,
                     uint64_t{step} + 1);
    }
    if (!command_.indexed) {
      const uint64_t begin = arguments.StartIndexLocation;
      const uint64_t end = begin + arguments.IndexCountPerInstance;
      if (inside(element, view, bytes, static_cast<uint32_t>(end - 1))) return;
      uint64_t first = begin;
      while (first < end && inside(element, view, bytes, static_cast<uint32_t>(first))) ++first;
      return outside("vertex " + number(first), static_cast<uint32_t>(first), end - first,
                     end - begin);
    }
    uint64_t count = 0;
    std::string what;
    uint32_t first = 0;
    for (const auto& [position, index] : indices_) {
      const uint32_t vertex = index + static_cast<uint32_t>(arguments.BaseVertexLocation);
      if (inside(element, view, bytes, vertex)) continue;
      if (count++ != 0) continue;
      first = vertex;
      what = "index " + number(index) + " (number " + number(position) + " of the buffer)";
      if (arguments.BaseVertexLocation != 0) {
        what += " + BaseVertexLocation " + std::to_string(arguments.BaseVertexLocation);
      }
      what += " is vertex " + number(vertex) + ", which";
    }
    if (count != 0) outside(what, first, count, indices_.size());
  }

  const runtime::AddressMap& addresses_;
  Reporter& reporter_;
  const runtime::DrawCommand& command_;
  const runtime::LinkedGraphics& linked_;
  const runtime::DrawState& state_;
  const std::string& who_;
  struct Index {
    uint64_t position;
    uint32_t index;
  };
  std::vector<Index> indices_;  // of the draw, without cuts
};

}  // namespace

void check_vertex_inputs(const runtime::AddressMap& addresses, Reporter& reporter,
                         const runtime::DrawCommand& command, const std::string& who) {
  InputCheck(addresses, reporter, command, who).run();
}

}  // namespace kaamos::checks
