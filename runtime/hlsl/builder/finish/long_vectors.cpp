// SPDX-License-Identifier: MIT
// An assignment of an expression becomes one loop, whatever the number of its operations:
//   v = a * b + s   ->   for (i = 0; i < N; ++i) v[i] = a[i] * b[i] + s
// That is right because expressions are pure, and because component i of a result depends on no
// other component of the vectors that it is made of. What is no operation on components (a load, a
// constructor) is kept in a variable before the loop, and so are scalars. Assignments in a row
// share a loop. The nodes keep the types of vectors until all is done.
#include "runtime/hlsl/builder/finish/long_vectors.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

// Assignments that share a loop.
constexpr size_t kMostShared = 16;

bool has_long_operand(const ir::Expr& expr) {
  return std::any_of(expr.operands.begin(), expr.operands.end(),
                     [](const ir::Expr* operand) { return operand->type->is_long_vector(); });
}

bool is_selection(ir::ExprKind kind) {
  return kind == ir::ExprKind::kField || kind == ir::ExprKind::kElement;
}

// A variable, or a part of one.
bool is_place(const ir::Expr* expr) {
  while (is_selection(expr->kind)) expr = expr->operands[0];
  return expr->kind == ir::ExprKind::kVariable;
}

bool is_same_everywhere(const ir::Expr& literal) {
  return std::all_of(literal.literal.begin(), literal.literal.end(),
                     [&](uint64_t bits) { return bits == literal.literal[0]; });
}

bool is_zero(const ir::Expr& expr) {
  return expr.kind == ir::ExprKind::kLiteral && expr.literal[0] == 0 && is_same_everywhere(expr);
}

// What an array can be made of as a whole.
bool is_made_whole(const ir::Expr& expr) {
  switch (expr.kind) {
    case ir::ExprKind::kVariable:
    case ir::ExprKind::kField:
    case ir::ExprKind::kElement:
    case ir::ExprKind::kZero:
    case ir::ExprKind::kLoad:
    case ir::ExprKind::kLoadElement:
      return true;
    case ir::ExprKind::kConstruct:
      return expr.operands.size() == expr.type->columns;
    default:
      return false;
  }
}

class LongVectors {
 public:
  LongVectors(ir::Module& module, IrBuilder& build) : module_(module), build_(build) {}

  void run() {
    for (ir::Function* function : module_.functions) {
      if (uses_long_vectors(function->body)) function->body = block(function->body);
    }
    // By index: constants of functions have been added at the end.
    for (size_t i = 0; i < module_.globals.size(); ++i) {
      ir::Variable* global = module_.globals[i];
      if (!global->initialiser) continue;
      build_.location = global->location;
      global->initialiser = constant(global->initialiser);
    }
    give_types();
  }

 private:
  static bool uses_long_vectors(const ir::Block& block) {
    bool uses = false;
    ir::visit(
        block,
        [&](const ir::Expr& expr) {
          uses = uses || expr.type->is_long_vector() || has_long_operand(expr);
        },
        [&](const ir::Stmt& stmt) {
          uses = uses || (stmt.result && stmt.result->type->is_long_vector());
        });
    return uses;
  }

  // -- Statements. What they need first is put at the end of `out_`.

  ir::Block block(const ir::Block& from) {
    return into_block([&] {
      for (const ir::Stmt* one : from) statement(*one);
    });
  }

  template <typename Action>
  ir::Block into_block(const Action& action) {
    ir::Block made;
    ir::Block* const outer = std::exchange(out_, &made);
    const ir::Stmt* const loop = std::exchange(shared_loop_, nullptr);
    action();
    out_ = outer;
    shared_loop_ = loop;
    return made;
  }

  void statement(const ir::Stmt& from) {
    build_.location = from.location;
    switch (from.kind) {
      case ir::StmtKind::kDeclare:
        if (from.variable->type->is_long_vector() && from.value && !is_made_whole(*from.value)) {
          declare_and_fill(variable_of(from.variable), from.value);
          return;
        }
        break;
      case ir::StmtKind::kAssign:
        if (from.place->type->is_long_vector()) {
          assign(fixed_place(from.place), from.value);
          return;
        }
        break;
      case ir::StmtKind::kWave:
        if (!from.operands.empty() && from.operands[0]->type->is_long_vector()) {
          wave(from);
          return;
        }
        break;
      default:
        break;
    }
    ir::Stmt* to = &module_.stmt_pool.emplace_back(from);
    to->prelude = block(from.prelude);
    if (from.kind == ir::StmtKind::kLoop) {
      // The condition is computed in each round.
      ir::Block needed = into_block([&] { to->value = expr(from.value); });
      to->prelude.insert(to->prelude.end(), needed.begin(), needed.end());
    } else {
      to->value = expr(from.value);
    }
    to->place = expr(from.place);
    to->compare = expr(from.compare);
    for (const ir::Expr*& operand : to->operands) operand = expr(operand);
    for (const ir::Expr*& argument : to->arguments) argument = expr(argument);
    to->body = block(from.body);
    to->orelse = block(from.orelse);
    to->step = block(from.step);
    for (ir::SwitchCase& one : to->cases) one.body = block(one.body);
    out_->push_back(to);
  }

