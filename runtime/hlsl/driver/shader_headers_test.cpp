// SPDX-License-Identifier: MIT
// Emitted code compiles against headers that the library carries.
#include "runtime/hlsl/driver/shader_headers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "runtime/hlsl/driver/files.h"
#include "runtime/hlsl/driver/host_compiler.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ShaderHeaders : public testing::Test {
 protected:
  ShaderHeaders() {
    std::string name = (fs::temp_directory_path() / "kaamos-headers-XXXXXX").string();
    cache_ = mkdtemp(name.data());
  }
  ~ShaderHeaders() override {
    unsetenv("KAAMOS_SHADER_INCLUDE");
    std::error_code ignored;
    fs::remove_all(cache_, ignored);
  }

  fs::path write() const {
    const auto folder = write_shader_headers(cache_);
    EXPECT_EQ(folder.error(), "");
    return folder ? *folder : fs::path();
  }

  fs::path cache_;
};

TEST_F(ShaderHeaders, AreThoseOfTheSourceTree) {
  EXPECT_EQ(shader_headers_text({}),
            shader_headers_text(KAAMOS_SOURCE_DIR "/runtime/shader/include"));
}

TEST_F(ShaderHeaders, AreWrittenWhereTheyAreMissingOrDamaged) {
  const fs::path folder = write();
  EXPECT_EQ(shader_headers_text(folder), shader_headers_text({}));
  EXPECT_EQ(folder.parent_path(), cache_);
  fs::remove(folder / "kaamos/shader/abi.h");
  std::ofstream(folder / "kaamos/shader/prelude.h") << "#error damaged\n";
  EXPECT_EQ(write(), folder);
  EXPECT_EQ(shader_headers_text(folder), shader_headers_text({}));
}

TEST_F(ShaderHeaders, ThatCannotBeWrittenAreAnError) {
  std::ofstream(cache_ / "file") << "x";
  EXPECT_THAT(write_shader_headers(cache_ / "file").error(),
              AllOf(HasSubstr("cannot write"), HasSubstr("Not a directory"),
                    HasSubstr("KAAMOS_CACHE_DIR")));
}

TEST_F(ShaderHeaders, OfTheEnvironmentTakeTheirPlace) {
  fs::create_directories(cache_ / "other/kaamos/shader");
  setenv("KAAMOS_SHADER_INCLUDE", (cache_ / "other").c_str(), 1);
  EXPECT_THAT(find_host_compiler().error(),
              AllOf(HasSubstr("$KAAMOS_SHADER_INCLUDE"), HasSubstr("no kaamos/shader/prelude.h"),
                    HasSubstr("unset it")));
  std::ofstream(cache_ / "other/kaamos/shader/prelude.h") << "inline int other() { return 1; }\n";
  const auto compiler = find_host_compiler();
  ASSERT_TRUE(compiler) << compiler.error();
  const SharedObject object = build_shared_object(
      *compiler, "#include <kaamos/shader/prelude.h>\nint kaamos_one() { return other(); }\n",
      Optimisation::kNone, cache_);
  EXPECT_EQ(object.error.message(), "");
}

}  // namespace
}  // namespace kaamos::hlsl
