// SPDX-License-Identifier: MIT
#include "runtime/checks/arguments.h"

#include <algorithm>
#include <cstring>

#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

using shader::BindingDesc;
using shader::BindingSlot;
using shader::BindingType;
using shader::Descriptor;
using shader::DescriptorAccess;
using shader::DescriptorKind;
using shader::RegisterClass;
using shader::SlotSource;

// At most this many descriptors of an array are examined for acceleration structures. An array may
// have room for far more than is ever indexed.
constexpr uint32_t kMostDescriptors = 1024;

struct Heap {
  const Descriptor* begin = nullptr;
  uint64_t address = 0;
  uint64_t count = 0;
};

Heap heap_of(const runtime::RootBindings& state, bool samplers) {
  const auto& buffer = samplers ? state.sampler_heap : state.view_heap;
  if (buffer == nullptr || buffer->host() == nullptr) return {};
  return {reinterpret_cast<const Descriptor*>(buffer->host()), buffer->address(),
          buffer->size_bytes() / sizeof(Descriptor)};
}

bool is_sampler(const BindingDesc& binding) {
  return binding.type == BindingType::kSampler || binding.type == BindingType::kComparisonSampler;
}

// Reads the eight bytes of an address or handle; false where the record ends too early.
bool read_argument(const BindingSlot& slot, const Arguments& arguments, uint64_t& value) {
  const uint8_t* base = slot.local ? arguments.local : arguments.global;
  const uint64_t size = slot.local ? arguments.local_bytes : runtime::kRootArgumentBytes;
  if (base == nullptr || uint64_t{slot.argument_offset} + 8 > size) return false;
  std::memcpy(&value, base + slot.argument_offset, sizeof value);
  return true;
}

const char* kind_name(DescriptorKind kind) {
  switch (kind) {
    case DescriptorKind::kNull:
      return "a null descriptor";
    case DescriptorKind::kConstantBuffer:
      return "a constant buffer";
    case DescriptorKind::kRawBuffer:
      return "a raw buffer";
    case DescriptorKind::kStructuredBuffer:
      return "a structured buffer";
    case DescriptorKind::kTypedBuffer:
      return "a typed buffer";
    case DescriptorKind::kTexture:
      return "a texture";
    case DescriptorKind::kSampler:
      return "a sampler";
    case DescriptorKind::kAccelerationStructure:
      return "an acceleration structure";
  }
  return "an unknown descriptor";
}

class ArgumentCheck {
 public:
  ArgumentCheck(const ProofInputs& inputs, const runtime::LinkedShader& shader,
                const Arguments& arguments, const std::string& where)
      : inputs_(inputs), shader_(shader), arguments_(arguments), where_(where) {}

  bool run() {
    if (never_written()) return false;
    for (uint32_t i = 0; i < shader_.slots.size(); ++i) {
      const BindingSlot& slot = shader_.slots[i];
      uint64_t value = 0;
      if (slot.source == SlotSource::kRootDescriptor && read_argument(slot, arguments_, value)) {
        check_root_descriptor(shader_.library->bindings[i], slot, value);
      }
      if (slot.source == SlotSource::kDescriptorTable && read_argument(slot, arguments_, value)) {
        check_table(shader_.library->bindings[i], slot, value);
      }
    }
    return good_;
  }

 private:
  void report(Id id, const std::string& text) {
    inputs_.reporter.report(id, text);
    good_ = false;
  }
  std::string parameter(const BindingDesc& binding, const BindingSlot& slot) const {
    return where_ + ", " + (slot.local ? "local" : "global") + " parameter " +
           binding_name(binding);
  }

  // All addresses are 0, and so are all constants: nobody wrote this record.
  bool never_written() {
    std::string unset;
    for (uint32_t i = 0; i < shader_.slots.size(); ++i) {
      const BindingSlot& slot = shader_.slots[i];
      const bool pointer =
          slot.source == SlotSource::kRootDescriptor || slot.source == SlotSource::kDescriptorTable;
      if (!slot.local || !pointer) continue;
      unset += (unset.empty() ? "" : ", ") + binding_name(shader_.library->bindings[i]);
    }
    const uint64_t bytes = std::min<uint64_t>(shader_.local_argument_bytes, arguments_.local_bytes);
    if (unset.empty() || arguments_.local == nullptr || bytes == 0) return false;
    if (std::any_of(arguments_.local, arguments_.local + bytes, [](uint8_t b) { return b != 0; })) {
      return false;
    }
    report(Id::kRecordNeverWritten,
           where_ + ": all " + std::to_string(shader_.local_argument_bytes) +
               " bytes of arguments after the identifier are 0, but the shader reads " + unset +
               ". Write the arguments of the local root signature after the identifier, from "
               "byte 32 of the record on.");
    return true;
  }

