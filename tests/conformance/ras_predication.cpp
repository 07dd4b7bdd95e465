// SPDX-License-Identifier: MIT
//
// Rules of predication.
#include <shaders/ras_draws.h>

#include <iterator>

#include "tests/conformance/ras_draws.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// Predicates of two words each: all zero, a low bit, the highest bit.
enum Predicate : uint64_t { kZero = 0, kOne = 8, kHigh = 16 };

class Predicates {
 public:
  explicit Predicates(Context& t) : screen(t, {Format::kR32Float}, Format::kUnknown, 8) {
    screen.library = kaamos_shaders_ras_draws();
    BufferDesc desc;
    desc.SizeInBytes = 64;
    desc.InitialState = ResourceStates::kPredication;
    buffer = t.device().CreateBuffer(desc).value();
    const Buffer values = t.upload(std::vector<uint64_t>{0, 1, uint64_t{1} << 63});
    CommandList list = t.device().CreateCommandList().value();
    list.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kPredication,
                                                     ResourceStates::kCopyDest));
    list.CopyBufferRegion(buffer, 0, values, 0, 24);
    list.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kCopyDest,
                                                     ResourceStates::kPredication));
    t.queue().ExecuteAndWait(list).value();
  }

  Screen screen;
  Buffer buffer;
};

