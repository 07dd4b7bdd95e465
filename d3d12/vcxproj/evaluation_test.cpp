// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/evaluation.h"

#include <gmock/gmock.h>

#include "d3d12/vcxproj/paths.h"
#include "d3d12/vcxproj/project_files.h"

namespace kaamos::vcxproj {
namespace {

using testing::HasSubstr;
using VcxprojEvaluation = ProjectFiles;

TEST_F(VcxprojEvaluation, MacrosAreThoseOfVisualStudio) {
  write("all.sln");
  write_project(
      "<PropertyGroup><ProjectName>Other</ProjectName><Mine>$(ProjectName)-$(PLATFORM)</Mine>"
      "<Configuration>Debug</Configuration></PropertyGroup>",
      "src/app.vcxproj");
  const auto evaluation = evaluated("src/app.vcxproj");
  ASSERT_TRUE(evaluation);
  const Properties& properties = evaluation->properties;
  EXPECT_EQ(properties.get("Mine"), "Other-x64");
  EXPECT_EQ(properties.get("Configuration"), "Release") << "the command line's wins";
  EXPECT_EQ(properties.expand("$(ProjectDir)a"), (folder / "src/a").string());
  EXPECT_EQ(properties.expand("$(SolutionDir)$(Nothing)"), folder.string() + "/");
  EXPECT_EQ(properties.expand("$(OutDir)"), folder.string() + "/x64/Release/");
  EXPECT_EQ(properties.expand("$([System.IO.Path]::GetTempPath())"), "");
  EXPECT_THAT(notes.text(), HasSubstr("GetTempPath"));
}

TEST_F(VcxprojEvaluation, ImportsAreReadInPlaceAndKnowTheirFolder) {
  write_project(
      "<PropertyGroup><Here>$(MSBuildThisFileDirectory)</Here></PropertyGroup>"
      "<ItemGroup><ClCompile Include=\"$(MSBuildThisFileDirectory)shared.cpp\"/></ItemGroup>",
      "shared/Shared.vcxitems");
  write_project(
      "<Import Project=\"..\\SHARED\\shared.vcxitems\"/>"
      "<Import Project=\"$(VCTargetsPath)\\Microsoft.Cpp.props\"/>"
      "<Import Project=\"gone.props\"/>"
      "<PropertyGroup><There>$(MSBuildThisFileDirectory)</There></PropertyGroup>",
      "src/app.vcxproj");
  const auto evaluation = evaluated("src/app.vcxproj");
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->properties.get("Here"), folder.string() + "/shared/");
  EXPECT_EQ(evaluation->properties.get("There"), folder.string() + "/src/");
  ASSERT_EQ(evaluation->items.size(), 1u);
  EXPECT_EQ(evaluation->items[0].path(), folder / "shared/shared.cpp");
  EXPECT_EQ(notes.text(), "not found, left out:\n  gone.props (import of app.vcxproj)\n");
}

TEST_F(VcxprojEvaluation, ItemsInheritDefaults) {
  write_project(
      "<ItemDefinitionGroup><FxCompile><VariableName>g_%(Filename)</VariableName>"
      "<PreprocessorDefinitions>A;%(PreprocessorDefinitions)</PreprocessorDefinitions>"
      "</FxCompile></ItemDefinitionGroup>"
      "<ItemDefinitionGroup><FxCompile>"
      "<PreprocessorDefinitions>B;%(PreprocessorDefinitions)</PreprocessorDefinitions>"
      "</FxCompile></ItemDefinitionGroup>"
      "<ItemGroup><FxCompile Include=\"sub\\x.hlsl\">"
      "<PreprocessorDefinitions>C;%(FxCompile.PreprocessorDefinitions)</PreprocessorDefinitions>"
      "<Own Condition=\"'%(Extension)'=='.hlsl'\">%(Identity)|%(RelativeDir)|%(FullPath)</Own>"
      "</FxCompile></ItemGroup>");
  const auto evaluation = evaluated();
  ASSERT_TRUE(evaluation);
  const Item& item = evaluation->items.at(0);
  EXPECT_EQ(item.value("VariableName"), "g_x");
  EXPECT_EQ(item.value("preprocessordefinitions"), "C;B;A;");
  EXPECT_EQ(item.value("Own"), "sub/x.hlsl|sub/|" + (folder / "sub/x.hlsl").string());
}

TEST_F(VcxprojEvaluation, WildcardsExcludeRemoveAndUpdate) {
  for (const char* file : {"a.cpp", "B.CPP", "sub/c.cpp", "sub/deep/d.cpp", "sub/e.h"}) write(file);
  write_project(
      "<ItemGroup><ClCompile Include=\"*.cpp;sub\\**\\*.cpp;none\\*.cpp\" Exclude=\"a.cpp\"/>"
      "<ClCompile Remove=\"sub\\c.cpp\"/>"
      "<ClCompile Update=\"b.cpp\"><X>1</X></ClCompile></ItemGroup>");
  const auto evaluation = evaluated();
  ASSERT_TRUE(evaluation);
  ASSERT_EQ(evaluation->items.size(), 2u);
  EXPECT_EQ(evaluation->items[0].include, "B.CPP");
  EXPECT_EQ(evaluation->items[0].value("X"), "1");
  EXPECT_EQ(evaluation->items[1].include, "sub/deep/d.cpp");
  EXPECT_THAT(notes.text(), HasSubstr("none\\*.cpp"));
}

TEST_F(VcxprojEvaluation, ChooseTakesTheFirstThatHolds) {
  write_project(
      "<Choose><When Condition=\"'$(Platform)'=='Win32'\"><PropertyGroup><A>1</A></PropertyGroup>"
      "</When><Otherwise><PropertyGroup><A>2</A></PropertyGroup></Otherwise></Choose>");
  const auto evaluation = evaluated();
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->properties.get("A"), "2");
}

