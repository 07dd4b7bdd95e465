// SPDX-License-Identifier: MIT
//
// Rules of indirect draws.
#include <shaders/ras_draws.h>

#include <bit>

#include "tests/conformance/ras_draws.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

IndirectArgumentDesc argument(IndirectArgumentType type) {
  return {.Type = type};
}

IndirectArgumentDesc constants(uint32_t offset, uint32_t count) {
  return {.Type = IndirectArgumentType::kConstant, .Constant = {kConstants, offset, count}};
}

void commands_in_order(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 8);
  screen.library = kaamos_shaders_ras_draws();
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].SrcBlend = Blend::kSrcAlpha;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kInvSrcAlpha;
  const PipelineState pipeline = screen.make(desc);
  const CommandSignature signature =
      t.device()
          .CreateCommandSignature(
              {.ByteStride = 24,
               .ArgumentDescs = {constants(0, 1), argument(IndirectArgumentType::kDraw)}},
              screen.root_signature)
          .value();
  std::vector<uint32_t> arguments;
  for (const float red : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
    for (const uint32_t word : {std::bit_cast<uint32_t>(red), 3u, 1u, 0u, 0u, 77u}) {
      arguments.push_back(word);
    }
  }
  const Buffer buffer = t.upload(arguments);
  const Buffer three = t.upload(std::vector<uint32_t>{55, 3});
  const Buffer nine = t.upload(std::vector<uint32_t>{9});
  const auto run = [&](uint32_t count, const Buffer& counts, uint64_t offset) {
    screen.run([&](CommandList& list) {
      Screen::use(list, pipeline, {.tint = {0, 0, 0, 0.5f}});
      list.ExecuteIndirect(signature, count, buffer, 0, counts, offset);
    });
    return screen.texel<float>(3, 4);
  };
  t.equal("3 of 5", run(5, three, 4), 0.125f + 0.5f + 2);
  t.equal("no more than the maximum", run(2, nine, 0), 0.25f + 1);
  t.equal("without a count", run(5, {}, 0), 1.0f / 32 + 0.125f + 0.5f + 2 + 8);
  // Ids begin anew, in indexed draws too.
  desc = screen.desc("Whole", "Facts");
  desc.RTVFormats = {Format::kR32G32B32A32Uint};
  Screen facts(t, desc.RTVFormats, Format::kUnknown, 8);
  const PipelineState ids = facts.make("Whole", "Facts");
  const CommandSignature indexed =
      t.device()
          .CreateCommandSignature(
              {.ByteStride = 20, .ArgumentDescs = {argument(IndirectArgumentType::kDrawIndexed)}})
          .value();
  const Buffer draws = t.upload(
      std::vector<DrawIndexedArguments>{{6, 1, 0, 0, 0}, {3, 2, 3, 0, 4}, {3, 1, 0, 0, 9}});
  const auto last = [&](uint32_t commands) {
    facts.run([&](CommandList& list) {
      Screen::use(list, ids);
      facts.indices(list, std::vector<uint16_t>{0, 1, 2, 3, 4, 5});
      list.ExecuteIndirect(indexed, commands, draws, 0);
    });
    return facts.fact(5, 5);
  };
  t.equal("first: SV_PrimitiveID", last(1).primitive, 1u);
  t.equal("second: SV_PrimitiveID", last(2).primitive, 0u);
  t.equal("second: SV_InstanceID", last(2).instance, 1u);
  t.equal("second: SV_VertexID", last(2).vertex, 3u);
  t.equal("third: SV_InstanceID", last(3).instance, 0u);
}

