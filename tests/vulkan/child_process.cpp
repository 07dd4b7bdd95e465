// SPDX-License-Identifier: MIT
#include "child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

namespace kaamos::test {

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int run(char** command, double limit_seconds, const std::string& output) {
  const pid_t child = fork();
  if (child == 0) {
    if (!output.empty()) {
      const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      if (file < 0 || dup2(file, 1) < 0 || dup2(file, 2) < 0) _exit(127);
    }
    execvp(command[0], command);
    std::perror(command[0]);
    _exit(127);
  }
  const double end = now_seconds() + limit_seconds;
  for (int status = 0;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0) return 127 << 8;
    if (now_seconds() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

bool crashed(int status) {
  return status == -1 || WIFSIGNALED(status);
}

std::string describe(int status, double limit_seconds) {
  if (status == -1) return "did not end within " + std::to_string(int(limit_seconds)) + " s";
  return "was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
         strsignal(WTERMSIG(status)) + ")";
}

}  // namespace kaamos::test
