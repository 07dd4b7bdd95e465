// SPDX-License-Identifier: MIT
#include "runtime/hlsl/glsl_prelude.h"

#include <gmock/gmock.h>

#include "runtime/hlsl/intrinsics.h"
#include "runtime/hlsl/spirv.h"

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

// The text of `body` and of what it uses is GLSL.
std::string messages_of(std::string_view head, const std::string& body) {
  GlslShader shader;
  shader.text = std::string("#version 460\n") + std::string(head) + glsl_prelude(body).text +
                "void main() {}\n";
  shader.stage = head.empty() ? ir::kStageCompute : ir::kStageRayGeneration;
  return compile_spirv(shader, "test").error;
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
