// SPDX-License-Identifier: MIT
// The tables of OVERLOADS.md: each cell, and a call with each pair of overloads.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "runtime/hlsl/check/check_test_support.h"
#include "runtime/hlsl/check/names/conversion_costs.h"

namespace kaamos::hlsl {
namespace {

struct CostTable {
  std::vector<std::string> targets;
  std::vector<std::pair<std::string, std::vector<std::string>>> rows;
};

std::string trimmed(std::string text) {
  std::erase(text, '`');
  const size_t begin = text.find_first_not_of(' ');
  const size_t end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

// The tables whose first cell is "from, to".
std::vector<CostTable> written_tables() {
  std::ifstream file(KAAMOS_SOURCE_DIR "/runtime/hlsl/OVERLOADS.md");
  std::vector<CostTable> tables;
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream split(line);
    for (std::string cell; std::getline(split, cell, '|');) cells.push_back(trimmed(cell));
    if (cells.size() < 2) {
      is_inside = false;
    } else if (cells[1] == "from, to") {
      is_inside = true;
      tables.push_back({{cells.begin() + 2, cells.end()}, {}});
    } else if (is_inside && !cells[1].starts_with("---")) {
      tables.back().rows.push_back({cells[1], {cells.begin() + 2, cells.end()}});
    }
  }
  return tables;
}

// Steps in the order of their costs; each outweighs all before it.
uint64_t cost_of(const std::string& steps) {
  constexpr std::string_view kOrder = "swdanct";
  uint64_t cost = 0;
  for (const char step : steps) {
    if (step != '0') cost += uint64_t{1} << (4 * kOrder.find(step));
  }
  return cost;
}

class OverloadTable : public testing::TestWithParam<size_t> {
 protected:
  bool is_native() const { return GetParam() == 1; }
  FrontendOptions options() const {
    FrontendOptions result;
    result.native_16bit = is_native();
    return result;
  }
};

TEST(OverloadTables, AreTwo) {
  const std::vector<CostTable> tables = written_tables();
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].rows.size(), 16u);
  EXPECT_EQ(tables[0].targets.size(), 13u);
  EXPECT_EQ(tables[1].rows.size(), 13u);
  EXPECT_EQ(tables[1].targets.size(), 10u);
}

