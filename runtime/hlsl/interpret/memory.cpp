// SPDX-License-Identifier: MIT
//
// Buffers: loads, stores and atomics on memory. Each scalar is bounds-checked, as in memory.h.
#include <kaamos/shader/checked.h>
#include <kaamos/shader/prelude.h>
#include <kaamos/shader/views.h>

#include <cstring>

#include "runtime/hlsl/interpret/evaluate.h"

namespace kaamos::hlsl::interpret {

namespace {

namespace memory = shader::memory;
using shader::Descriptor;
using shader::MemoryView;

template <class T>
void load_scalar(std::byte* to, const memory::Window& window, uint32_t at) {
  const T value = memory::read_scalar<T, true>(window, at);
  std::memcpy(to, &value, sizeof(value));
}
void load_scalar(std::byte* to, const memory::Window& window, uint32_t at, const Move& move) {
  if (move.is_bool) {
    load_scalar<bool>(to, window, at);
  } else if (move.bytes == 2) {
    load_scalar<uint16_t>(to, window, at);
  } else if (move.bytes == 4) {
    load_scalar<uint32_t>(to, window, at);
  } else {
    load_scalar<uint64_t>(to, window, at);
  }
}
template <class T>
void store_scalar(const std::byte* from, const memory::Window& window, uint32_t at) {
  memory::write_scalar<T, true>(window, at, read_as<T>(from));
}
void store_scalar(const std::byte* from, const memory::Window& window, uint32_t at,
                  const Move& move) {
  if (move.is_bool) {
    store_scalar<bool>(from, window, at);
  } else if (move.bytes == 2) {
    store_scalar<uint16_t>(from, window, at);
  } else if (move.bytes == 4) {
    store_scalar<uint32_t>(from, window, at);
  } else {
    store_scalar<uint64_t>(from, window, at);
  }
}

uint32_t value_bytes(const Move& move) {
  return move.is_bool ? 1 : move.bytes;
}
bool whole_run_inside(const Move& move, const memory::Window& window) {
  return !move.is_bool && window.bytes >= uint64_t{move.at} + uint64_t{move.count} * move.bytes;
}

const std::byte* load_from(const Node& node, Frame& frame, const MemoryView& view) {
  const auto offset = evaluate_as<uint32_t>(*node.operands.back(), frame);
  std::byte* out = frame.temporaries + node.slot;
  for (const Move& move : node.moves) {
    const memory::Window window = memory::window(view, (offset + move.member) & move.mask);
    std::byte* to = out + move.value;
    if (whole_run_inside(move, window)) {
      std::memcpy(to, window.base + move.at, size_t{move.count} * move.bytes);
      continue;
    }
    for (uint32_t i = 0; i < move.count; ++i) {
      load_scalar(to + i * value_bytes(move), window, move.at + i * move.bytes, move);
    }
  }
  return out;
}

void store_to(const Action& action, Frame& frame, const MemoryView& view) {
  const auto offset = evaluate_as<uint32_t>(*action.operands.back(), frame);
  const std::byte* value = evaluate(*action.value, frame);
  for (const Move& move : action.moves) {
    const memory::Window window = memory::window(view, (offset + move.member) & move.mask);
    const std::byte* from = value + move.value;
    if (whole_run_inside(move, window)) {
      std::memcpy(window.base + move.at, from, size_t{move.count} * move.bytes);
      continue;
    }
    for (uint32_t i = 0; i < move.count; ++i) {
      store_scalar(from + i * value_bytes(move), window, move.at + i * move.bytes, move);
    }
  }
}

// The buffer of an access; checked libraries check where it goes. `operands` are as in the IR.
Descriptor accessed(const std::vector<const Node*>& operands, const Access& access,
                    const ir::Location& location, uint32_t write, Frame& frame) {
  const auto buffer = evaluate_as<Descriptor>(*operands[0], frame);
  if (!frame.context->program->checked) return buffer;
  shader::Invocation& invocation = *frame.context->invocation;
  const auto first = evaluate_as<uint32_t>(*operands[1], frame);
  if (operands.size() == 2) {
    return shader::checked::access(invocation, site_of(location), buffer, first, access.bytes,
                                   access.alignment, write);
  }
  return shader::checked::access_element(invocation, site_of(location), buffer, first,
                                         evaluate_as<uint32_t>(*operands[2], frame), access.bytes,
                                         access.alignment, write);
}

const std::byte* load(const Node& node, Frame& frame) {
  const Descriptor buffer = accessed(node.operands, node.access, node.expr->location, 0, frame);
  return load_from(node, frame, shader::memory_view(buffer));
}
const std::byte* load_element(const Node& node, Frame& frame) {
  const Descriptor buffer = accessed(node.operands, node.access, node.expr->location, 0, frame);
  return load_from(node, frame,
                   shader::element_view(buffer, evaluate_as<uint32_t>(*node.operands[1], frame)));
}

template <class T>
void* memory_place(const Action& action, Frame& frame) {
  const Descriptor buffer =
      accessed(action.operands, action.access, action.stmt->location, 2, frame);
  const auto first = evaluate_as<uint32_t>(*action.operands[1], frame);
  if (action.stmt->target == ir::AtomicTarget::kMemory) {
    return shader::memory_address<T>(buffer, first);
  }
  return shader::element_address<T>(buffer, first,
                                    evaluate_as<uint32_t>(*action.operands[2], frame));
}

void* atomic_place(const Action& action, Frame& frame) {
  switch (action.stmt->target) {
    case ir::AtomicTarget::kPlace:
      return action.place->locate(*action.place, frame);
    case ir::AtomicTarget::kTyped:
      return typed_place(action, frame);
    case ir::AtomicTarget::kCounter:
      return shader::counter(evaluate_as<Descriptor>(*action.operands[0], frame));
    default:
      return action.value->bytes == 8 ? memory_place<uint64_t>(action, frame)
                                      : memory_place<uint32_t>(action, frame);
  }
}

}  // namespace

Evaluate evaluate_load() {
  return load;
}
Evaluate evaluate_load_element() {
  return load_element;
}

void store(const Action& action, Frame& frame) {
  const Descriptor buffer =
      accessed(action.operands, action.access, action.stmt->location, 1, frame);
  store_to(action, frame, shader::memory_view(buffer));
}
void store_element(const Action& action, Frame& frame) {
  const Descriptor buffer =
      accessed(action.operands, action.access, action.stmt->location, 1, frame);
  const auto index = evaluate_as<uint32_t>(*action.operands[1], frame);
  store_to(action, frame, shader::element_view(buffer, index));
}

void run_atomic(const Action& action, Frame& frame) {
  void* place = atomic_place(action, frame);
  const std::byte* value = evaluate(*action.value, frame);
  const std::byte* compare = action.compare != nullptr ? evaluate(*action.compare, frame) : nullptr;
  std::byte* result =
      action.result != nullptr ? action.result->locate(*action.result, frame) : nullptr;
  action.atomic(place, compare, value, result);
}

}  // namespace kaamos::hlsl::interpret
