// SPDX-License-Identifier: MIT
// Its file is not said to be one.
#pragma once

namespace kaamos::effects {

void dim();

}  // namespace kaamos::effects
