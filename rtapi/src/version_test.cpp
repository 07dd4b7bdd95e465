// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rtapi/version.h>

#include <string>

namespace {

TEST(Version, LibraryAndHeadersAgree) {
  EXPECT_EQ(rtapi::GetVersion(), std::to_string(rtapi::kVersionMajor) + "." +
                                     std::to_string(rtapi::kVersionMinor) + "." +
                                     std::to_string(rtapi::kVersionPatch));
}

}  // namespace
