// SPDX-License-Identifier: MIT
#include "d3d12/container/root_signature_blob.h"

#include <cstring>

#include "d3d12/com/errors.h"
#include "d3d12/container/container.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint32_t kPart = 0x30535452;  // "RTS0"
constexpr uint32_t kHeaderBytes = 24;
constexpr uint32_t kParameterBytes = 12;

// rtapi's static sampler has the bytes of D3D12's; so has the part. Flags are new in version 1.2.
static_assert(sizeof(rtapi::StaticSamplerDesc) == sizeof(D3D12_STATIC_SAMPLER_DESC1));
static_assert(sizeof(D3D12_ROOT_SIGNATURE_DESC2) == sizeof(D3D12_ROOT_SIGNATURE_DESC1));
constexpr uint32_t kSamplerBytes = sizeof(D3D12_STATIC_SAMPLER_DESC);
constexpr uint32_t kSamplerBytes1 = sizeof(D3D12_STATIC_SAMPLER_DESC1);

constexpr char kVersions[] = "1 (1.0), 2 (1.1) and 3 (1.2)";

bool is_version(uint32_t version) {
  return version >= D3D_ROOT_SIGNATURE_VERSION_1_0 && version <= D3D_ROOT_SIGNATURE_VERSION_1_2;
}
uint32_t sampler_bytes(uint32_t version) {
  return version >= D3D_ROOT_SIGNATURE_VERSION_1_2 ? kSamplerBytes1 : kSamplerBytes;
}

rtapi::Error bad(const std::string& detail) {
  return make_error(ErrorId::kRootSignatureBlob, detail);
}

// ---------------------------------------------------------------------------------------------
// D3D12's structures

// Both versions of a structure differ in Flags alone.
template <class Range>
rtapi::DescriptorRange range_of(const Range& range) {
  rtapi::DescriptorRange out;
  out.RangeType = static_cast<rtapi::DescriptorRangeType>(range.RangeType);
  out.NumDescriptors = range.NumDescriptors;
  out.BaseShaderRegister = range.BaseShaderRegister;
  out.RegisterSpace = range.RegisterSpace;
  out.OffsetInDescriptorsFromTableStart = range.OffsetInDescriptorsFromTableStart;
  if constexpr (requires { range.Flags; }) {
    out.Flags = static_cast<rtapi::DescriptorRangeFlags>(range.Flags);
  }
  return out;
}

template <class Parameter>
rtapi::Result<rtapi::RootParameter> parameter_of(const Parameter& parameter, uint32_t index) {
  rtapi::RootParameter out;
  out.ParameterType = static_cast<rtapi::RootParameterType>(parameter.ParameterType);
  out.ShaderVisibility = static_cast<rtapi::ShaderVisibility>(parameter.ShaderVisibility);
  switch (parameter.ParameterType) {
    case D3D12_ROOT_PARAMETER_TYPE_DESCRIPTOR_TABLE: {
      const auto& table = parameter.DescriptorTable;
      if (table.NumDescriptorRanges != 0 && table.pDescriptorRanges == nullptr) {
        return bad("parameter " + std::to_string(index) + ": pDescriptorRanges is null.");
      }
      for (UINT i = 0; i < table.NumDescriptorRanges; ++i) {
        out.DescriptorTable.Ranges.push_back(range_of(table.pDescriptorRanges[i]));
      }
      return out;
    }
    case D3D12_ROOT_PARAMETER_TYPE_32BIT_CONSTANTS:
      out.Constants = {parameter.Constants.ShaderRegister, parameter.Constants.RegisterSpace,
                       parameter.Constants.Num32BitValues};
      return out;
    case D3D12_ROOT_PARAMETER_TYPE_CBV:
    case D3D12_ROOT_PARAMETER_TYPE_SRV:
    case D3D12_ROOT_PARAMETER_TYPE_UAV:
      out.Descriptor.ShaderRegister = parameter.Descriptor.ShaderRegister;
      out.Descriptor.RegisterSpace = parameter.Descriptor.RegisterSpace;
      if constexpr (requires { parameter.Descriptor.Flags; }) {
        out.Descriptor.Flags = static_cast<rtapi::RootDescriptorFlags>(parameter.Descriptor.Flags);
      }
      return out;
    default:
      return bad("parameter " + std::to_string(index) + ": ParameterType is " +
                 std::to_string(parameter.ParameterType) + "; it is 0 to 4.");
  }
}

