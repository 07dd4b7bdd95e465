// SPDX-License-Identifier: MIT
#include "rtapi/src/errors/error_table.h"

namespace rtapi::detail {

namespace {

constexpr kaamos::errors::MessageRow kTable[] = {
#define KAAMOS_MESSAGE KAAMOS_MESSAGE_ROW
#include "rtapi/src/errors/errors.inc"
#undef KAAMOS_MESSAGE
};

}  // namespace

kaamos::errors::MessageTable error_table() {
  return kTable;
}

Error make_error(Id id, const std::string& detail) {
  return kaamos::errors::make_error(kTable, public_id(id), detail);
}

}  // namespace rtapi::detail
