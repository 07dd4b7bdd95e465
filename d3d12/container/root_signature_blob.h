// SPDX-License-Identifier: MIT
// Serialized root signatures: part RTS0 of a container. [D3D12:
// D3D12SerializeVersionedRootSignature]
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <d3d12.h>

#include <rtapi/rtapi.h>

namespace kaamos::d3d12 {

/// The description of version 1.2 that `desc` is. It lies where Desc_1_1 does; an older d3d12.h has
/// no member for it.
D3D12_ROOT_SIGNATURE_DESC2 desc_1_2(const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc);

/// A description of any version as rtapi has it, and back from there. Version 1.0 has no flags of
/// ranges and descriptors, and only 1.2 those of static samplers.
/// @errors KA4021 a version or a parameter type that does not exist, null arrays.
rtapi::Result<rtapi::RootSignatureDesc> root_signature_desc(
    const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc);

/// The bytes of the part, little-endian, in the layout that Microsoft's tools read.
std::vector<std::byte> write_root_signature(const rtapi::RootSignatureDesc& desc,
                                            D3D_ROOT_SIGNATURE_VERSION version);

/// A part's description. `version`, where not null, gets the version that it was written in.
/// @errors KA4021 names the offset of what cannot be.
rtapi::Result<rtapi::RootSignatureDesc> read_root_signature(
    std::span<const std::byte> part, D3D_ROOT_SIGNATURE_VERSION* version = nullptr);

/// A root signature in a blob: a container with part RTS0 (of D3D12SerializeRootSignature or of a
/// compiled shader), or the part alone.
/// @errors KA4021, KA4020.
rtapi::Result<rtapi::RootSignatureDesc> root_signature_of_blob(
    const void* blob, size_t size, D3D_ROOT_SIGNATURE_VERSION* version = nullptr);

/// D3D12's structures for a description. The arrays live as long as the object.
class RootSignatureTree {
 public:
  /// `source`: the version that `desc` was read from. 1.0 has no flags; in 1.1 they are volatile.
  RootSignatureTree(const rtapi::RootSignatureDesc& desc, D3D_ROOT_SIGNATURE_VERSION version,
                    D3D_ROOT_SIGNATURE_VERSION source = D3D_ROOT_SIGNATURE_VERSION_1_1);
  RootSignatureTree(const RootSignatureTree&) = delete;
  RootSignatureTree& operator=(const RootSignatureTree&) = delete;

  const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc() const { return desc_; }

 private:
  D3D12_VERSIONED_ROOT_SIGNATURE_DESC desc_ = {};
  std::vector<D3D12_ROOT_PARAMETER> parameters_;
  std::vector<D3D12_ROOT_PARAMETER1> parameters1_;
  std::vector<std::vector<D3D12_DESCRIPTOR_RANGE>> ranges_;
  std::vector<std::vector<D3D12_DESCRIPTOR_RANGE1>> ranges1_;
  std::vector<D3D12_STATIC_SAMPLER_DESC> samplers_;
  std::vector<D3D12_STATIC_SAMPLER_DESC1> samplers1_;
};

}  // namespace kaamos::d3d12