  // Variables belong to the module, which may change them.
  static ir::Variable* variable_of(const ir::Variable* variable) {
    return const_cast<ir::Variable*>(variable);
  }

  ir::Stmt* declaration(const ir::Variable* variable, const ir::Expr* value) {
    ir::Stmt* stmt = build_.stmt(ir::StmtKind::kDeclare);
    stmt->variable = variable;
    stmt->value = value;
    return stmt;
  }
  ir::Stmt* assignment(const ir::Expr* place, const ir::Expr* value) {
    ir::Stmt* stmt = build_.stmt(ir::StmtKind::kAssign);
    stmt->place = place;
    stmt->value = value;
    return stmt;
  }
  ir::Variable* local(const ir::Type* type) {
    return build_.variable({}, type, ir::Storage::kLocal);
  }
  const ir::Expr* saved(const ir::Expr* value) {
    const ir::Variable* variable = local(value->type);
    out_->push_back(declaration(variable, value));
    return build_.read(variable);
  }

  // -- Loops

  // Appends what `make` makes of the index to the loop at the end of `out_`, or to a new one.
  // `before` is put in front of the loop.
  template <typename Make>
  void for_each(uint32_t count, ir::Stmt* before, const Make& make) {
    const bool shares = shared_loop_ && !out_->empty() && out_->back() == shared_loop_ &&
                        shared_count_ == count && shared_body_->size() < kMostShared;
    if (before) out_->insert(shares ? out_->end() - 1 : out_->end(), before);
    if (!shares) {
      shared_loop_ = make_loop(count, shared_index_, shared_body_);
      shared_count_ = count;
    }
    make(shared_index_, *shared_body_);
  }

  const ir::Stmt* make_loop(uint32_t count, const ir::Expr*& index, ir::Block*& body) {
    const ir::Variable* variable = local(build_.scalar_type(Scalar::kUint32));
    out_->push_back(declaration(variable, build_.uint32(0)));
    index = build_.read(variable);
    ir::Stmt* loop = build_.stmt(ir::StmtKind::kLoop);
    loop->value = build_.binary(ir::BinaryOp::kLess, index, build_.uint32(count));
    loop->step = {assignment(index, build_.binary(ir::BinaryOp::kAdd, index, build_.uint32(1)))};
    out_->push_back(loop);
    body = &loop->body;
    return loop;
  }

  void declare_and_fill(ir::Variable* variable, const ir::Expr* value) {
    variable->is_const = false;
    fill(build_.read(variable), value, declaration(variable, nullptr));
  }

  // Returns a new variable with the value.
  const ir::Expr* kept(const ir::Expr* value) {
    if (is_made_whole(*value)) return saved(whole(value));
    ir::Variable* variable = local(value->type);
    declare_and_fill(variable, value);
    return build_.read(variable);
  }

  void assign(const ir::Expr* place, const ir::Expr* value) {
    // A constructor may read components of what it is assigned to.
    const bool mixes = value->kind == ir::ExprKind::kConstruct && !is_made_whole(*value);
    fill(place, mixes ? kept(value) : value, nullptr);
  }

