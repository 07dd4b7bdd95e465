// SPDX-License-Identifier: MIT
// Threads, the command line and the environment.
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <process.h>

#include "d3d12/com/text.h"
#include "d3d12/win32/event.h"
#include "d3d12/win32/text_out.h"

namespace kaamos::d3d12 {

namespace {

// An event that the end of the thread sets.
class Thread final : public Event {
 public:
  explicit Thread(std::function<void()> body) : Event(true, false), body_(std::move(body)) {}

  // False if it has been started.
  static bool start(const std::shared_ptr<Thread>& thread) {
    if (thread->started_.exchange(true)) return false;
    // The library's threads have stacks of their own size.
    std::thread([thread] {
      std::exchange(thread->body_, nullptr)();
      set_event(*thread, true);
    }).detach();
    return true;
  }

 private:
  std::function<void()> body_;
  std::atomic<bool> started_ = false;
};

HANDLE make_thread(std::function<void()> body, DWORD flags, const char* call) {
  if ((flags & ~(STACK_SIZE_PARAM_IS_A_RESERVATION | CREATE_SUSPENDED)) != 0) {
    succeed(false, ERROR_INVALID_PARAMETER, call,
            "flags are " + std::to_string(flags) +
                "; allowed are 0, CREATE_SUSPENDED (4) and STACK_SIZE_PARAM_IS_A_RESERVATION.");
    return nullptr;
  }
  const auto thread = std::make_shared<Thread>(std::move(body));
  const HANDLE handle = Handles::instance().add(thread);
  if ((flags & CREATE_SUSPENDED) == 0) Thread::start(thread);
  return handle;
}

std::string quote(const std::string& argument) {
  if (!argument.empty() && argument.find_first_of(" \t\"") == std::string::npos) return argument;
  std::string out = "\"";
  size_t backslashes = 0;
  for (char c : argument) {
    // Backslashes count double before a quotation mark. [Win32: CommandLineToArgvW]
    if (c == '"') out.append(backslashes + 1, '\\');
    backslashes = c == '\\' ? backslashes + 1 : 0;
    out += c;
  }
  out.append(backslashes, '\\');
  return out + '"';
}

std::string read_command_line() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const std::string argument = text.c_str() + at;
    at += argument.size() + 1;
    out += (out.empty() ? "" : " ") + quote(argument);
  }
  return out;
}

std::vector<std::wstring> split_command_line(std::wstring_view line) {
  std::vector<std::wstring> out;
  size_t at = 0;
  const auto blank = [&] { return line[at] == L' ' || line[at] == L'\t'; };
  while (at < line.size()) {
    if (blank()) {
      ++at;
      continue;
    }
    std::wstring argument;
    bool quoted = false;
    while (at < line.size() && (quoted || !blank())) {
      size_t backslashes = 0;
      while (at < line.size() && line[at] == L'\\') ++backslashes, ++at;
      if (at < line.size() && line[at] == L'"') {
        argument.append(backslashes / 2, L'\\');
        if (backslashes % 2 != 0) {
          argument += L'"';
        } else {
          quoted = !quoted;
        }
        ++at;
      } else {
        argument.append(backslashes, L'\\');
        if (backslashes == 0) argument += line[at++];
      }
    }
    out.push_back(std::move(argument));
  }
  return out;
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

DWORD WINAPI GetCurrentThreadId() {
  return static_cast<DWORD>(::syscall(SYS_gettid));
}
DWORD WINAPI GetCurrentProcessId() {
  return static_cast<DWORD>(::getpid());
}

HANDLE WINAPI CreateThread(LPSECURITY_ATTRIBUTES, SIZE_T, LPTHREAD_START_ROUTINE start,
                           LPVOID parameter, DWORD flags, LPDWORD id) {
  if (id != nullptr) *id = 0;
  return make_thread([start, parameter] { start(parameter); }, flags, "CreateThread");
}

DWORD WINAPI ResumeThread(HANDLE handle) {
  const auto thread = Handles::instance().find<Thread>(handle);
  if (!succeed(thread != nullptr, ERROR_INVALID_HANDLE, "ResumeThread",
               "the handle names no thread that lives.")) {
    return static_cast<DWORD>(-1);
  }
  return Thread::start(thread) ? 1 : 0;
}

uintptr_t _beginthreadex(void*, unsigned, _beginthreadex_proc_type start, void* argument,
                         unsigned flags, unsigned* id) {
  if (id != nullptr) *id = 0;
  return reinterpret_cast<uintptr_t>(
      make_thread([start, argument] { start(argument); }, flags, "_beginthreadex"));
}

LPSTR WINAPI GetCommandLineA() {
  static std::string line = read_command_line();
  return line.data();
}
LPWSTR WINAPI GetCommandLineW() {
  static std::wstring line = to_wide(read_command_line());
  return line.data();
}

LPWSTR* WINAPI CommandLineToArgvW(LPCWSTR command_line, int* count) {
  const auto arguments = split_command_line(
      command_line != nullptr && *command_line != 0 ? command_line : GetCommandLineW());
  size_t bytes = (arguments.size() + 1) * sizeof(LPWSTR);
  for (const auto& argument : arguments) bytes += (argument.size() + 1) * sizeof(WCHAR);
  auto* list = static_cast<LPWSTR*>(LocalAlloc(LPTR, bytes));
  auto* text = reinterpret_cast<LPWSTR>(list + arguments.size() + 1);  // NOLINT: one block for all
  for (size_t i = 0; i < arguments.size(); ++i) {
    list[i] = text;
    text = std::copy(arguments[i].begin(), arguments[i].end(), text) + 1;
  }
  *count = static_cast<int>(arguments.size());
  return list;
}

DWORD WINAPI GetEnvironmentVariableA(LPCSTR name, LPSTR value, DWORD size) {
  const char* found = std::getenv(name);
  if (found == nullptr) SetLastError(ERROR_ENVVAR_NOT_FOUND);
  return found != nullptr ? hand_out_text(std::string(found), value, size) : 0;
}
DWORD WINAPI GetEnvironmentVariableW(LPCWSTR name, LPWSTR value, DWORD size) {
  const char* found = std::getenv(to_utf8(name).c_str());
  if (found == nullptr) SetLastError(ERROR_ENVVAR_NOT_FOUND);
  return found != nullptr ? hand_out_text(to_wide(found), value, size) : 0;
}

}  // extern "C"
