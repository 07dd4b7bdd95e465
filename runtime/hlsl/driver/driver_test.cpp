// SPDX-License-Identifier: MIT
// kaamos-hlsl as called from a shell: its exit status, what it prints and what it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr char kLibrary[] = R"(#include "numbers.hlsli"
RWByteAddressBuffer results;
uint helper(uint x) { return x * NUMBER; }
uint other(uint x) { return x + NUMBER; }
[shader("raygeneration")]
void Main() {
  results.Store(0, helper(2));
}
)";
constexpr char kKernel[] = R"(RWByteAddressBuffer results : register(u0);
[numthreads(4, 2, 1)]
void kernel(uint i : SV_GroupIndex) { results.Store(4 * i, i); }
)";

struct Outcome {
  int status = -1;
  std::string out;
  std::string error;
};

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class Driver : public testing::Test {
 protected:
  Driver() {
    std::string name = (fs::temp_directory_path() / "kaamos-driver-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    write("main.hlsl", kLibrary);
    write("numbers.hlsli", "#define NUMBER 7\n");
    write("kernel.hlsl", kKernel);
  }
  ~Driver() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string text_of(const std::string& name) const { return read(folder_ / name); }

  // Runs in the folder; `arguments` are words for the shell.
  Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && '" KAAMOS_HLSL "' " + arguments +
                                " >out.txt 2>error.txt </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of("out.txt"), text_of("error.txt")};
  }

  fs::path folder_;
};

TEST_F(Driver, WrongCommandLines) {
  const struct {
    const char* arguments;
    const char* message;
  } cases[] = {
      {"", "kaamos-hlsl: no source file given; -help lists the options\n"},
      {"-foo main.hlsl", "kaamos-hlsl: unknown option \"-foo\"; -help lists the options\n"},
      {"main.hlsl kernel.hlsl",
       "kaamos-hlsl: two source files, \"main.hlsl\" and \"kernel.hlsl\": give one\n"},
      {"main.hlsl -T", "kaamos-hlsl: -T needs a value after it; -help lists the options\n"},
      {"-HV 2017 main.hlsl", "kaamos-hlsl: -HV 2017: the value must be 2018 or 2021\n"},
      {"-emit exe main.hlsl",
       "kaamos-hlsl: -emit exe: the value must be cpp, source, ir, reflection, object, glsl or "
       "spirv\n"},
      {"-default-linkage none main.hlsl",
       "kaamos-hlsl: -default-linkage none: the value must be external or internal\n"},
      {"-auto-binding-space 1x main.hlsl",
       "kaamos-hlsl: -auto-binding-space 1x: the value must be a whole number\n"},
      {"--entry-function 1a main.hlsl",
       "kaamos-hlsl: --entry-function 1a: the value must be a C identifier\n"},
      {"-emit object main.hlsl", "kaamos-hlsl: -emit object needs a file name: give it with -Fo\n"},
      {"-MF rule main.hlsl", "kaamos-hlsl: -MF needs the name of the output: give it with -Fo\n"},
  };
  for (const auto& one : cases) {
    const Outcome outcome = run(one.arguments);
    EXPECT_EQ(outcome.status, 2) << one.arguments;
    EXPECT_EQ(outcome.error, one.message);
    EXPECT_THAT(outcome.out, IsEmpty());
  }
}

TEST_F(Driver, HelpNamesEveryOption) {
  const Outcome outcome = run("-help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* option : {"-T ", "-E ", "-D ", "-I ", "-HV ", "-exports ", "-default-linkage ",
                             "-auto-binding-space ", "-enable-16bit-types", "-Zpr, -Zpc", "-WX",
                             "-Zi", "-Fo ", "-check", "-emit ", "--strict", "-MF "}) {
    EXPECT_THAT(outcome.out, HasSubstr(option));
  }
}

TEST_F(Driver, MissingFile) {
  const Outcome outcome = run("nowhere.hlsl");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.error,
            "error: cannot open 'nowhere.hlsl': there is no such file [KA2001]\n1 error\n");
}

