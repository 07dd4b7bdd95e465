// SPDX-License-Identifier: MIT
//
// Rules of queries of draws, and of predication.
#include <shaders/ras_draws.h>
#include <shaders/ras_order.h>

#include <random>

#include "tests/conformance/ras_draws.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSize = 64;
constexpr uint64_t kAll = kSize * kSize;
constexpr uint64_t kSentinel = 0x7777777777777777;

// A heap of eight queries, and what they are resolved to.
class Queries {
 public:
  Queries(Context& t, QueryHeapType type) : context_(t) {
    QueryHeapDesc desc;
    desc.Type = type;
    desc.Count = 8;
    heap = t.device().CreateQueryHeap(desc).value();
    BufferDesc buffer;
    buffer.SizeInBytes = 8 * sizeof(QueryDataPipelineStatistics);
    buffer.InitialState = ResourceStates::kCopyDest;
    result_ = t.device().CreateBuffer(buffer).value();
  }
  // In a list of its own.
  template <class T>
  std::vector<T> resolve(QueryType type, uint32_t count) {
    const Buffer sentinel = context_.upload(std::vector<uint64_t>(8 * sizeof(T) / 8, kSentinel));
    CommandList list = context_.device().CreateCommandList().value();
    list.CopyBufferRegion(result_, 0, sentinel, 0, 8 * sizeof(T));
    list.ResolveQueryData(heap, type, 0, count, result_, 0);
    context_.queue().ExecuteAndWait(list).value();
    const auto bytes = ReadbackBuffer(context_.device(), context_.queue(), result_).value();
    std::vector<T> out(count);
    std::memcpy(static_cast<void*>(out.data()), bytes.data(), count * sizeof(T));
    uint64_t behind;
    std::memcpy(&behind, bytes.data() + count * sizeof(T), sizeof behind);
    if (count < 8) context_.equal("nothing else is written", behind, kSentinel);
    return out;
  }

  QueryHeap heap;

 private:
  Context& context_;
  Buffer result_;
};

Screen query_screen(Context& t, Format depth = Format::kD32Float) {
  Screen screen(t, {Format::kR32G32B32A32Float}, depth, kSize);
  screen.library = kaamos_shaders_ras_order();
  return screen;
}

// What one query finds about the draws of `record`.
uint64_t samples(Screen& screen, Queries& queries, const std::function<void(CommandList&)>& record,
                 QueryType type = QueryType::kOcclusion) {
  screen.run([&](CommandList& list) {
    list.BeginQuery(queries.heap, type, 0);
    record(list);
    list.EndQuery(queries.heap, type, 0);
  });
  return queries.resolve<uint64_t>(type, 1)[0];
}

void samples_that_pass(Context& t) {
  Screen screen = query_screen(t);
  Queries queries(t, QueryHeapType::kOcclusion);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Value");
  const PipelineState pass = screen.make(desc);
  const PipelineState tint = screen.make("Whole", "Tint");
  const auto count = [&](const std::function<void(CommandList&)>& record) {
    return samples(screen, queries, record);
  };
  t.equal("all", count([&](CommandList& list) { screen.cover(list, tint); }), kAll);
  t.equal("nothing drawn", count([](CommandList&) {}), 0u);
  t.equal("scissor", count([&](CommandList& list) {
            list.RSSetScissorRects(Rect{3, 5, 13, 9});
            screen.cover(list, tint);
          }),
          40u);
  t.equal("behind the half", count([&](CommandList& list) {
            screen.draw(list, pass, screen.rectangle(0, 0, 32, kSize, 0.25f));
            screen.cover(list, tint);
          }),
          kAll / 2 + kAll / 2);
  screen.run([&](CommandList& list) {
    screen.draw(list, pass, screen.rectangle(0, 0, 32, kSize, 0.25f));
    list.BeginQuery(queries.heap, QueryType::kOcclusion, 0);
    screen.cover(list, tint);
    list.EndQuery(queries.heap, QueryType::kOcclusion, 0);
    screen.cover(list, tint, {.depth = 0.125f});
  });
  t.equal("between other draws", queries.resolve<uint64_t>(QueryType::kOcclusion, 1)[0], kAll / 2);
  desc = screen.desc("Whole", "Tint");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  const PipelineState always = screen.make(desc);
  t.equal("each triangle", count([&](CommandList& list) {
            Screen::use(list, always);
            list.DrawInstanced(3, 10, 0, 0);
          }),
          10 * kAll);
  desc.DepthStencilState.DepthEnable = false;
  desc.BlendState.RenderTarget[0].RenderTargetWriteMask = ColorWriteEnable::kNone;
  const PipelineState unseen = screen.make(desc);
  t.equal("nothing written", count([&](CommandList& list) { screen.cover(list, unseen); }), kAll);
}

