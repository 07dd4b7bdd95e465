// SPDX-License-Identifier: MIT
//
// Every .hlsl file in core, compute, extended and traps is a test for each executor: it is compiled
// like a user's shader and run on a device, and `results` must hold what its EXPECT comments say.
// For native code, a batch of files becomes one shared object, because starting the C++ compiler
// costs more than compiling a small shader. Checked executors run a sample of the files, or all
// with KAAMOS_FULL=1: they must give the same results, and no messages except those that BREAKS
// names.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>
#include <rtapi/rtapi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <utility>

#include "executors.h"
#include "expectations.h"
#include "fixtures.h"
#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/host_compiler.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

constexpr size_t kBatch = 16;

const std::vector<HlslTest>& all_tests() {
  static const std::vector<HlslTest> tests = find_hlsl_tests(
      std::string(KAAMOS_SOURCE_DIR) + "/tests/hlsl", {"core", "compute", "extended", "traps"});
  return tests;
}

std::string unit_name(size_t index, bool checked) {
  return std::string("kaamos_test_unit_") + (checked ? "checked_" : "") + std::to_string(index);
}

hlsl::FrontendOptions options_of(const HlslTest& test, bool checked) {
  hlsl::FrontendOptions options;
  options.path = test.path;
  options.check_access = checked;
  options.include_folders = {std::string(KAAMOS_SOURCE_DIR) + "/tests/hlsl"};
  for (size_t i = 0; i < test.options.size(); ++i) {
    const std::string& word = test.options[i];
    const bool last = i + 1 == test.options.size();
    if (word == "-enable-16bit-types") options.native_16bit = true;
    if (word == "-enable-experimental") options.experimental = true;
    if (word == "-disable-payload-qualifiers") options.payload_qualifiers = false;
    if (word == "-Zpr") options.row_major = true;
    if (word == "-HV" && !last)
      options.hlsl_version = static_cast<uint32_t>(std::stoul(test.options[++i]));
    if (word == "-D" && !last) options.defines.push_back(test.options[++i]);
    if (word == "-T" && !last) options.target = test.options[++i];
  }
  return options;
}

// The emitted C++ of a file.
hlsl::Result<std::string> emit(size_t index, bool checked, hlsl::WideThreads wide) {
  const auto module = compile_module(options_of(all_tests()[index], checked));
  if (!module) return hlsl::Failure{module.error()};
  return hlsl::emit_cpp(**module, {.entry_point = unit_name(index, checked), .wide = wide});
}

// Tells whether a file is in the sample that checked executors run.
bool in_checked_sample(size_t index) {
  const char* full = std::getenv("KAAMOS_FULL");
  return (full != nullptr && *full == '1') || index % 12 == 0;
}

std::map<size_t, Compiled> compile_batch(size_t batch, bool checked, hlsl::WideThreads wide) {
  std::map<size_t, Compiled> out;
  std::string source;
  const size_t end = std::min(all_tests().size(), (batch + 1) * kBatch);
  for (size_t i = batch * kBatch; i < end; ++i) {
    if (checked && !in_checked_sample(i)) continue;
    const auto emitted = emit(i, checked, wide);
    out[i].error = emitted.error();
    if (emitted) source += *emitted;
  }
  const auto compiler = hlsl::find_host_compiler();
  std::string error = compiler.error();
  hlsl::SharedObject object;
  if (compiler) {
    object = hlsl::build_shared_object(*compiler, source, hlsl::Optimisation::kFull,
                                       std::string(KAAMOS_BINARY_DIR) + "/shader-cache");
    error = object.error.message();
  }
  void* handle = error.empty() ? dlopen(object.path.c_str(), RTLD_NOW | RTLD_LOCAL) : nullptr;
  for (auto& [index, compiled] : out) {
    if (!compiled.error.empty()) continue;
    void* entry = handle != nullptr ? dlsym(handle, unit_name(index, checked).c_str()) : nullptr;
    if (entry == nullptr) {
      compiled.error = error.empty() ? "the shared object lacks its entry" : error;
    } else {
      compiled.library = reinterpret_cast<shader::LibraryEntryPointFn>(entry)();
    }
  }
  return out;
}

template <hlsl::WideThreads kWide>
Compiled compile_native(size_t index, bool checked) {
  static std::map<std::pair<size_t, bool>, std::map<size_t, Compiled>> batches;
  const std::pair batch(index / kBatch, checked);
  if (batches.count(batch) == 0) batches[batch] = compile_batch(batch.first, checked, kWide);
  return batches[batch][index];
}

// A way to run HLSL. A test's name is its name followed by the file's.
struct Executor {
  const char* name;
  const char* backend;
  Compiled (*compile)(size_t index, bool checked);
  bool checked = false;
};
Compiled interpreted(size_t index, bool checked) {
  return compile_interpreted(options_of(all_tests()[index], checked));
}
Compiled vulkan(size_t index, bool checked) {
  return compile_vulkan(options_of(all_tests()[index], checked));
}
const Executor kExecutors[] = {
    {"native", "embree", compile_native<hlsl::WideThreads::kNever>},
    // Compute shaders that run several threads at once, of which only one exists.
    {"wide", "embree", compile_native<hlsl::WideThreads::kAlways>},
    {"interpreted", "embree", interpreted},
    {"vulkan", "vulkan", vulkan},
    {"checked_native", "embree", compile_native<hlsl::WideThreads::kNever>, true},
    {"checked_interpreted", "embree", interpreted, true},
    {"checked_vulkan", "vulkan", vulkan, true},
};

