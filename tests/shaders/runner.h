// SPDX-License-Identifier: MIT
//
// Compiles a test file and runs its tests on one device, in this process.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/shaders/scene.h"
#include "tests/shaders/table_records.h"
#include "tests/shaders/test_file.h"

namespace kaamos::shader_tests {

// "interpreter", "embree" or "vulkan".
bool is_executor(const std::string& name);

struct SourceOptions {
  std::string path;
  std::vector<std::string> include_folders;
  std::vector<rtapi::ShaderDefine> defines;
  std::string target = "lib_6_6";
};

// A test file as it was read.
struct Source {
  SourceOptions options;
  std::string text;
  TestFile tests;
  SceneDescription scene;
  TableRecords records;
  std::vector<std::string> dependencies;  // files to watch
  std::string error;
};
Source read_source(const SourceOptions& options);

// What a test says while it runs.
struct Report {
  enum class Kind { kOutput, kFailure, kSkipped };
  Kind kind = Kind::kOutput;
  std::string text;
};
using Tell = std::function<void(const Report&)>;

class Runner {
 public:
  Runner(const Source& source, std::string executor);
  // Returns what is wrong: diagnostics of the compiler, or a device that cannot be made.
  std::string prepare();
  bool has_no_device() const { return has_no_device_; }  // is why
  void run(const TestRun& test, const Tell& tell);

 private:
  std::string make_device();
  void dispatch(const TestRun& test, rtapi::CommandList& list);
  void dispatch_rays(const TestRun& test, rtapi::CommandList& list);
  void draw(const TestRun& test, rtapi::CommandList& list);
  // Gives every resource of the file to the root arguments of dispatches, or of draws.
  void bind(rtapi::CommandList& list, bool of_draws = false);
  rtapi::GpuVirtualAddress resource(const rtapi::ShaderBindingInfo& binding);
  const rtapi::StateObject& rays_pipeline();
  void hear(const rtapi::Message& message);

  const Source& source_;
  const std::string executor_;
  rtapi::ShaderCompilation compiled_;
  std::vector<rtapi::ShaderBindingInfo> bindings_;  // of the global root signature, in its order
  std::string root_signature_text_;
  bool has_no_device_ = false;

  // These live as long as the device, which a fault ends.
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_signature_;
  rtapi::StateObject rays_pipeline_;
  std::optional<Scene> scenes_[3];      // TestScene, and what shaders are called on alone
  std::vector<rtapi::Buffer> buffers_;  // of the running test

  const Tell* tell_ = nullptr;
  std::string values_;  // what the next failure compared
};

}  // namespace kaamos::shader_tests
