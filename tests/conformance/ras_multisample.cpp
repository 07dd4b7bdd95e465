// SPDX-License-Identifier: MIT
//
// Rules of targets with several samples. tests/draws looks at each sample by itself.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "tests/conformance/ras_depth.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSide = 8;
constexpr uint32_t kSamples = 4;

// A target of four samples, and one that it is resolved to.
class Multisampled {
 public:
  Multisampled(Context& t, Format format) : context_(t), format_(format) {
    many_ = make({kSamples, 0}, ResourceStates::kRenderTarget);
    one_ = make({1, 0}, ResourceStates::kResolveDest);
    rtvs_ = t.device()
                .CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1})
                .value();
    t.device().CreateRenderTargetView(many_, rtvs_.GetCPUDescriptorHandle(0)).value();
  }

  void begin(CommandList& list) const {
    const CpuDescriptorHandle target = rtvs_.GetCPUDescriptorHandle(0);
    const float black[4] = {0, 0, 0, 0};
    list.ClearRenderTargetView(target, black);
    list.OMSetRenderTargets(1, &target);
  }
  void resolve(CommandList& list) const {
    list.ResourceBarrier(ResourceBarrier::Transition(many_, ResourceStates::kRenderTarget,
                                                     ResourceStates::kResolveSource));
    list.ResolveSubresource(one_, 0, many_, 0, format_);
  }
  std::vector<std::byte> read() {
    return ReadbackTexture(context_.device(), context_.queue(), one_, 0).value();
  }

 private:
  Texture make(const SampleDesc& samples, ResourceStates state) const {
    return context_.device()
        .CreateTexture({.Width = kSide,
                        .Height = kSide,
                        .Format = format_,
                        .SampleDesc = samples,
                        .Flags = ResourceFlags::kAllowRenderTarget,
                        .InitialState = state})
        .value();
  }

  Context& context_;
  Format format_;
  Texture many_, one_;
  DescriptorHeap rtvs_;
};

// Row y is drawn up to y quarters of pixel (3, y), of whose samples y are left of that: they lie 2,
// 6, 10 and 14 sixteenths from the left.
std::vector<std::byte> draw_quarters(Context& t, Format format) {
  Screen screen(t, {format}, Format::kUnknown, kSide);
  Multisampled target(t, format);
  const QueryHeap queries =
      t.device().CreateQueryHeap({.Type = QueryHeapType::kOcclusion, .Count = 1}).value();
  const Buffer counted =
      t.device()
          .CreateBuffer({.SizeInBytes = sizeof(uint64_t), .Heap = HeapType::kReadback})
          .value();
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
  desc.SampleDesc = {kSamples, 0};
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    target.begin(list);
    list.BeginQuery(queries, QueryType::kOcclusion, 0);
    for (uint32_t y = 0; y <= kSamples; ++y) {
      const auto top = static_cast<float>(y);
      screen.draw(list, pipeline, screen.rectangle(0, top, 3 + top / 4, top + 1));
    }
    list.EndQuery(queries, QueryType::kOcclusion, 0);
    list.ResolveQueryData(queries, QueryType::kOcclusion, 0, 1, counted, 0);
    target.resolve(list);
  });
  uint64_t samples = 0;
  std::memcpy(&samples, counted.Map().value().data(), sizeof samples);
  t.equal("samples", samples, 5u * 3 * kSamples + 0 + 1 + 2 + 3 + 4);
  return target.read();
}

void four_samples(Context& t) {
  const auto floats = draw_quarters(t, Format::kR32Float);
  const auto bytes = draw_quarters(t, Format::kR8G8B8A8Unorm);
  const auto curve = draw_quarters(t, Format::kR8G8B8A8UnormSrgb);
  for (uint32_t y = 0; y <= kSamples; ++y) {
    const std::string row = std::to_string(y) + " quarters";
    const float part = static_cast<float>(y) / 4;
    const auto at = [y](uint32_t x) { return size_t{y} * kSide + x; };
    float found;
    std::memcpy(&found, floats.data() + at(3) * sizeof found, sizeof found);
    t.equal(row, found, part);
    std::memcpy(&found, floats.data() + at(2) * sizeof found, sizeof found);
    t.equal(row + ": left of it", found, 1.0f);
    std::memcpy(&found, floats.data() + at(4) * sizeof found, sizeof found);
    t.equal(row + ": right of it", found, 0.0f);
    const int unorm = std::to_integer<int>(bytes[at(3) * 4]);
    t.holds(row + " of bytes: " + std::to_string(unorm),
            std::abs(static_cast<float>(unorm) - part * 255) <= 0.75f);
    // The average is one of linear values.
    const float encoded =
        part <= 0.0031308f ? part * 12.92f : 1.055f * std::pow(part, 1 / 2.4f) - 0.055f;
    const int srgb = std::to_integer<int>(curve[at(3) * 4]);
    t.holds(row + " of sRGB: " + std::to_string(srgb),
            std::abs(static_cast<float>(srgb) - encoded * 255) <= 1);
  }
}

// A plain line covers all samples of its pixels, a rectangle 1.4 pixels wide those that lie in it.
// One around y = 4 reaches 0.7 pixels to either side. Samples lie 2, 6, 10 and 14 sixteenths below
// the top of a pixel: three of four are covered in the row above, and in the row below.
void lines_of_samples(Context& t) {
  for (const bool rectangles : {false, true}) {
    Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
    Multisampled target(t, Format::kR32Float);
    GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
    desc.SampleDesc = {kSamples, 0};
    desc.PrimitiveTopologyType = PrimitiveTopologyType::kLine;
    desc.RasterizerState.MultisampleEnable = rectangles;
    const PipelineState pipeline = screen.make(desc);
    screen.run([&](CommandList& list) {
      target.begin(list);
      list.IASetPrimitiveTopology(PrimitiveTopology::kLineList);
      const float y = rectangles ? 4.0f : 3.7f;
      screen.draw(list, pipeline, {screen.at(1, y), screen.at(6, y)});
      target.resolve(list);
    });
    const std::vector<std::byte> bytes = target.read();
    for (uint32_t y = 0; y < kSide; ++y) {
      float found;
      std::memcpy(&found, bytes.data() + (size_t{y} * kSide + 3) * sizeof found, sizeof found);
      const bool inside = y == 3 || (rectangles && y == 4);
      t.equal((rectangles ? "rectangle: row " : "row ") + std::to_string(y), found,
              !inside      ? 0.0f
              : rectangles ? 0.75f
                           : 1.0f);
    }
  }
}

}  // namespace

RuleTest ras_multisample_lines_test() {
  return {"RAS-57", lines_of_samples, "*"};
}

RuleTest ras_multisample_test() {
  return {"RAS-153", four_samples, "*"};
}

}  // namespace kaamos::conformance
