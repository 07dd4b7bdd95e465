// SPDX-License-Identifier: MIT
#include "tests/shaders/test_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace kaamos::shader_tests {
namespace {

struct Token {
  std::string text;
  std::string file;
  uint32_t line = 0;

  bool is(std::string_view other) const { return text == other; }
  bool is_word() const {
    return std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_';
  }
};

bool is_word_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Splits a preprocessed source, which has neither comments nor macros any more.
class Splitter {
 public:
  Splitter(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  std::vector<Token> run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        ++at_;
        starts_line_ = true;
        continue;
      }
      if (std::isspace(static_cast<unsigned char>(c)) != 0) {
        ++at_;
        continue;
      }
      if (c == '#' && starts_line_) {
        directive();
        continue;
      }
      starts_line_ = false;
      const size_t begin = at_;
      if (c == '"' || c == '\'') {
        quoted(c);
      } else if (is_word_letter(c) ||
                 (c == '.' && begin + 1 < text_.size() &&
                  std::isdigit(static_cast<unsigned char>(text_[begin + 1])))) {
        number_or_word();
      } else {
        ++at_;
        if (c == ':' && at_ < text_.size() && text_[at_] == ':') ++at_;
      }
      tokens_.push_back({std::string(text_.substr(begin, at_ - begin)), file_, line_});
    }
    return std::move(tokens_);
  }

 private:
  void quoted(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\\') ++at_;
    }
    at_ = std::min(at_ + 1, text_.size());
  }
  void number_or_word() {
    const bool is_number =
        !std::isalpha(static_cast<unsigned char>(text_[at_])) && text_[at_] != '_';
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const char before = text_[at_ - (at_ > 0 ? 1 : 0)];
      const bool is_sign = is_number && (c == '+' || c == '-') && (before == 'e' || before == 'E');
      if (!is_word_letter(c) && !(is_number && c == '.') && !is_sign) return;
      ++at_;
    }
  }
  // #line 12 "file"
  void directive() {
    const size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    const size_t digit = rest.find_first_of("0123456789");
    const bool is_line = rest.starts_with("#line") || rest.starts_with("# ");
    if (!is_line || digit == std::string_view::npos) return;
    uint32_t line = 0;
    std::from_chars(rest.data() + digit, rest.data() + rest.size(), line);
    line_ = line - 1;  // of the line that ends here
    const size_t open = rest.find('"');
    const size_t close = rest.rfind('"');
    if (open != std::string_view::npos && close > open) {
      file_ = std::string(rest.substr(open + 1, close - open - 1));
    }
  }

  std::string_view text_;
  std::string file_;
  uint32_t line_ = 1;
  size_t at_ = 0;
  bool starts_line_ = true;
  std::vector<Token> tokens_;
};

using Tokens = std::vector<Token>;

std::string joined(const Tokens& tokens, size_t begin, size_t end) {
  std::string out;
  for (size_t i = begin; i < end; ++i) out += (i == begin ? "" : " ") + tokens[i].text;
  return out;
}

// The place of the bracket that closes the one at `open`; the end if none does.
size_t closing(const Tokens& tokens, size_t open) {
  int depth = 0;
  for (size_t i = open; i < tokens.size(); ++i) {
    const char c = tokens[i].text[0];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    if (depth == 0) return i;
  }
  return tokens.size();
}

// The parts between commas in [begin, end) that are in no brackets.
std::vector<std::pair<size_t, size_t>> parts(const Tokens& tokens, size_t begin, size_t end) {
  std::vector<std::pair<size_t, size_t>> out;
  size_t first = begin;
  for (size_t i = begin; i < end; ++i) {
    const char c = tokens[i].text[0];
    if (c == '(' || c == '[' || c == '{') i = closing(tokens, i);
    if (c == ',') {
      out.emplace_back(first, i);
      first = i + 1;
    }
  }
  if (first < end) out.emplace_back(first, end);
  return out;
}

struct Attributes {
  bool is_test = false;
  std::string test_stage;          // of [test("raygeneration")], in quotes
  std::vector<std::string> cases;  // arguments of a call
  std::string threads;             // "8, 8, 1"
  std::string stage;               // of [shader("...")], in quotes
  std::optional<std::array<uint32_t, 3>> size;
  std::string skip;
};

std::optional<TestStage> stage_of(const std::string& name) {
  if (name.empty() || name == "\"compute\"") return TestStage::kCompute;
  if (name == "\"raygeneration\"") return TestStage::kRays;
  if (name == "\"pixel\"") return TestStage::kPixels;
  return std::nullopt;
}

