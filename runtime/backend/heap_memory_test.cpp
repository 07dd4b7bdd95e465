// SPDX-License-Identifier: MIT
#include "runtime/backend/heap_memory.h"

#include <gtest/gtest.h>

namespace kaamos::runtime {
namespace {

constexpr uint64_t kPage = 64 * 1024;

TEST(HeapMemory, MappingsThatOverlapShareBytes) {
  const auto heap = HeapMemory::create(4 * kPage);
  ASSERT_NE(heap, nullptr);
  const MappedPages first = heap->map(0, 2 * kPage);
  const MappedPages second = heap->map(kPage, 2 * kPage);
  ASSERT_TRUE(first && second);
  EXPECT_NE(first.first() + kPage, second.first());
  EXPECT_EQ(reinterpret_cast<uint64_t>(second.first()) % kPage, 0u);
  EXPECT_EQ(second.first()[5], 0);
  first.first()[kPage + 5] = 7;
  EXPECT_EQ(second.first()[5], 7);
  second.first()[kPage] = 9;
  EXPECT_EQ(first.first()[0], 0);
}

TEST(HeapMemory, AMappingOutlivesItsHeap) {
  auto heap = HeapMemory::create(kPage);
  ASSERT_NE(heap, nullptr);
  MappedPages mapping = heap->map(4096, 1);
  ASSERT_TRUE(mapping);
  mapping.first()[0] = 3;
  EXPECT_EQ(heap->map(0, kPage).first()[4096], 3);
  heap.reset();
  MappedPages moved = std::move(mapping);
  EXPECT_EQ(moved.first()[0], 3);
}

TEST(HeapMemory, NothingIsThereForMoreThanThereIs) {
  EXPECT_EQ(HeapMemory::create(uint64_t{1} << 60), nullptr);
}

}  // namespace
}  // namespace kaamos::runtime
