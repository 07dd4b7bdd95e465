// SPDX-License-Identifier: MIT
#include "views.h"

#include <span>

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kSide = 8;
constexpr uint32_t kMips = 2;

// The properties that the name of a texture tells; see fixtures.h.
struct TextureKind {
  ResourceDimension resource = ResourceDimension::kTexture2D;
  SrvDimension srv = SrvDimension::kTexture2D;
  UavDimension uav = UavDimension::kTexture2D;
  uint32_t elements = 2;  // array elements, faces or slices
  Format format = Format::kR32G32B32A32Float;
};

TextureKind kind_of(const std::string& name) {
  const auto says = [&name](const char* part) { return name.find(part) != std::string::npos; };
  TextureKind kind;
  if (says("_1d")) {
    kind.resource = ResourceDimension::kTexture1D;
    kind.srv = says("_array") ? SrvDimension::kTexture1DArray : SrvDimension::kTexture1D;
    kind.uav = says("_array") ? UavDimension::kTexture1DArray : UavDimension::kTexture1D;
  } else if (says("_3d")) {
    kind.resource = ResourceDimension::kTexture3D;
    kind.srv = SrvDimension::kTexture3D;
    kind.uav = UavDimension::kTexture3D;
  } else if (says("_cube")) {
    kind.srv = says("_array") ? SrvDimension::kTextureCubeArray : SrvDimension::kTextureCube;
    kind.elements = 12;
  } else if (says("_array")) {
    kind.srv = SrvDimension::kTexture2DArray;
    kind.uav = UavDimension::kTexture2DArray;
  }
  if (says("_uint")) kind.format = Format::kR32Uint;
  if (says("_single")) kind.format = Format::kR32Float;
  if (says("_half")) kind.format = Format::kR16Float;
  if (says("_pairs")) kind.format = says("_signed") ? Format::kR32G32Sint : Format::kR32G32Uint;
  return kind;
}

// The texels of one mip of slices first .. first + count.
template <class T, class F>
std::vector<T> texels(uint32_t width, uint32_t height, uint32_t first, uint32_t count, F value) {
  std::vector<T> out;
  for (uint32_t z = first; z < first + count; ++z) {
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) value(out, x, y, z);
    }
  }
  return out;
}

}  // namespace

Buffer CountingResources::buffer(bool writable) {
  std::vector<uint32_t> words(256);
  for (uint32_t i = 0; i < words.size(); ++i) words[i] = i;
  buffers_.push_back(writable
                         ? CreateDefaultBuffer(device_, queue_, std::as_bytes(std::span(words)),
                                               ResourceFlags::kAllowUnorderedAccess)
                               .value()
                         : CreateUploadBuffer(device_, words).value());
  return buffers_.back();
}

Texture CountingResources::texture(const std::string& name, bool writable) {
  const TextureKind kind = kind_of(name);
  const bool volume = kind.resource == ResourceDimension::kTexture3D;
  TextureDesc desc;
  desc.Dimension = kind.resource;
  desc.Width = kSide;
  desc.Height = kind.resource == ResourceDimension::kTexture1D ? 1 : kSide;
  desc.MipLevels = kMips;
  desc.DepthOrArraySize = static_cast<uint16_t>(kind.elements);
  desc.Format = kind.format;
  desc.Flags = writable ? ResourceFlags::kAllowUnorderedAccess : ResourceFlags::kNone;
  if (writable) desc.InitialState = ResourceStates::kUnorderedAccess;
  const Texture texture = device_.CreateTexture(desc).value();
  textures_.push_back(texture);
  for (uint32_t i = 0; i < texture.subresource_count(); ++i) {
    const uint32_t mip = i % kMips;
    const uint32_t height = std::max(desc.Height >> mip, 1u);
    const uint32_t slices = volume ? kind.elements >> mip : 1;
    const auto put = [&](auto&& value) {
      using T = std::decay_t<decltype(value(0u, 0u, 0u)[0])>;
      const auto data = texels<T>(kSide >> mip, height, volume ? 0 : i / kMips, slices,
                                  [&](std::vector<T>& out, uint32_t x, uint32_t y, uint32_t z) {
                                    for (const T v : value(x, y, z)) out.push_back(v);
                                  });
      UploadTexture(device_, queue_, texture, i, std::as_bytes(std::span(data))).value();
    };
    if (kind.format == Format::kR32Uint) {
      put([mip](uint32_t x, uint32_t y, uint32_t z) {
        return std::array<uint32_t, 1>{x + 10 * y + 100 * mip + 1000 * z};
      });
    } else if (kind.format == Format::kR32Float) {
      put([mip](uint32_t x, uint32_t y, uint32_t z) {
        return std::array<float, 1>{float(x + 10 * y + 100 * mip + 1000 * z)};
      });
    } else if (kind.format == Format::kR16Float) {
      put([](uint32_t, uint32_t, uint32_t) { return std::array<uint16_t, 1>{0x3C00}; });  // 1
    } else if (kind.format != Format::kR32G32B32A32Float) {
      put([mip](uint32_t x, uint32_t y, uint32_t z) {
        return std::array<uint32_t, 2>{x + 10 * y + 100 * mip + 1000 * z, 1};
      });
    } else {
      put([mip](uint32_t x, uint32_t y, uint32_t z) {
        return std::array<float, 4>{float(x), float(y), float(mip), float(z)};
      });
    }
  }
  return texture;
}

