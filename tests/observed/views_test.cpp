// SPDX-License-Identifier: MIT
//
// Every kind of view under every declaration of a texture. D3D12 leaves it undefined where the two
// differ. Here an array and a single texture fit each other; the rest reads 0 and writes nothing.
#include <shaders/views.h>

#include <cstring>

#include "tests/observed/world.h"

namespace {

using namespace rtapi;
using testing::HasSubstr;
using Words = std::vector<uint32_t>;

struct View {
  const char* name;
  SrvDimension dimension;
  uint32_t first = 0;
  uint32_t count = 1;  // elements; cubes
  bool of_uint = false;
  // The values that views.hlsl reads through each declaration, in its order.
  Words loads, samples, sizes;
};

// In texel (x, y) of element or slice z of a texture: 100 z + 10 y + x + 1, of one with a line only
// 10 z + x + 1.
const View kCases[] = {
    {"Texture1D",
     SrvDimension::kTexture1D,
     0,
     1,
     false,
     {2, 2, 0, 0, 0, 0, 0, 0},
     {2, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0},
     {4, 41, 0, 0, 0, 0, 0, 0}},
    {"Texture1DArray",
     SrvDimension::kTexture1DArray,
     1,
     2,
     false,
     {12, 12, 22, 0, 0, 0, 0, 0},
     {12, 12, 22, 0, 0, 0, 0, 0, 0, 0, 0},
     {4, 42, 0, 0, 0, 0, 0, 0}},
    {"Texture2D",
     SrvDimension::kTexture2D,
     0,
     1,
     false,
     {0, 0, 0, 22, 22, 0, 0, 0},
     {0, 0, 0, 22, 22, 22, 0, 0, 0, 0, 0},
     {0, 0, 44, 441, 0, 0, 0, 0}},
    {"Texture2DArray of one",
     SrvDimension::kTexture2DArray,
     2,
     1,
     false,
     {0, 0, 0, 222, 222, 0, 0, 0},
     {0, 0, 0, 222, 222, 222, 0, 0, 0, 0, 0},
     {0, 0, 44, 441, 0, 0, 0, 0}},
    {"Texture2DArray of two",
     SrvDimension::kTexture2DArray,
     2,
     2,
     false,
     {0, 0, 0, 222, 222, 322, 0, 0},
     {0, 0, 0, 222, 222, 322, 0, 0, 0, 0, 0},
     {0, 0, 44, 442, 0, 0, 0, 0}},
    {"Texture3D",
     SrvDimension::kTexture3D,
     0,
     1,
     false,
     {0, 0, 0, 0, 0, 0, 322, 0},
     {0, 0, 0, 0, 0, 0, 322, 0, 0, 0, 0},
     {0, 0, 0, 0, 444, 0, 0, 0}},
    {"TextureCube",
     SrvDimension::kTextureCube,
     0,
     1,
     false,
     {0, 0, 0, 0, 0, 0, 0, 0},
     {0, 0, 0, 0, 0, 0, 0, 23, 523, 23, 23},
     {0, 0, 0, 0, 0, 44, 441, 0}},
    {"TextureCubeArray",
     SrvDimension::kTextureCubeArray,
     0,
     2,
     false,
     {0, 0, 0, 0, 0, 0, 0, 0},
     {0, 0, 0, 0, 0, 0, 0, 23, 523, 23, 623},
     {0, 0, 0, 0, 0, 44, 442, 0}},
    {"Texture2D of uint",
     SrvDimension::kTexture2D,
     0,
     1,
     true,
     {0, 0, 0, 0, 0, 0, 0, 22},
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
     {0, 0, 0, 0, 0, 0, 0, 44}},
};

class Views : public kaamos::observed::World {
 protected:
  Texture texture_of(const View& view) {
    TextureDesc desc;
    desc.Width = desc.Height = 4;
    desc.Format = view.of_uint ? Format::kR32Uint : Format::kR32Float;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.MipLevels = 1;
    desc.DepthOrArraySize = 12;
    switch (view.dimension) {
      case SrvDimension::kTexture1D:
      case SrvDimension::kTexture1DArray:
        desc.Dimension = ResourceDimension::kTexture1D;
        desc.Height = 1;
        break;
      case SrvDimension::kTexture3D:
        desc.Dimension = ResourceDimension::kTexture3D;
        desc.DepthOrArraySize = 4;
        break;
      default:
        desc.Dimension = ResourceDimension::kTexture2D;
    }
    desc.InitialState = ResourceStates::kCommon;
    const Texture texture = device_.CreateTexture(desc).value();
    for (uint32_t i = 0; i < texture.subresource_count(); ++i) {
      UploadTexture(device_, queue_, texture, i,
                    std::as_bytes(std::span<const uint32_t>(original(texture, i))))
          .value();
    }
    return texture;
  }

  // The texels of a subresource, which is all of a volume.
  static Words original(const Texture& texture, uint32_t subresource) {
    const TextureDesc& desc = texture.GetDesc();
    const bool volume = desc.Dimension == ResourceDimension::kTexture3D;
    const uint32_t line = desc.Dimension == ResourceDimension::kTexture1D ? 10 : 100;
    Words out;
    for (uint32_t z = 0; z < (volume ? 4u : 1u); ++z) {
      for (uint32_t y = 0; y < desc.Height; ++y) {
        for (uint32_t x = 0; x < 4; ++x) {
          out.push_back(bits(texture, line * (z + subresource) + 10 * y + x + 1));
        }
      }
    }
    return out;
  }
  static uint32_t bits(const Texture& texture, uint32_t value) {
    if (texture.GetDesc().Format == Format::kR32Uint) return value;
    const auto number = static_cast<float>(value);
    uint32_t out;
    std::memcpy(&out, &number, sizeof(out));
    return out;
  }

