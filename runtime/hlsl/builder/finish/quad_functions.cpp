// SPDX-License-Identifier: MIT
// Functions as pixel shaders need them, and compute shaders that take derivatives. What other
// stages reach too is copied, so that theirs stay as they are. In these functions
// - derivatives become statements of the quad, and implicit levels of detail gradients. Where the
//   operand is made of values that do not change, the statement stands right behind the last of
//   them, so that it is run by all lanes that have the values, and once, and, of pixel shaders,
// - wave operations leave out helpers (pixel_waves.h),
// - stores and atomics depend on `live`, a static global that says whether the pixel is covered and
//   was not discarded; an atomic of another lane gives 0.
// [D3D11.3: 16.13 Pixel shader, discard; 7.18.11 LOD]
#include "runtime/hlsl/builder/finish/quad_functions.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "runtime/hlsl/builder/finish/lone_lane.h"
#include "runtime/hlsl/builder/finish/pixel_waves.h"
#include "runtime/hlsl/builder/finish/square_quads.h"
#include "runtime/hlsl/ir/builtin_types.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using shader::WaveOp;

namespace {

// An expression may replace at most this many variables by their values.
constexpr int kMostReplaced = 8;

// Functions to make for one stage, callees before callers.
struct ReachedFunctions {
  std::set<const ir::Function*> all;     // those to make
  std::set<const ir::Function*> shared;  // of them, those that others need as they are
};

class QuadFunctions {
 public:
  // `facts`: of pixel shaders, which have helpers; null for compute shaders.
  QuadFunctions(ir::Module& module, IrBuilder& build, const ModuleFacts* facts)
      : module_(module),
        build_(build),
        stage_(facts ? ir::kStagePixel : ir::kStageCompute),
        live_(facts ? facts->live : nullptr),
        waves_of_helpers_(facts ? facts->waves_of_helpers : nullptr),
        is_helper_(facts ? facts->is_helper : nullptr) {}

  void run(const ReachedFunctions& reached) {
    std::vector<ir::Function*> functions;
    for (ir::Function* function : module_.functions) {
      const bool is_made = reached.all.count(function) != 0;
      const bool is_shared = !is_made || reached.shared.count(function) != 0;
      if (is_shared) functions.push_back(function);
      if (is_made) functions.push_back(make(function, is_shared));
    }
    module_.functions = std::move(functions);
  }
  // What stands for the function now.
  const ir::Function* made(const ir::Function* function) const {
    const auto found = made_.find(function);
    return found == made_.end() ? function : found->second;
  }

 private:
  ir::Function* make(ir::Function* from, bool is_shared) {
    ir::Function* to = from;
    variables_.clear();
    positions_.clear();
    values_.clear();
    made_quads_.clear();
    find_changing(*from);
    if (is_shared) {
      to = &module_.function_pool.emplace_back(*from);
      to->mangled += stage_ == ir::kStagePixel ? "#pixel" : "#compute";
      to->stages = stage_;
      if (stage_ == ir::kStagePixel) from->stages &= ~uint32_t{ir::kStagePixel};
      for (ir::Variable*& parameter : to->parameters) parameter = copy(parameter);
    }
    is_shared_ = is_shared;
    for (const ir::Variable* parameter : to->parameters) {
      const bool is_in = parameter->mode == ir::ParameterMode::kIn && !parameter->type->is_query();
      if (is_in && changing_.count(parameter) == 0) positions_[parameter] = {0, 0};
    }
    to->body = block(from->body);
    to->has_waves = false;
    ir::visit(
        to->body, [](const ir::Expr&) {},
        [&](const ir::Stmt& stmt) {
          const bool waits = stmt.kind == ir::StmtKind::kWave ||
                             (stmt.kind == ir::StmtKind::kCall && stmt.function->has_waves);
          to->has_waves = to->has_waves || waits;
        });
    made_[from] = to;
    return to;
  }

