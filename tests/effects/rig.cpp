// SPDX-License-Identifier: MIT
#include "rig.h"

#include <memory>

#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {

using namespace effects;

namespace {

FrameSettings settings_of(const RigOptions& options) {
  constexpr std::pair<std::uint32_t, const char*> kNames[] = {{kRigAo, "ao"},
                                                              {kRigSun, "sun"},
                                                              {kRigLocal, "local"},
                                                              {kRigContact, "contact"},
                                                              {kRigIndirect, "gi"},
                                                              {kRigReflections, "reflections"},
                                                              {kRigGlass, "transparent"}};
  FrameSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.seed = options.seed;
  settings.rows = options.rows > 0 ? options.rows : options.height;
  settings.denoise = default_denoise(options.denoise);
  for (const auto& [bit, name] : kNames) {
    if ((options.effects & bit) == 0) continue;
    EffectSettings& effect = settings.effects[name];
    effect = find_effect(northlight_effects(), name)->defaults;
    effect.samples = bit == kRigGlass ? 1 : options.samples;
    effect.keep = true;
    if (bit == kRigAo) effect.radius = options.ao_radius;
    if (bit == kRigContact) effect.set_constants(options.contact);
    if (bit == kRigIndirect) effect.set_constants(options.indirect);
    if (bit == kRigReflections) effect.set_constants(options.reflection);
    if (bit == kRigGlass) effect.set_constants(options.glass);
  }
  // A ray that rounding moves may read another cell, and which ones are baked would follow.
  settings.volume.whole = true;
  settings.volume.cell = options.cell;
  settings.volume.samples = options.bake_samples;
  settings.volume.bounces = 2;
  settings.volume.seed = 0;  // another seed is to change the frame's samples alone
  // Only indirect light asks for a volume that has to be baked.
  if (options.volume || (options.effects & kRigIndirect) == 0) {
    settings.volume.given =
        std::make_shared<IndirectVolume>(options.volume.value_or(IndirectVolume{}));
  }
  return settings;
}

// Mirrors are filtered too. Left as they are, a single ray that rounding sends another way would
// show by itself, and pictures could not be compared as closely.
std::vector<Effect> filtered_effects() {
  std::vector<Effect> effects = northlight_effects();
  for (Effect& effect : effects) {
    for (EffectSignal& signal : effect.signals) signal.of_lobe = false;
  }
  return effects;
}

std::unique_ptr<FrameRenderer> make_renderer(const Scene& scene, const RigOptions& options) {
  rtapi::DeviceDesc desc;
  desc.Backend = options.backend;
  desc.Threads = options.threads;
  return FrameRenderer::create(device_for(desc), scene, settings_of(options), filtered_effects())
      .value();
}

// Leaves the first three channels, and puts the fourth into a picture of its own.
void split(Pictures& pictures, const std::string& name, const std::string& fourth = "") {
  const auto found = pictures.find(name);
  if (found == pictures.end()) return;
  FloatImage& from = found->second;
  FloatImage color(from.width, from.height, 3), rest(from.width, from.height, 1);
  for (std::size_t i = 0; i < rest.values.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) color.values[3 * i + c] = from.values[4 * i + c];
    rest.values[i] = from.values[4 * i + 3];
  }
  from = std::move(color);
  if (!fourth.empty()) pictures[fourth] = std::move(rest);
}

Pictures read(FrameRenderer& renderer, const RigOptions& options) {
  Pictures out;
  for (const std::string name : {"ids", "view_z", "normal", "position", "radiance"}) {
    out[name] = renderer.read(name).value();
  }
  out["motion"] = renderer.read(renderer.frame().texture(kMotion)).value();
  for (const auto& signal : renderer.filters().signals().signals()) {
    out[signal.name] = renderer.read(signal.name).value();
    out[signal.name + "_denoised"] = renderer.read(signal.name + "_denoised").value();
  }
  if (const DirectLighting* lighting = renderer.lights().main()) {
    out["direct"] = renderer.read(lighting->direct()).value();
    if ((options.effects & kRigContact) != 0) {
      out["local"] = renderer.read(lighting->total()).value();
    }
  }
  if ((options.effects & kRigGlass) != 0) {
    out["glass"] = renderer.read("glass").value();
    out["transmittance"] = renderer.read("glass_transmittance").value();
  }
  split(out, "glass", "glass_depth");
  split(out, "transmittance", "glass_layers");
  split(out, "indirect", "indirect_length");
  split(out, "reflection", "reflection_length");
  for (const char* name :
       {"radiance", "direct", "local", "indirect_denoised", "reflection_denoised"}) {
    split(out, name);
  }
  return out;
}

}  // namespace

std::vector<Pictures> render_frames(std::span<const Scene> scenes, const RigOptions& options) {
  Scene scene = scenes.front();
  const auto renderer = make_renderer(scene, options);
  std::vector<Pictures> out;
  FrameMoment moment;
  for (const Scene& lit : scenes) {
    scene.lights = lit.lights;
    scene.sun = lit.sun;
    scene.sky = lit.sky;
    moment.camera = scene.cameras.front();
    renderer->begin_frame(moment).value();
    renderer->render().value();
    out.push_back(read(*renderer, options));
    ++moment.index;
  }
  return out;
}

Pictures render(const Scene& scene, const RigOptions& options) {
  return render_frames({&scene, 1}, options).front();
}

}  // namespace kaamos::test
