// SPDX-License-Identifier: MIT
#include "profile_table.h"

#include <fmt/format.h>

#include <utility>

namespace northlight {

using kaamos::effects::ProfilePart;
using kaamos::effects::ProfileStep;

namespace {

struct Sum {
  double wall_ms = 0, cpu_ms = 0;
  void add(const ProfileStep& step) {
    wall_ms += step.wall_ms;
    cpu_ms += step.cpu_ms;
  }
};

Sum sum_of(const std::vector<ProfileStep>& steps) {
  Sum out;
  for (const ProfileStep& step : steps) out.add(step);
  return out;
}

std::vector<ProfileStep> steps_of(const std::vector<ProfileStep>& steps, ProfilePart part) {
  std::vector<ProfileStep> out;
  for (const ProfileStep& step : steps) {
    if (step.part == part) out.push_back(step);
  }
  return out;
}

std::string line(const std::string& name, const std::string& count, const Sum& sum,
                 const Sum& all) {
  const double share = all.wall_ms > 0 ? 100 * sum.wall_ms / all.wall_ms : 0;
  return fmt::format("{:<28}{:>6}{:>12.1f}{:>12.1f}{:>8.1f} %\n", name, count, sum.wall_ms,
                     sum.cpu_ms, share);
}

}  // namespace

std::string print_profile(const std::vector<ProfileStep>& steps) {
  const Sum all = sum_of(steps);
  std::string out = fmt::format("\n{:<28}{:>6}{:>12}{:>12}{:>10}\n", "profile", "times", "wall ms",
                                "cpu ms", "of wall");
  for (const auto& [part, title] :
       {std::pair(ProfilePart::kStart, "start-up"), std::pair(ProfilePart::kFrame, "frame"),
        std::pair(ProfilePart::kFiles, "files"), std::pair(ProfilePart::kRest, "rest")}) {
    const std::vector<ProfileStep> of_part = steps_of(steps, part);
    if (of_part.empty()) continue;
    out += line(title, "", sum_of(of_part), all);
    for (const ProfileStep& step : of_part) {
      out += line("  " + step.name, std::to_string(step.count), {step.wall_ms, step.cpu_ms}, all);
    }
  }
  return out + line("total", "", all, all);
}

}  // namespace northlight
