// SPDX-License-Identifier: MIT
//
// A handler of fault signals that shares them with whoever had them before: sanitizers, debuggers,
// the application, another backend.
#pragma once

#include <signal.h>

#include <span>

namespace kaamos::runtime {

// The signals that faulty shader code raises.
inline constexpr int kShaderFaultSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};

class FaultSignals {
 public:
  using Handler = void (*)(int number, siginfo_t* info, void* context);

  // Lives as long as the process, or from install() to restore(); handlers run on any thread.
  constexpr explicit FaultSignals(std::span<const int> signals) : signals_(signals) {}

  // `handler` may leave by siglongjmp, and runs on the alternate stack where the thread has one.
  void install(Handler handler);
  void restore();

  // Within the handler, for a signal that is not its own: hands it to whoever had it before.
  void forward(int number, siginfo_t* info, void* context) const;

 private:
  static constexpr size_t kMost = 4;
  std::span<const int> signals_;
  struct sigaction previous_[kMost] = {};
};

// Within a handler that leaves by siglongjmp: unblocks what was not blocked where the fault
// happened. Sanitizers' handlers, which run before ours, have blocked every signal.
void restore_signal_mask(const void* context);

}  // namespace kaamos::runtime
