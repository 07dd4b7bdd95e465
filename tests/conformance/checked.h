// SPDX-License-Identifier: MIT
//
// What the tests of errors work with: a context in checked mode that hears what it says, and a
// small scene on it of which each test spoils one thing.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

// A context of its own whose failures go to the rule's.
class Checked : public Context {
 public:
  explicit Checked(Context& t) : Checked(t, std::make_shared<std::vector<rtapi::Message>>()) {}
  ~Checked();
  // The message must have been told since the last call.
  void told(const std::string& what, const char* id);
  // No error or warning of checked mode since then.
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

// errors.hlsl, with one ray that hits a triangle. Hit groups Plain, Nested, Boxes, Odd.
class CheckedScene : public Program {
 public:
  explicit CheckedScene(Checked& t);
  // A record of each table but callables.
  void add(const std::string& hit_group, const Constants& constants = {});
};

// Those of err_tests that are of dispatches.
std::vector<RuleTest> err_dispatch_tests();

}  // namespace kaamos::conformance
