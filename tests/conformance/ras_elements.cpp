// SPDX-License-Identifier: MIT
//
// Rules of the elements of vertices.
#include <shaders/ras_assembler.h>

#include <bit>
#include <cstdlib>
#include <limits>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr Format kBitsFormat = Format::kR32G32B32A32Uint;

using Four = std::vector<uint32_t>;
Four bits_of(float x, float y, float z, float w) {
  return {std::bit_cast<uint32_t>(x), std::bit_cast<uint32_t>(y), std::bit_cast<uint32_t>(z),
          std::bit_cast<uint32_t>(w)};
}

// Returns what a shader of ras_assembler.hlsl gets of vertex `start` of a view with one element.
Four element_bits(Context& t, const std::string& shader, const InputElementDesc& element,
                  const VertexBufferView& view, uint32_t start) {
  Screen screen(t, {kBitsFormat}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_assembler();
  GraphicsPipelineStateDesc desc = screen.desc(shader, "WriteBits");
  desc.InputLayout = {element};
  const PipelineState pipeline = screen.make(desc);
  screen.clear_color = {7, 7, 7, 7};
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    list.IASetVertexBuffers(0, view);
    list.DrawInstanced(3, 1, start, 0);
  });
  Four out;
  for (uint32_t c = 0; c < 4; ++c) out.push_back(screen.texel<uint32_t>(2, 2, c));
  return out;
}

// One element of these 32-bit words.
Four converted(Context& t, const std::string& shader, Format format,
               const std::vector<uint32_t>& words) {
  const Buffer buffer = t.upload(words);
  const VertexBufferView view = {buffer.GetGPUVirtualAddress(),
                                 static_cast<uint32_t>(words.size() * 4), 0};
  return element_bits(t, shader, element("VALUE", format), view, 0);
}

void elements_are_converted(Context& t) {
  const auto floats = [&](const char* what, Format format, const std::vector<uint32_t>& words,
                          const Four& expected) {
    const Four found = converted(t, "Floats", format, words);
    // Drivers may multiply by 1/255, which is off by a unit in the last place.
    const int64_t tolerance = t.target().backend == "vulkan" ? 1 : 0;
    for (size_t c = 0; c < 4; ++c) {
      const int64_t off = int64_t{found[c]} - int64_t{expected[c]};
      t.holds(std::string(what) + ", component " + std::to_string(c) + ": " +
                  std::to_string(std::bit_cast<float>(found[c])) + ", expected " +
                  std::to_string(std::bit_cast<float>(expected[c])),
              std::abs(off) <= tolerance);
    }
  };
  floats("R16G16_SNORM", Format::kR16G16Snorm, {0x7FFF8000}, bits_of(-1, 1, 0, 1));
  floats("R8G8B8A8_UNORM", Format::kR8G8B8A8Unorm, {0xFF3300FF}, bits_of(1, 0, 0.2f, 1));
  floats("R8G8B8A8_SNORM", Format::kR8G8B8A8Snorm, {0x7F8081C0}, bits_of(-64.0f / 127, -1, -1, 1));
  floats("B8G8R8A8_UNORM", Format::kB8G8R8A8Unorm, {0x33FF0000}, bits_of(1, 0, 0, 0.2f));
  floats("R10G10B10A2_UNORM", Format::kR10G10B10A2Unorm, {0x400003FF}, bits_of(1, 0, 0, 1.0f / 3));
  floats("R11G11B10_FLOAT", Format::kR11G11B10Float, {0x3C0 | 0x400 << 11}, bits_of(1, 2, 0, 1));
  floats("R16G16_FLOAT", Format::kR16G16Float, {0x3C00C000}, bits_of(-2, 1, 0, 1));
  floats("R16_UNORM", Format::kR16Unorm, {0xFFFF}, bits_of(1, 0, 0, 1));
  floats("R32_FLOAT", Format::kR32Float, {0x7F7FFFFF},
         bits_of(std::numeric_limits<float>::max(), 0, 0, 1));
  floats("R32G32_FLOAT", Format::kR32G32Float, {0x3F800000, 0x40000000}, bits_of(1, 2, 0, 1));
  floats("R32G32B32_FLOAT", Format::kR32G32B32Float, {0x3F800000, 0x40000000, 0xBF800000},
         bits_of(1, 2, -1, 1));
  t.equal("R8G8_UINT", converted(t, "Uints", Format::kR8G8Uint, {0xC8FF}), {255, 200, 0, 1});
  t.equal("R32_UINT", converted(t, "Uints", Format::kR32Uint, {0xFFFFFFFF}), {0xFFFFFFFF, 0, 0, 1});
  t.equal("R16G16_SINT", converted(t, "Ints", Format::kR16G16Sint, {0x7FFF8000}),
          {0xFFFF8000, 0x7FFF, 0, 1});
  t.equal("R8G8B8A8_SINT", converted(t, "Ints", Format::kR8G8B8A8Sint, {0x807F01FF}),
          {0xFFFFFFFF, 1, 0x7F, 0xFFFFFF80});
}

void elements_past_the_view_are_zero(Context& t) {
  const InputElementDesc two_floats = element("VALUE", Format::kR32G32Float);
  const Buffer buffer = t.upload(std::vector<float>(16, 3));
  const GpuVirtualAddress address = buffer.GetGPUVirtualAddress();
  t.equal("inside", element_bits(t, "Floats", two_floats, {address, 24, 8}, 2),
          bits_of(3, 3, 0, 1));
  t.equal("cut off", element_bits(t, "Floats", two_floats, {address, 20, 8}, 2),
          bits_of(0, 0, 0, 1));
  t.equal("past the view", element_bits(t, "Floats", two_floats, {address, 20, 8}, 5),
          bits_of(0, 0, 0, 1));
  t.equal("unbound", element_bits(t, "Floats", two_floats, {}, 0), bits_of(0, 0, 0, 0));
}