  // `declares` is the declaration of the place, which is then new.
  void fill(const ir::Expr* place, const ir::Expr* value, ir::Stmt* declares) {
    const uint32_t count = place->type->columns;
    const bool is_operation = !is_made_whole(*value) && value->kind != ir::ExprKind::kConstruct &&
                              value->kind != ir::ExprKind::kConditional &&
                              (value->kind != ir::ExprKind::kLiteral || is_same_everywhere(*value));
    if (is_operation) {
      const ir::Expr* components = prepared(value);
      for_each(count, declares, [&](const ir::Expr* index, ir::Block& body) {
        body.push_back(assignment(build_.element(place, index), component(components, index)));
      });
      return;
    }
    if (declares) out_->push_back(declares);
    if (value->kind == ir::ExprKind::kConditional) {
      ir::Stmt* choice = build_.stmt(ir::StmtKind::kIf);
      choice->value = expr(value->operands[0]);
      choice->body = into_block([&] { assign(place, value->operands[1]); });
      choice->orelse = into_block([&] { assign(place, value->operands[2]); });
      out_->push_back(choice);
    } else if (is_made_whole(*value) || value->kind == ir::ExprKind::kLiteral) {
      const ir::Expr* made = whole(value);
      out_->push_back(assignment(place, made));
    } else {
      fill_with_parts(place, *value);
    }
  }

  void fill_with_parts(const ir::Expr* place, const ir::Expr& constructor) {
    uint32_t first = 0;
    for (const ir::Expr* part : constructor.operands) {
      const bool is_scalar = part->type->kind == ir::TypeKind::kScalar;
      const uint32_t count = is_scalar ? 1 : part->type->columns;
      if (part->type->is_long_vector()) {
        const ir::Expr* components = prepared(part);
        const ir::Expr* index = nullptr;
        ir::Block* body = nullptr;
        make_loop(count, index, body);
        const ir::Expr* at = build_.add(index, first);
        body->push_back(assignment(build_.element(place, at), component(components, index)));
      } else {
        const ir::Expr* value = is_scalar ? expr(part) : saved(expr(part));
        for (uint32_t i = 0; i < count; ++i) {
          const ir::Expr* one =
              is_scalar ? value : build_.swizzle(value, {static_cast<uint8_t>(i)});
          out_->push_back(assignment(build_.element(place, build_.uint32(first + i)), one));
        }
      }
      first += count;
    }
  }

  // A wave's operation on each component, one after the other.
  void wave(const ir::Stmt& from) {
    const ir::Expr* components = prepared(from.operands[0]);
    std::vector<const ir::Expr*> operands = from.operands;
    for (size_t i = 1; i < operands.size(); ++i) operands[i] = fixed(operands[i]);
    const ir::Expr* result = build_.read(from.result);
    const bool is_match = !result->type->is_long_vector();
    if (is_match) {
      out_->push_back(
          assignment(result, build_.unary(ir::UnaryOp::kBitNot, build_.zero(result->type))));
    }
    const ir::Expr* index = nullptr;
    ir::Block* body = nullptr;
    make_loop(from.operands[0]->type->columns, index, body);
    operands[0] = component(components, index);
    ir::Variable* one = local(is_match ? result->type : build_.scalar_type(result->type->scalar));
    ir::Stmt* to = &module_.stmt_pool.emplace_back(from);
    to->operands = std::move(operands);
    to->result = one;
    *body = {declaration(one, nullptr), to};
    if (is_match) {
      body->push_back(
          assignment(result, build_.binary(ir::BinaryOp::kBitAnd, result, build_.read(one))));
    } else {
      body->push_back(assignment(build_.element(result, index), build_.read(one)));
    }
  }

  // -- Expressions

  ir::Expr* copy(const ir::Expr& from) { return &module_.expr_pool.emplace_back(from); }

  // The expression with other operands.
  template <typename Change>
  const ir::Expr* with_operands(const ir::Expr* from, const Change& change) {
    std::vector<const ir::Expr*> operands;
    for (const ir::Expr* operand : from->operands) operands.push_back(change(operand));
    if (operands == from->operands) return from;
    ir::Expr* to = copy(*from);
    to->operands = std::move(operands);
    return to;
  }
  const ir::Expr* rebuilt(const ir::Expr* from) {
    return with_operands(from, [&](const ir::Expr* operand) { return expr(operand); });
  }