template <class Desc>
rtapi::Result<rtapi::RootSignatureDesc> desc_of(const Desc& desc) {
  if ((desc.NumParameters != 0 && desc.pParameters == nullptr) ||
      (desc.NumStaticSamplers != 0 && desc.pStaticSamplers == nullptr)) {
    return bad("pParameters or pStaticSamplers is null, though there are some.");
  }
  rtapi::RootSignatureDesc out;
  for (UINT i = 0; i < desc.NumParameters; ++i) {
    auto parameter = parameter_of(desc.pParameters[i], i);
    if (!parameter) return parameter.error();
    out.Parameters.push_back(*std::move(parameter));
  }
  for (UINT i = 0; i < desc.NumStaticSamplers; ++i) {
    rtapi::StaticSamplerDesc sampler;
    std::memcpy(static_cast<void*>(&sampler), &desc.pStaticSamplers[i],
                sizeof(desc.pStaticSamplers[i]));
    out.StaticSamplers.push_back(sampler);
  }
  out.Flags = static_cast<rtapi::RootSignatureFlags>(desc.Flags);
  return out;
}

// ---------------------------------------------------------------------------------------------
// Bytes

class Writer {
 public:
  uint32_t size() const { return static_cast<uint32_t>(bytes_.size()); }
  void put(uint32_t value) {
    bytes_.resize(bytes_.size() + sizeof(value));
    put_at(size() - sizeof(value), value);
  }
  void put_at(size_t offset, uint32_t value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof(value));
  }
  void put(const void* data, size_t count) {
    const auto* from = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), from, from + count);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

// Reads 32-bit numbers, and remembers where the first was that is not there.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  uint32_t get(uint64_t offset) {
    uint32_t value = 0;
    if (offset + sizeof(value) > bytes_.size()) {
      if (!failed_) failed_ = offset;
      return 0;
    }
    std::memcpy(&value, bytes_.data() + offset, sizeof(value));
    return value;
  }
  /// Returns whether `count` elements of `stride` bytes lie inside; asked before anything is made
  /// of them.
  bool holds(uint64_t offset, uint64_t count, uint64_t stride) {
    const bool inside = offset <= bytes_.size() && count * stride <= bytes_.size() - offset;
    if (!inside && !failed_) failed_ = offset;
    return inside;
  }
  const std::byte* at(uint64_t offset) const { return bytes_.data() + offset; }
  std::optional<uint64_t> failed() const { return failed_; }

 private:
  std::span<const std::byte> bytes_;
  std::optional<uint64_t> failed_;
};

void write_payload(Writer& out, const rtapi::RootParameter& parameter, bool flags) {
  switch (parameter.ParameterType) {
    case rtapi::RootParameterType::kDescriptorTable:
      out.put(static_cast<uint32_t>(parameter.DescriptorTable.Ranges.size()));
      out.put(out.size() + sizeof(uint32_t));  // the ranges follow
      for (const rtapi::DescriptorRange& range : parameter.DescriptorTable.Ranges) {
        out.put(static_cast<uint32_t>(range.RangeType));
        out.put(range.NumDescriptors);
        out.put(range.BaseShaderRegister);
        out.put(range.RegisterSpace);
        if (flags) out.put(static_cast<uint32_t>(range.Flags));
        out.put(range.OffsetInDescriptorsFromTableStart);
      }
      break;
    case rtapi::RootParameterType::k32BitConstants:
      out.put(parameter.Constants.ShaderRegister);
      out.put(parameter.Constants.RegisterSpace);
      out.put(parameter.Constants.Num32BitValues);
      break;
    default:
      out.put(parameter.Descriptor.ShaderRegister);
      out.put(parameter.Descriptor.RegisterSpace);
      if (flags) out.put(static_cast<uint32_t>(parameter.Descriptor.Flags));
  }
}

