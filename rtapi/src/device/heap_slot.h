// SPDX-License-Identifier: MIT
//
// Slots of descriptor heaps, and what a handle of one points at.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <kaamos/shader/abi.h>
#include <rtapi/descriptor.h>

#include "runtime/backend/draw_commands.h"

namespace rtapi::detail {

namespace shader = kaamos::shader;

struct TextureImpl;

// A render target or depth-stencil descriptor. Only the host reads it, when a call is recorded.
struct TargetSlot {
  std::weak_ptr<TextureImpl> texture;  // a descriptor keeps nothing alive
  kaamos::runtime::TargetView view;    // its texture is null
  bool written = false;
  bool is_null = false;  // a null descriptor: draws to it are dropped
  std::string texture_name = {};
};

// The heap slot that a CPU or GPU descriptor handle points at.
struct HeapSlot {
  DescriptorHeapType type = DescriptorHeapType::kCbvSrvUav;
  bool shader_visible = false;
  shader::Descriptor* slot = nullptr;  // null in heaps of targets
  TargetSlot* target = nullptr;        // null in other heaps
  uint32_t index = 0;
  uint32_t count_from_here = 0;
  std::string heap_name = {};
};

// Returns " is in a sampler heap", or that it is in no live heap: the middle of an error's text.
std::string describe_heap(const std::optional<HeapSlot>& slot);

}  // namespace rtapi::detail
