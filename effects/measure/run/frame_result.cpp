// SPDX-License-Identifier: MIT
#include "effects/measure/run/frame_result.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace kaamos::measure {

using namespace kaamos::effects;

rtapi::Result<rtapi::Device> create_device(const Options& options, const Say& message) {
  rtapi::DeviceDesc desc;
  desc.Backend = options.backend;
  desc.Threads = options.threads;
  if (options.precision == "fast") desc.Precision = rtapi::TraversalPrecision::kFast;
  if (options.precision == "exact") desc.Precision = rtapi::TraversalPrecision::kExact;
  desc.CollectStatistics = true;
  desc.Checked = options.checked;
  desc.OnMessage = [message](const rtapi::Message& m) { message(m.Text); };
  return rtapi::CreateDevice(desc);
}

rtapi::Result<std::unique_ptr<FrameRenderer>> create_renderer(const Options& options,
                                                              const Scene& scene,
                                                              const Say& message) {
  const auto device = [&] {
    const auto step = Profile::enter(options.profile, ProfilePart::kStart, "device");
    return create_device(options, message);
  }();
  if (!device) return device.error();
  return FrameRenderer::create(*device, scene, options.frame, northlight_effects(),
                               options.profile);
}

rtapi::Result<FrameResult> read_frame(FrameRenderer& renderer, const LayerChoice& reads) {
  FrameResult out;
  for (const std::string& name : renderer.layers()) {
    if (name != "radiance" && reads && !reads(name)) continue;
    auto image = renderer.read(name);
    if (!image) return image.error();
    (name == "radiance" ? out.radiance : out.layers[name]) = std::move(*image);
  }
  if (renderer.context().set_up) out.passes.push_back(*renderer.context().set_up);
  out.passes.insert(out.passes.end(), renderer.runner().passes().begin(),
                    renderer.runner().passes().end());
  out.left_out = renderer.context().left_out;
  if (renderer.surfaces().raster() != nullptr) {
    const auto primary = renderer.surfaces().compare();
    if (!primary) return primary.error();
    out.primary = *primary;
    const FrameSettings& settings = renderer.context().settings;
    if (settings.structures.coarser_rays > 0 && settings.effects.count("sun") != 0) {
      const auto levels = count_level_mismatch(renderer);
      if (!levels) return levels.error();
      out.levels = *levels;
    }
  }
  return out;
}

rtapi::Result<Outcome> render_frame(FrameRenderer& renderer, const Progress& progress,
                                    FrameResult& result, const LayerChoice& reads) {
  if (const auto s = renderer.render(progress); !is_done(s)) return s;
  auto frame = read_frame(renderer, reads);
  if (!frame) return frame.error();
  result = std::move(*frame);
  return Outcome::kDone;
}

rtapi::Result<Outcome> compare_micromaps(const Options& options, const Scene& scene,
                                         const Progress& progress, FrameResult& result) {
  Options without = options;
  without.frame.structures.opacity_micromaps = 0;
  auto renderer = create_renderer(without, scene, options.say);
  if (!renderer) return renderer.error();
  FrameResult other;
  const auto done =
      render_frame(**renderer, progress, other, [](const std::string&) { return false; });
  if (!is_done(done)) return done;
  const auto add = [](const FrameResult& of, std::uint64_t& calls, double& ms) {
    for (const PassStatistics& pass : of.passes) {
      calls += pass.rays.AnyHitInvocations;
      if (pass.rays.TraceRayCalls != 0) ms += pass.ms;
    }
  };
  MicromapSavings savings;
  add(result, savings.calls, savings.ms);
  add(other, savings.calls_without, savings.ms_without);
  const std::vector<float>&a = result.radiance.values, &b = other.radiance.values;
  const std::size_t channels = result.radiance.channels;
  for (std::size_t i = 0; i < a.size(); i += channels) {
    const auto at = static_cast<std::ptrdiff_t>(i), end = static_cast<std::ptrdiff_t>(i + channels);
    savings.other_pixels += std::equal(a.begin() + at, a.begin() + end, b.begin() + at) ? 0 : 1;
  }
  result.micromaps = savings;
  return Outcome::kDone;
}

}  // namespace kaamos::measure
