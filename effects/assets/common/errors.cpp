// SPDX-License-Identifier: MIT
#include "effects/assets/common/errors.h"

#include "runtime/errors/message_table.h"

namespace kaamos::effects {
namespace {

constexpr errors::MessageRow kTable[] = {
#define KAAMOS_MESSAGE KAAMOS_MESSAGE_ROW
#include "effects/assets/common/errors.inc"
#undef KAAMOS_MESSAGE
};

}  // namespace

Error make_error(ErrorId id, const std::string& detail) {
  return errors::make_error(kTable, errors::public_id(id), detail);
}

Error within(const std::string& where, const Error& error, ErrorId otherwise) {
  const errors::MessageRow* row = errors::find_row(kTable, error.id);
  if (row == nullptr) return make_error(otherwise, where + ": " + error.message);
  const std::string detail = error.message.substr(errors::head_of(*row).size());
  return errors::make_error(kTable, error.id, where + ": " + detail);
}

}  // namespace kaamos::effects
