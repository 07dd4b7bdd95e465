// SPDX-License-Identifier: MIT
#include <rtapi/root_signature.h>

#include <algorithm>

#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/resources/sampler.h"

namespace rtapi {

namespace detail {

namespace {

using shader::RegisterClass;

constexpr uint32_t kDefinedFlags = 0xFFF;
constexpr uint64_t kRegisterEnd = uint64_t{1} << 32;
// Spaces 0xFFFFFFF0 and up are reserved. [D3D12: root signatures]
constexpr uint32_t kReservedSpaces = 0xFFFFFFF0u;

RegisterClass class_of(DescriptorRangeType type) {
  switch (type) {
    case DescriptorRangeType::kUav:
      return RegisterClass::kUnorderedAccess;
    case DescriptorRangeType::kCbv:
      return RegisterClass::kConstantBuffer;
    case DescriptorRangeType::kSampler:
      return RegisterClass::kSampler;
    default:
      return RegisterClass::kShaderResource;
  }
}

RegisterClass class_of(RootParameterType type) {
  switch (type) {
    case RootParameterType::kSrv:
      return RegisterClass::kShaderResource;
    case RootParameterType::kUav:
      return RegisterClass::kUnorderedAccess;
    default:
      return RegisterClass::kConstantBuffer;
  }
}

Status check_space(uint32_t space, const std::string& where) {
  if (space < kReservedSpaces) return {};
  return make_error(Id::kRootParameterInvalid, where, ": space ", space,
                    " is reserved; it must be 0 to 4294967279");
}

// Checks the ranges of a table and replaces append offsets by real ones.
Status check_table(RootDescriptorTable& table, const std::string& where) {
  if (table.Ranges.empty()) {
    return make_error(Id::kRangeInvalid, where, " is a descriptor table without ranges");
  }
  bool samplers = false, views = false;
  uint64_t next = 0;  // where an appended range would start
  bool after_unbounded = false;
  for (size_t i = 0; i < table.Ranges.size(); ++i) {
    DescriptorRange& range = table.Ranges[i];
    const std::string here = concat(where, ", range ", i);
    if (range.RangeType > DescriptorRangeType::kSampler) {
      return make_error(Id::kRangeInvalid, here, ": type ", static_cast<uint32_t>(range.RangeType),
                        "; it must be 0 to 3");
    }
    (range.RangeType == DescriptorRangeType::kSampler ? samplers : views) = true;
    if (Status s = check_space(range.RegisterSpace, here); !s.ok()) return s;
    const bool unbounded = range.NumDescriptors == kUnboundedDescriptors;
    if (range.NumDescriptors == 0 ||
        (!unbounded && uint64_t{range.BaseShaderRegister} + range.NumDescriptors > kRegisterEnd)) {
      return make_error(Id::kRangeInvalid, here, ": ", range.NumDescriptors,
                        " descriptors from register ", range.BaseShaderRegister,
                        "; a range needs at least one, and must end by register 2^32-1");
    }
    if (range.OffsetInDescriptorsFromTableStart == kDescriptorRangeOffsetAppend) {
      if (after_unbounded || next > 0xFFFFFFFEu) {
        return make_error(Id::kRangeInvalid, here,
                          ": appended after an unbounded range; give it an explicit offset");
      }
      range.OffsetInDescriptorsFromTableStart = static_cast<uint32_t>(next);
    }
    after_unbounded = unbounded;
    next = uint64_t{range.OffsetInDescriptorsFromTableStart} + range.NumDescriptors;
    if (!unbounded && next > 0xFFFFFFFFu) {
      return make_error(Id::kRangeInvalid, here, ": ends past descriptor 2^32-1 of the table");
    }
  }
  if (samplers && views) {
    return make_error(Id::kTableMixesSamplers, where,
                      " mixes samplers with other descriptors; split it into two tables");
  }
  return {};
}

Status check_visibility(ShaderVisibility visibility, bool local, const std::string& where) {
  if (visibility == ShaderVisibility::kAll) return {};
  if (!local && visibility <= ShaderVisibility::kMesh) return {};
  return make_error(Id::kRootSignatureVisibility, where, " has visibility ",
                    static_cast<uint32_t>(visibility), "; it must be ",
                    local ? "kAll, as in every local root signature" : "0 to 7");
}

Status check_parameter(RootParameter& parameter, uint32_t index, bool local) {
  const std::string where = concat("parameter ", index);
  if (Status s = check_visibility(parameter.ShaderVisibility, local, where); !s.ok()) return s;
  switch (parameter.ParameterType) {
    case RootParameterType::kDescriptorTable:
      return check_table(parameter.DescriptorTable, where);
    case RootParameterType::k32BitConstants:
      if (parameter.Constants.Num32BitValues == 0) {
        return make_error(Id::kRootConstantsCount, where,
                          " has Num32BitValues 0; it must be at least 1");
      }
      return check_space(parameter.Constants.RegisterSpace, where);
    case RootParameterType::kCbv:
    case RootParameterType::kSrv:
    case RootParameterType::kUav:
      return check_space(parameter.Descriptor.RegisterSpace, where);
  }
  return make_error(Id::kRootParameterInvalid, where, " has type ",
                    static_cast<uint32_t>(parameter.ParameterType), "; it must be 0 to 4");
}

Status check_flags(RootSignatureFlags flags) {
  const auto bits = static_cast<uint32_t>(flags);
  if (bits & ~kDefinedFlags) {
    return make_error(Id::kLocalRootSignatureFlags, "flags ", hex(bits), " have undefined bits");
  }
  if (HasAny(flags, RootSignatureFlags::kLocalRootSignature) &&
      flags != RootSignatureFlags::kLocalRootSignature) {
    return make_error(Id::kLocalRootSignatureFlags, "flags ", hex(bits),
                      ": kLocalRootSignature (0x80) cannot be combined with other flags");
  }
  return {};
}

Status check_border(const StaticSamplerDesc& sampler, const std::string& where) {
  const auto color = static_cast<uint32_t>(sampler.BorderColor);
  if (color > static_cast<uint32_t>(StaticBorderColor::kOpaqueWhiteUint)) {
    return make_error(Id::kStaticSamplerInvalid, where, ": BorderColor is ", color,
                      "; it must be 0 to 4");
  }
  if ((sampler.Flags & ~SamplerFlags::kUintBorderColor) != SamplerFlags::kNone) {
    return make_error(Id::kStaticSamplerInvalid, where, ": Flags are ",
                      hex(static_cast<uint32_t>(sampler.Flags)),
                      "; only kUintBorderColor (0x1) is known");
  }
  return {};
}

Status check_static_samplers(const RootSignatureDesc& desc) {
  for (size_t i = 0; i < desc.StaticSamplers.size(); ++i) {
    const StaticSamplerDesc& sampler = desc.StaticSamplers[i];
    const std::string where = concat("static sampler ", i);
    const bool local = HasAny(desc.Flags, RootSignatureFlags::kLocalRootSignature);
    if (Status s = check_visibility(sampler.ShaderVisibility, local, where); !s.ok()) return s;
    if (Status s = check_border(sampler, where); !s.ok()) return s;
    if (Status s = check_space(sampler.RegisterSpace, where); !s.ok()) return s;
    if (Status s = check_sampler(to_sampler_desc(sampler), Id::kStaticSamplerInvalid, where);
        !s.ok()) {
      return s;
    }
  }
  return {};
}

Status check_overlaps(const RootSignatureDesc& desc) {
  const auto ranges = get_register_ranges(desc);
  for (size_t i = 0; i < ranges.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      if (!overlap(ranges[k], ranges[i])) continue;
      const RegisterRange& a = ranges[k];
      const RegisterRange& b = ranges[i];
      return make_error(Id::kRootSignatureOverlap,
                        register_text(b.register_class, std::max(a.first, b.first), b.space),
                        " is bound by ", a.static_sampler ? "static sampler " : "parameter ",
                        a.parameter, " and by ",
                        b.static_sampler ? "static sampler " : "parameter ", b.parameter);
    }
  }
  return {};
}

// Size of a global signature in DWORDs. [D3D12: root signature limits]
uint64_t root_cost(const RootSignatureDesc& desc) {
  uint64_t cost = 0;
  for (const RootParameter& p : desc.Parameters) {
    switch (p.ParameterType) {
      case RootParameterType::kDescriptorTable:
        cost += 1;
        break;
      case RootParameterType::k32BitConstants:
        cost += p.Constants.Num32BitValues;
        break;
      default:
        cost += 2;
        break;
    }
  }
  return cost;
}

// Lays out the arguments by the rules of shader records, also for the root arguments of a dispatch,
// so that one slot description serves both. [DXR: Shader table memory initialization]
uint64_t lay_out(const RootSignatureDesc& desc, std::vector<uint32_t>& offsets) {
  uint64_t end = 0;
  for (const RootParameter& p : desc.Parameters) {
    const bool constants = p.ParameterType == RootParameterType::k32BitConstants;
    const uint64_t start = align_up(end, constants ? 4 : 8);
    offsets.push_back(static_cast<uint32_t>(start));
    end = start + (constants ? uint64_t{p.Constants.Num32BitValues} * 4 : 8);
  }
  return end;
}

Status check_size(const RootSignatureDesc& desc, uint64_t argument_bytes) {
  if (HasAny(desc.Flags, RootSignatureFlags::kLocalRootSignature)) {
    if (argument_bytes <= kMaxLocalRootArgumentBytes) return {};
    return make_error(Id::kLocalRootSignatureTooLarge, "its arguments take ", argument_bytes,
                      " bytes; at most 4064 fit in a record, whose stride is at most 4096");
  }
  const uint64_t cost = root_cost(desc);
  if (cost <= kMaxRootCost) return {};
  return make_error(
      Id::kRootSignatureTooLarge, "it costs ", cost,
      " DWORDs of at most 64 (a table costs 1, a root descriptor 2, each constant 1)");
}

}  // namespace

std::vector<RegisterRange> get_register_ranges(const RootSignatureDesc& desc) {
  std::vector<RegisterRange> out;
  for (uint32_t i = 0; i < desc.Parameters.size(); ++i) {
    const RootParameter& p = desc.Parameters[i];
    if (p.ParameterType == RootParameterType::kDescriptorTable) {
      for (const DescriptorRange& r : p.DescriptorTable.Ranges) {
        const uint64_t end = r.NumDescriptors == kUnboundedDescriptors
                                 ? kRegisterEnd
                                 : uint64_t{r.BaseShaderRegister} + r.NumDescriptors;
        out.push_back({class_of(r.RangeType), r.RegisterSpace, r.BaseShaderRegister, end, i, false,
                       p.ShaderVisibility});
      }
      continue;
    }
    const bool constants = p.ParameterType == RootParameterType::k32BitConstants;
    const uint32_t first = constants ? p.Constants.ShaderRegister : p.Descriptor.ShaderRegister;
    const uint32_t space = constants ? p.Constants.RegisterSpace : p.Descriptor.RegisterSpace;
    out.push_back({class_of(p.ParameterType), space, first, uint64_t{first} + 1, i, false,
                   p.ShaderVisibility});
  }
  for (uint32_t i = 0; i < desc.StaticSamplers.size(); ++i) {
    const StaticSamplerDesc& s = desc.StaticSamplers[i];
    out.push_back({RegisterClass::kSampler, s.RegisterSpace, s.ShaderRegister,
                   uint64_t{s.ShaderRegister} + 1, i, true, s.ShaderVisibility});
  }
  return out;
}

bool overlap(const RegisterRange& a, const RegisterRange& b) {
  const bool seen_together = a.visibility == ShaderVisibility::kAll ||
                             b.visibility == ShaderVisibility::kAll || a.visibility == b.visibility;
  return seen_together && a.register_class == b.register_class && a.space == b.space &&
         a.first < b.end && b.first < a.end;
}

std::string register_text(RegisterClass register_class, uint32_t index, uint32_t space) {
  static constexpr char kLetters[] = {'t', 'u', 'b', 's'};
  const auto i = static_cast<uint32_t>(register_class);
  std::string text = concat(i < 4 ? kLetters[i] : '?', index);
  return space ? concat(text, ", space", space) : text;
}

bool same_sampler(const StaticSamplerDesc& a, const StaticSamplerDesc& b) {
  auto key = [](const StaticSamplerDesc& s) {
    return std::tie(s.Filter, s.AddressU, s.AddressV, s.AddressW, s.MipLODBias, s.MaxAnisotropy,
                    s.ComparisonFunc, s.BorderColor, s.MinLOD, s.MaxLOD, s.ShaderRegister,
                    s.RegisterSpace, s.ShaderVisibility, s.Flags);
  };
  return key(a) == key(b);
}

bool same_arguments(const RootSignature& a, const RootSignature& b) {
  if (!a || !b) return false;
  const auto& x = a.GetDesc().Parameters;
  const auto& y = b.GetDesc().Parameters;
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& p, const auto& q) {
    return p.ParameterType == q.ParameterType &&
           (p.ParameterType != RootParameterType::k32BitConstants ||
            p.Constants.Num32BitValues == q.Constants.Num32BitValues);
  });
}

