// SPDX-License-Identifier: MIT
#include "tests/conformance/checked.h"

#include <shaders/errors.h>

namespace kaamos::conformance {

using namespace rtapi;

namespace {

DeviceDesc in_checked_mode(const Context& t,
                           const std::shared_ptr<std::vector<Message>>& messages) {
  DeviceDesc desc = t.target().device_desc();
  desc.Checked = true;
  // A list's messages arrive before ExecuteAndWait returns, one at a time.
  desc.OnMessage = [messages](const Message& message) { messages->push_back(message); };
  return desc;
}

}  // namespace

Checked::Checked(Context& t, Messages told)
    : Context(in_checked_mode(t, told), t.target()), outer_(t), messages_(std::move(told)) {}

Checked::~Checked() {
  for (const std::string& failure : failures()) outer_.fail(failure);
}

void Checked::told(const std::string& what, const char* id) {
  for (const Message& message : take_messages()) {
    if (message.Id.text() == id) return;
  }
  fail(what + ": no message " + id);
}

void Checked::not_told(const std::string& what, const char* id) {
  for (const Message& message : take_messages()) {
    if (message.Id.text() == id) fail(what + ": " + message.Text);
  }
}

void Checked::silent(const std::string& what) {
  for (const Message& message : take_messages()) {
    if (message.Severity == MessageSeverity::kInfo) continue;
    if (message.Id.number >= 400 && message.Id.number < 500) fail(what + ": " + message.Text);
  }
}

CheckedScene::CheckedScene(Checked& t) : Program(t, kaamos_shaders_errors()) {
  group("Plain", "Floor");
  group("Nested", "Deeper");
  group("Boxes", "", "", "Front");
  group("Odd", "", "", "Reports");
  local(kRecordSignature, {"Plain", "Odd"});
  scene = t.scene({triangle(5)});
  rays = t.upload(std::vector<Ray>{Ray()});
}

void CheckedScene::add(const std::string& hit_group, const Constants& constants) {
  raygen("One");
  miss("Sky");
  if (hit_group == "Plain" || hit_group == "Odd") {
    hit(hit_group, {LocalArgument::Constants(constants)});
  } else {
    hit(hit_group);
  }
}

}  // namespace kaamos::conformance
