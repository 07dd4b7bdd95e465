// SPDX-License-Identifier: MIT
/// @file
/// Glow.
#pragma once

namespace kaamos::effects {

/// How it glows.
struct GlowDesc {
  float radius = 0;  ///< metres
  float strength = 0;
};

/// Whether anything glows, or more than something else.
///@{
bool glows(const GlowDesc& desc);
bool glows_more(const GlowDesc& desc, const GlowDesc& than);
///@}
/// This names `std::vector<int>` right and <glow> wrong.
void glow(const GlowDesc& desc);
/// Makes it glow.
/// @errors too much of it.
Status start(const GlowDesc& desc);
/// Makes it glow longer.
rtapi::Result<Frame> keep_on(const GlowDesc& desc);

/// Glows.
class Glow {
 private:
  Status begin();
};

}  // namespace kaamos::effects
