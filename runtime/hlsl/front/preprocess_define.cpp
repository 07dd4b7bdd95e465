// SPDX-License-Identifier: MIT
// #define: parameters and body are checked and split up once, here.
#include <algorithm>

#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

bool equal_bodies(const Macro& a, const Macro& b) {
  auto equal = [](const MacroItem& x, const MacroItem& y) {
    constexpr uint8_t kSpace = Token::kSpaceBefore;
    return x.role == y.role && x.token.text == y.token.text && x.parameter == y.parameter &&
           (x.token.flags & kSpace) == (y.token.flags & kSpace);
  };
  return a.builtin == b.builtin && a.is_function_like == b.is_function_like &&
         a.is_variadic == b.is_variadic && a.parameters == b.parameters &&
         std::equal(a.body.begin(), a.body.end(), b.body.begin(), b.body.end(), equal);
}

// Splits up the tokens of a body; stops at the first error.
class BodyReader {
 public:
  BodyReader(Macro& macro, const std::vector<Token>& tokens, uint32_t va_args, uint32_t va_opt,
             DiagnosticEngine& diagnostics)
      : macro_(macro),
        tokens_(tokens),
        va_args_(va_args),
        va_opt_(va_opt),
        diagnostics_(diagnostics) {}

  bool read() {
    while (next_ < tokens_.size() && is_valid_) read_item();
    if (is_valid_ && begin_ != kNone) {
      fail(DiagnosticId::kVaOptMalformed, macro_.body[begin_].token, {});
    }
    return is_valid_;
  }

 private:
  static constexpr size_t kNone = SIZE_MAX;

  void fail(DiagnosticId id, const Token& token,
            std::initializer_list<std::string_view> arguments) {
    diagnostics_.report(id, token.location, arguments);
    is_valid_ = false;
  }

  // Index of the parameter, or the number of parameters if it is not one.
  size_t parameter_of(const Token& token) const {
    if (!token.is(TokenKind::kIdentifier)) return macro_.parameters.size();
    auto found = std::find(macro_.parameters.begin(), macro_.parameters.end(), token.value);
    return static_cast<size_t>(found - macro_.parameters.begin());
  }

  void read_item() {
    const Token& token = tokens_[next_++];
    MacroItem item;
    item.token = token;
    size_t parameter = parameter_of(token);
    bool is_name = token.is(TokenKind::kIdentifier);
    if (is_name && token.value == va_opt_ && macro_.is_variadic) {
      read_va_opt(item);
    } else if (parameter < macro_.parameters.size()) {
      item.role = MacroItem::kParameter;
      item.parameter = static_cast<uint32_t>(parameter);
    } else if (is_name && (token.value == va_args_ || token.value == va_opt_)) {
      fail(DiagnosticId::kVaArgsOutsideVariadic, token, {token.text});
    } else if (token.is(TokenKind::kHash) && macro_.is_function_like) {
      read_stringize(item);
    } else if (token.is(TokenKind::kHashHash)) {
      item.role = MacroItem::kPaste;
    } else if (begin_ != kNone && token.is(TokenKind::kLeftParen)) {
      ++parens_;
    } else if (begin_ != kNone && token.is(TokenKind::kRightParen) && parens_-- == 0) {
      item.role = MacroItem::kVaOptEnd;
      macro_.body[begin_].end = static_cast<uint32_t>(macro_.body.size());
      begin_ = kNone;
    }
    macro_.body.push_back(item);
  }

  void read_va_opt(MacroItem& item) {
    if (begin_ != kNone) return fail(DiagnosticId::kVaOptNested, item.token, {});
    if (next_ == tokens_.size() || !tokens_[next_].is(TokenKind::kLeftParen)) {
      return fail(DiagnosticId::kVaOptMalformed, item.token, {});
    }
    item.role = MacroItem::kVaOptBegin;
    begin_ = macro_.body.size();
    parens_ = 0;
    ++next_;
  }

  void read_stringize(MacroItem& item) {
    Token operand;
    operand.kind = TokenKind::kEndOfDirective;
    if (next_ < tokens_.size()) operand = tokens_[next_++];
    size_t parameter = parameter_of(operand);
    if (parameter == macro_.parameters.size()) {
      return fail(DiagnosticId::kStringizeNeedsParameter, item.token,
                  {macro_.name, describe(operand)});
    }
    item.role = MacroItem::kStringize;
    item.parameter = static_cast<uint32_t>(parameter);
  }

  Macro& macro_;
  const std::vector<Token>& tokens_;
  const uint32_t va_args_;
  const uint32_t va_opt_;
  DiagnosticEngine& diagnostics_;
  size_t next_ = 0;
  size_t begin_ = kNone;  // Index of the open __VA_OPT__ in the body.
  uint32_t parens_ = 0;   // Open parentheses inside it.
  bool is_valid_ = true;
};

}  // namespace

