// SPDX-License-Identifier: MIT
#include "d3d12/com/text.h"

#include <gtest/gtest.h>

namespace kaamos::d3d12 {
namespace {

TEST(Text, CodePointsOfEveryLengthGoThereAndBack) {
  const std::wstring text = L"a\u00e4\u20ac\U0001F600";
  const std::string utf8 = to_utf8(std::wstring_view(text));
  EXPECT_EQ(utf8, "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
  EXPECT_EQ(to_wide(utf8), text);
}

TEST(Text, WhatIsNoCodePointIsReplaced) {
  const wchar_t surrogate[] = {static_cast<wchar_t>(0xD800), 0};
  EXPECT_EQ(to_utf8(surrogate), "\xEF\xBF\xBD");
  EXPECT_EQ(to_wide("\xC3"), L"\uFFFD");          // ends too early
  EXPECT_EQ(to_wide("\xFF"), L"\uFFFD");          // no lead byte
  EXPECT_EQ(to_wide("\xC0\x80"), L"\uFFFD");      // longer than it need be
  EXPECT_EQ(to_wide("\xED\xA0\x80"), L"\uFFFD");  // a surrogate
  EXPECT_EQ(to_utf8(static_cast<const wchar_t*>(nullptr)), "");
}

}  // namespace
}  // namespace kaamos::d3d12
