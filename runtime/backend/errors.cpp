// SPDX-License-Identifier: MIT
#include "runtime/backend/errors.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <iterator>

namespace kaamos::runtime {
namespace {

using rtapi::ErrorCode;
using rtapi::MessageSeverity;

constexpr MessageEntry kTable[] = {
#define KAAMOS_RUNTIME_MESSAGE(number, name, severity, code, title, rule, cure) \
  {Id::name, MessageSeverity::severity, ErrorCode::code, title, rule, cure},
#include "runtime/backend/errors.inc"
#undef KAAMOS_RUNTIME_MESSAGE
};

const MessageEntry& entry_of(Id id) {
  const auto* found = std::lower_bound(std::begin(kTable), std::end(kTable), id,
                                       [](const MessageEntry& e, Id i) { return e.id < i; });
  assert(found != std::end(kTable) && found->id == id);
  return *found;
}

std::string text_of(const MessageEntry& entry, const std::string& detail) {
  return public_id(entry.id).text() + " " + entry.title + ": " + detail;
}

}  // namespace

std::span<const MessageEntry> message_table() {
  return kTable;
}

rtapi::Error make_error(Id id, ErrorCode code, const std::string& detail) {
  return {public_id(id), code, text_of(entry_of(id), detail)};
}

rtapi::Error make_error(Id id, const std::string& detail) {
  return make_error(id, entry_of(id).code, detail);
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

std::string hexadecimal(uint64_t address) {
  char text[2 + 16 + 1];
  std::snprintf(text, sizeof(text), "0x%llx", static_cast<unsigned long long>(address));
  return text;
}

rtapi::Message make_message(Id id, const std::string& detail) {
  const MessageEntry& entry = entry_of(id);
  return {entry.severity, public_id(id), text_of(entry, detail)};
}

}  // namespace kaamos::runtime
