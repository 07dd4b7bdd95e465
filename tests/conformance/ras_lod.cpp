// SPDX-License-Identifier: MIT
//
// Rules of implicit levels of detail and of comparison.
#include <shaders/ras_lod.h>

#include <cmath>

#include "tests/conformance/compile.h"
#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr char kMoreSamplers[] =
    ", StaticSampler(s2, filter = FILTER_MIN_MAG_MIP_LINEAR, mipLODBias = 1)"
    ", StaticSampler(s3, filter = FILTER_MIN_MAG_MIP_LINEAR, minLOD = 2.5, maxLOD = 4.5)"
    ", StaticSampler(s4, filter = FILTER_ANISOTROPIC, maxAnisotropy = 16)";

// With the samplers of ras_lod.hlsl.
Screen lod_screen(Context& t, uint32_t size = 256) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, size);
  screen.library = kaamos_shaders_ras_lod();
  screen.root_signature =
      t.device().CreateRootSignature(std::string(kDrawSignature) + kMoreSamplers).value();
  return screen;
}

float tolerance_of(const Context& t) {
  return t.target().backend == "vulkan" ? 1.0f / 16 : 0.02f;
}

// A texture whose mips hold their numbers.
Texture numbered_mips(Context& t, uint32_t side, uint16_t slices = 1) {
  TextureDesc desc = {.Width = side,
                      .Height = side,
                      .DepthOrArraySize = slices,
                      .MipLevels = 0,
                      .Format = Format::kR32Float};
  const Texture texture = t.device().CreateTexture(desc).value();
  const uint32_t mips = texture.GetDesc().MipLevels;
  for (uint32_t i = 0; i < mips * slices; ++i) {
    const uint32_t mip_side = std::max(1u, side >> (i % mips));
    const std::vector<float> texels(size_t{mip_side} * mip_side, static_cast<float>(i % mips));
    UploadTexture(t.device(), t.queue(), texture, i, std::as_bytes(std::span<const float>(texels)))
        .value();
  }
  return texture;
}

void implicit_levels(Context& t) {
  Screen screen = lod_screen(t);
  const Texture texture = numbered_mips(t, 1024);
  t.device().CreateShaderResourceView(texture, screen.views.GetCPUDescriptorHandle(0)).value();
  const PipelineState pipeline = screen.make("Whole", "Levels");
  const auto check = [&](const std::string& what, float x, float y, std::array<float, 4> expected) {
    screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.tint = {x, y, 0, 0}}); });
    const char* names[] = {"Sample", "SampleBias 1.5", "bias 1", "from 2.5 to 4.5"};
    for (uint32_t c = 0; c < 4; ++c) {
      for (const uint32_t at : {0u, 93u, 255u}) {
        t.close(what + ", " + names[c], screen.texel<float>(at, 255 - at, c), expected[c],
                tolerance_of(t));
      }
    }
  };
  check("4 texels", 1, 1, {2, 3.5f, 3, 2.5f});
  check("16 x 1 texels", 4, 0.25f, {4, 5.5f, 5, 4});
  check("1 x 16 texels", 0.25f, 4, {4, 5.5f, 5, 4});
  check("64 texels", 16, 16, {6, 7.5f, 7, 4.5f});
  check("1/2 texel", 0.125f, 0.125f, {0, 0.5f, 0, 2.5f});
  // A view of mips 1 to 3.
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kTexture2D;
  view.Texture2D.MostDetailedMip = 1;
  view.Texture2D.MipLevels = 3;
  t.device()
      .CreateShaderResourceView(texture, view, screen.views.GetCPUDescriptorHandle(0))
      .value();
  check("view of mips 1 to 3, 4 texels", 1, 1, {2, 3, 3, 3});
}

void cubes_and_arrays(Context& t) {
  Screen screen = lod_screen(t);
  const Texture cube = numbered_mips(t, 1024, 6);
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kTextureCube;
  t.device().CreateShaderResourceView(cube, view, screen.views.GetCPUDescriptorHandle(1)).value();
  const PipelineState of_cube = screen.make("Whole", "OfCube");
  screen.run([&](CommandList& list) { screen.cover(list, of_cube); });
  for (const uint32_t at : {2u, 93u, 250u}) {
    t.close("+Z", screen.texel<float>(at, 255 - at, 0), 2, tolerance_of(t));
    t.close("+X", screen.texel<float>(at, 255 - at, 1), 2, tolerance_of(t));
  }
  view.ViewDimension = SrvDimension::kTexture2DArray;
  t.device().CreateShaderResourceView(cube, view, screen.views.GetCPUDescriptorHandle(1)).value();
  const PipelineState of_array = screen.make("Whole", "OfArray");
  screen.run([&](CommandList& list) { screen.cover(list, of_array); });
  for (const uint32_t at : {2u, 93u, 250u}) {
    t.close("array", screen.texel<float>(at, 255 - at, 0), 2, tolerance_of(t));
  }
}

void calculated_levels(Context& t) {
  Screen screen = lod_screen(t);
  const Texture texture = numbered_mips(t, 1024);
  const PipelineState pipeline = screen.make("Whole", "Calculated");
  const auto at = [&](uint32_t mips, float scale, uint32_t component) {
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kTexture2D;
    view.Texture2D.MipLevels = mips;
    t.device()
        .CreateShaderResourceView(texture, view, screen.views.GetCPUDescriptorHandle(0))
        .value();
    screen.run([&](CommandList& list) {
      screen.cover(list, pipeline, {.tint = {scale, scale, 0, 0}});
    });
    return screen.texel<float>(70, 130, component);
  };
  t.close("of 11 mips", at(11, 1, 0), 2, tolerance_of(t));
  t.close("of 11 mips, unclamped", at(11, 1, 1), 2, tolerance_of(t));
  t.close("of one mip", at(1, 1, 0), 0, 0);
  t.close("of one mip, unclamped", at(1, 1, 1), 2, tolerance_of(t));
  t.close("magnified", at(11, 0.125f, 0), 0, 0);
  t.close("magnified, unclamped", at(11, 0.125f, 1), -1, tolerance_of(t));
}

