// SPDX-License-Identifier: MIT
#include "python/session.h"

#include <rtapi/upload.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

namespace kaamos::python {
namespace {

using rtapi::ShaderBindingInfo;
using rtapi::ShaderResourceType;

std::atomic<uint64_t> g_sessions{0};

bool is_root_descriptor(const ShaderBindingInfo& binding) {
  return binding.Type == ShaderResourceType::kConstantBuffer ||
         binding.Type == ShaderResourceType::kByteAddressBuffer ||
         binding.Type == ShaderResourceType::kStructuredBuffer ||
         binding.Type == ShaderResourceType::kAccelerationStructure;
}
bool is_texture(const ShaderBindingInfo& binding) {
  return binding.Type == ShaderResourceType::kTexture2D;
}
bool is_sampler(const ShaderBindingInfo& binding) {
  return binding.Type == ShaderResourceType::kSampler;
}

std::string register_text(const ShaderBindingInfo& binding) {
  return binding.RegisterClass + std::to_string(binding.Register) +
         ", space = " + std::to_string(binding.Space);
}

const char* view_text(const ShaderBindingInfo& binding) {
  return binding.RegisterClass == 'b' ? "CBV" : binding.RegisterClass == 'u' ? "UAV" : "SRV";
}

// The state of a texture that shaders of its binding can use it in.
rtapi::ResourceStates state_for(const ShaderBindingInfo& binding) {
  return binding.IsWritable ? rtapi::ResourceStates::kUnorderedAccess
                            : rtapi::ResourceStates::kAllShaderResource;
}

bool is_local(const ShaderBindingInfo& binding, const std::vector<std::string>& local) {
  return std::find(local.begin(), local.end(), binding.Name) != local.end();
}

// Sets root arguments of compute shaders and rays, or of draws.
struct RootArguments {
  rtapi::CommandList& list;
  bool graphics;

