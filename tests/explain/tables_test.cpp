// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include <cstring>

#include "tests/explain/scene.h"

using namespace rtapi;

KAAMOS_EXPLAIN_SUITE(Tables);

TEST_P(Tables, TextSaysWhatEachRecordHoldsAndWhoReachesIt) {
  const std::string expected =
      "ray generation table: 1 record at buffer \"ray generation\" + 0 (64 bytes)\n"
      "  record 0 at + 0: \"ExplainRayGen\"\n"
      "miss table: 2 records every 32 bytes at buffer \"miss\" + 0 (64 bytes)\n"
      "  record 0 at + 0: \"SkyMiss\"\n"
      "    reached by ray type 0 \"surface\"\n"
      "  record 1 at + 32: \"ShadowMiss\"\n"
      "    reached by ray type 1 \"shadow\"\n"
      "hit group table: 5 records every 64 bytes at buffer \"hit groups\" + 0 (320 bytes)\n"
      "  record 0 at + 0: \"Leaf\", any-hit \"LeafAnyHit\"\n"
      "    + 32 b0, space1 \"Leaf\": constants 1056964608 (0.5) 7\n"
      "    reached by instance 0 (ID 10), geometry 0, ray type 0 \"surface\"\n"
      "    reached by instance 1 (ID 11), geometry 0, ray type 0 \"surface\"\n"
      "  record 1 at + 64: \"LeafForShadows\", any-hit \"LeafShadow\"\n"
      "    + 32 b0, space1 \"Leaf\": constants 1056964608 (0.5) 7\n"
      "    reached by instance 0 (ID 10), geometry 0, ray type 1 \"shadow\"\n"
      "    reached by instance 1 (ID 11), geometry 0, ray type 1 \"shadow\"\n"
      "  record 2 at + 128: \"Wall\", closest-hit \"WallHit\"\n"
      "    + 32 t0, space1 \"colors\": descriptor table at heap \"views\" slot 2\n"
      "      slot 2: SRV structured buffer, stride 16, buffer \"colors\" + 0 (16 bytes), view of "
      "16 "
      "bytes\n"
      "    reached by instance 2 (ID 12), geometry 0, ray type 0 \"surface\"\n"
      "    reached by instance 3 (ID 13), geometry 0, ray type 0 \"surface\"\n"
      "    reached by instance 4 (ID 14), geometry 0, ray type 0 \"surface\"\n"
      "    reached by instance 5 (ID 15), geometry 0, ray type 0 \"surface\"\n"
      "    reached by instance 6 (ID 16), geometry 0, ray type 0 \"surface\"\n"
      "  record 3 at + 192: NULL identifier: nothing runs\n"
      "    reached by instance 2 (ID 12), geometry 0, ray type 1 \"shadow\"\n"
      "    reached by instance 3 (ID 13), geometry 0, ray type 1 \"shadow\"\n"
      "    reached by instance 4 (ID 14), geometry 0, ray type 1 \"shadow\"\n"
      "    reached by instance 5 (ID 15), geometry 0, ray type 1 \"shadow\"\n"
      "    reached by instance 6 (ID 16), geometry 0, ray type 1 \"shadow\"\n"
      "  record 4 at + 256: \"Sphere\", intersection \"SphereIntersection\", closest-hit "
      "\"SphereHit\"\n"
      "    reached by instance 7 (ID 17), geometry 0, ray type 0 \"surface\"\n"
      "callable table: 1 record every 32 bytes at buffer \"callables\" + 0 (32 bytes)\n"
      "  record 0 at + 0: \"Tint\"\n"
      "problem: hit group table: instance 7, geometry 0, ray type 1 asks for record 5, the table "
      "has 5; nothing runs for it. Do SizeInBytes, StrideInBytes and the contributions agree?\n";
  EXPECT_EQ(ToText(describe_tables()), expected);
}

TEST_P(Tables, JsonHoldsTheSame) {
  const auto json = nlohmann::json::parse(ToJson(describe_tables()));
  ASSERT_EQ(json["tables"].size(), 4u);
  const auto& hit = json["tables"][2];
  EXPECT_EQ(hit["name"], "hit group");
  EXPECT_EQ(hit["stride"], 64);
  ASSERT_EQ(hit["records"].size(), 5u);
  EXPECT_EQ(hit["records"][0]["export"], "Leaf");
  EXPECT_EQ(hit["records"][0]["arguments"][0]["values"][1], 7);
  EXPECT_EQ(hit["records"][2]["arguments"][0]["slot"], 2);
  EXPECT_EQ(hit["records"][2]["arguments"][0]["descriptors"][0]["resource"], "colors");
  EXPECT_EQ(hit["records"][2]["reach_count"], 5);
  EXPECT_EQ(hit["records"][3]["state"], "null");
  EXPECT_EQ(json["problems"].size(), 1u);
}

// The record's bytes in the upload buffer.
std::byte* bytes_of(const Buffer& table, size_t offset) {
  return table.Map().value().data() + offset;
}

TEST_P(Tables, WhatCannotBeAsItWasMeantIsAProblem) {
  // Overwrites the identifier of record 1 of the miss table with garbage and the address of the
  // wall's descriptor table with one that nobody owns, and sets a stride so small that the leaf's
  // arguments overlap the next record.
  std::memset(bytes_of(tables_[1], 32), 0x5A, 32);
  const uint64_t wild = 0x1234;
  std::memcpy(bytes_of(tables_[2], 160), &wild, 8);
  const TableDescription table = describe_tables();
  EXPECT_EQ(table.Tables[1].Records[1].State, TableRecordState::kUnknown);
  EXPECT_FALSE(table.Tables[2].Records[2].Arguments[0].HandleIsLive);
  ASSERT_EQ(table.Problems.size(), 3u);
  EXPECT_EQ(table.Problems[0],
            "miss table: record 1 holds no identifier of this state object. Was it written, and "
            "with an identifier of this state object?");
  EXPECT_EQ(table.Problems[1],
            "hit group table: record 2 (\"Wall\"), argument t0, space1: 0x1234 is no slot of a "
            "live shader-visible descriptor heap");
  dispatch_.HitGroupTable.StrideInBytes = 32;
  EXPECT_NE(ToText(describe_tables())
                .find("record 0 (\"Leaf\") takes 40 bytes, the stride is 32: it reaches into the "
                      "next record. Make the stride at least 64"),
            std::string::npos);
}

TEST_P(Tables, ErrorsNameWhatIsWrong) {
  TableDescriptionDesc desc;
  desc.Dispatch = dispatch_;
  EXPECT_EQ(DescribeShaderTables({}, pipeline_, desc).error().id.text(), "KA0904");
  EXPECT_EQ(DescribeShaderTables(device_, {}, desc).error().id.text(), "KA0904");
  desc.TopLevel = results_.GetGPUVirtualAddress();
  EXPECT_EQ(DescribeShaderTables(device_, pipeline_, desc).error().id.text(), "KA0915");
}