rtapi::RootParameter read_parameter(Reader& in, uint32_t at, bool flags) {
  rtapi::RootParameter out;
  out.ParameterType = static_cast<rtapi::RootParameterType>(in.get(at));
  out.ShaderVisibility = static_cast<rtapi::ShaderVisibility>(in.get(at + 4));
  const uint32_t payload = in.get(at + 8);
  switch (out.ParameterType) {
    case rtapi::RootParameterType::kDescriptorTable: {
      const uint32_t count = in.get(payload);
      const uint32_t ranges = in.get(uint64_t{payload} + 4);
      const uint32_t stride = flags ? 24 : 20;
      if (!in.holds(ranges, count, stride)) break;
      for (uint32_t i = 0; i < count; ++i) {
        const uint64_t r = ranges + uint64_t{i} * stride;
        rtapi::DescriptorRange range;
        range.RangeType = static_cast<rtapi::DescriptorRangeType>(in.get(r));
        range.NumDescriptors = in.get(r + 4);
        range.BaseShaderRegister = in.get(r + 8);
        range.RegisterSpace = in.get(r + 12);
        if (flags) range.Flags = static_cast<rtapi::DescriptorRangeFlags>(in.get(r + 16));
        range.OffsetInDescriptorsFromTableStart = in.get(r + stride - 4);
        out.DescriptorTable.Ranges.push_back(range);
      }
      break;
    }
    case rtapi::RootParameterType::k32BitConstants:
      out.Constants = {in.get(payload), in.get(uint64_t{payload} + 4),
                       in.get(uint64_t{payload} + 8)};
      break;
    default:
      out.Descriptor.ShaderRegister = in.get(payload);
      out.Descriptor.RegisterSpace = in.get(uint64_t{payload} + 4);
      if (flags) {
        out.Descriptor.Flags =
            static_cast<rtapi::RootDescriptorFlags>(in.get(uint64_t{payload} + 8));
      }
  }
  return out;
}

}  // namespace

D3D12_ROOT_SIGNATURE_DESC2 desc_1_2(const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc) {
  D3D12_ROOT_SIGNATURE_DESC2 out;
  std::memcpy(&out, &desc.Desc_1_1, sizeof(out));
  return out;
}

rtapi::Result<rtapi::RootSignatureDesc> root_signature_desc(
    const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc) {
  if (desc.Version == D3D_ROOT_SIGNATURE_VERSION_1_0) return desc_of(desc.Desc_1_0);
  if (desc.Version == D3D_ROOT_SIGNATURE_VERSION_1_1) return desc_of(desc.Desc_1_1);
  if (desc.Version == D3D_ROOT_SIGNATURE_VERSION_1_2) return desc_of(desc_1_2(desc));
  return bad("Version is " + std::to_string(desc.Version) + "; known are " + kVersions + ".");
}