class Finder {
 public:
  Finder(Tokens tokens, TestFile& out) : tokens_(std::move(tokens)), out_(out) {}

  void run() {
    for (size_t i = 0; i < tokens_.size() && out_.error.empty(); ++i) i = visit(i);
  }

 private:
  // Returns the last token that it looked at.
  size_t visit(size_t i) {
    const Token& token = tokens_[i];
    if (token.is("namespace") && i + 2 < tokens_.size() && tokens_[i + 2].is("{")) {
      namespaces_.push_back(tokens_[i + 1].text);
      return i + 2;
    }
    if (token.is("}")) {
      if (!namespaces_.empty()) namespaces_.pop_back();
      return i;
    }
    if (token.is("[")) {
      const size_t end = closing(tokens_, i);
      read_attribute(i, end);
      return end;
    }
    if (token.is("{")) {
      attributes_ = {};
      return closing(tokens_, i);
    }
    if (token.is(";")) attributes_ = {};
    if (token.is("(")) {
      const size_t end = closing(tokens_, i);
      if (i > 0 && tokens_[i - 1].is_word()) function(i, end);
      return end;
    }
    subobject(i);
    return i;
  }

  void read_attribute(size_t open, size_t close) {
    for (const auto& [begin, end] : parts(tokens_, open + 1, close)) {
      const std::string& name = tokens_[begin].text;
      const bool has_arguments = begin + 1 < end && tokens_[begin + 1].is("(");
      const size_t first = has_arguments ? begin + 2 : end;
      const size_t last = has_arguments ? end - 1 : end;
      const std::string arguments = first < last ? joined(tokens_, first, last) : std::string();
      if (name == "test") {
        attributes_.is_test = true;
        attributes_.test_stage = arguments;
      }
      if (name == "numthreads") attributes_.threads = arguments;
      if (name == "shader") attributes_.stage = arguments;
      if (name == "skip") {
        attributes_.skip =
            arguments.size() > 2 ? arguments.substr(1, arguments.size() - 2) : "no reason is given";
      }
      if (name == "dispatch") read_size(tokens_[begin], first, last);
      if (name == "cases") {
        for (const auto& [from, to] : parts(tokens_, first, last)) {
          const bool is_row = tokens_[from].is("(") && closing(tokens_, from) == to - 1;
          attributes_.cases.push_back(is_row ? joined(tokens_, from + 1, to - 1)
                                             : joined(tokens_, from, to));
        }
      }
    }
  }

  void read_size(const Token& at, size_t first, size_t last) {
    const auto given = parts(tokens_, first, last);
    std::array<uint32_t, 3>& size = attributes_.size.emplace();
    for (size_t i = 0; i < 3; ++i) {
      const std::string text = i < given.size() ? tokens_[given[i].first].text : "1";
      const auto read = std::from_chars(text.data(), text.data() + text.size(), size[i]);
      const bool is_number = read.ec == std::errc() && read.ptr == text.data() + text.size();
      if (!is_number || given.size() > 3 || size[i] == 0) {
        fail(at, "[dispatch] takes one to three numbers from 1 on, and here is '" + text + "'");
      }
    }
  }

  void function(size_t open, size_t close) {
    const Token& name = tokens_[open - 1];
    const bool has_body = close + 1 < tokens_.size() && tokens_[close + 1].is("{");
    if (attributes_.stage == "\"miss\"") out_.miss_shaders.push_back(name.text);
    if (attributes_.stage == "\"callable\"") out_.callable_shaders.push_back(name.text);
    if (attributes_.is_test && has_body) add_test(name, open, close);
  }

  // TriangleHitGroup Glass = { ... };
  void subobject(size_t i) {
    const Token& type = tokens_[i];
    const bool names_one = i + 1 < tokens_.size() && tokens_[i + 1].is_word();
    if (!names_one) return;
    if (type.is("TriangleHitGroup") || type.is("ProceduralPrimitiveHitGroup")) {
      out_.hit_groups.push_back(tokens_[i + 1].text);
    }
    if (type.is("LocalRootSignature")) {
      std::string text;
      for (size_t at = i + 2; at < tokens_.size() && !tokens_[at].is(";"); ++at) {
        const std::string& part = tokens_[at].text;
        if (part[0] == '"') text += part.substr(1, part.size() - 2);
      }
      out_.local_root_signatures.push_back(std::move(text));
    }
    if (type.is("RaytracingShaderConfig")) out_.has_shader_config = true;
    if (type.is("RaytracingPipelineConfig") || type.is("RaytracingPipelineConfig1")) {
      out_.has_pipeline_config = true;
    }
  }

