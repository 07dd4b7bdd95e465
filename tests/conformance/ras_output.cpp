// SPDX-License-Identifier: MIT
//
// Rules of outputs: slots, types, conversion to formats, write masks.
#include <shaders/ras_output.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// Draws colours to a target of a format and tells its components.
class Converter {
 public:
  Converter(Context& t, Format format, const char* pixel = "Tint")
      : screen_(t, {format}, Format::kUnknown, 2) {
    screen_.library = kaamos_shaders_ras_output();
    pipeline_ = screen_.make("Whole", pixel);
  }
  template <class T>
  T store(std::array<float, 4> color, uint32_t component = 0) {
    screen_.run([&](CommandList& list) { screen_.cover(list, pipeline_, {.tint = color}); });
    return screen_.texel<T>(1, 1, component);
  }
  template <class T>
  T store(float red) {
    return store<T>({red, red, red, red});
  }

 private:
  Screen screen_;
  PipelineState pipeline_;
};

void slots_with_gaps(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float, Format::kUnknown, Format::kR32Float},
                Format::kUnknown, 8);
  screen.library = kaamos_shaders_ras_output();
  const PipelineState pipeline = screen.make("Whole", "ToThree");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.tint = {1, 2, 3, 4}}); });
  t.equal("target 0", screen.texel<float>(5, 5, 3, 0), 4.0f);
  t.equal("target 2", screen.texel<float>(5, 5, 0, 2), 4.0f);
  Screen one(t, {Format::kR32Float}, Format::kUnknown, 8);
  one.library = kaamos_shaders_ras_output();
  const PipelineState dropping = one.make("Whole", "ToThree");
  one.run([&](CommandList& list) { one.cover(list, dropping, {.tint = {5, 0, 0, 0}}); });
  t.equal("outputs without a slot are dropped", one.texel<float>(5, 5), 5.0f);
}

void undeclared_targets_stay(Context& t) {
  Screen screen(t, {Format::kR32Float, Format::kR32Float}, Format::kUnknown, 8);
  screen.clear_color = {9, 9, 9, 9};
  for (const bool blend : {false, true}) {
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
    desc.BlendState.RenderTarget[0].BlendEnable = blend;
    desc.BlendState.RenderTarget[0].DestBlend = Blend::kZero;
    const PipelineState pipeline = screen.make(desc);
    screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.tint = {3, 0, 0, 0}}); });
    t.equal("target 0", screen.texel<float>(2, 6, 0, 0), 3.0f);
    t.equal(blend ? "target 1, blended" : "target 1", screen.texel<float>(2, 6, 0, 1), 9.0f);
  }
}

void outputs_in_part(Context& t) {
  Converter to(t, Format::kR8G8B8A8Unorm, "TwoComponents");
  t.equal("float2 on RGBA8", to.store<uint32_t>({1, 0.5f, 1, 1}), 0x000080FFu);
}

void classes_of_outputs(Context& t) {
  const auto create = [&](Format format, const char* pixel) {
    Screen screen(t, {format}, Format::kUnknown, 2);
    screen.library = kaamos_shaders_ras_output();
    return t.device().CreateGraphicsPipelineState(screen.desc("Whole", pixel));
  };
  // Native validation only warns, and so does KA0725: a column's bits are taken as they are.
  t.accepted("float4 on R32_UINT", create(Format::kR32Uint, "Tint"));
  t.accepted("float4 on R16_SINT", create(Format::kR16Sint, "Tint"));
  t.accepted("uint4 on R8_UNORM", create(Format::kR8Unorm, "Unsigned"));
  t.accepted("uint4 on R32_FLOAT", create(Format::kR32Float, "Unsigned"));
  t.accepted("int4 on R32_SINT", create(Format::kR32Sint, "Signed"));
  t.accepted("float4 on R8_SNORM", create(Format::kR8Snorm, "Tint"));
}