bool same_definition(const RootSignature& a, const RootSignature& b) {
  if (a == b) return true;
  if (!a || !b) return false;
  const RootSignatureDesc& x = a.GetDesc();
  const RootSignatureDesc& y = b.GetDesc();
  auto same_range = [](const DescriptorRange& r, const DescriptorRange& s) {
    return r.RangeType == s.RangeType && r.NumDescriptors == s.NumDescriptors &&
           r.BaseShaderRegister == s.BaseShaderRegister && r.RegisterSpace == s.RegisterSpace &&
           r.OffsetInDescriptorsFromTableStart == s.OffsetInDescriptorsFromTableStart;
  };
  auto same_parameter = [&](const RootParameter& p, const RootParameter& q) {
    if (p.ParameterType != q.ParameterType || p.ShaderVisibility != q.ShaderVisibility)
      return false;
    if (p.ParameterType == RootParameterType::kDescriptorTable) {
      return std::equal(p.DescriptorTable.Ranges.begin(), p.DescriptorTable.Ranges.end(),
                        q.DescriptorTable.Ranges.begin(), q.DescriptorTable.Ranges.end(),
                        same_range);
    }
    if (p.ParameterType == RootParameterType::k32BitConstants) {
      return p.Constants.ShaderRegister == q.Constants.ShaderRegister &&
             p.Constants.RegisterSpace == q.Constants.RegisterSpace &&
             p.Constants.Num32BitValues == q.Constants.Num32BitValues;
    }
    return p.Descriptor.ShaderRegister == q.Descriptor.ShaderRegister &&
           p.Descriptor.RegisterSpace == q.Descriptor.RegisterSpace;
  };
  return x.Flags == y.Flags &&
         std::equal(x.Parameters.begin(), x.Parameters.end(), y.Parameters.begin(),
                    y.Parameters.end(), same_parameter) &&
         std::equal(x.StaticSamplers.begin(), x.StaticSamplers.end(), y.StaticSamplers.begin(),
                    y.StaticSamplers.end(), same_sampler);
}

