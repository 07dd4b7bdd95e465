// SPDX-License-Identifier: MIT
//
// The list of cases, and the program around it: arguments, progress, output.
#pragma once

#include <rtapi/device.h>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "measure.h"

namespace kaamos::bench {

struct Options {
  bool summary = false;
  bool list = false;
  bool help = false;
  bool version = false;
  std::string only;  // prefix of the names; empty: all cases
  int pairs = 9;
  Clock clock = Clock::kWall;
  uint32_t threads = 0;  // 0: as many as the machine has
  uint32_t width = 640;  // rays of a dispatch
  uint32_t height = 360;
  rtapi::TraversalPrecision precision = rtapi::TraversalPrecision::kRobust;  // of Embree
  bool precision_table = false;  // print precision_table.h's table instead of running the cases
  bool raster_table = false;     // print raster_table.h's instead
  bool quick = false;            // small inputs: shows that everything works, measures nothing
};

// One line of the output. `ours` and `baseline` are in `unit`; `value` is the result: a ratio for
// most cases, for others the figure itself (then it equals `ours`).
struct Line {
  std::string name;
  double value = 0;
  double ours = 0;
  double baseline = 0;
  std::string unit;
  bool higher_is_better = true;
};

// name, value, ours, baseline, unit, higher or lower, separated by tabs; without a newline.
std::string format_line(const Line& line);

// The objects that the cases share and only some of them need; made on first use.
class Fixtures;

bool has_vulkan();  // vulkan_cases.cpp: whether there is a Vulkan device

struct Case {
  std::string name;
  // Throws std::runtime_error with a readable message.
  std::function<Line(Fixtures&, const Measure&)> run;
};

std::vector<Case> dispatch_cases();   // dispatch_cases.cpp
std::vector<Case> build_cases();      // build_cases.cpp
std::vector<Case> hlsl_cases();       // hlsl_cases.cpp
std::vector<Case> compute_cases();    // compute_cases.cpp
std::vector<Case> vector_cases();     // vector_cases.cpp
std::vector<Case> sorting_cases();    // sorting_cases.cpp
std::vector<Case> claims_cases();     // claims_cases.cpp
std::vector<Case> light_cases();      // light_cases.cpp
std::vector<Case> structure_cases();  // structure_cases.cpp
std::vector<Case> micromap_cases();   // micromap_cases.cpp
std::vector<Case> partition_cases();  // partition_cases.cpp
std::vector<Case> cluster_cases();    // cluster_cases.cpp
std::vector<Case> frame_cases();      // frame_cases.cpp
std::vector<Case> reference_cases();  // reference_cases.cpp
std::vector<Case> facade_cases();     // facade_cases.cpp; empty without the D3D12 facade
std::vector<Case> vulkan_cases();     // vulkan_cases.cpp; empty where there is no Vulkan device
std::vector<Case> raster_cases();     // raster_cases.cpp; last: they change how the heap grows

// Sets `options`. Returns which argument is wrong and what is allowed; "" if none is. `arguments`
// excludes the program.
std::string parse_arguments(const std::vector<std::string>& arguments, Options& options);

// Runs the whole program; returns its exit status: 0, 1 if a case failed, 2 for wrong arguments.
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& errors,
                bool errors_are_terminal);

}  // namespace kaamos::bench
