// SPDX-License-Identifier: MIT
//
// Rules of the state of draws.
#include <shaders/ras_draws.h>

#include <random>

#include "tests/conformance/ras_draws.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr char kConstantsOnly[] =
    "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), RootConstants(num32BitConstants = 8, b0)";

void arguments_of_their_own(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 32);
  screen.library = kaamos_shaders_ras_draws();
  const PipelineState pipeline = screen.make("Pass", "Tint");
  const PipelineState other = screen.make("Pass", "Value");
  const PipelineState compute =
      t.device()
          .CreateComputePipelineState(
              {screen.root_signature, screen.shader("StoresNumber").Library, "StoresNumber"})
          .value();
  const DrawConstants seven = {.tint = {7, 7, 7, 7}};
  const DrawConstants of_compute = {.tint = {1, 1, 1, 1}, .number = 99};
  screen.run([&](CommandList& list) {
    screen.draw(list, pipeline, screen.rectangle(0, 0, 8, 8), seven);
    list.SetComputeRootSignature(screen.root_signature);
    list.SetComputeRoot32BitConstants(kConstants, of_compute);
    list.SetComputeRootUnorderedAccessView(kOut, screen.words.GetGPUVirtualAddress());
    list.SetPipelineState(compute);
    list.Dispatch(1, 1, 1);
    // Everything but the pipeline is still set.
    list.SetPipelineState(pipeline);
    screen.vertices(list, screen.rectangle(8, 0, 16, 8));
    list.DrawInstanced(6, 1, 0, 0);
    // Another pipeline, and the same signature again, keep the arguments.
    list.SetPipelineState(other);
    list.SetGraphicsRootSignature(screen.root_signature);
    list.SetPipelineState(pipeline);
    screen.vertices(list, screen.rectangle(16, 0, 24, 8));
    list.DrawInstanced(6, 1, 0, 0);
    // Another signature makes them zero.
    const RootSignature another = t.device().CreateRootSignature(kConstantsOnly).value();
    GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
    desc.pRootSignature = another;
    const PipelineState zeroed = screen.make(desc);
    list.SetGraphicsRootSignature(another);
    list.SetPipelineState(zeroed);
    screen.vertices(list, screen.rectangle(0, 8, 32, 16));
    list.DrawInstanced(6, 1, 0, 0);
  });
  t.equal("px that differ", screen.differing<float>([](uint32_t x, uint32_t y) {
    return x < 24 && y < 8 ? 7.0f : 0.0f;
  }),
          0u);
  t.equal("dispatch", t.read(screen.words)[0], 99u);
}

void arguments_of_the_draw(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 32);
  screen.library = kaamos_shaders_ras_draws();
  screen.root_signature =
      t.device()
          .CreateRootSignature(
              "RootConstants(num32BitConstants = 8, b0, visibility = SHADER_VISIBILITY_VERTEX), "
              "RootConstants(num32BitConstants = 8, b0, visibility = SHADER_VISIBILITY_PIXEL)")
          .value();
  const PipelineState pipeline = screen.make("WithOwnConstants", "BothConstants");
  const CpuDescriptorHandle target = screen.rtv();
  CommandList list = t.device().CreateCommandList().value();
  list.ClearRenderTargetView(target, screen.clear_color.data());
  list.SetGraphicsRootSignature(screen.root_signature);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.OMSetRenderTargets(1, &target);
  list.RSSetViewports(Viewport{0, 0, 32, 32, 0, 1});
  list.SetPipelineState(pipeline);
  for (int32_t i = 0; i < 8; ++i) {
    // Changed after each draw: a draw keeps what was set.
    const auto number = static_cast<float>(i);
    list.RSSetScissorRects(Rect{i * 4, 0, i * 4 + 4, 32});
    list.SetGraphicsRoot32BitConstants(0, DrawConstants{.tint = {number, 0, 0, 0}});
    list.SetGraphicsRoot32BitConstants(1, DrawConstants{.tint = {number + 100, 0, 0, 0}});
    list.DrawInstanced(3, 1, 0, 0);
  }
  list.SetGraphicsRoot32BitConstants(0, DrawConstants{.tint = {-1, 0, 0, 0}});
  list.Close().value();
  t.queue().ExecuteAndWait(list).value();
  const auto texels = ReadbackTexture(t.device(), t.queue(), screen.colors[0], 0).value();
  uint32_t wrong = 0;
  for (size_t i = 0; i < 1024; ++i) {
    float found[2];
    std::memcpy(found, texels.data() + i * 16, sizeof found);
    const auto draw = static_cast<float>(i % 32 / 4);
    wrong += std::abs(found[0] - draw) <= 0x1p-16f && found[1] == draw + 100 ? 0 : 1;
  }
  t.equal("px that differ", wrong, 0u);
}

