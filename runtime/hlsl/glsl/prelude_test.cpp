// SPDX-License-Identifier: MIT
#include "runtime/hlsl/glsl/prelude.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <spirv-tools/libspirv.hpp>

#include "runtime/hlsl/glsl/spirv.h"
#include "runtime/hlsl/ir/intrinsics.h"

namespace kaamos::hlsl {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(GlslPrelude, HasWhatTheBodyUsesAndNothingElse) {
  const GlslPrelude prelude = glsl_prelude("void main() { float x = k_rcp(k_saturate(2.0)); }");
  EXPECT_THAT(prelude.missing, IsEmpty());
  EXPECT_THAT(prelude.text, HasSubstr("float k_rcp(float x) { return float(1) / x; }"));
  EXPECT_THAT(prelude.text, HasSubstr("vec3 k_saturate(vec3 x) { return vec3(k_saturate(x.x), "));
  EXPECT_THAT(prelude.text, Not(HasSubstr("k_add")));
  EXPECT_THAT(prelude.text, Not(HasSubstr("k_Descriptor")));
}

TEST(GlslPrelude, OverloadsOfRareTypesOnlyWhereTheBodyHasThem) {
  const std::string ordinary = glsl_prelude("k_add(1, 2); k_to_f32(1u)").text;
  EXPECT_THAT(ordinary, Not(HasSubstr("float16_t ")));
  EXPECT_THAT(ordinary, Not(HasSubstr("int16_t ")));
  EXPECT_THAT(ordinary, Not(HasSubstr("uint64_t ")));
  EXPECT_THAT(ordinary, Not(HasSubstr("double ")));
  EXPECT_THAT(glsl_prelude("f16vec3 a; k_add(a, a);").text, HasSubstr("f16vec3 k_add(f16vec3 a"));
  EXPECT_THAT(glsl_prelude("k_add(k_read_f64(w, 0u), x)").text, HasSubstr("double k_add(double a"));
  EXPECT_THAT(glsl_prelude("k_isnan(k_asdouble(a, b))").text, HasSubstr("bool k_isnan(double x"));
  EXPECT_THAT(glsl_prelude("k_isnan(k_asfloat16(a))").text, HasSubstr("bool k_isnan(float16_t x"));
}

TEST(GlslPrelude, ADefinitionStandsBeforeItsUse) {
  const std::string text = glsl_prelude("k_load_typed(d, 1u)").text;
  ASSERT_THAT(text, HasSubstr("uvec4 k_load_typed("));
  EXPECT_LT(text.find("struct k_Descriptor"), text.find("k_typed_element("));
  EXPECT_LT(text.find("uint k_decode_channel("), text.find("uvec4 k_decode_element("));
  EXPECT_LT(text.find("uvec4 k_decode_element("), text.find("uvec4 k_load_typed("));
}

TEST(GlslPrelude, NamesWhatIsMissing) {
  EXPECT_THAT(glsl_prelude("k_nobody(k_add(1, k_nobody(2)))").missing,
              testing::ElementsAre("k_nobody"));
}

TEST(GlslPrelude, AllIntrinsicsButThoseOfMatricesAreThere) {
  for (const std::string_view name : kIntrinsicNames) {
    if (name == "mul" || name == "transpose" || name == "determinant") continue;
    EXPECT_THAT(glsl_prelude("k_" + std::string(name) + "(x)").missing, IsEmpty());
  }
}

TEST(GlslPrelude, EveryBlockFindsWhatItUses) {
  const std::vector<std::string> names = glsl_prelude_names();
  ASSERT_GT(names.size(), 150u);
  std::string all = "float16_t int16_t uint16_t int64_t uint64_t double";
  for (const std::string& name : names) all += " " + name;
  const std::string text = glsl_prelude(all).text;
  EXPECT_THAT(text, Not(HasSubstr("$"))) << "a placeholder is left";
  for (const std::string& name : names) EXPECT_THAT(text, HasSubstr(name));
}

// Calls of the functions that `text` defines, except those with parameters that are not values.
std::string calls_of(const std::string& text) {
  static const std::regex kHead(R"(\n(\w+) (k_\w+)\(([^)]*)\) \{)");
  static const std::regex kParameter(R"((\w+) \w+,?\s*)");
  std::string calls;
  for (std::sregex_iterator at(text.begin(), text.end(), kHead), end; at != end; ++at) {
    const std::string parameters = (*at)[3];
    if (parameters.find("out ") != std::string::npos) continue;
    std::string arguments;
    for (std::sregex_iterator p(parameters.begin(), parameters.end(), kParameter); p != end; ++p) {
      const std::string type = (*p)[1];
      arguments += (arguments.empty() ? "" : ", ") + (type == "k_Descriptor" ? std::string("k_null")
                                                      : type == "k_Window"   ? "k_Window(0UL, 0UL)"
                                                                             : type + "(1)");
    }
    calls += "  " + std::string((*at)[2]) + "(" + arguments + ");\n";
  }
  return calls;
}

TEST(GlslPrelude, EveryFunctionIsValidSpirv) {
  std::string all = "float16_t int16_t uint16_t int64_t uint64_t double k_null k_Window";
  for (const std::string& name : glsl_prelude_names()) all += " " + name;
  const std::string prelude = glsl_prelude(all).text;
  const std::string calls = calls_of(prelude);
  EXPECT_GT(std::count(calls.begin(), calls.end(), '\n'), 2000);
  GlslShader shader;
  // An entry point defines these functions for checked.glsl.
  const std::string entry =
      "uint g_check_shader() { return 0u; }\nuvec3 g_check_index() { return uvec3(0); }\n";
  shader.text = "#version 460\n" + prelude + entry + "void main() {\n" + calls + "}\n";
  shader.stage = ir::kStageCompute;
  const SpirvModule module = compile_spirv(shader, "test");
  ASSERT_EQ(module.error.message(), "");
  std::string messages;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { messages += std::string(message) + "\n"; });
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  EXPECT_TRUE(tools.Validate(module.words.data(), module.words.size(), options)) << messages;
}

// Checks that the text of `body`, together with what it uses, is valid GLSL.
std::string messages_of(std::string_view head, const std::string& body) {
  GlslShader shader;
  shader.text = std::string("#version 460\n") + std::string(head) + glsl_prelude(body).text +
                "void main() {}\n";
  shader.stage = head.empty() ? ir::kStageCompute : ir::kStageRayGeneration;
  return compile_spirv(shader, "test").error.message();
}

TEST(GlslPrelude, EveryOverloadCompiles) {
  std::string all = "float16_t int16_t uint16_t int64_t uint64_t double";
  for (const std::string& name : glsl_prelude_names()) all += " " + name;
  EXPECT_EQ(messages_of("", all), "");
  EXPECT_EQ(
      messages_of("#extension GL_EXT_ray_tracing : require\n#define KAAMOS_SHADER_RECORD 1\n", all),
      "");
}

TEST(GlslPrelude, EveryBlockCompilesWithNothingButWhatItUses) {
  for (const std::string& name : glsl_prelude_names()) {
    EXPECT_EQ(messages_of("", name), "") << name;
    EXPECT_EQ(messages_of("", name + " float16_t double int64_t"), "") << name;
  }
}

}  // namespace
}  // namespace kaamos::hlsl
