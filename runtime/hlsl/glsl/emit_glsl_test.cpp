// SPDX-License-Identifier: MIT
//
// Every entry point in every HLSL file of the tests, examples and effects becomes GLSL that glslang
// accepts and SPIR-V that spirv-val accepts. Where the shape of the text matters, it is tested too.
#include "runtime/hlsl/glsl/emit_glsl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <spirv-tools/libspirv.hpp>
#include <sstream>
#include <thread>

#include "runtime/hlsl/check/check_test_support.h"
#include "runtime/hlsl/glsl/spirv.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kRoot = KAAMOS_SOURCE_DIR;

// The options in the header of a file in tests/hlsl.
FrontendOptions options_of(const fs::path& path) {
  FrontendOptions options;
  options.path = path.string();
  options.include_folders = {kRoot + "/tests/hlsl", kRoot + "/effects/shaders",
                             kRoot + "/tests/shaders/include"};
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with("//");) {
    std::istringstream words(line);
    std::string word;
    words >> word >> word;
    if (word != "OPTIONS:") continue;
    while (words >> word) {
      if (word == "-enable-16bit-types") options.native_16bit = true;
      if (word == "-enable-experimental") options.experimental = true;
      if (word == "-disable-payload-qualifiers") options.payload_qualifiers = false;
      if (word == "-Zpr") options.row_major = true;
      if (word == "-HV") words >> options.hlsl_version;
      if (word == "-D" && words >> word) options.defines.push_back(word);
      if (word == "-T") words >> options.target;
    }
  }
  const std::string rest(std::istreambuf_iterator<char>(file), {});
  const auto has = [&](const char* word) { return rest.find(word) != std::string::npos; };
  if (has("dx::HitObject") && has("[raypayload]")) options.target = "lib_6_9";
  if (has("ClusterID()") && has("[raypayload]")) {
    options.target = "lib_6_10";
    options.experimental = true;
  }
  return options;
}

std::string validate(const std::vector<uint32_t>& words) {
  std::string messages;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { messages += std::string(message) + "\n"; });
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  return tools.Validate(words.data(), words.size(), options) ? "" : messages + "invalid";
}

// The number of entry points that pass; messages for those that do not.
int sweep_file(const fs::path& path, bool checked, std::string& wrong) {
  DiskFileLoader loader;
  SourceManager sources(loader);
  DiagnosticEngine diagnostics;
  FrontendOptions options = options_of(path);
  options.check_access = checked;
  const auto module = compile_to_ir(options, sources, diagnostics);
  if (!module) {
    wrong += path.string() + ": " + render_all(diagnostics, sources);
    return 0;
  }
  int passed = 0;
  for (const ir::EntryPoint& entry : module->entry_points) {
    const auto check = [&](const GlslShader& shader) {
      const SpirvModule spirv = compile_spirv(shader, entry.name);
      return !spirv.error ? validate(spirv.words) : spirv.error.message();
    };
    std::string error = check(emit_glsl(*module, entry));
    if (has_twin(*module, entry)) error += check(emit_glsl_twin(*module, entry));
    if (error.empty()) {
      ++passed;
    } else {
      wrong += path.string() + ", " + entry.name + ": " + error + "\n";
    }
  }
  return passed;
}

void sweep(const std::string& folder, int at_least, bool checked = false) {
  std::vector<fs::path> files;
  for (const auto& file : fs::recursive_directory_iterator(kRoot + "/" + folder)) {
    if (file.path().extension() == ".hlsl") files.push_back(file.path());
  }
  std::sort(files.begin(), files.end());
  int passed = 0;
  std::string wrong;
  for (const fs::path& file : files) passed += sweep_file(file, checked, wrong);
  EXPECT_EQ(wrong, "");
  EXPECT_GE(passed, at_least);
}

TEST(EmitGlsl, Core) {
  sweep("tests/hlsl/core", 200);
}
TEST(EmitGlsl, Compute) {
  sweep("tests/hlsl/compute", 20);
}
TEST(EmitGlsl, Extended) {
  sweep("tests/hlsl/extended", 37);
}
TEST(EmitGlsl, Traps) {
  sweep("tests/hlsl/traps", 20);
}
TEST(EmitGlsl, Examples) {
  sweep("examples", 20);
}
TEST(EmitGlsl, Effects) {
  sweep("effects", 4);
}