void flags_of_root_signatures(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 4);
  const auto create = [&](const char* signature, const char* vertex) {
    GraphicsPipelineStateDesc desc = screen.desc(vertex, "Tint");
    desc.pRootSignature = t.device().CreateRootSignature(signature).value();
    return t.device().CreateGraphicsPipelineState(desc);
  };
  t.accepted("allowed", create(kConstantsOnly, "Pass"));
  t.refused("a layout without the flag", create("RootConstants(num32BitConstants = 8, b0)", "Pass"),
            "KA0727");
  t.accepted("no layout, no flag", create("RootConstants(num32BitConstants = 8, b0)", "Whole"));
  t.refused("vertex shader denied",
            create("RootFlags(DENY_VERTEX_SHADER_ROOT_ACCESS), "
                   "RootConstants(num32BitConstants = 8, b0)",
                   "Whole"),
            "KA0727");
  t.refused("pixel shader denied",
            create("RootFlags(DENY_PIXEL_SHADER_ROOT_ACCESS), "
                   "RootConstants(num32BitConstants = 8, b0)",
                   "Whole"),
            "KA0727");
}

void reset_unbinds(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 4);
  const PipelineState pipeline = screen.make("Whole", "Tint");
  CommandList list = t.device().CreateCommandList().value();
  screen.begin(list);
  screen.cover(list, pipeline);
  list.Close().value();
  list.Reset().value();
  list.DrawInstanced(3, 1, 0, 0);
  t.refused("draw after Reset", list.Close(), "KA0811");
  list.Reset().value();
  list.SetPipelineState(pipeline);
  list.DrawInstanced(3, 1, 0, 0);
  t.refused("pipeline alone", list.Close());
  // Vertex buffers, blend factor and targets too.
  list.Reset().value();
  screen.begin(list);
  list.Close().value();
  t.accepted("nothing", t.queue().ExecuteAndWait(list));
}

void counts_of_zero(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 8);
  screen.clear_color = {3, 3, 3, 3};
  const PipelineState pipeline = screen.make("Whole", "Tint");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    screen.indices(list, std::vector<uint16_t>{0, 1, 2});
    list.DrawInstanced(0, 1, 0, 0);
    list.DrawInstanced(3, 0, 0, 0);
    list.DrawInstanced(0, 0, 5, 5);
    list.DrawIndexedInstanced(0, 1, 0, 0, 0);
    list.DrawIndexedInstanced(3, 0, 0, 0, 0);
    list.DrawInstanced(2, 1, 0, 0);  // no whole triangle
  });
  t.equal("px that differ", screen.differing<float>([](uint32_t, uint32_t) { return 3.0f; }), 0u);
}