Macro* Preprocessor::make_builtin(std::string_view name, BuiltinMacro builtin) {
  auto macro = std::make_unique<Macro>();
  macro->name = name;
  macro->builtin = builtin;
  macros_.push_back(std::move(macro));
  identifiers_[identifiers_.intern(name)].macro = macros_.back().get();
  return macros_.back().get();
}

void Preprocessor::directive_define() {
  std::optional<Token> name = read_macro_name("define");
  if (!name) return finish_directive();
  if (name->value == va_args_ || name->value == va_opt_) {
    diagnostics_.report(DiagnosticId::kVaArgsOutsideVariadic, name->location, {name->text});
    return finish_directive();
  }
  auto macro = std::make_unique<Macro>();
  macro->name = name->text;
  macro->location = name->location;
  bool is_valid = read_parameters(*macro) && read_body(*macro);
  finish_directive();
  if (is_valid) set_macro(name->value, std::move(macro));
}

void Preprocessor::set_macro(uint32_t identifier, std::unique_ptr<Macro> macro) {
  Macro*& current = identifiers_[identifier].macro;
  if (current && current->is_predefined) {
    diagnostics_.report(DiagnosticId::kBuiltinMacroChanged, macro->location,
                        {"define", macro->name});
  } else if (current && !equal_bodies(*current, *macro)) {
    diagnostics_.report(DiagnosticId::kMacroRedefined, macro->location, {macro->name})
        .note(current->location, "the previous definition is here");
  }
  // The old one stays alive, because an expansion of it may be in progress.
  macros_.push_back(std::move(macro));
  current = macros_.back().get();
}

// A `(` begins a parameter list only if it follows the name directly.
bool Preprocessor::read_parameters(Macro& macro) {
  if (!lexer().is_left_paren_adjacent()) return true;
  lexer().next();
  macro.is_function_like = true;
  Token token = lexer().next();
  if (token.is(TokenKind::kRightParen)) return true;
  for (;;) {
    if (token.is(TokenKind::kEllipsis)) {
      macro.is_variadic = true;
      macro.parameters.push_back(va_args_);
      token = lexer().next();
    } else if (token.is(TokenKind::kIdentifier) && token.value != va_args_ &&
               token.value != va_opt_) {
      if (std::count(macro.parameters.begin(), macro.parameters.end(), token.value)) {
        diagnostics_.report(DiagnosticId::kMacroParameterTwice, token.location,
                            {macro.name, token.text});
        return false;
      }
      macro.parameters.push_back(token.value);
      token = lexer().next();
      // `name...`: a named variadic parameter [GNU].
      if (token.is(TokenKind::kEllipsis)) {
        macro.is_variadic = true;
        token = lexer().next();
      }
    } else {
      diagnostics_.report(DiagnosticId::kMacroParameterExpected, token.location,
                          {macro.name, describe(token)});
      return false;
    }
    if (token.is(TokenKind::kRightParen)) return true;
    if (!token.is(TokenKind::kComma) || macro.is_variadic) {
      diagnostics_.report(DiagnosticId::kMacroParametersUnclosed, token.location,
                          {macro.name, describe(token)});
      return false;
    }
    token = lexer().next();
  }
}

bool Preprocessor::read_body(Macro& macro) {
  Tokens tokens;
  for (Token token = lexer().next(); !token.is(TokenKind::kEndOfDirective);
       token = lexer().next()) {
    tokens.push_back(token);
  }
  if (!tokens.empty()) tokens[0].flags &= static_cast<uint8_t>(~Token::kSpaceBefore);
  BodyReader reader(macro, tokens, va_args_, va_opt_, diagnostics_);
  return reader.read() && check_pastes(macro);
}

// `##` needs an operand on both sides, even inside __VA_OPT__.
bool Preprocessor::check_pastes(const Macro& macro) {
  for (size_t i = 0; i < macro.body.size(); ++i) {
    if (macro.body[i].role != MacroItem::kPaste) continue;
    bool is_first = i == 0 || macro.body[i - 1].role == MacroItem::kVaOptBegin;
    bool is_last = i + 1 == macro.body.size() || macro.body[i + 1].role == MacroItem::kVaOptEnd;
    if (!is_first && !is_last) continue;
    diagnostics_.report(DiagnosticId::kPasteAtEdge, macro.body[i].token.location,
                        {is_first ? "beginning" : "end"});
    return false;
  }
  return true;
}

}  // namespace kaamos::hlsl
