// SPDX-License-Identifier: MIT
#include "effects/glass/settings.h"

namespace kaamos::effects {

namespace {

constexpr const char* kControl = "Control";

}  // namespace

SettingTable<TransparentConstants> transparent_settings() {
  using C = TransparentConstants;
  return {count_setting("reflecting-layers", &C::reflecting_layers, {0, double{kMaxSortedLayers}},
                        "", "nearest layers with a mirrored ray each", kControl),
          count_setting("sorted-layers", &C::sorted_layers, {0, double{kMaxSortedLayers}}, "",
                        "nearest layers traced one by one; what lies behind is blended without an "
                        "order",
                        kControl),
          word_setting("weight", &C::weight, {"none", "square", "cube", "far", "depth"},
                       "of layers that are blended without an order, by their depth",
                       "McGuire and Bavoil 2013"),
          switch_setting("sun", &C::sun, "shadow rays to the sun; off: it does not shine on glass"),
          number_setting("reflection-length", &C::reflection_length, {0, 1e6}, "m",
                         "beyond it the volume is mirrored", kControl),
          number_setting("fade", &C::fade, {0, 1}, "lengths",
                         "last part of it, over which the volume takes over"),
          switch_setting("full-reflection", &C::full_reflection,
                         "a layer reflects as much as glass does however little it covers; off: as "
                         "glTF has it"),
          number_setting("depth-scale", &C::depth_scale, {0, 1e6}, "",
                         "of the weights' depth: for scenes that are not metres large",
                         "McGuire and Bavoil 2013")};
}

SettingTable<DrawnGlassConstants> drawn_glass_settings() {
  using C = DrawnGlassConstants;
  const auto rays = close_settings(transparent_settings(),
                                   {"reflecting-layers", "sorted-layers", "weight", "depth-scale"});
  return join_settings(
      settings_within(&C::rays, rays),
      {number_setting("tolerance", &C::tolerance, {-1, 1}, "depths",
                      "by which a layer may miss the ray's and still have its mirror image; "
                      "negative: none has"),
       word_setting("fallback", &C::fallback, {"nothing", "environment"},
                    "what layers mirror that no ray was traced for"),
       closed_setting(&C::draw), closed_setting(&C::clip_scale), closed_setting(&C::width),
       closed_setting(&C::height)});
}

}  // namespace kaamos::effects
