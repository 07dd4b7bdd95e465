// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/coverage.h"

#include <algorithm>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {
namespace {

// Variables without a value are no code.
bool has_code(const DeclStmt& statement) {
  return std::ranges::any_of(statement.declarations, [](const Decl* decl) {
    const auto* variable = as<VariableDecl>(decl);
    return variable && variable->initializer && (variable->modifiers & kModStatic) == 0;
  });
}

}  // namespace

bool Coverage::is_on() const {
  return names_.options().coverage && body_.dead_depth == 0;
}

bool Coverage::has_arms(SourceLocation location) const {
  return is_on() && !location.is_macro();
}

const ir::Stmt* Coverage::cover(const ir::CoveragePoint& point) {
  auto& all = bench_.module.coverage;
  const ir::Location& at = point.location;
  const auto [known, is_new] = points_.try_emplace(Key(at.file, at.line, at.column, point.arm),
                                                   static_cast<uint32_t>(all.size()));
  if (is_new) all.push_back(point);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kCover);
  statement->point = known->second;
  return statement;
}

const ir::Stmt* Coverage::arm(SourceLocation location, size_t number) {
  return cover({locate(location), true, static_cast<uint32_t>(number)});
}

void Coverage::line(SourceLocation location) {
  if (!is_on()) return;
  ir::CoveragePoint point = {locate(location)};
  point.location.column = 0;
  const ir::Stmt* statement = cover(point);
  const ir::Block& block = *body_.block;
  const bool is_told = !block.empty() && block.back()->kind == ir::StmtKind::kCover &&
                       block.back()->point == statement->point;
  if (!is_told) body_.block->push_back(statement);
}

void Coverage::statement(const Stmt& statement) {
  switch (statement.kind) {
    case StmtKind::kError:
    case StmtKind::kEmpty:
    case StmtKind::kBlock:
      return;
    case StmtKind::kDecl:
      if (has_code(static_cast<const DeclStmt&>(statement))) line(statement.location);
      return;
    default:
      return line(statement.location);
  }
}

void Coverage::arms(ir::Block& then, ir::Block& orelse, SourceLocation location) {
  if (!has_arms(location)) return;
  then.push_back(arm(location, 0));
  orelse.push_back(arm(location, 1));
}

void Coverage::sides(ir::Block& first, ir::Block& second, SourceLocation location) {
  if (names_.options().hlsl_version >= 2021) arms(first, second, location);
}

void Coverage::loop(ir::Stmt& node, SourceLocation location) {
  if (!has_arms(location) || !node.value || evaluate(node.value)) return;
  at(location);
  ir::Block* outer = body_.block;
  body_.block = &node.prelude;
  const ir::Expr* goes_on = build_.read(body_.temporary(node.value));
  ir::Stmt* test = build_.stmt(ir::StmtKind::kIf);
  test->value = goes_on;
  arms(test->body, test->orelse, location);
  body_.emit(test);
  body_.block = outer;
  node.value = goes_on;
}

void Coverage::section(const ir::Stmt& node, SourceLocation location) {
  if (!has_arms(location) || evaluate(node.value)) return;
  body_.block->push_back(arm(location, node.cases.size()));
}

void Coverage::no_section(ir::Stmt& node, SourceLocation location) {
  if (!has_arms(location) || evaluate(node.value)) return;
  ir::SwitchCase one;
  one.is_default = true;
  one.body.push_back(arm(location, node.cases.size()));
  if (!node.cases.empty() && !Statements::ends(node.cases.back().body)) {
    node.cases.back().body.push_back(build_.stmt(ir::StmtKind::kBreak));
  }
  node.cases.push_back(std::move(one));
}

}  // namespace kaamos::hlsl
