// SPDX-License-Identifier: MIT
#include "runtime/explain/guard.h"

#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace kaamos::explain {
namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};

struct Guarded {
  sigjmp_buf jump;
  char why[256] = {};
  int signal = 0;
  uintptr_t address = 0;
};
thread_local Guarded* guarded = nullptr;
struct sigaction previous_actions[std::size(kSignals)];

void on_signal(int number, siginfo_t* info, void* context) {
  if (guarded != nullptr && info->si_code > 0) {
    guarded->signal = number;
    guarded->address = reinterpret_cast<uintptr_t>(info->si_addr);
    // The sanitizers' handlers, which run before this one, have blocked every signal.
    pthread_sigmask(SIG_SETMASK, &static_cast<const ucontext_t*>(context)->uc_sigmask, nullptr);
    siglongjmp(guarded->jump, 1);
  }
  const auto* slot = std::find(std::begin(kSignals), std::end(kSignals), number);
  const struct sigaction& previous = previous_actions[slot - std::begin(kSignals)];
  if ((previous.sa_flags & SA_SIGINFO) != 0 && previous.sa_sigaction != nullptr) {
    previous.sa_sigaction(number, info, context);
  } else if (previous.sa_handler != SIG_DFL && previous.sa_handler != SIG_IGN) {
    previous.sa_handler(number);
  } else {
    // With the default handler back, the faulting instruction runs again and ends the process.
    sigaction(number, &previous, nullptr);
    if (info->si_code <= 0) raise(number);
  }
}

// Installed while a replay runs; replays run one at a time.
class Handlers {
 public:
  Handlers() {
    struct sigaction action = {};
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < std::size(kSignals); ++i) {
      sigaction(kSignals[i], &action, &previous_actions[i]);
    }
  }
  ~Handlers() {
    for (size_t i = 0; i < std::size(kSignals); ++i) {
      sigaction(kSignals[i], &previous_actions[i], nullptr);
    }
  }
  Handlers(const Handlers&) = delete;
  Handlers& operator=(const Handlers&) = delete;
};

}  // namespace

std::string run_guarded(void (*body)(void*), void* argument) {
  const Handlers handlers;
  Guarded here;
  if (sigsetjmp(here.jump, 0) == 0) {
    guarded = &here;
    body(argument);
  }
  guarded = nullptr;
  if (here.signal == 0) return here.why;
  char text[128];
  std::snprintf(text, sizeof text, "signal %d at address 0x%llx", here.signal,
                static_cast<unsigned long long>(here.address));
  return text;
}

void leave(const char* why) {
  std::snprintf(guarded->why, sizeof guarded->why, "%s", why);
  siglongjmp(guarded->jump, 1);
}

}  // namespace kaamos::explain
