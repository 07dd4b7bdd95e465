// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL, as shader model 6.10 is: DebugBreak and dx::IsDebuggingEnabled. A backend answers
// through Services::record_constant, at an offset that is none of a record.
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

// Asks whether a debugger is attached that would stop at a DebugBreak: 1, or 0.
inline constexpr uint32_t kDebuggingEnabled = 0xFFFFFFFEu;

inline uint32_t is_debugging_enabled(Invocation& invocation) {
  const auto answer = invocation.dispatch->services->record_constant;
  return answer != nullptr ? answer(invocation, HitObject(), kDebuggingEnabled) : 0u;
}

// Stops in a debugger at this very line, which the instruction behind it belongs to, too.
#if defined(__x86_64__)
#define KAAMOS_BREAKPOINT() __asm__ volatile("int3\n\tnop")
#elif defined(__aarch64__)
#define KAAMOS_BREAKPOINT() __asm__ volatile("brk #0\n\tnop")  // gdb knows to go on behind it
#else
#define KAAMOS_BREAKPOINT() __builtin_trap()
#endif

// What checked libraries report of a DebugBreak that no debugger saw.
inline constexpr auto kBreakWithoutDebugger = static_cast<Finding>(66);

inline void report_break(Invocation& invocation, uint32_t site) {
  const auto tell = invocation.dispatch->services->report;
  CheckReport found;
  found.finding = kBreakWithoutDebugger;
  found.site = site;
  if (tell != nullptr) tell(invocation, found);
}

}  // namespace kaamos::shader