void samples_of_shaders(Context& t) {
  Screen screen = query_screen(t);
  Queries queries(t, QueryHeapType::kOcclusion);
  const auto count = [&](const PipelineState& pipeline, float z) {
    return samples(screen, queries,
                   [&](CommandList& list) { screen.cover(list, pipeline, {.depth = z}); });
  };
  screen.clear_depth = 0.5f;
  const PipelineState none = screen.make("Whole", "");
  t.equal("no pixel shader, in front", count(none, 0.25f), kAll);
  t.equal("no pixel shader, behind", count(none, 0.75f), 0u);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "");
  desc.DepthStencilState.DepthEnable = false;
  t.equal("no pixel shader, no test", count(screen.make(desc), 0.75f), kAll);
  const PipelineState discards = screen.make("Whole", "CountsWithDiscard");
  t.equal("discard", count(discards, 0.25f), kAll / 2);
  t.equal("discard, behind", count(discards, 0.75f), 0u);
  desc = screen.desc("Whole", "CountsWithDiscard");
  desc.DepthStencilState.DepthEnable = false;
  t.equal("discard, no test", count(screen.make(desc), 0.75f), kAll / 2);
  const PipelineState late = screen.make("Whole", "CountsLate");
  t.equal("stores, in front", count(late, 0.25f), kAll);
  t.equal("stores, behind", count(late, 0.75f), 0u);
  t.equal("stored", t.read(screen.words)[0], static_cast<uint32_t>(2 * kAll));
  const PipelineState early = screen.make("Whole", "CountsEarly");
  t.equal("early, in front", count(early, 0.25f), kAll);
  t.equal("early, behind", count(early, 0.75f), 0u);
  t.equal("stored early", t.read(screen.words)[0], static_cast<uint32_t>(3 * kAll));
  screen.library = nullptr;
  const PipelineState own = screen.make("Whole", "OwnDepth");
  const auto own_depth = [&](float z) {
    return samples(screen, queries, [&](CommandList& list) {
      screen.cover(list, own, {.tint = {z, 0, 0, 1}, .depth = 0.125f});
    });
  };
  t.equal("SV_Depth, in front", own_depth(0.25f), kAll);
  t.equal("SV_Depth, behind", own_depth(0.75f), 0u);
}

void samples_of_stencil(Context& t) {
  Screen screen = query_screen(t, Format::kD32FloatS8X24Uint);
  Queries queries(t, QueryHeapType::kOcclusion);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  DepthStencilDesc& state = desc.DepthStencilState;
  state.DepthEnable = false;
  state.StencilEnable = true;
  state.FrontFace.StencilFunc = state.BackFace.StencilFunc = ComparisonFunc::kAlways;
  state.FrontFace.StencilPassOp = state.BackFace.StencilPassOp = StencilOp::kReplace;
  const PipelineState writes = screen.make(desc);
  state.FrontFace.StencilFunc = state.BackFace.StencilFunc = ComparisonFunc::kEqual;
  for (const char* const shader : {"Tint", "CountsWithDiscard"}) {
    desc.PS = screen.shader(shader);
    const PipelineState tests = screen.make(desc);
    screen.run([&](CommandList& list) {
      list.ClearDepthStencilView(screen.dsv(), ClearFlags::kStencil, 0, 3);
      list.OMSetStencilRef(7);
      list.RSSetScissorRects(Rect{0, 0, kSize, 16});
      screen.cover(list, writes);
      list.RSSetScissorRects(Rect{0, 0, kSize, kSize});
      list.BeginQuery(queries.heap, QueryType::kOcclusion, 0);
      screen.cover(list, tests);
      list.EndQuery(queries.heap, QueryType::kOcclusion, 0);
    });
    t.equal(std::string("a quarter, ") + shader,
            queries.resolve<uint64_t>(QueryType::kOcclusion, 1)[0],
            shader[0] == 'T' ? kAll / 4 : kAll / 8);
  }
}

