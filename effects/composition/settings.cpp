// SPDX-License-Identifier: MIT
#include "effects/composition/settings.h"

namespace kaamos::effects {

SettingTable<TaaConstants> taa_settings() {
  using C = TaaConstants;
  return {number_setting("alpha", &C::alpha, {0, 1}, "",
                         "least weight of the new frame; the Nth has at least 1 / N"),
          number_setting("clip-gamma", &C::clip_gamma, {0, 1e6}, "deviations",
                         "of 3 x 3 pixels that history is clipped to; 0: no clipping"),
          number_setting("depth-tolerance", &C::depth_tolerance, {0, 1}, "depths",
                         "nearer by more may have hidden the surface"),
          closed_setting(&C::history_valid)};
}

SettingTable<EnlargeConstants> enlarge_settings() {
  using C = EnlargeConstants;
  return {number_setting("edges", &C::edges, {0, 1}, "",
                         "how far kernels are turned and stretched as edges run", "AMD 2021"),
          word_setting("method", &C::method, {"bilinear", "along-edges"},
                       "four pixels whatever they show, or twelve by such a kernel")};
}

}  // namespace kaamos::effects
