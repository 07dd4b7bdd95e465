// SPDX-License-Identifier: MIT
#include "effects/measure/claims/claims_page.h"

#include <fmt/format.h>

#include <vector>

#include "effects/measure/run/machine.h"

namespace kaamos::measure {

namespace {

std::string number(double value) {
  return value < 1000 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

std::string number(const std::optional<double>& value) {
  return value ? number(*value) : "-";
}

std::string line(const std::vector<std::string>& cells) {
  std::string out = "|";
  for (const std::string& cell : cells) out += " " + cell + " |";
  return out + "\n";
}

std::string head(const std::vector<std::string>& columns) {
  std::string out = line(columns) + "|";
  for (std::size_t i = 0; i < columns.size(); ++i) out += "---|";
  return out + "\n";
}

std::string claims_text(const ClaimTable& table) {
  std::vector<std::string> columns = {"claim", "theirs"};
  columns.insert(columns.end(), table.backends.begin(), table.backends.end());
  std::string out = "## Ratios and shares\n\n" + head(columns);
  for (const Claim& claim : table.claims) {
    std::vector<std::string> cells = {claim.text, claim.seed};
    for (const auto& value : claim.here) cells.push_back(number(value));
    out += line(cells);
  }
  return out;
}

std::string rates(double ms, double pixels, double rays) {
  const Rate rate = rate_of(ms, pixels, rays);
  return number(rate.ms_per_megapixel) + ", " + number(rate.ns_per_ray);
}

std::string deck_text(const ClaimTable& table) {
  std::vector<std::string> columns = {"pass, rays a pixel", "theirs: ms", "ms/Mpx, ns/ray"};
  for (const std::string& backend : table.backends) {
    columns.push_back(backend + ": ms");
    columns.emplace_back("ms/Mpx, ns/ray");
    columns.emplace_back("over theirs, per ray");
  }
  std::string out =
      "## The deck's milliseconds\n\nTheirs: 1920 x 1080 on an RTX 2080 Ti.\n\n" + head(columns);
  for (const DeckNumber& each : table.deck) {
    const double rays = each.rays * kDeckPixels;
    std::vector<std::string> cells = {fmt::format("{}, {:g}", each.name, each.rays),
                                      number(each.ms), rates(each.ms, kDeckPixels, rays)};
    for (std::size_t i = 0; i < each.here.size(); ++i) {
      const auto& here = each.here[i];
      if (!here) {
        cells.insert(cells.end(), {"-", "-", "-"});
        continue;
      }
      const double pixels = table.pixels[i];
      cells.push_back(number(here->ms));
      cells.push_back(rates(here->ms, pixels, here->rays));
      cells.push_back(number(rate_of(here->ms, pixels, here->rays).ns_per_ray /
                             rate_of(each.ms, kDeckPixels, rays).ns_per_ray));
    }
    out += line(cells);
  }
  out += "\nWhat can be compared:\n\n";
  for (const DeckNumber& each : table.deck) {
    out += fmt::format("- {}: {}.\n", each.name, each.compare);
  }
  return out +
         "- Milliseconds cannot be: their rays are found by units of a GPU, these by the cores "
         "that "
         "also shade and filter. Passes of one column can: in which order they stand, and by how "
         "much.\n";
}

std::string control_text(const ClaimTable& table) {
  std::vector<std::string> columns = {"pass", "Control, frames 1 and 2: ms", "share, %"};
  for (const std::string& backend : table.backends) {
    columns.push_back(backend + ": ms");
    columns.emplace_back("share, %");
  }
  double theirs[2] = {};
  std::vector<double> ours(table.backends.size());
  for (const ControlPass& pass : table.control) {
    if (pass.is_build) continue;
    for (int frame = 0; frame < 2; ++frame) theirs[frame] += pass.frames[frame];
    for (std::size_t i = 0; i < ours.size(); ++i) ours[i] += pass.here[i].value_or(0);
  }
  std::string out =
      "## Control's frame\n\nThe survey's Table 1: 2560 x 1440 on an RTX 3090. Shares are of the "
      "sum without structures.\n\n" +
      head(columns);
  for (const ControlPass& pass : table.control) {
    std::vector<std::string> cells = {
        pass.name, fmt::format("{:g}, {:g}", pass.frames[0], pass.frames[1]),
        fmt::format("{:.0f}, {:.0f}", 100 * pass.frames[0] / theirs[0],
                    100 * pass.frames[1] / theirs[1])};
    for (std::size_t i = 0; i < ours.size(); ++i) {
      cells.push_back(number(pass.here[i]));
      cells.push_back(pass.here[i] ? fmt::format("{:.2g}", 100 * *pass.here[i] / ours[i]) : "-");
    }
    out += line(cells);
  }
  std::vector<std::string> cells = {
      "sum without structures", fmt::format("{:.1f}, {:.1f}", theirs[0], theirs[1]), "100, 100"};
  for (const double sum : ours) {
    cells.push_back(number(sum));
    cells.emplace_back("100");
  }
  return out + line(cells) +
         "\n- Theirs builds what moves in a game; here a frame moves on by 1/30 s, and what stands "
         "still costs its top level alone.\n"
         "- Glass: theirs traces and shades apart (0.8 and 0.7, 0.3 and 0.1 ms), here the nearest "
         "layer is one pass with its sort.\n"
         "- Every signal is filtered by SVGF here, by filters made for each signal in Control.\n";
}

}  // namespace

Rate rate_of(double ms, double pixels, double rays) {
  return {1e6 * ms / pixels, 1e6 * ms / rays};
}

std::string claims_page(const Options& options, const ClaimTable& table) {
  return fmt::format(
      "# Claims\n\n    {}\n\nprints the first table and writes this page: what the talk, the deck "
      "and the survey say in numbers, beside what is measured here. Scene: {}. Medians of {} "
      "rounds, {}; {}.\n\n{}\n{}\n{}",
      options.command, options.scene, options.repeats,
      options.cpu_clock ? "processor time over threads" : "by the clock", machine(),
      claims_text(table), deck_text(table), control_text(table));
}

}  // namespace kaamos::measure