  // Any expression, in which long vectors are only read, loaded and made of scalars.
  const ir::Expr* expr(const ir::Expr* from) {
    if (!from) return nullptr;
    if (from->type->is_long_vector()) return whole(from);
    switch (from->kind) {
      case ir::ExprKind::kConditional:
      case ir::ExprKind::kLogicalAnd:
      case ir::ExprKind::kLogicalOr:
        return chosen(from);
      default:
        break;
    }
    if (!has_long_operand(*from)) return rebuilt(from);
    const ir::Expr* vector = from->operands[0];
    switch (from->kind) {
      case ir::ExprKind::kElement:
        if (is_place(vector)) return rebuilt(from);
        if (from->operands[1]->kind == ir::ExprKind::kLiteral) {
          return component(prepared(vector), from->operands[1]);
        }
        return build_.element(kept(vector), expr(from->operands[1]));
      case ir::ExprKind::kSwizzle:
        return first_components(from, from->components);
      case ir::ExprKind::kTruncate: {
        std::vector<uint8_t> leading;
        for (uint32_t i = 0; i < from->type->columns; ++i) {
          leading.push_back(static_cast<uint8_t>(i));
        }
        return first_components(from, leading);
      }
      case ir::ExprKind::kIntrinsic:
        return reduced(*from);
      default: {
        if (from->type->kind != ir::TypeKind::kMatrix) return rebuilt(from);
        // A matrix of the vector's components.
        std::vector<const ir::Expr*> parts;
        for (const ir::Expr* operand : from->operands) {
          const ir::Expr* components = prepared(operand);
          for (uint32_t i = 0; i < operand->type->columns; ++i) {
            parts.push_back(component(components, build_.uint32(i)));
          }
        }
        return build_.construct(from->type, std::move(parts));
      }
    }
  }

  const ir::Expr* first_components(const ir::Expr* from, const std::vector<uint8_t>& which) {
    const ir::Expr* components = prepared(from->operands[0]);
    std::vector<const ir::Expr*> parts;
    for (const uint8_t one : which) parts.push_back(component(components, build_.uint32(one)));
    return build_.construct(from->type, std::move(parts));
  }

  const ir::Expr* whole(const ir::Expr* from) {
    if (is_made_whole(*from)) return rebuilt(from);
    if (from->kind == ir::ExprKind::kLiteral) return constant_array(*from);
    return kept(from);
  }

  // What the operands need first only runs with the one that is chosen.
  const ir::Expr* chosen(const ir::Expr* from) {
    const ir::Expr* first = expr(from->operands[0]);
    std::vector<const ir::Expr*> values;
    std::vector<ir::Block> needed;
    for (size_t i = 1; i < from->operands.size(); ++i) {
      needed.push_back(into_block([&] { values.push_back(expr(from->operands[i])); }));
    }
    const bool is_simple = std::all_of(needed.begin(), needed.end(),
                                       [](const ir::Block& block) { return block.empty(); });
    if (is_simple) {
      values.insert(values.begin(), first);
      if (values == from->operands) return from;
      ir::Expr* to = copy(*from);
      to->operands = std::move(values);
      return to;
    }
    const bool is_logic = from->kind != ir::ExprKind::kConditional;
    const ir::Expr* result = is_logic ? saved(first) : build_.read(local(from->type));
    if (!is_logic) out_->push_back(declaration(result->variable, nullptr));
    for (size_t i = 0; i < needed.size(); ++i) {
      needed[i].push_back(assignment(result, values[i]));
    }
    ir::Stmt* choice = build_.stmt(ir::StmtKind::kIf);
    choice->value = from->kind == ir::ExprKind::kLogicalOr ? build_.unary(ir::UnaryOp::kNot, result)
                                                           : (is_logic ? result : first);
    choice->body = std::move(needed[0]);
    if (!is_logic) choice->orelse = std::move(needed[1]);
    out_->push_back(choice);
    return result;
  }

  // all(), any() and dot().
  const ir::Expr* reduced(const ir::Expr& from) {
    std::vector<const ir::Expr*> operands;
    for (const ir::Expr* operand : from.operands) operands.push_back(prepared(operand));
    const ir::Expr* first =
        from.intrinsic == Intrinsic::all ? build_.boolean(true) : build_.zero(from.type);
    const ir::Expr* result = build_.read(local(from.type));
    // In a loop of its own: what comes next may read the result, and a sum of floats has an order.
    out_->push_back(declaration(result->variable, first));
    const ir::Expr* index = nullptr;
    ir::Block* body = nullptr;
    make_loop(operands[0]->type->columns, index, body);
    body->push_back(assignment(result, with_component(from, operands, result, index)));
    return result;
  }

  // The reduction of one more component.
  const ir::Expr* with_component(const ir::Expr& from, const std::vector<const ir::Expr*>& operands,
                                 const ir::Expr* so_far, const ir::Expr* index) {
    const ir::Expr* one = component(operands[0], index);
    if (from.intrinsic == Intrinsic::all) return build_.binary(ir::BinaryOp::kBitAnd, so_far, one);
    if (from.intrinsic == Intrinsic::any) return build_.binary(ir::BinaryOp::kBitOr, so_far, one);
    const ir::Expr* product =
        build_.binary(ir::BinaryOp::kMultiply, one, component(operands[1], index));
    return build_.binary(ir::BinaryOp::kAdd, so_far, product);
  }

