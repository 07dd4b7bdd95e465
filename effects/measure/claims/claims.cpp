// SPDX-License-Identifier: MIT
#include "effects/measure/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/denoise/denoise.h"
#include "effects/glass/transparent/transparent.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/measure/claims/claims_page.h"
#include "effects/measure/curves/measure.h"
#include "effects/measure/run/failure.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

// The costs that are timed, each once per round.
enum Cost : std::size_t {
  kAo1,
  kAo16,
  kAoFilter,
  kSunRay,  // per traced ray, like kAoRay
  kAoRay,
  kContactTrace,
  kContactFilter,
  kReflectionTrace,
  kReflectionNoSun,
  kReflection,
  kReflectionFilter,
  kIndirectTrace,
  kIndirectBlack,
  kIndirect,
  kIndirectFilter,
  kBuild,  // what a frame of a sequence does to its acceleration structures
  kGlass,  // the first layer
  kSunPair,
  kCosts
};

// Milliseconds of one round (kSunRay, kAoRay: per ray); negative: this scene has no such cost.
using Round = std::array<double, kCosts>;

constexpr std::uint32_t kManyRays = 4;     // per pixel, where the costs of single rays are compared
constexpr std::uint32_t kDeckSunRays = 2;  // per pixel, in the deck
constexpr double kFramesPerSecond = 30;

// SVGF over what a setting's run has summed up.
class Filter {
 public:
  rtapi::Status create(EffectRuns& runs, const DenoiseLibraries& libraries, const Setting& setting,
                       const std::string& name) {
    const rtapi::Device& device = runs.renderer().device();
    const Frame& frame = runs.renderer().frame();
    const auto mean =
        frame.create_picture(device, name + " mean", rtapi::Format::kR32G32B32A32Float);
    if (!mean) return mean.error();
    mean_ = *mean;
    auto denoiser = Denoiser::create(device, frame, libraries, name, mean_,
                                     default_denoise(DenoiseMethod::kSvgf));
    if (!denoiser) return denoiser.error();
    denoiser_ = std::move(*denoiser);
    return denoiser_.create_load(device, frame, libraries, runs.sum(setting));
  }
  rtapi::Result<double> run(EffectRuns& runs) {
    return runs.renderer().runner().execute([&](rtapi::CommandList& list) {
      denoiser_.load(list, runs.renderer().frame(), 1);
      denoiser_.dispatch(list, runs.renderer().frame());
    });
  }

 private:
  rtapi::Texture mean_;
  Denoiser denoiser_;
};

struct Timed {
  Cost cost;
  Setting setting;
  bool per_ray = false;
};

struct Filtered {
  Cost cost;
  Setting setting;
  std::unique_ptr<Filter> filter;
};

struct Plan {
  std::vector<Timed> runs;
  std::vector<Filtered> filters;
};

rtapi::Result<Plan> make_plan(EffectRuns& runs, const Options& options) {
  Plan plan;
  const Scene& scene = runs.renderer().context().scene;
  Setting ao = setting_of("ao");
  ao.settings.radius = options.effects.at("ao").radius;
  constexpr std::pair<Cost, std::uint32_t> kAoRuns[] = {
      {kAo16, 16}, {kAoRay, kManyRays}, {kAo1, 1}};
  for (const auto& [cost, rays] : kAoRuns) {
    ao.settings.samples = rays;
    plan.runs.push_back({cost, ao, cost == kAoRay});
  }
  plan.filters.push_back({kAoFilter, ao, nullptr});
  if (scene.sun) {
    plan.runs.push_back({kSunRay, setting_of("sun", kManyRays), true});
    plan.runs.push_back({kSunPair, setting_of("sun", kDeckSunRays)});
  }
  if (has_glass(scene)) {
    Setting glass = setting_of("transparent");
    glass.settings.set_constants(deck_layers(1));
    plan.runs.push_back({kGlass, glass});
  }
  if (!scene.lights.empty()) {
    const Setting contact = setting_of("contact");
    plan.runs.push_back({kContactTrace, contact});
    plan.filters.push_back({kContactFilter, contact, nullptr});
  }
  Setting reflection = setting_of("reflections");
  reflection.change<ReflectionConstants>(
      [](auto& constants) { constants.fireflies = Fireflies::kKeep; });
  Setting without_sun = reflection;
  without_sun.change<ReflectionConstants>(
      [](auto& constants) { constants.sun_at_hits = SunAtHits::kNone; });
  Setting trace = reflection;
  trace.settings.trace_only = true;
  plan.runs.push_back({kReflectionTrace, trace});
  if (scene.sun) plan.runs.push_back({kReflectionNoSun, without_sun});
  plan.runs.push_back({kReflection, reflection});
  plan.filters.push_back({kReflectionFilter, reflection, nullptr});
  const Setting indirect = setting_of("gi");
  Setting black = indirect;
  black.change<IndirectConstants>(
      [](auto& constants) { constants.mode = IndirectMode::kHitBlack; });
  trace = black;
  trace.settings.trace_only = true;
  plan.runs.push_back({kIndirectTrace, trace});
  plan.runs.push_back({kIndirectBlack, black});
  plan.runs.push_back({kIndirect, indirect});
  plan.filters.push_back({kIndirectFilter, indirect, nullptr});
  const auto libraries = denoise_libraries();
  if (!libraries) return libraries.error();
  for (Filtered& filtered : plan.filters) {
    filtered.filter = std::make_unique<Filter>();
    if (const auto s =
            filtered.filter->create(runs, *libraries, filtered.setting,
                                    fmt::format("claim {}", static_cast<int>(filtered.cost)));
        !s) {
      return s.error();
    }
  }
  return plan;
}

