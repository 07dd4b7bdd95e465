// SPDX-License-Identifier: MIT
//
// Rules of order, early and late tests, unordered access views.
#include <shaders/ras_order.h>

#include <algorithm>

#include "tests/conformance/ras_reference.h"
#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

Screen order_screen(Context& t, Format color = Format::kR32G32B32A32Float,
                    Format depth = Format::kUnknown, uint32_t size = 32) {
  Screen screen(t, {color}, depth, size);
  screen.library = kaamos_shaders_ras_order();
  return screen;
}

void triangles_in_order(Context& t) {
  Screen screen = order_screen(t, Format::kR32Float, Format::kUnknown, 64);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "HalfOfElement");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].SrcBlend = Blend::kSrcAlpha;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kInvSrcAlpha;
  const PipelineState pipeline = screen.make(desc);
  std::mt19937 random(98);
  std::vector<Corner> corners = grid_triangles(screen, GridKind::kMedium, 10000, random);
  // Drivers that cut triangles at the target's border round new corners, so none reaches beyond.
  for (Corner& corner : corners) {
    const float w = corner.position[3];
    corner.position[0] = std::clamp(corner.position[0], -w, w);
    corner.position[1] = std::clamp(corner.position[1], -w, w);
  }
  // Halves and small numbers: blending is exact for a while, then rounds alike.
  for (size_t i = 0; i < corners.size(); i += 3) {
    const auto shade = static_cast<float>(random() % 1024);
    for (size_t k = 0; k < 3; ++k) corners[i + k].value = {shade, 0, 0, 0.5f};
  }
  std::vector<float> expected(64 * 64, 0.0f);
  for (size_t i = 0; i < corners.size(); i += 3) {
    const ExactTriangle triangle(screen, &corners[i]);
    triangle.each_pixel([&](uint32_t x, uint32_t y) {
      float& texel = expected[y * 64 + x];
      texel = corners[i].value[0] * 0.5f + texel * 0.5f;
    });
  }
  const bool exact = t.target().backend != "vulkan";
  for (const uint32_t threads : {0u, 1u, 8u}) {
    if (threads != 0 && !exact) continue;  // only the CPU backend has the option
    if (threads == 0) {
      screen.draw(pipeline, corners);
      t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
        const float tolerance = exact ? 0 : 0x1p-12f;
        return !(std::abs(screen.texel<float>(x, y) - expected[y * 64 + x]) <= tolerance);
      }),
              0u);
      continue;
    }
    DeviceDesc device = t.target().device_desc();
    device.Threads = threads;
    Context other(device, t.target());
    Screen again = order_screen(other, Format::kR32Float, Format::kUnknown, 64);
    GraphicsPipelineStateDesc same = again.desc("Pass", "HalfOfElement");
    same.BlendState = desc.BlendState;
    again.draw(again.make(same), corners);
    t.equal(std::to_string(threads) + " threads: px that differ",
            again.differing<float>([&](uint32_t x, uint32_t y) { return expected[y * 64 + x]; }),
            0u);
  }
}

void tests_come_late(Context& t) {
  Screen screen = order_screen(t, Format::kR32G32B32A32Float, Format::kD32Float);
  const PipelineState front = screen.make("Whole", "Tint");
  const PipelineState counts = screen.make("Whole", "CountsLate");
  screen.run([&](CommandList& list) {
    screen.cover(list, front, {.depth = 0.25f});
    screen.cover(list, counts, {.tint = {7, 0, 0, 0}, .depth = 0.5f});
  });
  t.equal("counted", t.read(screen.words)[0], 1024u);
  t.equal("drawn", screen.texel<float>(3, 3), 1.0f);
  // Discarded pixels write no depth, whenever they are tested.
  const PipelineState discards = screen.make("Whole", "CountsWithDiscard");
  screen.run([&](CommandList& list) { screen.cover(list, discards); });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return screen.depth(x, y) != (x % 2 == 0 ? 0.5f : 1.0f);
  }),
          0u);
}

