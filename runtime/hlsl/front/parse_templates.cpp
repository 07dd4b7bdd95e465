// SPDX-License-Identifier: MIT
// template<...> before functions, structs and aliases.
#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {

void Parser::template_declaration(Prefix& prefix, DeclList& out) {
  const size_t open = pos_ + 1;
  advance();
  if (!at(Kind::kLess) && prefix.outer_parameters.empty()) {
    // `template void f<int>(int);` asks for an instance.
    prefix.is_specialization = prefix.is_instantiation = true;
    return simple_declaration(prefix, out);
  }
  if (!expect(Kind::kLess, "'<' after 'template'")) return;
  prefix.is_specialization = at(Kind::kGreater);
  prefix.scope = scope_of(prefix);
  InScope inside(*this, scopes_.create(scopes_.current()));
  std::vector<TemplateParameter> found;
  if (!prefix.is_specialization) template_parameters(found);
  expect_template_end(open);
  if (panic_) return;
  prefix.is_template = !prefix.is_specialization;
  prefix.outer_parameters = prefix.template_parameters;
  prefix.template_parameters = list(found);
  if (at_attribute()) {
    std::vector<Attribute> all(prefix.attributes.begin(), prefix.attributes.end());
    attributes(all);
    prefix.attributes = list(all);
  }
  switch (token().kind) {
    case Kind::kUsing:
      if (peek(2).is(Kind::kEqual)) return using_declaration(prefix, out);
      break;
    case Kind::kTemplate:
      // A second list belongs to a member of what the first one is for.
      if (prefix.outer_parameters.empty()) return template_declaration(prefix, out);
      break;
    case Kind::kTypedef:
    case Kind::kNamespace:
    case Kind::kCbuffer:
    case Kind::kTbuffer:
    case Kind::kEnum:
    case Kind::kSemicolon:
    case Kind::kRightBrace:
      break;
    default:
      return simple_declaration(prefix, out);
  }
  fail_here(DiagnosticId::kTemplateOfWhat, {describe(token())});
}

void Parser::template_parameters(std::vector<TemplateParameter>& out) {
  do {
    out.push_back(template_parameter());
  } while (!panic_ && accept(Kind::kComma));
}

TemplateParameter Parser::template_parameter() {
  TemplateParameter result{.location = here(), .name = {}};
  const bool is_type = at(Kind::kTypename) || at(Kind::kClass);
  if (is_type) {
    advance();
  } else if (at(Kind::kTemplate) || behind_type(pos_) == pos_) {
    fail_here(DiagnosticId::kTemplateParameterExpected, {describe(token())});
    return result;
  } else {
    result.value_type = type_without_bounds();
  }
  if (at(Kind::kEllipsis)) {
    fail_here(DiagnosticId::kNoVariadic, {"template parameters"});
    return result;
  }
  if (at_name()) {
    const Token* name = expect_name("a template parameter");
    if (name == nullptr) return result;
    result.name = name->text;
    result.location = name->location;
    if (is_type) {
      scopes_.declare(scopes_.current(), name->value,
                      {ParsedKind::kTypeParameter, kDependentScope});
    } else {
      scopes_.declare_value(scopes_.current(), *name);
    }
  }
  if (panic_ || !accept(Kind::kEqual)) return result;
  if (is_type) {
    result.default_type = type_name();
  } else {
    Setting setting(greater_is_operator_, false);
    result.default_value = conditional();
  }
  return result;
}

}  // namespace kaamos::hlsl
