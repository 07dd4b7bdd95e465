// SPDX-License-Identifier: MIT
#include <kaamos_crt.h>
#include <strsafe.h>
#include <windows.h>

#include <gtest/gtest.h>

#include <string>

namespace kaamos::d3d12 {
namespace {

TEST(CrtText, ACopyThatDoesNotFitLeavesAnEmptyStringOrIsCut) {
  char text[4] = "abc";
  EXPECT_EQ(strcpy_s(text, "defg"), ERANGE);
  EXPECT_STREQ(text, "");
  EXPECT_EQ(strcpy_s(text, "def"), 0);
  EXPECT_STREQ(text, "def");
  EXPECT_EQ(strncpy_s(text, "ghijk", _TRUNCATE), STRUNCATE);
  EXPECT_STREQ(text, "ghi");
  wchar_t wide[6] = L"ab";
  EXPECT_EQ(wcscat_s(wide, L"cde"), 0);
  EXPECT_STREQ(wide, L"abcde");
  EXPECT_EQ(wcscat_s(wide, L"f"), ERANGE);
  EXPECT_STREQ(wide, L"");
}

TEST(CrtText, FormatsOfWideTextAreMsvcs) {
  wchar_t wide[64];
  EXPECT_EQ(swprintf_s(wide, L"%s %S %I64d %lu", L"wide", "narrow", INT64_C(5000000000), 7u), 24);
  EXPECT_STREQ(wide, L"wide narrow 5000000000 7");
  EXPECT_EQ(swprintf_s(wide, 4, L"%s", L"abcd"), -1);
  EXPECT_STREQ(wide, L"");
  char text[64];
  EXPECT_EQ(sprintf_s(text, "%s %S %I64u", "narrow", L"wide", UINT64_C(5000000000)), 22);
  EXPECT_STREQ(text, "narrow wide 5000000000");
}

TEST(CrtText, StringCchCutsWhatDoesNotFit) {
  wchar_t wide[4];
  EXPECT_EQ(StringCchCopyW(wide, 4, L"abcdef"), STRSAFE_E_INSUFFICIENT_BUFFER);
  EXPECT_STREQ(wide, L"abc");
  EXPECT_EQ(StringCchPrintfW(wide, 4, L"%d", 12), S_OK);
  EXPECT_STREQ(wide, L"12");
}

TEST(CrtText, PathsSplitAtEitherSlash) {
  wchar_t drive[_MAX_DRIVE], dir[_MAX_DIR], name[_MAX_FNAME], ext[_MAX_EXT];
  EXPECT_EQ(_wsplitpath_s(L"C:\\a\\b/c.d.hlsl", drive, 3, dir, 256, name, 256, ext, 256), 0);
  EXPECT_STREQ(drive, L"C:");
  EXPECT_STREQ(dir, L"\\a\\b/");
  EXPECT_STREQ(name, L"c.d");
  EXPECT_STREQ(ext, L".hlsl");
}

TEST(CrtText, ConversionsTellTheSizeTheyNeed) {
  const std::string text = "gr\xc3\xbc\xc3\x9f";
  EXPECT_EQ(MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, nullptr, 0), 5);
  wchar_t wide[5];
  EXPECT_EQ(MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, wide, 4), 0);
  EXPECT_EQ(GetLastError(), ERROR_INSUFFICIENT_BUFFER);
  EXPECT_EQ(MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, wide, 5), 5);
  EXPECT_STREQ(wide, L"gr\u00fc\u00df");
  char back[7];
  EXPECT_EQ(WideCharToMultiByte(CP_UTF8, 0, wide, -1, back, 7, nullptr, nullptr), 7);
  EXPECT_EQ(back, text);
}