// Each with its own texel or word: draws of three kinds, clears, dispatches, copies.
void what_is_left_out(Context& t) {
  Predicates p(t);
  Screen& screen = p.screen;
  const PipelineState tint = screen.make("Whole", "Tint");
  const PipelineState compute =
      t.device()
          .CreateComputePipelineState(
              {screen.root_signature, screen.shader("StoresNumber").Library, "StoresNumber"})
          .value();
  IndirectArgumentDesc argument;
  argument.Type = IndirectArgumentType::kDraw;
  const CommandSignature signature =
      t.device().CreateCommandSignature({.ByteStride = 16, .ArgumentDescs = {argument}}).value();
  const Buffer arguments = t.upload(std::vector<DrawArguments>{{3, 1, 0, 0}});
  const Buffer source = t.upload(std::vector<uint32_t>{41, 42, 43, 44});
  BufferDesc copied_desc;
  copied_desc.SizeInBytes = 64;
  copied_desc.InitialState = ResourceStates::kCopyDest;
  const Buffer copied = t.device().CreateBuffer(copied_desc).value();
  const Buffer whole = t.device().CreateBuffer(copied_desc).value();
  TextureDesc texture_desc = {.Width = 2, .Height = 1, .Format = Format::kR32Uint};
  texture_desc.InitialState = ResourceStates::kCopyDest;
  const Texture texture = t.device().CreateTexture(texture_desc).value();
  const Buffer whole_source = t.upload(std::vector<uint32_t>(16, 9));
  const Buffer uav = t.zeros(64);
  t.device()
      .CreateUnorderedAccessView(uav,
                                 {.Format = Format::kR32Uint,
                                  .ViewDimension = UavDimension::kBuffer,
                                  .Buffer = {.NumElements = 16}},
                                 screen.views.GetCPUDescriptorHandle(2))
      .value();
  const CpuDescriptorHandle rtv = screen.rtv();
  struct Found {
    uint32_t draw, indexed, indirect, clear, dispatch, copy, copy_of_texels, copy_of_all, clear_uav,
        immediate;
    bool operator==(const Found&) const = default;
  };
  const auto run = [&](const std::function<void(CommandList&)>& predicate) {
    screen.words = t.zeros(64);
    const std::vector<uint32_t> nothing(16, 0);
    const Buffer zeros = t.upload(nothing);
    screen.run([&](CommandList& list) {
      list.CopyBufferRegion(copied, 0, zeros, 0, 64);
      list.CopyBufferRegion(whole, 0, zeros, 0, 64);
      list.CopyTextureRegion({texture, 0}, 0, 0, 0,
                             {zeros, {.Footprint = {Format::kR32Uint, 2, 1, 1, 256}}});
      const std::vector<uint32_t> none(4, 0);
      list.ClearUnorderedAccessViewUint(screen.views.GetGPUDescriptorHandle(2),
                                        screen.views.GetCPUDescriptorHandle(2), uav, none.data());
      list.SetComputeRootSignature(screen.root_signature);
      list.SetComputeRoot32BitConstants(kConstants, DrawConstants{.number = 5});
      list.SetComputeRootUnorderedAccessView(kOut, screen.words.GetGPUVirtualAddress());
      screen.indices(list, std::vector<uint16_t>{0, 1, 2});
      predicate(list);
      const auto at = [&](int32_t x) { list.RSSetScissorRects(Rect{x, 0, x + 1, 1}); };
      Screen::use(list, tint, {.tint = {3, 0, 0, 0}});
      at(0);
      list.DrawInstanced(3, 1, 0, 0);
      at(1);
      list.DrawIndexedInstanced(3, 1, 0, 0, 0);
      at(2);
      list.ExecuteIndirect(signature, 1, arguments, 0);
      const Rect fourth = {3, 0, 4, 1};
      const float color[4] = {3, 0, 0, 0};
      list.ClearRenderTargetView(rtv, color, {&fourth, 1});
      list.SetPipelineState(compute);
      list.Dispatch(1, 1, 1);
      list.CopyBufferRegion(copied, 0, source, 0, 4);
      list.WriteBufferImmediate(
          {{WriteBufferImmediateParameter{copied.GetGPUVirtualAddress() + 4, 8}}});
      list.CopyTextureRegion({texture, 0}, 0, 0, 0,
                             {source, {.Footprint = {Format::kR32Uint, 2, 1, 1, 256}}});
      list.CopyResource(whole, whole_source);
      const uint32_t sevens[4] = {7, 7, 7, 7};
      list.ClearUnorderedAccessViewUint(screen.views.GetGPUDescriptorHandle(2),
                                        screen.views.GetCPUDescriptorHandle(2), uav, sevens);
    });
    const auto texel = [&](uint32_t x) { return static_cast<uint32_t>(screen.texel<float>(x, 0)); };
    const auto texels = ReadbackTexture(t.device(), t.queue(), texture, 0).value();
    uint32_t first;
    std::memcpy(&first, texels.data(), sizeof first);
    return Found{
        texel(0),          texel(1), texel(2),          texel(3),       t.read(screen.words)[0],
        t.read(copied)[0], first,    t.read(whole)[15], t.read(uav)[3], t.read(copied)[1]};
  };
  const auto predicate = [&](Predicate value, PredicationOp op) {
    return run([&, value, op](CommandList& list) { list.SetPredication(p.buffer, value, op); });
  };
  const Found all = {3, 3, 3, 3, 5, 41, 41, 9, 7, 8};
  const Found none = {0, 0, 0, 0, 0, 0, 0, 0, 0, 8};
  t.holds("no predicate", run([](CommandList&) {}) == all);
  for (const Predicate value : {kOne, kHigh}) {
    const std::string what = "value " + std::to_string(value);
    t.holds(what + ", EQUAL_ZERO", predicate(value, PredicationOp::kEqualZero) == all);
    t.holds(what + ", NOT_EQUAL_ZERO", predicate(value, PredicationOp::kNotEqualZero) == none);
  }
  t.holds("zero, EQUAL_ZERO", predicate(kZero, PredicationOp::kEqualZero) == none);
  t.holds("zero, NOT_EQUAL_ZERO", predicate(kZero, PredicationOp::kNotEqualZero) == all);
  t.holds("ended", run([&](CommandList& list) {
                     list.SetPredication(p.buffer, kZero, PredicationOp::kEqualZero);
                     list.SetPredication({}, 0, PredicationOp::kEqualZero);
                   }) == all);
}

