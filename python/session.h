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

// A pipeline of rays, and the root signature that it was made with.
struct RayPipeline {
  rtapi::RootSignature root_signature;
  rtapi::StateObject state_object;
};

// What calls of one device have made of a library so far, by all that they named, so that the next
// one with the same names need not.
struct MadePipelines {
  std::optional<rtapi::RootSignature> root_signature;
  std::map<std::string, rtapi::PipelineState> pipelines;
  std::map<std::string, RayPipeline> of_rays;
};

// What was compiled, and where each of its resources is bound.
struct Library {
  rtapi::ShaderLibrary library;
  rtapi::ShaderReflection reflection;
  std::string source_name;
  // By Session::number().
  std::shared_ptr<std::map<uint64_t, MadePipelines>> made =
      std::make_shared<std::map<uint64_t, MadePipelines>>();
};

// A bottom or top level, with what it was built from.
struct Structure {
  rtapi::Buffer buffer;
  std::vector<rtapi::Buffer> inputs;
};

// What a call binds to a name: a resource, a sampler, or the bytes of a constant buffer.
using Bound = std::variant<ArrayBuffer, ArrayTexture, Structure, rtapi::SamplerDesc, std::string>;
using Bindings = std::map<std::string, Bound>;

// What a list must leave alive and put back.
struct BoundResources {
  std::vector<rtapi::Resource> alive;
  rtapi::DescriptorHeap heap;                // empty without textures and typed buffers
  rtapi::DescriptorHeap samplers;            // empty without samplers
  std::vector<rtapi::ResourceBarrier> undo;  // textures back to the common state
};

enum class Root { kCompute, kGraphics };

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
  // No other session has it, not even after this one.
  uint64_t number() const { return number_; }
  MadePipelines& made_of(const Library& library) const { return (*library.made)[number_]; }

  Library compile(rtapi::ShaderCompileOptions options) const;
  // Root parameters for every resource of the library but those of local root signatures. Throws
  // for what cannot be bound.
  rtapi::RootSignature root_signature(const Library& library,
                                      const std::vector<std::string>& local = {}) const;
  // Sets all of them on the list, from the resources of those names; a SamplerState that is not
  // given is linear and wraps. Throws py::type_error for a name that the library lacks or that is
  // not given. [bindings.cpp]
  BoundResources bind(rtapi::CommandList& list, Root root, const Library& library,
                      const rtapi::RootSignature& signature, const Bindings& given,
                      const std::vector<std::string>& local = {});
  void dispatch(const Library& library, const std::string& entry, const uint32_t (&groups)[3],
                const Bindings& given);
  // Puts textures back and runs the list, without the GIL.
  void execute(rtapi::CommandList& list, const BoundResources& bound);
  // What was said since the last call.
  std::vector<Message> take_messages();

 private:
  const DeviceOptions options_;
  const uint64_t number_;
  std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>();
  std::shared_ptr<std::vector<Message>> messages_ = std::make_shared<std::vector<Message>>();
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
};

}  // namespace kaamos::python
