// SPDX-License-Identifier: MIT
//
// The program that a module is turned into before it runs: variables are byte offsets, expressions
// are nodes that know how to evaluate themselves, statements refer to nodes. A program is immutable
// while it runs, so several threads can run it at once; everything that changes is in Frame and
// Context on the thread's stack. Neither owns memory, because a backend leaves a failing shader by
// a jump.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/analysis/wave_paths.h"
#include "runtime/hlsl/interpret/interpret.h"
#include "runtime/hlsl/ir/host_layout.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::interpret {

struct Program;
struct Node;

struct Context {
  shader::Invocation* invocation = nullptr;
  shader::ComputeGroup* group = nullptr;
  const Program* program = nullptr;
  const ir::EntryPoint* entry = nullptr;
  std::byte* shared = nullptr;
  std::byte* statics = nullptr;
  std::byte* outputs = nullptr;  // of a vertex or pixel shader
  bool* stays_live = nullptr;    // of a pixel shader: whether it did not discard
  shader::GeometryStream* stream = nullptr;
  uint64_t steps_left = 0;
  uint32_t* path = nullptr;  // for wave operations
  uint32_t path_depth = 0;   // where the running function's part of it begins
  bool ended = false;
  shader::AnyHitResult any_hit = shader::AnyHitResult::kAccept;
};

struct Frame {
  Context* context = nullptr;
  std::byte* variables = nullptr;
  std::byte* temporaries = nullptr;  // results of the expressions of one statement
  std::byte* result = nullptr;  // where `return` puts the value; null: unused, or already there
};

// Returns the value, which stays valid until the next statement and may be a variable's own
// storage.
using Evaluate = const std::byte* (*)(const Node& node, Frame& frame);
// Returns where a value can be written to, or null if that is out of range and the write is
// dropped.
using Locate = std::byte* (*)(const Node& node, Frame& frame);
// Computes a value from its operands' values.
using Kernel = void (*)(const Node& node, std::byte* out, const std::byte* const* operands);

struct Node {
  Evaluate evaluate = nullptr;
  Locate locate = nullptr;
  Kernel kernel = nullptr;
  const ir::Expr* expr = nullptr;
  std::vector<const Node*> operands;
  uint32_t slot = 0;    // of the result among the temporaries
  uint32_t bytes = 0;   // of the value
  uint32_t offset = 0;  // of a variable, a field or a swizzle of one component
  uint32_t count = 0;   // components
  uint32_t length = 0;  // number of elements of the indexed operand
  uint32_t stride = 0;  // bytes from one component or element to the next
  uint8_t rows = 1;     // mul: rows of the left, common size, columns of the right operand
  uint8_t inner = 1;
  uint8_t columns = 1;
  std::vector<uint8_t> components;  // result component i is operand component components[i]
  std::vector<uint32_t> offsets;    // construct: one for each part
  const std::byte* data = nullptr;  // literals, constants
  std::vector<Move> moves;          // loads
  Access access;                    // loads, in checked libraries
};

// An atomic operation on a place; `place` and `result` may be null.
using Atomic = void (*)(void* place, const std::byte* compare, const std::byte* value,
                        std::byte* result);

struct Action;
using Actions = std::vector<const Action*>;
struct Code;

struct ActionCase {
  std::vector<int64_t> labels;
  bool is_default = false;
  Actions body;
};

struct Action {
  const ir::Stmt* stmt = nullptr;
  const Node* place = nullptr;
  const Node* value = nullptr;
  const Node* compare = nullptr;
  const Node* result = nullptr;  // the variable
  std::vector<const Node*> operands;
  std::vector<const Node*> arguments;
  const Code* callee = nullptr;
  uint32_t offset = 0;  // kDeclare: of the variable
  uint32_t bytes = 0;
  Actions prelude;
  Actions body;
  Actions orelse;
  Actions step;
  std::vector<ActionCase> cases;
  std::vector<Move> moves;  // stores
  Access access;            // stores and atomics, in checked libraries
  Atomic atomic = nullptr;
  const WavePlace* place_in_wave = nullptr;  // null: not in the path of any wave operation
};