namespace {

// Checks a description, gives appended ranges their offsets, and lays out the arguments.
Status complete(RootSignatureImpl& impl) {
  const RootSignatureDesc& desc = impl.desc;
  if (Status s = check_flags(desc.Flags); !s.ok()) return s;
  for (uint32_t i = 0; i < desc.Parameters.size(); ++i) {
    if (Status s = check_parameter(impl.desc.Parameters[i], i, impl.is_local()); !s.ok()) return s;
  }
  if (Status s = check_static_samplers(desc); !s.ok()) return s;
  if (Status s = check_overlaps(desc); !s.ok()) return s;
  const uint64_t bytes = lay_out(desc, impl.offsets);
  impl.argument_bytes = static_cast<uint32_t>(bytes);
  return check_size(desc, bytes);
}

}  // namespace

Result<RootSignature> make_root_signature(const std::shared_ptr<DeviceImpl>& device,
                                          const RootSignatureDesc& desc) {
  auto impl = std::make_shared<RootSignatureImpl>();
  impl->device = device;
  impl->desc = desc;
  if (Status s = complete(*impl); !s.ok()) return s.error();
  for (const StaticSamplerDesc& sampler : desc.StaticSamplers) {
    auto object = device->backend->create_sampler(to_sampler_desc(sampler));
    if (!object.ok()) return object.error();
    device->views.add_sampler(*object, to_sampler_desc(sampler));
    shader::Descriptor descriptor;
    descriptor.kind = shader::DescriptorKind::kSampler;
    descriptor.access = shader::DescriptorAccess::kOther;
    descriptor.address = *object;
    impl->static_samplers.push_back(descriptor);
  }
  return RootSignature(std::move(impl));
}

}  // namespace detail

using namespace detail;

namespace {
const RootSignatureDesc kEmptyDesc;
}

const RootSignatureDesc& RootSignature::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyDesc;
}
bool RootSignature::is_local() const {
  return impl_ && impl_->is_local();
}
uint32_t RootSignature::GetArgumentOffset(uint32_t i) const {
  return impl_ && i < impl_->offsets.size() ? impl_->offsets[i] : 0;
}
uint32_t RootSignature::GetArgumentBytes() const {
  return impl_ ? impl_->argument_bytes : 0;
}

Status CheckRootSignature(const RootSignatureDesc& desc) {
  RootSignatureImpl impl;
  impl.desc = desc;
  return complete(impl);
}

Result<RootSignature> Device::CreateRootSignature(const RootSignatureDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateRootSignature on an empty device handle");
  return make_root_signature(impl_, desc);
}

Result<RootSignature> Device::CreateRootSignature(std::string_view text) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateRootSignature on an empty device handle");
  auto desc = ParseRootSignature(text);
  if (!desc.ok()) return desc.error();
  return make_root_signature(impl_, *desc);
}

}  // namespace rtapi
