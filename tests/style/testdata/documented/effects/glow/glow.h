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

/// Both of these are said to glow.
///@{
bool glows(const GlowDesc& desc);
bool glows_more(const GlowDesc& desc, const GlowDesc& than);
///@}
/// This one names `std::vector<int>` right and <glow> wrong.
void glow(const GlowDesc& desc);

}  // namespace kaamos::effects