  void add_test(const Token& name, size_t open, size_t close) {
    std::string qualified;
    for (const std::string& space : namespaces_) qualified += space + "::";
    qualified += name.text;
    const std::string& stage_name =
        attributes_.test_stage.empty() ? attributes_.stage : attributes_.test_stage;
    const std::optional<TestStage> stage = stage_of(stage_name);
    if (!stage) {
      return fail(name, "'" + qualified + "' is a test for stage " + stage_name +
                            "; tests run in \"compute\", \"raygeneration\" or \"pixel\"");
    }
    const bool is_shader = !attributes_.stage.empty();
    if (is_shader && !attributes_.cases.empty()) {
      return fail(name, "'" + qualified + "' has [shader] and [cases]; write [test(" + stage_name +
                            ")] in place of [shader]");
    }
    if (open < 2 || !tokens_[open - 2].is("void")) {
      return fail(name, "'" + qualified + "' is a test and returns a value; tests return void");
    }
    const bool has_threads = !attributes_.threads.empty();
    const bool takes_pixels = *stage == TestStage::kPixels && open + 1 < close;
    if ((has_threads || takes_pixels) && !attributes_.cases.empty()) {
      return fail(name, "'" + qualified + "' has [cases] and " +
                            (has_threads ? "[numthreads]" : "inputs of a pixel shader") +
                            "; a test takes its arguments from one of them");
    }
    const bool has_cases = !attributes_.cases.empty();
    const size_t count = has_cases ? attributes_.cases.size() : 1;
    for (size_t i = 0; i < count; ++i) {
      TestRun run;
      run.name = qualified + (has_cases ? "/" + std::to_string(i) : "");
      run.stage = *stage;
      const uint32_t side = *stage == TestStage::kPixels ? 2 : 1;
      run.size = attributes_.size.value_or(std::array<uint32_t, 3>{side, side, 1});
      run.skip = attributes_.skip;
      run.file = name.file;
      run.line = name.line;
      run.entry = is_shader ? name.text : "kaamos_test_" + std::to_string(out_.runs.size());
      if (!is_shader) {
        add_entry_point(run, qualified, has_cases ? attributes_.cases[i] : "", open, close);
      }
      out_.runs.push_back(std::move(run));
    }
  }

  void add_entry_point(const TestRun& run, const std::string& qualified, std::string arguments,
                       size_t open, size_t close) {
    std::string& out = out_.entry_points;
    const bool has_threads = !attributes_.threads.empty();
    if (run.stage == TestStage::kRays) {
      out += "[shader(\"raygeneration\")] void ";
    } else if (run.stage == TestStage::kPixels) {
      out += "[shader(\"pixel\")] void ";
    } else {
      out += "[shader(\"compute\")] [numthreads(" +
             (has_threads ? attributes_.threads : std::string("1, 1, 1")) + ")] void ";
    }
    std::string parameters;
    if (has_threads || run.stage == TestStage::kPixels) {
      // The same system values, passed on.
      parameters = joined(tokens_, open + 1, close);
      for (const auto& [begin, end] : parts(tokens_, open + 1, close)) {
        size_t colon = begin;
        while (colon < end && !tokens_[colon].is(":")) ++colon;
        arguments += (arguments.empty() ? "" : ", ") + tokens_[colon - 1].text;
      }
    }
    out += run.entry + "(" + parameters + ") { " + qualified + "(" + arguments + "); }\n";
  }

  void fail(const Token& at, const std::string& text) {
    if (out_.error.empty()) {
      out_.error = at.file + ":" + std::to_string(at.line) + ": " + text;
    }
  }

  Tokens tokens_;
  TestFile& out_;
  std::vector<std::string> namespaces_;
  Attributes attributes_;
};

}  // namespace

TestFile find_tests(std::string_view text, const std::string& file) {
  TestFile out;
  Finder(Splitter(text, file).run(), out).run();
  const bool draws = std::any_of(out.runs.begin(), out.runs.end(), [](const TestRun& run) {
    return run.stage == TestStage::kPixels;
  });
  // A triangle over all pixels, in their front.
  if (draws) {
    out.entry_points +=
        "[shader(\"vertex\")] float4 " + std::string(kVertexShader) +
        "(uint i : SV_VertexID) : SV_Position { return float4(i == 1 ? 3 : -1, i == 2 ? -3 : 1, "
        "0.5, 1); }\n";
  }
  return out;
}

}  // namespace kaamos::shader_tests
