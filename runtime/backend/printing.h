// SPDX-License-Identifier: MIT
//
// What shaders printed: the device's print buffer, and the messages made of it.
// [kaamos/shader/printing.h]
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/message.h>

#include "runtime/backend/commands.h"
#include "runtime/backend/linked_graphics.h"
#include "runtime/backend/linked_pipeline.h"
#include "runtime/backend/root_bindings.h"

namespace kaamos::runtime {

inline constexpr uint64_t kPrintBufferBytes = uint64_t{4} << 20;

// The print buffer as shaders see it; null if the device has none.
shader::Descriptor view_of_prints(const RootBindings& state);

// Makes a buffer ready for the next command. `thread`: only that one prints; none: all do.
void clear_prints(BackendBuffer& buffer, const std::optional<std::array<uint32_t, 3>>& thread);

// The libraries of a pipeline's shaders that print.
using PrintingLibraries = std::vector<const shader::LibraryDesc*>;
PrintingLibraries printing_libraries(const LinkedPipeline& pipeline);
PrintingLibraries printing_libraries(const LinkedCompute& pipeline);
PrintingLibraries printing_libraries(const LinkedGraphics& pipeline);

// The buffer that a command prints to, and the libraries of its shaders; null: it does not print.
struct Printed {
  BackendBuffer* buffer = nullptr;
  PrintingLibraries libraries;
};
Printed printed_by(const Command& command);

// Tells what the shaders of a command printed, thread by thread (z, then y, then x) and in order
// within each, and empties the buffer. KA0845 printf, KA0846 errorf, KA0847 what found no room.
void tell_prints(const Printed& printed, const std::string& label,
                 const std::function<void(const rtapi::Message&)>& tell);

// The text of one record: `values` as kaamos/shader/printing.h lays them out.
std::string print_text(const shader::PrintDesc& print, const uint8_t* values, size_t bytes);

}  // namespace kaamos::runtime
