// SPDX-License-Identifier: MIT
#include "effects/light/direct/direct.h"

#include <shaders/direct.h>

namespace kaamos::effects {

namespace {

// Mirrors DirectConstants of direct.hlsl.
struct DirectConstants {
  std::uint32_t leave_out_strongest = 0;
  std::uint32_t combination = 0;  // ContactCombination
  std::uint32_t by_frustum = 0;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> direct_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_direct());
}

rtapi::Result<DirectLighting> DirectLighting::create(const rtapi::Device& device,
                                                     const Frame& frame, const Lighting& lighting,
                                                     const rtapi::ShaderLibrary& library) {
  DirectLighting out;
  struct {
    rtapi::Texture* texture;
    const char* name;
    rtapi::Format format;
    std::uint32_t u;
  } const pictures[] = {{&out.direct_, "direct", rtapi::Format::kR32G32B32A32Float, 0},
                        {&out.strongest_, "strongest lights", rtapi::Format::kR32G32Uint, 1},
                        {&out.total_, "local lights", rtapi::Format::kR32G32B32A32Float, 3}};
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  for (const auto& picture : pictures) {
    const auto created = frame.create_picture(device, picture.name, picture.format);
    if (!created) return created.error();
    *picture.texture = *created;
    if (const auto s = out.views_.set_unordered_access(picture.u, *created); !s) return s.error();
  }
  if (const auto s = lighting.bind(out.views_); !s) return s.error();
  // For as many lights as the atlas of shadow maps may have.
  rtapi::BufferDesc words;
  words.SizeInBytes = (kMaxAtlasLights + 1) * sizeof(std::uint32_t);
  words.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  words.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  words.Name = "lights in view";
  const auto in_view = device.CreateBuffer(words);
  if (!in_view) return in_view.error();
  out.in_view_ = *in_view;
  if (const auto s = out.views_.set_unordered_access(4, out.in_view_, sizeof(std::uint32_t)); !s) {
    return s.error();
  }
  const auto cull = ComputePass::create(device, frame, library, "CullByFrustum");
  if (!cull) return cull.error();
  out.cull_ = *cull;
  const auto main = ComputePass::create(device, frame, library, "MainLighting");
  if (!main) return main.error();
  out.main_ = *main;
  const auto add = ComputePass::create(device, frame, library, "AddStrongest");
  if (!add) return add.error();
  out.add_ = *add;
  return out;
}

void DirectLighting::dispatch(rtapi::CommandList& list, const Frame& frame,
                              bool leave_out_strongest, LightCulling culling) const {
  const bool by_frustum = culling == LightCulling::kFrustum;
  const DirectConstants constants = {.leave_out_strongest = leave_out_strongest ? 1u : 0u,
                                     .by_frustum = by_frustum ? 1u : 0u};
  if (by_frustum) cull_.dispatch_groups(list, frame, {}, PassArguments(views_, constants), 1, 1);
  main_.dispatch(list, frame, {}, PassArguments(views_, constants), frame.width(), frame.height());
}

void DirectLighting::add_strongest(rtapi::CommandList& list, const Frame& frame,
                                   ContactCombination combination) const {
  const DirectConstants constants = {.combination = static_cast<std::uint32_t>(combination)};
  add_.dispatch(list, frame, {}, PassArguments(views_, constants), frame.width(), frame.height());
}

rtapi::Status DirectLighting::set_contact(const rtapi::Texture& contact) {
  return views_.set_unordered_access(2, contact);
}

}  // namespace kaamos::effects
