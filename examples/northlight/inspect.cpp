// SPDX-License-Identifier: MIT
#include "inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "effects/image/heat_map.h"
#include "effects/image/png.h"

namespace northlight {

using kaamos::effects::RayPass;

rtapi::Result<std::vector<std::pair<std::string, rtapi::TableDescription>>>
Renderer::describe_tables(const ShaderLibraries& libraries) {
  std::vector<std::pair<std::string, rtapi::TableDescription>> out;
  for (const RayStep& step : steps(libraries)) {
    const auto pass = RayPass::create(device_, frame_, gpu_, step.desc);
    if (!pass) return pass.error();
    rtapi::TableDescriptionDesc desc;
    desc.Dispatch = pass->tables();
    desc.TopLevel = gpu_.top_level.GetGPUVirtualAddress();
    for (std::uint32_t type = 0; type < kaamos::effects::kRayTypeCount; ++type) {
      desc.RayTypes.push_back({type == kaamos::effects::kRayTypeSurface ? "surface" : "visibility",
                               type, kaamos::effects::kRayTypeCount, type});
    }
    auto described = rtapi::DescribeShaderTables(device_, pass->pipeline(), desc);
    if (!described) return described.error();
    out.emplace_back(step.desc.name, std::move(*described));
  }
  return out;
}

rtapi::Status Renderer::execute_band(rtapi::CommandList& list, const std::string& pass,
                                     std::uint32_t first_row, std::uint32_t row_count,
                                     FrameResult& result) {
  const auto& chosen = options_.explain;
  if (chosen && chosen->second >= first_row && chosen->second < first_row + row_count) {
    auto pixel =
        rtapi::ExplainPixel(queue_, list, {.X = chosen->first, .Y = chosen->second - first_row});
    if (!pixel) return pixel.error();
    result.explained.push_back({pass, first_row, std::move(*pixel)});
    return device_.GetDeviceRemovedReason();
  }
  if (options_.heatmap.empty()) return queue_.ExecuteAndWait(list);
  const auto counts = rtapi::CollectPixelStatistics(queue_, list);
  if (!counts) return counts.error();
  result.pixel_counts.resize(std::size_t{options_.width} * options_.height);
  for (std::size_t i = 0; i < counts->Pixels.size(); ++i) {
    const rtapi::PixelStatistics& from = counts->Pixels[i];
    rtapi::PixelStatistics& to = result.pixel_counts[std::size_t{first_row} * options_.width + i];
    to.TraceRayCalls += from.TraceRayCalls;
    to.AnyHitCalls += from.AnyHitCalls;
    to.Candidates += from.Candidates;
    to.MaxDepth = std::max(to.MaxDepth, from.MaxDepth);
  }
  return {};
}

std::string print_tables(const std::vector<std::pair<std::string, rtapi::TableDescription>>& passes,
                         bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::object();
    for (const auto& [name, tables] : passes) {
      all[name] = nlohmann::ordered_json::parse(rtapi::ToJson(tables));
    }
    return all.dump(2) + "\n";
  }
  std::string out;
  for (const auto& [name, tables] : passes) {
    out += fmt::format("{}{}:\n{}", out.empty() ? "" : "\n", name, rtapi::ToText(tables));
  }
  return out;
}

std::string print_explanations(const std::vector<ExplainedDispatch>& dispatches, bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const ExplainedDispatch& each : dispatches) {
      all.push_back({{"pass", each.pass},
                     {"first_row", each.first_row},
                     {"pixel", nlohmann::ordered_json::parse(rtapi::ToJson(each.pixel))}});
    }
    return all.dump(2) + "\n";
  }
  std::string out;
  for (const ExplainedDispatch& each : dispatches) {
    out += fmt::format("{}{}, rows from {}:\n{}", out.empty() ? "" : "\n", each.pass,
                       each.first_row, rtapi::ToText(each.pixel));
  }
  return out;
}

std::string write_heatmap(const Options& options, const FrameResult& frame, std::string& said) {
  std::vector<std::uint32_t> counts;
  counts.reserve(frame.pixel_counts.size());
  for (const rtapi::PixelStatistics& pixel : frame.pixel_counts) {
    counts.push_back(options.heatmap == "anyhit"       ? pixel.AnyHitCalls
                     : options.heatmap == "candidates" ? pixel.Candidates
                     : options.heatmap == "depth"      ? pixel.MaxDepth
                                                       : pixel.TraceRayCalls);
  }
  const auto picture = kaamos::effects::heat_map(options.width, options.height, counts);
  const std::string path = options.out + "/heatmap-" + options.heatmap + ".png";
  if (const auto written = kaamos::effects::write_png(path, picture.image); !written.ok()) {
    return written.error();
  }
  said = fmt::format("wrote {}: black is 0, white {} or more; the most is {}, the mean {:.2f}\n",
                     path, picture.white, picture.most, picture.mean);
  return {};
}

}  // namespace northlight
