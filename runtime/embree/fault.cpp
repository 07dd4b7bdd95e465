// SPDX-License-Identifier: MIT
#include "runtime/embree/fault.h"

#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>

#include "runtime/backend/errors.h"
#include "runtime/backend/fault_signals.h"
#include "runtime/errors/text.h"

namespace kaamos::embree {
namespace {

constinit runtime::FaultSignals signals(runtime::kShaderFaultSignals);

// The worker whose guarded code this thread runs; null outside of shaders.
thread_local Worker* guarded_worker = nullptr;

// An overflow faults at most this far from the stack pointer: on the guard page, or past it if a
// large frame skipped it.
constexpr uintptr_t kNearStackPointer = 1u << 20;

uintptr_t stack_pointer_of(const void* context) {
  const auto* machine = static_cast<const ucontext_t*>(context);
#if defined(__x86_64__)
  return static_cast<uintptr_t>(machine->uc_mcontext.gregs[REG_RSP]);
#elif defined(__aarch64__)
  return static_cast<uintptr_t>(machine->uc_mcontext.sp);
#else
  return 0;
#endif
}

// Copied, because what `index` points to ends with the guarded run.
void note_index(Worker& worker) {
  for (int axis = 0; axis < 3; ++axis) {
    worker.fault_index[axis] = worker.index != nullptr ? worker.index[axis] : 0;
  }
}

void on_signal(int signal_number, siginfo_t* info, void* context) {
  Worker* worker = guarded_worker;
  if (worker == nullptr || info->si_code <= 0) {
    return signals.forward(signal_number, info, context);
  }
  worker->fault_signal = signal_number;
  worker->fault_address = reinterpret_cast<uintptr_t>(info->si_addr);
  worker->fault_reason = shader::RemovalReason::kFault;
  const uintptr_t stack = stack_pointer_of(context);
  const bool memory_fault = signal_number == SIGSEGV || signal_number == SIGBUS;
  // Memory around the stack pointer always exists, unless the stack has run out.
  if (memory_fault && worker->fault_address + kNearStackPointer > stack &&
      worker->fault_address < stack + kNearStackPointer) {
    worker->fault_reason = shader::RemovalReason::kStackOverflow;
  }
  note_index(*worker);
  runtime::restore_signal_mask(context);
  siglongjmp(*worker->jump, 1);
}

void install_handlers() {
  static std::once_flag once;
  std::call_once(once, [] { signals.install(on_signal); });
}

// A stack for the handler, because the shader's may be used up.
class SignalStack {
 public:
  SignalStack() {
    stack_t current = {};
    if (sigaltstack(nullptr, &current) == 0 && (current.ss_flags & SS_DISABLE) == 0) return;
    memory_ = std::malloc(kBytes);
    if (memory_ == nullptr) return;
    stack_t stack = {};
    stack.ss_sp = memory_;
    stack.ss_size = kBytes;
    sigaltstack(&stack, nullptr);
  }
  ~SignalStack() {
    if (memory_ == nullptr) return;
    stack_t none = {};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
    std::free(memory_);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  static constexpr size_t kBytes = 64 * 1024;
  void* memory_ = nullptr;
};

uintptr_t find_stack_limit() {
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return 0;
  void* lowest = nullptr;
  size_t bytes = 0;
  pthread_attr_getstack(&attributes, &lowest, &bytes);
  pthread_attr_destroy(&attributes);
  // Embree's traversal of two levels takes about 20 KiB, a shader rarely more.
  const size_t reserve = std::min<size_t>(bytes / 4, 256 * 1024);
  return reinterpret_cast<uintptr_t>(lowest) + reserve;
}

const char* name_of(int signal_number) {
  switch (signal_number) {
    case SIGSEGV:
      return "access to memory that is not there (SIGSEGV)";
    case SIGBUS:
      return "bus error (SIGBUS)";
    case SIGFPE:
      return "integer division (SIGFPE)";
    case SIGILL:
      return "illegal instruction (SIGILL)";
    default:
      return "fault";
  }
}

std::string detail_of(const Worker& worker) {
  switch (worker.fault_reason) {
    case shader::RemovalReason::kRecursionDepth:
      return "the pipeline declares MaxTraceRecursionDepth " +
             std::to_string(worker.dispatch->max_recursion_depth) +
             " and a shader at that depth called TraceRay";
    case shader::RemovalReason::kStackOverflow:
      return "calls are nested too deep";
    case shader::RemovalReason::kFault:
      return std::string(name_of(worker.fault_signal)) + " at address " +
             errors::hex(worker.fault_address) +
             ". A root descriptor, a table handle or a record argument may name memory that is "
             "not "
             "there";
    case shader::RemovalReason::kStepLimit:
      return "it may loop for ever. Otherwise raise ShaderCompileOptions::InterpretStepLimit";
    case shader::RemovalReason::kMultisampled:
      return runtime::kMultisampledUse;
    default:
      return "it called for it";
  }
}

}  // namespace

uintptr_t stack_limit_of_this_thread() {
  thread_local const uintptr_t limit = find_stack_limit();
  return limit;
}

bool run_guarded(Worker& worker, void (*body)(void*), void* argument) {
  install_handlers();
  thread_local const SignalStack signal_stack;
  worker.stack_limit = stack_limit_of_this_thread();
  sigjmp_buf jump;
  worker.jump = &jump;
  // Not saving the signal mask saves one system call per tile.
  if (sigsetjmp(jump, 0) != 0) {
    guarded_worker = nullptr;
    worker.jump = nullptr;
    return false;
  }
  guarded_worker = &worker;
  body(argument);
  guarded_worker = nullptr;
  worker.jump = nullptr;
  return true;
}

bool run_guarded_on_fiber(Worker& worker, void (*body)(void*), void* argument) {
  sigjmp_buf jump;
  if (sigsetjmp(jump, 0) != 0) return false;
  worker.jump = &jump;
  body(argument);
  return true;
}

void remove_device(Worker& worker, shader::RemovalReason reason) {
  worker.fault_reason = reason;
  note_index(worker);
  siglongjmp(*worker.jump, 1);
}

void record_removal(Worker& worker) {
  RunningDispatch& dispatch = *worker.dispatch;
  std::string text = detail_of(worker) + " (" + dispatch.label;
  if (worker.running != nullptr) {
    text += std::string(", shader \"") + worker.running->name + "\"";
    if (worker.index != nullptr) {
      text += " at (" + std::to_string(worker.fault_index[0]) + "," +
              std::to_string(worker.fault_index[1]) + "," + std::to_string(worker.fault_index[2]) +
              ")";
    }
  }
  text += ").";
  const std::lock_guard lock(dispatch.mutex);
  if (dispatch.removed.exchange(true)) return;
  dispatch.removal = {worker.fault_reason, std::move(text)};
}

}  // namespace kaamos::embree