// The code that a checked device runs.
TEST(EmitCheckedGlsl, Effects) {
  sweep("effects", 40, true);
}
TEST(EmitCheckedGlsl, Examples) {
  sweep("examples", 20, true);
}
TEST(EmitCheckedGlsl, Conformance) {
  sweep("tests/conformance", 100, true);
}
TEST(EmitCheckedGlsl, CheckedCode) {
  sweep("tests/checked_code", 20, true);
}

std::string glsl_of(const std::string& text, const std::string& entry = "main",
                    const std::string& target = FrontendOptions().target) {
  FrontendOptions options;
  options.target = target;
  Compilation compilation(text, options);
  if (!compilation.module) return compilation.messages();
  for (const ir::EntryPoint& one : compilation.module->entry_points) {
    if (one.name != entry) continue;
    const GlslShader shader = emit_glsl(*compilation.module, one);
    const SpirvModule spirv = compile_spirv(shader, entry);
    EXPECT_EQ(spirv.error.message(), "") << shader.text;
    EXPECT_EQ(validate(spirv.words), "") << shader.text;
    return shader.text;
  }
  return "no such entry point";
}

// ---------------------------------------------------------------------------------------------
// Shapes

TEST(EmitGlsl, NamesOfTheSourceNeverStandBare) {
  const std::string text =
      glsl_of(kernel("float texture2D = 1, common = 2, gl_Position = 3;\n"
                     "float buffer__ = texture2D + common + gl_Position;\n"
                     "results.Store(0, asuint(buffer__));"));
  EXPECT_THAT(text, HasSubstr("float u_texture2D = "));
  EXPECT_THAT(text, HasSubstr("float u_gl_Position = "));
  EXPECT_THAT(text, HasSubstr("float u_buffer = "));
}

TEST(EmitGlsl, NamesAreCutToWhatGlslAllows) {
  const std::string name(2000, 'x');
  const std::string text = glsl_of(kernel("float " + name + "a = 1, " + name +
                                              "b = 2;\nresults.Store2(0, asuint(float2(" + name +
                                              "a, f" + name + "(" + name + "b))));",
                                          "float f" + name + "(float v) { return v + 1; }"));
  EXPECT_THAT(text, Not(HasSubstr(std::string(300, 'x'))));
}

TEST(EmitGlsl, IndicesThatMayBeOutOfRangeAreGuarded) {
  const std::string text =
      glsl_of(kernel("uint a[3] = {1, 2, 3};\nuint i = results.Load(0);\na[i] = 4;\n"
                     "results.Store(4, a[i + 1] + a[2]);"));
  EXPECT_THAT(text, HasSubstr("if ((u_i < 3u)) u_a[min(u_i, 2u)] = 4u;"));
  EXPECT_THAT(text, HasSubstr("< 3u) ? u_a[min("));
  EXPECT_THAT(text, HasSubstr("u_a[2]"));
}

TEST(EmitGlsl, ContinueOfALoopWithTheTestAtItsEndGoesToTheTest) {
  const std::string text =
      glsl_of(kernel("uint n = 0;\ndo { ++n; if (n == 2) continue; results.Store(4 * n, n); }\n"
                     "while (n < 4);"));
  EXPECT_THAT(text, HasSubstr("bool g_t"));
  EXPECT_THAT(text, HasSubstr("continue;"));
}