void CountingResources::texture_view(const std::string& name, bool writable,
                                     CpuDescriptorHandle handle) {
  const Texture image = texture(name, writable);
  const TextureKind kind = kind_of(name);
  if (writable) {
    UnorderedAccessViewDesc view;
    view.Format = kind.format;
    view.ViewDimension = kind.uav;
    device_.CreateUnorderedAccessView(image, view, handle).value();
  } else {
    ShaderResourceViewDesc view;
    view.Format = kind.format;
    view.ViewDimension = kind.srv;
    device_.CreateShaderResourceView(image, view, handle).value();
  }
}

void CountingResources::buffer_view(const shader::BindingDesc& b, const Buffer& buffer,
                                    CpuDescriptorHandle handle) {
  const bool raw = b.type == shader::BindingType::kRawBuffer;
  const Format typed = kind_of(b.name != nullptr ? b.name : "").format;
  const bool named = typed == Format::kR32G32Uint || typed == Format::kR32G32Sint ||
                     typed == Format::kR32Float || typed == Format::kR16Float;
  const Format format = b.type == shader::BindingType::kTypedBuffer
                            ? (named ? typed : Format::kR32Uint)
                        : raw ? Format::kR32Typeless
                              : Format::kUnknown;
  const uint32_t stride = b.type == shader::BindingType::kStructuredBuffer ? b.size_bytes : 0;
  if (b.register_class == shader::RegisterClass::kConstantBuffer) {
    device_.CreateConstantBufferView({buffer.GetGPUVirtualAddress(), 1024}, handle).value();
  } else if (b.register_class == shader::RegisterClass::kUnorderedAccess) {
    UnorderedAccessViewDesc view;
    view.ViewDimension = UavDimension::kBuffer;
    view.Format = format;
    view.Buffer.Flags = raw ? BufferUavFlags::kRaw : BufferUavFlags::kNone;
    view.Buffer.StructureByteStride = stride;
    const std::string name = b.name != nullptr ? b.name : "";
    Buffer counter;
    if (name.find("counted") != std::string::npos) {
      const uint32_t start = name.find("_from_8") != std::string::npos ? 8 : 0;
      counter = CreateDefaultBuffer(device_, queue_, std::as_bytes(std::span(&start, 1)),
                                    ResourceFlags::kAllowUnorderedAccess)
                    .value();
      buffers_.push_back(counter);
    }
    device_.CreateUnorderedAccessView(buffer, counter, view, handle).value();
  } else {
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kBuffer;
    view.Format = format;
    view.Buffer.Flags = raw ? BufferSrvFlags::kRaw : BufferSrvFlags::kNone;
    view.Buffer.StructureByteStride = stride;
    device_.CreateShaderResourceView(buffer, view, handle).value();
  }
}

void CountingResources::fill_table(const shader::BindingDesc& b, const DescriptorHeap& heap,
                                   uint32_t first, uint32_t count) {
  const bool writable = b.register_class == shader::RegisterClass::kUnorderedAccess;
  for (uint32_t i = 0; i < count; ++i) {
    const CpuDescriptorHandle handle = heap.GetCPUDescriptorHandle(first + i);
    if (b.type == shader::BindingType::kTexture) {
      texture_view(b.name, writable, handle);
    } else {
      buffer_view(b, buffer(writable), handle);
    }
  }
}

void CountingResources::fill_view_heap(const DescriptorHeap& heap, const Buffer& results) {
  shader::BindingDesc raw = {};
  raw.type = shader::BindingType::kRawBuffer;
  texture_view("image", false, heap.GetCPUDescriptorHandle(0));
  raw.register_class = shader::RegisterClass::kShaderResource;
  buffer_view(raw, buffer(false), heap.GetCPUDescriptorHandle(1));
  raw.register_class = shader::RegisterClass::kConstantBuffer;
  buffer_view(raw, buffer(false), heap.GetCPUDescriptorHandle(2));
  raw.register_class = shader::RegisterClass::kUnorderedAccess;
  buffer_view(raw, results, heap.GetCPUDescriptorHandle(3));
}

void CountingResources::fill_sampler_heap(const DescriptorHeap& heap) {
  SamplerDesc sampler;
  sampler.Filter = Filter::kMinMagMipPoint;
  for (const TextureAddressMode mode : {TextureAddressMode::kClamp, TextureAddressMode::kWrap}) {
    sampler.AddressU = sampler.AddressV = sampler.AddressW = mode;
    const uint32_t slot = mode == TextureAddressMode::kWrap ? 1 : 0;
    device_.CreateSampler(sampler, heap.GetCPUDescriptorHandle(slot)).value();
  }
}

}  // namespace kaamos::test