struct Code {
  const ir::Function* function = nullptr;
  std::vector<uint32_t> parameters;       // offsets of the values, or of pointers to them
  std::vector<uint32_t> parameter_bytes;  // of the values
  Actions body;
  uint32_t variable_bytes = 0;
  uint32_t temporary_bytes = 0;
  uint32_t result_bytes = 0;
  uint32_t stack_bytes = 0;                  // including everything that it calls
  std::vector<const ir::Variable*> statics;  // touched by it or a callee, in the module's order
  bool reads_hit_kind = false;               // it or a callee reads it
};

struct StaticInitialiser {
  const Node* value = nullptr;  // null: zero
  uint32_t offset = 0;
  uint32_t bytes = 0;
};

// The code of an entry point, and what is set up before its body runs.
struct EntryCode {
  const ir::EntryPoint* entry = nullptr;
  const Code* code = nullptr;
  uint32_t payload_bytes = 0;
  std::vector<StaticInitialiser> statics;
  uint32_t temporary_bytes = 0;  // of the initialisers
  uint32_t static_bytes = 0;
  uint32_t path_words = 0;
  std::vector<uint32_t> output_offsets;  // by parameter; those of others are not used
  uint32_t output_bytes = 0;
};

struct Program {
  std::shared_ptr<const ir::Module> module;
  std::unique_ptr<WavePaths> wave_paths;
  InterpretOptions options;
  std::deque<Node> nodes;
  std::deque<Action> actions;
  std::deque<Code> codes;
  std::deque<EntryCode> entries;                 // as Module::entry_points
  Layouts layouts;                               // used while the program is made
  std::deque<std::vector<std::byte>> constants;  // literals, constants
  std::vector<std::byte> zeros;                  // as long as the longest value
  uint32_t static_bytes = 0;
  uint32_t shared_bytes = 0;
  std::string error;                   // set if a module breaks the rules of the IR
  bool checked = false;                // Module::check_access
  std::unique_ptr<uint8_t[]> covered;  // by Module::coverage: 1 once it ran
};

// compile.cpp
std::unique_ptr<Program> make_program(std::shared_ptr<const ir::Module> module,
                                      const InterpretOptions& options);

// run.cpp: the stages' entry points. attributes and payload are null if the stage has
// none. Returns the any-hit shader's decision.
shader::AnyHitResult run_ray_entry(const Program& program, const EntryCode& entry,
                                   shader::Invocation& invocation, void* payload,
                                   const void* attributes);
void run_compute_thread(const Program& program, const EntryCode& entry,
                        shader::Invocation& invocation, shader::ComputeGroup& group,
                        const uint32_t thread[3]);

// `lane` of the columns. A pixel's helper runs only where derivatives need it.
void run_vertex(const Program& program, const EntryCode& entry, shader::Invocation& invocation,
                const shader::VertexLanes& lanes, uint32_t lane);
void run_geometry(const Program& program, const EntryCode& entry, shader::Invocation& invocation,
                  const shader::GeometryInputs& inputs, shader::GeometryStream& stream);
void run_pixel(const Program& program, const EntryCode& entry, shader::Invocation& invocation,
               shader::PixelLanes& lanes, shader::ComputeGroup* group, uint32_t lane);

// Calls the hook, if there is one.
void report(Context& context, InterpretFinding finding, const ir::Location& location);

// waves.cpp: the word of a call, the counter of a loop's iterations (null if no wave operation is
// in it), the operation.
void enter_path(const Action& action, Context& context);
uint32_t* iteration_in_path(const Action& loop, Context& context);
void run_wave(const Action& action, Frame& frame);

// statements.cpp: runs a function whose parameters are already in place.
void run_body(const Code& code, Frame& frame);

inline const std::byte* evaluate(const Node& node, Frame& frame) {
  return node.evaluate(node, frame);
}
template <class T>
T read_as(const std::byte* bytes) {
  T value;
  __builtin_memcpy(&value, bytes, sizeof(value));
  return value;
}
template <class T>
T evaluate_as(const Node& node, Frame& frame) {
  return read_as<T>(node.evaluate(node, frame));
}

}  // namespace kaamos::hlsl::interpret