std::vector<std::byte> write_root_signature(const rtapi::RootSignatureDesc& desc,
                                            D3D_ROOT_SIGNATURE_VERSION version) {
  const bool flags = version != D3D_ROOT_SIGNATURE_VERSION_1_0;
  const auto count = static_cast<uint32_t>(desc.Parameters.size());
  Writer out;
  out.put(static_cast<uint32_t>(version));
  out.put(count);
  out.put(kHeaderBytes);
  out.put(static_cast<uint32_t>(desc.StaticSamplers.size()));
  out.put(0);  // where the samplers are, below
  out.put(static_cast<uint32_t>(desc.Flags));
  for (const rtapi::RootParameter& parameter : desc.Parameters) {
    out.put(static_cast<uint32_t>(parameter.ParameterType));
    out.put(static_cast<uint32_t>(parameter.ShaderVisibility));
    out.put(0);  // where the rest of it is, below
  }
  for (uint32_t i = 0; i < count; ++i) {
    out.put_at(kHeaderBytes + i * kParameterBytes + 8, out.size());
    write_payload(out, desc.Parameters[i], flags);
  }
  out.put_at(16, out.size());
  for (const rtapi::StaticSamplerDesc& sampler : desc.StaticSamplers) {
    out.put(&sampler, sampler_bytes(version));
  }
  return out.take();
}

rtapi::Result<rtapi::RootSignatureDesc> read_root_signature(std::span<const std::byte> part,
                                                            D3D_ROOT_SIGNATURE_VERSION* version) {
  Reader in(part);
  const uint32_t number = in.get(0);
  if (!is_version(number)) {
    return bad("it has version " + std::to_string(number) + "; known are " + kVersions + ".");
  }
  const uint32_t parameters = in.get(4), parameters_at = in.get(8);
  const uint32_t samplers = in.get(12), samplers_at = in.get(16);
  rtapi::RootSignatureDesc desc;
  desc.Flags = static_cast<rtapi::RootSignatureFlags>(in.get(20));
  if (in.holds(parameters_at, parameters, kParameterBytes)) {
    for (uint32_t i = 0; i < parameters; ++i) {
      desc.Parameters.push_back(
          read_parameter(in, parameters_at + i * kParameterBytes, number != 1));
      if (const auto type = desc.Parameters.back().ParameterType;
          type > rtapi::RootParameterType::kUav) {
        return bad("parameter " + std::to_string(i) + " has type " +
                   std::to_string(static_cast<uint32_t>(type)) + "; it is 0 to 4.");
      }
    }
  }
  const uint32_t stride = sampler_bytes(number);
  if (in.holds(samplers_at, samplers, stride)) {
    desc.StaticSamplers.resize(samplers);
    for (uint32_t i = 0; i < samplers; ++i) {
      std::memcpy(static_cast<void*>(&desc.StaticSamplers[i]),
                  in.at(samplers_at + uint64_t{i} * stride), stride);
    }
  }
  if (const auto failed = in.failed()) {
    return bad("it refers to byte " + std::to_string(*failed) + " of " +
               std::to_string(part.size()) + ".");
  }
  if (version != nullptr) *version = static_cast<D3D_ROOT_SIGNATURE_VERSION>(number);
  return desc;
}

rtapi::Result<rtapi::RootSignatureDesc> root_signature_of_blob(
    const void* blob, size_t size, D3D_ROOT_SIGNATURE_VERSION* version) {
  if (blob == nullptr) return bad("the blob is null.");
  constexpr char kMagic[4] = {'D', 'X', 'B', 'C'};
  if (size < sizeof(kMagic) || std::memcmp(blob, kMagic, sizeof(kMagic)) != 0) {
    return read_root_signature({static_cast<const std::byte*>(blob), size}, version);
  }
  const auto parts = read_container(blob, size);
  if (!parts) return parts.error();
  for (const Part& part : *parts) {
    if (part.fourcc == kPart) return read_root_signature(part.bytes, version);
  }
  return bad("the container has no part RTS0: the shader was compiled without a root signature.");
}

// ---------------------------------------------------------------------------------------------
// Back to D3D12's structures

