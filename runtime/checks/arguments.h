// SPDX-License-Identifier: MIT
//
// Do the root arguments, global or of a record, point at something of the right kind?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/checks/table_proof.h"

namespace kaamos::checks {

// The places where the arguments of a shader are found.
struct Arguments {
  const uint8_t* global = nullptr;               // kRootArgumentBytes
  const uint8_t* local = nullptr;                // null: no record
  uint64_t local_bytes = 0;                      // how many of them are readable
  const runtime::RootBindings* state = nullptr;  // the heaps
};

// Reports what is wrong with the arguments that `shader` uses; `where` is the record, for the
// message, with the shader's name. True if nothing is.
bool check_arguments(const ProofInputs& inputs, const runtime::LinkedShader& shader,
                     const Arguments& arguments, const std::string& where);

// The addresses of the acceleration structures behind a binding of `shader`; 0 for null ones. Skips
// descriptors outside the heap and those of other kinds.
std::vector<uint64_t> structures_behind(const runtime::LinkedShader& shader, uint32_t binding,
                                        const Arguments& arguments);

// Collects the single buffers and structures that the shader's arguments point to.
void collect_uses(const runtime::LinkedShader& shader, const Arguments& arguments,
                  const std::string& shader_name, std::vector<ShaderUse>& uses);

}  // namespace kaamos::checks
