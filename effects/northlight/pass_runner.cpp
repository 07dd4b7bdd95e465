// SPDX-License-Identifier: MIT
#include "effects/northlight/pass_runner.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace kaamos::effects {

namespace {

// A dispatch should not take longer: whoever watches sees four steps a second, and a frame that is
// stopped ends as soon.
constexpr double kDispatchMs = 250;
constexpr std::uint32_t kFirstRows = 32;

// The amount of something that is dispatched at once.
class Portion {
 public:
  // `most` at most. What is fixed stays at its size.
  Portion(std::uint32_t size, std::uint32_t most, bool is_fixed)
      : size_(std::min(size, most)), most_(most), is_fixed_(is_fixed) {}
  std::uint32_t of(std::uint32_t left) const { return std::min(size_, left); }
  // The last portion took so long: the next one is to take kDispatchMs.
  void took(double ms) {
    if (is_fixed_) return;
    const double fit = size_ * std::clamp(kDispatchMs / std::max(ms, 0.1), 0.5, 2.0);
    size_ = static_cast<std::uint32_t>(std::clamp(fit, 1.0, static_cast<double>(most_)));
  }

 private:
  std::uint32_t size_, most_;
  bool is_fixed_;
};

}  // namespace

rtapi::Result<PassRunner> PassRunner::create(const rtapi::Device& device) {
  PassRunner out;
  out.device_ = device;
  const auto queue = device.CreateCommandQueue();
  if (!queue) return queue.error();
  out.queue_ = *queue;
  out.clock_ms_ = [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
  };
  return out;
}

rtapi::Result<double> PassRunner::execute(const std::function<void(rtapi::CommandList&)>& record) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  record(*list);
  const double start = now_ms();
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done.error();
  return now_ms() - start;
}

rtapi::Status PassRunner::run_by(const std::function<rtapi::Status(rtapi::CommandList&)>& executor,
                                 const std::string& name, std::uint64_t bytes,
                                 const std::function<void(rtapi::CommandList&)>& record) {
  const auto step = Profile::enter(profile_, ProfilePart::kFrame, name);
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  device_.ResetStatistics();
  const double start = now_ms();
  record(*list);
  if (const auto done = executor(*list); !done) return done;
  add({name, now_ms() - start, device_.GetStatistics(), bytes});
  return {};
}

rtapi::Status PassRunner::run(const std::string& name, std::uint64_t bytes,
                              const std::function<void(rtapi::CommandList&)>& record) {
  const auto execute = [this](rtapi::CommandList& list) { return queue_.ExecuteAndWait(list); };
  return run_by(execute, name, bytes, record);
}

rtapi::Status PassRunner::run_gradient(const std::string& name, std::uint64_t bytes,
                                       const std::function<void(rtapi::CommandList&)>& record) {
  if (const auto s = run(name, bytes, record); !s) return s;
  passes_.back().is_gradient = true;
  return {};
}

rtapi::Status PassRunner::run_draws(const std::string& name, std::uint64_t bytes,
                                    const std::function<void(rtapi::CommandList&)>& record) {
  const auto execute = [this](rtapi::CommandList& list) {
    return execute_draws_ ? execute_draws_(queue_, list) : queue_.ExecuteAndWait(list);
  };
  return run_by(execute, name, bytes, record);
}

rtapi::Result<Outcome> PassRunner::run_pass(const SampledWork& work, std::uint64_t bytes,
                                            const Progress& progress) {
  const auto step = Profile::enter(profile_, ProfilePart::kFrame, work.title);
  device_.ResetStatistics();
  double order_ms = 0;
  const double start = now_ms();
  const auto done = run_samples(work, progress, &order_ms);
  if (!is_done(done)) return done;
  const double ms = now_ms() - start;
  if (work.order) add({work.title + " order", order_ms, {}});
  add({work.title, ms - order_ms, device_.GetStatistics(), bytes});
  return done;
}

rtapi::Result<Outcome> PassRunner::run_samples(const SampledWork& work, const Progress& progress,
                                               double* order_ms) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  const std::uint32_t rows = work.rows.value_or(1);
  Portion samples(work.grows ? 1 : work.most_samples, work.most_samples, !work.grows);
  Portion band(work.rows_per_band > 0 ? work.rows_per_band : kFirstRows, rows,
               work.rows_per_band > 0);
  for (std::uint32_t sample = 0; sample < work.samples;) {
    PassConstants constants;
    constants.first_sample = work.first_sample + sample;
    constants.sample_count = samples.of(work.samples - sample);
    constants.accumulate = sample > 0 ? 1 : 0;
    if (work.order) {
      const double start = now_ms();
      if (const auto s = work.order(constants); !s) return s.error();
      if (order_ms != nullptr) *order_ms += now_ms() - start;
    }
    for (std::uint32_t row = 0; row < rows;) {
      const std::uint32_t count = band.of(rows - row);
      constants.first_row = row;
      if (const auto reset = list->Reset(); !reset) return reset.error();
      work.record(*list, constants, count);
      const double start = now_ms();
      const auto executed = execute_band_ && work.rows
                                ? execute_band_(queue_, *list, work.title, row, count)
                                : queue_.ExecuteAndWait(*list);
      if (!executed) return executed.error();
      const double ms = now_ms() - start;
      row += count;
      band.took(ms);
      if (row == rows) {
        samples.took(ms);
        if (work.done) work.done(sample + constants.sample_count);
      }
      const double done_rows = static_cast<double>(row) / rows;
      const double part = (sample + constants.sample_count * done_rows) / work.samples;
      if (progress && !progress(work.title, part)) return Outcome::kStopped;
    }
    sample += constants.sample_count;
  }
  return Outcome::kDone;
}

}  // namespace kaamos::effects
