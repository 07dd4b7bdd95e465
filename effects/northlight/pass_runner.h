// SPDX-License-Identifier: MIT
/// @file
/// Executes the passes of a frame: in portions that are short enough to be watched and stopped, and
/// with what each of them took.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/engine/frame.h"
#include "effects/engine/outcome.h"
#include "effects/engine/profile.h"

namespace kaamos::effects {

/// Takes what is being done and its done part, from 0 to 1; returning false stops the work at the
/// next step. Empty: nobody watches.
using Progress = std::function<bool(const std::string& what, double done)>;

/// The time, rays and memory of one pass of a frame.
struct PassStatistics {
  std::string name;                  ///< "ambient occlusion"
  double ms = 0;                     ///< from recording to the end of execution
  rtapi::RaytracingStatistics rays;  ///< those of the pass
  std::uint64_t bytes = 0;           ///< of the pictures and buffers that it writes or alone reads
  bool is_gradient = false;          ///< A-SVGF's: only that denoiser needs it
};

/// Executes a band of rows of a pass; replaces CommandQueue::ExecuteAndWait, to look at it.
using BandExecutor = std::function<rtapi::Status(rtapi::CommandQueue& queue,
                                                 rtapi::CommandList& list, const std::string& pass,
                                                 std::uint32_t first_row, std::uint32_t row_count)>;

/// Executes the draws of a G-buffer; replaces CommandQueue::ExecuteAndWait, to look at them.
using DrawExecutor =
    std::function<rtapi::Status(rtapi::CommandQueue& queue, rtapi::CommandList& list)>;

/// Work that takes samples of the pixels of a picture, which is cut into dispatches.
struct SampledWork {
  std::string title;               ///< for Progress and executors
  std::uint32_t first_sample = 0;  ///< of each pixel's sequence
  std::uint32_t samples = 1;       ///< of each pixel
  /// A dispatch takes at most so many of them.
  std::uint32_t most_samples = 64;
  /// Dispatches begin with one sample and take more where they are short.
  bool grows = false;
  /// Rows that can be recorded in bands; none: the picture is recorded as a whole.
  std::optional<std::uint32_t> rows = {};
  /// Rows of a band; 0: as many as fit.
  std::uint32_t rows_per_band = 0;
  /// Called before the bands of some samples, to put their rays in order; may change what they are
  /// recorded with. May be null.
  std::function<rtapi::Status(PassConstants& constants)> order = {};
  /// Records a band of `row_count` rows from constants.first_row on, or the whole picture.
  std::function<void(rtapi::CommandList& list, const PassConstants& constants,
                     std::uint32_t row_count)>
      record;
  /// Called when each pixel has so many samples. May be null.
  std::function<void(std::uint32_t samples)> done = {};
};

/// Executes passes on a queue of its own. Not for several threads at once.
class PassRunner {
 public:
  /// Makes the queue.
  /// @errors those of rtapi::Device::CreateCommandQueue.
  static rtapi::Result<PassRunner> create(const rtapi::Device& device);

  /// Executes the bands of rows of every pass by this, to look at them.
  void set_band_executor(BandExecutor executor) { execute_band_ = std::move(executor); }
  /// Executes the draws of frames that are rendered by this, to look at them.
  void set_draw_executor(DrawExecutor executor) { execute_draws_ = std::move(executor); }
  /// Enters every pass of the frame as a step; null: nobody asks.
  void set_profile(Profile* profile) { profile_ = profile; }
  /// Milliseconds of the clock that times passes and runs; by default the time that passes.
  void set_clock(std::function<double()> milliseconds) { clock_ms_ = std::move(milliseconds); }
  /// The time that this clock shows.
  double now_ms() const { return clock_ms_(); }
  /// The queue on which everything is executed.
  rtapi::CommandQueue& queue() { return queue_; }

  /// Executes what `record` records; milliseconds. It is no pass of the frame.
  /// @errors those of the device.
  rtapi::Result<double> execute(const std::function<void(rtapi::CommandList&)>& record);
  /// Executes a pass of the frame. `bytes`: PassStatistics::bytes.
  /// @errors those of the device.
  rtapi::Status run(const std::string& name, std::uint64_t bytes,
                    const std::function<void(rtapi::CommandList&)>& record);
  /// The same with PassStatistics::is_gradient.
  /// @errors those of the device.
  rtapi::Status run_gradient(const std::string& name, std::uint64_t bytes,
                             const std::function<void(rtapi::CommandList&)>& record);
  /// The same for draws of the G-buffer.
  /// @errors those of the device.
  rtapi::Status run_draws(const std::string& name, std::uint64_t bytes,
                          const std::function<void(rtapi::CommandList&)>& record);
  /// Executes work in its portions; it becomes no pass of the frame. `order_ms`, if not null, gets
  /// what SampledWork::order took.
  /// @errors those of the device and of SampledWork::order.
  rtapi::Result<Outcome> run_samples(const SampledWork& work, const Progress& progress,
                                     double* order_ms = nullptr);
  /// The same as a pass of the frame, behind one of its order, where it has one.
  /// @errors as above.
  rtapi::Result<Outcome> run_pass(const SampledWork& work, std::uint64_t bytes,
                                  const Progress& progress);

  /// The passes of the last frame, in order.
  const std::vector<PassStatistics>& passes() const { return passes_; }
  /// Adds one that was timed elsewhere.
  void add(PassStatistics pass) { passes_.push_back(std::move(pass)); }
  /// Another frame begins.
  void clear() { passes_.clear(); }

 private:
  rtapi::Status run_by(const std::function<rtapi::Status(rtapi::CommandList&)>& executor,
                       const std::string& name, std::uint64_t bytes,
                       const std::function<void(rtapi::CommandList&)>& record);

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  BandExecutor execute_band_;
  DrawExecutor execute_draws_;
  std::function<double()> clock_ms_;
  Profile* profile_ = nullptr;
  std::vector<PassStatistics> passes_;
};

}  // namespace kaamos::effects
