// SPDX-License-Identifier: MIT
// main of a program that has WinMain, wWinMain or wmain in its place. A library of its own, which a
// program with main does not take.
#include <windows.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "d3d12/com/text.h"
#include "d3d12/win32/not_found.h"

extern "C" {
int WINAPI WinMain(HINSTANCE, HINSTANCE, LPSTR, int) __attribute__((weak));
int WINAPI wWinMain(HINSTANCE, HINSTANCE, LPWSTR, int) __attribute__((weak));
}

// wmain is a C++ function here, of one of these types.
int wmain_none() __asm__("_Z5wmainv") __attribute__((weak));
int wmain_texts(int, wchar_t**) __asm__("_Z5wmainiPPw") __attribute__((weak));
int wmain_const_texts(int, const wchar_t**) __asm__("_Z5wmainiPPKw") __attribute__((weak));

namespace {

// What std::terminate called before a list of names came first.
std::terminate_handler before_fail = nullptr;

// Windows gives WinMain what follows the program's name.
template <class C>
C* skip_program(C* line) {
  bool quoted = false;
  while (*line != 0 && (quoted || *line != ' ')) {
    if (*line == '"') quoted = !quoted;
    ++line;
  }
  while (*line == ' ') ++line;
  return line;
}

int run(int argc, char** argv) {
  std::setlocale(LC_CTYPE, "C.UTF-8");  // wide output of any text
  const HINSTANCE instance = GetModuleHandleA(nullptr);
  if (wWinMain != nullptr) {
    return wWinMain(instance, nullptr, skip_program(GetCommandLineW()), SW_SHOWDEFAULT);
  }
  if (WinMain != nullptr) {
    return WinMain(instance, nullptr, skip_program(GetCommandLineA()), SW_SHOWDEFAULT);
  }
  if (wmain_none != nullptr) return wmain_none();
  std::vector<std::wstring> texts;
  for (int i = 0; i < argc; ++i) texts.push_back(kaamos::d3d12::to_wide(argv[i]));
  std::vector<wchar_t*> pointers;
  for (auto& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  if (wmain_texts != nullptr) return wmain_texts(argc, pointers.data());
  if (wmain_const_texts != nullptr) {
    return wmain_const_texts(argc, const_cast<const wchar_t**>(pointers.data()));  // NOLINT
  }
  std::fputs("This program has no main, wmain, WinMain or wWinMain.\n", stderr);
  return 1;
}

[[noreturn]] void fail() {
  kaamos::d3d12::print_not_found();
  before_fail();
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  before_fail = std::set_terminate(&fail);
  const int code = run(argc, argv);
  if (code != 0) kaamos::d3d12::print_not_found();
  return code;
}
