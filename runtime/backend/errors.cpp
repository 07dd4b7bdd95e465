// SPDX-License-Identifier: MIT
#include "runtime/backend/errors.h"

namespace kaamos::runtime {
namespace {

constexpr errors::MessageRow kTable[] = {
#define KAAMOS_MESSAGE KAAMOS_MESSAGE_ROW
#include "runtime/backend/errors.inc"
#undef KAAMOS_MESSAGE
};

}  // namespace

rtapi::Error make_error(Id id, rtapi::ErrorCode code, const std::string& detail) {
  rtapi::Error error = make_error(id, detail);
  error.code = code;
  return error;
}

rtapi::Error make_error(Id id, const std::string& detail) {
  return errors::make_error(kTable, public_id(id), detail);
}

Id removal_id(shader::RemovalReason reason) {
  switch (reason) {
    case shader::RemovalReason::kRecursionDepth:
      return Id::kRecursionLimit;
    case shader::RemovalReason::kStackOverflow:
      return Id::kShaderStack;
    case shader::RemovalReason::kFault:
      return Id::kShaderFault;
    case shader::RemovalReason::kStepLimit:
      return Id::kStepLimit;
    case shader::RemovalReason::kMultisampled:
      return Id::kMultisampled;
    case shader::RemovalReason::kOther:
      break;
  }
  return Id::kShaderRemoval;
}

rtapi::Message make_message(Id id, const std::string& detail) {
  return errors::make_message(kTable, public_id(id), detail);
}

}  // namespace kaamos::runtime
