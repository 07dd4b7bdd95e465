// SPDX-License-Identifier: MIT
//
// Rules of depth and stencil as planes of a texture.
#include "tests/conformance/ras_draws.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSide = 8;

struct Case {
  Format format;
  uint32_t depth_bits;  // of three quarters
  uint32_t mask;        // of the bits that are defined
};
constexpr Case kCases[] = {{Format::kD24UnormS8Uint, 12582911, 0xFFFFFF},
                           {Format::kD32FloatS8X24Uint, 0x3F400000, 0xFFFFFFFF}};

std::string name_of(const Case& each) {
  return "format " + std::to_string(static_cast<uint32_t>(each.format)) + ": ";
}

template <class T>
std::vector<T> texels(Context& t, const Texture& texture, uint32_t subresource) {
  const auto bytes = ReadbackTexture(t.device(), t.queue(), texture, subresource).value();
  std::vector<T> out(bytes.size() / sizeof(T));
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

// Clears to three quarters and stencil 0xAB.
Screen cleared(Context& t, const Case& each) {
  Screen screen(t, {Format::kR32Float}, each.format, kSide);
  screen.clear_depth = 0.75f;
  screen.run([&](CommandList& list) {
    list.ClearDepthStencilView(screen.dsv(), ClearFlags::kStencil, 0, 0xAB);
  });
  return screen;
}

uint32_t count_of(const std::vector<uint32_t>& texels, uint32_t mask, uint32_t value) {
  uint32_t count = 0;
  for (const uint32_t texel : texels) count += (texel & mask) == value ? 1 : 0;
  return count;
}

void subresources_of_planes(Context& t) {
  TextureDesc desc = {.Width = 16, .Height = 8, .Format = Format::kR24G8Typeless};
  desc.DepthOrArraySize = 3;
  desc.MipLevels = 2;
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = ResourceStates::kDepthWrite;
  t.equal("mips by elements by planes", t.device().CreateTexture(desc).value().subresource_count(),
          12u);
  std::vector<PlacedSubresourceFootprint> layouts;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> row_bytes;
  t.device().GetCopyableFootprints(desc, 5, 2, 0, &layouts, &rows, &row_bytes).value();
  t.holds("depth", layouts[0].Footprint.Format == Format::kR32Typeless);
  t.equal("bytes of a row of depth", row_bytes[0], 32u);
  t.holds("stencil", layouts[1].Footprint.Format == Format::kR8Typeless);
  t.equal("bytes of a row of stencil", row_bytes[1], 16u);
  t.equal("rows", rows[1], 8u);
  t.refused("past the planes", t.device().GetCopyableFootprints(desc, 11, 2, 0, &layouts),
            "KA0817");
}

void planes_are_copied_apart(Context& t) {
  for (const Case& each : kCases) {
    const std::string what = name_of(each);
    Screen screen = cleared(t, each);
    const Texture& texture = screen.depth_texture;
    t.equal(what + "depth", count_of(texels<uint32_t>(t, texture, 0), each.mask, each.depth_bits),
            64u);
    t.equal(what + "stencil", texels<uint8_t>(t, texture, 1), std::vector<uint8_t>(64, 0xAB));
    // Each alone, from a buffer.
    std::vector<uint8_t> numbers(64);
    for (uint8_t i = 0; i < 64; ++i) numbers[i] = i;
    UploadTexture(t.device(), t.queue(), texture, 1, std::as_bytes(std::span(numbers))).value();
    t.equal(what + "stencil from a buffer", texels<uint8_t>(t, texture, 1), numbers);
    t.equal(what + "depth stays",
            count_of(texels<uint32_t>(t, texture, 0), each.mask, each.depth_bits), 64u);
    const std::vector<uint32_t> halves(64, each.depth_bits - 5);
    UploadTexture(t.device(), t.queue(), texture, 0, std::as_bytes(std::span(halves))).value();
    t.equal(what + "depth from a buffer",
            count_of(texels<uint32_t>(t, texture, 0), each.mask, each.depth_bits - 5), 64u);
    t.equal(what + "stencil stays", texels<uint8_t>(t, texture, 1), numbers);
    // A part of stencil to a texture of 8 bits.
    TextureDesc desc = {.Width = 4, .Height = 2, .Format = Format::kR8Uint};
    desc.InitialState = ResourceStates::kCopyDest;
    const Texture bytes = t.device().CreateTexture(desc).value();
    // And all of it to another texture of the same format.
    desc = texture.GetDesc();
    desc.InitialState = ResourceStates::kCopyDest;
    const Texture other = t.device().CreateTexture(desc).value();
    CommandList list = t.device().CreateCommandList().value();
    list.ResourceBarrier(ResourceBarrier::Transition(texture, ResourceStates::kDepthWrite,
                                                     ResourceStates::kCopySource));
    const Box box = {3, 5, 0, 6, 7, 1};
    list.CopyTextureRegion({bytes, 0}, 1, 0, 0, {texture, 1}, &box);
    list.CopyResource(other, texture);
    list.ResourceBarrier(ResourceBarrier::Transition(texture, ResourceStates::kCopySource,
                                                     ResourceStates::kDepthWrite));
    t.queue().ExecuteAndWait(list).value();
    t.equal(what + "a part of stencil", texels<uint8_t>(t, bytes, 0),
            std::vector<uint8_t>{0, 43, 44, 45, 0, 51, 52, 53});
    t.equal(what + "CopyResource, depth",
            count_of(texels<uint32_t>(t, other, 0), each.mask, each.depth_bits - 5), 64u);
    t.equal(what + "CopyResource, stencil", texels<uint8_t>(t, other, 1), numbers);
  }
}

// A float of depth is one in a colour texture, too; 24 bits are not.
void depth_goes_to_numbers(Context& t) {
  for (const Case& each : kCases) {
    Screen screen = cleared(t, each);
    TextureDesc desc = {.Width = kSide, .Height = kSide, .Format = Format::kR32Float};
    desc.InitialState = ResourceStates::kCopyDest;
    const Texture numbers = t.device().CreateTexture(desc).value();
    CommandList list = t.device().CreateCommandList().value();
    list.ResourceBarrier(ResourceBarrier::Transition(
        screen.depth_texture, ResourceStates::kDepthWrite, ResourceStates::kCopySource, 0));
    list.CopyTextureRegion({numbers, 0}, 0, 0, 0, {screen.depth_texture, 0});
    list.ResourceBarrier(ResourceBarrier::Transition(
        screen.depth_texture, ResourceStates::kCopySource, ResourceStates::kDepthWrite, 0));
    if (each.mask != 0xFFFFFFFF) {
      t.refused("24 bits", list.Close(), "KA0819");
      continue;
    }
    t.queue().ExecuteAndWait(list).value();
    t.equal("floats", texels<float>(t, numbers, 0), std::vector<float>(64, 0.75f));
  }
}

// Stencil is read while depth is drawn to.
void planes_have_states(Context& t) {
  Screen screen = cleared(t, kCases[1]);
  const PipelineState pipeline = screen.make("Whole", "Tint");
  const Texture& texture = screen.depth_texture;
  BufferDesc desc;
  desc.SizeInBytes = 8 * 256;
  desc.InitialState = ResourceStates::kCopyDest;
  const Buffer copied = t.device().CreateBuffer(desc).value();
  screen.clears = false;
  screen.run([&](CommandList& list) {
    list.ResourceBarrier(ResourceBarrier::Transition(texture, ResourceStates::kDepthWrite,
                                                     ResourceStates::kCopySource, 1));
    list.CopyTextureRegion({copied, {.Footprint = {Format::kR8Typeless, 8, 8, 1, 256}}}, 0, 0, 0,
                           {texture, 1});
    screen.cover(list, pipeline, {.depth = 0.5f});
    list.ResourceBarrier(ResourceBarrier::Transition(texture, ResourceStates::kCopySource,
                                                     ResourceStates::kDepthWrite, 1));
  });
  t.equal("stencil", t.read(copied)[0], 0xABABABABu);
  t.equal("depth", texels<float>(t, texture, 0), std::vector<float>(64, 0.5f));
}

void wrong_planes(Context& t) {
  Screen screen = cleared(t, kCases[0]);
  const Buffer buffer = t.zeros(8 * 256);
  const auto recorded = [&](uint32_t subresource, Format format) {
    CommandList list = t.device().CreateCommandList().value();
    list.CopyTextureRegion({buffer, {.Footprint = {format, 8, 8, 1, 256}}}, 0, 0, 0,
                           {screen.depth_texture, subresource});
    return list.Close();
  };
  t.accepted("depth as integers", recorded(0, Format::kR32Uint));
  t.accepted("stencil as integers", recorded(1, Format::kR8Uint));
  t.refused("a third plane", recorded(2, Format::kR8Uint), "KA0817");
  t.refused("both at once", recorded(0, Format::kR24G8Typeless), "KA0819");
  t.refused("stencil of 32 bits", recorded(1, Format::kR32Typeless), "KA0819");
}

}  // namespace

std::vector<RuleTest> ras_plane_tests() {
  return {{"RAS-158", subresources_of_planes},
          {"RAS-158", planes_are_copied_apart},
          {"RAS-158", depth_goes_to_numbers},
          {"RAS-158", planes_have_states},
          {"RAS-158", wrong_planes}};
}

}  // namespace kaamos::conformance
