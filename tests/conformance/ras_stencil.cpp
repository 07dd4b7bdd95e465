// SPDX-License-Identifier: MIT
//
// Rules of the stencil test.
#include <shaders/ras_depth.h>
#include <shaders/ras_order.h>

#include <algorithm>
#include <cmath>

#include "tests/conformance/ras_depth.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSide = 16;
// What each column of the target holds before a draw.
constexpr uint8_t kColumns[kSide] = {0,    1,    2,    3,    0x0F, 0x10, 0x33, 0x55,
                                     0x7F, 0x80, 0x81, 0xAA, 0xF0, 0xF1, 0xFE, 0xFF};

// A target with stencil, whose values shaders read.
class StencilScreen {
 public:
  StencilScreen(Context& t, Format format)
      : screen(t, {Format::kR32G32B32A32Float}, format, kSide) {
    screen.library = kaamos_shaders_ras_depth();
    const bool d24 = format == Format::kD24UnormS8Uint;
    ShaderResourceViewDesc view;
    view.ViewDimension = SrvDimension::kTexture2D;
    view.Format = d24 ? Format::kR24UnormX8Typeless : Format::kR32FloatX8X24Typeless;
    make_view(view, 0);
    view.Format = d24 ? Format::kX24TypelessG8Uint : Format::kX32TypelessG8X24Uint;
    view.Texture2D.PlaneSlice = 1;
    make_view(view, 1);
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "ReadDepthAndStencil");
    desc.DepthStencilState.DepthEnable = false;
    desc.DSVFormat = Format::kUnknown;
    reader_ = screen.make(desc);
    screen.library = kaamos_shaders_ras_order();
  }

  // Clears, gives each column its stencil, executes what `record` adds, and reads all values.
  void run(const std::function<void(CommandList&)>& record) {
    screen.clears = true;
    screen.run([&](CommandList& list) {
      for (uint32_t x = 0; x < kSide; ++x) {
        const auto left = static_cast<int32_t>(x);
        const Rect column = {left, 0, left + 1, static_cast<int32_t>(kSide)};
        list.ClearDepthStencilView(screen.dsv(), ClearFlags::kStencil, 0, kColumns[x],
                                   {&column, 1});
      }
      record(list);
    });
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      colors_[i] = screen.texel<float>(i % kSide, i / kSide);
    }
    screen.clears = false;
    screen.run([&](CommandList& list) {
      list.ResourceBarrier(ResourceBarrier::Transition(
          screen.depth_texture, ResourceStates::kDepthWrite, ResourceStates::kPixelShaderResource));
      const CpuDescriptorHandle target = screen.rtv();
      list.OMSetRenderTargets(1, &target);
      screen.cover(list, reader_);
      list.ResourceBarrier(ResourceBarrier::Transition(
          screen.depth_texture, ResourceStates::kPixelShaderResource, ResourceStates::kDepthWrite));
    });
  }
  bool colored(uint32_t x, uint32_t y) const { return colors_[y * kSide + x] != 0; }
  float depth(uint32_t x, uint32_t y) const { return screen.texel<float>(x, y, 0); }
  uint32_t stencil(uint32_t x, uint32_t y) const {
    return static_cast<uint32_t>(screen.texel<float>(x, y, 1));
  }
  // Counts the pixels that have another stencil than expected(x, y).
  uint32_t differing(const std::function<uint32_t(uint32_t x, uint32_t y)>& expected) const {
    return screen.count([&](uint32_t x, uint32_t y) { return stencil(x, y) != expected(x, y); });
  }
  uint32_t colored_count() const {
    return screen.count([&](uint32_t x, uint32_t y) { return colored(x, y); });
  }

  Screen screen;

 private:
  void make_view(const ShaderResourceViewDesc& view, uint32_t slot) {
    screen.context()
        .device()
        .CreateShaderResourceView(screen.depth_texture, view,
                                  screen.views.GetCPUDescriptorHandle(slot))
        .value();
  }

  PipelineState reader_;
  std::array<float, kSide* kSide> colors_ = {};
};

bool compares(ComparisonFunc func, int reference, int stored) {
  switch (func) {
    case ComparisonFunc::kNever:
      return false;
    case ComparisonFunc::kLess:
      return reference < stored;
    case ComparisonFunc::kEqual:
      return reference == stored;
    case ComparisonFunc::kLessEqual:
      return reference <= stored;
    case ComparisonFunc::kGreater:
      return reference > stored;
    case ComparisonFunc::kNotEqual:
      return reference != stored;
    case ComparisonFunc::kGreaterEqual:
      return reference >= stored;
    default:
      return true;
  }
}