// A call with one of two overloads does what the table says, for every type of argument and every
// two types of parameters.
TEST_P(OverloadTable, DecidesBetweenEveryTwoTypes) {
  const CostTable table = written_tables()[GetParam()];
  for (const auto& [from, cells] : table.rows) {
    const std::string argument = from == "literal int"     ? "1"
                                 : from == "literal float" ? "1.5"
                                                           : "v";
    std::string globals = from == "enum"    ? "enum E { kA, kB };\nstatic E v;\n"
                          : argument == "v" ? "static " + from + " v;\n"
                                            : "";
    std::string wrong;
    std::map<std::string, uint64_t> winners;
    std::string ambiguous;
    std::vector<size_t> ambiguous_lines;
    std::string calls;
    std::string all_functions;
    for (size_t a = 0; a < cells.size(); ++a) {
      for (size_t b = a + 1; b < cells.size(); ++b) {
        const std::string name = "p" + std::to_string(a) + "_" + std::to_string(b);
        all_functions += "uint " + name + "(" + table.targets[a] + " x) { return 1111; }\n" +
                         "uint " + name + "(" + table.targets[b] + " x) { return 2222; }\n";
        const uint64_t first = cost_of(cells[a]);
        const uint64_t second = cost_of(cells[b]);
        const std::string call = "results.Store(0, " + name + "(" + argument + "));\n";
        if (first == second) {
          ambiguous += call;
        } else {
          calls += call;
          winners[name] = first < second ? 1111 : 2222;
        }
      }
    }
    const Compilation chosen(kernel(calls, globals + all_functions), options());
    ASSERT_NE(chosen.module, nullptr) << from << "\n" << chosen.messages();
    for (const auto& [name, winner] : winners) {
      EXPECT_NE(chosen.function(name).find(std::to_string(winner)), std::string::npos)
          << from << ": " << name << " " << chosen.function(name);
    }
    // At most 50 errors are reported, so the calls that must fail are compiled one by one.
    std::istringstream each(ambiguous);
    for (std::string call; std::getline(each, call);) {
      const Compilation refused(kernel(call, globals + all_functions), options());
      EXPECT_EQ(refused.module, nullptr) << from << ": " << call;
      EXPECT_TRUE(refused.has(DiagnosticId::kAmbiguousCall)) << call << refused.messages();
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, OverloadTable, testing::Values(0, 1));

// The steps of shape, and how costs of several arguments add up.
TEST(Overloads, ShapesAndSums) {
  struct Case {
    const char* functions;
    const char* call;  // 1111 wins; empty: ambiguous
    bool is_ambiguous = false;
  };
  const Case cases[] = {
      {"uint f(float3 a, float3 b) { return 1111; } uint f(float a, float b) { return 2222; }",
       "f(v3, v)"},
      {"uint f(float3 a) { return 1111; } uint f(float a) { return 2222; }", "f(v3)"},
      {"uint f(int3 a) { return 1111; } uint f(float2 a) { return 2222; }", "f(int3(1, 2, 3))"},
      {"uint f(float3 a) { return 1111; } uint f(int2 a) { return 2222; }", "f(int3(1, 2, 3))"},
      {"uint f(int2 a) { return 1111; } uint f(float2 a) { return 2222; }", "f(uint2(1, 2))"},
      {"uint f(float a) { return 1111; } uint f(float3 a) { return 2222; }", "f(v)"},
      {"uint f(float3 a) { return 1111; } uint f(int a) { return 2222; }", "f(v)"},
      {"uint f(float4x4 a) { return 1111; } uint f(float3x3 a) { return 2222; }", "f((float4x4)1)"},
      {"uint f(int a, double b) { return 1111; } uint f(float a, float b) { return 2222; }",
       "f(i, v)"},
      {"uint f(int a, float b) { return 1111; } uint f(float a, int b) { return 2222; }", "f(i, i)",
       true},
      {"uint f(float a, int b) { return 1111; } uint f(half a, half b) { return 2222; }",
       "f(h, i)"},
      {"uint f(half a) { return 1111; } uint f(float a) { return 2222; }", "f(h)"},
      {"uint f(float a) { return 1111; } uint f(half a) { return 2222; }", "f(v)"},
      {"uint f(half a) { return 1111; } uint f(float a) { return 2222; }", "f(h * h + 1)"},
      {"uint f(float a) { return 1111; } uint f(half a) { return 2222; }", "f(h * v)"},
      {"uint f(half2 a[2]) { return 1111; } uint f(float2 a[2]) { return 2222; }", "f(h2)"},
      {"uint f(inout int a) { return 1111; } uint f(inout uint a) { return 2222; }", "f(i)"},
      {"uint f(out uint a) { a = 0; return 1111; } uint f(out float a) { a = 0; return 2222; }",
       "f(i)"},
      {"template <typename T> uint f(T a) { return 2222; } uint f(float a) { return 1111; }",
       "f(v)"},
      {"struct A { int x; }; struct B : A { int y; }; struct C : B { int z; };\n"
       "static C c; uint f(B a) { return 1111; } uint f(A a) { return 2222; }",
       "f(c)"},
      {"uint f(float a, float b = 1) { return 1111; } uint f(int a) { return 2222; }", "f(v)"},
      {"float sin(half a) { return 1111; }", "(uint)sin(h)"}};
  for (const Case& one : cases) {
    const std::string globals =
        "static float v; static float3 v3; static int i; static half h; static half2 h2[2];\n";
    const Compilation compilation(
        kernel("results.Store(0, " + std::string(one.call) + ");", globals + one.functions));
    if (one.is_ambiguous) {
      EXPECT_TRUE(compilation.has(DiagnosticId::kAmbiguousCall))
          << one.functions << one.call << compilation.messages();
      continue;
    }
    ASSERT_NE(compilation.module, nullptr) << one.functions << compilation.messages();
    std::string text;
    for (const ir::Function* function : compilation.module->functions) text += dump(*function);
    EXPECT_NE(text.find("1111"), std::string::npos) << one.functions << one.call << "\n" << text;
    EXPECT_EQ(text.find("2222"), std::string::npos) << one.functions << one.call << "\n" << text;
  }
}

// With native 16-bit types the min types still are types of their own. [DXC: function_overload_*]
TEST(Overloads, NativeMinTypes) {
  const char* const types[] = {"float", "half",     "min16float", "min10float", "int",
                               "uint",  "min16int", "min12int",   "min16uint"};
  for (const bool is_float : {true, false}) {
    const size_t first = is_float ? 0 : 4;
    const size_t end = is_float ? 4 : 9;
    std::string globals;
    for (size_t i = first; i < end; ++i) {
      const std::string name = types[i];
      globals += "static " + name + " v" + std::to_string(i) + ";\nuint f(" + name + " a, " + name +
                 " b) { return " + std::to_string(1111 * (i + 1)) + "; }\n";
    }
    for (size_t i = first; i < end; ++i) {
      const std::string v = "v" + std::to_string(i);
      FrontendOptions options;
      options.native_16bit = true;
      const Compilation compilation(
          kernel("results.Store(0, f(" + v + ", " + v + " % 10));", globals), options);
      ASSERT_NE(compilation.module, nullptr) << types[i] << compilation.messages();
      EXPECT_NE(compilation.function("f").find(std::to_string(1111 * (i + 1))), std::string::npos)
          << types[i] << compilation.function("f");
    }
  }
}

TEST(Overloads, CombinedScalars) {
  EXPECT_EQ(combined_scalar(Scalar::kInt64, Scalar::kUint32), Scalar::kUint64);
  EXPECT_EQ(combined_scalar(Scalar::kHalf, Scalar::kFloat32), Scalar::kFloat32);
  EXPECT_EQ(combined_scalar(Scalar::kHalf, Scalar::kLiteralFloat), Scalar::kHalf);
  EXPECT_EQ(combined_scalar(Scalar::kHalf, Scalar::kInt32), Scalar::kFloat32);
  EXPECT_EQ(combined_scalar(Scalar::kMin16Float, Scalar::kInt32), Scalar::kMin16Float);
  EXPECT_EQ(combined_scalar(Scalar::kMin10Float, Scalar::kMin16Float), Scalar::kMin16Float);
  EXPECT_EQ(combined_scalar(Scalar::kMin16Int, Scalar::kMin16Uint), Scalar::kMin16Uint);
  EXPECT_EQ(combined_scalar(Scalar::kMin12Int, Scalar::kBool), Scalar::kMin12Int);
  EXPECT_EQ(combined_scalar(Scalar::kNativeMin16Float, Scalar::kInt32), Scalar::kNativeMin16Float);
  EXPECT_EQ(combined_scalar(Scalar::kNativeMin16Int, Scalar::kFloat32), Scalar::kFloat32);
  EXPECT_EQ(combined_scalar(Scalar::kNativeMin12Int, Scalar::kBool), Scalar::kNativeMin12Int);
  EXPECT_EQ(combined_scalar(Scalar::kBool, Scalar::kLiteralInt), Scalar::kInt32);
  EXPECT_EQ(combined_scalar(Scalar::kLiteralFloat, Scalar::kInt64), Scalar::kFloat32);
  EXPECT_EQ(combined_scalar(Scalar::kFloat64, Scalar::kInt64), Scalar::kFloat64);
}

}  // namespace
}  // namespace kaamos::hlsl
