// SPDX-License-Identifier: MIT
// The counters of structured buffers, and append and consume buffers, which use them.
// [HLSL: RWStructuredBuffer, AppendStructuredBuffer, ConsumeStructuredBuffer]
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {
namespace {

constexpr uint8_t kGoesUp = 1;
constexpr uint8_t kGoesDown = 2;

}  // namespace

// The counter's value before it goes up, or after it went down.
const ir::Expr* Lowerer::change_counter(const ir::Expr* resource, bool up,
                                        SourceLocation location) {
  if (const auto found = checker_.binding_of_.find(resource); found != checker_.binding_of_.end()) {
    uint8_t& uses = counter_uses_[found->second];
    uses |= up ? kGoesUp : kGoesDown;
    if (uses == (kGoesUp | kGoesDown)) {
      report(CheckId::kCounterBothWays, location, {std::string(found->second->name)});
      return nullptr;
    }
  }
  at(location);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAtomic);
  statement->target = ir::AtomicTarget::kCounter;
  statement->operands = {resource};
  statement->atomic = ir::AtomicOp::kAdd;
  statement->value = build_.uint32(up ? 1 : 0xFFFFFFFFu);
  const ir::Variable* before = empty_temporary(types_.scalar(Scalar::kUint32)->ir);
  statement->result = before;
  emit(statement);
  const ir::Expr* value = build_.read(before);
  return up ? value : build_.binary(ir::BinaryOp::kSubtract, value, build_.uint32(1));
}

std::optional<Value> Lowerer::call_counter_method(const Value& object, std::string_view name,
                                                  std::vector<Value>& arguments,
                                                  SourceLocation location) {
  using K = ir::ResourceKind;
  const Type* type = object.type;
  const bool counts = type->resource == K::kRWStructuredBuffer &&
                      (name == "IncrementCounter" || name == "DecrementCounter");
  const bool appends = type->resource == K::kAppendStructuredBuffer && name == "Append";
  const bool consumes = type->resource == K::kConsumeStructuredBuffer && name == "Consume";
  if (!counts && !appends && !consumes) return std::nullopt;
  const size_t count = appends ? 1 : 0;
  if (!check_count(name, arguments.size(), count, count, location)) return error_value();
  const ir::Expr* resource = load(object);
  if (!resource) return error_value();
  const ir::Expr* value = nullptr;
  if (appends) {
    value = convert(arguments[0], type->element, arguments[0].location);
    if (!value) return error_value();
    value = build_.read(temporary(value));
  }
  const bool up = appends || name == "IncrementCounter";
  const ir::Expr* index = change_counter(resource, up, location);
  if (!index) return error_value();
  if (counts) return rvalue(index, types_.scalar(Scalar::kUint32));
  const Value element = memory(resource, build_.read(temporary(index)), build_.uint32(0),
                               type->element, ir::Layout::kStructured, false);
  if (appends) {
    store(element, value);
    return rvalue(build_.int32(0), types_.void_type());
  }
  return rvalue(build_.read(temporary(load(element))), type->element);
}

}  // namespace kaamos::hlsl
