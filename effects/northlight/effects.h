// SPDX-License-Identifier: MIT
/// @file
/// The registry of Northlight's effects: the rows of all families.
#pragma once

#include <vector>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Northlight's effects in the order in which they are rendered, and behind them the alternatives
/// to them.
const std::vector<Effect>& northlight_effects();

}  // namespace kaamos::effects