void to_unorm(Context& t) {
  Converter r8(t, Format::kR8Unorm);
  const std::pair<float, int> cases[] = {{0.5f, 128},      {1.5f, 255}, {kNaN, 0},
                                         {-1, 0},          {kInf, 255}, {0.49f / 255, 0},
                                         {0.51f / 255, 1}, {1, 255},    {254.4f / 255, 254}};
  for (const auto& [value, expected] : cases) {
    t.equal("R8 of " + std::to_string(value), int{r8.store<uint8_t>(value)}, expected);
  }
  for (int i = 0; i <= 255; i += 17) {
    t.equal("R8 of its own", int{r8.store<uint8_t>(static_cast<float>(i) / 255)}, i);
  }
  Converter r16(t, Format::kR16Unorm);
  t.equal("R16 of 0.5", int{r16.store<uint16_t>(0.5f)}, 32768);
  t.equal("R16 of 2", int{r16.store<uint16_t>(2)}, 65535);
  t.equal("R16 of NaN", int{r16.store<uint16_t>(kNaN)}, 0);
  Converter rgba8(t, Format::kR8G8B8A8Unorm);
  t.equal("RGBA8", rgba8.store<uint32_t>({1, 0.5f, 0, 0.25f}), 0x400080FFu);
  Converter bgra8(t, Format::kB8G8R8A8Unorm);
  t.equal("BGRA8", bgra8.store<uint32_t>({1, 0.5f, 0, 0.25f}), 0x40FF8000u);
}

void to_ten_bits(Context& t) {
  Converter to(t, Format::kR10G10B10A2Unorm);
  t.equal("0.5", to.store<uint32_t>({0.5f, 0.5f, 0.5f, 0.5f}),
          512u | 512u << 10 | 512u << 20 | 2u << 30);
  t.equal("out of range", to.store<uint32_t>({2, -1, kNaN, 0.8f}), 1023u | 2u << 30);
  for (uint32_t i = 0; i <= 1023; i += 33) {
    // An error of 0.6 steps is allowed.
    for (const float off : {-0.39f, 0.39f}) {
      const float value = (static_cast<float>(i) + off) / 1023;
      const uint32_t found = to.store<uint32_t>({value, 0, 0, 0}) & 1023;
      if (value <= 1) t.equal(std::to_string(value * 1023) + " steps", found, i);
    }
  }
}

void to_snorm(Context& t) {
  Converter r16(t, Format::kR16Snorm);
  const std::pair<float, int> wide[] = {{-1, -32767}, {0.5f, 16384}, {-0.5f, -16384},
                                        {1, 32767},   {-3, -32767},  {kNaN, 0}};
  for (const auto& [value, expected] : wide) {
    t.equal("R16 of " + std::to_string(value), int{r16.store<int16_t>(value)}, expected);
  }
  Converter r8(t, Format::kR8Snorm);
  const std::pair<float, int> narrow[] = {{-1, -127}, {0.5f, 64}, {-0.5f, -64},
                                          {2, 127},   {-2, -127}, {kNaN, 0}};
  for (const auto& [value, expected] : narrow) {
    t.equal("R8 of " + std::to_string(value), int{r8.store<int8_t>(value)}, expected);
  }
}

void to_half(Context& t) {
  Converter to(t, Format::kR16Float);
  const std::pair<float, uint32_t> cases[] = {
      {0.3f, 0x34CC},  {-0.3f, 0xB4CC},      {65520, 0x7BFF},     {1e6f, 0x7BFF},
      {-1e6f, 0xFBFF}, {kInf, 0x7C00},       {-kInf, 0xFC00},     {1, 0x3C00},
      {1e-7f, 1},      {0x1.8p-15f, 0x0300}, {0x1.FFFp0f, 0x3FFF}};
  for (const auto& [value, expected] : cases) {
    t.equal("R16 of " + std::to_string(value), uint32_t{to.store<uint16_t>(value)}, expected);
  }
  t.holds("NaN", (to.store<uint16_t>(kNaN) & 0x7FFF) > 0x7C00);
}

