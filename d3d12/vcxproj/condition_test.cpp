// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/condition.h"

#include <gtest/gtest.h>

#include <string>

#include "d3d12/vcxproj/project_files.h"

namespace kaamos::vcxproj {
namespace {

TEST(VcxprojCondition, Compares) {
  EXPECT_EQ(evaluate_condition("", "/"), true);
  EXPECT_EQ(evaluate_condition("'Release|x64'=='release|X64'", "/"), true);
  EXPECT_EQ(evaluate_condition(" 'a' != 'a' ", "/"), false);
  EXPECT_EQ(evaluate_condition("'17.0' == '17'", "/"), true);
  EXPECT_EQ(evaluate_condition("'14' >= '15'", "/"), false);
  EXPECT_EQ(evaluate_condition("true", "/"), true);
}

TEST(VcxprojCondition, AndBindsTighterThanOr) {
  EXPECT_EQ(evaluate_condition("'a'=='a' Or 'a'=='a' And 'a'=='b'", "/"), true);
  EXPECT_EQ(evaluate_condition("('a'=='a' or 'a'=='a') and 'a'=='b'", "/"), false);
  EXPECT_EQ(evaluate_condition("!('a'=='b')", "/"), true);
  EXPECT_EQ(evaluate_condition("!true", "/"), false);
}

TEST(VcxprojCondition, UnknownOnesHaveNoValue) {
  for (const char* text : {"'a'", "'a'=='b", "frob('a')", "'a'=='a' extra", "(true", "'a' < 'b'"}) {
    EXPECT_EQ(evaluate_condition(text, "/"), std::nullopt) << text;
  }
  EXPECT_EQ(evaluate_condition(std::string(100000, '('), "/"), std::nullopt);
}

using VcxprojConditionFiles = ProjectFiles;

TEST_F(VcxprojConditionFiles, ExistsIgnoresCase) {
  write("Sub/File.props");
  EXPECT_EQ(evaluate_condition("Exists('sub\\file.PROPS')", folder), true);
  EXPECT_EQ(evaluate_condition("!exists('sub\\other')", folder), true);
}

TEST_F(VcxprojConditionFiles, UnknownOnesAreFalseAndNamed) {
  write_project(
      "<PropertyGroup><A Condition=\"frob('x')\">1</A><B Condition=\"'$(A)'==''\">2</B>"
      "</PropertyGroup>");
  const auto evaluation = evaluated();
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->properties.get("b"), "2");
  ASSERT_EQ(notes.of(Topic::kConditions).size(), 1u);
  EXPECT_EQ(notes.of(Topic::kConditions)[0], "frob('x')");
}

}  // namespace
}  // namespace kaamos::vcxproj
