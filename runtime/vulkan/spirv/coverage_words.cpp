// SPDX-License-Identifier: MIT
#include "runtime/vulkan/spirv/coverage_words.h"

#include <utility>

namespace kaamos::vulkan {

CoverageWords::CoverageWords(Gpu& gpu) : gpu_(gpu) {
  coverage::add_reader(*this);
}

CoverageWords::~CoverageWords() {
  coverage::remove_reader(*this);
}

rtapi::Status CoverageWords::provide(const shader::LibraryDesc& library) {
  // Before the lock: whoever reads has both locks in the other order.
  const shader::CoverageDesc* table = coverage::table_of(library);
  if (table == nullptr) return {};
  const std::lock_guard lock(mutex_);
  std::unique_ptr<GpuBuffer>& buffer = buffers_[table];
  if (buffer != nullptr) return {};
  auto made = gpu_.create_buffer(table->point_count * sizeof(uint32_t), "coverage of a library");
  if (!made) return made.error();
  buffer = std::move(*made);
  return {};
}

uint64_t CoverageWords::address_of(const shader::LibraryDesc& library) {
  const shader::CoverageDesc* table = coverage::table_of(library);
  const std::lock_guard lock(mutex_);
  const auto at = buffers_.find(table);
  return at == buffers_.end() || at->second == nullptr ? 0 : at->second->address();
}

void CoverageWords::read(const shader::CoverageDesc& table, bool is_last) {
  const std::lock_guard lock(mutex_);
  const auto at = buffers_.find(&table);
  if (at == buffers_.end() || at->second == nullptr) return;
  auto* words = reinterpret_cast<uint32_t*>(at->second->host());
  for (uint32_t i = 0; i < table.point_count; ++i) {
    if (__atomic_load_n(&words[i], __ATOMIC_RELAXED) != 0) shader::cover(table.ran[i]);
  }
  if (is_last) buffers_.erase(at);
}

}  // namespace kaamos::vulkan