// Moves on to the next frame of a sequence with the camera at rest: milliseconds of its structures.
rtapi::Result<double> run_structures(EffectRuns& runs, std::uint32_t frame) {
  FrameRenderer& renderer = runs.renderer();
  const auto begun = renderer.begin_frame({.index = frame,
                                           .seconds = frame / kFramesPerSecond,
                                           .camera = renderer.context().scene.cameras.front(),
                                           .cut = frame == 0});
  if (!begun) return begun.error();
  for (const PassStatistics& pass : renderer.runner().passes()) {
    if (pass.name == "structures") return pass.ms;
  }
  return failure("the frame's structures were not timed");
}

rtapi::Result<Round> run_round(EffectRuns& runs, Plan& plan, std::uint32_t frame) {
  Round round;
  round.fill(-1);
  const auto build_ms = run_structures(runs, frame);
  if (!build_ms) return build_ms.error();
  round[kBuild] = *build_ms;
  for (const Timed& timed : plan.runs) {
    const auto ran = runs.run(timed.setting);
    if (!ran) return ran.error();
    const double rays = static_cast<double>(std::max<std::uint64_t>(ran->rays, 1));
    round[timed.cost] = timed.per_ray ? ran->ms / rays : ran->ms;
  }
  for (Filtered& filtered : plan.filters) {
    const auto ms = filtered.filter->run(runs);
    if (!ms) return ms.error();
    round[filtered.cost] = *ms;
  }
  return round;
}

// The median over the rounds of value(round); empty if a cost is missing.
template <class Value>
std::optional<double> over(const std::vector<Round>& rounds, std::initializer_list<Cost> needs,
                           Value value) {
  std::vector<double> values;
  for (const Round& round : rounds) {
    for (const Cost cost : needs) {
      if (round[cost] < 0) return std::nullopt;
    }
    values.push_back(value(round));
  }
  return median(values);
}

std::optional<double> ratio(const std::vector<Round>& rounds, Cost a, Cost b, double scale = 1) {
  return over(rounds, {a, b}, [=](const Round& round) { return scale * round[a] / round[b]; });
}

// The number of every claim on one backend, in the order of kTexts.
std::vector<std::optional<double>> numbers(const std::vector<Round>& rounds) {
  std::vector<std::optional<double>> out = {
      ratio(rounds, kAo16, kAo1, 1.0 / 16), ratio(rounds, kSunRay, kAoRay),
      ratio(rounds, kReflection, kReflectionNoSun), ratio(rounds, kIndirect, kIndirectBlack),
      ratio(rounds, kAoFilter, kAo1)};
  struct {
    Cost trace, shaded, filter;
  } const shares[] = {{kReflectionTrace, kReflection, kReflectionFilter},
                      {kIndirectTrace, kIndirect, kIndirectFilter}};
  for (const auto& s : shares) {
    const auto share = [&](auto part) {
      return over(rounds, {s.trace, s.shaded, s.filter}, [&](const Round& round) {
        return 100 * part(round) / (round[s.shaded] + round[s.filter]);
      });
    };
    out.push_back(share([&](const Round& round) { return round[s.trace]; }));
    out.push_back(share([&](const Round& round) { return round[s.shaded] - round[s.trace]; }));
    out.push_back(share([&](const Round& round) { return round[s.filter]; }));
  }
  const auto contact = [&](Cost part) {
    return over(rounds, {kContactTrace, kContactFilter}, [=](const Round& round) {
      return 100 * round[part] / (round[kContactTrace] + round[kContactFilter]);
    });
  };
  out.push_back(contact(kContactTrace));
  out.push_back(contact(kContactFilter));
  return out;
}