TEST_F(Driver, ErrorsHavePlaceLineAndCaret) {
  write("wrong.hlsl", "#include \"broken.hlsli\"\n");
  write("broken.hlsli", "static const int a = 1;\nstatic const int b = c;\n");
  const Outcome outcome = run("-check wrong.hlsl");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("broken.hlsli:2:22: error: "),
                                   HasSubstr("static const int b = c;\n                     ^"),
                                   HasSubstr("wrong.hlsl:1"), HasSubstr("1 error")));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST_F(Driver, UnwritableOutput) {
  for (const char* emit : {"cpp", "ir", "reflection"}) {
    const Outcome outcome = run(std::string("-no-warnings -o nowhere/x main.hlsl -emit ") + emit);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.error, "kaamos-hlsl: cannot write nowhere/x: No such file or directory\n");
  }
  const Outcome rule = run("-no-warnings -o x.cpp -MF nowhere/rule main.hlsl");
  EXPECT_EQ(rule.status, 1);
  EXPECT_EQ(rule.error, "kaamos-hlsl: cannot write nowhere/rule: No such file or directory\n");
  fs::create_directory(folder_ / "taken");
  EXPECT_EQ(run("-no-warnings -o taken main.hlsl").error,
            "kaamos-hlsl: cannot write taken: Is a directory\n");
  EXPECT_TRUE(fs::is_empty(folder_ / "taken"));
}

// The output may be /dev/null, and the user root; a pipe does no harm if this fails.
TEST_F(Driver, OutputIsWrittenToPipesAndThroughLinks) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const char* emit : {"cpp", "reflection", "object"}) {
    const std::string options = std::string("-no-warnings main.hlsl -emit ") + emit;
    EXPECT_EQ(std::system(("cat '" + (folder_ / "pipe").string() + "' >/dev/null &").c_str()), 0);
    EXPECT_EQ(run(options + " -o pipe").status, 0);
    EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
  }
  fs::create_symlink("target", folder_ / "link");
  EXPECT_EQ(run("-no-warnings -o link main.hlsl -emit ir").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_GT(fs::file_size(folder_ / "target"), 0u);
  EXPECT_EQ(run("-no-warnings -o /dev/stdout main.hlsl -emit ir").out,
            run("-no-warnings main.hlsl -emit ir").out);
}

TEST_F(Driver, CheckWritesNothing) {
  const Outcome outcome = run("-check -o x.cpp main.hlsl");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_FALSE(fs::exists(folder_ / "x.cpp"));
}

TEST_F(Driver, EmitsEachForm) {
  const Outcome ir = run("-emit ir main.hlsl");
  EXPECT_EQ(ir.status, 0);
  EXPECT_THAT(ir.out, AllOf(StartsWith("module main.hlsl lib_6_6\n"), HasSubstr("helper")));
  const Outcome glsl = run("-emit glsl main.hlsl");
  EXPECT_THAT(glsl.out, HasSubstr("#version 460"));
  EXPECT_THAT(glsl.out, HasSubstr("void f_Main()"));
  EXPECT_EQ(run("-emit spirv -o main.spv main.hlsl").status, 0);
  EXPECT_THAT(read(folder_ / "main.spv"), StartsWith("\x03\x02\x23\x07"));
  EXPECT_THAT(run("main.hlsl").out, HasSubstr("spirv_0"));
  EXPECT_THAT(run("-no-spirv main.hlsl").out, Not(HasSubstr("spirv_0")));
  EXPECT_THAT(run("-emit cpp main.hlsl").out, Not(HasSubstr("spirv_0")));
  EXPECT_THAT(run("-spirv -emit cpp main.hlsl").out, HasSubstr("spirv_0"));
  const Outcome reflection = run("-emit reflection main.hlsl");
  EXPECT_EQ(reflection.status, 0);
  EXPECT_THAT(reflection.out,
              AllOf(StartsWith("{"), HasSubstr("\"name\": \"Main\""), HasSubstr("\"results\"")));
  const Outcome cpp = run("main.hlsl --entry-function my_table");
  EXPECT_EQ(cpp.status, 0);
  EXPECT_THAT(cpp.out,
              AllOf(HasSubstr("#include <kaamos/shader/prelude.h>"), HasSubstr("my_table")));
  EXPECT_EQ(run("-o x.cpp main.hlsl --entry-function my_table").status, 0);
  EXPECT_EQ(text_of("x.cpp"), cpp.out);
}

