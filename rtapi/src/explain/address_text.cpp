// SPDX-License-Identifier: MIT
#include "rtapi/src/explain/address_text.h"

namespace rtapi::detail {
namespace {

using shader::Descriptor;
using shader::DescriptorAccess;
using shader::DescriptorKind;

const char* kind_text(DescriptorKind kind) {
  switch (kind) {
    case DescriptorKind::kNull:
      return "null";
    case DescriptorKind::kConstantBuffer:
      return "constant buffer";
    case DescriptorKind::kRawBuffer:
      return "raw buffer";
    case DescriptorKind::kStructuredBuffer:
      return "structured buffer";
    case DescriptorKind::kTypedBuffer:
      return "typed buffer";
    case DescriptorKind::kTexture:
      return "texture";
    case DescriptorKind::kSampler:
      return "sampler";
    case DescriptorKind::kAccelerationStructure:
      return "acceleration structure";
  }
  return "no descriptor";
}

const char* access_text(const Descriptor& descriptor) {
  switch (descriptor.kind) {
    case DescriptorKind::kNull:
      return "";
    case DescriptorKind::kConstantBuffer:
      return "CBV";
    case DescriptorKind::kSampler:
      return "sampler";
    default:
      return view_access(descriptor) == DescriptorAccess::kUnorderedAccess ? "UAV" : "SRV";
  }
}

}  // namespace

AddressDescription describe_where(const DeviceImpl& device, GpuVirtualAddress address) {
  AddressDescription where;
  where.Address = address;
  if (const auto allocation = device.addresses.find(address)) {
    where.Live = true;
    where.Buffer = allocation->name;
    where.OffsetInBytes = address - allocation->address;
    where.SizeInBytes = allocation->size_bytes;
  }
  return where;
}

DescriptorDescription describe_descriptor(const DeviceImpl& device, const Descriptor& descriptor) {
  DescriptorDescription out;
  out.Kind = kind_text(descriptor.kind);
  out.Access = access_text(descriptor);
  switch (descriptor.kind) {
    case DescriptorKind::kNull:
    case DescriptorKind::kSampler:
      break;
    case DescriptorKind::kTexture:
      if (const auto view = device.views.find(
              descriptor.address, descriptor.access == DescriptorAccess::kUnorderedAccess)) {
        out.Resource = view->name;
      }
      break;
    default:
      out.StrideInBytes = descriptor.stride_bytes;
      out.SizeInBytes = descriptor.size_bytes;
      out.Address = describe_where(device, descriptor.address);
      out.Resource = out.Address.Buffer;
      break;
  }
  return out;
}

std::string ToText(const AddressDescription& address) {
  if (address.Address == 0) return "address 0";
  if (!address.Live) return concat("address ", hex(address.Address), " (in no live buffer)");
  return concat(named("buffer", address.Buffer), " + ", address.OffsetInBytes, " (",
                address.SizeInBytes, " bytes)");
}

std::string ToText(const DescriptorDescription& d) {
  std::string text =
      d.Access.empty() || d.Access == d.Kind ? d.Kind : concat(d.Access, " ", d.Kind);
  if (d.Kind == "texture") {
    text += d.Resource.empty() ? " without a name" : concat(" ", in_quotes(d.Resource));
  }
  if (d.StrideInBytes != 0) text += concat(", stride ", d.StrideInBytes);
  if (d.Address.Address != 0) text += concat(", ", ToText(d.Address));
  if (d.SizeInBytes != 0) text += concat(", view of ", d.SizeInBytes, " bytes");
  return text;
}

}  // namespace rtapi::detail
