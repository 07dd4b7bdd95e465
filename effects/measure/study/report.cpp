// SPDX-License-Identifier: MIT
#include "effects/measure/study/report.h"

#include <fmt/format.h>
#include <rtapi/version.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "effects/measure/run/failure.h"
#include "effects/measure/study/findings.h"
#include "effects/measure/study/page.h"
#include "effects/measure/study/plans.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0);
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
    }
  }
  return out;
}

rtapi::Result<std::string> as_url(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(in)),
                                   std::istreambuf_iterator<char>());
  if (bytes.empty()) return failure("cannot read " + file + ", a picture of the study");
  return "data:image/png;base64," + base64(bytes);
}

// The results as the page's script reads them, with their pictures.
rtapi::Result<std::string> as_script(const std::string& folder,
                                     const std::vector<StudyResult>& results) {
  auto all = nlohmann::ordered_json::array();
  for (const StudyResult& result : results) {
    auto one = nlohmann::ordered_json::parse(to_json(std::vector{result})).front();
    const auto inline_picture = [&](nlohmann::ordered_json& name) -> rtapi::Status {
      if (name.get<std::string>().empty()) return {};
      const auto url = as_url(folder + "/" + name.get<std::string>());
      if (!url) return url.error();
      name = *url;
      return {};
    };
    if (const auto s = inline_picture(one["truth_picture"]); !s) return s.error();
    for (auto& row : one["rows"]) {
      for (const char* picture : {"picture", "difference"}) {
        if (const auto s = inline_picture(row[picture]); !s) return s.error();
      }
    }
    all.push_back(one);
  }
  std::string text = all.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  // "</script>" within a name would end the script.
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) {
    text.replace(at, 2, "<\\/");
  }
  return text;
}

std::string table_of(const StudyResult& result) {
  std::set<std::size_t> front;
  for (const std::size_t i : pareto_front(result.trades())) front.insert(i);
  const bool has_flicker = std::any_of(result.rows.begin(), result.rows.end(),
                                       [](const StudyRow& row) { return row.flicker >= 0; });
  std::string heads;
  std::size_t also = 0;
  for (const StudyRow& row : result.rows) {
    if (row.also.size() <= also) continue;
    also = row.also.size();
    heads.clear();
    for (const auto& [name, number] : row.also) heads += "<th>" + escaped(name) + "</th>";
  }
  std::string out = fmt::format(
      "<table><thead><tr><th>technique</th><th>setting</th><th>ms</th><th>rays a pixel</th>"
      "<th>RMSE</th><th>FLIP</th><th>SSIM</th><th>energy</th>{}<th>spread of ms</th><th></th></tr>"
      "</thead><tbody class=\"settings\">\n",
      (has_flicker ? "<th>flicker</th>" : "") + heads);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const StudyRow& row = result.rows[i];
    const std::string begin = fmt::format(
        "<tr{} title=\"{}\"><td>{}</td><td>{}</td>", front.count(i) != 0 ? " class=\"front\"" : "",
        escaped(row.command), escaped(row.technique), escaped(row.label));
    if (!row.missing.empty()) {
      out += begin + fmt::format("<td colspan=\"{}\">not measured: {}</td></tr>\n",
                                 (has_flicker ? 9 : 8) + also, escaped(row.missing));
      continue;
    }
    std::string more;
    for (const auto& [name, number] : row.also) more += fmt::format("<td>{:.3g}</td>", number);
    out += begin;
    out += fmt::format(
        "<td>{:.3g}</td><td>{:.2f}</td><td>{:.3g}</td><td>{:.4f}</td>"
        "<td>{:.4f}</td><td>{:.3f}</td>{}<td>{:.0f} %</td><td>{}</td></tr>\n",
        row.ms, row.traced, row.error, row.flip, row.ssim, row.energy,
        (!has_flicker       ? std::string()
         : row.flicker >= 0 ? fmt::format("<td>{:.4f}</td>", row.flicker)
                            : std::string("<td></td>")) +
            more,
        100 * row.ms_spread, escaped(row.note));
  }
  return out + "</tbody></table>\n";
}

std::string misses_of(const StudyResult& result) {
  std::string out;
  std::set<std::string> seen;
  for (const StudyRow& row : result.rows) {
    if (!seen.insert(row.technique).second) continue;
    const std::string misses = what_it_misses(row.technique);
    if (misses.empty()) continue;
    out += "<tr><td>" + escaped(row.technique) + "</td><td>" + escaped(misses) + "</td></tr>\n";
  }
  if (out.empty()) return {};
  return "<h3>What each technique misses</h3><table><tbody>\n" + out + "</tbody></table>\n";
}

