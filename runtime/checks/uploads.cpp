// SPDX-License-Identifier: MIT
#include "runtime/checks/uploads.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "runtime/backend/linked_graphics.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

uint64_t hash_of(const uint8_t* bytes, uint64_t size) {
  uint64_t hash = 0xCBF29CE484222325u;
  for (; size >= 8; size -= 8, bytes += 8) {
    uint64_t word;
    std::memcpy(&word, bytes, 8);
    hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  for (; size > 0; --size, ++bytes) hash = (hash ^ *bytes) * 0x100000001B3u;
  return hash;
}

class Reader {
 public:
  explicit Reader(const runtime::AddressMap& addresses) : addresses_(addresses) {}

  void add(uint64_t address, uint64_t size_bytes, const std::string& what) {
    const auto allocation = address == 0 ? std::nullopt : addresses_.find(address);
    if (!allocation || allocation->heap != rtapi::HeapType::kUpload) return;
    const uint64_t left = allocation->size_bytes - (address - allocation->address);
    size_bytes = std::min(size_bytes, left);
    if (!seen_.insert({address, size_bytes}).second) return;
    out.push_back({address, size_bytes, hash_of(addresses_.host(address), size_bytes), what});
  }
  void add(const runtime::DrawCommand& command, const std::string& who) {
    const runtime::DrawState& state = *command.state;
    for (const runtime::LinkedElement& element : command.linked->elements) {
      const rtapi::VertexBufferView& view = state.vertex_buffers[element.slot];
      add(view.BufferLocation, view.SizeInBytes,
          who + ": the vertex buffer of slot " + std::to_string(element.slot));
    }
    if (command.indexed) {
      add(state.index_buffer.BufferLocation, state.index_buffer.SizeInBytes,
          who + ": the index buffer");
    }
    for (const runtime::LinkedShader* shader : command.linked->shaders()) {
      add(*shader, command, who);
    }
  }

  std::vector<UploadRange> out;

 private:
  void add(const runtime::LinkedShader& shader, const runtime::DrawCommand& command,
           const std::string& who) {
    for (uint32_t i = 0; i < shader.slots.size(); ++i) {
      const shader::BindingSlot& slot = shader.slots[i];
      const shader::BindingDesc& binding = shader.library->bindings[i];
      if (slot.source != shader::SlotSource::kRootDescriptor || slot.local) continue;
      if (binding.type == shader::BindingType::kAccelerationStructure) continue;
      uint64_t address = 0;
      if (slot.argument_offset + sizeof address > runtime::kRootArgumentBytes) continue;
      std::memcpy(&address, command.bindings.root_arguments->bytes.data() + slot.argument_offset,
                  sizeof address);
      const bool constants = binding.type == shader::BindingType::kConstantBuffer;
      add(address, constants ? binding.size_bytes : UINT64_MAX,
          who + ": " + binding_name(binding) + " of " + stage_name(shader.stage) + " shader " +
              in_quotes(shader.name));
    }
  }

  const runtime::AddressMap& addresses_;
  std::set<std::pair<uint64_t, uint64_t>> seen_;
};

}  // namespace

std::vector<UploadRange> read_uploads(const runtime::AddressMap& addresses,
                                      std::span<const runtime::Command> commands) {
  Reader reader(addresses);
  uint64_t number = 0;
  for (const runtime::Command& command : commands) {
    const auto* draw = std::get_if<runtime::DrawCommand>(&command);
    if (draw == nullptr) continue;
    reader.add(*draw,
               "draw " + std::to_string(number++) + ", pipeline " + in_quotes(draw->linked->name));
  }
  return std::move(reader.out);
}

void compare_uploads(const runtime::AddressMap& addresses, Reporter& reporter,
                     std::span<const UploadRange> ranges) {
  for (const UploadRange& range : ranges) {
    if (!addresses.contains(range.address, range.size_bytes)) continue;
    if (hash_of(addresses.host(range.address), range.size_bytes) == range.hash) continue;
    reporter.report(Id::kUploadOverwritten,
                    range.what + " is " + range_name(addresses, range.address, range.size_bytes) +
                        ", whose contents changed after ExecuteCommandLists and before the draw "
                        "ran: it reads the new ones. Wait for a fence that the queue signals after "
                        "the list, or use another buffer for each frame.");
  }
}

}  // namespace kaamos::checks
