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

}  // namespace kaamos::effects