constexpr char kScene[] = R"(
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);
struct Payload { bool hit; float3 colour; };
[shader("raygeneration")] void Trace() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 100};
  Payload payload = {false, float3(0, 0, 0)};
  TraceRay(scene, RAY_FLAG_NONE, 0x1FF, 0, 1, 0, ray, payload);
  results.Store(0, payload.hit);
}
[shader("closesthit")] void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  payload.hit = true;
  payload.colour = mul(ObjectToWorld3x4(), float4(a.barycentrics, 0, 1)) +
                   mul(float4(1, 2, 3, 4), WorldToObject4x3()) +
                   mul(float4(1, 2, 3, 4), ObjectToWorld4x3());
}
[shader("anyhit")] void Test(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  payload.colour.x = a.barycentrics.x;
  if (PrimitiveIndex() == 3) IgnoreHit();
}
struct Sphere { float3 normal; uint kind; };
[shader("intersection")] void Meet() {
  Sphere sphere = (Sphere)0;
  if (ReportHit(RayTCurrent() * 0.5, 7, sphere)) results.Store(4, 1);
}
)";

TEST(EmitGlsl, PayloadsTravelWithTheirDepthAndWithoutBools) {
  const std::string text = glsl_of(kScene, "Trace");
  EXPECT_THAT(text, HasSubstr("layout(location = 1) rayPayloadEXT "));
  EXPECT_THAT(text, HasSubstr("uint m_hit;"));
  EXPECT_THAT(text, HasSubstr("mask & 0xFFu"));
  EXPECT_THAT(text, HasSubstr("g_max_trace_depth"));
}

// glslang 12 generates invalid SPIR-V if both forms of the matrix are used in one shader.
TEST(EmitGlsl, OnlyOneFormOfTheTransformsIsUsed) {
  const std::string text = glsl_of(kScene, "Hit");
  EXPECT_THAT(text, HasSubstr("gl_ObjectToWorldEXT"));
  EXPECT_THAT(text, HasSubstr("gl_WorldToObjectEXT"));
  EXPECT_THAT(text, Not(HasSubstr("3x4EXT")));
}

TEST(EmitGlsl, APayloadIsWrittenBackBeforeAHitIsIgnored) {
  const std::string text = glsl_of(kScene, "Test");
  EXPECT_LT(text.find("g_in.data = "), text.rfind("ignoreIntersectionEXT"));
}

TEST(EmitGlsl, OnlyQueriesWithPermissionLookMicromapsUp) {
  const auto query = [](const std::string& arguments) {
    return glsl_of(kernel("RayQuery<" + arguments +
                              "> query;\n"
                              "RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 9};\n"
                              "query.TraceRayInline(scene, 0, 255, ray);\n"
                              "while (query.Proceed()) query.CommitNonOpaqueTriangleHit();",
                          "RaytracingAccelerationStructure scene : register(t7);"),
                   "main", "lib_6_9");
  };
  EXPECT_THAT(query("0, RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS"), HasSubstr("g_opacity("));
  EXPECT_THAT(query("0"), Not(HasSubstr("g_opacity(")));
}

TEST(EmitGlsl, AnyHitShadersBeginWithTheMicromapWherePipelinesAllowIt) {
  const std::string text = glsl_of(kScene, "Test");
  const size_t main = text.find("void main()");
  const size_t lookup = text.find("if (g_micromaps_allowed != 0u) {", main);
  ASSERT_NE(lookup, std::string::npos);
  EXPECT_LT(lookup, text.find("g_in", main));
}

TEST(EmitGlsl, AttributesAreWordsUnlessTwoFloats) {
  EXPECT_THAT(glsl_of(kScene, "Meet"), HasSubstr("hitAttributeEXT uint g_attributes[4];"));
  EXPECT_THAT(glsl_of(kScene, "Hit"), HasSubstr("hitAttributeEXT vec2 g_attributes;"));
}

TEST(EmitGlsl, OneShaderReportsAttributesOfSeveralTypes) {
  const std::string text = glsl_of(
      "struct Small { float2 uv; };\nstruct Large { double d; bool b[3]; };\n"
      "[shader(\"intersection\")] void Meet() {\n"
      "  Small small = {float2(1, 2)};\n  ReportHit(1, 0, small);\n"
      "  Large large = (Large)0;\n  ReportHit(2, 0, large);\n}\n",
      "Meet");
  EXPECT_THAT(text, HasSubstr("hitAttributeEXT uint g_attributes[5];"));
  EXPECT_THAT(text, HasSubstr("g_attributes[1] = floatBitsToUint(value.m_uv.y);"));
}

