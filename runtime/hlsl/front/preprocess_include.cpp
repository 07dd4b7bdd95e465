// SPDX-License-Identifier: MIT
// #include and __has_include: reading the name, finding the file.
#include <algorithm>

#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/preprocessor.h"

namespace kaamos::hlsl {
namespace {

bool is_absolute(std::string_view path) {
  bool has_drive = path.size() > 2 && path[1] == ':' && path[2] == '/';
  return path.starts_with('/') || has_drive;
}

std::string folder_of(const std::string& path) {
  size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

std::string joined(std::string folder, std::string_view name) {
  if (!folder.empty() && folder.back() != '/' && folder.back() != '\\') folder += '/';
  return normalize_path(folder + std::string(name));
}

}  // namespace

// Reads "name", <name> or a macro that expands to one of them, and leaves the rest of the line.
std::optional<Preprocessor::IncludeName> Preprocessor::read_include_name(const Token& directive) {
  Token token;
  // Only in the file itself does `<name>` appear as written; a macro gives it in pieces.
  bool is_from_file = std::all_of(frames_.begin(), frames_.end(), [](const Frame& frame) {
    return frame.next == frame.tokens.size();
  });
  if (is_from_file && lexer().read_angled_name(token))
    return IncludeName{std::string(token.text), true};
  Tokens tokens;
  for (;;) {
    token = next_expanded();
    if (token.is(TokenKind::kEndOfDirective) || token.is(TokenKind::kEndOfFile)) break;
    tokens.push_back(token);
    bool is_name = tokens[0].is(TokenKind::kStringLiteral) || token.is(TokenKind::kGreater);
    if (is_name) break;
  }
  return include_name_of(tokens, directive);
}

std::optional<Preprocessor::IncludeName> Preprocessor::include_name_of(const Tokens& tokens,
                                                                       const Token& directive) {
  if (!tokens.empty() && tokens[0].is(TokenKind::kStringLiteral)) {
    std::string_view text = tokens[0].text;
    // A `\` separates folders here and is not an escape.
    return IncludeName{std::string(text.substr(1, text.size() - 2)), false};
  }
  bool is_angled =
      tokens.size() > 2 && tokens[0].is(TokenKind::kLess) && tokens.back().is(TokenKind::kGreater);
  if (is_angled) {
    std::string name;
    for (size_t i = 1; i + 1 < tokens.size(); ++i) {
      if (i > 1 && (tokens[i].flags & Token::kSpaceBefore)) name += ' ';
      name += tokens[i].text;
    }
    return IncludeName{name, true};
  }
  SourceLocation location = tokens.empty() ? directive.location : tokens[0].location;
  diagnostics_.report(DiagnosticId::kIncludeExpectsName, location,
                      {tokens.empty() ? "end of line" : describe(tokens[0])});
  return std::nullopt;
}

SourceText* Preprocessor::find_include(const IncludeName& name, std::string* searched,
                                       std::string* error) {
  std::string path = normalize_path(name.name);
  if (is_absolute(path)) {
    *searched = path;
    return sources_.load(path, error);
  }
  auto look_in = [&](const std::string& folder) {
    if (!searched->empty()) *searched += ", ";
    *searched += folder.empty() ? "." : folder;
    return sources_.load(joined(folder, path), error);
  };
  if (!name.is_angled) {
    SourceText* text = look_in(file().folder);
    if (text || !error->empty()) return text;
  }
  for (const std::string& folder : options_.include_folders) {
    SourceText* text = look_in(folder);
    if (text || !error->empty()) return text;
  }
  if (searched->empty()) *searched = "no folder; <...> needs an -I option";
  return nullptr;
}

bool Preprocessor::has_include(const Token& keyword) {
  if (!is_left_paren_next()) {
    Token found = next_unexpanded();
    diagnostics_.report(DiagnosticId::kConditionTokenExpected, found.location,
                        {"'(' after __has_include", describe(found)});
    return false;
  }
  next_unexpanded();
  std::optional<IncludeName> name = read_include_name(keyword);
  if (!name) return false;
  Token close = next_unexpanded();
  if (!close.is(TokenKind::kRightParen)) {
    diagnostics_.report(DiagnosticId::kConditionTokenExpected, close.location,
                        {"')' after __has_include", describe(close)});
  }
  std::string searched;
  std::string error;
  return find_include(*name, &searched, &error) != nullptr;
}

void Preprocessor::directive_include(const Token& name) {
  SourceLocation location = name.location;
  std::optional<IncludeName> wanted = read_include_name(name);
  if (!wanted) return finish_directive();
  expect_end("include");
  std::string searched;
  std::string error;
  SourceText* text = find_include(*wanted, &searched, &error);
  if (!text) {
    if (error.empty()) {
      auto message =
          diagnostics_.report(DiagnosticId::kIncludeNotFound, location, {wanted->name, searched});
      // A header of DXC's own.
      if (wanted->name == "dx/linalg.h") {
        message.note(location,
                     "it declares linear algebra, Shader Model 6.10, which is not supported");
      }
    } else {
      diagnostics_.report(DiagnosticId::kIncludeUnreadable, location, {wanted->name, error});
    }
    return;
  }
  if (once_.contains(text)) return;
  if (files_.size() > options_.max_include_depth) {
    diagnostics_.report(
        DiagnosticId::kIncludeTooDeep, location,
        {std::to_string(files_.size()), std::to_string(options_.max_include_depth), text->path});
    return fatal();
  }
  if (++inclusions_ > options_.max_inclusions) {
    diagnostics_.report(
        DiagnosticId::kTooMuchSource, location,
        {"more than " + std::to_string(options_.max_inclusions) + " files are included"});
    return fatal();
  }
  enter_file(text, location, folder_of(text->path));
}

}  // namespace kaamos::hlsl
