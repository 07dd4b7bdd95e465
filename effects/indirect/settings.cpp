// SPDX-License-Identifier: MIT
#include "effects/indirect/settings.h"

#include "effects/occlusion/settings.h"

namespace kaamos::effects {

SettingTable<IndirectConstants> indirect_settings() {
  using C = IndirectConstants;
  return {word_setting("mode", &C::mode,
                       {"direct", "hit-black", "near-field", "near-field-glossy", "times-open"},
                       "the volume at the surface, where rays end, what rays hit, the same with "
                       "mirrored lights, or the volume times the open part",
                       "Northlight deck"),
          number_setting("length", &C::length, {0, 1e6}, "m",
                         "of the rays; at least two cells of the volume", "Northlight deck"),
          word_setting("sun-at-hits", &C::sun_at_hits, {"none", "ray", "map"},
                       "the sun where rays hit: a shadow ray, a map of the whole scene, or none")};
}

SettingTable<OccludedVolumeSettings> occluded_volume_settings() {
  using C = OccludedVolumeSettings;
  return join_settings(
      settings_within(&C::occlusion, gtao_settings()),
      {number_setting("radius", &C::radius, {0, 1e6}, "m", "how far occluders reach; 0: none")});
}

}  // namespace kaamos::effects
