// SPDX-License-Identifier: MIT
// The sums to which ambient occlusion and the sun add their samples, for tests that dispatch the
// passes themselves.
#pragma once

#include "effects/engine/frame.h"

namespace kaamos::effects {

struct AmbientSums {
  AmbientSums() = default;
  AmbientSums(const rtapi::Device& device, const Frame& frame)
      : open(frame.create_picture(device, "open", rtapi::Format::kR32Float).value()),
        views(frame.create_pass_views(device).value()) {
    views.set_unordered_access(0, open).value();
  }
  PassArguments arguments() const { return PassArguments(views); }

  rtapi::Texture open;
  PassViews views;
};

struct SunSums {
  SunSums() = default;
  SunSums(const rtapi::Device& device, const Frame& frame)
      : visible(frame.create_picture(device, "visible", rtapi::Format::kR32Float).value()),
        sharpness(
            frame.create_picture(device, "sharpness", rtapi::Format::kR32G32B32A32Float).value()),
        views(frame.create_pass_views(device).value()) {
    views.set_unordered_access(0, visible).value();
    views.set_unordered_access(1, sharpness).value();
  }
  PassArguments arguments() const { return PassArguments(views); }

  rtapi::Texture visible, sharpness;
  PassViews views;
};

}  // namespace kaamos::effects