void to_small_floats(Context& t) {
  Converter to(t, Format::kR11G11B10Float);
  const auto red = [&](float value) { return to.store<uint32_t>({value, 0, 0, 0}) & 0x7FF; };
  const auto blue = [&](float value) { return to.store<uint32_t>({0, 0, value, 0}) >> 22; };
  t.equal("red 1", red(1), 0x3C0u);
  t.equal("red 1.02", red(1.02f), 0x3C1u);   // 1 + 1.28 / 64
  t.equal("red 1.03", red(1.031f), 0x3C1u);  // 1 + 1.98 / 64
  t.equal("red -1", red(-1), 0u);
  t.equal("red 1e6", red(1e6f), 0x7BFu);
  t.equal("red infinity", red(kInf), 0x7C0u);
  t.equal("red -infinity", red(-kInf), 0u);
  t.holds("red NaN", red(kNaN) > 0x7C0u);
  t.equal("blue 1", blue(1), 0x1E0u);
  t.equal("blue 1.06", blue(1.06f), 0x1E1u);  // 1 + 1.92 / 32
  t.equal("blue 1e6", blue(1e6f), 0x3DFu);
}

void narrow_floats(Context& t) {
  to_half(t);
  to_small_floats(t);
}

void wide_values_and_integers(Context& t) {
  Converter r32(t, Format::kR32Float);
  for (const float value : {0.3f, -0.0f, kInf, 0x1p-126f, 3.4e38f}) {
    t.equal("R32_FLOAT", r32.store<uint32_t>(value), std::bit_cast<uint32_t>(value));
  }
  const auto uints = [&](Format format, float value) {
    Converter to(t, format, "Unsigned");
    return to.store<uint32_t>(value);
  };
  t.equal("R32_UINT of 2^31", uints(Format::kR32Uint, 0x1p31f), 0x80000000u);
  t.equal("R8_UINT of 300", uints(Format::kR8G8B8A8Uint, 300), 0xFFFFFFFFu);
  t.equal("R8_UINT of 77", uints(Format::kR8G8B8A8Uint, 77), 0x4D4D4D4Du);
  t.equal("R16_UINT of 70000", uints(Format::kR16G16Uint, 70000), 0xFFFFFFFFu);
  t.equal("R10G10B10A2_UINT of 2000", uints(Format::kR10G10B10A2Uint, 2000), 0xFFFFFFFFu);
  t.equal("R10G10B10A2_UINT of 2", uints(Format::kR10G10B10A2Uint, 2),
          2u | 2u << 10 | 2u << 20 | 2u << 30);
  const auto ints = [&](Format format, float value) {
    Converter to(t, format, "Signed");
    return to.store<uint32_t>(value);
  };
  t.equal("R8_SINT of -200", ints(Format::kR8G8B8A8Sint, -200), 0x80808080u);
  t.equal("R8_SINT of 200", ints(Format::kR8G8B8A8Sint, 200), 0x7F7F7F7Fu);
  t.equal("R16_SINT of -40000", ints(Format::kR16G16Sint, -40000), 0x80008000u);
  t.equal("R32_SINT of -2^31", ints(Format::kR32Sint, -0x1p31f), 0x80000000u);
}

// Equal but for 1 on Vulkan, where drivers may compute the curve less exactly.
void srgb_equal(Context& t, const std::string& what, int found, int expected) {
  const int tolerance = t.target().backend == "vulkan" ? 1 : 0;
  t.holds(what + ": " + std::to_string(found) + ", expected " + std::to_string(expected),
          std::abs(found - expected) <= tolerance);
}

void to_srgb(Context& t) {
  Converter to(t, Format::kR8G8B8A8UnormSrgb);
  const std::pair<float, int> cases[] = {{0.5f, 188}, {0.0031308f, 10}, {0, 0},
                                         {1, 255},    {2, 255},         {-1, 0},
                                         {kNaN, 0},   {0.001f, 3},      {0.2f, 124}};
  for (const auto& [value, expected] : cases) {
    srgb_equal(t, "red of " + std::to_string(value), to.store<uint8_t>(value), expected);
  }
  t.equal("alpha of 0.5", int{to.store<uint8_t>({0, 0, 0, 0.5f}, 3)}, 128);
  Converter bgra(t, Format::kB8G8R8A8UnormSrgb);
  srgb_equal(t, "BGRA: red", bgra.store<uint8_t>({0.5f, 0, 0, 0}, 2), 188);
}