// A draw with a vertex buffer and a constant from the argument buffer, then one without.
void arguments_are_reset(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 8);
  screen.library = kaamos_shaders_ras_draws();
  GraphicsPipelineStateDesc desc = screen.desc("Fetches", "ReadFetched");
  desc.InputLayout = {element("VALUE", Format::kR32G32Float)};
  const PipelineState pipeline = screen.make(desc);
  const CommandSignature signature =
      t.device()
          .CreateCommandSignature(
              {.ByteStride = 56,
               .ArgumentDescs = {constants(0, 1),
                                 {.Type = IndirectArgumentType::kVertexBufferView,
                                  .VertexBuffer = {0}},
                                 argument(IndirectArgumentType::kIndexBufferView),
                                 argument(IndirectArgumentType::kDrawIndexed)}},
              screen.root_signature)
          .value();
  const VertexBufferView fives = screen.view(std::vector<float>(6, 5.0f), 8);
  const VertexBufferView ones = screen.view(std::vector<float>(6, 1.0f), 8);
  const Buffer indices = t.upload(std::vector<uint16_t>{0, 1, 2});
  std::vector<uint32_t> arguments = {std::bit_cast<uint32_t>(7.0f)};
  const auto address = [&](GpuVirtualAddress value) {
    arguments.push_back(static_cast<uint32_t>(value));
    arguments.push_back(static_cast<uint32_t>(value >> 32));
  };
  address(fives.BufferLocation);
  arguments.insert(arguments.end(), {24, 8});
  address(indices.GetGPUVirtualAddress());
  arguments.insert(arguments.end(), {6, static_cast<uint32_t>(Format::kR16Uint)});
  arguments.insert(arguments.end(), {3, 1, 0, 0, 0});
  const Buffer buffer = t.upload(arguments);
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline, {.tint = {3, 0, 0, 0}});
    list.IASetVertexBuffers(0, ones);
    screen.indices(list, std::vector<uint16_t>{2, 1, 0});
    list.RSSetScissorRects(Rect{0, 0, 4, 8});
    list.ExecuteIndirect(signature, 1, buffer, 0);
    list.RSSetScissorRects(Rect{4, 0, 8, 8});
    list.DrawInstanced(3, 1, 0, 0);
  });
  t.equal("value in the command", screen.texel<float>(1, 1, 0), 5.0f);
  t.equal("constant in the command", screen.texel<float>(1, 1, 1), 7.0f);
  t.equal("value afterwards: unbound", screen.texel<float>(6, 1, 0), 0.0f);
  t.equal("constant afterwards", screen.texel<float>(6, 1, 1), 0.0f);
  t.equal("drawn", screen.texel<float>(6, 1, 3), 1.0f);
  // The index buffer too: all indices are 0, so nothing has an area.
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    screen.indices(list, std::vector<uint16_t>{2, 1, 0});
    list.ExecuteIndirect(signature, 0, buffer, 0);
    list.DrawIndexedInstanced(3, 1, 0, 0, 0);
  });
  t.equal("index buffer afterwards",
          screen.count([&](uint32_t x, uint32_t y) { return screen.texel<float>(x, y, 3) != 0; }),
          0u);
}

void signatures_of_draws(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 4);
  const auto create = [&](uint32_t stride, std::vector<IndirectArgumentDesc> arguments,
                          bool with_root) {
    return t.device().CreateCommandSignature(
        {.ByteStride = stride, .ArgumentDescs = std::move(arguments)},
        with_root ? screen.root_signature : RootSignature());
  };
  const IndirectArgumentDesc draw = argument(IndirectArgumentType::kDraw);
  t.accepted("constants, draw", create(20, {constants(0, 1), draw}, true));
  t.refused("draw, constants", create(20, {draw, constants(0, 1)}, true), "KA0540");
  t.refused("no draw", create(4, {constants(0, 1)}, true), "KA0540");
  t.refused("two draws", create(32, {draw, draw}, true), "KA0540");
  t.refused("constants without a root signature", create(20, {constants(0, 1), draw}, false));
  t.accepted("a draw alone without one", create(16, {draw}, false));
  t.refused("a stride too small", create(12, {draw}, false), "KA0540");
  t.refused("a stride of 18", create(18, {draw}, false), "KA0540");
  t.accepted("a stride of 20", create(20, {draw}, false));
}

void views_of_living_buffers(Context& t) {
  Context own(t.target().device_desc(), t.target());
  Screen screen(own, {Format::kR32G32B32A32Float}, Format::kUnknown, 8);
  screen.library = kaamos_shaders_ras_draws();
  GraphicsPipelineStateDesc desc = screen.desc("Fetches", "ReadFetched");
  desc.InputLayout = {element("VALUE", Format::kR32G32Float)};
  const PipelineState pipeline = screen.make(desc);
  const CommandSignature signature =
      own.device()
          .CreateCommandSignature(
              {.ByteStride = 32,
               .ArgumentDescs = {{.Type = IndirectArgumentType::kVertexBufferView,
                                  .VertexBuffer = {0}},
                                 argument(IndirectArgumentType::kDraw)}})
          .value();
  const Buffer buffer = own.upload(
      std::vector<uint32_t>{0x1230, 0x7F000000, 24, 8, 3, 1, 0, 0});  // an address of nothing
  CommandList list = own.device().CreateCommandList().value();
  screen.begin(list);
  Screen::use(list, pipeline);
  list.ExecuteIndirect(signature, 1, buffer, 0);
  list.Close().value();
  t.refused("an address in no buffer", own.queue().ExecuteAndWait(list), "KA0898");
}

}  // namespace

std::vector<RuleTest> ras_indirect_tests() {
  return {{"RAS-145", commands_in_order, "*"},
          {"RAS-146", arguments_are_reset, "*"},
          {"RAS-147", signatures_of_draws},
          {"RAS-148", views_of_living_buffers}};
}

}  // namespace kaamos::conformance