RootSignatureTree::RootSignatureTree(const rtapi::RootSignatureDesc& desc,
                                     D3D_ROOT_SIGNATURE_VERSION version,
                                     D3D_ROOT_SIGNATURE_VERSION source) {
  const bool adds_flags = source == D3D_ROOT_SIGNATURE_VERSION_1_0;
  const auto fill = [&](auto& parameters, auto& ranges, auto& samplers, auto& out) {
    for (const rtapi::StaticSamplerDesc& sampler : desc.StaticSamplers) {
      std::memcpy(static_cast<void*>(&samplers.emplace_back()), &sampler, sizeof(samplers.back()));
    }
    for (const rtapi::RootParameter& from : desc.Parameters) {
      auto& to = parameters.emplace_back();
      to = {};
      to.ParameterType = static_cast<D3D12_ROOT_PARAMETER_TYPE>(from.ParameterType);
      to.ShaderVisibility = static_cast<D3D12_SHADER_VISIBILITY>(from.ShaderVisibility);
      auto& table = ranges.emplace_back();  // its elements stay where they are when `ranges` grows
      switch (from.ParameterType) {
        case rtapi::RootParameterType::kDescriptorTable:
          for (const rtapi::DescriptorRange& range : from.DescriptorTable.Ranges) {
            auto& r = table.emplace_back();
            r.RangeType = static_cast<D3D12_DESCRIPTOR_RANGE_TYPE>(range.RangeType);
            r.NumDescriptors = range.NumDescriptors;
            r.BaseShaderRegister = range.BaseShaderRegister;
            r.RegisterSpace = range.RegisterSpace;
            r.OffsetInDescriptorsFromTableStart = range.OffsetInDescriptorsFromTableStart;
            if constexpr (requires { r.Flags; }) {
              r.Flags = static_cast<D3D12_DESCRIPTOR_RANGE_FLAGS>(range.Flags);
              if (adds_flags) {
                r.Flags = D3D12_DESCRIPTOR_RANGE_FLAG_DESCRIPTORS_VOLATILE;
                if (r.RangeType != D3D12_DESCRIPTOR_RANGE_TYPE_SAMPLER) {
                  r.Flags |= D3D12_DESCRIPTOR_RANGE_FLAG_DATA_VOLATILE;
                }
              }
            }
          }
          to.DescriptorTable.NumDescriptorRanges = static_cast<UINT>(table.size());
          to.DescriptorTable.pDescriptorRanges = table.data();
          break;
        case rtapi::RootParameterType::k32BitConstants:
          to.Constants = {from.Constants.ShaderRegister, from.Constants.RegisterSpace,
                          from.Constants.Num32BitValues};
          break;
        default:
          to.Descriptor.ShaderRegister = from.Descriptor.ShaderRegister;
          to.Descriptor.RegisterSpace = from.Descriptor.RegisterSpace;
          if constexpr (requires { to.Descriptor.Flags; }) {
            to.Descriptor.Flags =
                adds_flags ? D3D12_ROOT_DESCRIPTOR_FLAG_DATA_VOLATILE
                           : static_cast<D3D12_ROOT_DESCRIPTOR_FLAGS>(from.Descriptor.Flags);
          }
      }
    }
    out.NumParameters = static_cast<UINT>(parameters.size());
    out.pParameters = parameters.data();
    out.NumStaticSamplers = static_cast<UINT>(samplers.size());
    out.pStaticSamplers = samplers.data();
    out.Flags = static_cast<D3D12_ROOT_SIGNATURE_FLAGS>(desc.Flags);
  };
  desc_.Version = version;
  if (version == D3D_ROOT_SIGNATURE_VERSION_1_0) {
    fill(parameters_, ranges_, samplers_, desc_.Desc_1_0);
  } else if (version == D3D_ROOT_SIGNATURE_VERSION_1_1) {
    fill(parameters1_, ranges1_, samplers_, desc_.Desc_1_1);
  } else {
    D3D12_ROOT_SIGNATURE_DESC2 newest = {};
    fill(parameters1_, ranges1_, samplers1_, newest);
    std::memcpy(&desc_.Desc_1_1, &newest, sizeof(newest));
  }
}

}  // namespace kaamos::d3d12
