// SPDX-License-Identifier: MIT
// The main loop: files in, language tokens out.
#include "runtime/hlsl/front/preprocess.h"

#include <utility>

#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

std::string folder_of(std::string_view path) {
  size_t slash = path.find_last_of('/');
  return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash + 1));
}

std::string describe_character(std::string_view bytes) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  auto first = static_cast<unsigned char>(bytes[0]);
  if (first > 0x20 && first != 0x7F && (first < 0x80 || bytes.size() > 1)) {
    return "'" + std::string(bytes) + "'";
  }
  return std::string("0x") + kHex[first >> 4] + kHex[first & 15];
}

}  // namespace

Preprocessor::Preprocessor(const PreprocessOptions& options, SourceManager& sources,
                           DiagnosticEngine& diagnostics)
    : options_(options), sources_(sources), diagnostics_(diagnostics) {
  va_args_ = identifiers_.intern("__VA_ARGS__");
  va_opt_ = identifiers_.intern("__VA_OPT__");
  defined_ = identifiers_.intern("defined");
  has_include_ = identifiers_.intern("__has_include");
  make_builtin("__LINE__", BuiltinMacro::kLine);
  make_builtin("__FILE__", BuiltinMacro::kFile);
  make_builtin("__COUNTER__", BuiltinMacro::kCounter);
}

// [DXC: Predefined Version Macros]
void Preprocessor::define_predefined(std::string& text) const {
  auto define = [&](std::string_view name, uint32_t value) {
    text += "#define " + std::string(name) + " " + std::to_string(value) + "\n";
  };
  define("__hlsl_dx_compiler", 1);
  define("__HLSL_VERSION", options_.hlsl_version);
  define("__SHADER_TARGET_MAJOR", options_.shader_model_major);
  define("__SHADER_TARGET_MINOR", options_.shader_model_minor);
  define("__SHADER_TARGET_STAGE", static_cast<uint32_t>(options_.stage));
  define("__SHADER_STAGE_PIXEL", static_cast<uint32_t>(ShaderStage::kPixel));
  define("__SHADER_STAGE_VERTEX", static_cast<uint32_t>(ShaderStage::kVertex));
  define("__SHADER_STAGE_GEOMETRY", static_cast<uint32_t>(ShaderStage::kGeometry));
  define("__SHADER_STAGE_HULL", static_cast<uint32_t>(ShaderStage::kHull));
  define("__SHADER_STAGE_DOMAIN", static_cast<uint32_t>(ShaderStage::kDomain));
  define("__SHADER_STAGE_COMPUTE", static_cast<uint32_t>(ShaderStage::kCompute));
  define("__SHADER_STAGE_LIBRARY", static_cast<uint32_t>(ShaderStage::kLibrary));
  define("__SHADER_STAGE_MESH", static_cast<uint32_t>(ShaderStage::kMesh));
  define("__SHADER_STAGE_AMPLIFICATION", static_cast<uint32_t>(ShaderStage::kAmplification));
  // The DXC release whose rules are followed; headers test for a minimum version.
  define("__DXC_VERSION_MAJOR", 1);
  define("__DXC_VERSION_MINOR", 8);
  define("__DXC_VERSION_RELEASE", 2407);
  define("__DXC_VERSION_COMMITS", 0);
  if (options_.enable_16bit_types) define("__HLSL_ENABLE_16_BIT", 1);
}

// Each option is a text of its own, so that a comment or line continuation in a value ends with it.
std::vector<SourceText*> Preprocessor::define_options() const {
  std::vector<SourceText*> texts;
  for (const std::string& option : options_.defines) {
    size_t equal = option.find('=');
    // A macro with parameters, `F(x)=x`, keeps them: what is wrong with them is told like in a
    // file.
    const size_t parenthesis = option.substr(0, equal).find('(');
    std::string name = option.substr(0, std::min(parenthesis, equal));
    std::string value = equal == std::string::npos ? "1" : option.substr(equal + 1);
    const std::string parameters =
        parenthesis == std::string::npos ? "" : option.substr(parenthesis, equal - parenthesis);
    bool is_name = !name.empty() && !(name[0] >= '0' && name[0] <= '9');
    for (char c : name) {
      is_name = is_name && (c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                            (c >= 'A' && c <= 'Z'));
    }
    if (!is_name || option.find_first_of("\r\n") != std::string::npos || name == "defined") {
      diagnostics_.report(DiagnosticId::kDefineOptionMalformed, {}, {option});
      continue;
    }
    texts.push_back(
        sources_.add_text("<command line>", "#define " + name + parameters + " " + value + "\n"));
  }
  return texts;
}

