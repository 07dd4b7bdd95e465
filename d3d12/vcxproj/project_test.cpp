// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/project.h"

#include <gmock/gmock.h>

#include "d3d12/vcxproj/command.h"
#include "d3d12/vcxproj/project_files.h"

namespace kaamos::vcxproj {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using VcxprojProject = ProjectFiles;

std::string items(const std::string& text) {
  return "<ItemGroup>" + text + "</ItemGroup>";
}

TEST(VcxprojCommand, WordsLoseQuotesAndRedirections) {
  EXPECT_THAT(split_words("dxc -E\"VSMain\" -Fo\"a b.cso\" \"c d.hlsl\" > NUL 2>&1"),
              ElementsAre("dxc", "-EVSMain", "-Foa b.cso", "c d.hlsl"));
}

TEST_F(VcxprojProject, SourcesAreFoundInAnyCase) {
  write("Src/Main.cpp");
  write("left.cpp");
  write_project(
      items("<ClCompile Include=\"src\\MAIN.cpp\"/><ClCompile Include=\"gone.cpp\"/>"
            "<ClCompile Include=\"lost.cpp\"/>"
            "<ClCompile Include=\"left.cpp\"><ExcludedFromBuild "
            "Condition=\"'$(Configuration)'=='Release'\">true</ExcludedFromBuild>"
            "</ClCompile><Frob Include=\"x.frob\"/>"));
  const auto project = imported();
  ASSERT_TRUE(project);
  EXPECT_THAT(project->sources, ElementsAre(folder / "Src/Main.cpp"));
  EXPECT_THAT(notes.of(Topic::kMissing), ElementsAre("ClCompile gone.cpp", "ClCompile lost.cpp"));
  EXPECT_THAT(notes.of(Topic::kItems), ElementsAre("Frob x.frob"));
}

TEST_F(VcxprojProject, HostOptions) {
  write("main.cpp");
  write("inc/a.h");
  write_project(
      "<PropertyGroup><CharacterSet>Unicode</CharacterSet></PropertyGroup>"
      "<ItemDefinitionGroup><ClCompile>"
      "<PreprocessorDefinitions>NDEBUG;N=1;TEXT=\"x y\";%(PreprocessorDefinitions)"
      "</PreprocessorDefinitions><ForcedIncludeFiles>stdafx.h</ForcedIncludeFiles>"
      "<AdditionalIncludeDirectories>INC;$(IntDir);gone;%(AdditionalIncludeDirectories)"
      "</AdditionalIncludeDirectories><StructMemberAlignment>4Bytes</StructMemberAlignment>"
      "<LanguageStandard>stdcpp20</LanguageStandard>"
      "<AdditionalOptions>/bigobj /frob /DMORE %(AdditionalOptions)</AdditionalOptions>"
      "</ClCompile><Link><AdditionalDependencies>d3d12.lib;d2d1.lib;%(AdditionalDependencies)"
      "</AdditionalDependencies></Link></ItemDefinitionGroup>" +
      items("<ClCompile Include=\"main.cpp\"><PreprocessorDefinitions>OWN;"
            "%(PreprocessorDefinitions)</PreprocessorDefinitions></ClCompile>"));
  const auto project = imported();
  ASSERT_TRUE(project);
  EXPECT_THAT(project->defines,
              ElementsAre("UNICODE", "_UNICODE", "N=1", "TEXT=\"x y\"", "MORE", "OWN"));
  EXPECT_THAT(project->includes, ElementsAre(folder / "inc", folder));
  EXPECT_THAT(project->forced_includes, ElementsAre("stdafx.h"));
  EXPECT_THAT(project->options, ElementsAre("-fpack-struct=4", "-std=gnu++20"));
  EXPECT_THAT(notes.of(Topic::kMissing), ElementsAre("include folder gone"));
  EXPECT_THAT(notes.of(Topic::kLibraries), ElementsAre("d2d1.lib"));
  EXPECT_THAT(
      notes.of(Topic::kOptions),
      ElementsAre("of cl, left out: /frob", "main.cpp: its define OWN goes to all sources"));
}

TEST_F(VcxprojProject, ShaderItems) {
  write("main.cpp", "#include \"Compiled\\Lib.hlsl.h\"\n");
  for (const char* file : {"lib.hlsl", "old.hlsl", "quads.hlsl", "patch.hlsl"}) write(file);
  write_project(
      "<PropertyGroup><IntDir>obj\\</IntDir></PropertyGroup>" +
      items("<ClCompile Include=\"main.cpp\"/>"
            "<FxCompile Include=\"lib.hlsl\"><ShaderType>Library</ShaderType>"
            "<ShaderModel>6.5</ShaderModel><EntryPointName>main</EntryPointName>"
            "<HeaderFileOutput>$(IntDir)Compiled\\%(Filename).hlsl.h</HeaderFileOutput>"
            "<VariableName>g_p%(Filename)</VariableName>"
            "<AdditionalOptions>/Zpr -HV 2021 -Zi /Fd \"$(OutDir)x.pdb\"</AdditionalOptions>"
            "<PreprocessorDefinitions>A=1;B</PreprocessorDefinitions></FxCompile>"
            "<FxCompile Include=\"old.hlsl\"><ShaderType>Pixel</ShaderType>"
            "<ShaderModel>5.1</ShaderModel><EntryPointName>PS</EntryPointName>"
            "<ObjectFileOutput>$(OutDir)shaders\\%(Filename).cso</ObjectFileOutput></FxCompile>"
            "<FxCompile Include=\"quads.hlsl\"><ShaderType>Geometry</ShaderType>"
            "<ShaderModel>6.0</ShaderModel></FxCompile>"
            "<FxCompile Include=\"patch.hlsl\"><ShaderType>Hull</ShaderType></FxCompile>"));
  const auto project = imported();
  ASSERT_TRUE(project);
  ASSERT_EQ(project->shaders.size(), 3u);
  const Shader& library = project->shaders[0];
  EXPECT_EQ(library.profile, "lib_6_5");
  EXPECT_EQ(library.entry, "");
  EXPECT_EQ(library.header, "Compiled/Lib.hlsl.h") << "as the source includes it";
  EXPECT_EQ(library.variable, "g_plib");
  EXPECT_THAT(library.options, ElementsAre("-DA=1", "-DB", "-Zpr", "-HV", "2021"));
  const Shader& pixel = project->shaders[1];
  EXPECT_EQ(pixel.profile, "ps_6_0");
  EXPECT_EQ(pixel.entry, "PS");
  EXPECT_EQ(pixel.object, "shaders/old.cso");
  EXPECT_EQ(project->shaders[2].profile, "gs_6_0");
  EXPECT_THAT(notes.of(Topic::kShaders),
              ElementsAre("old.hlsl: shader model 5.1 becomes ps_6_0",
                          "patch.hlsl: Kaamos compiles no shaders of profile hs, left out"));
}

TEST_F(VcxprojProject, CustomBuilds) {
  for (const char* file : {"s.hlsl", "Assets/A.bin", "main.cpp"}) write(file);
  write_project(
      "<ItemDefinitionGroup><CustomBuild><Command>copy %(Identity) \"$(OutDir)\" &gt; NUL"
      "</Command></CustomBuild></ItemDefinitionGroup>" +
      items("<CustomBuild Include=\"assets\\a.bin\"/>"
            "<CustomBuild Include=\"s.hlsl\"><Command>"
            "dxc.exe -nologo -Tvs_6_0 -E\"VS\" -Zi -Fo\"$(OutDir)%(Filename)_VS.cso\" "
            "\"%(FullPath)\"\nmkdir x\nfxc /Tps_5_0 /EPS /Fo\"$(OutDir)%(Filename)_VS.cso\" "
            "%(Identity)\nfrob.exe %(Filename)</Command></CustomBuild>"));
  const auto project = imported();
  ASSERT_TRUE(project);
  ASSERT_EQ(project->contents.size(), 1u);
  EXPECT_EQ(project->contents[0].source, folder / "Assets/A.bin");
  EXPECT_EQ(project->contents[0].destination, "A.bin");
  ASSERT_EQ(project->shaders.size(), 2u);
  EXPECT_EQ(project->shaders[0].object, "s_VS.cso");
  EXPECT_EQ(project->shaders[0].entry, "VS");
  EXPECT_EQ(project->shaders[0].profile, "vs_6_0");
  EXPECT_EQ(project->shaders[1].profile, "ps_6_0");
  EXPECT_EQ(project->shaders[1].object, "s_VS_2.cso") << "no two shaders have one object";
  EXPECT_THAT(notes.of(Topic::kCommands), ElementsAre("s.hlsl: frob.exe s"));
}

TEST_F(VcxprojProject, ContentIsCopiedBesideTheProgram) {
  for (const char* file : {"a/1.txt", "a/2.png", "3.dds", "4.txt", "5.bin"}) write(file);
  write_project(
      items("<None Include=\"a\\1.txt\"><CopyToOutputDirectory>PreserveNewest"
            "</CopyToOutputDirectory></None>"
            "<Image Include=\"a\\2.png\"><DeploymentContent>true</DeploymentContent></Image>"
            "<CopyFileToFolders Include=\"3.dds\"><DestinationFolders>$(OutDir)Textures"
            "</DestinationFolders></CopyFileToFolders><None Include=\"4.txt\"/>") +
      "<ItemDefinitionGroup><PostBuildEvent><Command>xcopy /Y /D \"$(ProjectDir)5.bin\" "
      "\"$(OutDir)data\\\"</Command></PostBuildEvent></ItemDefinitionGroup>");
  const auto project = imported();
  ASSERT_TRUE(project);
  std::vector<std::string> destinations;
  for (const Content& content : project->contents) destinations.push_back(content.destination);
  EXPECT_THAT(destinations, ElementsAre("a/1.txt", "a/2.png", "Textures/3.dds", "data/5.bin"));
}

TEST_F(VcxprojProject, StaticLibrariesBecomePartOfTheProgram) {
  write("main.cpp");
  write("lib/part.cpp");
  write_project(
      "<PropertyGroup><ConfigurationType>StaticLibrary</ConfigurationType>"
      "</PropertyGroup>" +
          items("<ClCompile Include=\"part.cpp\"/>"
                "<ProjectReference Include=\"..\\app.vcxproj\"/>"),
      "lib/part.vcxproj");
  write_project(
      items("<ClCompile Include=\"main.cpp\"/>"
            "<ProjectReference Include=\"lib\\part.vcxproj\"/>"));
  const auto project = imported();
  ASSERT_TRUE(project);
  EXPECT_EQ(project->name, "app");
  EXPECT_THAT(project->sources, ElementsAre(folder / "main.cpp", folder / "lib/part.cpp"));
}

TEST_F(VcxprojProject, WrittenText) {
  write("main.cpp");
  write("s \"$x.hlsl");
  write_project(
      "<PropertyGroup><ProjectName>My app</ProjectName></PropertyGroup>"
      "<ItemDefinitionGroup><ClCompile><PreprocessorDefinitions>T=\"a b\\n\""
      "</PreprocessorDefinitions><ForcedIncludeFiles>f.h</ForcedIncludeFiles></ClCompile>"
      "</ItemDefinitionGroup>" +
      items("<ClCompile Include=\"main.cpp\"/><None Include=\"main.cpp\">"
            "<CopyToOutputDirectory>Always</CopyToOutputDirectory></None>"));
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr("\nproject(My_app LANGUAGES CXX)\nfind_package(kaamos REQUIRED)\n"));
  EXPECT_THAT(text, HasSubstr("kaamos_add_d3d12_program(My_app\n  SOURCES\n    main.cpp\n"));
  EXPECT_THAT(text, HasSubstr("\n    \"T=\\\"a b\\\\n\\\"\"\n"));
  EXPECT_THAT(text, HasSubstr("OPTIONS\n    -include f.h)"));
  EXPECT_THAT(text, HasSubstr("add_content(main.cpp main.cpp)\n"));
  EXPECT_THAT(text, Not(HasSubstr(folder.string())));
  EXPECT_EQ(cmake_argument("s \"$x;"), "\"s \\\"\\$x;\"");
}

}  // namespace
}  // namespace kaamos::vcxproj