  ir::Variable* copy(const ir::Variable* from) {
    const uint32_t id = build_.variable({}, from->type, from->storage)->id;
    ir::Variable* to = &module_.variable_pool.back();
    *to = *from;
    to->id = id;
    variables_[from] = to;
    if (changing_.count(from) != 0) changing_.insert(to);
    return to;
  }
  const ir::Variable* variable(const ir::Variable* from) const {
    const auto found = variables_.find(from);
    return found == variables_.end() ? from : found->second;
  }

  // -- Expressions. What they need first is put at the end of `out_`.

  const ir::Expr* expr(const ir::Expr* from) {
    if (!from) return nullptr;
    if (from->kind == ir::ExprKind::kVariable) {
      if (is_helper_ && from->variable == is_helper_) {
        return build_.unary(ir::UnaryOp::kNot, build_.read(live_));
      }
      const ir::Variable* own = variable(from->variable);
      if (own == from->variable) return from;
      ir::Expr* read = &module_.expr_pool.emplace_back(*from);
      read->variable = own;
      return read;
    }
    if (from->kind == ir::ExprKind::kQuad) return quad(from->wave, expr(from->operands[0]));
    std::vector<const ir::Expr*> operands;
    bool is_same = !from->implicit_level;
    for (const ir::Expr* operand : from->operands) {
      operands.push_back(expr(operand));
      is_same = is_same && operands.back() == operand;
    }
    if (is_same) return from;
    ir::Expr* to = &module_.expr_pool.emplace_back(*from);
    to->operands = std::move(operands);
    if (to->implicit_level) take_derivatives(*to);
    return to;
  }

  const ir::Expr* quad(WaveOp op, const ir::Expr* operand) {
    std::optional<Position> position = position_of(operand);
    std::string key;
    if (position) {
      int budget = kMostReplaced;
      operand = early(operand, budget);
      position = position_of(operand);
      key = std::to_string(static_cast<int>(op));
      add_key(*operand, key);
      const auto known = made_quads_.find(key);
      if (known != made_quads_.end()) return build_.read(known->second);
    }
    ir::Stmt* declaration = build_.stmt(ir::StmtKind::kDeclare);
    declaration->variable = build_.variable({}, operand->type, ir::Storage::kLocal);
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kWave);
    statement->wave = op;
    statement->operands = {operand};
    statement->result = declaration->variable;
    if (position) {
      insert(*position, {declaration, statement});
      positions_[statement->result] = {position->depth, position->index + 2};
      made_quads_[key] = statement->result;
    } else {
      out_->push_back(declaration);
      out_->push_back(statement);
    }
    return build_.read(statement->result);
  }

  // -- Values that do not change once they are there

  // The first place where a variable can be read: the index in a block that is open, counted from
  // the function's, which is 0.
  struct Position {
    size_t depth = 0;
    size_t index = 0;
    auto operator<=>(const Position&) const = default;
  };

  void find_changing(const ir::Function& function) {
    changing_.clear();
    ir::visit(
        function.body, [](const ir::Expr&) {},
        [&](const ir::Stmt& stmt) {
          if (stmt.kind == ir::StmtKind::kDeclare) return;
          ir::visit_written(stmt, [&](const ir::Variable* written, const ir::Expr*) {
            changing_.insert(written);
          });
        });
  }

  // From where on the expression has its value; nothing if that changes, or costs much.
  std::optional<Position> position_of(const ir::Expr* of) const {
    Position last;
    for (const ir::Expr* operand : of->operands) {
      const std::optional<Position> one = position_of(operand);
      if (!one) return std::nullopt;
      last = std::max(last, *one);
    }
    switch (of->kind) {
      case ir::ExprKind::kVariable: {
        if (of->variable->storage == ir::Storage::kConstant) return last;
        const auto found = positions_.find(of->variable);
        if (found == positions_.end()) return std::nullopt;
        return found->second;
      }
      case ir::ExprKind::kLoad:
        if (of->operands[0]->type->resource != ir::ResourceKind::kConstantBuffer) break;
        return last;
      case ir::ExprKind::kBinding:
      case ir::ExprKind::kLiteral:
      case ir::ExprKind::kZero:
      case ir::ExprKind::kField:
      case ir::ExprKind::kElement:
      case ir::ExprKind::kSwizzle:
      case ir::ExprKind::kMatrixSwizzle:
      case ir::ExprKind::kConvert:
      case ir::ExprKind::kSplat:
      case ir::ExprKind::kTruncate:
      case ir::ExprKind::kConstruct:
      case ir::ExprKind::kUnary:
      case ir::ExprKind::kBinary:
      case ir::ExprKind::kSelect:
      case ir::ExprKind::kIntrinsic:
        return last;
      default:
        break;
    }
    return std::nullopt;
  }

