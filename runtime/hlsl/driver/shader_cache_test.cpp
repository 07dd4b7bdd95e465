// SPDX-License-Identifier: MIT
// Nothing is loaded from the shader cache that another user may have put there.
#include "runtime/hlsl/driver/shader_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "runtime/hlsl/driver/host_compiler.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr uid_t kAnotherUser = 65534;  // nobody

class ShaderCache : public testing::Test {
 protected:
  ShaderCache() {
    std::string name = (fs::temp_directory_path() / "kaamos-cache-test-XXXXXX").string();
    root_ = mkdtemp(name.data());
    folder_ = root_ / "cache";
  }
  ~ShaderCache() override {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }

  static mode_t mode_of(const fs::path& path) {
    struct stat found = {};
    EXPECT_EQ(lstat(path.c_str(), &found), 0) << path;
    return found.st_mode & 07777;
  }

  fs::path root_, folder_;
};

TEST_F(ShaderCache, IsMadeForItsUserAloneWhateverTheUmaskIs) {
  const mode_t before = umask(0);
  const std::string error = open_cache(folder_ / "below");
  umask(before);
  EXPECT_EQ(error, "");
  EXPECT_EQ(mode_of(folder_ / "below"), mode_t{0700});
}

TEST_F(ShaderCache, OfThisUserIsOpenedWhateverOthersMayRead) {
  fs::create_directory(folder_);
  for (const mode_t mode : {0700u, 0755u, 0711u}) {
    ASSERT_EQ(chmod(folder_.c_str(), mode), 0);
    EXPECT_EQ(open_cache(folder_), "") << std::oct << mode;
  }
}

TEST_F(ShaderCache, ThatOthersCanWriteToIsRefused) {
  fs::create_directory(folder_);
  for (const mode_t mode : {0770u, 0702u, 01777u}) {
    ASSERT_EQ(chmod(folder_.c_str(), mode), 0);
    EXPECT_THAT(open_cache(folder_),
                AllOf(HasSubstr(folder_.string()), HasSubstr("others can write to it"),
                      HasSubstr("chmod go-w"), HasSubstr("KAAMOS_CACHE_DIR")))
        << std::oct << mode;
  }
  EXPECT_THAT(open_cache(folder_), HasSubstr("(mode 1777)"));
}

TEST_F(ShaderCache, OfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder to another user";
  fs::create_directory(folder_);
  ASSERT_EQ(chmod(folder_.c_str(), 0700), 0);
  ASSERT_EQ(chown(folder_.c_str(), kAnotherUser, kAnotherUser), 0);
  EXPECT_THAT(open_cache(folder_),
              AllOf(HasSubstr(folder_.string()), HasSubstr("belongs to user 65534"),
                    HasSubstr("runs as user 0"), HasSubstr("KAAMOS_CACHE_DIR")));
}

TEST_F(ShaderCache, BehindALinkIsRefused) {
  ASSERT_EQ(open_cache(root_ / "real"), "");
  fs::create_directory_symlink(root_ / "real", folder_);
  for (const fs::path& name : {folder_, folder_ / ""}) {
    EXPECT_THAT(open_cache(name), AllOf(HasSubstr(folder_.string()), HasSubstr("symbolic link"),
                                        HasSubstr("KAAMOS_CACHE_DIR")))
        << name;
  }
}

TEST_F(ShaderCache, InTheTemporaryFolderIsNamedAfterItsUser) {
  for (const char* name : {"KAAMOS_CACHE_DIR", "XDG_CACHE_HOME", "HOME"}) unsetenv(name);
  EXPECT_EQ(cache_folder(), fs::path("/tmp") / ("kaamos-cache-" + std::to_string(geteuid())));
}

// Objects that are built, and those that were there before.
class CachedObject : public ShaderCache {
 protected:
  CachedObject() { EXPECT_TRUE(compiler_) << compiler_.error(); }
  SharedObject build() const {
    return build_shared_object(*compiler_, kSource, Optimisation::kNone, folder_);
  }
  fs::path find() const {
    return find_shared_object(*compiler_, kSource, Optimisation::kNone, folder_);
  }
  // After `spoil`, the object is not loaded but built again, in the other's place.
  void expect_built_anew(void (*spoil)(const fs::path&)) const {
    const SharedObject first = build();
    ASSERT_EQ(first.error.message(), "");
    EXPECT_EQ(find(), first.path);
    spoil(first.path);
    EXPECT_EQ(find(), "");
    const SharedObject again = build();
    EXPECT_EQ(again.error.message(), "");
    EXPECT_FALSE(again.from_cache);
    EXPECT_EQ(again.path, first.path);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(again.path)));
    struct stat found = {};
    ASSERT_EQ(lstat(again.path.c_str(), &found), 0);
    EXPECT_EQ(found.st_uid, geteuid());
    EXPECT_TRUE(build().from_cache);
  }

  static constexpr char kSource[] = "int kaamos_one() { return 1; }\n";
  const Result<HostCompiler> compiler_ = find_host_compiler();
};

TEST_F(CachedObject, IsFoundAgainWhateverTheUmaskIs) {
  const mode_t before = umask(0);
  const SharedObject first = build();
  umask(before);
  EXPECT_EQ(first.error.message(), "");
  EXPECT_EQ(mode_of(first.path) & 022, mode_t{0});
  EXPECT_TRUE(build().from_cache);
}

TEST_F(CachedObject, ThatOthersCanWriteToIsBuiltAnew) {
  expect_built_anew([](const fs::path& object) { ASSERT_EQ(chmod(object.c_str(), 0775), 0); });
}

TEST_F(CachedObject, OfAnotherUserIsBuiltAnew) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
  expect_built_anew([](const fs::path& object) {
    ASSERT_EQ(chown(object.c_str(), kAnotherUser, kAnotherUser), 0);
  });
}

TEST_F(CachedObject, BehindALinkIsBuiltAnew) {
  expect_built_anew([](const fs::path& object) {
    fs::rename(object, object.parent_path() / "elsewhere");
    fs::create_symlink("elsewhere", object);
  });
}

TEST_F(CachedObject, OfARefusedFolderIsNotLoaded) {
  ASSERT_EQ(build().error.message(), "");
  ASSERT_EQ(chmod(folder_.c_str(), 0777), 0);
  EXPECT_EQ(find(), "");
  const SharedObject refused = build();
  EXPECT_EQ(refused.path, "");
  EXPECT_THAT(refused.error.text, AllOf(HasSubstr(folder_.string()), HasSubstr("is refused")));
}

}  // namespace
}  // namespace kaamos::hlsl
