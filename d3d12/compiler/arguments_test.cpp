// SPDX-License-Identifier: MIT
#include "d3d12/compiler/arguments.h"

#include <gmock/gmock.h>

#include <string_view>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

DxcArguments parse(const std::vector<std::string>& words) {
  const auto parsed = parse_dxc_arguments(words);
  EXPECT_TRUE(parsed) << parsed.error().message;
  return parsed ? *parsed : DxcArguments();
}

std::string error_of(const std::vector<std::string>& words) {
  const auto parsed = parse_dxc_arguments(words);
  if (parsed) return "";
  EXPECT_EQ(parsed.error().id, public_id(ErrorId::kCompiler));
  return parsed.error().message;
}

TEST(DxcArguments, ValuesFollowOrAreAttached) {
  for (const auto& words : {std::vector<std::string>{"-T", "lib_6_3", "-E", "Main", "a.hlsl"},
                            {"-Tlib_6_3", "-EMain", "a.hlsl"},
                            {"/T", "lib_6_3", "/EMain", "a.hlsl"},
                            {"a.hlsl", "/Tlib_6_3", "/E", "Main"}}) {
    const DxcArguments parsed = parse(words);
    EXPECT_EQ(parsed.options.Target, "lib_6_3");
    EXPECT_EQ(parsed.options.EntryPoint, "Main");
    EXPECT_EQ(parsed.options.File, "a.hlsl");
  }
}

TEST(DxcArguments, DefinesAndFolders) {
  const DxcArguments parsed =
      parse({"-D", "ONE", "-DTWO=2", "/D", "EMPTY=", "-I", "first", "-Isecond", "a.hlsl"});
  ASSERT_EQ(parsed.options.Defines.size(), 3u);
  EXPECT_EQ(parsed.options.Defines[0].Name, "ONE");
  EXPECT_EQ(parsed.options.Defines[0].Value, "1");
  EXPECT_EQ(parsed.options.Defines[1].Value, "2");
  EXPECT_EQ(parsed.options.Defines[2].Name, "EMPTY");
  EXPECT_EQ(parsed.options.Defines[2].Value, "");
  EXPECT_THAT(parsed.options.IncludeDirectories, ElementsAre("first", "second"));
}

TEST(DxcArguments, OptionsOfTheLanguage) {
  const DxcArguments plain = parse({"a.hlsl"});
  EXPECT_FALSE(plain.options.RowMajorMatrices);
  EXPECT_FALSE(plain.options.Native16BitTypes);
  EXPECT_FALSE(plain.options.ReserveUnusedRegisters);
  EXPECT_TRUE(parse({"-flegacy-resource-reservation", "a.hlsl"}).options.ReserveUnusedRegisters);
  EXPECT_EQ(plain.options.HlslVersion, "2021");
  EXPECT_FALSE(plain.options.AutoBindingSpace);
  EXPECT_FALSE(plain.options.PayloadQualifiers);
  const DxcArguments parsed =
      parse({"-Zpr", "-enable-16bit-types", "-HV", "2018", "-auto-binding-space", "7", "-exports",
             "A;B=C", "-default-linkage", "external", "-disable-payload-qualifiers", "a.hlsl"});
  EXPECT_TRUE(parsed.options.RowMajorMatrices);
  EXPECT_TRUE(parsed.options.Native16BitTypes);
  EXPECT_EQ(parsed.options.HlslVersion, "2018");
  EXPECT_EQ(parsed.options.AutoBindingSpace, 7u);
  EXPECT_THAT(parsed.options.Exports, ElementsAre("A", "B=C"));
  EXPECT_TRUE(parsed.options.ExternalLinkage);
  EXPECT_EQ(parsed.options.PayloadQualifiers, false);
  EXPECT_FALSE(parse({"-Zpr", "-Zpc", "a.hlsl"}).options.RowMajorMatrices);
}