std::string pictures_of(const StudyResult& result) {
  std::string options = "<option value=\"truth\">" + escaped(result.truth) + "</option>";
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const std::string name = escaped(setting_name(result.rows[i]));
    options += fmt::format(
        "<option value=\"{0}\">{1}</option><option value=\"d{0}\">{1}: 4 x |error|</option>", i,
        name);
  }
  std::string left = options;
  left.replace(left.find("\"0\""), 3, "\"0\" selected");
  return "<figure><div class=\"controls\">left <select class=\"left\">" + left +
         "</select> right <select class=\"right\">" + options +
         "</select></div>\n<div class=\"split\"><img alt=\"right\"><img alt=\"left\">"
         "<div class=\"line\"></div></div>\n"
         "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"border\">"
         "<figcaption>" +
         escaped(
             result.title + ": " + result.signal +
             ". The slider moves the border between the two pictures; \"4 x |error|\" is how far "
             "each pixel is from the truth, black where it is right. Grey: not compared.") +
         "</figcaption></figure>\n";
}

double middle_error(const StudyResult& result) {
  std::vector<double> errors;
  for (const StudyRow& row : result.rows) {
    if (row.missing.empty()) errors.push_back(row.error);
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 2];
}

std::string section_of(const StudyResult& result) {
  std::string out = fmt::format("<section id=\"{}\"><h2>{}</h2>\n", escaped(result.family),
                                escaped(result.title));
  if (!result.is_measured()) return out + table_of(result) + "</section>\n";
  std::string plot = plot_svg(as_plot(result));
  plot.erase(0, plot.find("<svg"));
  out +=
      "<figure>" + plot + "<figcaption>" +
      escaped(result.subtitle + "; against the " + result.truth) +
      ". A point on the lower left is better; a click shows its picture.</figcaption></figure>\n";
  out += fmt::format(
      "<p>For an error below <input class=\"wanted\" type=\"number\" step=\"any\" min=\"0\" "
      "value=\"{:.3g}\"> <span class=\"advice\"></span>.</p>\n",
      1.01 * middle_error(result));
  out += pictures_of(result) + table_of(result);
  out +=
      "<p>A dot marks the Pareto front: nothing else measured here is both as fast and as "
      "accurate.</p>\n";
  for (const std::string& line : result.about) out += "<p>" + escaped(line) + ".</p>\n";
  return out + misses_of(result) + "</section>\n";
}

// No section: those have plots and pictures.
std::string article_of(const StudyTable& table) {
  std::string out = fmt::format("<article id=\"{}\"><h2>{}</h2>\n<table><thead><tr>",
                                escaped(table.name), escaped(table.title));
  for (const std::string& column : table.cells.columns) out += "<th>" + escaped(column) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.cells.rows) {
    out += "<tr>";
    for (const std::string& cell : row) out += "<td>" + escaped(cell) + "</td>";
    out += "</tr>\n";
  }
  out += "</tbody></table>\n";
  for (const std::string& line : table.about) out += "<p>" + escaped(line) + ".</p>\n";
  return out + "</article>\n";
}

// "AMD EPYC 7B13": of the first processor; empty: the system does not say.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(':');
    return colon == std::string::npos ? "" : line.substr(colon + 2);
  }
  return {};
}

// On what, by what and how often everything was measured.
std::string circumstances(const Options& options) {
  const std::uint32_t threads =
      options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
  std::string out = fmt::format("Measured on {}, {} {}, with Kaamos {}", processor(), threads,
                                threads == 1 ? "thread" : "threads", rtapi::GetVersion());
  if (!options.commit.empty()) out += " of commit " + options.commit;
  out += fmt::format(
      "; seeds {} to {}, references of {} samples a pixel, path-traced truth of {}. Times are "
      "medians of {} runs{}; their spread is that of the longest and the shortest over the median. "
      "Techniques that keep a history are timed in the eighth frame of a sequence at rest. "
      "Command: {}",
      options.frame.seed + 1, options.frame.seed + options.repeats, options.measure_reference,
      options.measure_truth, options.repeats,
      options.cpu_clock ? ", processor time over threads" : "", options.command);
  return "<p>" + escaped(out) + "; a row's own command shows above it.</p>\n";
}

}  // namespace

rtapi::Result<std::string> study_page(const Options& options,
                                      const std::vector<StudyResult>& results,
                                      const std::vector<StudyTable>& tables) {
  const std::string& scene = options.scene;
  const auto data = as_script(options.out + "/study", results);
  if (!data) return data.error();
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>What accuracy "
      "costs: " +
      escaped(scene) + "</title>\n<style>" + kPageStyle +
      "</style></head><body>\n<h1>What accuracy costs: " + escaped(scene) + "</h1>\n<ul>\n";
  for (const std::string& line : study_findings(results)) {
    out += "<li>" + escaped(line.substr(line.find_first_not_of(' '))) + "</li>\n";
  }
  out += "</ul>\n" + circumstances(options);
  for (const StudyResult& result : results) out += section_of(result);
  for (const StudyTable& table : tables) out += article_of(table);
  return out + "<script>const study = " + *data + ";</script>\n<script>" + kPageScript +
         "</script>\n</body></html>\n";
}

}  // namespace kaamos::measure