// The claims of the sources. Control's shares are those of frames 1 and 2 in its Table 1, whose
// last row is called reflections but is the sum of all ray traced effects: 8.9 and 7.1 ms, 9.5 and
// 8.1 ms with the structures (effects/SOURCES.md: E7). [GDC 2018 talk; Northlight deck; survey:
// Table 1]
constexpr std::pair<const char*, const char*> kTexts[] = {
    {"AO: 16 rays a pixel / 16 x 1 ray (0.85 to 1.15)", "1.00: 80 ms / 16 x 5 ms"},
    {"a sun ray / an AO ray of 4 m", "below 1: coherent"},
    {"reflections: with a sun ray per hit / without", "about 2"},
    {"indirect: hits lit / hit = black", "1.5 to 2"},
    {"AO: denoising / 1 ray", "0.44: 0.4 / 0.9 ms"},
    {"reflections: trace, %", "31, 42"},
    {"reflections: shade, %", "44, 33"},
    {"reflections: denoise, %", "25, 24"},
    {"indirect: trace, %", "30, 30"},
    {"indirect: shade, %", "30, 26"},
    {"indirect: denoise, %", "41, 43"},
    {"contact shadows: trace, %", "53, 36"},
    {"contact shadows: denoise, %", "47, 64"}};

// The passes of Control that are timed here too. [survey: Table 1]
const std::vector<ControlPass> kControl = {
    {"structures: build and update", {0.6, 1.0}, {}, true},
    {"reflections: trace", {1.0, 1.4}, {}},
    {"reflections: shade", {1.4, 1.1}, {}},
    {"reflections: denoise", {0.8, 0.8}, {}},
    {"transparent reflections: trace and shade", {1.5, 0.4}, {}},
    {"indirect diffuse: trace", {0.8, 0.7}, {}},
    {"indirect diffuse: shade", {0.8, 0.6}, {}},
    {"indirect diffuse: denoise", {1.1, 1.0}, {}},
    {"contact shadows: trace", {0.8, 0.4}, {}},
    {"contact shadows: denoise", {0.7, 0.7}, {}}};

// In the order of kControl.
std::vector<std::optional<double>> control_costs(const std::vector<Round>& rounds) {
  const auto cost = [&](Cost which) {
    return over(rounds, {which}, [=](const Round& round) { return round[which]; });
  };
  const auto more = [&](Cost all, Cost part) {
    return over(rounds, {all, part}, [=](const Round& round) { return round[all] - round[part]; });
  };
  return {cost(kBuild),
          cost(kReflectionTrace),
          more(kReflection, kReflectionTrace),
          cost(kReflectionFilter),
          cost(kGlass),
          cost(kIndirectTrace),
          more(kIndirect, kIndirectTrace),
          cost(kIndirectFilter),
          cost(kContactTrace),
          cost(kContactFilter)};
}

// The deck's numbers: what each is, per pixel, and what can be said of it here.
const std::vector<DeckNumber> kDeck = {
    {"sun shadow",
     0.9,
     kDeckSunRays,
     "the same rays; theirs end at the first hit that they find, and these too, unless a "
     "denoiser reads how far it is",
     {}},
    {"contact shadows and denoising",
     1.4,
     2,
     "as many rays, one to each of two lights, which look for the closest hit here; theirs has "
     "another denoiser than SVGF",
     {}},
    {"reflections and denoising",
     4.4,
     1,
     "a ray a pixel with a sun ray at its hit in both; materials and denoisers differ",
     {}},
    {"near-field indirect light and denoising",
     2.5,
     1,
     "a ray a pixel that is lit where it hits, within 3 m here, and reads the volume beyond; how "
     "long theirs are the deck does not say",
     {}}};

// In the order of kDeck.
std::vector<std::optional<TimedPass>> deck_costs(const std::vector<Round>& rounds, double pixels) {
  const auto timed = [&](std::initializer_list<Cost> costs,
                         double rays) -> std::optional<TimedPass> {
    const auto ms = over(rounds, costs, [&](const Round& round) {
      double sum = 0;
      for (const Cost cost : costs) sum += round[cost];
      return sum;
    });
    if (!ms) return std::nullopt;
    return TimedPass{*ms, rays * pixels};
  };
  return {timed({kSunPair}, kDeck[0].rays), timed({kContactTrace, kContactFilter}, kDeck[1].rays),
          timed({kReflection, kReflectionFilter}, kDeck[2].rays),
          timed({kIndirect, kIndirectFilter}, kDeck[3].rays)};
}