void early_tests(Context& t) {
  Screen screen = order_screen(t, Format::kR32G32B32A32Float, Format::kD32Float);
  const PipelineState front = screen.make("Pass", "Value");
  const PipelineState discards = screen.make("Whole", "DiscardsEarly");
  screen.run([&](CommandList& list) {
    screen.draw(list, front, screen.rectangle(0, 0, 16, 32, 0.25f));
    screen.cover(list, discards, {.tint = {7, 0, 0, 0}, .depth = 0.5f});
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return screen.depth(x, y) != (x < 16 ? 0.25f : 0.5f) ||
           screen.texel<float>(x, y) != (x < 16 ? 1.0f : 0.0f);
  }),
          0u);
  std::vector<uint32_t> words = t.read(screen.words);
  t.equal("counted", words[0], 512u);
  t.equal("after discard", words[1], 0u);
  const PipelineState counts = screen.make("Whole", "CountsEarly");
  screen.run([&](CommandList& list) {
    screen.draw(list, front, screen.rectangle(0, 0, 32, 32, 0.25f));
    screen.cover(list, counts, {.depth = 0.5f});
  });
  words = t.read(screen.words);
  t.equal("all occluded: counted", words[0], 512u);
  const PipelineState ignored = screen.make("Whole", "IgnoredDepth");
  screen.run([&](CommandList& list) { screen.cover(list, ignored); });
  t.equal("SV_Depth is ignored", screen.depth(3, 4), 0.5f);
}

void tests_see_triangles_before(Context& t) {
  Screen screen = order_screen(t, Format::kR32G32B32A32Uint, Format::kD32Float);
  const PipelineState pipeline = screen.make("Whole", "Facts");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    list.DrawInstanced(3, 5, 0, 0);
  });
  t.equal("instances that differ", screen.count([&](uint32_t x, uint32_t y) {
    return !screen.fact(x, y).covered || screen.fact(x, y).instance != 0;
  }),
          0u);
  Screen late = order_screen(t, Format::kR32G32B32A32Float, Format::kD32Float);
  const PipelineState counts = late.make("Whole", "CountsLate");
  late.run([&](CommandList& list) {
    for (const float red : {1.0f, 2.0f, 3.0f}) {
      Screen::use(list, counts, {.tint = {red, 0, 0, 0}});
      list.DrawInstanced(3, 2, 0, 0);
    }
  });
  t.equal("late: px that differ", late.differing<float>([](uint32_t, uint32_t) { return 1.0f; }),
          0u);
}

PipelineState appending(Screen& screen, const char* pixel) {
  GraphicsPipelineStateDesc desc = screen.desc("Whole", pixel);
  desc.RTVFormats = {};
  return screen.make(desc);
}

void atomics_are_complete(Context& t) {
  Screen screen = order_screen(t);
  const PipelineState appends = appending(screen, "Appends");
  screen.run([&](CommandList& list) {
    list.OMSetRenderTargets(0, nullptr);
    Screen::use(list, appends);
    list.DrawInstanced(3, 10, 0, 0);
  });
  const std::vector<uint32_t> words = t.read(screen.words);
  t.equal("all", words[0], 10240u);
  for (uint32_t i = 0; i < 10; ++i) t.equal("each", words[1 + i], 1024u);
}

void ordered_views(Context& t) {
  Screen screen = order_screen(t);
  const PipelineState in_order = appending(screen, "InOrder");
  TextureDesc desc = {.Width = 32, .Height = 32, .Format = Format::kR32Uint};
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  const Texture texture = t.device().CreateTexture(desc).value();
  t.device().CreateUnorderedAccessView(texture, screen.views.GetCPUDescriptorHandle(2)).value();
  screen.run([&](CommandList& list) {
    list.OMSetRenderTargets(0, nullptr);
    // Two draws: their order holds too.
    Screen::use(list, in_order, {.number = 1});
    list.DrawInstanced(3, 50, 0, 0);
    Screen::use(list, in_order, {.number = 70});
    list.DrawInstanced(3, 7, 0, 0);
  });
  uint32_t expected = 0;
  for (uint32_t i = 0; i < 50; ++i) expected = expected * 3 + i + 1;
  for (uint32_t i = 0; i < 7; ++i) expected = expected * 3 + i + 70;
  const auto texels = ReadbackTexture(t.device(), t.queue(), texture, 0).value();
  uint32_t wrong = 0;
  for (size_t i = 0; i < 1024; ++i) {
    uint32_t value;
    std::memcpy(&value, texels.data() + i * 4, 4);
    wrong += value != expected ? 1 : 0;
  }
  t.equal("px that differ", wrong, 0u);
}

void covered_triangles_write(Context& t) {
  Screen screen = order_screen(t);
  const PipelineState counts = screen.make("Whole", "CountsLate");
  const PipelineState opaque = screen.make("Whole", "Tint");
  screen.run([&](CommandList& list) {
    Screen::use(list, counts);
    list.DrawInstanced(3, 10, 0, 0);
    screen.cover(list, opaque, {.tint = {5, 0, 0, 0}});
  });
  t.equal("counted", t.read(screen.words)[0], 10240u);
  t.equal("drawn", screen.texel<float>(8, 8), 5.0f);
}

