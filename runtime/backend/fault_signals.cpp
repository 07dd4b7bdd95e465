// SPDX-License-Identifier: MIT
#include "runtime/backend/fault_signals.h"

#include <pthread.h>

#include <algorithm>
#include <cassert>

namespace kaamos::runtime {

void FaultSignals::install(Handler handler) {
  assert(signals_.size() <= kMost);
  struct sigaction action = {};
  action.sa_sigaction = handler;
  // NODEFER: the handler may leave by a jump that does not restore the mask.
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (size_t i = 0; i < signals_.size(); ++i) sigaction(signals_[i], &action, &previous_[i]);
}

void FaultSignals::restore() {
  for (size_t i = 0; i < signals_.size(); ++i) sigaction(signals_[i], &previous_[i], nullptr);
}

void FaultSignals::forward(int number, siginfo_t* info, void* context) const {
  const auto found = std::find(signals_.begin(), signals_.end(), number);
  const struct sigaction& previous = previous_[found - signals_.begin()];
  if ((previous.sa_flags & SA_SIGINFO) != 0 && previous.sa_sigaction != nullptr) {
    previous.sa_sigaction(number, info, context);
  } else if (previous.sa_handler != SIG_DFL && previous.sa_handler != SIG_IGN) {
    previous.sa_handler(number);
  } else {
    // Once the default is restored, the instruction that faulted runs again and ends the process.
    sigaction(number, &previous, nullptr);
    if (info->si_code <= 0) raise(number);
  }
}

void restore_signal_mask(const void* context) {
  pthread_sigmask(SIG_SETMASK, &static_cast<const ucontext_t*>(context)->uc_sigmask, nullptr);
}

}  // namespace kaamos::runtime
