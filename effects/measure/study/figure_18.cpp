// SPDX-License-Identifier: MIT
#include "effects/measure/study/figure_18.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "effects/measure/curves/measure.h"
#include "effects/measure/study/light_costs.h"
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

// The columns are milliseconds for one light and for four. [survey: figure 18]
struct SurveyRow {
  const char* name;
  double pub[2], resort[2], breakfast[2];
};

constexpr SurveyRow kSurvey[] = {{"shadow map, hard", {0.7, 2.6}, {2.3, 9.1}, {0.9, 5.9}},
                                 {"rays, hard", {1.4, 4.8}, {1.3, 3.4}, {1.6, 3.7}},
                                 {"rays, soft, standard", {3.2, 13.5}, {2.7, 8.3}, {4.7, 11.0}},
                                 {"rays, soft, high", {3.5, 19.9}, {2.9, 12.0}, {6.5, 16.2}}};
static_assert(kHardRays == 1);  // all else is told in its times

const StudyRow* find_row(const StudyResult& result, const std::string& effect,
                         const std::string& label) {
  const Effect* row = find_effect(northlight_effects(), effect);
  for (const StudyRow& each : result.rows) {
    if (row != nullptr && each.technique == row->about && each.label == label) return &each;
  }
  return nullptr;
}

std::string adaptive_label(std::uint32_t rays) {
  return fmt::format("{} rays at most", rays);
}

// Says how a ratio of ours stands to those of the survey's three scenes.
std::string beside_theirs(double here, const std::vector<double>& theirs) {
  const auto [low, high] = std::minmax_element(theirs.begin(), theirs.end());
  if (here < *low) return fmt::format("cheaper: {:.2g} of their least", here / *low);
  if (here > *high) return fmt::format("dearer: {:.2g} times their most", here / *high);
  return "agrees: between their scenes";
}

// The survey's ratios to hard rays: Pub, Resort, Breakfast, each with one light and with four.
std::vector<double> ratios_of(const SurveyRow& row) {
  const SurveyRow& unit = kSurvey[kHardRays];
  std::vector<double> out;
  for (const auto& [scene, by] :
       {std::pair(row.pub, unit.pub), {row.resort, unit.resort}, {row.breakfast, unit.breakfast}}) {
    for (int lights = 0; lights < 2; ++lights) out.push_back(scene[lights] / by[lights]);
  }
  return out;
}

// Those for one light (0) or for four (1).
std::vector<double> with_lights(const std::vector<double>& ratios, std::size_t lights) {
  return {ratios[lights], ratios[2 + lights], ratios[4 + lights]};
}

const std::vector<std::string> kTheirScenes = {
    "Pub, 1 light", "4 lights", "Resort, 1 light", "4 lights", "Breakfast, 1 light", "4 lights"};

std::optional<StudyTable> figure_18(const StudyResult& result) {
  const StudyRow* ours[] = {
      find_row(result, "sun-map", "2048 x 2048"), find_row(result, "sun", "1 ray"),
      find_row(result, "adaptive-sun", adaptive_label(kAdaptiveStandardSamples)),
      find_row(result, "adaptive-sun", adaptive_label(kAdaptiveHighSamples))};
  for (const StudyRow* row : ours) {
    if (row == nullptr) return std::nullopt;
  }
  StudyTable out{"figure-18", "The survey's figure 18: shadow maps against rays", {}, {}};
  out.title += result.title.find(',') == std::string::npos
                   ? ""
                   : result.title.substr(result.title.find(','));
  if (result.family != "shadows") out.name += result.family.substr(std::string("shadows").size());
  out.cells.columns = {"time over that of hard rays", "setting here"};
  for (const std::string& scene : kTheirScenes) out.cells.columns.push_back(scene);
  out.cells.columns.insert(out.cells.columns.end(), {"here, the sun", "beside theirs of 1 light"});
  for (std::size_t i = 0; i < std::size(kSurvey); ++i) {
    auto& cells =
        out.cells.rows.emplace_back(std::vector{std::string(kSurvey[i].name), ours[i]->label});
    const std::vector<double> theirs = ratios_of(kSurvey[i]);
    for (const double ratio : theirs) cells.push_back(fmt::format("{:.2f}", ratio));
    if (!ours[i]->missing.empty() || !(ours[kHardRays]->ms > 0)) {
      cells.push_back("-");
      cells.push_back("not measured: " + ours[i]->missing);
      continue;
    }
    const double here = ours[i]->ms / ours[kHardRays]->ms;
    cells.push_back(fmt::format("{:.2f}", here));
    cells.push_back(i == kHardRays ? "the unit" : beside_theirs(here, with_lights(theirs, 0)));
  }
  out.about = {
      result.is_measured()
          ? result.subtitle + fmt::format("; hard rays, which end at the first hit that they find, "
                                          "take {:.3g} ms",
                                          ours[kHardRays]->ms)
          : result.title + ": not measured, " + ours[kHardRays]->missing,
      "Theirs: 1920 x 1080, RTX 2080 Ti, maps of 2048 x 2048 texels; Pub 281 000, Resort 376 000, "
      "Breakfast 1.4 million triangles. Here: one scene and one light, the sun; "
      "--families figure-18 measures four lights",
      "Why they differ: here maps are drawn by the same cores that trace rays, and a map costs as "
      "much for a small picture as for a large one; adaptive rays pay for passes over the picture "
      "that a GPU hides"};
  return out;
}

