// SPDX-License-Identifier: MIT
//
// Root arguments, global or of a record: do they point at something of the right kind.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/checks/table_proof.h"

namespace kaamos::checks {

// Where the arguments of a shader stand.
struct Arguments {
  const uint8_t* global = nullptr;                // kRootArgumentBytes
  const uint8_t* local = nullptr;                 // null: no record
  uint64_t local_bytes = 0;                       // readable ones
  const runtime::DispatchState* state = nullptr;  // the heaps
};

// Reports what is wrong with the arguments that `shader` uses; `where` is the record, for the
// message, with the shader's name. True if nothing is.
bool check_arguments(const ProofInputs& inputs, const runtime::LinkedShader& shader,
                     const Arguments& arguments, const std::string& where);

// The addresses of the acceleration structures behind a binding of `shader`; 0 for null ones.
// Descriptors outside the heap and of other kinds are left out.
std::vector<uint64_t> structures_behind(const runtime::LinkedShader& shader, uint32_t binding,
                                        const Arguments& arguments);

// What single buffers and structures the shader's arguments name.
void collect_uses(const runtime::LinkedShader& shader, const Arguments& arguments,
                  const std::string& shader_name, std::vector<ShaderUse>& uses);

}  // namespace kaamos::checks