// Everything that a random draw leaves: colours, depth, a sum.
std::vector<uint32_t> image_with(Context& t, uint32_t threads) {
  DeviceDesc device = t.target().device_desc();
  if (t.target().backend != "vulkan") device.Threads = threads;
  Context own(device, t.target());
  Screen screen(own, {Format::kR32Float}, Format::kD32Float);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Value");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].SrcBlend = Blend::kSrcAlpha;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kInvSrcAlpha;
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kLessEqual;
  const PipelineState pipeline = screen.make(desc);
  std::mt19937 random(149);
  std::uniform_real_distribution<float> number(0, 1);
  std::vector<Corner> corners;
  for (uint32_t i = 0; i < 6000; ++i) {
    const float x = number(random) * 256, y = number(random) * 256, z = number(random);
    for (int corner = 0; corner < 3; ++corner) {
      const float px = x + number(random) * 50 - 25, py = y + number(random) * 50 - 25;
      corners.push_back(
          screen.at(px, py, z, 1 + number(random) * 4, {number(random), 0, 0, number(random)}));
    }
  }
  screen.draw(pipeline, corners);
  std::vector<uint32_t> out;
  for (uint32_t y = 0; y < 256; ++y) {
    for (uint32_t x = 0; x < 256; ++x) {
      out.push_back(screen.texel<uint32_t>(x, y));
      out.push_back(screen.depth_bits(x, y));
    }
  }
  return out;
}

void threads_do_not_matter(Context& t) {
  const std::vector<uint32_t> one = image_with(t, 1);
  if (t.target().backend == "vulkan") {
    t.holds("once more", image_with(t, 1) == one);
    return;
  }
  for (const uint32_t threads : {2u, 3u, 7u}) {
    t.holds(std::to_string(threads) + " threads", image_with(t, threads) == one);
  }
}

void timestamps(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Whole", "Tint");
  QueryHeapDesc desc;
  desc.Count = 4;
  const QueryHeap heap = t.device().CreateQueryHeap(desc).value();
  const Buffer result = t.zeros(64);
  screen.run([&](CommandList& list) {
    list.EndQuery(heap, QueryType::kTimestamp, 1);
    Screen::use(list, pipeline);
    list.DrawInstanced(3, 100, 0, 0);
    list.EndQuery(heap, QueryType::kTimestamp, 2);
    list.EndQuery(heap, QueryType::kTimestamp, 3);
    list.ResourceBarrier(ResourceBarrier::Transition(result, ResourceStates::kUnorderedAccess,
                                                     ResourceStates::kCopyDest));
    list.ResolveQueryData(heap, QueryType::kTimestamp, 1, 3, result, 8);
    list.ResourceBarrier(ResourceBarrier::Transition(result, ResourceStates::kCopyDest,
                                                     ResourceStates::kUnorderedAccess));
  });
  const std::vector<uint32_t> words = t.read(result);
  uint64_t times[8];
  std::memcpy(times, words.data(), sizeof times);
  t.holds("time passes in a draw of 6.5 million pixels", times[2] > times[1]);
  t.holds("time does not go back", times[3] >= times[2]);
  t.equal("nothing else is written", times[0] + times[4], 0u);
  const uint64_t frequency = t.queue().GetTimestampFrequency().value();
  t.holds("ticks of a second: " + std::to_string(frequency), frequency >= 1000);
  const double seconds = static_cast<double>(times[2] - times[1]) / static_cast<double>(frequency);
  t.holds("seconds: " + std::to_string(seconds), seconds > 1e-6 && seconds < 60);
}

}  // namespace

std::vector<RuleTest> ras_draw_tests() {
  std::vector<RuleTest> tests = {{"RAS-140", arguments_of_their_own, "*"},
                                 {"RAS-141", arguments_of_the_draw},
                                 {"RAS-142", flags_of_root_signatures},
                                 {"RAS-143", reset_unbinds},
                                 {"RAS-144", counts_of_zero}};
  const auto append = [&](const std::vector<RuleTest>& more) {
    tests.insert(tests.end(), more.begin(), more.end());
  };
  append(ras_indirect_tests());
  tests.push_back({"RAS-149", threads_do_not_matter});
  tests.push_back({"RAS-150", timestamps});
  append(ras_query_tests());
  append(ras_predication_tests());
  append(ras_plane_tests());
  return tests;
}

}  // namespace kaamos::conformance