void formats_of_views(Context& t) {
  for (const bool typeless : {true, false}) {
    Screen screen(t, {typeless ? Format::kR8G8B8A8Typeless : Format::kR8G8B8A8Unorm},
                  Format::kUnknown, 8);
    screen.clears = false;
    int found[2] = {};
    int i = 0;
    for (const Format format : {Format::kR8G8B8A8Unorm, Format::kR8G8B8A8UnormSrgb}) {
      RenderTargetViewDesc view;
      view.Format = format;
      view.ViewDimension = RtvDimension::kTexture2D;
      const Status made = t.device().CreateRenderTargetView(screen.colors[0], view, screen.rtv());
      t.accepted("view", made);
      if (!made) return;
      GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
      desc.RTVFormats = {format};
      const PipelineState pipeline = screen.make(desc);
      screen.run([&](CommandList& list) {
        screen.cover(list, pipeline, {.tint = {0.5f, 0.5f, 0.5f, 0.5f}});
      });
      found[i++] = screen.texel<uint8_t>(4, 4);
      t.equal("alpha", int{screen.texel<uint8_t>(4, 4, 3)}, 128);
    }
    t.equal("through UNORM", found[0], 128);
    srgb_equal(t, "through SRGB", found[1], 188);
  }
}

void write_masks(Context& t) {
  const auto masked = [](Screen& screen, const char* pixel, uint32_t mask) {
    screen.library = kaamos_shaders_ras_output();
    GraphicsPipelineStateDesc desc = screen.desc("Whole", pixel);
    desc.BlendState.RenderTarget[0].RenderTargetWriteMask = static_cast<ColorWriteEnable>(mask);
    const PipelineState pipeline = screen.make(desc);
    screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.tint = {1, 1, 1, 1}}); });
  };
  for (uint32_t mask = 0; mask < 16; ++mask) {
    Screen screen(t, {Format::kR8G8B8A8Unorm}, Format::kUnknown, 4);
    screen.clear_color = {0.2f, 0.2f, 0.2f, 0.2f};
    masked(screen, "Tint", mask);
    for (uint32_t c = 0; c < 4; ++c) {
      t.equal("mask " + std::to_string(mask) + ", component " + std::to_string(c),
              int{screen.texel<uint8_t>(3, 1, c)}, (mask >> c & 1) != 0 ? 255 : 51);
    }
  }
  Screen integers(t, {Format::kR16G16B16A16Uint}, Format::kUnknown, 4);
  integers.clear_color = {40, 41, 42, 43};
  masked(integers, "Unsigned", 2);
  for (uint32_t c = 0; c < 4; ++c) {
    t.equal("R16G16B16A16_UINT", int{integers.texel<uint16_t>(3, 1, c)},
            c == 1 ? 1 : 40 + static_cast<int>(c));
  }
  Screen bgra(t, {Format::kB8G8R8A8Unorm}, Format::kUnknown, 4);
  masked(bgra, "Tint", 1);
  t.equal("red of BGRA8", bgra.texel<uint32_t>(0, 0), 0x00FF0000u);
}

}  // namespace

std::vector<RuleTest> ras_output_tests() {
  return {{"RAS-109", slots_with_gaps},
          {"RAS-110", undeclared_targets_stay},
          {"RAS-111", outputs_in_part, "*"},
          {"RAS-112", classes_of_outputs},
          {"RAS-113", to_unorm, "*"},
          {"RAS-113", to_ten_bits, "*"},
          {"RAS-114", to_snorm, "*"},
          {"RAS-115", narrow_floats, "*"},
          {"RAS-116", wide_values_and_integers, "KA0479"},
          {"RAS-117", to_srgb, "*"},
          {"RAS-118", formats_of_views},
          {"RAS-119", write_masks}};
}

}  // namespace kaamos::conformance