// The value is that of the call, as earlier commands leave it and later ones do not.
void when_it_is_read(Context& t) {
  Predicates p(t);
  Screen& screen = p.screen;
  const PipelineState tint = screen.make("Whole", "Tint");
  const auto write = [&](CommandList& list, uint32_t value) {
    list.ResourceBarrier(ResourceBarrier::Transition(p.buffer, ResourceStates::kPredication,
                                                     ResourceStates::kCopyDest));
    list.WriteBufferImmediate(
        {{WriteBufferImmediateParameter{p.buffer.GetGPUVirtualAddress() + 4, value}}});
    list.ResourceBarrier(ResourceBarrier::Transition(p.buffer, ResourceStates::kCopyDest,
                                                     ResourceStates::kPredication));
  };
  screen.run([&](CommandList& list) {
    const auto draw = [&](int32_t x) {
      list.RSSetScissorRects(Rect{x, 0, x + 1, 1});
      screen.cover(list, tint);
    };
    write(list, 1);
    list.SetPredication(p.buffer, kZero, PredicationOp::kEqualZero);
    write(list, 0);
    draw(0);  // the value was not 0
    list.SetPredication(p.buffer, kZero, PredicationOp::kEqualZero);
    write(list, 1);
    draw(1);  // it was
    list.ClearState();
    screen.begin(list);
    draw(2);  // ClearState ends predication
    list.SetPredication(p.buffer, kOne, PredicationOp::kNotEqualZero);
  });
  t.equal("before a later write", screen.texel<float>(0, 0), 1.0f);
  t.equal("after an earlier write", screen.texel<float>(1, 0), 0.0f);
  t.equal("after ClearState", screen.texel<float>(2, 0), 1.0f);
  screen.run([&](CommandList& list) { screen.cover(list, tint); });
  t.equal("the next list", screen.texel<float>(3, 3), 1.0f);
}

// An occlusion query decides, and is not left out itself.
void queries_and_predicates(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 8);
  const PipelineState tint = screen.make("Whole", "Tint");
  QueryHeapDesc heap_desc;
  heap_desc.Type = QueryHeapType::kOcclusion;
  heap_desc.Count = 1;
  const QueryHeap heap = t.device().CreateQueryHeap(heap_desc).value();
  BufferDesc desc;
  desc.SizeInBytes = 16;
  desc.InitialState = ResourceStates::kCopyDest;
  const Buffer result = t.device().CreateBuffer(desc).value();
  const Buffer decided = t.device().CreateBuffer(desc).value();
  for (const bool seen : {true, false}) {
    screen.run([&](CommandList& list) {
      list.BeginQuery(heap, QueryType::kBinaryOcclusion, 0);
      screen.cover(list, tint, {.tint = {2, 0, 0, 0}, .depth = seen ? 0.5f : 1.0f});
      list.EndQuery(heap, QueryType::kBinaryOcclusion, 0);
      list.ResolveQueryData(heap, QueryType::kBinaryOcclusion, 0, 1, result, 0);
      list.ResourceBarrier(ResourceBarrier::Transition(result, ResourceStates::kCopyDest,
                                                       ResourceStates::kPredication));
      list.SetPredication(result, 0, PredicationOp::kEqualZero);
      list.BeginQuery(heap, QueryType::kOcclusion, 0);
      screen.cover(list, tint, {.tint = {5, 0, 0, 0}, .depth = 0.25f});
      list.EndQuery(heap, QueryType::kOcclusion, 0);
      list.ResolveQueryData(heap, QueryType::kOcclusion, 0, 1, decided, 8);
      list.ResourceBarrier(ResourceBarrier::Transition(result, ResourceStates::kPredication,
                                                       ResourceStates::kCopyDest));
    });
    t.equal("drawn", screen.texel<float>(4, 4), seen ? 5.0f : 0.0f);
    t.equal("counted", t.read(decided)[2], seen ? 64u : 0u);
  }
}

void wrong_predicates(Context& t) {
  Predicates p(t);
  const auto recorded = [&](const Resource& buffer, uint64_t offset, PredicationOp op) {
    CommandList list = t.device().CreateCommandList().value();
    list.SetPredication(buffer, offset, op);
    return list.Close();
  };
  constexpr PredicationOp kOp = PredicationOp::kEqualZero;
  t.accepted("the last value", recorded(p.buffer, 56, kOp));
  t.accepted("none", recorded({}, 3, kOp));
  t.refused("past the end", recorded(p.buffer, 64, kOp), "KA0829");
  t.refused("misaligned", recorded(p.buffer, 4, kOp), "KA0829");
  t.refused("an unknown operation", recorded(p.buffer, 0, static_cast<PredicationOp>(2)), "KA0829");
  t.refused("a texture", recorded(p.screen.colors[0], 0, kOp), "KA0829");
}

}  // namespace

std::vector<RuleTest> ras_predication_tests() {
  return {{"RAS-157", what_is_left_out},
          {"RAS-157", when_it_is_read},
          {"RAS-151, RAS-157", queries_and_predicates, "KA0458"},
          {"RAS-157", wrong_predicates}};
}

}  // namespace kaamos::conformance
