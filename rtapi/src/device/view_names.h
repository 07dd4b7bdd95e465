// SPDX-License-Identifier: MIT
//
// Maps the opaque addresses in texture and sampler descriptors back to what they stand for. An
// entry is replaced when the backend reuses an address; textures that were destroyed are no longer
// found.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "runtime/backend/backend.h"

namespace rtapi::detail {

struct NamedView {
  std::string name;  // of the texture
  TextureDesc texture_desc;
  kaamos::runtime::TextureViewDesc desc;
  std::weak_ptr<kaamos::runtime::BackendTexture> texture;
};

class ViewNames {
 public:
  void add_view(uint64_t address, NamedView view) {
    const std::lock_guard lock(mutex_);
    views_[{address, view.desc.unordered_access}] = std::move(view);
  }
  std::optional<NamedView> find(uint64_t address, bool unordered_access) const {
    const std::lock_guard lock(mutex_);
    const auto it = views_.find({address, unordered_access});
    if (it == views_.end() || it->second.texture.expired()) return std::nullopt;
    return it->second;
  }
  void add_sampler(uint64_t address, const SamplerDesc& desc) {
    const std::lock_guard lock(mutex_);
    samplers_[address] = desc;
  }
  std::optional<SamplerDesc> find_sampler(uint64_t address) const {
    const std::lock_guard lock(mutex_);
    const auto it = samplers_.find(address);
    return it == samplers_.end() ? std::nullopt : std::optional(it->second);
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::pair<uint64_t, bool>, NamedView> views_;
  std::map<uint64_t, SamplerDesc> samplers_;
};

}  // namespace rtapi::detail