  void check_root_descriptor(const BindingDesc& binding, const BindingSlot& slot, uint64_t value) {
    if (value == 0 || binding.type == BindingType::kAccelerationStructure) return;
    const auto allocation = inputs_.addresses.find(value);
    if (!allocation) {
      return report(Id::kRecordArgument,
                    parameter(binding, slot) + ": the root descriptor is " + hex(value) +
                        ", which is in no live buffer. Was the buffer freed, or are the "
                        "arguments laid out in another order than the root signature's?");
    }
    const bool constants = binding.type == BindingType::kConstantBuffer;
    const uint64_t alignment = constants ? 256 : 4;
    if (value % alignment != 0) {
      report(Id::kRecordArgumentKind, parameter(binding, slot) + ": the root descriptor is " +
                                          address_name(inputs_.addresses, value) + "; " +
                                          (constants ? "a constant buffer" : "a buffer") +
                                          " must start at a multiple of " +
                                          std::to_string(alignment) + ".");
    }
    if (binding.register_class == RegisterClass::kUnorderedAccess &&
        !rtapi::HasAny(allocation->flags, rtapi::ResourceFlags::kAllowUnorderedAccess)) {
      report(
          Id::kRecordArgumentKind,
          parameter(binding, slot) + ": the root descriptor is " +
              address_name(inputs_.addresses, value) +
              ", which was created without kAllowUnorderedAccess, but the shader may write there.");
    }
  }

  void check_table(const BindingDesc& binding, const BindingSlot& slot, uint64_t value) {
    const bool samplers = is_sampler(binding);
    const Heap heap = heap_of(*arguments_.state, samplers);
    const char* heap_kind = samplers ? "sampler" : "CBV/SRV/UAV";
    const uint64_t offset = value - heap.address;
    const uint64_t first = offset / sizeof(Descriptor);
    if (heap.begin == nullptr || value < heap.address || first >= heap.count ||
        offset % sizeof(Descriptor) != 0) {
      return report(
          Id::kRecordArgument,
          parameter(binding, slot) + ": the descriptor table is handle " + hex(value) +
              (heap.begin == nullptr
                   ? std::string(", but no ") + heap_kind + " heap is set. Call SetDescriptorHeaps."
                   : std::string(", which is not in the ") + heap_kind +
                         " heap that is set. Is it the handle of another heap, or a CPU "
                         "handle?"));
    }
    const uint64_t index = first + slot.descriptor_index;
    if (binding.count != 1) return;  // which elements of an array are read is unknown
    if (index >= heap.count) {
      return report(Id::kRecordArgument, parameter(binding, slot) + ": descriptor " +
                                             std::to_string(index) + " is outside the " +
                                             heap_kind + " heap, which has " +
                                             std::to_string(heap.count) + ".");
    }
    check_descriptor(binding, slot, heap.begin[index], index);
  }

  void check_descriptor(const BindingDesc& binding, const BindingSlot& slot,
                        const Descriptor& descriptor, uint64_t index) {
    if (descriptor.kind == DescriptorKind::kNull) return;
    const DescriptorKind wanted = slot.kind;
    const std::string place =
        parameter(binding, slot) + ": descriptor " + std::to_string(index) + " of the heap is ";
    if (descriptor.kind != wanted) {
      return report(Id::kRecordArgumentKind, place + kind_name(descriptor.kind) +
                                                 ", but the shader declares " + kind_name(wanted) +
                                                 ". Does the table start at the right descriptor?");
    }
    const bool buffer =
        wanted == DescriptorKind::kConstantBuffer || wanted == DescriptorKind::kRawBuffer ||
        wanted == DescriptorKind::kStructuredBuffer || wanted == DescriptorKind::kTypedBuffer;
    if (buffer && descriptor.address != 0 && !inputs_.addresses.find(descriptor.address)) {
      report(Id::kRecordArgument, place + "a view of a buffer that has been freed, at address " +
                                      hex(descriptor.address) + ".");
    }
    const bool writable = binding.register_class == RegisterClass::kUnorderedAccess;
    const bool view =
        wanted != DescriptorKind::kSampler && wanted != DescriptorKind::kConstantBuffer;
    if (view && writable != (view_access(descriptor) == DescriptorAccess::kUnorderedAccess)) {
      report(Id::kRecordArgumentKind,
             place + (writable ? "a shader resource view, but the shader declares an unordered "
                                 "access view."
                               : "an unordered access view, but the shader declares a shader "
                                 "resource view."));
    }
    if (wanted == DescriptorKind::kTexture) {
      check_shape(place, descriptor.stride_bytes, slot.stride_bytes);
    }
  }