  // Puts the view into every slot of its kind.
  void bind_view(const Texture& texture, const View& view) {
    ShaderResourceViewDesc srv;
    srv.Format = texture.GetDesc().Format;
    srv.ViewDimension = view.dimension;
    srv.Texture1DArray.FirstArraySlice = srv.Texture2DArray.FirstArraySlice = view.first;
    srv.Texture1DArray.ArraySize = srv.Texture2DArray.ArraySize = view.count;
    srv.TextureCubeArray.NumCubes = view.count;
    for (uint32_t i = 0; i < 8; ++i) {
      device_.CreateShaderResourceView(Resource(texture), srv, views_.GetCPUDescriptorHandle(i))
          .value();
    }
    if (view.dimension == SrvDimension::kTextureCube ||
        view.dimension == SrvDimension::kTextureCubeArray) {
      return;
    }
    UnorderedAccessViewDesc uav;
    uav.Format = srv.Format;
    uav.ViewDimension = static_cast<UavDimension>(view.dimension);
    uav.Texture1DArray.FirstArraySlice = uav.Texture2DArray.FirstArraySlice = view.first;
    uav.Texture1DArray.ArraySize = uav.Texture2DArray.ArraySize = view.count;
    for (uint32_t i = 8; i < 16; ++i) {
      device_.CreateUnorderedAccessView(Resource(texture), uav, views_.GetCPUDescriptorHandle(i))
          .value();
    }
  }

  Words run(const char* entry, size_t count) {
    out_ = zeros(1024, "out");
    dispatch(LoadShaderLibrary(kaamos_shaders_views()).value(), entry);
    Words words = read(out_);
    words.resize(count);
    return words;
  }
  bool told(const std::string& text) const {
    for (const Message& message : messages_) {
      if (message.Id.text() == "KA0438" && message.Text.find(text) != std::string::npos)
        return true;
    }
    return false;
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, Views, testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Views, ReadTheTexelWhereTheyFit) {
  for (const View& view : kCases) {
    const Texture texture = texture_of(view);
    bind_view(texture, view);
    EXPECT_EQ(run("Load", view.loads.size()), view.loads) << view.name;
    EXPECT_EQ(run("Sample", view.samples.size()), view.samples) << view.name;
    EXPECT_EQ(run("Size", view.sizes.size()), view.sizes) << view.name;
    constants_[0] = 3;
    EXPECT_EQ(run("LoadFromHeap", view.loads.size()), view.loads) << view.name;
  }
}

// The declarations of Store in its order read what they have stored, or store nothing.
TEST_P(Views, WriteTheTexelWhereTheyFit) {
  constexpr uint32_t kTexel[] = {1, 1, 1, 9, 9, 9, 57, 9};  // where in a subresource
  constexpr uint32_t kElement[] = {0, 0, 1, 0, 0, 1, 0, 0};
  for (const View& view : kCases) {
    if (view.dimension >= SrvDimension::kTextureCube) continue;
    const Texture texture = texture_of(view);
    bind_view(texture, view);
    for (uint32_t which = 0; which < 8; ++which) {
      constants_[0] = which;
      const uint32_t expected = view.loads[which] != 0 ? 100 * (which + 1) : 0;
      EXPECT_EQ(run("Store", 1)[0], expected) << view.name << ", " << which;
      for (uint32_t i = 0; i < texture.subresource_count(); ++i) {
        Words texels = original(texture, i);
        if (expected != 0 && i == view.first + kElement[which]) {
          texels[kTexel[which]] = bits(texture, expected);
        }
        const auto bytes = ReadbackTexture(device_, queue_, texture, i).value();
        ASSERT_EQ(bytes.size(), texels.size() * 4);
        EXPECT_EQ(std::memcmp(bytes.data(), texels.data(), bytes.size()), 0)
            << view.name << ", " << which << ", subresource " << i;
        UploadTexture(device_, queue_, texture, i,
                      std::as_bytes(std::span<const uint32_t>(original(texture, i))))
            .value();
      }
    }
  }
}

TEST_P(Views, CheckedModeSaysThatDimensionsDiffer) {
  open(true);
  const struct {
    uint32_t view;
    const char* text;  // null: nothing to say
    uint32_t value;
  } cases[] = {{2, nullptr, 22},
               {3,
                "a view as Texture2DArray of float, but the shader declares Texture2D of float: "
                "their dimensions differ. It reads the first element",
                222},
               {5,
                "a view as Texture3D of float, but the shader declares Texture2D of float: their "
                "dimensions differ. It reads as a null descriptor",
                0},
               {8,
                "a view as Texture2D of uint, but the shader declares Texture2D of float: their "
                "numbers differ. It reads as a null descriptor",
                0}};
  for (const auto& one : cases) {
    const Texture texture = texture_of(kCases[one.view]);
    bind_view(texture, kCases[one.view]);
    messages_.clear();
    EXPECT_EQ(run("LoadOne", 1)[0], one.value);
    EXPECT_EQ(told(one.text != nullptr ? one.text : "their dimensions differ"), one.text != nullptr)
        << kCases[one.view].name;
  }
}

}  // namespace