TEST(DxcArguments, ExperimentalModelsAreChosenByTheVariable) {
  EXPECT_FALSE(parse({"-T", "lib_6_10", "a.hlsl"}).options.Experimental);
  setenv("KAAMOS_SHADER_MODEL", "6.10", 1);
  EXPECT_TRUE(parse({"-T", "lib_6_10", "a.hlsl"}).options.Experimental);
  setenv("KAAMOS_SHADER_MODEL", "6.9", 1);
  EXPECT_FALSE(parse({"-T", "lib_6_10", "a.hlsl"}).options.Experimental);
  unsetenv("KAAMOS_SHADER_MODEL");
}

TEST(DxcArguments, Files) {
  const DxcArguments parsed = parse({"-Fo", "a.cso", "-Fha.h", "-Vn", "g_a", "-Fe", "a.err", "-Fc",
                                     "a.asm", "/Fd", "a.pdb", "-MF", "a.d", "a.hlsl"});
  EXPECT_EQ(parsed.object, "a.cso");
  EXPECT_EQ(parsed.header, "a.h");
  EXPECT_EQ(parsed.variable, "g_a");
  EXPECT_EQ(parsed.errors, "a.err");
  EXPECT_EQ(parsed.listing, "a.asm");
  EXPECT_EQ(parsed.dependency_file, "a.d");
  EXPECT_EQ(parse({"-MD", "folder/a.hlsl"}).dependency_file, "folder/a.d");
}

TEST(DxcArguments, DebugCodeUnlessOptimised) {
  EXPECT_FALSE(parse({"-O3", "a.hlsl"}).options.Debug);
  EXPECT_FALSE(parse({"-O3", "a.hlsl"}).absolute_paths);
  EXPECT_TRUE(parse({"-Od", "a.hlsl"}).options.Debug);
  EXPECT_TRUE(parse({"-Zi", "-Qembed_debug", "a.hlsl"}).options.Debug);
  EXPECT_FALSE(parse({"-Zi", "-O3", "a.hlsl"}).options.Debug);
  EXPECT_TRUE(parse({"-Zi", "-O3", "a.hlsl"}).absolute_paths);
  EXPECT_TRUE(parse({"-Zi", "-Od", "-O3", "a.hlsl"}).options.Debug);
}

// DXC says so too: the layout that they asked for is gone.
TEST(DxcArguments, LayoutOfConstantBuffersStays) {
  for (const char* option : {"-no-legacy-cbuf-layout", "/not_use_legacy_cbuf_load"}) {
    const DxcArguments parsed = parse({option, "-T", "cs_6_0", "a.hlsl"});
    ASSERT_EQ(parsed.notes.size(), 1u);
    EXPECT_THAT(parsed.notes[0], HasSubstr(std::string(option + 1) + " has no effect"));
  }
}

// Shaders run with denormals flushed, which "any" allows and "ftz" asks for.
TEST(DxcArguments, DenormalsAreFlushed) {
  for (const char* mode : {"any", "ftz"}) {
    EXPECT_TRUE(parse({"-denorm", mode, "-T", "cs_6_2", "a.hlsl"}).notes.empty()) << mode;
  }
  const DxcArguments kept = parse({"/denorm", "preserve", "-T", "cs_6_2", "a.hlsl"});
  ASSERT_EQ(kept.notes.size(), 1u);
  EXPECT_THAT(kept.notes[0], HasSubstr("-denorm preserve has no effect"));
  EXPECT_THAT(error_of({"-denorm", "none", "a.hlsl"}), HasSubstr("any, ftz or preserve"));
}

TEST(DxcArguments, OldProfilesArePromoted) {
  const DxcArguments parsed = parse({"-T", "cs_5_1", "a.hlsl"});
  EXPECT_EQ(parsed.options.Target, "cs_6_0");
  ASSERT_EQ(parsed.notes.size(), 1u);
  EXPECT_THAT(parsed.notes[0], HasSubstr("promoting"));
  EXPECT_EQ(parse({"-T", "cs", "a.hlsl"}).options.Target, "cs");  // refused later
}