// Milliseconds of a technique: of the sun's shadows, or of all four lights'.
double cost_of(const LightCosts& costs, std::size_t technique, bool four) {
  const LightCost& cost = costs.by_technique[technique];
  return cost.sun_ms + (four ? cost.lamps_ms : 0.0);
}

// A row for each technique; `costs`: over the traced G-buffer and over the drawn one.
StudyTable lights_table(const Options& options, const LightCosts (&costs)[2]) {
  StudyTable out{"figure-18-lights",
                 "The survey's figure 18: one light and four, by maps, rays and both",
                 {},
                 {}};
  out.cells.columns = {"time over that of hard rays", "setting here"};
  for (const std::string& scene : kTheirScenes) out.cells.columns.push_back(scene);
  for (const char* column :
       {"here, G-buffer traced: the sun", "sun and 3 lamps", "drawn: the sun", "sun and 3 lamps",
        "RMSE, the sun", "RMSE, all four", "1 light beside theirs", "4 lights beside theirs"}) {
    out.cells.columns.push_back(column);
  }
  const bool has_lamps = costs[0].lamps > 0;
  for (std::size_t i = 0; i < light_techniques().size(); ++i) {
    const LightTechnique& technique = light_techniques()[i];
    auto& cells = out.cells.rows.emplace_back(std::vector{technique.name, technique.label});
    std::vector<double> theirs;
    for (const SurveyRow& row : kSurvey) {
      if (technique.name == row.name) theirs = ratios_of(row);
    }
    for (std::size_t k = 0; k < kTheirScenes.size(); ++k) {
      cells.push_back(theirs.empty() ? "-" : fmt::format("{:.2f}", theirs[k]));
    }
    double traced[2] = {};
    for (std::size_t which = 0; which < 2; ++which) {
      for (const bool four : {false, true}) {
        const double ratio =
            cost_of(costs[which], i, four) / cost_of(costs[which], kHardRays, four);
        if (which == 0) traced[four ? 1 : 0] = ratio;
        cells.push_back(four && !has_lamps ? "-" : fmt::format("{:.2f}", ratio));
      }
    }
    cells.push_back(fmt::format("{:.3f}", costs[0].by_technique[i].sun_error));
    cells.push_back(has_lamps ? fmt::format("{:.3f}", costs[0].by_technique[i].all_error) : "-");
    for (const std::size_t lights : {0u, 1u}) {
      cells.push_back(i == kHardRays   ? "the unit"
                      : theirs.empty() ? "not in theirs"
                      : lights == 1 && !has_lamps
                          ? "not measured: too few lamps"
                          : beside_theirs(traced[lights], with_lights(theirs, lights)));
    }
  }
  out.about = {
      fmt::format(
          "Scene {}, medians of {} frames; G-buffer traced {:.3g} ms, drawn {:.3g} ms; hard "
          "rays {:.3g} ms for the sun, {:.3g} ms for all lights; a lamp's map {:.3g} ms",
          scene_text(options), options.repeats, costs[0].surfaces_ms, costs[1].surfaces_ms,
          cost_of(costs[0], kHardRays, false), cost_of(costs[0], kHardRays, true), costs[0].map_ms),
      has_lamps
          ? "Four lights: the sun and the three lamps nearest to the camera. Errors are those "
            "of visibility, over the traced G-buffer, against 256 rays to each light"
          : "Four lights are not measured: the scene has fewer than three lamps",
      "Why they differ: a lamp's map has 128 x 128 texels here, 2048 x 2048 there, and maps and "
      "rays "
      "share the same cores; adaptive rays pay for nine passes over the picture for each light, "
      "which a GPU hides. Which G-buffer there is matters to its own time alone"};
  return out;
}

}  // namespace

std::vector<StudyTable> shadow_tables(const std::vector<StudyResult>& results) {
  std::vector<StudyTable> out;
  for (const StudyResult& result : results) {
    if (!result.family.starts_with("shadows")) continue;
    if (auto table = figure_18(result)) out.push_back(*table);
  }
  return out;
}

rtapi::Result<Outcome> study_figure_18(const Options& options, const Scene& scene,
                                       const Progress& progress, std::vector<StudyTable>& tables) {
  const auto make = [&](std::vector<StudyTable>& out) -> rtapi::Result<Outcome> {
    if (!scene.sun) {
      out.push_back({"figure-18-lights", "The survey's figure 18", {}, {}});
      out.back().about = {
          "Not measured: the scene has no sun; --sun AZIMUTH,ELEVATION gives it one"};
      return Outcome::kDone;
    }
    LightCosts costs[2];
    const Primary primaries[] = {Primary::kRays, Primary::kRaster};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto done = measure_lights(options, scene, primaries[i], progress, costs[i]);
      if (!is_done(done)) return done;
    }
    out.push_back(lights_table(options, costs));
    return Outcome::kDone;
  };
  return kept_tables(options.out + "/study/figure-18.json", tables_key(options, scene), make,
                     tables);
}

}  // namespace kaamos::measure
