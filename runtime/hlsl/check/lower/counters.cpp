// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/counters.h"

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {
namespace {

constexpr uint8_t kGoesUp = 1;
constexpr uint8_t kGoesDown = 2;

}  // namespace

// The counter's value before it goes up, or after it went down.
const ir::Expr* Counters::change_counter(const ir::Expr* resource, bool up,
                                         SourceLocation location) {
  if (const BindingInfo* binding = lower_.places.binding_of(resource)) {
    uint8_t& uses = counter_uses_[binding];
    uses |= up ? kGoesUp : kGoesDown;
    if (uses == (kGoesUp | kGoesDown)) {
      report(CheckId::kCounterBothWays, location, {std::string(binding->name)});
      return nullptr;
    }
  }
  at(location);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAtomic);
  statement->target = ir::AtomicTarget::kCounter;
  statement->operands = {resource};
  statement->atomic = ir::AtomicOp::kAdd;
  statement->value = build_.uint32(up ? 1 : 0xFFFFFFFFu);
  const ir::Variable* before = body_.empty_temporary(types_.scalar(Scalar::kUint32)->ir);
  statement->result = before;
  body_.emit(statement);
  const ir::Expr* value = build_.read(before);
  return up ? value : build_.binary(ir::BinaryOp::kSubtract, value, build_.uint32(1));
}

std::optional<Value> Counters::call_counter_method(const Value& object, std::string_view name,
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
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location))
    return error_value();
  const ir::Expr* resource = lower_.places.load(object);
  if (!resource) return error_value();
  const ir::Expr* value = nullptr;
  if (appends) {
    value = lower_.conversions.convert(arguments[0], type->element, arguments[0].location);
    if (!value) return error_value();
    value = build_.read(body_.temporary(value));
  }
  const bool up = appends || name == "IncrementCounter";
  const ir::Expr* index = change_counter(resource, up, location);
  if (!index) return error_value();
  if (counts) return rvalue(index, types_.scalar(Scalar::kUint32));
  const Value element = memory(resource, build_.read(body_.temporary(index)), build_.uint32(0),
                               type->element, ir::Layout::kStructured, false);
  if (appends) {
    lower_.places.store(element, value);
    return rvalue(build_.int32(0), types_.void_type());
  }
  return rvalue(build_.read(body_.temporary(lower_.places.load(element))), type->element);
}

}  // namespace kaamos::hlsl
