// SPDX-License-Identifier: MIT
//
// The GLSL emitter's state, shared by its files: types.cpp (types, literals), memory.cpp (loads and
// stores), matrices.cpp, expressions.cpp, resources.cpp (bindings, typed buffers, textures,
// atomics), statements.cpp, rays.cpp (TraceRay and related calls), queries.cpp, micromaps.cpp,
// waves.cpp, graphics.cpp (vertex and pixel shaders), hit_objects.cpp and twins.cpp (HitObject),
// system_values.cpp, emit_glsl.cpp (functions, main).
//
// Name prefixes: u_ for variables, f_ functions, s_ structs and m_ fields of the HLSL source, with
// a number added if the name is not unique; k_ for the prelude; g_ for what is generated here.
// Every name of the source has a prefix, so none can clash with a GLSL keyword.
//
// GLSL has no matrices of every scalar type and no rows: an HLSL matrix is a struct of rows, and
// its functions are generated when first used.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/glsl/emit_glsl.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Unique names of one kind, made from the names of the source.
class GlslNames {
 public:
  explicit GlslNames(std::string_view prefix) : prefix_(prefix) {}
  std::string add(std::string_view hlsl_name);
  void reserve(const std::string& name) { used_.emplace(name, 1); }

 private:
  std::string prefix_;
  std::unordered_map<std::string, int> used_;
};

class GlslEmitter {
 public:
  // `twin`: the callable twin of a hit or miss shader (twins.cpp).
  GlslEmitter(const ir::Module& module, const ir::EntryPoint& entry, bool twin = false);
  GlslShader run();

 private:
  // A place inside a variable. If an index can be out of range, a condition guards the access and
  // the index is clamped, so that the emitted expression is always in range.
  struct Path {
    std::string text;
    std::vector<std::string> guards;
    std::string guard() const;  // all guards combined
  };

  // types.cpp
  std::string type(const ir::Type* type);
  std::string matrix_name(ir::Scalar scalar, int rows, int columns);
  std::string zero(const ir::Type* type);
  std::string scalar_literal(ir::Scalar scalar, uint64_t bits);
  std::string literal(const ir::Expr& expr);
  void emit_struct(const ir::Struct* structure);
  bool is_constant(const ir::Expr& expr) const;

  // memory.cpp
  std::string memory_read(const ir::Type* type, ir::Layout layout, bool row_major,
                          const std::string& window, const std::string& at);
  std::string memory_write(const ir::Type* type, ir::Layout layout, bool row_major,
                           const std::string& window, const std::string& at,
                           const std::string& text);
  std::string read_function(const ir::Type* type, ir::Layout layout, bool row_major);
  std::string write_function(const ir::Type* type, ir::Layout layout, bool row_major);
  std::string window(const std::vector<const ir::Expr*>& operands, bool element,
                     const ir::Type* type, const std::string& access);
  std::string load(const ir::Expr& expr);
  void store(const ir::Stmt& stmt);

  // matrices.cpp
  std::string matrix_call(const std::string& function, const ir::Type* result,
                          const std::vector<const ir::Expr*>& operands);
  std::string matrix_intrinsic(const ir::Expr& expr);
  std::string matrix_construct(const ir::Expr& expr);
  std::string matrix_splat(const ir::Expr& expr);
  std::string matrix_truncate(const ir::Expr& expr);
  std::string matrix_swizzle(const ir::Expr& expr);
  std::string mul(const ir::Type* result, const ir::Type* a, const ir::Type* b);
  std::string transpose(const ir::Type* matrix);
  std::string determinant(const ir::Type* matrix);

  // expressions.cpp
  std::string value(const ir::Expr* expr);
  Path path(const ir::Expr* expr);
  std::string element_index(const ir::Expr* index, uint32_t count, Path& path);
  std::string call(std::string_view function, const std::vector<const ir::Expr*>& arguments);
  std::string construct(const ir::Expr& expr);
  std::string convert(const ir::Expr& expr);
  std::string swizzle(const ir::Expr& expr);
  std::string unary(const ir::Expr& expr);
  std::string binary(const ir::Expr& expr);
  std::string intrinsic(const ir::Expr& expr);
  // Declares a temporary before the statement that is being printed. Expressions are pure, so it
  // does not matter where they are evaluated.
  std::string hoist(const std::string& type, const std::string& text);
  std::string repeatable(const ir::Expr* expr);  // a name or a literal

