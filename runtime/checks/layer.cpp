// SPDX-License-Identifier: MIT
#include "runtime/checks/layer.h"

#include <variant>

namespace kaamos::checks {

void Layer::before(const runtime::Command&, const std::string& label) {
  reporter_.begin(label);
}

void Layer::after(const runtime::Command&, bool) {
  reporter_.end();
}

bool Layer::needs_memory(const runtime::Command& command) const {
  return std::holds_alternative<runtime::DispatchRaysCommand>(command) ||
         std::holds_alternative<runtime::BuildCommand>(command);
}

}  // namespace kaamos::checks
