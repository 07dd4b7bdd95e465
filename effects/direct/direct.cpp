// SPDX-License-Identifier: MIT
#include "effects/direct/direct.h"

#include <shaders/direct.h>

namespace kaamos::effects {

namespace {

// Mirrors DirectConstants of direct.hlsl.
struct DirectConstants {
  std::uint32_t leave_out_strongest = 0;
  std::uint32_t by_minimum = 0;
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
  const auto main = ComputePass::create(device, frame, library, "MainLighting");
  if (!main) return main.error();
  out.main_ = *main;
  const auto add = ComputePass::create(device, frame, library, "AddStrongest");
  if (!add) return add.error();
  out.add_ = *add;
  return out;
}

void DirectLighting::dispatch(rtapi::CommandList& list, const Frame& frame,
                              bool leave_out_strongest) const {
  const DirectConstants constants = {.leave_out_strongest = leave_out_strongest ? 1u : 0u};
  main_.dispatch(list, frame, {}, PassArguments(views_, constants), frame.width(), frame.height());
}

void DirectLighting::add_strongest(rtapi::CommandList& list, const Frame& frame,
                                   ContactCombination combination) const {
  const DirectConstants constants = {.by_minimum = static_cast<std::uint32_t>(combination)};
  add_.dispatch(list, frame, {}, PassArguments(views_, constants), frame.width(), frame.height());
}

rtapi::Status DirectLighting::set_contact(const rtapi::Texture& contact) {
  return views_.set_unordered_access(2, contact);
}

}  // namespace kaamos::effects
