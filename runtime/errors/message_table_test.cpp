// SPDX-License-Identifier: MIT
#include "runtime/errors/message_table.h"

#include <gtest/gtest.h>

#include "runtime/errors/text.h"

namespace kaamos::errors {
namespace {

constexpr MessageRow kRows[] = {
    KAAMOS_MESSAGE_ROW(7, kFirst, kWarning, kFailed, "odd", "", "Even it out.")
        KAAMOS_MESSAGE_ROW(504, kSecond, kError, kNotFound, "lost", "SO-04", "Look for it.")};

TEST(MessageTable, AnErrorHasItsIdItsCodeAndItsTitle) {
  const rtapi::Error error = make_error(kRows, {504}, "a \"b\"");
  EXPECT_EQ(error.id.number, 504);
  EXPECT_EQ(error.code, rtapi::ErrorCode::kNotFound);
  EXPECT_EQ(error.message, "KA0504 lost: a \"b\"");
}

TEST(MessageTable, AMessageHasItsSeverity) {
  const rtapi::Message message = make_message(kRows, {7}, "3");
  EXPECT_EQ(message.Severity, rtapi::MessageSeverity::kWarning);
  EXPECT_EQ(message.Id.number, 7);
  EXPECT_EQ(message.Text, "KA0007 odd: 3");
}

TEST(MessageTable, FindsItsOwnIdsOnly) {
  for (const uint16_t number : {0, 6, 8, 503, 505}) EXPECT_EQ(find_row(kRows, {number}), nullptr);
  for (const MessageRow& row : kRows) EXPECT_EQ(find_row(kRows, {row.number}), &row);
}

TEST(Text, NamesStandInQuotesAndAddressesAreHexadecimal) {
  EXPECT_EQ(concat("buffer ", in_quotes("sofa"), " at ", hex(31), ", ", 2u, " of ", 0.5),
            "buffer \"sofa\" at 0x1f, 2 of 0.5");
  EXPECT_EQ(hex(UINT64_MAX), "0xffffffffffffffff");
}

}  // namespace
}  // namespace kaamos::errors