int operate(StencilOp op, int reference, int stored) {
  switch (op) {
    case StencilOp::kZero:
      return 0;
    case StencilOp::kReplace:
      return reference;
    case StencilOp::kIncrSat:
      return std::min(stored + 1, 255);
    case StencilOp::kDecrSat:
      return std::max(stored - 1, 0);
    case StencilOp::kInvert:
      return 255 - stored;
    case StencilOp::kIncr:
      return (stored + 1) % 256;
    case StencilOp::kDecr:
      return (stored + 255) % 256;
    default:
      return stored;
  }
}

struct Expected {
  bool passed;  // both tests
  uint32_t stencil;
};

Expected expect(const DepthStencilOpDesc& face, int reference, int stored, bool depth_passes) {
  const bool passes =
      compares(face.StencilFunc, reference & face.StencilReadMask, stored & face.StencilReadMask);
  const StencilOp op = !passes         ? face.StencilFailOp
                       : !depth_passes ? face.StencilDepthFailOp
                                       : face.StencilPassOp;
  const int result = operate(op, reference, stored);
  const int mask = face.StencilWriteMask;
  return {passes && depth_passes, static_cast<uint32_t>((result & mask) | (stored & ~mask))};
}

StencilOp op_of(uint32_t number) {
  return static_cast<StencilOp>(number % 8 + 1);
}
ComparisonFunc func_of(uint32_t number) {
  return static_cast<ComparisonFunc>(number % 8 + 1);
}

// Rows 0 to 7 are front facing, the others back facing; of both, the first four pass the depth
// test.
bool is_front(uint32_t y) {
  return y < 8;
}
bool passes_depth(uint32_t y) {
  return y % 8 < 4;
}

void draw_both_faces(StencilScreen& s, CommandList& list, const PipelineState& pipeline) {
  const auto side = static_cast<float>(kSide);
  std::vector<Corner> corners = s.screen.rectangle(0, 0, side, 8);
  std::vector<Corner> back = s.screen.rectangle(0, 8, side, side);
  std::swap(back[0], back[1]);
  std::swap(back[3], back[4]);
  corners.insert(corners.end(), back.begin(), back.end());
  for (const int32_t top : {4, 12}) {
    const Rect nearer = {0, top, static_cast<int32_t>(kSide), top + 4};
    list.ClearDepthStencilView(s.screen.dsv(), ClearFlags::kDepth, 0.25f, 0, {&nearer, 1});
  }
  s.screen.draw(list, pipeline, corners);
}

// All operations in all roles with all functions, for both faces.
void operations_and_functions(Context& t, Format format, uint32_t step) {
  StencilScreen s(t, format);
  constexpr uint8_t kMasks[] = {0xFF, 0x0F, 0xF0, 0x7E, 0xFF, 0x81, 0xFE, 0xAA};
  constexpr uint8_t kReferences[] = {0x81, 0x02, 0x55, 0xF0, 0x00, 0xFF, 0x10};
  for (uint32_t i = 0; i < 64; i += step) {
    GraphicsPipelineStateDesc desc = s.screen.desc("Pass", "Tint");
    DepthStencilDesc& state = desc.DepthStencilState;
    state.StencilEnable = true;
    state.FrontFace = {op_of(i / 8), op_of(i / 8 + 3),    op_of(i / 8 + 5),
                       func_of(i),   kMasks[(i / 8) % 8], kMasks[(i + 3) % 8]};
    state.BackFace = {op_of(i / 8 + 6), op_of(i / 8 + 1),    op_of(i / 8 + 2),
                      func_of(i + 3),   kMasks[(i / 3) % 8], kMasks[(i / 5) % 8]};
    const uint8_t references[] = {kReferences[i % 7], kReferences[(i + 2) % 7]};
    const PipelineState pipeline = s.screen.make(desc);
    s.run([&](CommandList& list) {
      // Only the lower 8 bits count.
      list.OMSetFrontAndBackStencilRef(references[0] | 0x100u, references[1] | 0xABCD00u);
      draw_both_faces(s, list, pipeline);
    });
    const auto expected = [&](uint32_t x, uint32_t y) {
      return expect(is_front(y) ? state.FrontFace : state.BackFace, references[is_front(y) ? 0 : 1],
                    kColumns[x], passes_depth(y));
    };
    const std::string what = "format " + std::to_string(static_cast<uint32_t>(format)) +
                             ", state " + std::to_string(i) + ": px ";
    t.equal(what + "of another stencil",
            s.differing([&](uint32_t x, uint32_t y) { return expected(x, y).stencil; }), 0u);
    t.equal(what + "coloured otherwise", s.screen.count([&](uint32_t x, uint32_t y) {
      return s.colored(x, y) != expected(x, y).passed;
    }),
            0u);
    t.equal(what + "of another depth", s.screen.count([&](uint32_t x, uint32_t y) {
      const float z = expected(x, y).passed ? 0.5f : passes_depth(y) ? 1.0f : 0.25f;
      return std::abs(s.depth(x, y) - z) > 1e-6f;
    }),
            0u);
  }
}

