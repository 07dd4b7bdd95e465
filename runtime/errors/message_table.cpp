// SPDX-License-Identifier: MIT
#include "runtime/errors/message_table.h"

#include <algorithm>
#include <cassert>

namespace kaamos::errors {

const MessageRow* find_row(MessageTable table, rtapi::ErrorId id) {
  const auto found = std::ranges::lower_bound(table, id.number, {}, &MessageRow::number);
  return found != table.end() && found->number == id.number ? &*found : nullptr;
}

const MessageRow& row_of(MessageTable table, rtapi::ErrorId id) {
  const MessageRow* row = find_row(table, id);
  assert(row != nullptr);
  return *row;
}

std::string head_of(const MessageRow& row) {
  return rtapi::ErrorId{row.number}.text() + " " + row.title + ": ";
}

rtapi::Error make_error(MessageTable table, rtapi::ErrorId id, const std::string& detail) {
  const MessageRow& row = row_of(table, id);
  return {id, row.code, head_of(row) + detail};
}

rtapi::Message make_message(MessageTable table, rtapi::ErrorId id, const std::string& detail) {
  const MessageRow& row = row_of(table, id);
  return {row.severity, id, head_of(row) + detail};
}

}  // namespace kaamos::errors
