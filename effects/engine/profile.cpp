// SPDX-License-Identifier: MIT
#include "effects/engine/profile.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace kaamos::effects {

namespace {

double wall_clock_ms() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

}  // namespace

double process_clock_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

Profile::Profile() : steps_(1), running_{0}, wall_ms_(wall_clock_ms()) {
  steps_.front().name = "other";
  steps_.front().count = 1;
}

Profile::Scope::~Scope() {
  if (profile_ == nullptr) return;
  profile_->settle();
  profile_->running_.pop_back();
}

Profile::Scope Profile::enter(Profile* profile, ProfilePart part, const std::string& name) {
  if (profile != nullptr) {
    profile->settle();
    auto& steps = profile->steps_;
    auto found = std::find_if(steps.begin(), steps.end(), [&](const ProfileStep& step) {
      return step.part == part && step.name == name;
    });
    if (found == steps.end()) found = steps.insert(found, {part, name});
    ++found->count;
    profile->running_.push_back(static_cast<std::size_t>(found - steps.begin()));
  }
  return Scope(profile);
}

std::vector<ProfileStep> Profile::steps() {
  settle();
  return steps_;
}

void Profile::settle() {
  const double wall_ms = wall_clock_ms(), cpu_ms = process_clock_ms();
  ProfileStep& step = steps_[running_.back()];
  step.wall_ms += wall_ms - wall_ms_;
  step.cpu_ms += cpu_ms - cpu_ms_;
  wall_ms_ = wall_ms;
  cpu_ms_ = cpu_ms;
}

}  // namespace kaamos::effects