  // resources.cpp
  std::string binding(const ir::Expr& expr);
  std::string binding_arguments(uint32_t binding, const std::string& index);
  // For checked libraries: CheckReport::site; the extra arguments of the checked windows; k_tell's
  // arguments.
  std::string site(const ir::Location& location) const;
  std::string access_arguments(const ir::Type* type, ir::Layout layout, bool row_major, int write,
                               const ir::Location& location) const;
  void define_check_place();
  std::string constant(uint32_t id, const std::string& name);
  std::string typed_load(const ir::Expr& expr);
  void typed_store(const ir::Stmt& stmt);
  std::string sample(const ir::Expr& expr);
  std::string dimensions(const ir::Expr& expr);
  void atomic(const ir::Stmt& stmt);
  void exchange_shared_float(const ir::Stmt& stmt);
  std::string alone_atomic(ir::AtomicOp op, const ir::Type* type);
  std::string from_texel(const ir::Type* type, const std::string& bits);
  std::string to_texel(const ir::Type* type, const std::string& text);
  std::string texel_at(const ir::Expr* coordinates);

  // statements.cpp
  void block(const ir::Block& body);
  void statement(const ir::Stmt& stmt);
  void declare(const ir::Stmt& stmt);
  void assign(const ir::Stmt& stmt);
  void call_function(const ir::Stmt& stmt);
  void return_if_ended();
  void loop(const ir::Stmt& stmt);
  void loop_condition(const ir::Stmt& stmt);
  void continue_loop();
  void switch_(const ir::Stmt& stmt);
  void barrier(uint32_t flags);
  void end_shader();

  // rays.cpp
  void declare_workarounds();
  std::string generated(const std::string& name, const std::string& text);
  std::string wire_type(const ir::Type* type);
  std::string convert_wire(const ir::Type* type, bool to_wire);
  void declare_status();
  void declare_remove_device();
  std::string count(uint32_t what);
  std::string payload_block(const char* qualifier, int location, const ir::Type* type,
                            const std::string& name);
  std::string header(const std::string& payload, const ir::Type* type) const;
  // The statements of checked code ahead of a ray; `ray` has the arguments of its RayDesc, `out` is
  // the name of its payload block.
  std::string trace_checks(const std::string& ray, const std::string& out,
                           const ir::Type* payload) const;
  std::string trace_function(const ir::Type* payload);
  void declare_top_level();
  void trace_ray(const ir::Stmt& stmt);
  std::string call_shader_function(const ir::Type* data);
  void call_shader(const ir::Stmt& stmt);
  void declare_attributes();
  bool attributes_are_floats() const;
  uint32_t attribute_words() const;
  void each_scalar(const ir::Type* type, const std::string& at,
                   const std::function<void(ir::Scalar, const std::string&)>& visit);
  std::string words_of(const ir::Type* type, const std::string& words, bool store);
  std::string attributes_function(const ir::Type* attributes, bool store);
  std::string report_function(const ir::Type* attributes);
  std::string reported_t();
  void report_hit(const ir::Stmt& stmt);

  // hit_objects.cpp
  std::string hit_type();
  std::string hit_member(uint32_t index);
  std::string with_hit(std::string text);
  void declare_twin_data();
  void declare_twin();
  std::string twin_payload(const std::string& data, const ir::Type* type, bool store);
  std::string search_function();
  std::string trace_hit_function(const ir::Type* payload);
  std::string invoke_function(const ir::Type* payload);
  std::string twin_trace_function(const ir::Type* payload);
  void invoke(const ir::Stmt& stmt);
  std::string same_bytes(const ir::Expr& expr);
  std::string record_constant(const ir::Expr& expr);

  // twins.cpp
  std::string twin_value(uint32_t index);
  std::string twin_report_function(const ir::Type* attributes);
  void begin_twin();
  void end_twin();
  std::string twin_attributes(const ir::Type* attributes);
  std::string twin_transform(bool to_world, bool transposed, const ir::Type* type);
  std::string twin_object_ray(bool origin);
  std::string twin_system_value(const ir::Expr& expr);

  // micromaps.cpp
  void declare_opacity();
  void declare_query_opacity();
  void declare_micromap_top_level();
  std::string micromaps_allowed();
  std::string ray_flags();
  std::string micromap_start();

  // waves.cpp
  std::string multi_prefix_function(shader::WaveOp op, const ir::Type* type);
  std::string match_function(const ir::Type* type);
  std::string quad_votes_function();
  std::string difference_function(shader::WaveOp op, const std::string& real);
  std::string all_equal(const ir::Expr* operand);
  std::string lone_wave(const ir::Stmt& stmt);
  std::string wave_text(const ir::Stmt& stmt);
  void wave(const ir::Stmt& stmt);
  std::string wave_extensions() const;

