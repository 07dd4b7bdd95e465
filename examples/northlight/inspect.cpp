// SPDX-License-Identifier: MIT
#include "inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "effects/assets/image/heat_map.h"
#include "effects/assets/image/png.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

rtapi::Status explain_band(const Options& options, Inspection& seen, rtapi::CommandQueue& queue,
                           rtapi::CommandList& list, const std::string& pass,
                           std::uint32_t first_row, std::uint32_t row_count) {
  const auto& chosen = *options.explain;
  if (chosen.second < first_row || chosen.second >= first_row + row_count) {
    return queue.ExecuteAndWait(list);
  }
  auto pixel =
      rtapi::ExplainPixel(queue, list, {.X = chosen.first, .Y = chosen.second - first_row});
  if (!pixel) return pixel.error();
  seen.explained.push_back({pass, first_row, std::move(*pixel)});
  return {};
}

rtapi::Status count_band(const Options& options, Inspection& seen, rtapi::CommandQueue& queue,
                         rtapi::CommandList& list, std::uint32_t first_row) {
  const auto counts = rtapi::CollectPixelStatistics(queue, list);
  if (!counts) return counts.error();
  const std::size_t width = options.frame.width;
  seen.pixel_counts.resize(width * options.frame.height);
  for (std::size_t i = 0; i < counts->Pixels.size(); ++i) {
    const rtapi::PixelStatistics& from = counts->Pixels[i];
    rtapi::PixelStatistics& to = seen.pixel_counts[first_row * width + i];
    to.TraceRayCalls += from.TraceRayCalls;
    to.AnyHitCalls += from.AnyHitCalls;
    to.Candidates += from.Candidates;
    to.MaxDepth = std::max(to.MaxDepth, from.MaxDepth);
  }
  return {};
}

rtapi::Status count_draws(Inspection& seen, rtapi::CommandQueue& queue, rtapi::CommandList& list) {
  const auto counts = rtapi::CollectOverdraw(queue, list);
  if (!counts) return counts.error();
  for (const rtapi::PixelOverdraw& pixel : counts->Pixels) seen.overdraw.push_back(pixel.Shaded);
  return {};
}

}  // namespace

void inspect(const Options& options, FrameRenderer& renderer, Inspection& seen) {
  const rtapi::Device device = renderer.device();
  if (options.explain) {
    renderer.runner().set_band_executor([&options, &seen, device](auto& queue, auto& list,
                                                                  const auto& pass, auto first_row,
                                                                  auto row_count) {
      const auto done = explain_band(options, seen, queue, list, pass, first_row, row_count);
      return done ? device.GetDeviceRemovedReason() : done;
    });
  } else if (options.heatmap == "overdraw") {
    renderer.runner().set_draw_executor(
        [&seen](auto& queue, auto& list) { return count_draws(seen, queue, list); });
  } else if (!options.heatmap.empty()) {
    renderer.runner().set_band_executor(
        [&options, &seen](auto& queue, auto& list, const auto&, auto first_row, auto) {
          return count_band(options, seen, queue, list, first_row);
        });
  }
}

rtapi::Result<PassTables> describe_tables(const FrameRenderer& renderer) {
  const auto passes = create_ray_passes(renderer.context());
  if (!passes) return passes.error();
  PassTables out;
  for (const auto& [name, pass] : *passes) {
    rtapi::TableDescriptionDesc desc;
    desc.Dispatch = pass.tables();
    desc.TopLevel = renderer.context().gpu.top_level.GetGPUVirtualAddress();
    for (std::uint32_t type = 0; type < kRayTypeCount; ++type) {
      desc.RayTypes.push_back(
          {type == kRayTypeSurface ? "surface" : "visibility", type, kRayTypeCount, type});
    }
    auto described = rtapi::DescribeShaderTables(renderer.device(), pass.pipeline(), desc);
    if (!described) return described.error();
    out.emplace_back(name, std::move(*described));
  }
  return out;
}

std::string print_tables(const PassTables& passes, bool json) {
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

std::string write_heatmap(const Options& options, const Inspection& seen, std::string& said) {
  std::vector<std::uint32_t> counts = seen.overdraw;
  counts.reserve(seen.pixel_counts.size());
  for (const rtapi::PixelStatistics& pixel : seen.pixel_counts) {
    counts.push_back(options.heatmap == "anyhit"       ? pixel.AnyHitCalls
                     : options.heatmap == "candidates" ? pixel.Candidates
                     : options.heatmap == "depth"      ? pixel.MaxDepth
                                                       : pixel.TraceRayCalls);
  }
  const auto picture = heat_map(options.frame.width, options.frame.height, counts);
  const std::string path = options.out + "/heatmap-" + options.heatmap + ".png";
  if (const auto written = write_png(path, picture.image); !written.ok()) {
    return written.error().message;
  }
  said = fmt::format("wrote {}: black is 0, white {} or more; the most is {}, the mean {:.2f}\n",
                     path, picture.white, picture.most, picture.mean);
  return {};
}

}  // namespace northlight
