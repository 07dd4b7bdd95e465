// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/shader_table.h"

#include <gtest/gtest.h>

#include <memory>

namespace kaamos::vulkan {
namespace {

using runtime::RecordKind;

// Records of a pipeline, with handles 0xA0, 0xA1 and so on.
struct Pipeline {
  explicit Pipeline(uint32_t handle_bytes) : groups(handle_bytes) {}
  const runtime::LinkedRecord* add(RecordKind kind, bool group = true) {
    auto record = std::make_unique<runtime::LinkedRecord>();
    const auto index = static_cast<uint32_t>(records.size() + 5);
    const uint64_t words[4] = {index, 1, 2, 3};
    std::memcpy(record->identifier.data(), words, 32);
    record->kind = kind;
    identifiers.insert(record.get());
    const std::vector<uint8_t> handle(groups.handle_bytes(),
                                      static_cast<uint8_t>(0xA0 + records.size()));
    if (group) groups.add(record.get(), handle.data());
    records.push_back(std::move(record));
    return records.back().get();
  }
  std::vector<std::unique_ptr<runtime::LinkedRecord>> records;
  runtime::IdentifierTable identifiers;
  GroupHandles groups;
};

struct Translated {
  uint64_t unknown = 0;
  std::vector<uint8_t> bytes;
  uint64_t stride = 0;
  std::vector<uint8_t> handle(size_t record, uint32_t size) const {
    return {bytes.begin() + record * stride, bytes.begin() + record * stride + size};
  }
  uint64_t arguments(size_t record, uint32_t handle_bytes) const {
    uint64_t value;
    std::memcpy(&value, bytes.data() + record * stride + handle_bytes, sizeof(value));
    return value;
  }
};

Translated translate(const Pipeline& pipeline, const std::vector<uint8_t>& table, uint64_t stride,
                     const TableLayout& layout, RecordKind kind = RecordKind::kMiss) {
  const ApplicationTable source = {table.data(), 0x10000, table.size(), stride};
  Translated result;
  result.stride = layout.stride();
  result.bytes.assign(source.count() * result.stride, 0xEE);
  result.unknown = translate_table(source, kind, pipeline.identifiers, pipeline.groups, layout,
                                   result.bytes.data());
  return result;
}

void put(std::vector<uint8_t>& table, size_t offset, const runtime::LinkedRecord* record) {
  std::memcpy(table.data() + offset, record->identifier.data(), 32);
}

TEST(ShaderTable, CountsRecordsAsTheOtherBackendDoes) {
  const uint8_t byte = 0;
  EXPECT_EQ((ApplicationTable{&byte, 1, 31, 32}.count()), 0u);
  EXPECT_EQ((ApplicationTable{&byte, 1, 32, 32}.count()), 1u);
  EXPECT_EQ((ApplicationTable{&byte, 1, 95, 64}.count()), 1u);
  EXPECT_EQ((ApplicationTable{&byte, 1, 96, 64}.count()), 2u);  // the last record has no arguments
  EXPECT_EQ((ApplicationTable{&byte, 1, 4096, 0}.count()), 1u);
  EXPECT_EQ((ApplicationTable{nullptr, 0, 4096, 32}.count()), 0u);
}

TEST(ShaderTable, RecordsBecomeHandleAndAddressOfArguments) {
  for (const TableLayout& layout : {TableLayout{32, 16, 32}, TableLayout{32, 32, 64},
                                    TableLayout{16, 8, 128}, TableLayout{64, 64, 64}}) {
    Pipeline pipeline(layout.handle_bytes);
    const auto* first = pipeline.add(RecordKind::kMiss);
    const auto* second = pipeline.add(RecordKind::kMiss);
    std::vector<uint8_t> table(5 * 96);
    put(table, 0, second);
    put(table, 96, first);
    put(table, 2 * 96, first);
    put(table, 4 * 96, second);
    const Translated t = translate(pipeline, table, 96, layout);
    const auto bytes = [&](uint8_t value) {
      return std::vector<uint8_t>(layout.handle_bytes, value);
    };
    EXPECT_EQ(layout.stride() % layout.handle_alignment, 0u);
    EXPECT_GE(layout.stride(), layout.handle_bytes + 8u);
    EXPECT_EQ(t.unknown, kNoRecord);
    EXPECT_EQ(t.handle(0, layout.handle_bytes), bytes(0xA1));
    EXPECT_EQ(t.handle(1, layout.handle_bytes), bytes(0xA0));
    EXPECT_EQ(t.handle(2, layout.handle_bytes), bytes(0xA0));
    EXPECT_EQ(t.handle(3, static_cast<uint32_t>(t.stride)),
              std::vector<uint8_t>(t.stride, 0));  // null
    EXPECT_EQ(t.handle(4, layout.handle_bytes), bytes(0xA1));
    EXPECT_EQ(t.arguments(0, layout.handle_bytes), 0x10000u + 32);
    EXPECT_EQ(t.arguments(2, layout.handle_bytes), 0x10000u + 2 * 96 + 32);
    EXPECT_EQ(t.arguments(4, layout.handle_bytes), 0x10000u + 4 * 96 + 32);
  }
}

TEST(ShaderTable, WhatIsNoIdentifierOfTheKindIsNullAndReported) {
  const TableLayout layout;
  Pipeline pipeline(32);
  const auto* miss = pipeline.add(RecordKind::kMiss);
  const auto* callable = pipeline.add(RecordKind::kCallable);
  std::vector<uint8_t> table(4 * 64);
  put(table, 0, miss);
  put(table, 64, callable);
  put(table, 128, miss);
  table[128 + 31] ^= 1;  // one wrong bit
  put(table, 192, miss);
  const Translated t = translate(pipeline, table, 64, layout);
  EXPECT_EQ(t.unknown, 1u);
  EXPECT_EQ(t.handle(1, 40), std::vector<uint8_t>(40, 0));
  EXPECT_EQ(t.handle(2, 40), std::vector<uint8_t>(40, 0));
  EXPECT_EQ(t.handle(3, 32), std::vector<uint8_t>(32, 0xA0));
  EXPECT_EQ(translate(pipeline, table, 64, layout, RecordKind::kCallable).unknown, 0u);
}

TEST(ShaderTable, RecordsWithoutShadersAreNullWithoutAWord) {
  const TableLayout layout;
  Pipeline pipeline(32);
  std::vector<uint8_t> table(64);
  put(table, 0, pipeline.add(RecordKind::kHitGroup, false));
  const Translated t = translate(pipeline, table, 64, layout, RecordKind::kHitGroup);
  EXPECT_EQ(t.unknown, kNoRecord);
  EXPECT_EQ(t.handle(0, 40), std::vector<uint8_t>(40, 0));
}

// Any-hit, intersection and closest-hit shader of each record, or nothing.
TEST(ShaderTable, TwinsHaveTheArgumentsOfTheirRecord) {
  const TableLayout layout;
  Pipeline pipeline(32);
  runtime::LinkedShader any_hit, closest_hit, miss;
  const std::vector<uint8_t> handles[] = {std::vector<uint8_t>(32, 0xB0),
                                          std::vector<uint8_t>(32, 0xB1),
                                          std::vector<uint8_t>(32, 0xB2)};
  pipeline.groups.add_twin(&any_hit, handles[0].data());
  pipeline.groups.add_twin(&closest_hit, handles[1].data());
  pipeline.groups.add_twin(&miss, handles[2].data());
  pipeline.add(RecordKind::kHitGroup);
  pipeline.add(RecordKind::kMiss);
  pipeline.records[0]->any_hit = &any_hit;
  pipeline.records[0]->closest_hit = &closest_hit;
  pipeline.records[1]->shader = &miss;
  std::vector<uint8_t> table(3 * 64);
  put(table, 0, pipeline.records[1].get());  // of the other kind
  put(table, 64, pipeline.records[0].get());
  const auto twins = [&](RecordKind kind) {
    const ApplicationTable source = {table.data(), 0x10000, table.size(), 64};
    Translated result;
    result.stride = layout.stride();
    result.bytes.assign(source.count() * twins_of(kind) * result.stride, 0xEE);
    translate_twins(source, kind, pipeline.identifiers, pipeline.groups, layout,
                    result.bytes.data());
    return result;
  };
  const Translated hits = twins(RecordKind::kHitGroup);
  const std::vector<uint8_t> null(40, 0);
  for (const size_t i : {0, 1, 2, 4, 6, 7, 8}) EXPECT_EQ(hits.handle(i, 40), null) << i;
  EXPECT_EQ(hits.handle(3, 32), handles[0]);
  EXPECT_EQ(hits.handle(5, 32), handles[1]);
  EXPECT_EQ(hits.arguments(3, 32), 0x10000u + 64 + 32);
  EXPECT_EQ(hits.arguments(5, 32), 0x10000u + 64 + 32);
  const Translated misses = twins(RecordKind::kMiss);
  EXPECT_EQ(misses.handle(0, 32), handles[2]);
  EXPECT_EQ(misses.handle(1, 40), null);
}

}  // namespace
}  // namespace kaamos::vulkan