  // The expression with the values of variables in place of those variables, where that gives it
  // its value earlier.
  const ir::Expr* early(const ir::Expr* of, int& budget) {
    if (of->kind == ir::ExprKind::kVariable) {
      const auto value = values_.find(of->variable);
      if (value == values_.end() || budget == 0) return of;
      const std::optional<Position> before = position_of(value->second);
      if (!before || *before >= positions_.at(of->variable)) return of;
      --budget;
      return early(value->second, budget);
    }
    std::vector<const ir::Expr*> operands;
    for (const ir::Expr* operand : of->operands) operands.push_back(early(operand, budget));
    if (operands == of->operands) return of;
    ir::Expr* to = &module_.expr_pool.emplace_back(*of);
    to->operands = std::move(operands);
    return to;
  }

  // Tells expressions that position_of() accepts apart.
  static void add_key(const ir::Expr& of, std::string& key) {
    const auto add = [&](uint64_t number) { key += "," + std::to_string(number); };
    add(static_cast<uint64_t>(of.kind));
    add(reinterpret_cast<uintptr_t>(of.type));
    if (of.variable) add(of.variable->id);
    for (const uint64_t bits : of.literal) add(bits);
    for (const uint8_t component : of.components) add(component);
    add(of.index);
    add(static_cast<uint64_t>(of.unary) << 24 | static_cast<uint64_t>(of.binary) << 16 |
        static_cast<uint64_t>(of.intrinsic) << 8 | static_cast<uint64_t>(of.layout) << 1 |
        (of.row_major ? 1u : 0u));
    key += "(";
    for (const ir::Expr* operand : of.operands) add_key(*operand, key);
    key += ")";
  }

  void insert(const Position& position, std::initializer_list<const ir::Stmt*> statements) {
    ir::Block& block = *blocks_[position.depth];
    block.insert(block.begin() + static_cast<std::ptrdiff_t>(position.index), statements);
    for (auto& [variable, other] : positions_) {
      if (other.depth == position.depth && other.index > position.index) {
        other.index += statements.size();
      }
    }
  }

  void close_block() {
    const size_t depth = blocks_.size() - 1;
    std::erase_if(positions_, [&](const auto& one) { return one.second.depth == depth && depth; });
    std::erase_if(values_, [&](const auto& one) { return !positions_.count(one.first); });
    std::erase_if(made_quads_, [&](const auto& one) { return !positions_.count(one.second); });
    blocks_.pop_back();
  }

