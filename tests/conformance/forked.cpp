// SPDX-License-Identifier: MIT
#include "tests/conformance/forked.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstring>

namespace kaamos::conformance {

namespace {

#if defined(KAAMOS_EMULATED)
constexpr unsigned kLimitSeconds = 1200;
#else
constexpr unsigned kLimitSeconds = 120;
#endif

bool write_all(int to, const void* data, size_t bytes) {
  for (const char* at = static_cast<const char*>(data); bytes > 0;) {
    const ssize_t count = write(to, at, bytes);
    if (count <= 0) return false;
    at += count;
    bytes -= static_cast<size_t>(count);
  }
  return true;
}

bool read_all(int from, void* data, size_t bytes) {
  for (char* at = static_cast<char*>(data); bytes > 0;) {
    const ssize_t count = read(from, at, bytes);
    if (count <= 0) return false;
    at += count;
    bytes -= static_cast<size_t>(count);
  }
  return true;
}

}  // namespace

// Texts come back through a pipe, each preceded by its size.
End fork_and_run(size_t count, const std::function<std::string(size_t)>& work,
                 const std::function<void(size_t, const std::string&)>& on_text) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    for (size_t i = 0; i < count; ++i) {
      alarm(kLimitSeconds);
      const std::string text = work(i);
      const uint64_t size = text.size();
      if (!write_all(ends[1], &size, sizeof size) || !write_all(ends[1], text.data(), size)) break;
    }
    _exit(0);
  }
  close(ends[1]);
  End out;
  uint64_t size = 0;
  while (child > 0 && out.done < count && read_all(ends[0], &size, sizeof size)) {
    std::string text(size, '\0');
    if (!read_all(ends[0], text.data(), size)) break;
    on_text(out.done++, text);
  }
  close(ends[0]);
  if (child > 0) waitpid(child, &out.status, 0);
  return out;
}

std::string describe_end(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    return "did not end within " + std::to_string(kLimitSeconds) + " s\n";
  }
  if (WIFSIGNALED(status)) return std::string("ended by ") + strsignal(WTERMSIG(status)) + "\n";
  return "its process ended without a result\n";
}

}  // namespace kaamos::conformance