TEST(CrtText, AnErrorCodeHasAName) {
  char text[64];
  EXPECT_GT(FormatMessageA(FORMAT_MESSAGE_FROM_SYSTEM, nullptr, 0x887A0001u, 0, text, 64, nullptr),
            0u);
  EXPECT_STREQ(text, "DXGI_ERROR_INVALID_CALL (0x887A0001)");
  LPWSTR made = nullptr;
  EXPECT_GT(FormatMessageW(FORMAT_MESSAGE_ALLOCATE_BUFFER | FORMAT_MESSAGE_FROM_SYSTEM, nullptr,
                           ERROR_FILE_NOT_FOUND, 0, reinterpret_cast<LPWSTR>(&made), 0, nullptr),
            0u);
  EXPECT_EQ(std::wstring(made).substr(0, 20), L"ERROR_FILE_NOT_FOUND");
  LocalFree(made);
}

TEST(CrtText, ScanCallsTakeTheSizesOfTexts) {
  char word[8] = {}, letter = 0;
  float x = 0, y = 0;
  int64_t large = 0;
  EXPECT_EQ(sscanf_s("v 1.5 -2 q 5000000000 x", "%s %f %f %c %I64d", word, 8u, &x, &y, &letter, 1u,
                     &large),
            5);
  EXPECT_STREQ(word, "v");
  EXPECT_EQ(x, 1.5f);
  EXPECT_EQ(y, -2.0f);
  EXPECT_EQ(letter, 'q');
  EXPECT_EQ(large, INT64_C(5000000000));
  EXPECT_EQ(sscanf_s("skipped abc]d", "%*s %[a-c]]%c", word, 8u, &letter, 1u), 2);
  EXPECT_STREQ(word, "abc");
  EXPECT_EQ(letter, 'd');
  EXPECT_EQ(sscanf_s("abcdefghij", "%s", word, 8u), 1);
  EXPECT_STREQ(word, "abcdefg");  // never more than fits
  wchar_t wide[8] = {};
  int number = 0;
  EXPECT_EQ(swscanf_s(L"name=7", L"%[^=]=%d", wide, 8u, &number), 2);
  EXPECT_STREQ(wide, L"name");
  EXPECT_EQ(number, 7);
}

TEST(CrtText, WideStreamsHaveMsvcsFormats) {
  FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(fwprintf(file, L"%s and %S, %u\n", L"wide", "narrow", 7u), 19);
  std::rewind(file);
  char text[64] = {};
  ASSERT_NE(std::fgets(text, sizeof(text), file), nullptr);
  EXPECT_STREQ(text, "wide and narrow, 7\n");
  std::fclose(file);
  testing::internal::CaptureStdout();
  EXPECT_EQ(wprintf(L"%s", L"wide"), 4);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "wide");
}

TEST(CrtText, LengthsAreThoseOfTheWholeText) {
  EXPECT_EQ(_scprintf("%s %I64u", "abc", UINT64_C(5000000000)), 14);
  const std::wstring longer(1000, L'x');
  EXPECT_EQ(_scwprintf(L"%s!", longer.c_str()), 1001);
}

TEST(CrtText, NarrowAndWideTextConvertWithoutALocale) {
  char text[32];
  EXPECT_EQ(sprintf_s(text, "%S", L"Gr\u00f6\u00dfe"), 7);
  EXPECT_STREQ(text,
               "Gr\xc3\xb6\xc3\x9f"
               "e");
}

TEST(CrtText, CountsOfSnprintfCut) {
  char text[16];
  EXPECT_EQ(_snprintf_s(text, 16, 5, "%s", "abcdefgh"), -1);
  EXPECT_STREQ(text, "abcde");
  EXPECT_EQ(_snprintf_s(text, _TRUNCATE, "%s", "abcdefgh"), 8);
}

TEST(CrtText, TheLastBackslashMayBeASlash) {
  const wchar_t path[] = L"/a/b.exe";
  EXPECT_STREQ(wcsrchr(path, L'\\'), L"/b.exe");
  EXPECT_STREQ(std::wcsrchr(path, L'.'), L".exe");
  EXPECT_STREQ(strrchr("a\\b/c", '/'), "/c");
  EXPECT_EQ(strrchr("abc", '\\'), nullptr);
}

}  // namespace
}  // namespace kaamos::d3d12
