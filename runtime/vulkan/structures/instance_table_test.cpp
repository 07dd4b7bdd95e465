// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/instance_table.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "runtime/vulkan/testing/vulkan_device.h"

namespace kaamos::vulkan {
namespace {

using shader::spirv::InstanceEntry;

std::vector<InstanceEntry> entries_of(uint32_t count, uint32_t id) {
  std::vector<InstanceEntry> entries(count);
  for (uint32_t i = 0; i < count; ++i) entries[i] = {uint64_t{id} << 32, id, i};
  return entries;
}

TEST(InstanceTable, RangesKeepTheirEntriesWhileOthersComeAndGo) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "the host reads the table by its address";
  const auto table = *InstanceTable::create(gpu);
  struct Living {
    InstanceTable::Range range;
    uint32_t id;
    uint32_t count;
  };
  std::vector<Living> living;
  std::mt19937 random(4);
  for (uint32_t round = 0; round < 600; ++round) {
    if (random() % 5 < 2 && !living.empty()) {
      std::swap(living[random() % living.size()], living.back());
      living.pop_back();
      continue;
    }
    const uint32_t count = random() % 700;
    auto range = table->add(entries_of(count, round), std::vector<uint64_t>(count, round));
    ASSERT_TRUE(range) << range.error().message;
    living.push_back({std::move(*range), round, count});
  }
  const auto* all = reinterpret_cast<const InstanceEntry*>(table->address());
  const auto* positions = reinterpret_cast<const uint64_t*>(table->position_tables());
  for (const Living& l : living) {
    for (uint32_t i = 0; i < l.count; ++i) {
      ASSERT_EQ(all[l.range.first() + i].instance_id, l.id);
      ASSERT_EQ(all[l.range.first() + i].instance_index, i);
      ASSERT_EQ(positions[l.range.first() + i], l.id);
    }
  }
}

TEST(InstanceTable, WhatIsFreedIsUsedAgain) {
  KAAMOS_NEED_GPU(gpu);
  const auto table = *InstanceTable::create(gpu);
  const uint64_t address = table->address();
  for (uint32_t i = 0; i < 50; ++i) {
    std::vector<InstanceTable::Range> ranges;
    for (uint32_t j = 0; j < 10; ++j)
      ranges.push_back(*table->add(entries_of(100, j), std::vector<uint64_t>(100)));
    std::swap(ranges[i % 10], ranges[(7 * i) % 10]);
  }
  EXPECT_EQ(table->address(), address);  // the table never had to grow
}

TEST(InstanceTable, MoreThanItsIndexHasBitsIsAnError) {
  KAAMOS_NEED_GPU(gpu);
  const auto table = *InstanceTable::create(gpu);
  constexpr size_t kTooMany = (size_t{1} << 24) + 1;
  void* zeros = std::calloc(kTooMany, sizeof(InstanceEntry));
  ASSERT_NE(zeros, nullptr);
  const auto range = table->add({static_cast<const InstanceEntry*>(zeros), kTooMany}, {});
  std::free(zeros);
  ASSERT_FALSE(range);
  EXPECT_EQ(range.error().id.text(), "KA0794");
  EXPECT_TRUE(table->add(entries_of(10, 1), std::vector<uint64_t>(10)));
}

}  // namespace
}  // namespace kaamos::vulkan