  const ir::Variable* declare(const ir::Type* type, const ir::Expr* value) {
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kDeclare);
    statement->variable = build_.variable({}, type, ir::Storage::kLocal);
    statement->value = value;
    out_->push_back(statement);
    note_declaration(*statement);
    return statement->variable;
  }
  void note_declaration(const ir::Stmt& statement) {
    if (out_ != blocks_.back() || changing_.count(statement.variable) != 0) return;
    positions_[statement.variable] = {blocks_.size() - 1, out_->size()};
    if (statement.value) values_[statement.variable] = statement.value;
  }

  void take_derivatives(ir::Expr& sample) {
    sample.implicit_level = false;
    const ir::Expr* least = nullptr;  // the clamp
    if (std::exchange(sample.clamps_level, false)) {
      least = sample.operands.back();
      sample.operands.pop_back();
    }
    const ResourceTraits& traits = traits_of(sample.operands[0]->type->resource);
    const ir::Expr*& at = sample.operands[2];
    const ir::Expr* place = at;
    if (at->kind != ir::ExprKind::kVariable) {
      const bool is_fixed = position_of(at).has_value();
      at = build_.read(declare(at->type, at));
      if (!is_fixed) place = at;
    }
    if (traits.is_array) {
      std::vector<uint8_t> components;
      for (uint8_t i = 0; i + 1 < traits.coordinates; ++i) components.push_back(i);
      place = build_.swizzle(place, components);
    }
    const ir::Expr* ddx = quad(WaveOp::kDdxCoarse, place);
    const ir::Expr* ddy = quad(WaveOp::kDdyCoarse, place);
    if (sample.sample == ir::SampleKind::kLevelOfDetail) {
      sample.operands.push_back(ddx);
      sample.operands.push_back(ddy);
      return;
    }
    const ir::Type* real = build_.scalar_type(Scalar::kFloat32);
    const auto level_of_detail = [&] {
      ir::Expr* level = build_.expr(ir::ExprKind::kSample, real,
                                    {sample.operands[0], sample.operands[1], at, ddx, ddy});
      level->sample = ir::SampleKind::kLevelOfDetail;
      return level;
    };
    const auto at_least = [&](const ir::Expr* level) {
      return least ? build_.intrinsic(Intrinsic::max, real, {level, least}) : level;
    };
    if (sample.sample == ir::SampleKind::kCompareLevel) {
      sample.operands[4] =
          at_least(build_.binary(ir::BinaryOp::kAdd, level_of_detail(), sample.operands[4]));
      return;
    }
    if (least) {
      sample.operands[3] =
          at_least(build_.binary(ir::BinaryOp::kAdd, level_of_detail(), sample.operands[3]));
      return;
    }
    // A bias is a factor of the derivatives.
    const ir::Expr* bias = sample.operands[3];
    const bool is_zero = bias->kind == ir::ExprKind::kZero ||
                         (bias->kind == ir::ExprKind::kLiteral && bias->literal[0] == 0);
    if (!is_zero) {
      const ir::Expr* factor =
          build_.read(declare(real, build_.intrinsic(Intrinsic::exp2, real, {bias})));
      const auto scaled = [&](const ir::Expr* derivative) {
        const bool is_scalar = derivative->type->kind == ir::TypeKind::kScalar;
        return build_.binary(ir::BinaryOp::kMultiply, derivative,
                             is_scalar ? factor : build_.splat(factor, derivative->type));
      };
      ddx = scaled(ddx);
      ddy = scaled(ddy);
    }
    sample.sample = ir::SampleKind::kGradient;
    sample.operands[3] = ddx;
    sample.operands.insert(sample.operands.begin() + 4, ddy);
  }

  // -- Statements

  ir::Block block(const ir::Block& from) {
    ir::Block to;
    ir::Block* const outer = out_;
    out_ = &to;
    blocks_.push_back(&to);
    for (const ir::Stmt* each : from) statement(*each);
    close_block();
    out_ = outer;
    return to;
  }

  void statement(const ir::Stmt& from) {
    build_.location = from.location;
    ir::Stmt* to = &module_.stmt_pool.emplace_back(from);
    if (from.kind == ir::StmtKind::kDeclare && is_shared_) {
      to->variable = copy(from.variable);
    }
    if (from.kind == ir::StmtKind::kCall) to->function = made(from.function);
    if (from.result) to->result = variable(from.result);
    to->place = expr(from.place);
    if (from.kind != ir::StmtKind::kLoop) to->value = expr(from.value);
    to->compare = expr(from.compare);
    for (const ir::Expr*& operand : to->operands) operand = expr(operand);
    for (const ir::Expr*& argument : to->arguments) argument = expr(argument);
    to->prelude = block(from.prelude);
    if (from.kind == ir::StmtKind::kLoop) {
      ir::Block* const outer = out_;
      out_ = &to->prelude;
      to->value = expr(from.value);
      out_ = outer;
    }
    to->body = block(from.body);
    to->orelse = block(from.orelse);
    to->step = block(from.step);
    for (ir::SwitchCase& one : to->cases) one.body = block(one.body);
    switch (from.kind) {
      case ir::StmtKind::kStore:
      case ir::StmtKind::kStoreElement:
      case ir::StmtKind::kTypedStore:
      case ir::StmtKind::kCover:
        if (!live_) break;
        return if_live(to, nullptr);
      case ir::StmtKind::kAtomic:
        if (!live_ || from.target == ir::AtomicTarget::kPlace) break;
        return if_live(to, to->result);
      case ir::StmtKind::kWave:
        if (!live_ || !leaves_out_helpers(from.wave)) break;
        return append_pixel_wave(build_, to, takes_part(), *out_);
      case ir::StmtKind::kDiscard:
        assign(live_, build_.boolean(false));
        break;
      default:
        break;
    }
    out_->push_back(to);
    if (from.kind == ir::StmtKind::kDeclare) note_declaration(*to);
  }

  const ir::Expr* takes_part() {
    const ir::Expr* live = build_.read(live_);
    if (!waves_of_helpers_) return live;
    return build_.binary(ir::BinaryOp::kBitOr, live, build_.read(waves_of_helpers_));
  }

  void assign(const ir::Variable* variable, const ir::Expr* value) {
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kAssign);
    statement->place = build_.read(variable);
    statement->value = value;
    out_->push_back(statement);
  }

  // `result` is 0 otherwise.
  void if_live(const ir::Stmt* statement, const ir::Variable* result) {
    ir::Stmt* condition = build_.stmt(ir::StmtKind::kIf);
    condition->value = build_.read(live_);
    condition->body.push_back(statement);
    if (result) {
      ir::Block* const outer = out_;
      out_ = &condition->orelse;
      assign(result, build_.zero(result->type));
      out_ = outer;
    }
    out_->push_back(condition);
  }

  ir::Module& module_;
  IrBuilder& build_;
  const uint32_t stage_;
  const ir::Variable* live_;  // null outside of pixel shaders, which have helpers
  const ir::Variable* waves_of_helpers_;
  const ir::Variable* is_helper_;
  std::map<const ir::Function*, ir::Function*> made_;
  std::map<const ir::Variable*, const ir::Variable*> variables_;  // of the function being copied
  std::set<const ir::Variable*> changing_;                        // written after their declaration
  std::map<const ir::Variable*, Position> positions_;             // of those that do not change
  std::map<const ir::Variable*, const ir::Expr*> values_;
  std::map<std::string, const ir::Variable*> made_quads_;
  std::vector<ir::Block*> blocks_;  // those that are open, the function's first
  bool is_shared_ = false;
  ir::Block* out_ = nullptr;
};

