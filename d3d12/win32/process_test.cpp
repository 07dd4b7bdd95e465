// SPDX-License-Identifier: MIT
#include <process.h>
#include <shellapi.h>
#include <windows.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "d3d12/com/report_fixture.h"

namespace kaamos::d3d12 {
namespace {

DWORD WINAPI add_one(LPVOID value) {
  return static_cast<DWORD>(InterlockedIncrement(static_cast<LONG*>(value)));
}

TEST(Thread, ItsHandleIsSetWhenItHasEnded) {
  LONG value = 0;
  std::vector<HANDLE> threads;
  for (int i = 0; i < 8; ++i) {
    threads.push_back(CreateThread(nullptr, 0, &add_one, &value, 0, nullptr));
    ASSERT_NE(threads.back(), nullptr);
  }
  EXPECT_EQ(WaitForMultipleObjects(8, threads.data(), TRUE, INFINITE), WAIT_OBJECT_0);
  EXPECT_EQ(value, 8);
  for (HANDLE thread : threads) EXPECT_TRUE(CloseHandle(thread));
}

// The type that DWORD has on Windows.
unsigned long WINAPI start_of_windows(void* seen) {
  *static_cast<bool*>(seen) = true;
  return 0;
}

TEST(Thread, MayStartInAFunctionOfUnsignedLong) {
  bool seen = false;
  const HANDLE thread = CreateThread(nullptr, 0, start_of_windows, &seen, 0, nullptr);
  ASSERT_NE(thread, nullptr);
  EXPECT_EQ(WaitForSingleObject(thread, INFINITE), WAIT_OBJECT_0);
  EXPECT_TRUE(seen);
  EXPECT_TRUE(CloseHandle(thread));
}

TEST(Process, LocallyUniqueIdsDiffer) {
  LUID first = {}, second = {};
  ASSERT_TRUE(AllocateLocallyUniqueId(&first));
  ASSERT_TRUE(AllocateLocallyUniqueId(&second));
  EXPECT_FALSE(first.LowPart == second.LowPart && first.HighPart == second.HighPart);
}

struct Listed {
  int number;
  LIST_ENTRY entry;
};

TEST(ListEntry, IsFoundInWhatContainsIt) {
  Listed listed = {7, {}};
  listed.entry.Flink = listed.entry.Blink = &listed.entry;
  EXPECT_EQ(CONTAINING_RECORD(listed.entry.Flink, Listed, entry)->number, 7);
}

TEST(Thread, OneThatIsSuspendedWaitsForResumeThread) {
  const Quiet quiet;
  LONG value = 0;
  const HANDLE thread = CreateThread(nullptr, 0, &add_one, &value, CREATE_SUSPENDED, nullptr);
  ASSERT_NE(thread, nullptr);
  EXPECT_EQ(WaitForSingleObject(thread, 20), WAIT_TIMEOUT);
  EXPECT_EQ(ResumeThread(thread), 1u);
  EXPECT_EQ(WaitForSingleObject(thread, INFINITE), WAIT_OBJECT_0);
  EXPECT_EQ(value, 1);
  EXPECT_EQ(ResumeThread(thread), 0u);
  EXPECT_TRUE(CloseHandle(thread));
  EXPECT_EQ(ResumeThread(thread), static_cast<DWORD>(-1));
  EXPECT_EQ(GetLastError(), ERROR_INVALID_HANDLE);
}

TEST(Thread, OtherFlagsAreRefused) {
  const Quiet quiet;
  EXPECT_EQ(CreateThread(nullptr, 0, &add_one, nullptr, 0x8, nullptr), nullptr);
  EXPECT_EQ(GetLastError(), ERROR_INVALID_PARAMETER);
}

TEST(Interlocked, UnsignedNumbersOfBothSizes) {
  volatile UINT64 wide = 0xFFFFFFFFull;
  EXPECT_EQ(InterlockedIncrement(&wide), 0x100000000ull);
  EXPECT_EQ(InterlockedExchange(&wide, 7), 0x100000000ull);
  EXPECT_EQ(InterlockedExchangeAdd(&wide, 3), 7u);
  EXPECT_EQ(InterlockedCompareExchange(&wide, 1, 10), 10u);
  EXPECT_EQ(InterlockedDecrement(&wide), 0u);
  volatile ULONG narrow = 0xFFFFFFFFu;
  EXPECT_EQ(InterlockedIncrement(&narrow), 0u);
  EXPECT_EQ(InterlockedExchange(&narrow, 5), 0u);
  EXPECT_EQ(narrow, 5u);
}

std::vector<std::wstring> split(const wchar_t* line) {
  int count = 0;
  LPWSTR* list = CommandLineToArgvW(line, &count);
  std::vector<std::wstring> out(list, list + count);
  LocalFree(list);
  return out;
}

// Win32's own examples of the rule for backslashes and quotation marks.
TEST(CommandLine, BackslashesCountBeforeAQuotationMarkOnly) {
  using Words = std::vector<std::wstring>;
  EXPECT_EQ(split(LR"(p "abc" d e)"), (Words{L"p", L"abc", L"d", L"e"}));
  EXPECT_EQ(split(LR"(p a\\b d"e f"g h)"), (Words{L"p", LR"(a\\b)", L"de fg", L"h"}));
  EXPECT_EQ(split(LR"(p a\\\"b c d)"), (Words{L"p", LR"(a\"b)", L"c", L"d"}));
  EXPECT_EQ(split(LR"(p a\\\\"b c" d e)"), (Words{L"p", LR"(a\\b c)", L"d", L"e"}));
}

TEST(CommandLine, IsThisPrograms) {
  EXPECT_NE(std::string(GetCommandLineA()).find("win32_test"), std::string::npos);
  char path[MAX_PATH] = {};
  EXPECT_EQ(GetEnvironmentVariableA("KAAMOS_NO_SUCH_VARIABLE", path, MAX_PATH), 0u);
}

TEST(CriticalSection, AThreadMayEnterItTwice) {
  CRITICAL_SECTION section;
  InitializeCriticalSection(&section);
  EnterCriticalSection(&section);
  EXPECT_TRUE(TryEnterCriticalSection(&section));
  LeaveCriticalSection(&section);
  LeaveCriticalSection(&section);
  DeleteCriticalSection(&section);
}

}  // namespace
}  // namespace kaamos::d3d12