// Queries overlap each other, renderings, clears, copies and dispatches.
void queries_overlap(Context& t) {
  Screen screen = query_screen(t);
  screen.library = kaamos_shaders_ras_draws();
  Queries queries(t, QueryHeapType::kOcclusion);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  const PipelineState pipeline = screen.make(desc);
  const PipelineState compute =
      t.device()
          .CreateComputePipelineState(
              {screen.root_signature, screen.shader("StoresNumber").Library, "StoresNumber"})
          .value();
  const CpuDescriptorHandle rtv = screen.rtv();
  const CpuDescriptorHandle dsv = screen.dsv();
  constexpr QueryType kOne = QueryType::kOcclusion;
  constexpr QueryType kBinary = QueryType::kBinaryOcclusion;
  screen.run([&](CommandList& list) {
    const auto draw = [&](int32_t pixels) {
      list.RSSetScissorRects(Rect{0, 0, pixels, 1});
      screen.cover(list, pipeline);
    };
    draw(60);
    list.BeginQuery(queries.heap, kBinary, 3);  // nothing is in it
    list.EndQuery(queries.heap, kBinary, 3);
    list.BeginQuery(queries.heap, kOne, 0);
    draw(1);
    list.BeginQuery(queries.heap, kOne, 1);
    list.BeginQuery(queries.heap, kBinary, 2);
    draw(2);
    const float color[4] = {1, 2, 3, 4};
    list.ClearRenderTargetView(rtv, color);
    list.OMSetRenderTargets(1, &rtv);
    list.OMSetRenderTargets(1, &rtv, false, &dsv);
    draw(4);
    list.EndQuery(queries.heap, kOne, 0);
    list.SetComputeRootSignature(screen.root_signature);
    list.SetComputeRoot32BitConstants(kConstants, DrawConstants{});
    list.SetComputeRootUnorderedAccessView(kOut, screen.words.GetGPUVirtualAddress());
    list.SetPipelineState(compute);
    list.Dispatch(1, 1, 1);
    draw(8);
    list.ClearDepthStencilView(dsv, ClearFlags::kDepth, 0.5f, 0);
    list.OMSetRenderTargets(0, nullptr, false, &dsv);
    list.OMSetRenderTargets(1, &rtv, false, &dsv);
    draw(16);
    list.EndQuery(queries.heap, kOne, 1);
    list.EndQuery(queries.heap, kBinary, 2);
    draw(32);
  });
  const auto found = queries.resolve<uint64_t>(kOne, 2);
  t.equal("first", found[0], 7u);
  t.equal("second", found[1], 30u);
  const auto binary = queries.resolve<uint64_t>(kBinary, 4);
  t.equal("binary", binary[2], 1u);
  t.equal("binary, nothing drawn", binary[3], 0u);
  // The same query again, many times: each begins at zero.
  screen.run([&](CommandList& list) {
    for (int32_t i = 0; i < 100; ++i) {
      list.BeginQuery(queries.heap, kOne, static_cast<uint32_t>(i % 5));
      list.RSSetScissorRects(Rect{0, 0, i % static_cast<int32_t>(kSize) + 1, 1});
      screen.cover(list, pipeline);
      list.EndQuery(queries.heap, kOne, static_cast<uint32_t>(i % 5));
    }
  });
  t.equal("the last of each", queries.resolve<uint64_t>(kOne, 5),
          std::vector<uint64_t>{32, 33, 34, 35, 36});
}

void occlusion_depends_on_no_threads(Context& t) {
  if (t.target().backend == "vulkan") return;
  std::vector<uint64_t> found;
  for (const uint32_t threads : {1u, 7u}) {
    DeviceDesc device = t.target().device_desc();
    device.Threads = threads;
    Context own(device, t.target());
    Screen screen(own, {Format::kR32Float}, Format::kD32Float);
    Queries queries(own, QueryHeapType::kOcclusion);
    const PipelineState pipeline = screen.make("Pass", "Value");
    std::mt19937 random(151);
    std::uniform_real_distribution<float> number(0, 1);
    std::vector<Corner> corners;
    for (uint32_t i = 0; i < 15000; ++i) {
      corners.push_back(screen.at(number(random) * 256, number(random) * 256, number(random), 1));
    }
    found.push_back(
        samples(screen, queries, [&](CommandList& list) { screen.draw(list, pipeline, corners); }));
  }
  t.holds("samples: " + std::to_string(found[0]), found[0] > 65536);
  t.equal("threads", found[1], found[0]);
}

