// SPDX-License-Identifier: MIT
#include "runtime/checks/report.h"

#include <gtest/gtest.h>

#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

class ReporterTest : public ::testing::Test {
 protected:
  std::vector<rtapi::Message> messages_;
  Reporter reporter_{[this](const rtapi::Message& m) { messages_.push_back(m); }, 3};
};

TEST(MessageTableTest, IdsAreSortedAndDescribed) {
  int last = 399;
  for (const errors::MessageRow& entry : message_table()) {
    EXPECT_GT(static_cast<int>(entry.number), last);
    last = static_cast<int>(entry.number);
    EXPECT_NE(std::string(entry.title), "") << last;
    EXPECT_NE(std::string(entry.rule), "") << last;
    EXPECT_NE(std::string(entry.cure), "") << last;
  }
  EXPECT_LT(last, 500);
}

TEST_F(ReporterTest, OutsideOfACommandItIsToldAtOnce) {
  reporter_.report(Id::kRecordStride, "x");
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Id.text(), "KA0435");
  EXPECT_EQ(messages_[0].Text, "KA0435 stride too small for the records: x");
  EXPECT_EQ(messages_[0].Severity, rtapi::MessageSeverity::kError);
}

TEST_F(ReporterTest, OnceWithACountAndTheLeastPixel) {
  reporter_.begin("DispatchRays, command 2");
  for (uint64_t pixel : {7u, 3u, 9u}) {
    reporter_.report(Id::kRootAccessOutOfBounds, 1, pixel,
                     [&] { return "pixel " + std::to_string(pixel); });
  }
  reporter_.add_count(Id::kRootAccessOutOfBounds, 1, 10);
  EXPECT_TRUE(messages_.empty());
  reporter_.end();
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Text,
            "KA0417 root descriptor out of bounds: pixel 3 [and 12 more times] (DispatchRays, "
            "command 2)");
}

TEST_F(ReporterTest, AtMostSoManyPerCommand) {
  reporter_.begin("Dispatch, command 0");
  for (int i = 0; i < 300; ++i) {
    reporter_.report(Id::kRootAccessOutOfBounds, static_cast<uint64_t>(i), static_cast<uint64_t>(i),
                     [&] { return std::to_string(i); });
  }
  reporter_.end();
  ASSERT_EQ(messages_.size(), 4u);
  EXPECT_EQ(messages_[0].Text.substr(0, 41), "KA0417 root descriptor out of bounds: 0 (");
  EXPECT_EQ(messages_[3].Text,
            "KA0400 more findings: 297 more are not shown. Correct the first ones and run again. "
            "(Dispatch, command 0)");
}

TEST(NamesTest, AddressesRangesAndRecords) {
  runtime::AddressMap addresses;
  addresses.insert({.address = 0x1000, .size_bytes = 416, .name = "sofa.vb"});
  EXPECT_EQ(address_name(addresses, 0), "address 0");
  EXPECT_EQ(address_name(addresses, 0x20), "address 0x20, which is in no live buffer");
  EXPECT_EQ(address_name(addresses, 0x1010), "byte 16 of buffer \"sofa.vb\" (416 bytes)");
  EXPECT_EQ(range_name(addresses, 0x1000 + 410, 12),
            "bytes 410..422 of buffer \"sofa.vb\" (416 bytes)");
  rtapi::DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = {0x4000, 64};
  desc.HitGroupTable = {0x5000, 256, 64};
  EXPECT_EQ(record_name(desc, 0x4020), "ray generation record");
  EXPECT_EQ(record_name(desc, 0x50C0 + 32), "hit group table record 3");
  EXPECT_EQ(record_name(desc, 0x6000), "");
}

}  // namespace
}  // namespace kaamos::checks
