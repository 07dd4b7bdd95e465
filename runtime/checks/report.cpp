// SPDX-License-Identifier: MIT
#include "runtime/checks/report.h"

#include <algorithm>
#include <vector>

namespace kaamos::checks {
namespace {

constexpr errors::MessageRow kTable[] = {
#define KAAMOS_MESSAGE KAAMOS_MESSAGE_ROW
#include "runtime/checks/messages.inc"
#undef KAAMOS_MESSAGE
};

rtapi::Message make_message(Id id, const std::string& detail) {
  return errors::make_message(kTable, errors::public_id(id), detail);
}

// At most this many different findings of one command are kept apart; the rest are only counted.
constexpr size_t kMostKept = 256;

}  // namespace

errors::MessageTable message_table() {
  return kTable;
}

uint64_t Reporter::key_of(std::string_view text) {
  uint64_t hash = 0xCBF29CE484222325u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return hash;
}

Reporter::Finding* Reporter::count(Id id, uint64_t key, uint64_t order) {
  const auto it = findings_.find({id, key});
  if (it == findings_.end()) {
    if (findings_.size() >= kMostKept) {
      ++left_out_;
      return nullptr;
    }
    Finding& finding = findings_[{id, key}];
    finding.order = order;
    finding.count = 1;
    return &finding;
  }
  Finding& finding = it->second;
  ++finding.count;
  if (order >= finding.order) return nullptr;
  finding.order = order;
  return &finding;
}

void Reporter::add_count(Id id, uint64_t key, uint64_t more) {
  const std::lock_guard lock(mutex_);
  if (const auto it = findings_.find({id, key}); it != findings_.end()) it->second.count += more;
}

void Reporter::begin(std::string where) {
  const std::lock_guard lock(mutex_);
  flush();
  open_ = true;
  where_ = std::move(where);
}

void Reporter::end() {
  const std::lock_guard lock(mutex_);
  flush();
  open_ = false;
  where_.clear();
}

void Reporter::flush() {
  if (findings_.empty()) return;
  struct Shown {
    Id id;
    const Finding* finding;
  };
  std::vector<Shown> shown;
  for (const auto& [key, finding] : findings_) shown.push_back({key.first, &finding});
  std::stable_sort(shown.begin(), shown.end(), [](const Shown& a, const Shown& b) {
    return a.finding->order < b.finding->order;
  });
  const std::string place = where_.empty() ? "" : " (" + where_ + ")";
  const size_t told = std::min<size_t>(shown.size(), limit_);
  for (size_t i = 0; i < told; ++i) {
    const uint64_t again = shown[i].finding->count - 1;
    std::string text = shown[i].finding->text;
    if (again > 0) text += " [and " + std::to_string(again) + " more times]";
    sink_(make_message(shown[i].id, text + place));
  }
  if (const uint64_t rest = shown.size() - told + left_out_; rest > 0) {
    sink_(make_message(Id::kMoreFindings,
                       std::to_string(rest) +
                           " more are not shown. Correct the first ones and run again." + place));
  }
  findings_.clear();
  left_out_ = 0;
}

}  // namespace kaamos::checks