TEST(Spirv, ManyThreadsCompileAtOnce) {
  Compilation compilation(kScene);
  const SpirvLibrary alone = compile_spirv(*compilation.module);
  ASSERT_EQ(alone.error.message(), "");
  std::vector<SpirvLibrary> results(6);
  std::vector<std::thread> threads;
  for (SpirvLibrary& result : results) {
    threads.emplace_back([&] { result = compile_spirv(*compilation.module); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const SpirvLibrary& result : results) EXPECT_EQ(result.modules, alone.modules);
}

// DXC rejects it; the native code accepts it.
TEST(EmitGlsl, GroupsharedMemoryOfRayTracingIsPrivate) {
  const std::string text = glsl_of(
      "RWByteAddressBuffer results : register(u0);\ngroupshared uint n[2];\n"
      "[shader(\"raygeneration\")] void Shoot() {\n  uint old, i = results.Load(0);\n"
      "  InterlockedAdd(n[i], 3, old);\n  results.Store(4, old);\n}\n",
      "Shoot");
  EXPECT_THAT(text, Not(HasSubstr("shared ")));
}

TEST(EmitGlsl, AShaderAsksForNoCapabilityThatItDoesNotUse) {
  Compilation compilation(kernel("results.Store(0, 1);"));
  const SpirvModule spirv =
      compile_spirv(emit_glsl(*compilation.module, compilation.module->entry_points[0]), "main");
  ASSERT_EQ(spirv.error.message(), "");
  for (size_t i = 5; i < spirv.words.size(); i += spirv.words[i] >> 16) {
    if ((spirv.words[i] & 0xFFFFu) != 17) break;  // OpCapability
    const uint32_t capability = spirv.words[i + 1];
    EXPECT_TRUE(capability == 1 /* Shader */ || capability == 11 /* Int64 */ ||
                capability == 4466 /* SignedZeroInfNanPreserve */ ||
                capability == 5347 /* PhysicalStorageBufferAddresses */)
        << capability;
  }
}

TEST(Spirv, ConstantsHaveTheNumbersOfTheInterface) {
  Compilation compilation(kernel("results.Store(0, 1);"));
  const GlslShader shader = emit_glsl(*compilation.module, compilation.module->entry_points[0]);
  ASSERT_EQ(shader.constants, (std::vector<uint32_t>{0, 1, 2, 3}));
  GlslShader changed = shader;
  changed.constants = {0xFFFF0000u, 400000, 400001, 400002};
  const SpirvModule spirv = compile_spirv(changed, "main");
  std::vector<uint32_t> found;
  for (size_t i = 5; i < spirv.words.size(); i += spirv.words[i] >> 16) {
    if ((spirv.words[i] & 0xFFFFu) == 71 && spirv.words[i + 2] == 1) {  // OpDecorate SpecId
      found.push_back(spirv.words[i + 3]);
    }
  }
  EXPECT_EQ(found, changed.constants);
}

TEST(Spirv, BindingsThatAreTooManyAreAnErrorOfTheSource) {
  std::string globals;
  std::string body;
  for (int i = 0; i < 512; ++i) {
    const std::string n = std::to_string(i);
    globals += "RWByteAddressBuffer b" + n + " : register(u" + n + ", space1);\n";
    body += "b" + n + ".Store(0, " + n + ");\n";
  }
  const SpirvLibrary library = compile_spirv(*Compilation(kernel(body, globals)).module);
  EXPECT_THAT(library.error.message(), HasSubstr("KA2761 'main' reaches 512 bindings"));
}

TEST(Spirv, AFailureNamesTheExport) {
  GlslShader broken;
  broken.text = "#version 460\nvoid main() { nonsense(); }\n";
  broken.stage = ir::kStageCompute;
  const SpirvModule spirv = compile_spirv(broken, "MyKernel");
  EXPECT_TRUE(spirv.words.empty());
  EXPECT_THAT(spirv.error.message(), HasSubstr("KA2760"));
  EXPECT_THAT(spirv.error.message(), HasSubstr("'MyKernel'"));
}

}  // namespace
}  // namespace kaamos::hlsl
