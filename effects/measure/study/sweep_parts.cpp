// SPDX-License-Identifier: MIT
#include "effects/measure/study/sweep_parts.h"

#include <fmt/format.h>

namespace kaamos::measure {

MeasurePlan base_plan(const std::string& effect, const Options& options) {
  Options own = options;
  own.measure = effect;
  own.quick = false;
  MeasurePlan plan = measure_plan(own);
  plan.settings.clear();
  plan.references.resize(1);
  return plan;
}

void add_to(MeasurePlan& plan, const std::string& group, std::string label,
            const Setting& setting) {
  plan.settings.push_back({group, std::move(label), setting, plan.references.front().name});
}

std::string counted(std::uint32_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

}  // namespace kaamos::measure
