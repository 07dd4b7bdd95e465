// SPDX-License-Identifier: MIT
#include "runtime/vulkan/memory/fault_guard.h"

#include <dlfcn.h>
#include <signal.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <mutex>

#include "runtime/backend/fault_signals.h"

namespace kaamos::vulkan {
namespace {

constexpr uintptr_t kPageBytes = 4096;
constexpr uint32_t kMaxPages = 16384;  // further faults are not handled

// A signal handler reads and writes all of it.
struct Faults {
  std::atomic<bool> active = false;
  std::atomic<uint32_t> count = 0;
  std::atomic<uintptr_t> first = 0;
  std::atomic<uintptr_t> pages[kMaxPages];
};
Faults faults;
std::mutex owner;  // held by the active guard
constexpr int kSignals[] = {SIGSEGV};
constinit runtime::FaultSignals signals(kSignals);

void* instruction_of(const void* context) {
  const auto* machine = static_cast<const ucontext_t*>(context);
#if defined(__x86_64__)
  return reinterpret_cast<void*>(machine->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
  return reinterpret_cast<void*>(machine->uc_mcontext.pc);
#else
  return nullptr;
#endif
}

// Code that a driver generated at run time is in no file, unlike all other code.
bool is_generated_code(const void* context) {
  void* instruction = instruction_of(context);
  Dl_info info;
  return instruction != nullptr && dladdr(instruction, &info) == 0;
}

// True if the instruction can be run again.
bool give_page(uintptr_t address) {
  const uint32_t slot = faults.count.fetch_add(1);
  if (slot >= kMaxPages) return false;
  const uintptr_t page = address / kPageBytes * kPageBytes;
  void* mapped = mmap(reinterpret_cast<void*>(page), kPageBytes, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
  const bool given = mapped == reinterpret_cast<void*>(page);
  const bool taken = mapped == MAP_FAILED && errno == EEXIST;  // by another thread, just before
  if (!given && mapped != MAP_FAILED) munmap(mapped, kPageBytes);
  if (given) faults.pages[slot] = page;
  uintptr_t none = 0;
  faults.first.compare_exchange_strong(none, std::max<uintptr_t>(address, 1));
  return given || taken;
}

void on_fault(int signal_number, siginfo_t* info, void* context) {
  if (faults.active && info->si_code == SEGV_MAPERR && is_generated_code(context) &&
      give_page(reinterpret_cast<uintptr_t>(info->si_addr))) {
    return;
  }
  signals.forward(signal_number, info, context);
}

void install_handler() {
  static const bool installed = [] {
    signals.install(on_fault);
    return true;
  }();
  static_cast<void>(installed);
}

}  // namespace

FaultGuard::FaultGuard(bool wanted) : wanted_(wanted) {
  if (!wanted_) return;
  owner.lock();
  install_handler();
  faults.count = 0;
  faults.first = 0;
  faults.active = true;
}

FaultGuard::~FaultGuard() {
  if (!wanted_) return;
  faults.active = false;
  const uint32_t count = std::min(faults.count.load(), kMaxPages);
  for (uint32_t i = 0; i < count; ++i) {
    if (const uintptr_t page = faults.pages[i].exchange(0); page != 0) {
      munmap(reinterpret_cast<void*>(page), kPageBytes);
    }
  }
  owner.unlock();
}

bool FaultGuard::faulted() const {
  return wanted_ && faults.count != 0;
}

uint64_t FaultGuard::address() const {
  return faults.first;
}

}  // namespace kaamos::vulkan