  void check_shape(const std::string& place, uint32_t view, uint32_t declared) {
    if (declared == 0 || view == declared) return;
    const bool fits = shader::fits_shape(view, declared);
    report(Id::kRecordArgumentKind,
           place + "a view as " + texture_name(view) + ", but the shader declares " +
               texture_name(declared) + ": their " +
               ((view & 0xFF) != (declared & 0xFF) ? "dimensions" : "numbers") + " differ. " +
               (fits ? "It reads the first element of the array, and D3D12 leaves it undefined."
                     : "It reads as a null descriptor."));
  }

  const ProofInputs& inputs_;
  const runtime::LinkedShader& shader_;
  const Arguments& arguments_;
  const std::string& where_;
  bool good_ = true;
};

}  // namespace

bool check_arguments(const ProofInputs& inputs, const runtime::LinkedShader& shader,
                     const Arguments& arguments, const std::string& where) {
  return ArgumentCheck(inputs, shader, arguments, where).run();
}

std::vector<uint64_t> structures_behind(const runtime::LinkedShader& shader, uint32_t binding,
                                        const Arguments& arguments) {
  std::vector<uint64_t> out;
  if (binding >= shader.slots.size()) return out;
  const BindingSlot& slot = shader.slots[binding];
  uint64_t value = 0;
  if (slot.source == SlotSource::kRootDescriptor) {
    if (read_argument(slot, arguments, value)) out.push_back(value);
    return out;
  }
  if (slot.source != SlotSource::kDescriptorTable || !read_argument(slot, arguments, value)) {
    return out;
  }
  const Heap heap = heap_of(*arguments.state, false);
  if (heap.begin == nullptr || value < heap.address ||
      (value - heap.address) % sizeof(Descriptor) != 0) {
    return out;
  }
  const uint64_t first = (value - heap.address) / sizeof(Descriptor) + slot.descriptor_index;
  const uint32_t count =
      std::min({slot.descriptor_count, shader.library->bindings[binding].count, kMostDescriptors});
  for (uint64_t i = first; i < std::min<uint64_t>(first + count, heap.count); ++i) {
    if (heap.begin[i].kind == DescriptorKind::kAccelerationStructure) {
      out.push_back(heap.begin[i].address);
    }
  }
  return out;
}

void collect_uses(const runtime::LinkedShader& shader, const Arguments& arguments,
                  const std::string& shader_name, std::vector<ShaderUse>& uses) {
  using rtapi::ResourceStates;
  for (uint32_t i = 0; i < shader.slots.size(); ++i) {
    const BindingSlot& slot = shader.slots[i];
    const BindingDesc& binding = shader.library->bindings[i];
    if (slot.source == SlotSource::kUnbound || binding.count != 1) continue;
    ShaderUse use;
    use.what = shader_name + ", " + binding_name(binding);
    if (binding.type == BindingType::kAccelerationStructure) {
      use.structure = true;
      for (const uint64_t address : structures_behind(shader, i, arguments)) {
        use.address = address;
        if (address != 0) uses.push_back(use);
      }
      continue;
    }
    use.state = binding.type == BindingType::kConstantBuffer
                    ? ResourceStates::kVertexAndConstantBuffer
                : binding.register_class == RegisterClass::kUnorderedAccess
                    ? ResourceStates::kUnorderedAccess
                : shader.stage == shader::Stage::kPixel ? ResourceStates::kPixelShaderResource
                                                        : ResourceStates::kNonPixelShaderResource;
    uint64_t value = 0;
    if (slot.source == SlotSource::kRootDescriptor && read_argument(slot, arguments, value)) {
      use.address = value;
    } else if (slot.source == SlotSource::kDescriptorTable &&
               read_argument(slot, arguments, value)) {
      const Heap heap = heap_of(*arguments.state, is_sampler(binding));
      const uint64_t index = (value - heap.address) / sizeof(Descriptor) + slot.descriptor_index;
      if (heap.begin == nullptr || value < heap.address || index >= heap.count) continue;
      const Descriptor& descriptor = heap.begin[index];
      const bool buffer = descriptor.kind == DescriptorKind::kConstantBuffer ||
                          descriptor.kind == DescriptorKind::kRawBuffer ||
                          descriptor.kind == DescriptorKind::kStructuredBuffer ||
                          descriptor.kind == DescriptorKind::kTypedBuffer;
      if (buffer) use.address = descriptor.address;
      if (descriptor.kind == DescriptorKind::kTexture && descriptor.address != 0) {
        const bool writable = descriptor.access == DescriptorAccess::kUnorderedAccess;
        use.texture = true;
        use.address = shader::view_key(descriptor.address, writable);
      }
    }
    if (use.address != 0) uses.push_back(std::move(use));
  }
}

}  // namespace kaamos::checks
