// SPDX-License-Identifier: MIT
#include "python/session.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace kaamos::python {
namespace {

std::atomic<uint64_t> g_sessions{0};

bool is_on_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

// Work of a device, in a thread of its own, so that this one can listen to Ctrl-C meanwhile. Lives
// until the work is done.
class InterruptibleWork {
 public:
  explicit InterruptibleWork(std::function<void()> work)
      : thread_([this, work = std::move(work)] {
          try {
            work();
          } catch (...) {
            error_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          done_ = true;
          changed_.notify_one();
        }) {}
  ~InterruptibleWork() {
    const py::gil_scoped_release released;
    thread_.join();
  }

  bool wait_for(std::chrono::milliseconds time) {
    const py::gil_scoped_release released;
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [this] { return done_; });
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // starts when all else is there
};

}  // namespace

Session::Session(const DeviceOptions& options) : options_(options), number_(g_sessions++) {
  rtapi::DeviceDesc desc;
  desc.Backend = options.backend;
  desc.Checked = options.checked;
  desc.Threads = options.threads;
  desc.OnMessage = [mutex = mutex_, messages = messages_](const rtapi::Message& message) {
    const std::lock_guard lock(*mutex);
    messages->push_back({message.Severity, message.Id.text(), message.Text});
  };
  device_ = rtapi::CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
}

Library Session::compile(rtapi::ShaderCompileOptions options) const {
  options.Interpret = options_.interpret || options_.backend == "vulkan";
  options.Spirv = options_.backend == "vulkan";
  options.CheckAccess = options_.checked;
  options.NoWarnings = true;
  rtapi::ShaderCompilation compiled;
  {
    const py::gil_scoped_release released;
    compiled = rtapi::CompileShaderLibrary(options);
  }
  if (!compiled.Status.ok()) throw rtapi::ResultError(compiled.Status.error());
  return {compiled.Library, std::move(compiled.Reflection), options.File};
}

void Session::dispatch(const Library& library, const std::string& entry,
                       const uint32_t (&groups)[3], const Bindings& given) {
  const rtapi::RootSignature signature = root_signature(library);
  rtapi::PipelineState& pipeline = made_of(library).pipelines[entry];
  if (!pipeline) {
    pipeline =
        device_.CreateComputePipelineState({signature, library.library, entry, entry}).value();
  }
  rtapi::CommandList list = device_.CreateCommandList().value();
  const BoundResources bound = bind(list, Root::kCompute, library, signature, given);
  list.SetPipelineState(pipeline);
  list.Dispatch(groups[0], groups[1], groups[2]);
  execute(list, bound);
}

void Session::execute(rtapi::CommandList& list, const BoundResources& bound) {
  if (!bound.undo.empty()) list.ResourceBarrier(bound.undo);
  const auto work = [&] { queue_.ExecuteAndWait(list).value(); };
  // Python tells no other thread of signals.
  if (!is_on_main_thread()) {
    const py::gil_scoped_release released;
    return work();
  }
  InterruptibleWork running(work);
  while (!running.wait_for(std::chrono::milliseconds(50))) {
    if (PyErr_CheckSignals() == 0) continue;
    py::error_already_set interrupt;
    (void)device_.RemoveDevice();
    throw interrupt;
  }
  running.rethrow();
}

std::vector<Message> Session::take_messages() {
  const std::lock_guard lock(*mutex_);
  return std::exchange(*messages_, {});
}

}  // namespace kaamos::python
