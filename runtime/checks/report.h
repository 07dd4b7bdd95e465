// SPDX-License-Identifier: MIT
//
// How checked mode speaks. Whoever finds something (the layer in this folder, a backend that reads
// what instrumented shader code left behind) hands it to the device's Reporter, which says it once
// with a count, and at most so much per command. A finding never stops anything: execution goes on
// with the policy that the conformance list states for the case.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <rtapi/device.h>

namespace kaamos::checks {

// The number in KA04nn.
enum class Id : uint16_t {
#define KAAMOS_CHECK(number, name, severity, title, rule) name = number,
#include "runtime/checks/messages.inc"
#undef KAAMOS_CHECK
};

struct MessageEntry {
  Id id;
  rtapi::MessageSeverity severity;
  const char* title;  // what a message says after the id
  const char* rule;   // items of the conformance list
};
// Sorted by id.
std::span<const MessageEntry> message_table();
std::string id_text(Id id);  // "KA0417"

// Thread-safe.
class Reporter {
 public:
  using Sink = std::function<void(const rtapi::Message&)>;
  // Different findings per command before only their number is told.
  static constexpr uint32_t kDefaultLimit = 16;

  explicit Reporter(Sink sink, uint32_t limit = kDefaultLimit)
      : sink_(std::move(sink)), limit_(limit) {}

  // One finding. `text` says what, where, actual and allowed, and what to do, without the id and
  // the title: "hit group table record 7 (...) ...: 416..432 of buffer \"x\" (416 bytes). Is ...?".
  // Findings of one id and key are the same one; of those the text with the least `order` is told
  // (the linear index of the pixel, so that the message does not depend on the threads). `text` is
  // only called if it may be told. Outside of a command it is told at once.
  template <class TextFn>
  void report(Id id, uint64_t key, uint64_t order, TextFn&& text) {
    const std::lock_guard lock(mutex_);
    Finding* finding = count(id, key, order);
    if (finding != nullptr) finding->text = text();
    if (!open_) flush();
  }
  // The same with the text as key.
  void report(Id id, const std::string& text) {
    report(id, key_of(text), 0, [&] { return text; });
  }
  // `count` more of a finding that was counted elsewhere, e.g. on a GPU.
  void add_count(Id id, uint64_t key, uint64_t count);

  // What is found between the two belongs to one command and is told at its end, in the order of
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
  // To be given a text, or null.
  Finding* count(Id id, uint64_t key, uint64_t order);
  void flush();

  Sink sink_;
  uint32_t limit_;
  std::mutex mutex_;
  bool open_ = false;
  std::string where_;
  std::map<std::pair<Id, uint64_t>, Finding> findings_;
  uint64_t left_out_ = 0;  // findings for which there was no room
};

}  // namespace kaamos::checks