TEST(DxcArguments, ErrorsNameTheArgument) {
  EXPECT_THAT(error_of({"-unheard-of", "a.hlsl"}), HasSubstr("\"-unheard-of\": it is unknown"));
  EXPECT_THAT(error_of({"a.hlsl", "-T"}), HasSubstr("\"-T\": a value must follow"));
  EXPECT_THAT(error_of({"-HV", "1999", "a.hlsl"}), HasSubstr("2016 to 2018"));
  EXPECT_THAT(error_of({"-auto-binding-space", "x", "a.hlsl"}), HasSubstr("whole number"));
  EXPECT_THAT(error_of({"-default-linkage", "both", "a.hlsl"}), HasSubstr("external or internal"));
  EXPECT_THAT(error_of({"a.hlsl", "b.hlsl"}), HasSubstr("\"a.hlsl\""));
  EXPECT_THAT(error_of({"-spirv", "a.hlsl"}), HasSubstr("kaamos-hlsl -emit spirv"));
}

TEST(DxcArguments, BackslashesArePathsOfWindows) {
  const auto parsed = parse({"-I", "with\\headers", "shaders\\a.hlsl"});
  EXPECT_EQ(parsed.options.File, "shaders/a.hlsl");
  EXPECT_THAT(parsed.options.IncludeDirectories, ElementsAre("with/headers"));
}

TEST(DxcArguments, PathsMayBeginWithASlash) {
  EXPECT_EQ(parse({"-T", "lib_6_3", "/no/such/a.hlsl"}).options.File, "/no/such/a.hlsl");
  // -D takes any text, so that only the file system can tell.
  const std::string path = KAAMOS_SOURCE_DIR "/README.md";
  EXPECT_EQ(parse({path}).options.File, path);
  EXPECT_EQ(parse({"/fast/a.hlsl"}).options.File, "/fast/a.hlsl");  // no -f
  EXPECT_EQ(parse({"/Fo/out/a.cso", "a.hlsl"}).object, "/out/a.cso");
}

TEST(DxcArguments, ValuesOfIgnoredOptionsAreNoSources) {
  EXPECT_EQ(
      parse({"-force-rootsig-ver", "rootsig_1_1", "-encoding", "utf8", "a.hlsl"}).options.File,
      "a.hlsl");
}

// Every row of the table does what it says: with a value where it takes one.
TEST(DxcArguments, EveryOptionIsTakenIgnoredOrRefused) {
  enum Form { kFlag, kValue, kJoined, kPrefix };
  enum Use { kTaken, kIgnored, kRefused };
  struct Row {
    std::string_view name;
    Form form;
    Use use;
    std::string_view text;
  };
  const Row rows[] = {
#define KAAMOS_DXC_OPTION(name, form, use, text) {name, form, use, text},
#include "d3d12/compiler/arguments.inc"
#undef KAAMOS_DXC_OPTION
  };
  const std::string help = dxc_help();
  for (const Row& row : rows) {
    std::vector<std::string> words = {std::string(row.name)};
    if (row.form == kPrefix) words[0] += "anything";
    if (row.form == kValue || row.form == kJoined) {
      words.push_back(row.name == "-HV"                ? "2018"
                      : row.name == "-default-linkage" ? "external"
                      : row.name == "-denorm"          ? "any"
                                                       : "1");
    }
    words.push_back("a.hlsl");
    const std::string error = error_of(words);
    if (row.use == kRefused) {
      EXPECT_THAT(error, HasSubstr(std::string(row.text))) << row.name;
    } else {
      EXPECT_EQ(error, "") << row.name;
    }
    EXPECT_THAT(help, HasSubstr(std::string(row.text))) << row.name;
  }
}

}  // namespace
}  // namespace kaamos::d3d12