rtapi::Result<Outcome> run_rounds(const Options& options, const Scene& scene,
                                  const std::string& cache, const Progress& progress,
                                  std::vector<Round>& rounds) {
  std::unique_ptr<EffectRuns> runs;
  std::vector<std::string> effects = {"ao", "sun", "local", "contact", "gi", "reflections"};
  if (has_glass(scene)) effects.emplace_back("transparent");
  Options own = options;
  own.frame.moving = true;  // frames keep their structures
  const auto created = EffectRuns::create(own, scene, effects, cache, progress, options.say, runs);
  if (!is_done(created)) return created;
  auto plan = make_plan(*runs, options);
  if (!plan) return plan.error();
  // One uncounted round first, so that pipelines, caches and histories exist.
  for (std::uint32_t repeat = 0; repeat <= options.repeats; ++repeat) {
    const auto round = run_round(*runs, *plan, repeat);
    if (!round) return round.error();
    if (repeat > 0) rounds.push_back(*round);
    const double done = (repeat + 1.0) / (options.repeats + 1.0);
    if (!progress(options.backend, done)) return Outcome::kStopped;
  }
  return Outcome::kDone;
}

bool has_vulkan() {
  const auto devices = rtapi::EnumerateDevices();
  return std::any_of(devices.begin(), devices.end(),
                     [](const rtapi::DeviceInfo& info) { return info.Backend == "vulkan"; });
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : "-";
}

}  // namespace

rtapi::Result<Outcome> measure_claims(const Options& options, const Scene& scene,
                                      const Progress& progress, ClaimTable& table) {
  const std::string cache = options.out + "/measure-cache";
  std::error_code failed;
  std::filesystem::create_directories(cache, failed);
  if (failed) return failure("cannot make the folder " + cache + ": " + failed.message());
  for (const auto& [text, seed] : kTexts) table.claims.push_back({text, seed, {}});
  table.control = kControl;
  table.deck = kDeck;
  // In this order, so that the second run finds the volume that the first one bakes.
  for (const std::string& backend : {std::string("embree"), std::string("vulkan")}) {
    if (backend == "vulkan" && !has_vulkan()) continue;
    Options own = options;
    own.backend = backend;
    if (backend == "vulkan") {
      own.frame.width = std::max(options.frame.width / 4, 1u);
      own.frame.height = std::max(options.frame.height / 4, 1u);
    }
    std::vector<Round> rounds;
    const auto ran = run_rounds(own, scene, cache, progress, rounds);
    if (!is_done(ran)) return ran;
    table.backends.push_back(fmt::format("{} {} x {}", backend, own.frame.width, own.frame.height));
    const auto values = numbers(rounds);
    for (std::size_t i = 0; i < values.size(); ++i) table.claims[i].here.push_back(values[i]);
    const auto costs = control_costs(rounds);
    for (std::size_t i = 0; i < costs.size(); ++i) table.control[i].here.push_back(costs[i]);
    const double pixels = static_cast<double>(own.frame.width) * own.frame.height;
    table.pixels.push_back(pixels);
    const auto deck = deck_costs(rounds, pixels);
    for (std::size_t i = 0; i < deck.size(); ++i) table.deck[i].here.push_back(deck[i]);
  }
  return Outcome::kDone;
}

std::string as_text(const ClaimTable& table) {
  std::string out = fmt::format("{:<50}{:<26}", "claim", "the seeds");
  for (const std::string& backend : table.backends) out += fmt::format("{:>20}", backend);
  out += "\n";
  for (const Claim& claim : table.claims) {
    out += fmt::format("{:<50}{:<26}", claim.text, claim.seed);
    for (const auto& value : claim.here) out += fmt::format("{:>20}", number(value));
    out += "\n";
  }
  return out;
}

Table as_csv(const ClaimTable& table) {
  Table out;
  out.columns = {"claim", "seeds"};
  out.columns.insert(out.columns.end(), table.backends.begin(), table.backends.end());
  for (const Claim& claim : table.claims) {
    out.rows.push_back({claim.text, claim.seed});
    for (const auto& value : claim.here) {
      out.rows.back().push_back(value ? csv_number(*value) : "");
    }
  }
  return out;
}

rtapi::Result<Outcome> run_claims(const Options& options, const Scene& scene,
                                  const Progress& progress, std::string& said) {
  ClaimTable table;
  if (const auto s = measure_claims(options, scene, progress, table); !is_done(s)) return s;
  const std::string text = write_csv(as_csv(table)), path = options.out + "/claims.csv";
  if (const auto s = write_text(path, text); !s.ok()) return s.error();
  const std::string page = options.out + "/claims.md";
  if (const auto s = write_text(page, claims_page(options, table)); !s.ok()) return s.error();
  said = fmt::format("{}, median of {} rounds{}\n{}\nwrote {} and {}\n", options.scene,
                     options.repeats, options.cpu_clock ? ", CPU time over threads" : "",
                     as_text(table), path, page);
  return Outcome::kDone;
}

}  // namespace kaamos::measure
