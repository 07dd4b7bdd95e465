// SPDX-License-Identifier: MIT
#include "tests/parity/hits.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace kaamos::parity {
namespace {

bool same_triangle(const HitRecord& a, const HitRecord& b) {
  return a.hit == b.hit && a.instance_index == b.instance_index && a.geometry == b.geometry &&
         a.primitive == b.primitive;
}

// Infinite if either of them is NaN.
double apart(double a, double b) {
  const double difference = std::fabs(a - b);
  return a == b ? 0 : std::isnan(difference) ? INFINITY : difference;
}

double relative(double a, double b) {
  return a == b ? 0 : apart(a, b) / std::max(std::fabs(a), std::fabs(b));
}

std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string line(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

class Comparison {
 public:
  Comparison(const std::vector<HitRecord>& a, const std::vector<HitRecord>& b, uint32_t width,
             const HitLimits& limits)
      : a_(a), b_(b), width_(width), limits_(limits) {}

  HitDifference run() {
    out_.rays = a_.size();
    for (uint64_t i = 0; i < a_.size(); ++i) {
      out_.hits += a_[i].hit;
      compare(i);
    }
    return out_;
  }

 private:
  void compare(uint64_t i) {
    const HitRecord& a = a_[i];
    const HitRecord& b = b_[i];
    if (!same_triangle(a, b)) {
      compare_different(i, a, b);
    } else if (a.instance_id != b.instance_id || a.kind != b.kind || a.record != b.record ||
               a.flags != b.flags) {
      note(i, HitChange::kInteger, 1, a, b);
    } else if (a.hit != 0) {
      compare_numbers(i, a, b);
    } else {
      ++out_.counts[0];
    }
  }

  void compare_different(uint64_t i, const HitRecord& a, const HitRecord& b) {
    const bool both = a.hit != 0 && b.hit != 0;
    const double distance = both ? relative(a.t, b.t) : 1;
    const bool grazing = std::min(a.cosine, b.cosine) < limits_.grazing_cosine;
    const double size = std::max(double{a.t}, double{b.t});
    const double rounding = limits_.per_coordinate * double{std::max(a.coordinate, b.coordinate)};
    const bool tied = both && apart(a.t, b.t) <= (grazing ? 1e-2 : limits_.t_relative) * size +
                                                     (grazing ? 100 : 1) * rounding;
    const bool silhouette = tied || is_next_to(i, b, a_);
    note(i, silhouette ? HitChange::kSilhouette : HitChange::kVisibility, distance, a, b);
  }

  // Tells whether `hit` is what a neighbour of pixel `i` shows in `picture`.
  bool is_next_to(uint64_t i, const HitRecord& hit, const std::vector<HitRecord>& picture) const {
    if (width_ == 0) return false;
    const int64_t x = static_cast<int64_t>(i % width_);
    const int64_t y = static_cast<int64_t>(i / width_);
    const int64_t height = static_cast<int64_t>(picture.size() / width_);
    for (int64_t ny = std::max<int64_t>(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny) {
      for (int64_t nx = std::max<int64_t>(x - 1, 0); nx <= std::min<int64_t>(x + 1, width_ - 1);
           ++nx) {
        if (nx == x && ny == y) continue;
        if (same_triangle(picture[static_cast<size_t>(ny * width_ + nx)], hit)) return true;
      }
    }
    return false;
  }

  void compare_numbers(uint64_t i, const HitRecord& a, const HitRecord& b) {
    if (a.cosine < limits_.grazing_cosine) {
      ++out_.counts[0];
      return;
    }
    // An error across the triangle is that much larger along the ray and in the plane.
    const double cosine = std::max(double{a.cosine}, 1e-3);
    const double rounding = limits_.per_coordinate * double{a.coordinate} / cosine;
    const double along = apart(a.t, b.t);
    const double allowed = limits_.t_relative * std::fabs(double{a.t}) + rounding;
    const double error = along / std::max(allowed, 1e-30);
    out_.worst_t = std::max(out_.worst_t, error);
    const double in_plane = limits_.t_relative * std::fabs(double{a.t}) / cosine + rounding;
    if (!(error <= 1)) {
      note(i, HitChange::kNumber, error, a, b);
      return;
    }
    // Compares barycentrics by the points that they name: in a thin triangle a tiny distance
    // changes them a lot.
    double place = 0;
    for (int k = 0; k < 3; ++k) {
      place = std::max(place, apart(a.surface_point[k], b.surface_point[k]) / in_plane);
    }
    // Objects of mixed sizes: an instance much larger than its mesh divides the error of t by its
    // scale.
    for (int k = 0; k < 3; ++k) {
      const double size = std::max(1.0, std::fabs(double{a.object_point[k]}));
      place = std::max(place, apart(a.object_point[k], b.object_point[k]) /
                                  (limits_.t_relative * size + 4 * along));
    }
    for (int k = 0; k < 2; ++k) {
      if (!std::isfinite(b.barycentrics[k])) {
        note(i, HitChange::kNumber, INFINITY, a, b);
        return;
      }
    }
    if (place <= 1) {
      ++out_.counts[0];
    } else {
      note(i, HitChange::kPlace, place, a, b);
    }
  }

  void note(uint64_t i, HitChange change, double size, const HitRecord& a, const HitRecord& b) {
    ++out_.counts[static_cast<int>(change)];
    // Ranks from harmless to bad, in the order of HitChange.
    static constexpr int kRanks[] = {0, 1, 3, 5, 2, 4};
    const auto rank = [](HitChange c) { return kRanks[static_cast<int>(c)]; };
    if (rank(change) < rank(out_.worst_change)) return;
    if (change == out_.worst_change && size <= worst_size_) return;
    out_.worst_change = change;
    out_.worst_ray = i;
    out_.worst_text = describe(a) + "\n  against " + describe(b);
    worst_size_ = size;
  }

  const std::vector<HitRecord>& a_;
  const std::vector<HitRecord>& b_;
  uint32_t width_;
  HitLimits limits_;
  HitDifference out_;
  double worst_size_ = 0;
};

}  // namespace

HitDifference compare_hits(const std::vector<HitRecord>& a, const std::vector<HitRecord>& b,
                           uint32_t width, const HitLimits& limits) {
  if (a.size() != b.size()) std::abort();  // a mistake in the test
  return Comparison(a, b, width, limits).run();
}

std::string judge(const HitDifference& difference, const HitLimits& limits) {
  std::string text;
  const auto rays = static_cast<double>(difference.rays);
  const auto complain = [&](HitChange change, double allowed, const char* what) {
    const auto count = static_cast<double>(difference.count(change));
    // A single ray of a small set is not a meaningful share.
    if (count <= std::max(allowed * rays, allowed > 0 ? 1.0 : 0.0)) return;
    text += line("%s in %.0f of %.0f rays, allowed %g; ", what, count, rays, allowed * rays);
  };
  complain(HitChange::kVisibility, limits.visibility, "visibility differs");
  complain(HitChange::kSilhouette, limits.silhouettes, "silhouettes differ");
  complain(HitChange::kPlace, limits.places, "barycentrics differ");
  complain(HitChange::kInteger, 0, "integers differ");
  complain(HitChange::kNumber, 0, "numbers differ");
  return text;
}

std::string describe(const HitRecord& hit) {
  if (hit.hit == 0) return line("miss (flags 0x%x)", hit.flags);
  return line(
      "instance %u (id %u) geometry %u primitive %u kind 0x%x record %u flags 0x%x t %.9g "
      "barycentrics %.7g %.7g cosine %.4g object point %.7g %.7g %.7g",
      hit.instance_index, hit.instance_id, hit.geometry, hit.primitive, hit.kind, hit.record,
      hit.flags, double{hit.t}, double{hit.barycentrics[0]}, double{hit.barycentrics[1]},
      double{hit.cosine}, double{hit.object_point[0]}, double{hit.object_point[1]},
      double{hit.object_point[2]});
}

std::string describe(const HitDifference& d) {
  return line(
      "%llu rays, %llu hits: visibility %llu, silhouettes %llu, integers %llu, numbers "
      "%llu, barycentrics %llu; worst t %.2g of what is allowed",
      static_cast<unsigned long long>(d.rays), static_cast<unsigned long long>(d.hits),
      static_cast<unsigned long long>(d.count(HitChange::kVisibility)),
      static_cast<unsigned long long>(d.count(HitChange::kSilhouette)),
      static_cast<unsigned long long>(d.count(HitChange::kInteger)),
      static_cast<unsigned long long>(d.count(HitChange::kNumber)),
      static_cast<unsigned long long>(d.count(HitChange::kPlace)), d.worst_t);
}

}  // namespace kaamos::parity
