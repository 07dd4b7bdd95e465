// SPDX-License-Identifier: MIT
//
// printf and errorf: ordinary stores to the device's print buffer, so that every executor runs
// them. [kaamos/shader/printing.h; DXC: printf for SPIR-V]
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Printing : LowerPart {
 public:
  using LowerPart::LowerPart;

  static bool is_print(std::string_view name) { return name == "printf" || name == "errorf"; }
  // Arguments are lowered here, since some of them are strings, which are no values.
  Value call(std::string_view name, const CallExpr* expr);

  // The thread that runs, a uint3, which entry points set when they start; null as long as nothing
  // prints.
  const ir::Variable* thread() const;
  // For an entry point that sets it.
  void use_thread(FunctionInfo& function);

 private:
  struct Argument {
    const StringLiteralExpr* text = nullptr;
    const ir::Expr* value = nullptr;  // as it is stored
    std::string type;                 // as in messages
    std::string letters;              // as in shader::PrintDesc::arguments
    bool is_float = false;
    uint32_t components = 1;
    bool is_matrix = false;
  };
  bool lower_arguments(std::string_view name, const CallExpr* expr, std::vector<Argument>& out);
  Argument to_store(std::string_view name, const Value& value);
  // The format with its strings filled in, if it fits the arguments.
  std::optional<std::string> fitting_format(std::string_view name, const CallExpr* expr,
                                            const std::vector<Argument>& arguments);
  void store(uint64_t id, const std::vector<Argument>& arguments);
  void make_thread();
};

}  // namespace kaamos::hlsl