TokenList Preprocessor::run(SourceText* main) {
  std::string predefined;
  define_predefined(predefined);
  read_definitions(sources_.add_text("<predefined>", std::move(predefined)));
  for (auto& macro : macros_) macro->is_predefined = true;
  for (SourceText* option : define_options()) read_definitions(option);

  output_.tokens.reserve(main->text.size() / 4);
  if (enter_file(main, {}, folder_of(main->path))) {
    for (;;) {
      Token token = next_expanded();
      emit(token);
      if (token.is(TokenKind::kEndOfFile)) break;
    }
  }
  finish_string();
  bool has_end = !output_.tokens.empty() && output_.tokens.back().is(TokenKind::kEndOfFile);
  if (!has_end) output_.tokens.emplace_back();
  return std::move(output_);
}

void Preprocessor::read_definitions(SourceText* text) {
  if (!enter_file(text, {}, "")) return;
  while (!next_expanded().is(TokenKind::kEndOfFile)) {
  }
}

// Turns a preprocessing token into a token [C++: translation phase 7].
void Preprocessor::emit(Token token) {
  if (token.is(TokenKind::kStringLiteral)) return emit_string(token);
  finish_string();
  switch (token.kind) {
    case TokenKind::kIdentifier:
      token.kind = identifiers_[token.value].keyword;
      break;
    case TokenKind::kCharacter:
    case TokenKind::kNumber: {
      const auto parse = token.is(TokenKind::kNumber) ? parse_number : parse_character;
      NumberLiteral number = parse(token.text, token.location, diagnostics_);
      token.kind = number.is_float ? TokenKind::kFloatLiteral : TokenKind::kIntLiteral;
      token.value = static_cast<uint32_t>(output_.numbers.size());
      output_.numbers.push_back(number);
      break;
    }
    case TokenKind::kUnknown:
      if (token.flags & Token::kQuotedBroken) {
        diagnostics_.report(token.text[0] == '"' ? DiagnosticId::kUnterminatedString
                                                 : DiagnosticId::kUnterminatedCharacter,
                            token.location);
      } else {
        diagnostics_.report(DiagnosticId::kUnexpectedCharacter, token.location,
                            {describe_character(token.text)});
      }
      return;
    default:
      break;
  }
  output_.tokens.push_back(token);
}

// Adjacent strings become one, which gets its text when a different token follows.
void Preprocessor::emit_string(const Token& token) {
  if (!is_joining_) output_.tokens.push_back(token);
  is_joining_ = true;
  joined_ += parse_quoted(token.text, token.location, diagnostics_);
}

void Preprocessor::finish_string() {
  if (!is_joining_) return;
  output_.tokens.back().text = sources_.keep(std::exchange(joined_, {}));
  is_joining_ = false;
}

void Preprocessor::fatal() {
  is_fatal_ = true;
  for (Frame& frame : frames_) {
    if (frame.macro) frame.macro->is_disabled = false;
  }
  frames_.clear();
}

// A token of the innermost file; directives are carried out on the way.
Token Preprocessor::read_file_token() {
  for (;;) {
    if (is_fatal_ || diagnostics_.should_stop()) return stop_token(TokenKind::kEndOfFile);
    if (pending_) {
      Token token = *pending_;
      pending_.reset();
      return token;
    }
    Token token = lexer().next();
    bool is_directive = token.is(TokenKind::kHash) && (token.flags & Token::kAtLineStart) &&
                        !lexer().in_directive();
    if (is_directive) {
      read_directive(token);
      continue;
    }
    if (!token.is(TokenKind::kEndOfFile)) return token;
    // A macro's arguments do not extend past the end of a file.
    if (!collecting_.empty()) return token;
    leave_file();
    if (files_.empty()) return token;
  }
}

bool Preprocessor::enter_file(SourceText* text, SourceLocation included_from, std::string folder) {
  std::optional<SourceManager::FileIndex> index = sources_.add_file(text, included_from);
  if (!index) {
    diagnostics_.report(DiagnosticId::kTooMuchSource, included_from,
                        {"all included files together have more than 2 GiB"});
    fatal();
    return false;
  }
  files_.push_back(std::make_unique<OpenFile>(
      OpenFile{text, std::move(folder), Lexer(sources_, *index, identifiers_, &diagnostics_), {}}));
  return true;
}

void Preprocessor::leave_file() {
  for (const Conditional& conditional : file().conditionals) {
    diagnostics_.report(DiagnosticId::kUnterminatedConditional, conditional.location,
                        {conditional.keyword});
  }
  files_.pop_back();
}

TokenList preprocess_file(const std::string& path, const PreprocessOptions& options,
                          SourceManager& sources, DiagnosticEngine& diagnostics) {
  std::string error;
  SourceText* text = sources.load(path, &error);
  if (!text) {
    diagnostics.report(DiagnosticId::kMainFileNotFound, {},
                       {path, error.empty() ? "there is no such file" : error});
    TokenList result;
    result.tokens.emplace_back();
    return result;
  }
  return Preprocessor(options, sources, diagnostics).run(text);
}

TokenList preprocess_text(std::string name, std::string text, const PreprocessOptions& options,
                          SourceManager& sources, DiagnosticEngine& diagnostics) {
  SourceText* main = sources.add_text(std::move(name), std::move(text));
  return Preprocessor(options, sources, diagnostics).run(main);
}

}  // namespace kaamos::hlsl