void strides_may_be_short(Context& t) {
  std::vector<float> numbers;
  for (int i = 0; i < 32; ++i) numbers.push_back(static_cast<float>(i));
  const GpuVirtualAddress address = t.upload(numbers).GetGPUVirtualAddress();
  InputElementDesc four_floats = element("VALUE", Format::kR32G32B32A32Float);
  t.equal("stride 0", element_bits(t, "Floats", four_floats, {address, 128, 0}, 3),
          bits_of(0, 1, 2, 3));
  four_floats.AlignedByteOffset = 16;
  const VertexBufferView view = {address, 36, 4};
  t.equal("vertex 0", element_bits(t, "Floats", four_floats, view, 0), bits_of(4, 5, 6, 7));
  t.equal("vertex 1", element_bits(t, "Floats", four_floats, view, 1), bits_of(5, 6, 7, 8));
  t.equal("vertex 2", element_bits(t, "Floats", four_floats, view, 2), bits_of(0, 0, 0, 0));
}

void elements_are_appended_in_their_slot(Context& t) {
  Screen screen(t, {kBitsFormat}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_assembler();
  GraphicsPipelineStateDesc desc = screen.desc("Colors", "WriteBits");
  constexpr Format kTwo = Format::kR32G32Float;
  desc.InputLayout = {instance_element("CoLoR", kTwo, 1, 2, 2),
                      instance_element("ColoR", kTwo, 5, 1, 3), element("POSITION", kTwo),
                      instance_element("ColoR", kTwo, 5, 1, 0),
                      instance_element("cOLOr", kTwo, 1, 2, 1)};
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    list.IASetVertexBuffers(0, screen.view(std::vector<float>{-1, 1, 3, 1, -1, -3}, 8));
    list.IASetVertexBuffers(1, screen.view(std::vector<float>{1, 2, 3, 4}, 16));
    list.IASetVertexBuffers(5, screen.view(std::vector<float>{5, 6, 7, 8}, 16));
    list.DrawInstanced(3, 1, 0, 0);
  });
  // From the high byte: COLOR3, COLOR2, COLOR1, COLOR0.
  t.equal("x", screen.texel<uint32_t>(2, 2, 0), 0x05010307u);
  t.equal("y", screen.texel<uint32_t>(2, 2, 1), 0x06020408u);
  // Bytes and halves are aligned to their size.
  desc.InputLayout[2] = element("POSITION", kTwo);
  desc.InputLayout.insert(desc.InputLayout.begin() + 2, element("SPARE", Format::kR8Unorm));
  const PipelineState aligned = screen.make(desc);
  screen.run([&](CommandList& list) {
    Screen::use(list, aligned);
    list.IASetVertexBuffers(0, screen.view(std::vector<float>{0, -1, 1, 0, 3, 1, 0, -1, -3}, 12));
    list.IASetVertexBuffers(1, screen.view(std::vector<float>{1, 2, 3, 4}, 16));
    list.IASetVertexBuffers(5, screen.view(std::vector<float>{5, 6, 7, 8}, 16));
    list.DrawInstanced(3, 1, 0, 0);
  });
  t.equal("x behind a byte", screen.texel<uint32_t>(2, 2, 0), 0x05010307u);
}

void inputs_need_elements(Context& t) {
  Screen screen(t, {kBitsFormat}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_assembler();
  GraphicsPipelineStateDesc desc = screen.desc("Colors", "WriteBits");
  constexpr Format kTwo = Format::kR32G32Float;
  desc.InputLayout = {element("position", kTwo), element("CoLoR", kTwo, 0, 2),
                      element("color", kTwo, 0, 0), element("COLOR", kTwo, 0, 1),
                      element("SPARE", Format::kR32Uint)};
  t.refused("without COLOR3", t.device().CreateGraphicsPipelineState(desc), "KA0723");
  desc.InputLayout.push_back(element("cOLOR", kTwo, 0, 3));
  t.accepted("with a spare element", t.device().CreateGraphicsPipelineState(desc));
}

void classes_of_elements(Context& t) {
  Screen screen(t, {kBitsFormat}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_assembler();
  const auto create = [&](const char* shader, Format format) {
    GraphicsPipelineStateDesc desc = screen.desc(shader, "WriteBits");
    desc.InputLayout = {element("VALUE", format)};
    return t.device().CreateGraphicsPipelineState(desc);
  };
  const auto refused = create("Floats", Format::kR32Uint);
  t.refused("float from R32_UINT", refused, "KA0723");
  if (!refused) {
    const std::string& text = refused.error().message;
    t.holds("names VALUE: " + text, text.find("VALUE") != std::string::npos);
    t.holds("names format 42: " + text, text.find("42") != std::string::npos);
  }
  t.refused("uint from R32_SINT", create("Uints", Format::kR32Sint), "KA0723");
  t.refused("int from R32_UINT", create("Ints", Format::kR32Uint), "KA0723");
  t.refused("uint from R8_UNORM", create("Uints", Format::kR8Unorm), "KA0723");
  t.accepted("float from R8_SNORM", create("Floats", Format::kR8Snorm));
}

}  // namespace

std::vector<RuleTest> ras_element_tests() {
  return {{"RAS-13", elements_are_converted},    {"RAS-14", elements_past_the_view_are_zero, "*"},
          {"RAS-15", strides_may_be_short, "*"}, {"RAS-16", elements_are_appended_in_their_slot},
          {"RAS-17", inputs_need_elements},      {"RAS-18", classes_of_elements}};
}

}  // namespace kaamos::conformance