// A state that counts what passes both tests.
DepthStencilDesc counting(StencilOp failed = StencilOp::kKeep,
                          StencilOp depth_failed = StencilOp::kKeep) {
  DepthStencilDesc out;
  out.StencilEnable = true;
  out.FrontFace.StencilFailOp = failed;
  out.FrontFace.StencilDepthFailOp = depth_failed;
  out.FrontFace.StencilPassOp = StencilOp::kIncr;
  out.BackFace = out.FrontFace;
  return out;
}

uint32_t one_more(uint32_t x, uint32_t) {
  return (kColumns[x] + 1u) % 256;
}
uint32_t as_before(uint32_t x, uint32_t) {
  return kColumns[x];
}

void discards_and_early_tests(Context& t, Format format) {
  StencilScreen s(t, format);
  const auto draw = [&](const char* pixel, const DepthStencilDesc& state,
                        const DrawConstants& constants) {
    GraphicsPipelineStateDesc desc = s.screen.desc("Whole", pixel);
    desc.DepthStencilState = state;
    const PipelineState pipeline = s.screen.make(desc);
    s.run([&](CommandList& list) { s.screen.cover(list, pipeline, constants); });
  };
  const auto odd_stay = [](uint32_t x, uint32_t y) {
    return x % 2 != 0 ? as_before(x, y) : one_more(x, y);
  };
  draw("CountsWithDiscard", counting(), {});
  t.equal("discarded px keep stencil", s.differing(odd_stay), 0u);
  DepthStencilDesc never = counting(StencilOp::kIncr);
  never.FrontFace.StencilFunc = never.BackFace.StencilFunc = ComparisonFunc::kNever;
  draw("CountsWithDiscard", never, {});
  t.equal("also where the stencil test fails", s.differing(odd_stay), 0u);
  draw("CountsWithDiscard", counting(StencilOp::kKeep, StencilOp::kIncr), {.depth = 1});
  t.equal("and where the depth test fails", s.differing(odd_stay), 0u);
  draw("DiscardsEarly", counting(), {.tint = {1, 1, 1, 0}});
  t.equal("[earlydepthstencil]: discard comes too late", s.differing(one_more), 0u);
  t.equal("and colours stay", s.colored_count(), 0u);
  draw("CountsLate", counting(), {});
  t.equal("a shader that writes memory", s.differing(one_more), 0u);
  draw("OwnDepth", counting(StencilOp::kKeep, StencilOp::kDecr), {.tint = {1, 0, 0, 0}});
  t.equal("SV_Depth that fails",
          s.differing([](uint32_t x, uint32_t) { return (kColumns[x] + 255u) % 256; }), 0u);
  draw("OwnDepth", counting(StencilOp::kKeep, StencilOp::kDecr), {.tint = {0.5f, 0, 0, 0}});
  t.equal("SV_Depth that passes", s.differing(one_more), 0u);
  draw("", counting(), {});
  t.equal("no pixel shader", s.differing(one_more), 0u);
  DepthStencilDesc alone = counting();
  alone.DepthEnable = false;
  draw("Tint", alone, {.depth = 1});
  t.equal("no depth test: stencil", s.differing(one_more), 0u);
  t.equal("no depth test: px", s.colored_count(), kSide * kSide);
  t.equal("no depth test: depth", s.depth(3, 4), 1.0f);
  alone.StencilEnable = false;
  draw("Tint", alone, {});
  t.equal("StencilEnable false", s.differing(as_before), 0u);
}

