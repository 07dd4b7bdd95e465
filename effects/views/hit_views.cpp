// SPDX-License-Identifier: MIT
#include <shaders/hit_views.h>

#include <string>
#include <utility>

#include "effects/engine/ray_pass.h"
#include "effects/reflections/traced/reflections.h"
#include "effects/views/view_passes.h"

namespace kaamos::effects {

namespace {

// Mirrors ReflectionLengths of reflection_ray.hlsli.
struct Lengths {
  float longest, shortest, jitter;
};

Lengths lengths_of(const FrameRenderer& renderer) {
  ReflectionConstants constants;
  const auto chosen = renderer.context().settings.effects.find("reflections");
  if (chosen != renderer.context().settings.effects.end()) {
    constants = chosen->second.get_constants<ReflectionConstants>();
  }
  const bool single = constants.single_length != 0;
  return {constants.longest, single ? constants.longest : constants.shortest,
          single ? 0.0f : constants.length_jitter};
}

RayPassDesc hit_view_pass(rtapi::ShaderLibrary library, std::string closest_hit) {
  RayPassDesc desc;
  desc.name = "view of hits";
  desc.library = std::move(library);
  desc.ray_generation = "HitViewRayGen";
  desc.miss[kRayTypeSurface] = "ViewMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"ViewAnyHit", std::move(closest_hit)};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 16;
  desc.max_recursion_depth = 2;  // a lit hit traces a shadow ray to the sun
  return desc;
}

rtapi::Result<FloatImage> view_hits(FrameRenderer& renderer, const std::string& closest_hit,
                                    bool is_lit) {
  const auto library = hit_views_library();
  if (!library) return library.error();
  const rtapi::Device& device = renderer.device();
  const Frame& frame = renderer.frame();
  const auto pass =
      RayPass::create(device, frame, renderer.context().gpu, hit_view_pass(*library, closest_hit));
  if (!pass) return pass.error();
  const auto numbers = frame.create_picture(device, "view", rtapi::Format::kR32G32B32A32Float);
  if (!numbers) return numbers.error();
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto s = views->set_unordered_access(0, *numbers); !s) return s.error();
  if (is_lit) {
    if (const auto s = renderer.lights().lighting()->bind(*views); !s) return s.error();
    if (const auto s = renderer.lights().volume()->bind(*views); !s) return s.error();
  }
  const auto done = renderer.runner().execute([&](rtapi::CommandList& list) {
    if (is_lit) renderer.lights().lighting()->update(list, frame);
    pass->dispatch(list, frame, {.sample_count = 1}, frame.height(),
                   PassArguments(*views, lengths_of(renderer)));
  });
  if (!done) return done.error();
  return renderer.read(*numbers);
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> hit_views_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_hit_views());
}

rtapi::Result<FloatImage> view_hit_uv(FrameRenderer& renderer) {
  return view_hits(renderer, "HitUv", false);
}

rtapi::Result<FloatImage> view_hit_albedo(FrameRenderer& renderer) {
  return view_hits(renderer, "HitAlbedo", false);
}

rtapi::Result<FloatImage> view_hit_lighting(FrameRenderer& renderer) {
  return view_hits(renderer, "HitLighting", true);
}

}  // namespace kaamos::effects
