// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/instance_table.h"
#include "runtime/backend/errors.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace kaamos::vulkan {
namespace {

using shader::spirv::InstanceEntry;

constexpr uint32_t kFirstCapacity = 1024;
constexpr uint32_t kLargestCapacity = 1u << 24;  // bits of instanceCustomIndex

}  // namespace

rtapi::Result<std::shared_ptr<InstanceTable>> InstanceTable::create(std::shared_ptr<Gpu> gpu) {
  std::shared_ptr<InstanceTable> table(new InstanceTable(std::move(gpu)));
  if (auto s = table->grow(kFirstCapacity); !s) return s.error();
  return table;
}

InstanceTable::Range::~Range() {
  if (count_ != 0) table_->release(first_, count_);
}

uint64_t InstanceTable::address() const {
  const std::lock_guard lock(mutex_);
  return buffer_->address();
}

uint64_t InstanceTable::position_tables() const {
  const std::lock_guard lock(mutex_);
  return buffer_->address() + uint64_t{capacity_} * sizeof(InstanceEntry);
}

rtapi::Result<InstanceTable::Range> InstanceTable::add(std::span<const InstanceEntry> entries,
                                                       std::span<const uint64_t> position_tables) {
  const auto count = static_cast<uint32_t>(entries.size());
  if (count == 0) return Range();
  const std::lock_guard lock(mutex_);
  const auto fits = [&](const auto& free) { return free.second >= count; };
  auto place = std::find_if(free_.begin(), free_.end(), fits);
  if (place == free_.end()) {
    if (auto s = grow(count); !s) return s.error();
    place = std::find_if(free_.begin(), free_.end(), fits);
  }
  const auto [first, available] = *place;
  free_.erase(place);
  if (available > count) free_[first + count] = available - count;
  std::memcpy(buffer_->host() + uint64_t{first} * sizeof(InstanceEntry), entries.data(),
              entries.size_bytes());
  std::memcpy(buffer_->host() + uint64_t{capacity_} * sizeof(InstanceEntry) +
                  uint64_t{first} * sizeof(uint64_t),
              position_tables.data(), position_tables.size_bytes());
  return Range(shared_from_this(), first, count);
}

// Grows by at least `entries` entries, at the end.
rtapi::Status InstanceTable::grow(uint32_t entries) {
  if (entries > kLargestCapacity - capacity_) {
    return runtime::make_error(
        runtime::Id::kTooManyElements,
        "the top levels of a Vulkan device hold at most 2^24 instances together, and " +
            std::to_string(entries) +
            " more do not fit. Free top levels that are no longer traced.");
  }
  const uint32_t capacity =
      std::min(std::max(capacity_ + entries, 2 * capacity_), kLargestCapacity);
  auto buffer = gpu_->create_buffer(uint64_t{capacity} * (sizeof(InstanceEntry) + sizeof(uint64_t)),
                                    "instance table");
  if (!buffer) return buffer.error();
  if (buffer_ != nullptr) {
    const uint64_t old_bytes = uint64_t{capacity_} * sizeof(InstanceEntry);
    std::memcpy((*buffer)->host(), buffer_->host(), old_bytes);
    std::memcpy((*buffer)->host() + uint64_t{capacity} * sizeof(InstanceEntry),
                buffer_->host() + old_bytes, uint64_t{capacity_} * sizeof(uint64_t));
  }
  buffer_ = std::move(*buffer);
  const uint32_t added = capacity - capacity_;
  const auto last = free_.empty() ? free_.end() : std::prev(free_.end());
  if (last != free_.end() && last->first + last->second == capacity_) {
    last->second += added;
  } else {
    free_[capacity_] = added;
  }
  capacity_ = capacity;
  return {};
}

void InstanceTable::release(uint32_t first, uint32_t count) {
  const std::lock_guard lock(mutex_);
  auto place = free_.emplace(first, count).first;
  const auto next = std::next(place);
  if (next != free_.end() && place->first + place->second == next->first) {
    place->second += next->second;
    free_.erase(next);
  }
  if (place == free_.begin()) return;
  const auto before = std::prev(place);
  if (before->first + before->second == place->first) {
    before->second += place->second;
    free_.erase(place);
  }
}

}  // namespace kaamos::vulkan
