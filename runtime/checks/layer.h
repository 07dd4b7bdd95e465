// SPDX-License-Identifier: MIT
//
// Checked mode's layer over a backend: reads the command stream as it executes.
#pragma once

#include <string>

#include "runtime/backend.h"
#include "runtime/checks/report.h"

namespace kaamos::checks {

class Layer : public runtime::CommandObserver {
 public:
  Layer(const runtime::AddressMap& addresses, Reporter& reporter)
      : addresses_(addresses), reporter_(reporter) {}

  void before(const runtime::Command& command, const std::string& label) override;
  void after(const runtime::Command& command, bool succeeded) override;
  bool needs_memory(const runtime::Command& command) const override;

 private:
  [[maybe_unused]] const runtime::AddressMap& addresses_;
  Reporter& reporter_;
};

}  // namespace kaamos::checks
