// SPDX-License-Identifier: MIT
#include "rtapi/src/resources/sampler.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "rtapi/src/device/device_impl.h"

namespace rtapi {

namespace detail {

namespace {

bool is_address_mode(TextureAddressMode mode) {
  return mode >= TextureAddressMode::kWrap && mode <= TextureAddressMode::kMirrorOnce;
}

// Bits of D3D12_FILTER: 0, 2, 4 linear; 6 anisotropic (with all three linear); 7-8 reduction.
bool is_filter(Filter filter) {
  const auto f = static_cast<uint32_t>(filter);
  if (f & ~0x1D5u) return false;
  return !(f & 0x40u) || (f & 0x55u) == 0x55u;
}

}  // namespace

Status check_sampler(const SamplerDesc& desc, Id id, std::string_view what) {
  if (!is_filter(desc.Filter)) {
    return make_error(id, what, ": Filter is ", hex(static_cast<uint32_t>(desc.Filter)),
                      ", which is not a D3D12_FILTER");
  }
  for (auto mode : {desc.AddressU, desc.AddressV, desc.AddressW}) {
    if (!is_address_mode(mode)) {
      return make_error(id, what, ": an address mode is ", static_cast<uint32_t>(mode),
                        "; it must be 1 to 5");
    }
  }
  if (!(desc.MipLODBias >= -16.0f && desc.MipLODBias <= 15.99f)) {
    return make_error(id, what, ": MipLODBias is ", desc.MipLODBias, "; it must be -16 to 15.99");
  }
  if (desc.MaxAnisotropy > 16) {
    return make_error(id, what, ": MaxAnisotropy is ", desc.MaxAnisotropy, "; it must be 0 to 16");
  }
  if (desc.ComparisonFunc > ComparisonFunc::kAlways) {
    return make_error(id, what, ": ComparisonFunc is ", static_cast<uint32_t>(desc.ComparisonFunc),
                      "; it must be 0 to 8");
  }
  if (std::isnan(desc.MinLOD) || std::isnan(desc.MaxLOD)) {
    return make_error(id, what, ": MinLOD or MaxLOD is NaN");
  }
  for (float c : desc.BorderColor) {
    if (std::isnan(c)) return make_error(id, what, ": BorderColor is NaN");
  }
  return {};
}

SamplerDesc to_sampler_desc(const StaticSamplerDesc& desc) {
  SamplerDesc out;
  out.Filter = desc.Filter;
  out.AddressU = desc.AddressU;
  out.AddressV = desc.AddressV;
  out.AddressW = desc.AddressW;
  out.MipLODBias = desc.MipLODBias;
  out.MaxAnisotropy = desc.MaxAnisotropy;
  out.ComparisonFunc = desc.ComparisonFunc;
  const bool white = desc.BorderColor == StaticBorderColor::kOpaqueWhite ||
                     desc.BorderColor == StaticBorderColor::kOpaqueWhiteUint;
  const float color = white ? 1.0f : 0.0f;
  std::fill_n(out.BorderColor, 3, color);
  out.BorderColor[3] = desc.BorderColor == StaticBorderColor::kTransparentBlack ? 0.0f : 1.0f;
  out.MinLOD = desc.MinLOD;
  out.MaxLOD = desc.MaxLOD;
  return out;
}

}  // namespace detail

using namespace detail;

Status Device::CreateSampler(const SamplerDesc& desc, CpuDescriptorHandle dest) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateSampler on an empty device handle");
  if (Status s = check_sampler(desc, Id::kSamplerInvalid, "sampler"); !s.ok()) return s;
  const auto slot = impl_->find_slot(dest);
  if (!slot || slot->type != DescriptorHeapType::kSampler) {
    return make_error(Id::kDescriptorHandle, "CreateSampler: ", hex(dest.ptr), describe_heap(slot),
                      "; it must be in one of kSampler");
  }
  auto object = impl_->backend->create_sampler(desc);
  if (!object.ok()) return object.error();
  impl_->views.add_sampler(*object, desc);
  shader::Descriptor descriptor;
  descriptor.kind = shader::DescriptorKind::kSampler;
  descriptor.access = shader::DescriptorAccess::kOther;
  descriptor.address = *object;
  std::memcpy(slot->slot, &descriptor, sizeof descriptor);
  return {};
}

}  // namespace rtapi
