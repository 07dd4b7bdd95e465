// SPDX-License-Identifier: MIT
//
// Coverage of shaders, interpreted, as native code and on Vulkan: the same lines and branches.
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "runtime/coverage/tracefile.h"
#include "tests/shaders/session.h"
#include "tests/vulkan/support.h"

namespace kaamos::shader_tests {
namespace {

namespace fs = std::filesystem;
using coverage::FileCoverage;
using coverage::Tracefile;

constexpr char kMark[] = "//= ";
const std::string kMain = KAAMOS_TESTDATA "/coverage.hlsl";
const std::string kPart = KAAMOS_TESTDATA "/coverage_part.hlsli";

// Where the branch of a line stands for which a mark has this before its bracket: the operator ?, &
// or |, else the first keyword.
size_t branch_of(const std::string& text, char kind) {
  if (kind == '?') return text.find(" ? ") + 1;
  if (kind == '&') return text.find("&&");
  if (kind == '|') return text.find("||");
  size_t keyword = std::string::npos;
  for (const char* word : {"if (", "for (", "while (", "do {", "switch ("}) {
    keyword = std::min(keyword, text.find(word));
  }
  return keyword;
}

// What the marks of a file say, for so many runs.
FileCoverage marked(const std::string& path, uint64_t runs) {
  FileCoverage out;
  std::ifstream in(path);
  std::string text;
  for (uint32_t line = 1; std::getline(in, text); ++line) {
    const size_t mark = text.find(kMark);
    if (mark == std::string::npos || text.starts_with("//")) continue;
    const std::string counts = text.substr(mark + sizeof(kMark) - 1);
    out.lines[line] = runs * static_cast<uint64_t>(counts[0] - '0');
    for (size_t open = counts.find('['); open != std::string::npos;
         open = counts.find('[', open + 1)) {
      const auto column = static_cast<uint32_t>(branch_of(text, counts[open - 1])) + 1;
      uint32_t arm = 0;
      for (size_t i = open + 1; counts[i] != ']'; ++i) {
        if (counts[i] == ' ') continue;
        out.arms[{line, column, arm++}] =
            counts[i] == '-' ? 0 : runs * static_cast<uint64_t>(counts[i] - '0');
      }
    }
  }
  return out;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Tracefile parse(const fs::path& path) {
  size_t line = 0;
  auto out = coverage::parse_tracefile(text_of(path), line);
  EXPECT_TRUE(out) << path << ":" << line;
  return out.value_or(Tracefile());
}

class CoverageOn : public testing::TestWithParam<std::string> {
 protected:
  CoverageOn() {
    std::string name = fs::temp_directory_path() / "kaamos-coverage-XXXXXX";
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "shaders.info";
    setenv("KAAMOS_COVERAGE", path_.c_str(), 1);
  }
  ~CoverageOn() override {
    unsetenv("KAAMOS_COVERAGE");
    fs::remove_all(folder_);
  }

  // Returns whether there is such a device. Each file is run in a process of its own.
  bool run(const std::string& filter = {}) {
    const Source source = read_source({kMain});
    EXPECT_EQ(source.error, "");
    std::vector<const TestRun*> runs;
    for (const TestRun& test : source.tests.runs) {
      if (filter.empty() || test.name == filter) runs.push_back(&test);
    }
    const SessionResult session = run_tests(source, runs, GetParam(), 100);
    const bool may_lack_device = GetParam() == "vulkan" && !test::vulkan_is_required();
    if (session.has_no_device && may_lack_device) return false;
    EXPECT_EQ(session.error, "");
    for (const TestResult& result : session.results) {
      for (const std::string& failure : result.failures) ADD_FAILURE() << failure;
    }
    return true;
  }

  static std::string expected(uint64_t runs) {
    return coverage::to_text({{kMain, marked(kMain, runs)}, {kPart, marked(kPart, runs)}});
  }

  fs::path folder_;
  fs::path path_;
};

TEST_P(CoverageOn, LinesAndBranchesAreExact) {
  if (!run()) GTEST_SKIP() << "no Vulkan device";
  EXPECT_EQ(text_of(path_), expected(1));
}

TEST_P(CoverageOn, RunsAddUp) {
  if (!run("Classifies")) GTEST_SKIP() << "no Vulkan device";
  const auto line_of = [](const std::string& text) {
    const std::string all = text_of(kMain);
    return static_cast<uint32_t>(
        std::count(all.begin(), all.begin() + static_cast<ptrdiff_t>(all.find(text)), '\n') + 1);
  };
  const uint32_t shared = line_of("[test] void Classifies");
  const uint32_t miss = line_of("[shader(\"miss\")]");
  EXPECT_EQ(parse(path_)[kMain].lines[shared], 1u);
  EXPECT_EQ(parse(path_)[kMain].lines[miss], 0u);
  run();
  EXPECT_EQ(parse(path_)[kMain].lines[shared], 2u);
  EXPECT_EQ(parse(path_)[kMain].lines[miss], 1u);
}

TEST_P(CoverageOn, ProcessesAtATimeLoseNothing) {
  constexpr uint64_t kProcesses = 3;
  std::vector<pid_t> children;
  for (uint64_t i = 0; i < kProcesses; ++i) {
    const pid_t child = fork();
    if (child == 0) _exit(run() ? HasFailure() : 77);
    children.push_back(child);
  }
  bool has_device = true;
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    has_device = has_device && WEXITSTATUS(status) != 77;
    EXPECT_TRUE(!has_device || status == 0);
  }
  if (!has_device) GTEST_SKIP() << "no Vulkan device";
  EXPECT_EQ(text_of(path_), expected(kProcesses));
}

// Vertex, geometry and pixel shaders, and all of ray tracing.
TEST_P(CoverageOn, EveryStageIsCovered) {
  const std::string executor = GetParam() == "interpreter" ? "interpreted"
                               : GetParam() == "embree"    ? "native"
                                                           : "vulkan";
  const std::string command =
      std::string(KAAMOS_PRINTING_TEST) + " --gtest_filter='*/" + executor + "' > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const bool may_lack_device = GetParam() == "vulkan" && !test::vulkan_is_required();
  if (may_lack_device && !fs::exists(path_)) GTEST_SKIP() << "no Vulkan device";
  const Tracefile all = parse(path_);
  ASSERT_EQ(all.size(), 1u);
  const FileCoverage& file = all.begin()->second;
  EXPECT_EQ(file.lines.size(), 55u);
  for (const auto& [line, runs] : file.lines) EXPECT_EQ(runs, 1u) << "printing.hlsl:" << line;
}

// An ordinary program, whose shaders were compiled without coverage when it was built.
TEST_P(CoverageOn, ProgramsNeedNoChange) {
  if (GetParam() == "interpreter") GTEST_SKIP() << "programs run native code or Vulkan";
  const std::string command = std::string(KAAMOS_EXAMPLE) + " --unchecked --size 16x16 --backend " +
                              GetParam() + " --out " + (folder_ / "a.png").string() +
                              " > /dev/null 2>&1";
  const bool ran = std::system(command.c_str()) == 0;
  if (!ran && GetParam() == "vulkan" && !test::vulkan_is_required()) GTEST_SKIP();
  ASSERT_TRUE(ran) << command;
  const Tracefile all = parse(path_);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all.begin()->first.ends_with("/examples/01-triangle/triangle.hlsl"));
  const FileCoverage& file = all.begin()->second;
  EXPECT_EQ(file.lines.size(), 17u);
  EXPECT_TRUE(std::ranges::all_of(file.lines, [](const auto& one) { return one.second == 1; }));
}

// What a device says when the library is made a pipeline of, in a process of its own.
std::string messages_of(const std::string& tracefile, bool with_source, bool with_compiler = true) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    rtapi::ShaderCompileOptions options;
    options.File = "kernel.hlsl";
    options.Source = "[numthreads(1, 1, 1)] [shader(\"compute\")] void Kernel() {}";
    options.EmbedSource = with_source;
    options.Interpret = with_compiler;
    options.Spirv = false;
    const rtapi::ShaderLibrary library = rtapi::CompileShaderLibrary(options).Library;
    if (!with_compiler) setenv("KAAMOS_CXX", "no-such-compiler", 1);
    setenv("KAAMOS_COVERAGE", tracefile.c_str(), 1);
    std::string said;
    rtapi::DeviceDesc desc;
    desc.OnMessage = [&](const rtapi::Message& message) { said += message.Text + "\n"; };
    const rtapi::Device device = rtapi::CreateDevice(desc).value();
    rtapi::ComputePipelineStateDesc pipeline;
    pipeline.CS = library;
    pipeline.pRootSignature = device.CreateRootSignature("").value();
    if (!device.CreateComputePipelineState(pipeline).ok()) said += "no pipeline\n";
    const bool is_told =
        write(ends[1], said.data(), said.size()) == static_cast<ssize_t>(said.size());
    _exit(is_told ? 0 : 1);
  }
  close(ends[1]);
  std::string out(4096, '\0');
  const ssize_t bytes = read(ends[0], out.data(), out.size());
  out.resize(bytes < 0 ? 0 : static_cast<size_t>(bytes));
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return out;
}

TEST(Coverage, WhatCannotBeCollectedOrWrittenIsTold) {
  std::string folder = fs::temp_directory_path() / "kaamos-coverage-XXXXXX";
  folder = mkdtemp(folder.data());
  EXPECT_EQ(messages_of(folder + "/a.info", true), "");
  EXPECT_EQ(
      messages_of(folder + "/a.info", false),
      "KA2754 library without coverage: \"kernel.hlsl\": it carries no source (-no-source)\n");
  EXPECT_EQ(messages_of(folder + "/no/a.info", true),
            "KA2755 coverage cannot be written: \"" + folder +
                "/no/a.info\" of $KAAMOS_COVERAGE: its folder cannot be opened: No such file or "
                "directory\n");
  const std::string slow = messages_of(folder + "/a.info", true, false);
  EXPECT_EQ(slow.find("KA2756 code with coverage is interpreted: \"kernel.hlsl\", and what else "),
            0u)
      << slow;
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(All, CoverageOn, testing::Values("interpreter", "embree", "vulkan"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace kaamos::shader_tests
