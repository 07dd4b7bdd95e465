// SPDX-License-Identifier: MIT
//
// Keeps track of the GPU virtual addresses that are alive, and of what their buffers are called.
// rtapi maintains it; while it executes, a backend looks up what it is about to read or write.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/resource.h>

namespace kaamos::runtime {

// Whether buffers on such a heap change their state, and shaders may write them.
inline bool has_free_state(rtapi::HeapType heap) {
  return heap == rtapi::HeapType::kDefault || heap == rtapi::HeapType::kCustom;
}

struct Allocation {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  rtapi::HeapType heap = rtapi::HeapType::kDefault;
  rtapi::ResourceFlags flags = rtapi::ResourceFlags::kNone;
  bool acceleration_structure = false;   // created in the acceleration structure state
  std::string name;                      // "" if unnamed
  uint8_t* host = nullptr;               // where the host sees it; null: at `address` itself
  std::weak_ptr<const void> owner = {};  // what it is freed with
};

// Set in a view's key in AddressMap::ranges() while its texture is in a state that forbids its use.
// [kaamos/shader/checked.h]
constexpr uint64_t kWrongView = uint64_t{1} << 61;

class AddressMap {
 public:
  void insert(Allocation allocation) {
    std::unique_lock lock(mutex_);
    allocations_[allocation.address] = std::move(allocation);
    ++version_;
  }
  void erase(uint64_t address) {
    std::unique_lock lock(mutex_);
    allocations_.erase(address);
    ++version_;
  }
  void rename(uint64_t address, std::string name) {
    std::unique_lock lock(mutex_);
    if (auto it = allocations_.find(address); it != allocations_.end()) {
      it->second.name = std::move(name);
    }
  }

  // Grows with every allocation that is added or removed.
  uint64_t version() const { return version_; }

  // The allocation that contains the byte at `address`.
  std::optional<Allocation> find(uint64_t address) const {
    std::shared_lock lock(mutex_);
    const Allocation* a = locate(address);
    return a ? std::optional<Allocation>(*a) : std::nullopt;
  }
  // True if [address, address + size_bytes) lies inside one allocation.
  bool contains(uint64_t address, uint64_t size_bytes) const {
    return bytes_from(address) >= size_bytes && bytes_from(address) > 0;
  }
  // Bytes from `address` to the end of its allocation; 0 if it is in none.
  uint64_t bytes_from(uint64_t address) const {
    std::shared_lock lock(mutex_);
    const Allocation* a = locate(address);
    return a ? a->address + a->size_bytes - address : 0;
  }
  std::vector<Allocation> all() const {
    std::shared_lock lock(mutex_);
    std::vector<Allocation> out;
    for (const auto& [address, allocation] : allocations_) out.push_back(allocation);
    return out;
  }
  // Adds a view of a texture; it lives as long as the texture. `key`: shader::view_key.
  void insert_view(uint64_t key, std::weak_ptr<const void> texture) {
    std::unique_lock lock(mutex_);
    views_[key] = std::move(texture);
  }
  // Sets the views whose textures are in a state that forbids their use, each with the words to
  // report it. Replaces the views set before.
  void set_wrong_views(std::map<uint64_t, std::string> wrong) {
    std::unique_lock lock(mutex_);
    wrong_views_ = std::move(wrong);
  }
  std::string wrong_view(uint64_t key) const {
    std::shared_lock lock(mutex_);
    const auto it = wrong_views_.find(key);
    return it == wrong_views_.end() ? std::string() : it->second;
  }
  // Only the ranges of allocations and live views, sorted by address.
  std::vector<shader::AddressRange> ranges() const {
    std::shared_lock lock(mutex_);
    std::vector<shader::AddressRange> out;
    for (const auto& [address, a] : allocations_) out.push_back({address, a.size_bytes});
    const auto middle = static_cast<std::ptrdiff_t>(out.size());
    for (const auto& [key, texture] : views_) {
      if (texture.expired()) continue;
      out.push_back({wrong_views_.count(key) == 0 ? key : key | kWrongView, 1});
    }
    const auto by_address = [](const auto& a, const auto& b) { return a.address < b.address; };
    if (!wrong_views_.empty()) std::sort(out.begin() + middle, out.end(), by_address);
    std::inplace_merge(out.begin(), out.begin() + middle, out.end(), by_address);
    return out;
  }
  // Returns where the host sees the byte at `address`. An address outside every allocation is taken
  // for a host address.
  uint8_t* host(uint64_t address) const {
    std::shared_lock lock(mutex_);
    const Allocation* a = locate(address);
    return a && a->host ? a->host + (address - a->address) : reinterpret_cast<uint8_t*>(address);
  }

 private:
  const Allocation* locate(uint64_t address) const {
    auto it = allocations_.upper_bound(address);
    if (it == allocations_.begin()) return nullptr;
    const Allocation& a = std::prev(it)->second;
    return address - a.address < a.size_bytes ? &a : nullptr;
  }

  mutable std::shared_mutex mutex_;
  std::map<uint64_t, Allocation> allocations_;
  std::map<uint64_t, std::weak_ptr<const void>> views_;
  std::map<uint64_t, std::string> wrong_views_;
  std::atomic<uint64_t> version_{0};
};

}  // namespace kaamos::runtime
