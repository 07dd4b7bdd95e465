// SPDX-License-Identifier: MIT
#include "effects/assets/common/errors.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace kaamos::effects {
namespace {

constexpr ErrorEntry kTable[] = {
#define KAAMOS_EFFECTS_ERROR(number, name, code, title, source, cure) \
  {ErrorId::name, rtapi::ErrorCode::code, title, source, cure},
#include "effects/assets/common/errors.inc"
#undef KAAMOS_EFFECTS_ERROR
};

const ErrorEntry* find_entry(ErrorId id) {
  const auto* found = std::lower_bound(std::begin(kTable), std::end(kTable), id,
                                       [](const ErrorEntry& e, ErrorId i) { return e.id < i; });
  return found != std::end(kTable) && found->id == id ? found : nullptr;
}

std::string head_of(const ErrorEntry& entry) {
  const rtapi::ErrorId number{static_cast<std::uint16_t>(entry.id)};
  return number.text() + " " + entry.title + ": ";
}

}  // namespace

std::span<const ErrorEntry> error_table() {
  return kTable;
}

Error make_error(ErrorId id, const std::string& detail) {
  const ErrorEntry* entry = find_entry(id);
  assert(entry != nullptr);
  return {{static_cast<std::uint16_t>(id)}, entry->code, head_of(*entry) + detail};
}

Error within(const std::string& where, const Error& error, ErrorId otherwise) {
  const auto id = static_cast<ErrorId>(error.id.number);
  const ErrorEntry* entry = find_entry(id);
  if (entry == nullptr) return make_error(otherwise, where + ": " + error.message);
  return make_error(id, where + ": " + error.message.substr(head_of(*entry).size()));
}

}  // namespace kaamos::effects
