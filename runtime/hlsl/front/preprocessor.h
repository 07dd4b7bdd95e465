// SPDX-License-Identifier: MIT
// The preprocessor's inner state; users include preprocess.h. Where to find what:
// preprocess.cpp: files in, tokens out; _directive: directives; _conditional: #if and skipped
// groups; _condition: its expression; _include: #include; _define: #define; _macro: calls and their
// arguments; _substitute: bodies with arguments inserted.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "runtime/hlsl/front/lex.h"
#include "runtime/hlsl/front/preprocess.h"

namespace kaamos::hlsl {

enum class BuiltinMacro : uint8_t { kNone, kLine, kFile, kCounter };

// One piece of a macro's body, in the form that substitution needs.
struct MacroItem {
  enum Role : uint8_t {
    kPlain,
    kParameter,
    kStringize,   // '#' and the parameter after it.
    kPaste,       // '##'
    kVaOptBegin,  // __VA_OPT__( up to `end`, the index of the kVaOptEnd.
    kVaOptEnd,
  };
  Role role = kPlain;
  Token token;
  uint32_t parameter = 0;
  uint32_t end = 0;
};

struct Macro {
  std::string_view name;
  SourceLocation location;
  BuiltinMacro builtin = BuiltinMacro::kNone;
  bool is_predefined = false;
  bool is_function_like = false;
  bool is_variadic = false;
  bool is_disabled = false;  // While its expansion is being read, the name is not expanded again.
  std::vector<uint32_t> parameters;
  std::vector<MacroItem> body;
};

class Preprocessor {
 public:
  Preprocessor(const PreprocessOptions& options, SourceManager& sources,
               DiagnosticEngine& diagnostics);
  TokenList run(SourceText* main);

  // ---- For the condition parser ----
  Token next_expanded();
  Token next_unexpanded();
  bool is_defined(const Token& name);
  bool has_include(const Token& keyword);
  DiagnosticEngine& diagnostics() { return diagnostics_; }
  // A limit was exceeded: every token from now on is an end of file.
  bool is_fatal() const { return is_fatal_; }

 private:
  struct Conditional {
    SourceLocation location;
    std::string_view keyword;  // "if", "ifdef", "ifndef"
    bool is_taken;             // One of its groups was read or is being read.
    bool has_else;
  };
  struct OpenFile {
    SourceText* text;
    std::string folder;
    Lexer lexer;
    std::vector<Conditional> conditionals;
  };
  // Tokens to be read before the file goes on.
  struct Frame {
    std::vector<Token> tokens;
    size_t next = 0;
    Macro* macro = nullptr;
  };
  using Tokens = std::vector<Token>;
  struct Call {
    Macro* macro;
    Token name;
    uint32_t expansion;
    std::vector<Tokens> arguments;
    std::vector<std::optional<Tokens>> expanded;
  };

  OpenFile& file() { return *files_.back(); }
  Lexer& lexer() { return files_.back()->lexer; }
  void fatal();

  // preprocess.cpp
  void define_predefined(std::string& text) const;
  std::vector<SourceText*> define_options() const;
  void read_definitions(SourceText* text);
  void emit(Token token);
  void emit_string(const Token& token);
  void finish_string();
  Token read_file_token();
  bool enter_file(SourceText* text, SourceLocation included_from, std::string folder);
  void leave_file();

  // preprocess_directive.cpp
  void read_directive(const Token& hash);
  void run_directive(const Token& hash, const Token& name);
  void expect_end(std::string_view directive);
  void finish_directive();
  void directive_undef();
  void directive_line(std::string_view name, std::optional<Token> number);
  void directive_message(const Token& name, DiagnosticId id);
  void directive_pragma(const Token& hash);
  void pragma_pack_matrix(const Token& hash, const Token& name);
  std::optional<Token> read_macro_name(std::string_view directive);

  // preprocess_conditional.cpp
  void directive_if(const Token& name, bool value);
  bool read_ifdef(const Token& name);
  void directive_elif(const Token& name);
  void directive_else(const Token& name);
  void directive_endif(const Token& name);
  void skip_group();
  // Handles one directive in a skipped group; returns true if the following group is to be read.
  bool skip_directive(uint32_t& depth);
  bool read_condition(const Token& name);

  // preprocess_include.cpp
  struct IncludeName {
    std::string name;
    bool is_angled = false;
  };
  std::optional<IncludeName> read_include_name(const Token& directive);
  std::optional<IncludeName> include_name_of(const Tokens& tokens, const Token& directive);
  SourceText* find_include(const IncludeName& name, std::string* searched, std::string* error);
  void directive_include(const Token& name);

  // preprocess_define.cpp
  void directive_define();
  bool read_parameters(Macro& macro);
  bool read_body(Macro& macro);
  bool check_pastes(const Macro& macro);
  void set_macro(uint32_t identifier, std::unique_ptr<Macro> macro);
  Macro* make_builtin(std::string_view name, BuiltinMacro builtin);

  // preprocess_macro.cpp
  // Returns true if `token` was a macro, whose expansion is read next, or was replaced.
  bool expand(Token& token, bool& is_replaced);
  void expand_builtin(Token& token, const Macro& macro);
  bool is_left_paren_next();
  bool read_arguments(Call& call);
  bool check_argument_count(Call& call);
  bool count_tokens(size_t count, std::string_view macro);
  Token stop_token(TokenKind kind);

  // preprocess_substitute.cpp
  void substitute(Call& call, uint32_t begin, uint32_t end, Tokens& result);
  // Appends what items[i] expands to; returns the index of its last item.
  uint32_t append_operand(Call& call, uint32_t i, bool is_raw, Tokens& result);
  const Tokens& expanded_argument(Call& call, uint32_t parameter);
  Token stringize(Call& call, const MacroItem& item);
  void paste(Call& call, const Token& operation, Tokens& left, const Tokens& right);
  Token lex_pasted(const std::string& text);
  bool has_variadic_tokens(Call& call);

  const PreprocessOptions options_;
  SourceManager& sources_;
  DiagnosticEngine& diagnostics_;
  IdentifierTable identifiers_;
  std::vector<std::unique_ptr<OpenFile>> files_;
  std::vector<Frame> frames_;
  std::vector<Tokens> spare_;  // Memory of frames that have been read.
  std::vector<std::unique_ptr<Macro>> macros_;
  std::unordered_set<const SourceText*> once_;  // Files with #pragma once.
  std::optional<Token> pending_;                // A #pragma pack_matrix, to be returned next.
  TokenList output_;
  std::string joined_;  // The value of the adjacent strings at the end of the output.
  bool is_joining_ = false;
  std::vector<std::string_view> collecting_;  // Macros whose arguments are being read.
  bool is_isolated_ = false;  // Expanding an argument by itself: nothing follows the frames.
  bool is_fatal_ = false;
  uint32_t argument_depth_ = 0;
  uint32_t inclusions_ = 0;
  uint64_t expansion_tokens_ = 0;
  uint32_t counter_ = 0;
  uint32_t va_args_ = 0;
  uint32_t va_opt_ = 0;
  uint32_t defined_ = 0;
  uint32_t has_include_ = 0;
};

}  // namespace kaamos::hlsl
