// SPDX-License-Identifier: MIT
#include "runtime/explain/guard.h"

#include <signal.h>

#include <cstdio>

#include "runtime/backend/fault_signals.h"

namespace kaamos::explain {
namespace {

struct Guarded {
  sigjmp_buf jump;
  char why[256] = {};
  int signal = 0;
  uintptr_t address = 0;
};
thread_local Guarded* guarded = nullptr;
constinit runtime::FaultSignals signals(runtime::kShaderFaultSignals);

void on_signal(int number, siginfo_t* info, void* context) {
  if (guarded != nullptr && info->si_code > 0) {
    guarded->signal = number;
    guarded->address = reinterpret_cast<uintptr_t>(info->si_addr);
    runtime::restore_signal_mask(context);
    siglongjmp(guarded->jump, 1);
  }
  signals.forward(number, info, context);
}

// Installed while a replay runs; replays run one at a time.
class Handlers {
 public:
  Handlers() { signals.install(on_signal); }
  ~Handlers() { signals.restore(); }
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
