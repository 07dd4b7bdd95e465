// SPDX-License-Identifier: MIT
//
// The setting that the tests of errors share: a context in checked mode that records messages, and
// a small scene in which each test breaks one thing.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

// A context with its own device; its failures count as the rule's.
class Checked : public Context {
 public:
  explicit Checked(Context& t) : Checked(t, std::make_shared<std::vector<rtapi::Message>>()) {}
  ~Checked();
  // The message must have arrived since the last call.
  void told(const std::string& what, const char* id);
  // It may not.
  void not_told(const std::string& what, const char* id);
  // No error or warning of checked mode may have arrived since then.
  void silent(const std::string& what);
  rtapi::Status execute(rtapi::CommandList& list) { return queue().ExecuteAndWait(list); }
  rtapi::CommandList list() { return device().CreateCommandList().value(); }

 private:
  using Messages = std::shared_ptr<std::vector<rtapi::Message>>;
  Checked(Context& t, Messages told);
  std::vector<rtapi::Message> take_messages() { return std::exchange(*messages_, {}); }

  Context& outer_;
  Messages messages_;
};

// errors.hlsl with one ray that hits a triangle. Hit groups: Plain, Nested, Boxes, Odd.
class CheckedScene : public Program {
 public:
  explicit CheckedScene(Checked& t);
  // Adds a record to each table except the callable table.
  void add(const std::string& hit_group, const Constants& constants = {});
};

// The tests of err_tests that are about dispatches.
std::vector<RuleTest> err_dispatch_tests();

}  // namespace kaamos::conformance
