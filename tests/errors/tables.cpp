// SPDX-License-Identifier: MIT
#include "tests/errors/tables.h"

#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace kaamos::errors {
namespace {

#define KAAMOS_MESSAGE(number, name, severity, code, title, rule, cure) \
  {number, #name, #severity, #code, title, rule, cure},
constexpr Row kCheckedMode[] = {
#include "runtime/checks/messages.inc"
};
constexpr Row kApi[] = {
#include "rtapi/src/errors/errors.inc"
};
constexpr Row kBackends[] = {
#include "runtime/backend/errors.inc"
};
constexpr Row kEffects[] = {
#include "effects/assets/common/errors.inc"
};
constexpr Row kD3d12[] = {
#include "d3d12/com/errors.inc"
};
#undef KAAMOS_MESSAGE

constexpr Row kCompiler[] = {
#define KAAMOS_DIAGNOSTIC(number, name, severity, text, cure) \
  {number, #name, #severity, "", text, "", cure},
#include "runtime/hlsl/front/diagnostic_ids_preprocess.inc"

#include "runtime/hlsl/front/diagnostic_ids_parse.inc"

#include "runtime/hlsl/front/diagnostic_ids_check.inc"

#include "runtime/hlsl/front/diagnostic_ids_emit.inc"
#undef KAAMOS_DIAGNOSTIC
};

// Rows with numbers from `first` up to but without `last`.
template <size_t n>
std::vector<Row> rows_of(const Row (&table)[n], int first = 0, int last = 10000) {
  std::vector<Row> rows(table, table + n);
  std::erase_if(rows, [&](const Row& row) { return row.number < first || row.number >= last; });
  return rows;
}

// The table of rtapi also has the errors of CompileShaderLibrary, which belong with the compiler.
constexpr int kFirstOfCompiler = 2000;

std::string_view severity_name(std::string_view enumerator) {
  if (enumerator == "kError") return "error";
  if (enumerator == "kWarning") return "warning";
  if (enumerator == "kStrict") return "warning (error with --strict)";
  return "information";
}

// "" where no rtapi::Error is made of the row.
std::string_view code_of(const Layer& layer, const Row& row) {
  return layer.has_codes && row.severity == "kError" ? row.code : std::string_view();
}

// So that Markdown shows the text as it is. An underscore inside a word needs no escape.
std::string escaped(std::string_view text) {
  const auto in_word = [&](size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool edge = text[i] == '_' && !(in_word(i - 1) && in_word(i + 1));
    const bool link = text[i] == '#' && in_word(i + 1);  // Doxygen takes #name for a reference
    if (edge || link || std::string_view("|<*`\\").find(text[i]) != std::string_view::npos)
      out += '\\';
    out += text[i];
  }
  return out;
}

bool within(const Layer& layer, int number) {
  for (const Range& range : layer.ranges) {
    if (number >= range.first && number <= range.last) return true;
  }
  return false;
}

}  // namespace

std::string id_text(int number) {
  const std::string digits = std::to_string(number);
  return "KA" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

const std::vector<Layer>& all_layers() {
  static const std::vector<Layer> layers = {
      {"Checked mode",
       "With `DeviceDesc::Checked` the device looks for what DXR leaves undefined, and reports it "
       "through `DeviceDesc::OnMessage`. Execution goes on. Shader code finds KA0400 to KA0429, "
       "the "
       "layer that reads the command stream the rest. Table: `runtime/checks/messages.inc`.",
       {{400, 499}},
       false,
       "checked",
       rows_of(kCheckedMode)},
      {"API",
       "What a call of `rtapi` refuses, in its `Result` or `Status`. A command list keeps the "
       "errors "
       "of its recording, and `Close` returns the first. KA05nn: state objects; KA06nn: root "
       "signatures and descriptors; KA07nn: acceleration structures; KA08nn: command lists, queues "
       "and shader tables; KA09nn: devices and resources. Table: `rtapi/src/errors/errors.inc`.",
       {{500, 999}},
       true,
       "api",
       rows_of(kApi, 0, kFirstOfCompiler)},
      {"Backends",
       "What only shows when commands execute or memory is allocated. An error with code "
       "`kDeviceRemoved`, or any error of a command, removes the device "
       "(`Device::GetDeviceRemovedReason`); warnings arrive through `DeviceDesc::OnMessage`, and "
       "execution goes on. Table: `runtime/backend/errors.inc`.",
       {{550, 552}, {700, 999}},
       true,
       "backend",
       rows_of(kBackends)},
      {"HLSL compiler",
       "Diagnostics of `kaamos-hlsl` and `CompileShaderLibrary`, each with file, line and column. "
       "KA20nn: preprocessor; KA21nn: lexer; KA22nn: parser; KA24nn to KA26nn: checker. Tables: "
       "`runtime/hlsl/front/diagnostic_ids_*.inc`.",
       {{2000, 2749}},
       false,
       "compiler",
       rows_of(kCompiler)},
      {"Shaders compiled at run time",
       "What `CompileShaderLibrary` returns as a whole, after the compiler's front end. Table: "
       "`rtapi/src/errors/errors.inc`.",
       {{2750, 2799}},
       true,
       "compiler",
       rows_of(kApi, kFirstOfCompiler)},
      {"Effects",
       "What the effects library and `northlight` refuse, in a `Result` or `Status`. KA300n: files "
       "and pictures; KA302n: scenes; KA304n: frames. Table: `effects/assets/common/errors.inc`.",
       {{3000, 3099}},
       true,
       "",
       rows_of(kEffects)},
      {"D3D12 facade",
       "What `d3d12` itself refuses, by an `HRESULT` and a message of the info queue; what `rtapi` "
       "refuses keeps its id. Table: `d3d12/com/errors.inc`.",
       {{4000, 4099}},
       true,
       "",
       rows_of(kD3d12)},
  };
  return layers;
}

std::vector<std::string> faults_of(const std::vector<Layer>& layers) {
  std::vector<std::string> faults;
  std::map<int, std::string_view> seen;  // id and layer
  std::set<std::pair<std::string_view, std::string_view>> names;
  for (const Layer& layer : layers) {
    int last = -1;
    for (const Row& row : layer.rows) {
      const std::string who = id_text(row.number) + " (" + std::string(layer.title) + ")";
      if (const auto [it, is_new] = seen.emplace(row.number, layer.title); !is_new) {
        faults.push_back(who + " is an id of " + std::string(it->second) + " already");
      }
      if (!layer.namespace_.empty() && !names.emplace(layer.namespace_, row.name).second) {
        faults.push_back(who + " has the name " + std::string(row.name) + " of another");
      }
      if (row.number < last) faults.push_back(who + " is out of order");
      last = row.number;
      if (!within(layer, row.number)) {
        faults.push_back(who + " is outside the layer's range of ids");
      }
      if (row.meaning.empty()) faults.push_back(who + " has no meaning");
      if (row.cure.empty() || row.cure.back() != '.') {
        faults.push_back(who + " has no cure that is a sentence");
      }
    }
  }
  return faults;
}

std::string markdown(const std::vector<Layer>& layers) {
  std::string out =
      "# Errors and messages\n\n"
      "Every id that Kaamos reports, with its meaning and its cure. A message is `id title: "
      "detail`, "
      "where the detail says what, where, the actual and the allowed value; the compiler's end "
      "with "
      "the id in brackets. An id never changes its meaning: compare `rtapi::ErrorId`, never texts. "
      "{0}, {1}, ... stand for names and values. A rule names an item of the conformance list "
      "(`tests/conformance`) or a topic of D3D12's documentation.\n\n"
      "`kaamos-errors --markdown` (`tests/errors`) makes this page from the tables that the "
      "sources "
      "are compiled from.\n";
  for (const Layer& layer : layers) {
    bool codes = false;
    bool rules = false;
    for (const Row& row : layer.rows) {
      codes |= !code_of(layer, row).empty();
      rules |= !row.rule.empty();
    }
    out.append("\n## ").append(layer.title).append("\n\n").append(layer.about).append("\n\n");
    out += std::string("| id | severity |") + (codes ? " code |" : "") + " meaning |" +
           (rules ? " rule |" : "") + " cure |\n";
    out += std::string("|---|---|") + (codes ? "---|" : "") + "---|" + (rules ? "---|" : "") +
           "---|\n";
    for (const Row& row : layer.rows) {
      out += "| " + id_text(row.number) + " | " + escaped(severity_name(row.severity)) + " | ";
      if (codes) {
        const std::string code(code_of(layer, row));
        out += (code.empty() ? "" : "`" + code + "`") + " | ";
      }
      out += escaped(row.meaning) + " | ";
      if (rules) out += escaped(row.rule) + " | ";
      out += escaped(row.cure) + " |\n";
    }
  }
  return out;
}

std::string header(const std::vector<Layer>& layers) {
  std::string out =
      "// SPDX-License-Identifier: MIT\n"
      "/// @file\n"
      "/// The ids of rtapi/ERRORS.md by name, for programs that look for one:\n"
      "/// `status.error().id == rtapi::error_ids::backend::kOutOfMemory`. `kaamos-errors "
      "--header`\n"
      "/// (tests/errors) makes this header from the tables that the sources are compiled from.\n"
      "#pragma once\n\n#include <rtapi/result.h>\n\n"
      "/// A name for each id, a namespace for each part of the library.\n"
      "namespace rtapi::error_ids {\n\n// clang-format off\n";
  for (const Layer& layer : layers) {
    if (layer.namespace_.empty()) continue;
    out.append("\n/// Section \"").append(layer.title).append("\" of rtapi/ERRORS.md.\nnamespace ");
    out.append(layer.namespace_).append(" {\n");
    for (const Row& row : layer.rows) {
      out.append("inline constexpr ErrorId ").append(row.name);
      out += "{" + std::to_string(row.number) + "};  ///< " + escaped(row.meaning) + "\n";
    }
    out.append("}  // namespace ").append(layer.namespace_).append("\n");
  }
  return out + "\n// clang-format on\n\n}  // namespace rtapi::error_ids\n";
}

}  // namespace kaamos::errors
