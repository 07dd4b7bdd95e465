// SPDX-License-Identifier: MIT
/// @file
/// Where the time of a run goes, step by step: loading, building, each pass, files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::effects {

/// Processor time that all threads of this process have taken so far, in milliseconds.
double process_clock_ms();

/// What a step is for.
enum class ProfilePart : std::uint8_t {
  kStart,  ///< before the first frame: loading, building, pipelines, baking
  kFrame,  ///< passes
  kFiles,  ///< reading back, encoding, writing
  kRest,   ///< all that no step covers
};

/// One line of a profile: all steps of the same part and name.
struct ProfileStep {
  ProfilePart part = ProfilePart::kRest;  ///< what it is for
  std::string name;                       ///< "scene", "G-buffer", ...
  std::uint32_t count = 0;                ///< how often it was entered
  double wall_ms = 0;                     ///< time that passed
  double cpu_ms = 0;                      ///< processor time of all threads
};

/// Adds up the time of steps. A step within another one interrupts it, so that every moment belongs
/// to one step, and all steps together take as long as the run. For one thread.
class Profile {
 public:
  /// Ends its step when it goes.
  class [[nodiscard]] Scope {
   public:
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    friend class Profile;
    explicit Scope(Profile* profile) : profile_(profile) {}
    Profile* profile_;
  };

  /// The run begins. Processor time that the process has taken before counts as the rest's.
  Profile();
  Profile(const Profile&) = delete;
  Profile& operator=(const Profile&) = delete;

  /// Enters a step until the scope ends, within the one that runs. A null profile measures nothing.
  static Scope enter(Profile* profile, ProfilePart part, const std::string& name);
  /// What has been entered so far, in the order of the first times, behind the rest.
  std::vector<ProfileStep> steps();

 private:
  // Gives the time since the last call to the step that runs.
  void settle();

  std::vector<ProfileStep> steps_;
  std::vector<std::size_t> running_;  // in steps_, from the outermost on
  double wall_ms_ = 0, cpu_ms_ = 0;   // when the last call settled
};

}  // namespace kaamos::effects
