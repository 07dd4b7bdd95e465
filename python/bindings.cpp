// SPDX-License-Identifier: MIT
//
// Resources by their names in HLSL: the root signature of a library, and the arguments of a call.
#include <rtapi/upload.h>

#include <algorithm>
#include <cstring>

#include "python/session.h"

namespace kaamos::python {
namespace {

using rtapi::ShaderBindingInfo;
using rtapi::ShaderResourceType;

bool is_root_descriptor(const ShaderBindingInfo& binding) {
  return binding.Type == ShaderResourceType::kConstantBuffer ||
         binding.Type == ShaderResourceType::kByteAddressBuffer ||
         binding.Type == ShaderResourceType::kStructuredBuffer ||
         binding.Type == ShaderResourceType::kAccelerationStructure;
}
// What has a descriptor.
bool is_view(const ShaderBindingInfo& binding) {
  return binding.Type == ShaderResourceType::kTexture2D ||
         binding.Type == ShaderResourceType::kBuffer;
}
bool is_sampler(const ShaderBindingInfo& binding) {
  return binding.Type == ShaderResourceType::kSampler ||
         binding.Type == ShaderResourceType::kComparisonSampler;
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
                                    "a Sampler", "constants"};
  return kNames[bound.index()];
}

[[noreturn]] void wrong_kind(const ShaderBindingInfo& binding, const Bound& bound,
                             const char* wanted) {
  throw py::type_error("'" + binding.Name + "' is " + what_is(bound) + ", and the shader has " +
                       wanted);
}

// A heap with a descriptor for each of the bindings; empty for none.
rtapi::DescriptorHeap heap_for(const rtapi::Device& device, rtapi::DescriptorHeapType type,
                               const std::vector<ShaderBindingInfo>& bindings,
                               bool (*counts)(const ShaderBindingInfo&)) {
  const auto count = static_cast<uint32_t>(std::count_if(bindings.begin(), bindings.end(), counts));
  if (count == 0) return {};
  return device
      .CreateDescriptorHeap({.Type = type,
                             .NumDescriptors = count,
                             .Flags = rtapi::DescriptorHeapFlags::kShaderVisible})
      .value();
}

void write_sampler(const rtapi::Device& device, const ShaderBindingInfo& binding,
                   const Bound* bound, rtapi::CpuDescriptorHandle to) {
  const bool compares = binding.Type == ShaderResourceType::kComparisonSampler;
  if (bound == nullptr) {
    if (compares) throw py::type_error("the shader's '" + binding.Name + "' is not given");
    return device.CreateSampler({}, to).value();
  }
  const auto* desc = std::get_if<rtapi::SamplerDesc>(bound);
  if (desc == nullptr) wrong_kind(binding, *bound, "a sampler");
  if (compares != (desc->ComparisonFunc != rtapi::ComparisonFunc::kNever)) {
    throw py::type_error("'" + binding.Name + "' is a " +
                         (compares ? "SamplerComparisonState: give its Sampler a 'compare'"
                                   : "SamplerState, and its Sampler has a 'compare'"));
  }
  device.CreateSampler(*desc, to).value();
}

// The format of a typed buffer: the array's type, with its last axis as channels.
rtapi::Format element_format(const ArrayBuffer& array) {
  const bool has_channels = array.shape.size() > 1 && array.shape.back() <= 4;
  return format_of(array.type, has_channels ? array.shape.back() : 1);
}

const ArrayBuffer& buffer_of(const ShaderBindingInfo& binding, const Bound& bound) {
  const auto* array = std::get_if<ArrayBuffer>(&bound);
  if (array == nullptr) wrong_kind(binding, bound, "a buffer");
  return *array;
}

// Writes the descriptor of a texture or a typed buffer, and returns what it shows.
rtapi::Resource write_view(const rtapi::Device& device, const ShaderBindingInfo& binding,
                           const Bound& bound, rtapi::CpuDescriptorHandle to) {
  if (binding.Type == ShaderResourceType::kTexture2D) {
    const auto* texture = std::get_if<ArrayTexture>(&bound);
    if (texture == nullptr) wrong_kind(binding, bound, "a texture");
    binding.IsWritable ? device.CreateUnorderedAccessView(texture->texture, to).value()
                       : device.CreateShaderResourceView(texture->texture, to).value();
    return texture->texture;
  }
  const ArrayBuffer& array = buffer_of(binding, bound);
  const rtapi::Format format = element_format(array);
  const auto count =
      static_cast<uint32_t>(array.buffer.size() / rtapi::GetFormatInfo(format).bytes);
  if (binding.IsWritable) {
    rtapi::UnorderedAccessViewDesc desc;
    desc.Format = format;
    desc.ViewDimension = rtapi::UavDimension::kBuffer;
    desc.Buffer.NumElements = count;
    device.CreateUnorderedAccessView(array.buffer, desc, to).value();
  } else {
    rtapi::ShaderResourceViewDesc desc;
    desc.Format = format;
    desc.ViewDimension = rtapi::SrvDimension::kBuffer;
    desc.Buffer.NumElements = count;
    device.CreateShaderResourceView(array.buffer, desc, to).value();
  }
  return array.buffer;
}

// Brings a resource from the common state into the one that shaders use it in, and notes for
// textures how to undo it; buffers go back by themselves.
void enter_state(rtapi::CommandList& list, const ShaderBindingInfo& binding,
                 const rtapi::Resource& resource, BoundResources& out) {
  const auto common = rtapi::ResourceStates::kCommon;
  if (std::holds_alternative<rtapi::Buffer>(resource)) {
    if (!binding.IsWritable) return;
    list.ResourceBarrier(rtapi::ResourceBarrier::Transition(resource, common, state_for(binding)));
    return;
  }
  list.ResourceBarrier(rtapi::ResourceBarrier::Transition(resource, common, state_for(binding)));
  out.undo.push_back(rtapi::ResourceBarrier::Transition(resource, state_for(binding), common));
}

// The buffer of a root descriptor.
rtapi::Buffer root_buffer(const rtapi::Device& device, const ShaderBindingInfo& binding,
                          const Bound& bound) {
  if (binding.Type == ShaderResourceType::kAccelerationStructure) {
    const auto* structure = std::get_if<Structure>(&bound);
    if (structure == nullptr) wrong_kind(binding, bound, "an acceleration structure");
    return structure->buffer;
  }
  if (binding.RegisterClass != 'b') return buffer_of(binding, bound).buffer;
  const auto* bytes = std::get_if<std::string>(&bound);
  if (bytes == nullptr) wrong_kind(binding, bound, "a constant buffer: give bytes or numbers");
  if (bytes->size() > binding.SizeInBytes) {
    throw py::value_error("'" + binding.Name + "' gets " + std::to_string(bytes->size()) +
                          " bytes, and has " + std::to_string(binding.SizeInBytes));
  }
  std::vector<std::byte> padded((binding.SizeInBytes + 255) / 256 * 256);
  std::memcpy(padded.data(), bytes->data(), bytes->size());
  return rtapi::CreateUploadBuffer(device, padded, binding.Name).value();
}

}  // namespace

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
    } else if (is_view(binding)) {
      one = std::string("DescriptorTable(") + view_text(binding) + "(" + place + "))";
    } else if (is_sampler(binding)) {
      one = "DescriptorTable(Sampler(" + place + "))";
    }
    if (one.empty()) {
      throw py::type_error("'" + binding.Name +
                           "' of the shader cannot be bound from Python: constant, raw, structured "
                           "and typed buffers, Texture2D, RWTexture2D, samplers and acceleration "
                           "structures can");
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
  out.heap = heap_for(device_, rtapi::DescriptorHeapType::kCbvSrvUav, bindings, is_view);
  out.samplers = heap_for(device_, rtapi::DescriptorHeapType::kSampler, bindings, is_sampler);
  std::vector<rtapi::DescriptorHeap> heaps;
  for (const rtapi::DescriptorHeap& heap : {out.heap, out.samplers}) {
    if (heap) heaps.push_back(heap);
  }
  if (!heaps.empty()) list.SetDescriptorHeaps(heaps);
  const RootArguments arguments = {list, root == Root::kGraphics};
  arguments.signature(signature);
  uint32_t parameter = 0, view = 0, sampler = 0;
  for (const ShaderBindingInfo& binding : bindings) {
    if (is_local(binding, local)) continue;
    const auto found = given.find(binding.Name);
    if (is_sampler(binding)) {
      write_sampler(device_, binding, found == given.end() ? nullptr : &found->second,
                    out.samplers.GetCPUDescriptorHandle(sampler));
      arguments.table(parameter++, out.samplers.GetGPUDescriptorHandle(sampler++));
      continue;
    }
    if (found == given.end()) {
      throw py::type_error("the shader's '" + binding.Name + "' is not given");
    }
    const Bound& bound = found->second;
    if (is_view(binding)) {
      const rtapi::Resource viewed =
          write_view(device_, binding, bound, out.heap.GetCPUDescriptorHandle(view));
      enter_state(list, binding, viewed, out);
      arguments.table(parameter++, out.heap.GetGPUDescriptorHandle(view++));
      out.alive.push_back(viewed);
      continue;
    }
    const rtapi::Buffer buffer = root_buffer(device_, binding, bound);
    if (binding.IsWritable) enter_state(list, binding, buffer, out);
    arguments.descriptor(parameter++, binding.RegisterClass, buffer.GetGPUVirtualAddress());
    out.alive.emplace_back(buffer);
  }
  return out;
}

}  // namespace kaamos::python