TEST_F(Driver, EmitsTheSourceAlone) {
  const Outcome source = run("-emit source --entry-function my_table main.hlsl");
  EXPECT_EQ(source.status, 0);
  EXPECT_THAT(source.out, AllOf(HasSubstr("kLibrarySource"), HasSubstr("my_table"),
                                HasSubstr("helper(2)"), HasSubstr("#define NUMBER 7")));
  EXPECT_THAT(source.out, Not(HasSubstr("prelude.h")));
  for (const std::string other :
       {"-no-source", "-check-access", "-Zi", "-no-wide", "-spirv", "-no-spirv"}) {
    const Outcome refused = run("-emit source " + other + " main.hlsl");
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.error, HasSubstr("does not go with " + other));
  }
}

// Milliseconds of processor time, the least of a few runs, since other processes share the machine.
double least_ms(const std::function<void()>& run) {
  const auto used = [] {
    rusage children = {};
    getrusage(RUSAGE_CHILDREN, &children);
    const auto ms = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
    };
    return ms(children.ru_utime) + ms(children.ru_stime);
  };
  double least = 1e9;
  for (int i = 0; i < 5; ++i) {
    const double before = used();
    run();
    least = std::min(least, used() - before);
  }
  return least;
}

// SPIR-V takes many times longer than C++, because glslang reads its built-in declarations for each
// shader. The time of the shell that starts the program is left out.
TEST_F(Driver, WhoAsksForNoSpirvDoesNotPayForIt) {
  const double shell = least_ms([] { EXPECT_EQ(std::system("/bin/true </dev/null"), 0); });
  const double start = least_ms([&] { run("--version"); }) - shell;
  const double cpp = least_ms([&] { run("-emit cpp main.hlsl"); }) - shell;
  const double spirv = least_ms([&] { run("-spirv -emit cpp main.hlsl"); }) - shell;
  EXPECT_LT(start, 4 * 5);
  EXPECT_LT(cpp, 4 * 40);
  EXPECT_LT(cpp, spirv / 2);
}

TEST_F(Driver, DependencyFileNamesEveryInput) {
  EXPECT_EQ(run("-o 'x y.cpp' -MF rule main.hlsl").status, 0);
  const std::string rule = text_of("rule");
  EXPECT_THAT(rule, AllOf(HasSubstr("main.hlsl"), HasSubstr("numbers.hlsli")));
}

TEST_F(Driver, DefinesAndIncludeFolders) {
  fs::create_directory(folder_ / "inc");
  write("inc/deep.hlsli", "static const uint kDeep = DEPTH;\n");
  write("uses.hlsl", "#include <deep.hlsli>\n" + std::string(kKernel));
  EXPECT_EQ(run("-check -T cs_6_0 -E kernel uses.hlsl").status, 1);
  EXPECT_EQ(run("-check -T cs_6_0 -E kernel -I inc uses.hlsl").status, 1);
  EXPECT_EQ(run("-check -T cs_6_0 -E kernel -Iinc -D DEPTH=3 uses.hlsl").status, 0);
  EXPECT_EQ(run("-check -T cs_6_0 -E kernel -I inc -DDEPTH=3 uses.hlsl").status, 0);
}

TEST_F(Driver, Exports) {
  const std::string reflect = "-emit reflection main.hlsl ";
  EXPECT_THAT(run(reflect).out, Not(HasSubstr("\"name\": \"helper\"")));
  EXPECT_THAT(run(reflect + "-default-linkage external").out,
              AllOf(HasSubstr("\"name\": \"helper\""), HasSubstr("\"name\": \"other\""),
                    HasSubstr("\"name\": \"Main\"")));
  EXPECT_THAT(run(reflect + "-exports 'A,B=Main;helper'").out,
              AllOf(HasSubstr("\"name\": \"A\""), HasSubstr("\"name\": \"B\""),
                    HasSubstr("\"name\": \"helper\""), Not(HasSubstr("\"name\": \"Main\""))));
  const Outcome unknown = run(reflect + "-exports nobody");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_EQ(unknown.error,
            "error: cannot export 'nobody': there is no such function [KA2577]\n"
            "1 error\n");
  EXPECT_EQ(run(reflect + "-exports '=Main'").status, 1);
}

