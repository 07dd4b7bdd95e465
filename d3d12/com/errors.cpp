// SPDX-License-Identifier: MIT
#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

namespace {

constexpr errors::MessageRow kTable[] = {
#define KAAMOS_MESSAGE KAAMOS_MESSAGE_ROW
#include "d3d12/com/errors.inc"
#undef KAAMOS_MESSAGE
};

}  // namespace

rtapi::Error make_error(ErrorId id, const std::string& detail) {
  return errors::make_error(kTable, public_id(id), detail);
}

}  // namespace kaamos::d3d12