  // A scalar whose value no statement of a loop over components changes.
  const ir::Expr* fixed(const ir::Expr* from) {
    const ir::Expr* value = expr(from);
    const bool is_local =
        value->kind == ir::ExprKind::kVariable && value->variable->storage == ir::Storage::kLocal;
    return value->kind == ir::ExprKind::kLiteral || is_local ? value : saved(value);
  }

  const ir::Expr* fixed_place(const ir::Expr* from) {
    if (!is_selection(from->kind)) return from;
    return with_operands(from, [&](const ir::Expr* operand) {
      return operand == from->operands[0] ? fixed_place(operand) : fixed(operand);
    });
  }

  // The same vector, made of what component() takes.
  const ir::Expr* prepared(const ir::Expr* from) {
    switch (from->kind) {
      case ir::ExprKind::kField:
      case ir::ExprKind::kElement:
        return is_place(from) ? fixed_place(from) : kept(from);
      case ir::ExprKind::kVariable:
      case ir::ExprKind::kZero:
        return from;
      case ir::ExprKind::kLiteral:
        return is_same_everywhere(*from) ? from : constant_array(*from);
      case ir::ExprKind::kSplat:
        return with_operands(from, [&](const ir::Expr* operand) { return fixed(operand); });
      case ir::ExprKind::kConvert:
      case ir::ExprKind::kTruncate:
      case ir::ExprKind::kUnary:
      case ir::ExprKind::kBinary:
      case ir::ExprKind::kSelect:
      case ir::ExprKind::kIntrinsic:
        return with_operands(from, [&](const ir::Expr* operand) {
          return operand->type->is_long_vector() ? prepared(operand) : fixed(operand);
        });
      default:
        return kept(from);
    }
  }

  // The component of a prepared vector or, at an index that is a literal, of any.
  const ir::Expr* component(const ir::Expr* from, const ir::Expr* index) {
    if (!from->type->is_long_vector()) return from;
    const auto operand = [&](size_t i) { return component(from->operands[i], index); };
    const ir::Type* scalar = build_.scalar_type(from->type->scalar);
    switch (from->kind) {
      case ir::ExprKind::kZero:
        return build_.zero(scalar);
      case ir::ExprKind::kLiteral: {
        const bool is_known = index->kind == ir::ExprKind::kLiteral;
        return build_.literal(scalar, {from->literal[is_known ? index->literal[0] : 0]});
      }
      case ir::ExprKind::kSplat:
        return from->operands[0];
      case ir::ExprKind::kTruncate:
        return operand(0);
      case ir::ExprKind::kConvert:
        return build_.convert(operand(0), scalar->scalar);
      case ir::ExprKind::kUnary:
        return build_.unary(from->unary, operand(0));
      case ir::ExprKind::kBinary:
        return build_.binary(from->binary, operand(0), operand(1));
      case ir::ExprKind::kSelect:
      case ir::ExprKind::kIntrinsic: {
        ir::Expr* to = copy(*from);
        to->type = scalar;
        for (size_t i = 0; i < to->operands.size(); ++i) to->operands[i] = operand(i);
        return to;
      }
      case ir::ExprKind::kConditional:
        return build_.conditional(from->operands[0], operand(1), operand(2));
      case ir::ExprKind::kConstruct:
        if (index->kind == ir::ExprKind::kLiteral) return part_of(*from, index->literal[0]);
        [[fallthrough]];
      default:
        return build_.element(from, index);
    }
  }

  const ir::Expr* part_of(const ir::Expr& constructor, uint64_t index) {
    for (const ir::Expr* part : constructor.operands) {
      const uint32_t count = part->type->kind == ir::TypeKind::kScalar ? 1 : part->type->columns;
      if (index >= count) {
        index -= count;
        continue;
      }
      if (part->type->is_long_vector()) return component(part, build_.uint32(index));
      return count == 1 ? part : build_.swizzle(part, {static_cast<uint8_t>(index)});
    }
    return build_.zero(build_.scalar_type(constructor.type->scalar));
  }

  // -- Constants

