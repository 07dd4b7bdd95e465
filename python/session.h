// SPDX-License-Identifier: MIT
//
// A device for Python: its queue, its messages, and resources that are bound by their HLSL names.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "python/arrays.h"

namespace kaamos::python {

// What was compiled, and where each of its resources is bound.
struct Library {
  rtapi::ShaderLibrary library;
  rtapi::ShaderReflection reflection;
  std::string source_name;
};

// A bottom or top level, with what it was built from.
struct Structure {
  rtapi::Buffer buffer;
  std::vector<rtapi::Buffer> inputs;
};

// What a call binds to a name: a resource, or the bytes of a constant buffer.
using Bound = std::variant<ArrayBuffer, ArrayTexture, Structure, std::string>;
using Bindings = std::map<std::string, Bound>;

struct Message {
  rtapi::MessageSeverity severity;
  std::string id;
  std::string text;
};

struct DeviceOptions {
  std::string backend = "embree";
  bool interpret = false;
  bool checked = false;
  uint32_t threads = 0;
};

class Session {
 public:
  explicit Session(const DeviceOptions& options);

  const rtapi::Device& device() const { return device_; }
  const rtapi::CommandQueue& queue() const { return queue_; }
  const DeviceOptions& options() const { return options_; }

  Library compile(rtapi::ShaderCompileOptions options) const;
  // Root parameters for every resource of the library. Throws for what cannot be bound.
  rtapi::RootSignature root_signature(const Library& library) const;
  // Sets all of them on the list, from the resources of those names. Returns what must live until
  // the list has run. Throws py::type_error for a name that the library lacks or that is not given.
  std::vector<rtapi::Resource> bind(rtapi::CommandList& list, const Library& library,
                                    const rtapi::RootSignature& signature, const Bindings& given);
  void dispatch(const Library& library, const std::string& entry, const uint32_t (&groups)[3],
                const Bindings& given);
  // Runs a list, without the GIL.
  void execute(const rtapi::CommandList& list);
  // What was said since the last call.
  std::vector<Message> take_messages();

 private:
  const DeviceOptions options_;
  std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>();
  std::shared_ptr<std::vector<Message>> messages_ = std::make_shared<std::vector<Message>>();
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  std::optional<rtapi::DescriptorHeap> heap_;  // of the list that is recorded
};

}  // namespace kaamos::python
