// SPDX-License-Identifier: MIT
#include "suite.h"

#include <rtapi/version.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <iomanip>
#include <iterator>
#include <ostream>
#include <thread>

#include "fixtures.h"
#include "precision_table.h"
#include "raster_table.h"

namespace kaamos::bench {
namespace {

constexpr char kUsage[] =
    R"(Usage: kaamos-bench [--summary] [--only PREFIX] [--list] [options]

Measures Kaamos against hand-written baselines in the same process, in turn.

  --summary        lines of name, value, ours, baseline, unit, higher|lower between tabs
                   (without it: the same as a table)
  --only PREFIX    only the cases whose names begin with PREFIX, for example dispatch/embree/
  --list           the names of the cases
  --pairs N        pairs of runs per case, 1 to 999 (default 9); the median counts
  --size WxH       rays of a dispatch, 1x1 to 4096x4096 (default 640x360)
  --threads N      1 to 256 (default: all of the machine)
  --precision P    of the Embree backend in dispatch/embree/: fast, robust (default) or exact
  --precision-table
                   instead of the cases: speeds, wrong hits and errors of every precision
  --raster-table   instead of the cases: draws by number of triangles, pixels and threads
  --clock wall|cpu cpu: CPU time over threads, for a machine that is busy (default wall)
  --quick          small inputs and one pair: shows that it works, measures nothing
  --help           this text
  --version        which Kaamos this is
)";

bool parse_number(const std::string& text, uint32_t low, uint32_t high, uint32_t& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && value >= low && value <= high;
}

bool parse_size(const std::string& text, uint32_t& width, uint32_t& height) {
  const size_t x = text.find('x');
  return x != std::string::npos && parse_number(text.substr(0, x), 1, 4096, width) &&
         parse_number(text.substr(x + 1), 1, 4096, height);
}

// Reads the value of the option; false if it is missing or wrong.
bool parse_value(const std::string& option, const std::string& value, Options& options,
                 std::string& allowed) {
  uint32_t number = 0;
  if (option == "--only") {
    options.only = value;
    return true;
  }
  if (option == "--pairs") {
    allowed = "1 to 999";
    if (!parse_number(value, 1, 999, number)) return false;
    options.pairs = static_cast<int>(number);
    return true;
  }
  if (option == "--threads") {
    allowed = "1 to 256";
    return parse_number(value, 1, 256, options.threads);
  }
  if (option == "--size") {
    allowed = "WxH, each 1 to 4096, for example 640x360";
    return parse_size(value, options.width, options.height);
  }
  if (option == "--precision") {
    allowed = "fast, robust or exact";
    const char* names[] = {"fast", "robust", "exact"};
    const auto* at = std::find(std::begin(names), std::end(names), value);
    options.precision = static_cast<rtapi::TraversalPrecision>(at - names);
    return at != std::end(names);
  }
  allowed = "wall or cpu";
  options.clock = value == "cpu" ? Clock::kCpu : Clock::kWall;
  return value == "cpu" || value == "wall";
}

std::string format_value(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

void print_row(std::ostream& out, const Line& line) {
  out << std::left << std::setw(30) << line.name << std::right << std::setw(12)
      << format_value(line.value) << std::setw(12) << format_value(line.ours) << std::setw(12)
      << format_value(line.baseline) << "  " << line.unit << ", "
      << (line.higher_is_better ? "higher" : "lower") << " is better\n";
}

class Runner {
 public:
  Runner(const Options& options, std::ostream& out, std::ostream& errors, bool terminal)
      : options_(options), out_(out), errors_(errors), terminal_(terminal), fixtures_(options) {}

  int run(const std::vector<Case>& cases) {
    int status = 0;
    if (!options_.summary) {
      out_ << std::left << std::setw(30) << "name" << std::right << std::setw(12) << "value"
           << std::setw(12) << "ours" << std::setw(12) << "baseline"
           << "\n";
    }
    for (size_t i = 0; i < cases.size(); ++i) {
      if (!run_case(cases[i], i, cases.size())) status = 1;
    }
    return status;
  }

 private:
  bool run_case(const Case& one, size_t index, size_t count) {
    Measure measure;
    measure.pairs = options_.pairs;
    measure.clock = options_.clock;
    measure.threads = fixtures_.threads();
    const std::string place = "[" + std::to_string(index + 1) + "/" + std::to_string(count) + "] ";
    if (terminal_) {
      errors_ << "\r\x1b[K" << place << one.name << std::flush;
      measure.progress = [&](int done, int of) {
        errors_ << "\r\x1b[K" << place << one.name << " " << done << "/" << of << std::flush;
      };
    }
    try {
      const Line line = one.run(fixtures_, measure);
      if (terminal_) errors_ << "\r\x1b[K" << std::flush;
      if (options_.summary) {
        out_ << format_line(line) << "\n" << std::flush;
      } else {
        print_row(out_, line);
        out_ << std::flush;
      }
      return true;
    } catch (const std::exception& error) {
      if (terminal_) errors_ << "\r\x1b[K";
      errors_ << "kaamos-bench: error: " << one.name << ": " << error.what() << "\n";
      return false;
    }
  }

  const Options& options_;
  std::ostream& out_;
  std::ostream& errors_;
  bool terminal_;
  Fixtures fixtures_;
};

}  // namespace

std::string format_line(const Line& line) {
  return line.name + "\t" + format_value(line.value) + "\t" + format_value(line.ours) + "\t" +
         format_value(line.baseline) + "\t" + line.unit + "\t" +
         (line.higher_is_better ? "higher" : "lower");
}

std::string parse_arguments(const std::vector<std::string>& arguments, Options& options) {
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--summary") {
      options.summary = true;
    } else if (argument == "--list") {
      options.list = true;
    } else if (argument == "--help" || argument == "-h") {
      options.help = true;
    } else if (argument == "--version") {
      options.version = true;
    } else if (argument == "--precision-table") {
      options.precision_table = true;
    } else if (argument == "--raster-table") {
      options.raster_table = true;
    } else if (argument == "--quick") {
      options.quick = true;
      options.pairs = 1;
      options.width = 64;
      options.height = 36;
    } else if (argument == "--only" || argument == "--pairs" || argument == "--threads" ||
               argument == "--size" || argument == "--clock" || argument == "--precision") {
      if (i + 1 == arguments.size()) {
        return argument + " needs a value";
      }
      std::string allowed;
      if (!parse_value(argument, arguments[++i], options, allowed)) {
        return argument + " is \"" + arguments[i] + "\", allowed is " + allowed;
      }
    } else {
      return "unknown argument \"" + argument + "\"";
    }
  }
  return {};
}