void anisotropic_filters(Context& t) {
  Screen screen = lod_screen(t);
  const Texture texture = numbered_mips(t, 1024);
  t.device().CreateShaderResourceView(texture, screen.views.GetCPUDescriptorHandle(0)).value();
  const PipelineState pipeline = screen.make("Whole", "Calculated");
  // 16 x 4 texels: between levels 2 and 4.
  for (const bool turned : {false, true}) {
    screen.run([&](CommandList& list) {
      screen.cover(list, pipeline, {.tint = {turned ? 1.0f : 4.0f, turned ? 4.0f : 1.0f, 0, 0}});
    });
    const auto found = screen.texel<float>(70, 130, 2);
    t.holds("level " + std::to_string(found),
            found >= 2 - tolerance_of(t) && found <= 4 + tolerance_of(t));
  }
}

void comparisons(Context& t) {
  Screen screen = lod_screen(t, 4);
  const PipelineState pipeline = screen.make("Whole", "Compared");
  const auto compare = [&](Format format, float u, float v, float reference, float expected) {
    const bool d16 = format == Format::kD16Unorm;
    TextureDesc desc = {.Width = 2, .Height = 2, .Format = typeless_of_depth(format)};
    desc.Flags = ResourceFlags::kAllowDepthStencil;
    const Texture texture = t.device().CreateTexture(desc).value();
    const std::vector<uint16_t> words = {0, 0, 65535, 65535};
    const std::vector<float> floats = {0, 0, 1, 1};
    UploadTexture(t.device(), t.queue(), texture, 0,
                  d16 ? std::as_bytes(std::span<const uint16_t>(words))
                      : std::as_bytes(std::span<const float>(floats)))
        .value();
    ShaderResourceViewDesc view;
    view.Format = d16 ? Format::kR16Unorm : Format::kR32Float;
    view.ViewDimension = SrvDimension::kTexture2D;
    t.device()
        .CreateShaderResourceView(texture, view, screen.views.GetCPUDescriptorHandle(0))
        .value();
    screen.run([&](CommandList& list) {
      list.ResourceBarrier(ResourceBarrier::Transition(texture, ResourceStates::kCommon,
                                                       ResourceStates::kPixelShaderResource));
      screen.cover(list, pipeline, {.tint = {u, v, reference, 0}});
    });
    const std::string what = std::string(d16 ? "D16" : "D32") + " at " + std::to_string(v) +
                             " with " + std::to_string(reference);
    const float tolerance = t.target().backend == "vulkan" ? 1.0f / 256 : 0;
    t.close(what, screen.texel<float>(1, 1, 0), expected, tolerance);
    t.close(what + ", level 0", screen.texel<float>(1, 1, 1), expected, tolerance);
  };
  for (const Format format : {Format::kD32Float, Format::kD16Unorm}) {
    compare(format, 0.5f, 0.5f, 0.5f, 0.5f);
    compare(format, 0.5f, 0.25f, 0.5f, 0);
    compare(format, 0.25f, 0.75f, 0.5f, 1);
    compare(format, 0.5f, 0.375f, 0.5f, 0.25f);
    compare(format, 0.5f, 0.5f, 0, 1);
    compare(format, 0.5f, 0.5f, -0.5f, 1);
  }
  compare(Format::kD16Unorm, 0.5f, 0.75f, 1.5f, 1);
  compare(Format::kD32Float, 0.5f, 0.75f, 1.5f, 0);
}

void sampling_in_vertex_shaders(Context& t) {
  const auto with = [](const std::string& expression) {
    return "Texture2D<float> texels : register(t0);\nSamplerState s : register(s0);\n"
           "SamplerComparisonState c : register(s1);\n"
           "[shader(\"vertex\")]\nfloat4 vs() : SV_Position { return " +
           expression + "; }\n";
  };
  for (const char* call :
       {"texels.Sample(s, float2(0, 0))", "texels.SampleBias(s, float2(0, 0), 1.0)",
        "texels.SampleCmp(c, float2(0, 0), 0.5)", "texels.CalculateLevelOfDetail(s, float2(0, 0))",
        "ddx(1.0)"}) {
    const Status status = compile(with(call));
    t.refused(call, status);
    if (!status) {
      t.holds("the stage is said: " + status.error().message,
              status.error().message.find("vertex") != std::string::npos);
    }
  }
  Screen screen = lod_screen(t, 4);
  const Texture texture = numbered_mips(t, 1024);
  t.device().CreateShaderResourceView(texture, screen.views.GetCPUDescriptorHandle(0)).value();
  const PipelineState pipeline = screen.make("InVertexShader", "Value");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  t.close("SampleLevel", screen.texel<float>(1, 1, 0), 3, 0x1p-20f);
  t.close("SampleGrad", screen.texel<float>(1, 1, 1), 4, tolerance_of(t));
  t.close("SampleCmpLevelZero", screen.texel<float>(1, 1, 2), 1, 0x1p-20f);
}

}  // namespace

std::vector<RuleTest> ras_lod_tests() {
  return {{"RAS-91", implicit_levels},     {"RAS-93", cubes_and_arrays},
          {"RAS-94", anisotropic_filters}, {"RAS-95", calculated_levels},
          {"RAS-96", comparisons},         {"RAS-97", sampling_in_vertex_shaders}};
}

}  // namespace kaamos::conformance