  // A constant that holds the components.
  const ir::Expr* constant_array(const ir::Expr& literal) {
    ir::Variable*& variable = constants_[{literal.type, literal.literal}];
    if (!variable) {
      variable = build_.variable({}, literal.type, ir::Storage::kConstant);
      variable->name = "components_" + std::to_string(constants_.size());
      variable->initialiser = constant(&literal);
      module_.globals.push_back(variable);
    }
    return build_.read(variable);
  }

  // An initialiser, which no statement can come before.
  const ir::Expr* constant(const ir::Expr* from) {
    if (from->type->is_long_vector()) {
      if (is_zero(*from)) return build_.expr(ir::ExprKind::kZero, from->type);
      if (is_made_whole(*from)) {
        return with_operands(from, [&](const ir::Expr* operand) { return constant(operand); });
      }
      std::vector<const ir::Expr*> parts;
      for (uint32_t i = 0; i < from->type->columns; ++i) {
        parts.push_back(constant(component(from, build_.uint32(i))));
      }
      ir::Expr* to = build_.expr(ir::ExprKind::kConstruct, from->type);
      to->operands = std::move(parts);
      return to;
    }
    if (has_long_operand(*from)) {
      if (from->kind == ir::ExprKind::kElement &&
          from->operands[1]->kind == ir::ExprKind::kLiteral && !is_made_whole(*from->operands[0])) {
        return constant(component(from->operands[0], from->operands[1]));
      }
      if (from->kind == ir::ExprKind::kTruncate) {
        std::vector<const ir::Expr*> parts;
        for (uint32_t i = 0; i < from->type->columns; ++i) {
          parts.push_back(constant(component(from->operands[0], build_.uint32(i))));
        }
        return build_.construct(from->type, std::move(parts));
      }
      if (from->kind == ir::ExprKind::kSwizzle) {
        std::vector<const ir::Expr*> parts;
        for (const uint8_t one : from->components) {
          parts.push_back(constant(component(from->operands[0], build_.uint32(one))));
        }
        return build_.construct(from->type, std::move(parts));
      }
      if (from->kind == ir::ExprKind::kIntrinsic) {
        const ir::Expr* result =
            from->intrinsic == Intrinsic::all ? build_.boolean(true) : build_.zero(from->type);
        for (uint32_t i = 0; i < from->operands[0]->type->columns; ++i) {
          result = with_component(*from, from->operands, result, build_.uint32(i));
        }
        return constant(result);
      }
    }
    return with_operands(from, [&](const ir::Expr* operand) { return constant(operand); });
  }

  // -- Types

  const ir::Type* array_type(const ir::Type* type) {
    if (type->is_long_vector()) {
      return build_.types().array(build_.scalar_type(type->scalar), type->columns);
    }
    const bool holds = type->element && (type->kind == ir::TypeKind::kArray ||
                                         type->kind == ir::TypeKind::kResource);
    if (!holds) return type;
    const ir::Type* element = array_type(type->element);
    if (element == type->element) return type;
    return type->kind == ir::TypeKind::kArray ? build_.types().array(element, type->count)
                                              : build_.types().resource(type->resource, element);
  }

  void give_types() {
    std::map<const ir::Type*, const ir::Type*> made;
    const auto give = [&](const ir::Type*& type) {
      if (!type) return;
      const auto [entry, is_new] = made.try_emplace(type, nullptr);
      if (is_new) entry->second = array_type(type);
      type = entry->second;
    };
    for (ir::Expr& one : module_.expr_pool) give(one.type);
    for (ir::Variable& one : module_.variable_pool) give(one.type);
    for (ir::Function& one : module_.function_pool) give(one.result);
    for (ir::Binding& one : module_.bindings) give(one.type);
    for (ir::Struct& one : module_.struct_pool) {
      for (ir::Field& field : one.fields) give(field.type);
    }
  }

  ir::Module& module_;
  IrBuilder& build_;
  ir::Block* out_ = nullptr;
  // The last loop that assignments may share.
  const ir::Stmt* shared_loop_ = nullptr;
  const ir::Expr* shared_index_ = nullptr;
  ir::Block* shared_body_ = nullptr;
  uint32_t shared_count_ = 0;
  std::map<std::pair<const ir::Type*, std::vector<uint64_t>>, ir::Variable*> constants_;
};

}  // namespace

void make_long_vectors_arrays(ir::Module& module, IrBuilder& build) {
  const bool has_any = std::any_of(module.type_pool.begin(), module.type_pool.end(),
                                   [](const ir::Type& type) { return type.is_long_vector(); });
  if (has_any) LongVectors(module, build).run();
}

}  // namespace kaamos::hlsl