  void signature(const rtapi::RootSignature& one) const {
    graphics ? list.SetGraphicsRootSignature(one) : list.SetComputeRootSignature(one);
  }
  void table(uint32_t parameter, rtapi::GpuDescriptorHandle base) const {
    graphics ? list.SetGraphicsRootDescriptorTable(parameter, base)
             : list.SetComputeRootDescriptorTable(parameter, base);
  }
  void descriptor(uint32_t parameter, char register_class, rtapi::GpuVirtualAddress at) const {
    if (register_class == 'b') {
      graphics ? list.SetGraphicsRootConstantBufferView(parameter, at)
               : list.SetComputeRootConstantBufferView(parameter, at);
    } else if (register_class == 'u') {
      graphics ? list.SetGraphicsRootUnorderedAccessView(parameter, at)
               : list.SetComputeRootUnorderedAccessView(parameter, at);
    } else {
      graphics ? list.SetGraphicsRootShaderResourceView(parameter, at)
               : list.SetComputeRootShaderResourceView(parameter, at);
    }
  }
};

std::string what_is(const Bound& bound) {
  constexpr const char* kNames[] = {"a Buffer", "a Texture", "an acceleration structure",
                                    "constants"};
  return kNames[bound.index()];
}

[[noreturn]] void wrong_kind(const ShaderBindingInfo& binding, const Bound& bound,
                             const char* wanted) {
  throw py::type_error("'" + binding.Name + "' is " + what_is(bound) + ", and the shader has " +
                       wanted);
}

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

rtapi::RootSignature Session::root_signature(const Library& library,
                                             const std::vector<std::string>& local) const {
  std::optional<rtapi::RootSignature>& known = made_of(library).root_signature;
  if (local.empty() && known) return *known;
  std::string text;
  for (const ShaderBindingInfo& binding : library.reflection.Bindings) {
    if (is_local(binding, local)) continue;
    const std::string place = register_text(binding);
    std::string one;
    if (binding.Count != 1) {
    } else if (is_root_descriptor(binding)) {
      one = std::string(view_text(binding)) + "(" + place + ")";
    } else if (is_texture(binding)) {
      one = std::string("DescriptorTable(") + view_text(binding) + "(" + place + "))";
    } else if (is_sampler(binding)) {
      one = "StaticSampler(" + place + ", filter = FILTER_MIN_MAG_MIP_LINEAR)";
    }
    if (one.empty()) {
      throw py::type_error("'" + binding.Name +
                           "' of the shader cannot be bound from Python: constant, raw and "
                           "structured buffers, Texture2D, RWTexture2D, samplers (linear) and "
                           "acceleration structures can");
    }
    text += (text.empty() ? "" : ", ") + one;
  }
  auto made = device_.CreateRootSignature(text).value();
  if (local.empty()) known = made;
  return made;
}

BoundResources Session::bind(rtapi::CommandList& list, Root root, const Library& library,
                             const rtapi::RootSignature& signature, const Bindings& given,
                             const std::vector<std::string>& local) {
  const auto& bindings = library.reflection.Bindings;
  for (const auto& [name, bound] : given) {
    const bool known = std::any_of(bindings.begin(), bindings.end(),
                                   [&](const ShaderBindingInfo& one) { return one.Name == name; });
    if (!known) {
      throw py::type_error("\"" + library.source_name + "\" has no resource '" + name +
                           "' that an entry point reads or writes");
    }
  }
  BoundResources out;
  const auto textures =
      static_cast<uint32_t>(std::count_if(bindings.begin(), bindings.end(), is_texture));
  if (textures != 0) {
    out.heap = device_
                   .CreateDescriptorHeap({.NumDescriptors = textures,
                                          .Flags = rtapi::DescriptorHeapFlags::kShaderVisible})
                   .value();
    list.SetDescriptorHeaps({out.heap});
  }
  const RootArguments arguments = {list, root == Root::kGraphics};
  arguments.signature(signature);
  uint32_t parameter = 0;
  uint32_t slot = 0;
  for (const ShaderBindingInfo& binding : bindings) {
    if (is_sampler(binding) || is_local(binding, local)) continue;
    const auto found = given.find(binding.Name);
    if (found == given.end()) {
      throw py::type_error("the shader's '" + binding.Name + "' is not given");
    }
    const Bound& bound = found->second;
    if (is_texture(binding)) {
      const auto* texture = std::get_if<ArrayTexture>(&bound);
      if (texture == nullptr) wrong_kind(binding, bound, "a texture");
      const rtapi::CpuDescriptorHandle handle = out.heap.GetCPUDescriptorHandle(slot);
      if (binding.IsWritable) {
        device_.CreateUnorderedAccessView(texture->texture, handle).value();
      } else {
        device_.CreateShaderResourceView(texture->texture, handle).value();
      }
      list.ResourceBarrier(rtapi::ResourceBarrier::Transition(
          texture->texture, rtapi::ResourceStates::kCommon, state_for(binding)));
      out.undo.push_back(rtapi::ResourceBarrier::Transition(texture->texture, state_for(binding),
                                                            rtapi::ResourceStates::kCommon));
      arguments.table(parameter++, out.heap.GetGPUDescriptorHandle(slot++));
      out.alive.emplace_back(texture->texture);
      continue;
    }
    rtapi::Buffer buffer;
    if (binding.Type == ShaderResourceType::kAccelerationStructure) {
      const auto* structure = std::get_if<Structure>(&bound);
      if (structure == nullptr) wrong_kind(binding, bound, "an acceleration structure");
      buffer = structure->buffer;
    } else if (binding.RegisterClass == 'b') {
      const auto* bytes = std::get_if<std::string>(&bound);
      if (bytes == nullptr) wrong_kind(binding, bound, "a constant buffer: give bytes or numbers");
      if (bytes->size() > binding.SizeInBytes) {
        throw py::value_error("'" + binding.Name + "' gets " + std::to_string(bytes->size()) +
                              " bytes, and has " + std::to_string(binding.SizeInBytes));
      }
      std::vector<std::byte> padded((binding.SizeInBytes + 255) / 256 * 256);
      std::memcpy(padded.data(), bytes->data(), bytes->size());
      buffer = rtapi::CreateUploadBuffer(device_, padded, binding.Name).value();
    } else {
      const auto* array = std::get_if<ArrayBuffer>(&bound);
      if (array == nullptr) wrong_kind(binding, bound, "a buffer");
      buffer = array->buffer;
      if (binding.IsWritable) {
        list.ResourceBarrier(rtapi::ResourceBarrier::Transition(
            buffer, rtapi::ResourceStates::kCommon, rtapi::ResourceStates::kUnorderedAccess));
      }
    }
    arguments.descriptor(parameter++, binding.RegisterClass, buffer.GetGPUVirtualAddress());
    out.alive.emplace_back(buffer);
  }
  return out;
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
  const py::gil_scoped_release released;
  queue_.ExecuteAndWait(list).value();
}

std::vector<Message> Session::take_messages() {
  const std::lock_guard lock(*mutex_);
  return std::exchange(*messages_, {});
}

}  // namespace kaamos::python