TEST_F(Driver, AutomaticBindingSpace) {
  EXPECT_THAT(run("-emit ir main.hlsl").out, HasSubstr("binding results RWByteAddressBuffer u0 "
                                                       "space0"));
  EXPECT_THAT(run("-emit ir -auto-binding-space 9 main.hlsl").out,
              HasSubstr("binding results RWByteAddressBuffer u0 space9"));
}

TEST_F(Driver, ComputeTargets) {
  const Outcome kernel = run("-T cs_6_0 -E kernel -emit reflection kernel.hlsl");
  EXPECT_EQ(kernel.status, 0) << kernel.error;
  EXPECT_THAT(kernel.out, HasSubstr("\"name\": \"kernel\""));
  EXPECT_EQ(run("-T cs_6_0 -E nobody kernel.hlsl").error,
            "error: entry point 'nobody' not found [KA2562]\n1 error\n");
  const Outcome pixel = run("-T hs_6_0 kernel.hlsl");
  EXPECT_EQ(pixel.status, 1);
  EXPECT_THAT(pixel.error, HasSubstr("unknown target 'hs_6_0'"));
}

TEST_F(Driver, GraphicsTargets) {
  write("draw.hlsl",
        "struct V { float4 at : SV_Position; nointerpolation int id : ID2;\n"
        "  noperspective centroid float edge : EDGE; };\n"
        "V vs(float2 p : POSITION) { V v = {p, 0, 1, 7, 1}; return v; }\n"
        "float ps(V v) : SV_Target3 { return v.id; }\n");
  const Outcome vertex = run("-T vs_6_0 -E vs -emit reflection -no-warnings draw.hlsl");
  EXPECT_EQ(vertex.status, 0) << vertex.error;
  EXPECT_THAT(vertex.out, HasSubstr("\"stage\": \"vertex\""));
  EXPECT_THAT(vertex.out, HasSubstr("\"semantic\": \"POSITION\""));
  const Outcome pixel = run("-T ps_6_0 -E ps -emit reflection -no-warnings draw.hlsl");
  EXPECT_EQ(pixel.status, 0) << pixel.error;
  EXPECT_THAT(pixel.out, HasSubstr("\"index\": 2"));
  EXPECT_THAT(pixel.out, HasSubstr("\"interpolation\": \"nointerpolation\""));
  EXPECT_THAT(pixel.out, HasSubstr("\"interpolation\": \"noperspective centroid\""));
  EXPECT_THAT(run("-T ps_6_0 -E ps -emit glsl -no-warnings draw.hlsl").out,
              HasSubstr("layout(location = 1) flat in int"));
  EXPECT_THAT(run("-T ps_6_0 -E ps -no-warnings draw.hlsl").out, HasSubstr("spirv_0"));
}

TEST_F(Driver, WarningsAsErrors) {
  write("warns.hlsl",
        "RWByteAddressBuffer results;\n[shader(\"raygeneration\")]\nvoid Main() {\n"
        "  float4 a = results.Load(0);\n  float3 b = a;\n  results.Store(0, asuint(b.x));\n}\n");
  const Outcome plain = run("-check warns.hlsl");
  EXPECT_EQ(plain.status, 0);
  EXPECT_THAT(plain.error, AllOf(HasSubstr("warns.hlsl:5:14: warning: "), HasSubstr("1 warning")));
  EXPECT_THAT(run("-check -no-warnings warns.hlsl").error, IsEmpty());
  const Outcome strict = run("-WX -o x.cpp warns.hlsl");
  EXPECT_EQ(strict.status, 1);
  EXPECT_THAT(strict.error, HasSubstr("kaamos-hlsl: warnings are errors [-WX]\n"));
  EXPECT_FALSE(fs::exists(folder_ / "x.cpp"));
  EXPECT_EQ(run("-WX -check main.hlsl").status, 0);
  // Ignored attributes for SPIR-V are no reason to fail, because DXC says nothing about them.
  write("vk.hlsl",
        "[[vk::binding(1)]] RWByteAddressBuffer results;\n[shader(\"raygeneration\")]\n"
        "void Main() { results.Store(0, 1); }\n");
  EXPECT_THAT(run("-check vk.hlsl").error, HasSubstr("[[vk::binding]] is ignored: the register"));
  EXPECT_EQ(run("-WX -check vk.hlsl").status, 0);
}

}  // namespace
