// SPDX-License-Identifier: MIT
//
// All shader identifiers that a device has given out, so that one in the wrong place can be named.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <string>

#include "runtime/backend/linked_pipeline.h"

namespace kaamos::checks {

class Identifiers {
 public:
  void add(const runtime::LinkedPipeline& pipeline) {
    const std::lock_guard lock(mutex_);
    for (const auto& record : pipeline.records) {
      std::string& name = names_[record->identifier];
      name = record->name;
    }
  }
  // The export that the 32 bytes identify, in whichever state object; "" if there is none.
  std::string find(const uint8_t* bytes) const {
    rtapi::ShaderIdentifier key;
    std::memcpy(key.data(), bytes, key.size());
    const std::lock_guard lock(mutex_);
    const auto it = names_.find(key);
    return it == names_.end() ? std::string() : it->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<rtapi::ShaderIdentifier, std::string> names_;
};

}  // namespace kaamos::checks