void views_and_lists(Context& t, Format format) {
  StencilScreen s(t, format);
  GraphicsPipelineStateDesc desc = s.screen.desc("Whole", "Tint");
  desc.DepthStencilState = counting();
  desc.DepthStencilState.FrontFace.StencilFunc = ComparisonFunc::kEqual;
  desc.DepthStencilState.BackFace.StencilFunc = ComparisonFunc::kEqual;
  const PipelineState equal = s.screen.make(desc);
  const auto in_column = [](uint8_t value) {
    return [value](uint32_t x, uint32_t y) {
      return kColumns[x] == value ? one_more(x, y) : as_before(x, y);
    };
  };
  s.run([&](CommandList& list) { s.screen.cover(list, equal); });
  t.equal("the reference is 0 at first", s.differing(in_column(0)), 0u);
  s.run([&](CommandList& list) {
    list.OMSetFrontAndBackStencilRef(7, 9);
    list.OMSetStencilRef(0x155);
    s.screen.cover(list, equal);
    s.screen.cover(list, equal, {.depth = 0.25f});
    list.OMSetStencilRef(0x7F);
    s.screen.cover(list, equal);
  });
  t.equal("a reference for each draw", s.differing([](uint32_t x, uint32_t y) {
    return kColumns[x] == 0x55 || kColumns[x] == 0x7F ? one_more(x, y) : as_before(x, y);
  }),
          0u);
  // Read-only views.
  DepthStencilViewDesc view;
  view.Format = format;
  view.ViewDimension = DsvDimension::kTexture2D;
  const auto draw_to = [&](DsvFlags flags) {
    view.Flags = DsvFlags::kNone;
    t.device().CreateDepthStencilView(s.screen.depth_texture, view, s.screen.dsv()).value();
    s.run([&](CommandList& list) {
      view.Flags = flags;
      t.device().CreateDepthStencilView(s.screen.depth_texture, view, s.screen.dsv()).value();
      s.screen.begin(list);
      list.OMSetStencilRef(2);
      s.screen.cover(list, equal);
    });
  };
  draw_to(DsvFlags::kReadOnlyStencil);
  t.equal("read-only stencil is tested", s.colored_count(), kSide);
  t.equal("and not written", s.differing(as_before), 0u);
  t.holds("but depth is", std::abs(s.depth(2, 5) - 0.5f) < 1e-6f);
  draw_to(DsvFlags::kReadOnlyDepth);
  t.equal("read-only depth: stencil is written", s.differing(in_column(2)), 0u);
  t.equal("and depth is not", s.depth(2, 5), 1.0f);
}

void no_stencil_to_test(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, kSide);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.DepthStencilState = counting();
  desc.DepthStencilState.FrontFace.StencilFunc = ComparisonFunc::kNever;
  desc.DepthStencilState.BackFace.StencilFunc = ComparisonFunc::kNever;
  const PipelineState never = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, never); });
  t.equal("a format without stencil: px", screen.covered(), kSide * kSide);
  screen.run([&](CommandList& list) {
    const CpuDescriptorHandle target = screen.rtv();
    list.OMSetRenderTargets(1, &target);
    screen.cover(list, never);
  });
  t.equal("no depth-stencil view: px", screen.covered(), kSide * kSide);
}

// A closed mesh that goes out through every far wall it came in by: +1 at front faces, -1 at back
// faces, in any order of its triangles.
void closed_meshes_count_to_zero(Context& t, Format format) {
  StencilScreen s(t, format);
  GraphicsPipelineStateDesc desc = s.screen.desc("Pass", "");
  desc.DepthStencilState = counting();
  desc.DepthStencilState.DepthEnable = false;
  desc.DepthStencilState.BackFace.StencilPassOp = StencilOp::kDecr;
  const PipelineState pipeline = s.screen.make(desc);
  const Corner top = s.screen.at(7.3f, 1.1f, 0.3f), left = s.screen.at(0.7f, 9.6f, 0.4f),
               right = s.screen.at(15.2f, 11.9f, 0.2f), far = s.screen.at(6.1f, 14.8f, 0.9f);
  s.run([&](CommandList& list) {
    s.screen.draw(list, pipeline,
                  {top, right, left, top, left, far, top, far, right, left, right, far});
  });
  t.equal("px that are not as before", s.differing(as_before), 0u);
  s.run([&](CommandList& list) { s.screen.draw(list, pipeline, {top, right, left}); });
  t.holds("one face counts", s.differing(as_before) > 20);
}

void stencil_test(Context& t) {
  operations_and_functions(t, Format::kD24UnormS8Uint, 1);
  operations_and_functions(t, Format::kD32FloatS8X24Uint, 3);
  for (const Format format : {Format::kD24UnormS8Uint, Format::kD32FloatS8X24Uint}) {
    discards_and_early_tests(t, format);
    views_and_lists(t, format);
    closed_meshes_count_to_zero(t, format);
  }
  no_stencil_to_test(t);
}

}  // namespace

RuleTest ras_stencil_test() {
  return {"RAS-152", stencil_test, "*"};
}

}  // namespace kaamos::conformance
