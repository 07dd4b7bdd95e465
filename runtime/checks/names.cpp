// SPDX-License-Identifier: MIT
#include "runtime/checks/names.h"

#include <cstdio>
#include <iterator>

namespace kaamos::checks {
namespace {

const char* register_letter(shader::RegisterClass register_class) {
  switch (register_class) {
    case shader::RegisterClass::kShaderResource:
      return "t";
    case shader::RegisterClass::kUnorderedAccess:
      return "u";
    case shader::RegisterClass::kConstantBuffer:
      return "b";
    case shader::RegisterClass::kSampler:
      return "s";
  }
  return "?";
}

// Finds the record of a table that contains `address`.
bool find_record(const rtapi::GpuVirtualAddressRangeAndStride& table, uint64_t address,
                 uint64_t& index) {
  if (table.StartAddress == 0 || address < table.StartAddress) return false;
  const uint64_t offset = address - table.StartAddress;
  if (offset >= table.SizeInBytes) return false;
  index = table.StrideInBytes == 0 ? 0 : offset / table.StrideInBytes;
  return true;
}

}  // namespace

std::string buffer_name(const runtime::Allocation& allocation) {
  return (allocation.name.empty() ? std::string("an unnamed buffer")
                                  : "buffer " + in_quotes(allocation.name)) +
         " (" + std::to_string(allocation.size_bytes) + " bytes)";
}

std::string address_name(const runtime::AddressMap& addresses, uint64_t address) {
  if (address == 0) return "address 0";
  const auto allocation = addresses.find(address);
  if (!allocation) return "address " + hex(address) + ", which is in no live buffer";
  return "byte " + std::to_string(address - allocation->address) + " of " +
         buffer_name(*allocation);
}

std::string range_name(const runtime::AddressMap& addresses, uint64_t address,
                       uint64_t size_bytes) {
  const auto allocation = addresses.find(address);
  if (!allocation) {
    return std::to_string(size_bytes) + " bytes at address " + hex(address) +
           ", which is in no live buffer";
  }
  const uint64_t first = address - allocation->address;
  return "bytes " + std::to_string(first) + ".." + std::to_string(first + size_bytes) + " of " +
         buffer_name(*allocation);
}

const char* stage_name(shader::Stage stage) {
  switch (stage) {
    case shader::Stage::kPixel:
      return "pixel";
    case shader::Stage::kVertex:
      return "vertex";
    case shader::Stage::kGeometry:
      return "geometry";
    case shader::Stage::kCompute:
      return "compute";
    case shader::Stage::kLibrary:
      return "library";
    case shader::Stage::kRayGeneration:
      return "ray generation";
    case shader::Stage::kIntersection:
      return "intersection";
    case shader::Stage::kAnyHit:
      return "any-hit";
    case shader::Stage::kClosestHit:
      return "closest-hit";
    case shader::Stage::kMiss:
      return "miss";
    case shader::Stage::kCallable:
      return "callable";
  }
  return "unknown";
}

const char* record_kind_name(runtime::RecordKind kind) {
  switch (kind) {
    case runtime::RecordKind::kRayGeneration:
      return "ray generation";
    case runtime::RecordKind::kMiss:
      return "miss";
    case runtime::RecordKind::kCallable:
      return "callable";
    case runtime::RecordKind::kHitGroup:
      return "hit group";
    case runtime::RecordKind::kNone:
      break;
  }
  return "unknown";
}

std::string record_name(const rtapi::DispatchRaysDesc& desc, uint64_t address) {
  const auto& first = desc.RayGenerationShaderRecord;
  if (address >= first.StartAddress && address - first.StartAddress < first.SizeInBytes) {
    return "ray generation record";
  }
  uint64_t index = 0;
  if (find_record(desc.HitGroupTable, address, index)) {
    return "hit group table record " + std::to_string(index);
  }
  if (find_record(desc.MissShaderTable, address, index)) {
    return "miss table record " + std::to_string(index);
  }
  if (find_record(desc.CallableShaderTable, address, index)) {
    return "callable table record " + std::to_string(index);
  }
  return "";
}

std::string binding_name(const shader::BindingDesc& binding) {
  std::string text =
      register_letter(binding.register_class) + std::to_string(binding.register_index);
  if (binding.space != 0) text += ", space " + std::to_string(binding.space);
  return text + " " + in_quotes(binding.name);
}

std::string texture_name(uint32_t shape) {
  static constexpr const char* kDimensions[] = {
      "Texture1D", "Texture1DArray", "Texture2D",   "Texture2DArray",  "?",
      "?",         "Texture3D",      "TextureCube", "TextureCubeArray"};
  static constexpr const char* kNumbers[] = {"float", "int", "uint"};
  const uint32_t dimension = (shape & 0xFF) - 2;
  const uint32_t number = shape >> 8;
  return std::string(dimension < std::size(kDimensions) ? kDimensions[dimension] : "?") + " of " +
         (number < std::size(kNumbers) ? kNumbers[number] : "?");
}

std::string pixel_name(const uint32_t index[3], uint32_t depth) {
  std::string text = "pixel (" + std::to_string(index[0]) + "," + std::to_string(index[1]);
  if (depth > 1) text += "," + std::to_string(index[2]);
  return text + ")";
}

std::string format_name(rtapi::Format format) {
  using rtapi::Format;
  static constexpr std::pair<Format, const char*> kNames[] = {
      {Format::kUnknown, "UNKNOWN"},
      {Format::kR32G32B32A32Float, "R32G32B32A32_FLOAT"},
      {Format::kR32G32B32A32Uint, "R32G32B32A32_UINT"},
      {Format::kR32G32B32A32Sint, "R32G32B32A32_SINT"},
      {Format::kR16G16B16A16Float, "R16G16B16A16_FLOAT"},
      {Format::kR16G16B16A16Unorm, "R16G16B16A16_UNORM"},
      {Format::kR16G16B16A16Snorm, "R16G16B16A16_SNORM"},
      {Format::kR16G16B16A16Uint, "R16G16B16A16_UINT"},
      {Format::kR32G32Float, "R32G32_FLOAT"},
      {Format::kR32G32Uint, "R32G32_UINT"},
      {Format::kR10G10B10A2Unorm, "R10G10B10A2_UNORM"},
      {Format::kR11G11B10Float, "R11G11B10_FLOAT"},
      {Format::kR8G8B8A8Unorm, "R8G8B8A8_UNORM"},
      {Format::kR8G8B8A8UnormSrgb, "R8G8B8A8_UNORM_SRGB"},
      {Format::kR8G8B8A8Uint, "R8G8B8A8_UINT"},
      {Format::kR8G8B8A8Snorm, "R8G8B8A8_SNORM"},
      {Format::kB8G8R8A8Unorm, "B8G8R8A8_UNORM"},
      {Format::kB8G8R8A8UnormSrgb, "B8G8R8A8_UNORM_SRGB"},
      {Format::kR16G16Float, "R16G16_FLOAT"},
      {Format::kR16G16Unorm, "R16G16_UNORM"},
      {Format::kR16G16Snorm, "R16G16_SNORM"},
      {Format::kR16G16Uint, "R16G16_UINT"},
      {Format::kR32Float, "R32_FLOAT"},
      {Format::kR32Uint, "R32_UINT"},
      {Format::kR32Sint, "R32_SINT"},
      {Format::kR16Float, "R16_FLOAT"},
      {Format::kR16Unorm, "R16_UNORM"},
      {Format::kR16Uint, "R16_UINT"},
      {Format::kR8Unorm, "R8_UNORM"},
      {Format::kR8Uint, "R8_UINT"},
      {Format::kD16Unorm, "D16_UNORM"},
      {Format::kD24UnormS8Uint, "D24_UNORM_S8_UINT"},
      {Format::kD32Float, "D32_FLOAT"},
      {Format::kD32FloatS8X24Uint, "D32_FLOAT_S8X24_UINT"},
  };
  for (const auto& [known, name] : kNames) {
    if (known == format) return name;
  }
  return "DXGI format " + std::to_string(static_cast<uint32_t>(format));
}

std::string float_name(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
  return text;
}

}  // namespace kaamos::checks