  // graphics.cpp
  std::string graphics_input(size_t index);
  std::string at_other_place(size_t index);
  std::string corner_inputs(size_t index);
  void emit_vertex(const ir::Stmt& stmt);
  void graphics_output(size_t index, const std::string& name);
  std::string sample_count();
  std::string converted_target(const ir::SignatureElement& element, const std::string& name);
  void graphics_main();
  std::string graphics_head() const;
  std::string graphics_layout() const;
  std::string derivative(const ir::Stmt& stmt);

  // queries.cpp
  void declare_query();
  bool uses_queries() const;
  std::string query_arguments(const ir::Expr* object);
  std::string query_trace_function(bool micromaps);
  void query(const ir::Stmt& stmt);
  std::string query_result(const ir::Expr& expr);
  std::string query_value(const ir::Expr& expr);

  // triangle_positions.cpp
  void declare_address();
  std::string print_buffer();
  void cover(uint32_t point);
  std::string position_table();
  bool reads_tables() const;
  std::string query_table_arguments(bool committed) const;
  std::string cluster_id(const ir::Expr& expr);
  std::string triangle_positions(const ir::Expr& expr);

  // system_values.cpp
  void declare_instance_entry();
  std::string system_value(const ir::Expr& expr);
  std::string hit_builtin(const std::string& name, const std::string& type,
                          const std::string& text);
  std::string transform(bool to_world, bool transposed, const ir::Type* type);
  std::string ray_t_current();
  std::string object_ray(bool origin);
  std::string geometry_index();
  std::string instance_entry();
  std::string primitive_index();

  // emit_glsl.cpp
  void collect(const ir::Function& function);
  void collect(const ir::Expr& expr);
  void emit_globals();
  void emit_function(const ir::Function& function);
  void count_invocation();
  void emit_main();
  void initialise_globals();
  std::string entry_argument(size_t index);
  std::string variable(const ir::Variable* variable);
  const std::string& field(const ir::Struct* structure, uint32_t index);

  // The output.
  void line(std::string_view text) {
    out_.append(static_cast<size_t>(indent_) * 2, ' ');
    out_ += text;
    out_ += '\n';
  }
  void open(std::string_view text) {
    line(text);
    ++indent_;
  }
  void close(std::string_view text) {
    --indent_;
    line(text);
  }

  // A loop whose body is being printed.
  struct Loop {
    const ir::Stmt* stmt;
    bool flagged;  // step and condition come at the start of the next iteration
  };

  const ir::Module& module_;
  ir::Location statement_location_;
  const ir::EntryPoint& entry_;
  const bool twin_;
  std::string twin_location_;  // of the data that the shader passes to twins
  GlslShader shader_;

  // Sections of the text, in the order in which they are put together.
  std::string constants_;     // specialization constants
  std::string matrices_;      // matrix structs
  std::string structs_;       // the library's structs
  std::string declarations_;  // global variables, payloads
  std::string helpers_;       // generated functions
  std::string out_;           // the library's functions, main
  int indent_ = 0;
  std::string start_;  // statements at the start of main

  GlslNames global_names_{"u_"};
  GlslNames function_names_set_{"f_"};
  GlslNames struct_names_set_{"s_"};
  GlslNames local_names_{"u_"};
  std::unordered_map<const ir::Struct*, std::string> struct_names_;
  std::unordered_map<const ir::Struct*, std::vector<std::string>> field_names_;
  std::unordered_map<const ir::Function*, std::string> function_names_;
  std::unordered_map<const ir::Variable*, std::string> variable_names_;

  std::unordered_set<const ir::Function*> functions_;  // reached by the entry point
  std::unordered_set<const ir::Variable*> globals_;
  std::vector<const ir::Type*> attribute_types_;            // those that it reports or receives
  std::unordered_set<std::string> made_;                    // generated functions and variables
  std::unordered_map<std::string, std::string> generated_;  // names, by what they were made for
  const ir::Function* current_ = nullptr;
  std::vector<Loop> loops_;
  int next_temporary_ = 0;
  int next_location_ = 1;  // for payloads and callable data; 0 is the incoming one
};

namespace glsl {

std::string scalar_name(ir::Scalar scalar);               // "uint64_t"
std::string vector_name(ir::Scalar scalar, int columns);  // one column is a scalar
const char* suffix(ir::Scalar scalar);                    // "u64"
std::string component(int index);                         // "x"
std::string number(uint64_t n);                           // "3u"
bool contains_bool(const ir::Type* type);
// Total number of 32-bit words for all scalars: two for a 64-bit one, one for any other.
uint32_t words(const ir::Type* type);

}  // namespace glsl
}  // namespace kaamos::hlsl