void make_pixel_shaders(ir::Module& module, IrBuilder& build, const ModuleFacts& facts) {
  ReachedFunctions reached;
  for (const ir::Function* function : module.functions) {
    if ((function->stages & ir::kStagePixel) == 0) continue;
    reached.all.insert(function);
    if (function->stages != ir::kStagePixel) reached.shared.insert(function);
  }
  QuadFunctions functions(module, build, &facts);
  functions.run(reached);
  for (ir::EntryPoint& entry : module.entry_points) {
    if (entry.stage == ir::kStagePixel) entry.function = functions.made(entry.function);
  }
}

void collect_reached(const ir::Function& function, std::set<const ir::Function*>& reached) {
  if (!reached.insert(&function).second) return;
  ir::visit(
      function.body, [](const ir::Expr&) {},
      [&](const ir::Stmt& stmt) {
        if (stmt.kind == ir::StmtKind::kCall) collect_reached(*stmt.function, reached);
      });
}

// Functions of compute shaders that take derivatives, and their callers, if the group has quads.
void make_compute_quads(ir::Module& module, IrBuilder& build) {
  std::set<const ir::Function*> in_quads, elsewhere;
  for (const ir::EntryPoint& entry : module.entry_points) {
    if (!entry.imports.empty()) continue;
    collect_reached(*entry.function, has_quads(entry) ? in_quads : elsewhere);
  }
  ReachedFunctions reached;
  for (const ir::Function* function : module.functions) {
    if (in_quads.count(function) == 0) continue;
    bool takes = false;
    ir::visit(
        function->body,
        [&](const ir::Expr& expr) {
          takes = takes || expr.kind == ir::ExprKind::kQuad || expr.implicit_level;
        },
        [&](const ir::Stmt& stmt) {
          takes = takes || (stmt.kind == ir::StmtKind::kCall && reached.all.count(stmt.function));
        });
    if (!takes) continue;
    reached.all.insert(function);
    if (elsewhere.count(function) != 0) reached.shared.insert(function);
  }
  if (reached.all.empty()) return;
  QuadFunctions functions(module, build, nullptr);
  functions.run(reached);
  for (ir::EntryPoint& entry : module.entry_points) {
    if (has_quads(entry) && entry.imports.empty()) {
      entry.function = functions.made(entry.function);
    }
  }
}