void statistics(Context& t) {
  Screen screen = query_screen(t, Format::kUnknown);
  Queries queries(t, QueryHeapType::kPipelineStatistics);
  const PipelineState pass = screen.make("Pass", "Value");
  const PipelineState none = screen.make("Whole", "");
  const PipelineState compute =
      t.device()
          .CreateComputePipelineState(
              {screen.root_signature, screen.shader("TracesThreads").Library, "TracesThreads"})
          .value();
  const Buffer scene = t.scene({triangle(5)});
  constexpr QueryType kType = QueryType::kPipelineStatistics;
  screen.words = t.zeros(64 * 64 * 4);
  screen.run([&](CommandList& list) {
    screen.cover(list, none);
    list.BeginQuery(queries.heap, kType, 0);
    // Two of three triangles can be seen; indices are shared.
    std::vector<Corner> corners = screen.rectangle(0, 0, 32, 32);
    for (const float x : {-200.0f, -180.0f, -190.0f}) corners.push_back(screen.at(x, x));
    screen.draw(list, pass, corners);
    list.BeginQuery(queries.heap, kType, 1);
    list.EndQuery(queries.heap, kType, 0);
    list.SetComputeRootSignature(screen.root_signature);
    list.SetComputeRootShaderResourceView(kWords, scene.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(kOut, screen.words.GetGPUVirtualAddress());
    list.SetPipelineState(compute);
    list.Dispatch(2, 3, 1);
    Screen::use(list, none);
    list.DrawInstanced(6, 5, 0, 0);
    list.EndQuery(queries.heap, kType, 1);
    screen.cover(list, none);
  });
  const auto found = queries.resolve<QueryDataPipelineStatistics>(kType, 2);
  const QueryDataPipelineStatistics& first = found[0];
  const QueryDataPipelineStatistics& second = found[1];
  t.equal("IAVertices", first.IAVertices, 9u);
  t.equal("IAPrimitives", first.IAPrimitives, 3u);
  t.holds("VSInvocations: " + std::to_string(first.VSInvocations),
          first.VSInvocations >= 7 && first.VSInvocations <= 9);
  t.equal("CInvocations", first.CInvocations, 3u);
  t.equal("CPrimitives", first.CPrimitives, 2u);
  // With helpers at most the quads of the edges.
  t.holds("PSInvocations: " + std::to_string(first.PSInvocations),
          first.PSInvocations >= 1024 && first.PSInvocations <= 2048);
  t.equal("CSInvocations", first.CSInvocations, 0u);
  t.equal("IAVertices of instances", second.IAVertices, 30u);
  t.equal("IAPrimitives of instances", second.IAPrimitives, 10u);
  t.equal("no pixel shader", second.PSInvocations, 0u);
  t.equal("CSInvocations of 6 groups", second.CSInvocations, 384u);
  for (const auto& one : found) {
    t.equal("no such stages",
            one.GSInvocations + one.GSPrimitives + one.HSInvocations + one.DSInvocations, 0u);
  }
}

void wrong_queries(Context& t) {
  Queries queries(t, QueryHeapType::kOcclusion);
  const auto recorded = [&](const std::function<void(CommandList&)>& record) {
    CommandList list = t.device().CreateCommandList().value();
    record(list);
    return list.Close();
  };
  const auto begin = [&](CommandList& list, QueryType type = QueryType::kOcclusion) {
    list.BeginQuery(queries.heap, type, 1);
  };
  const auto end = [&](CommandList& list, QueryType type = QueryType::kOcclusion) {
    list.EndQuery(queries.heap, type, 1);
  };
  t.accepted("begin and end", recorded([&](CommandList& l) { begin(l), end(l); }));
  t.refused("not ended", recorded([&](CommandList& l) { begin(l); }), "KA0745");
  t.refused("not begun", recorded([&](CommandList& l) { end(l); }), "KA0745");
  t.refused("begun twice", recorded([&](CommandList& l) { begin(l), begin(l), end(l); }), "KA0745");
  t.refused("ended as another type", recorded([&](CommandList& l) {
              begin(l), end(l, QueryType::kBinaryOcclusion), end(l);
            }),
            "KA0745");
  t.refused("of another heap",
            recorded([&](CommandList& l) { begin(l, QueryType::kPipelineStatistics); }), "KA0745");
  t.refused("resolved too early", recorded([&](CommandList& l) {
              begin(l);
              l.ResolveQueryData(queries.heap, QueryType::kOcclusion, 0, 2, t.zeros(16), 0);
              end(l);
            }),
            "KA0745");
  QueryHeapDesc desc;
  desc.Count = 1;
  const QueryHeap times = t.device().CreateQueryHeap(desc).value();
  t.refused("a timestamp",
            recorded([&](CommandList& l) { l.BeginQuery(times, QueryType::kTimestamp, 0); }),
            "KA0745");
}

}  // namespace

std::vector<RuleTest> ras_query_tests() {
  return {{"RAS-151", samples_that_pass},
          {"RAS-151", samples_of_shaders, "KA0458"},
          {"RAS-151", samples_of_stencil},
          {"RAS-151", queries_overlap},
          {"RAS-151, RAS-149", occlusion_depends_on_no_threads},
          {"RAS-151", wrong_queries},
          {"RAS-156", statistics}};
}

}  // namespace kaamos::conformance
