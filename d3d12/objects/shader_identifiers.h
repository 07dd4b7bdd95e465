// SPDX-License-Identifier: MIT
// Shader identifiers at one address each: programs compare pointers from a collection and from the
// pipeline that took it, or from before and after AddToStateObject.
#pragma once

#include <mutex>
#include <set>

#include <rtapi/state_object.h>

namespace kaamos::d3d12 {

/// Those of one device. Thread-safe.
class ShaderIdentifiers {
 public:
  /// The bytes of `identifier`, where they stay as long as this object.
  const uint8_t* keep(const rtapi::ShaderIdentifier& identifier) {
    const std::lock_guard lock(mutex_);
    return kept_.insert(identifier).first->data();
  }

 private:
  std::mutex mutex_;
  std::set<rtapi::ShaderIdentifier> kept_;
};

}  // namespace kaamos::d3d12
