// SPDX-License-Identifier: MIT
// Building while a shader is being edited.
#include "runtime/hlsl/driver/build_library.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>

#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/file_loader.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;

class QuickBuild : public testing::Test {
 protected:
  QuickBuild() {
    std::string name = (fs::temp_directory_path() / "kaamos-quick-XXXXXX").string();
    cache_ = mkdtemp(name.data());
    EXPECT_TRUE(compiler_) << compiler_.error();
  }
  ~QuickBuild() override {
    std::error_code ignored;
    fs::remove_all(cache_, ignored);
  }

  std::unique_ptr<ir::Module> compile(const FrontendOptions& options) const {
    DiskFileLoader loader;
    SourceManager sources(loader);
    DiagnosticEngine diagnostics;
    auto module = compile_to_ir(options, sources, diagnostics);
    EXPECT_NE(module, nullptr) << render_all(diagnostics, sources);
    return module;
  }
  SharedObject build(const ir::Module& module, bool quick) const {
    SharedObject object =
        build_library(*compiler_, module, {.spirv = false, .quick = quick, .cache = cache_});
    EXPECT_FALSE(object.error) << object.error.message();
    return object;
  }

  fs::path cache_;
  const Result<HostCompiler> compiler_ = find_host_compiler();
};

TEST_F(QuickBuild, TakesTheFullLibraryOnceTheCacheHasIt) {
  FrontendOptions options;
  options.path = "row.hlsl";
  options.text =
      "RWTexture2D<float> t;\n[shader(\"raygeneration\")]\nvoid Main() {\n"
      "  t[DispatchRaysIndex().xy] = sqrt(float(DispatchRaysIndex().x));\n}\n";
  const auto module = compile(options);
  const SharedObject first = build(*module, true);
  EXPECT_FALSE(first.from_cache);
  const SharedObject second = build(*module, true);
  EXPECT_TRUE(second.from_cache);
  EXPECT_EQ(second.path, first.path);
  const SharedObject full = build(*module, false);
  EXPECT_FALSE(full.from_cache);
  EXPECT_NE(full.path, first.path);
  const SharedObject third = build(*module, true);
  EXPECT_TRUE(third.from_cache);
  EXPECT_EQ(third.path, full.path);
}

double seconds_of(int who) {
  rusage used = {};
  getrusage(who, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

// From an edit to the next picture, nearly all of the time is the C++ compiler's; HLSL to C++ takes
// about 0.02 s. The test counts processor time, since other processes share the machine.
TEST_F(QuickBuild, HasReflectionsInTwoSeconds) {
  FrontendOptions options;
  options.path = KAAMOS_SOURCE_DIR "/effects/reflections/traced/reflections.hlsl";
  options.include_folders = {KAAMOS_SOURCE_DIR "/effects/shaders"};
  const double before = seconds_of(RUSAGE_SELF);
  const auto module = compile(options);
  ASSERT_NE(module, nullptr);
  const double front_end = seconds_of(RUSAGE_SELF) - before;
  EXPECT_LT(front_end, 4 * 0.05);
  const double children = seconds_of(RUSAGE_CHILDREN);
  build(*module, true);
  const double compiler = seconds_of(RUSAGE_CHILDREN) - children;
  EXPECT_LT(compiler, 4 * 1.8);
  std::printf("reflections.hlsl: %.3f s to the IR, %.2f s in the C++ compiler\n", front_end,
              compiler);
}

}  // namespace
}  // namespace kaamos::hlsl