// Returns what the functions that an entry point reaches can do, as flags.
uint32_t flags_of(const ir::Function& function, std::set<const ir::Function*>& seen) {
  if (!seen.insert(&function).second) return 0;
  uint32_t flags = 0;
  ir::visit(
      function.body, [](const ir::Expr&) {},
      [&](const ir::Stmt& stmt) {
        switch (stmt.kind) {
          case ir::StmtKind::kStore:
          case ir::StmtKind::kStoreElement:
          case ir::StmtKind::kTypedStore:
            flags |= shader::kGraphicsWritesMemory;
            break;
          case ir::StmtKind::kAtomic:
            if (stmt.target != ir::AtomicTarget::kPlace) flags |= shader::kGraphicsWritesMemory;
            break;
          case ir::StmtKind::kDiscard:
            flags |= shader::kGraphicsDiscards;
            break;
          case ir::StmtKind::kWave:
            flags |= shader::kGraphicsReadsQuad;
            if (!shader::is_derivative(stmt.wave)) flags |= shader::kGraphicsReadsWave;
            break;
          case ir::StmtKind::kCall:
            flags |= flags_of(*stmt.function, seen);
            break;
          default:
            break;
        }
      });
  return flags;
}

}  // namespace

void make_quad_functions(ir::Module& module, IrBuilder& build, ModuleFacts& facts,
                         bool has_errors) {
  // Initialisers are the same for all pixels, so their derivatives are 0. Where no pixel shader
  // comes, levels are 0 too; copies for pixel shaders are made first.
  for (GlobalFacts* global : facts.globals) {
    FunctionFacts* initialiser = global->initialiser;
    if (!initialiser) continue;
    take_level_zero(build, *initialiser);
    for (ir::Expr* quad : initialiser->quads) {
      quad->kind = ir::ExprKind::kZero;
      quad->operands.clear();
    }
  }
  if (facts.is_helper) module.globals.push_back(facts.is_helper);
  if (facts.live && !has_errors) {
    module.globals.push_back(facts.live);
    if (facts.waves_of_helpers) module.globals.push_back(facts.waves_of_helpers);
    make_pixel_shaders(module, build, facts);
  }
  if (!has_errors) make_compute_quads(module, build);
  for (FunctionFacts* function : facts.functions) take_level_zero(build, *function);
  if (has_errors) return;
  for (ir::EntryPoint& entry : module.entry_points) {
    if (!entry.is_graphics()) continue;
    std::set<const ir::Function*> seen;
    entry.graphics_flags |= flags_of(*entry.function, seen);
    const bool per_sample = std::any_of(
        entry.inputs.begin(), entry.inputs.end(), [](const ir::SignatureElement& input) {
          return input.system_value == shader::SystemValue::kSampleIndex ||
                 shader::is_at_sample(input.interpolation);
        });
    if (per_sample && entry.stage == ir::kStagePixel) {
      entry.graphics_flags |= shader::kGraphicsRunsPerSample;
    }
    const bool orders = facts.names_ordered_views && entry.stage == ir::kStagePixel &&
                        (entry.graphics_flags & shader::kGraphicsWritesMemory);
    if (orders) entry.graphics_flags |= shader::kGraphicsOrdersPixels;
  }
}

}  // namespace kaamos::hlsl
