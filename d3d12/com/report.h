// SPDX-License-Identifier: MIT
// Where messages go: to the standard error stream, which on Linux stands for a debugger's output
// window, and to the info queues of the process.
#pragma once

#include <functional>
#include <string>

#include <directx/d3d12.h>

#include <rtapi/result.h>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

/// The HRESULT of an error's family.
HRESULT to_hresult(rtapi::ErrorCode code);

/// Sends a message to every sink. The environment variable KAAMOS_D3D12_MESSAGES says which of them
/// are printed: "none", "errors" (the default), or "all".
void report(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error);

/// Reports the warning that shaders are interpreted. The process prints the first one unless
/// nothing is printed at all: a program that runs a hundred times slower says why.
void report_interpreted(const rtapi::Error& error);

/// Prints what a program asked for, unless nothing is printed at all.
void print(D3D12_MESSAGE_SEVERITY severity, const std::string& text);

/// While muted, nothing is printed; sinks still get every message. Counts calls.
void mute_output(bool muted);

/// Reports an error and returns its HRESULT.
///@{
HRESULT fail(const rtapi::Error& error);
HRESULT fail(ErrorId id, const std::string& detail);
///@}
/// S_OK, or as above.
HRESULT check(const rtapi::Status& status);

/// Adds a sink, which may be called on any thread, and returns what removes it.
using MessageSink = std::function<void(D3D12_MESSAGE_SEVERITY, const rtapi::Error&)>;
uint64_t add_sink(MessageSink sink);
void remove_sink(uint64_t id);

}  // namespace kaamos::d3d12