TEST_F(VcxprojEvaluation, MetadataThatRefersToItselfEnds) {
  write_project(
      "<ItemDefinitionGroup><None><A>%(Filename)%(A)</A></None></ItemDefinitionGroup>"
      "<ItemGroup><None Include=\"x\"><B>%(B)y</B></None></ItemGroup>");
  const auto evaluation = evaluated();
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->items.at(0).value("A"), "x");
  EXPECT_EQ(evaluation->items.at(0).value("B"), "y");
}

TEST_F(VcxprojEvaluation, BadFilesAreErrors) {
  EXPECT_FALSE(evaluated("none.vcxproj"));
  write("damaged.vcxproj", "<Project><ItemGroup></Project>");
  EXPECT_FALSE(evaluated("damaged.vcxproj"));
  write("other.vcxproj", "<html/>");
  EXPECT_FALSE(evaluated("other.vcxproj"));
  write_project("<Import Project=\"damaged.vcxproj\"/>", "importing.vcxproj");
  EXPECT_FALSE(evaluated("importing.vcxproj"));
  ASSERT_EQ(notes.errors().size(), 3u);  // that of damaged.vcxproj is the same twice
  EXPECT_THAT(notes.errors()[0], HasSubstr("none.vcxproj: cannot be read"));
  EXPECT_THAT(notes.errors()[1], HasSubstr("damaged.vcxproj: damaged XML at byte"));
  EXPECT_THAT(notes.errors()[2], HasSubstr("other.vcxproj: begins with <html>"));
}

TEST_F(VcxprojEvaluation, ImportsInACircleAreErrors) {
  write_project("<Import Project=\"a.props\"/>");
  write_project("<Import Project=\"b.props\"/>", "a.props");
  write_project("<Import Project=\"a.props\"/>", "b.props");
  EXPECT_FALSE(evaluated());
  ASSERT_EQ(notes.errors().size(), 1u);
  EXPECT_THAT(notes.errors()[0],
              HasSubstr("imports in a circle: app.vcxproj > a.props > b.props > a.props"));
}

}  // namespace
}  // namespace kaamos::vcxproj