// The messages of a checked device that the file does not name, and those that it names but that
// are missing.
std::string unexpected(const HlslTest& test, const std::vector<std::string>& told) {
  std::string out;
  const auto is_of = [](const std::string& text, const std::string& id) {
    return text.compare(0, id.size(), id) == 0;
  };
  for (const std::string& text : told) {
    const bool named = std::any_of(test.breaks.begin(), test.breaks.end(),
                                   [&](const std::string& id) { return is_of(text, id); });
    if (!named) out += test.path + ": checked mode says " + text + "\n";
  }
  for (const std::string& id : test.breaks) {
    const bool said = std::any_of(told.begin(), told.end(),
                                  [&](const std::string& text) { return is_of(text, id); });
    if (!said) out += test.path + ": checked mode does not say " + id + "\n";
  }
  return out;
}

// Everything that is wrong; empty if nothing is.
std::string run(const Executor& executor, size_t index) {
  const HlslTest& test = all_tests()[index];
  if (!test.error.empty()) return test.path + ": " + test.error;
  const Compiled code = executor.compile(index, executor.checked);
  if (code.library == nullptr) return code.error;
  std::vector<std::string> told;
  const auto results = run_on_device(executor.backend, *code.library, test.dispatch,
                                     executor.checked ? &told : nullptr);
  if (!results) return test.path + ": " + results.error();
  std::string wrong = executor.checked ? unexpected(test, told) : "";
  for (const Expectation& expectation : test.expectations) {
    const std::string difference = compare(expectation, *results);
    if (!difference.empty()) wrong += test.path + ", " + difference + "\n";
  }
  return wrong;
}

// Under scripts/test, the name of a file that says that this run's test of the file passed, so that
// the report need not repeat it; otherwise empty.
std::string note_of(const Executor& executor, size_t index) {
  const char* folder = std::getenv("KAAMOS_SHARED_RUNS");
  if (folder == nullptr) return "";
  return std::string(folder) + "/hlsl_test/passed-" + executor.name + "-" + std::to_string(index);
}

class HlslFile : public testing::Test {
 public:
  HlslFile(const Executor& executor, size_t index) : executor_(executor), index_(index) {}
  void TestBody() override {
    if (executor_.backend != std::string("vulkan")) return check();
    KAAMOS_NEED_VULKAN();
    check();
  }

 private:
  void check() {
    const std::string wrong = run(executor_, index_);
    EXPECT_EQ(wrong, "");
    const std::string note = note_of(executor_, index_);
    if (wrong.empty() && !note.empty()) std::ofstream(note).put('\n');
  }

  const Executor& executor_;
  size_t index_;
};

// "core switch" gives "core"; "trap 7 copy-in" gives "trap 7", one feature in several files.
std::string tier_of(const std::string& feature) {
  return feature.substr(0, feature.find(' '));
}
std::string feature_key(const std::string& feature) {
  if (tier_of(feature) != "trap") return feature;
  return feature.substr(0, feature.find(' ', std::string("trap ").size()));
}

// Counts how many of the features that FEATURE and TRAP comments name work on a backend. A feature
// works if all its files pass on all executors.
class FeatureReport : public testing::Test {
 public:
  explicit FeatureReport(const char* backend) : backend_(backend) {}

  void TestBody() override {
    if (backend_ != "vulkan") return check();
    KAAMOS_NEED_VULKAN();
    check();
  }

 private:
  void check() {
    std::map<std::string, bool> features;
    for (size_t i = 0; i < all_tests().size(); ++i) {
      bool passed = true;
      for (const Executor& executor : kExecutors) {
        if (executor.backend != backend_ || executor.checked) continue;
        const std::string note = note_of(executor, i);
        const bool known = !note.empty() && std::filesystem::exists(note);
        passed = passed && (known || run(executor, i).empty());
      }
      const auto known = features.emplace(feature_key(all_tests()[i].feature), passed).first;
      known->second = known->second && passed;
    }
    const size_t tested = features.size();
    std::map<std::string, std::pair<size_t, size_t>> tiers;  // passed, total
    size_t passed = 0;
    for (const auto& [feature, works] : features) {
      auto& tier = tiers[tier_of(feature)];
      tier.first += works ? 1 : 0;
      tier.second += 1;
      passed += works ? 1 : 0;
      if (!works) std::printf("missing: %s\n", feature.c_str());
    }
    for (const auto& [tier, counts] : tiers) {
      std::printf("HLSL %s%s: %zu passed / %zu total\n", where().c_str(), tier.c_str(),
                  counts.first, counts.second);
    }
    std::printf("HLSL %sfeatures: %zu passed / %zu total\n", where().c_str(), passed,
                features.size());
    EXPECT_EQ(passed, tested);
    EXPECT_GT(tested, 0u);
  }

  std::string where() const { return backend_ == "embree" ? "" : "on Vulkan "; }

  std::string backend_;
};

std::string test_name(const std::string& path) {
  std::string name = path;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

}  // namespace
}  // namespace kaamos::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  using namespace kaamos::test;
  for (const Executor& executor : kExecutors) {
    for (size_t i = 0; i < all_tests().size(); ++i) {
      if (executor.checked && !in_checked_sample(i)) continue;
      const std::string name = std::string(executor.name) + "/" + test_name(all_tests()[i].name);
      testing::RegisterTest(
          "HlslFile", name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
          [&executor, i]() -> testing::Test* { return new HlslFile(executor, i); });
    }
  }
  for (const char* backend : {"embree", "vulkan"}) {
    const bool vulkan = std::string(backend) == "vulkan";
    testing::RegisterTest("HlslReport", vulkan ? "vulkan_Features" : "Features", nullptr, nullptr,
                          __FILE__, __LINE__,
                          [backend]() -> testing::Test* { return new FeatureReport(backend); });
  }
  return RUN_ALL_TESTS();
}
