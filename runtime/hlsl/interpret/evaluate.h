// SPDX-License-Identifier: MIT
//
// The functions that evaluate each kind of node. compile.cpp picks one of these for each
// expression.
#pragma once

#include "runtime/hlsl/interpret/program.h"

namespace kaamos::hlsl::interpret {

// evaluate.cpp
Evaluate evaluate_data();  // node.data: literals
Evaluate evaluate_zero();
// Variables: node.offset bytes from the start of their storage. With `reference`, a pointer is
// stored there.
void make_variable(Node& node, ir::Storage storage, bool reference);
Evaluate evaluate_member();  // field, component: node.offset bytes into the operand
Locate locate_member();
Evaluate evaluate_element();  // operand[index]: node.length elements, node.stride bytes apart
Locate locate_element();
Evaluate evaluate_gather();       // node.components of the operand, node.stride bytes each
Evaluate evaluate_construct();    // operands at node.offsets
Evaluate evaluate_kernel();       // node.kernel on up to 3 operands
Evaluate evaluate_conditional();  // the chosen operand only
Evaluate evaluate_logical_and();
Evaluate evaluate_logical_or();
Evaluate evaluate_system_value();
Evaluate evaluate_query_value();
Evaluate evaluate_same_bytes();
Evaluate evaluate_record_constant();
Evaluate evaluate_triangle_positions();
Evaluate evaluate_cluster_id();
Evaluate evaluate_binding();
Evaluate evaluate_heap_resource();
Evaluate evaluate_print_buffer();

// memory.cpp
Evaluate evaluate_load();
Evaluate evaluate_load_element();
void store(const Action& action, Frame& frame);
void store_element(const Action& action, Frame& frame);
void run_atomic(const Action& action, Frame& frame);

// textures.cpp
Evaluate evaluate_typed_load();
Evaluate evaluate_sample();
Evaluate evaluate_dimensions();
void typed_store(const Action& action, Frame& frame);
// The target of an atomic on a typed buffer or a texture; null if out of bounds.
void* typed_place(const Action& action, Frame& frame);

}  // namespace kaamos::hlsl::interpret
