// SPDX-License-Identifier: MIT
#include "precision_table.h"

#include <stdlib.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <ostream>

#include "fixtures.h"
#include "tests/numerics/exactness.h"

namespace kaamos::bench {
namespace {

using rtapi::TraversalPrecision;

constexpr char kPadding[] = "KAAMOS_VULKAN_ENABLE_WORKAROUNDS";

// A column of the table.
struct Column {
  const char* name;
  const char* backend;
  TraversalPrecision precision;
  bool pads_boxes;
};
constexpr Column kColumns[] = {
    {"fast", "embree", TraversalPrecision::kFast, false},
    {"robust", "embree", TraversalPrecision::kRobust, false},
    {"exact", "embree", TraversalPrecision::kExact, false},
    {"Vulkan", "vulkan", TraversalPrecision::kRobust, false},
    {"Vulkan, boxes padded", "vulkan", TraversalPrecision::kRobust, true},
};

// Sets the padding through the environment while a device is created.
class PaddingOf {
 public:
  explicit PaddingOf(const Column& column) {
    if (column.pads_boxes) setenv(kPadding, "B4", 1);
  }
  ~PaddingOf() { unsetenv(kPadding); }
  PaddingOf(const PaddingOf&) = delete;
  PaddingOf& operator=(const PaddingOf&) = delete;
};

std::string text(const char* format, double value) {
  char out[32];
  std::snprintf(out, sizeof(out), format, value);
  return out;
}

class Table {
 public:
  Table(const Options& options, std::ostream& out) : options_(options), out_(out) {}

  void print() {
    rays_ = options_.quick ? 600 : 300000;
    for (const Column& column : kColumns) {
      rtapi::DeviceDesc desc;
      desc.Backend = column.backend;
      desc.Threads = options_.threads;
      desc.Precision = column.precision;
      const PaddingOf padding(column);
      if (!rtapi::CreateDevice(desc)) continue;  // no Vulkan here
      columns_.push_back(&column);
      probes_.push_back(std::make_unique<test::RayProbe>(desc));
    }
    print_speeds();
    print_wrong_hits();
    print_errors();
  }

 private:
  void print_head(const std::string& first) {
    out_ << "\n| " << first << " |";
    for (const Column* column : columns_) out_ << " " << column->name << " |";
    out_ << "\n|---|";
    for (size_t i = 0; i < columns_.size(); ++i) out_ << "---|";
    out_ << "\n" << std::flush;
  }

  // Takes the medians of several runs, in turn.
  void print_speeds() {
    Fixtures fixtures(options_);
    std::vector<std::unique_ptr<DxrScene>> scenes;
    for (const Column* column : columns_) {
      const PaddingOf padding(*column);
      scenes.push_back(std::make_unique<DxrScene>(fixtures.scene(), fixtures.threads(), false,
                                                  column->backend, column->precision));
    }
    print_head("Mrays/s");
    Measure measure;
    measure.clock = options_.clock;
    measure.threads = fixtures.threads();
    for (const RaySet set : kRaySets) {
      const RayGrid& grid = fixtures.rays(set);
      std::vector<std::unique_ptr<DxrDispatch>> dispatches;
      std::vector<std::vector<double>> times(columns_.size());
      const Program program = is_visibility(set) ? Program::kVisible : Program::kClosest;
      for (const auto& scene : scenes) {
        dispatches.push_back(std::make_unique<DxrDispatch>(*scene, program, grid));
        dispatches.back()->run();
      }
      for (int run = 0; run < options_.pairs; ++run) {
        for (size_t i = 0; i < dispatches.size(); ++i) {
          times[i].push_back(seconds(measure, [&] { dispatches[i]->run(); }));
        }
      }
      out_ << "| " << name_of(set) << " |";
      for (auto& of_column : times) {
        const double mrays = 1e-6 * static_cast<double>(grid.rays.size());
        out_ << " " << text("%.2f", mrays / median(std::move(of_column))) << " |";
      }
      out_ << "\n" << std::flush;
    }
  }

  void print_wrong_hits() {
    out_
        << "\nWrong hits of " << rays_
        << " rays aimed at edges / vertices / at random; in brackets the rays that slip through.\n";
    print_head("scale, scene, camera");
    for (const test::Placement& place : test::all_placements()) {
      out_ << "| " << test::name_of(place) << " |";
      for (const auto& probe : probes_) {
        const char* separator = " ";
        uint32_t gaps = 0;
        for (const test::Aim aim : test::kAims) {
          const test::WrongHits hits = test::count_wrong_hits(*probe, place, aim, rays_);
          out_ << separator << hits.wrong;
          gaps += hits.gaps;
          separator = " / ";
        }
        if (gaps != 0) out_ << " (" << gaps << ")";
        out_ << " |" << std::flush;
      }
      out_ << "\n";
    }
  }

  void print_errors() {
    out_
        << "\nLargest error of t in ulp / of barycentrics in 2^-24; 99 of 100 are below the values "
           "in brackets.\n";
    print_head("scale, scene, camera");
    for (const test::Placement& place : test::all_placements()) {
      out_ << "| " << test::name_of(place) << " |";
      for (const auto& probe : probes_) {
        const test::HitErrors e = test::measure_hit_errors(*probe, place, rays_);
        out_ << " " << text("%.3g", e.t) << " / " << text("%.3g", e.barycentrics) << " ("
             << text("%.3g", e.t_99) << " / " << text("%.3g", e.barycentrics_99) << ") |"
             << std::flush;
      }
      out_ << "\n";
    }
  }

  const Options& options_;
  std::ostream& out_;
  uint32_t rays_ = 0;
  std::vector<const Column*> columns_;
  std::vector<std::unique_ptr<test::RayProbe>> probes_;
};

}  // namespace

int print_precision_table(const Options& options, std::ostream& out, std::ostream& errors) {
  try {
    Table(options, out).print();
    return 0;
  } catch (const std::exception& error) {
    errors << "kaamos-bench: error: the precision table: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace kaamos::bench