void vertex_shaders_store(Context& t) {
  Screen screen = order_screen(t);
  const PipelineState pipeline = screen.make("StoresItsId", "Tint");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    list.DrawInstanced(900, 1, 0, 0);
  });
  const std::vector<uint32_t> words = t.read(screen.words);
  uint32_t wrong = 0;
  for (uint32_t i = 0; i < 1024; ++i) wrong += words[i] != (i < 900 ? 1000 + i : 0) ? 1 : 0;
  t.equal("words that differ", wrong, 0u);
}

void draws_without_targets(Context& t) {
  Screen screen = order_screen(t);
  const PipelineState appends = appending(screen, "Appends");
  const auto counted = [&](const Viewport& viewport, const Rect& scissor) {
    const uint32_t before = t.read(screen.words)[0];
    screen.run([&](CommandList& list) {
      list.OMSetRenderTargets(0, nullptr);
      list.RSSetViewports(viewport);
      list.RSSetScissorRects(scissor);
      screen.cover(list, appends);
    });
    return t.read(screen.words)[0] - before;
  };
  t.equal("2 x 2", counted({0, 0, 2, 2, 0, 1}, {0, 0, 2, 2}), 4u);
  t.equal("cut by the scissor", counted({0, 0, 300, 200, 0, 1}, {250, 100, 400, 400}), 5000u);
  t.equal("far away", counted({16000, 9000, 384, 100, 0, 1}, {0, 0, 16384, 16384}), 38400u);
}

void targets_are_in_order_across_draws(Context& t) {
  Screen screen = order_screen(t, Format::kR32G32B32A32Float, Format::kD32Float);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "CountsLate");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kLessEqual;
  const PipelineState counts = screen.make(desc);
  screen.run([&](CommandList& list) {
    for (uint32_t i = 1; i <= 20; ++i) {
      screen.cover(list, counts, {.tint = {static_cast<float>(i), 0, 0, 0}, .depth = 0.5f});
    }
  });
  t.equal("px that differ", screen.differing<float>([](uint32_t, uint32_t) { return 20.0f; }), 0u);
  t.equal("counted", t.read(screen.words)[0], 20480u);
}

void queries_in_draws(Context& t) {
  Screen screen = order_screen(t, Format::kR32G32B32A32Float, Format::kUnknown, 64);
  screen.words = t.zeros(64 * 64 * 4);
  const Buffer scene = t.scene({triangle(5), triangle(4, 2), triangle(3, -3)});
  const PipelineState compute =
      t.device()
          .CreateComputePipelineState(
              {screen.root_signature, screen.shader("TracesThreads").Library, "TracesThreads"})
          .value();
  const PipelineState pixels = screen.make("Whole", "TracesPixels");
  const PipelineState vertices = screen.make("TracesVertices", "ReadTraced");
  screen.run([&](CommandList& list) {
    list.SetComputeRootSignature(screen.root_signature);
    list.SetComputeRootShaderResourceView(kWords, scene.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(kOut, screen.words.GetGPUVirtualAddress());
    list.SetPipelineState(compute);
    list.Dispatch(8, 8, 1);
    list.SetGraphicsRootShaderResourceView(kWords, scene.GetGPUVirtualAddress());
    screen.cover(list, pixels);
  });
  const std::vector<uint32_t> words = t.read(screen.words);
  uint32_t hits = 0;
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    hits += screen.texel<float>(x, y) > 0 ? 1 : 0;
    return screen.texel<uint32_t>(x, y) != words[y * 64 + x];
  }),
          0u);
  t.holds("hits: " + std::to_string(hits), hits > 1000);
  for (const uint32_t place : {10u, 31u, 50u}) {
    screen.run([&](CommandList& list) {
      list.SetGraphicsRootShaderResourceView(kWords, scene.GetGPUVirtualAddress());
      screen.cover(list, vertices, {.number = place});
    });
    t.equal("in a vertex shader", screen.texel<uint32_t>(1, 1), words[place * 64 + place]);
  }
}

}  // namespace

std::vector<RuleTest> ras_order_tests() {
  return {{"RAS-98", triangles_in_order},       {"RAS-99", tests_come_late},
          {"RAS-100", early_tests, "*"},        {"RAS-101", tests_see_triangles_before},
          {"RAS-102", atomics_are_complete},    {"RAS-103", ordered_views},
          {"RAS-104", covered_triangles_write}, {"RAS-105", vertex_shaders_store},
          {"RAS-106", draws_without_targets},   {"RAS-107", targets_are_in_order_across_draws, "*"},
          {"RAS-108", queries_in_draws}};
}

}  // namespace kaamos::conformance
