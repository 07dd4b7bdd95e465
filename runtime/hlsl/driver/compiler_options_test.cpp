// SPDX-License-Identifier: MIT
// Shaders compiled at run time are compiled like those that are built with a program.
#include "runtime/hlsl/driver/compiler_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "runtime/hlsl/driver/host_compiler.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

void remove_all_of(std::vector<std::string>& words, const std::vector<std::string>& unwanted) {
  std::erase_if(words, [&](const std::string& word) {
    return std::find(unwanted.begin(), unwanted.end(), word) != unwanted.end();
  });
}

// The options of a shader library of this build, without what only a program with two versions of
// each library needs, and those of run time without what makes a shared object.
void expect_same(const std::string& build, shader::CpuLevel level) {
  std::vector<std::string> at_build = words_of(build);
  remove_all_of(at_build, {"-fno-weak"});
  std::vector<std::string> at_run_time =
      compiler_options(Optimisation::kFull, OptionSet::kGnu, level);
  remove_all_of(at_run_time, {"-std=c++20", "-fPIC", "-shared", "-fvisibility=hidden"});
  // A build for debugging has the level of its configuration.
  if (!KAAMOS_BUILD_OPTIMISES) {
    std::erase_if(at_run_time, [](const std::string& word) { return word.starts_with("-O"); });
  }
  EXPECT_THAT(at_run_time, ElementsAreArray(at_build));
}

TEST(CompilerOptions, AtRunTimeAreThoseOfTheBuild) {
  expect_same(KAAMOS_BUILD_OPTIONS, shader::CpuLevel::kBaseline);
}

TEST(CompilerOptions, AtRunTimeAreThoseOfTheBuildForAvx2) {
  if (std::string(KAAMOS_BUILD_AVX2_OPTIONS).empty()) {
    GTEST_SKIP() << "this build compiles no shaders for AVX2 (KAAMOS_SHADER_AVX2)";
  }
  expect_same(KAAMOS_BUILD_AVX2_OPTIONS, shader::CpuLevel::kAvx2);
}

// A compiler that notes its arguments, and refuses those of g++ 12 on request.
class CompilerCalls : public testing::Test {
 protected:
  CompilerCalls() {
    std::string name = (fs::temp_directory_path() / "kaamos-options-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    EXPECT_TRUE(compiler_) << compiler_.error();
  }
  ~CompilerCalls() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  SharedObject build_with(const fs::path& program) {
    HostCompiler compiler = *compiler_;
    compiler.program = program;
    return build_shared_object(compiler, "int kaamos_one() { return 1; }\n", Optimisation::kFull,
                               folder_ / "cache");
  }
  fs::path recorder(const std::string& first) const {
    const fs::path script = folder_ / "c++";
    std::ofstream(script) << "#!/bin/sh\necho \"$@\" >> '" << (folder_ / "calls").string() << "'\n"
                          << first << "exec '" << compiler_->program.string() << "' \"$@\"\n";
    fs::permissions(script, fs::perms::owner_all);
    return script;
  }
  std::vector<std::string> calls() const {
    std::ifstream file(folder_ / "calls");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  fs::path folder_;
  const Result<HostCompiler> compiler_ = find_host_compiler();
};

TEST_F(CompilerCalls, HaveTheseOptions) {
  const SharedObject object = build_with(recorder(""));
  ASSERT_EQ(object.error.message(), "");
  ASSERT_FALSE(calls().empty());
  std::vector<std::string> given = words_of(calls().front());
  const auto options = compiler_options(Optimisation::kFull, OptionSet::kGnu);
  ASSERT_GT(given.size(), options.size());
  given.resize(options.size());  // behind them are the headers, the source and the object
  EXPECT_THAT(given, ElementsAreArray(options));
}

TEST_F(CompilerCalls, AreRepeatedWithoutWhatTheCompilerDoesNotKnow) {
  if (shader::cpu_level() != shader::CpuLevel::kAvx2) GTEST_SKIP() << "no AVX2 on this processor";
  const SharedObject object = build_with(
      recorder("case \"$*\" in *-mmove-max*) echo 'error: unknown argument' >&2; exit 1;; esac\n"));
  EXPECT_EQ(object.error.message(), "");
  ASSERT_EQ(calls().size(), 2u);
  EXPECT_THAT(calls()[0], HasSubstr(" -mmove-max=256 -mstore-max=256 "));
  EXPECT_THAT(calls()[1], Not(HasSubstr("-max=256")));
  EXPECT_THAT(calls()[1], HasSubstr(" -mavx2 "));
}

TEST_F(CompilerCalls, CanGoToClang) {
  const auto clang = find_host_compiler("clang++");
  if (!clang) GTEST_SKIP() << "clang++ is not installed";
  const SharedObject object = build_with(clang->program);
  EXPECT_EQ(object.error.message(), "");
}

}  // namespace
}  // namespace kaamos::hlsl
