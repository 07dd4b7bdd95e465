// SPDX-License-Identifier: MIT
//
// Reports for checked mode. Whoever finds something (the layer in this folder, or a backend that
// reads what instrumented shader code left behind) hands it to the device's Reporter, which reports
// it once with a count, and limits how many are reported per command. A finding never stops
// anything: execution goes on as the conformance list says for the case.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include <rtapi/message.h>

#include "runtime/errors/message_table.h"

namespace kaamos::checks {

// The number in KA04nn.
enum class Id : uint16_t {
#define KAAMOS_MESSAGE(number, name, ...) name = number,
#include "runtime/checks/messages.inc"
#undef KAAMOS_MESSAGE
};

errors::MessageTable message_table();

// Thread-safe.
class Reporter {
 public:
  using Sink = std::function<void(const rtapi::Message&)>;
  // By default this many different findings per command are reported in full; the rest become a
  // number.
  static constexpr uint32_t kDefaultLimit = 16;

  explicit Reporter(Sink sink, uint32_t limit = kDefaultLimit)
      : sink_(std::move(sink)), limit_(limit) {}

  // Reports one finding. `text` says what, where, actual and allowed, and what to do, without the
  // id and the title: "hit group table record 7 (...) ...: 416..432 of buffer \"x\" (416 bytes). Is
  // ...?". Findings with the same id and key count as one; the text with the lowest `order` is kept
  // (the linear index of the pixel, so that the message does not depend on how threads run). `text`
  // is only called if it may be needed. Outside of a command the finding is reported at once.
  template <class TextFn>
  void report(Id id, uint64_t key, uint64_t order, TextFn&& text) {
    const std::lock_guard lock(mutex_);
    Finding* finding = count(id, key, order);
    if (finding != nullptr) finding->text = text();
    if (!open_) flush();
  }
  // The same, with the text itself as the key.
  void report(Id id, const std::string& text) {
    report(id, key_of(text), 0, [&] { return text; });
  }
  // Adds `count` to a finding that was counted elsewhere, e.g. on a GPU.
  void add_count(Id id, uint64_t key, uint64_t count);

  // Findings between the two calls belong to one command and are reported at its end, sorted by
  // `order`. `where` closes each message: "DispatchRays, command 3 in \"shadows\"".
  void begin(std::string where);
  void end();

  static uint64_t key_of(std::string_view text);

 private:
  struct Finding {
    uint64_t order = 0;
    uint64_t count = 0;
    std::string text;
  };
  // Returns the finding that needs a text, or null.
  Finding* count(Id id, uint64_t key, uint64_t order);
  void flush();

  Sink sink_;
  uint32_t limit_;
  std::mutex mutex_;
  bool open_ = false;
  std::string where_;
  std::map<std::pair<Id, uint64_t>, Finding> findings_;
  uint64_t left_out_ = 0;  // findings that there was no room for
};

}  // namespace kaamos::checks