int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& errors,
                bool errors_are_terminal) {
  Options options;
  if (const std::string error = parse_arguments(arguments, options); !error.empty()) {
    errors << "kaamos-bench: error: " << error << ". kaamos-bench --help lists the arguments.\n";
    return 2;
  }
  if (options.help) {
    out << kUsage;
    return 0;
  }
  if (options.version) {
    out << "kaamos-bench " << rtapi::GetVersion() << "\n";
    return 0;
  }
  if (options.threads == 0) options.threads = std::max(1u, std::thread::hardware_concurrency());
  if (options.precision_table) return print_precision_table(options, out, errors);
  if (options.raster_table) return print_raster_table(options, out, errors);
  std::vector<Case> cases;
  for (auto part :
       {dispatch_cases, build_cases, hlsl_cases, compute_cases, vector_cases, frame_cases,
        reference_cases, sorting_cases, light_cases, structure_cases, micromap_cases,
        partition_cases, cluster_cases, facade_cases, claims_cases, vulkan_cases, raster_cases}) {
    for (Case& one : part()) {
      if (one.name.starts_with(options.only)) cases.push_back(std::move(one));
    }
  }
  if (cases.empty()) {
    errors << "kaamos-bench: error: no case begins with \"" << options.only
           << "\". kaamos-bench --list names them.\n";
    return 2;
  }
  if (options.list) {
    for (const Case& one : cases) out << one.name << "\n";
    return 0;
  }
  Runner runner(options, out, errors, errors_are_terminal);
  return runner.run(cases);
}

}  // namespace kaamos::bench
