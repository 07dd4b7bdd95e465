// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/body.h"

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {

void Body::emit(const ir::Stmt* statement) {
  block->push_back(statement);
  if (statement->kind != ir::StmtKind::kDeclare) ++effects;
}

const ir::Variable* Body::temporary(const ir::Expr* value, size_t* position) {
  ir::Variable* variable = build_.variable({}, value->type, ir::Storage::kLocal);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kDeclare);
  statement->variable = variable;
  statement->value = value;
  if (position) {
    block->insert(block->begin() + static_cast<ptrdiff_t>((*position)++), statement);
  } else {
    emit(statement);
  }
  return variable;
}

ir::Variable* Body::empty_temporary(const ir::Type* type) {
  ir::Variable* variable = build_.variable({}, type, ir::Storage::kLocal);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kDeclare);
  statement->variable = variable;
  emit(statement);
  return variable;
}

const ir::Expr* Body::repeatable(const ir::Expr* value) {
  const ir::Expr* at_expr = value;
  for (int i = 0; i < 3; ++i) {
    switch (at_expr->kind) {
      case ir::ExprKind::kLiteral:
      case ir::ExprKind::kZero:
      case ir::ExprKind::kVariable:
      case ir::ExprKind::kConstruct:
        return value;
      case ir::ExprKind::kField:
      case ir::ExprKind::kSwizzle:
      case ir::ExprKind::kMatrixSwizzle:
        at_expr = at_expr->operands[0];
        continue;
      default:
        return build_.read(temporary(value));
    }
  }
  return build_.read(temporary(value));
}

void Body::assign(const ir::Variable* variable, const ir::Expr* value) {
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAssign);
  statement->place = build_.read(variable);
  statement->value = value;
  emit(statement);
}

BodyScope::BodyScope(Lowerer& lowerer, FunctionInfo* function, ir::Block* block, Scope* scope)
    : body_(lowerer.body),
      names_(lowerer.names),
      build_(lowerer.bench.build),
      function_(body_.function),
      block_(body_.block),
      scope_(body_.scope),
      this_(body_.this_variable),
      loops_(body_.loop_depth),
      switches_(body_.switch_depth),
      dead_(body_.dead_depth),
      unused_(body_.result_unused),
      location_(build_.location),
      view_(names_.view()) {
  names_.enter(scope);
  body_.function = function;
  body_.block = block;
  body_.scope = scope;
  body_.this_variable = nullptr;
  body_.loop_depth = body_.switch_depth = body_.dead_depth = 0;
  body_.result_unused = false;
}

BodyScope::~BodyScope() {
  body_.function = function_;
  body_.block = block_;
  body_.scope = scope_;
  body_.this_variable = this_;
  body_.loop_depth = loops_;
  body_.switch_depth = switches_;
  body_.dead_depth = dead_;
  body_.result_unused = unused_;
  build_.location = location_;
  names_.set_view(view_);
}

}  // namespace kaamos::hlsl
