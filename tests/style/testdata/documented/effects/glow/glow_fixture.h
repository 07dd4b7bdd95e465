// SPDX-License-Identifier: MIT
#pragma once

namespace kaamos::effects {

struct GlowFixture {
  void set_up();
};

}  // namespace kaamos::effects
