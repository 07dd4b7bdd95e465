// SPDX-License-Identifier: MIT
#include "tests/verify/checks.h"

#include <rtapi/shader_compiler.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/driver/process.h"
#include "tests/conformance/forked.h"
#include "tests/conformance/run.h"
#include "tests/verify/expected.h"
#include "tests/verify/picture.h"

namespace kaamos::verify {

namespace {

using conformance::Target;

// One of each kind, each of them short: hit, miss and callable records, local arguments, opacity,
// any-hit shaders, object space, ray queries, renamed exports, a draw.
constexpr char kRules[] = "SBT-02,SBT-11,SBT-12,ROOT-01,FLG-11,TRV-22,SV-04,RQ-03,SO-05,RAS-02";

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Does the work in another process. What it throws, and how its process ends, fails it.
Finding run_apart(const std::string& what, const std::function<Finding()>& work) {
  const auto start = std::chrono::steady_clock::now();
  Finding out;
  bool arrived = false;
  const conformance::End end = conformance::fork_and_run(
      1,
      [&](size_t) -> std::string {
        Finding found;
        try {
          found = work();
        } catch (const std::exception& error) {
          found.detail = error.what();
        }
        return std::to_string(static_cast<int>(found.outcome)) + found.detail;
      },
      [&](size_t, const std::string& text) {
        arrived = true;
        out.outcome = static_cast<Outcome>(text[0] - '0');
        out.detail = text.substr(1);
      });
  if (!arrived) out.detail = conformance::describe_end(end.status);
  out.what = what;
  out.seconds = seconds_since(start);
  return out;
}

rtapi::Device make_device(const std::string& backend, std::string& messages) {
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  desc.OnMessage = [&](const rtapi::Message& message) { messages += message.Text + "\n"; };
  return rtapi::CreateDevice(desc).value();
}

// Traces the picture and compares it; `before` begins what is said about a right one.
Finding check_picture(const std::string& backend, const rtapi::ShaderLibrary& library,
                      const std::string& before) {
  std::string messages;
  const rtapi::Device device = make_device(backend, messages);
  const Comparison comparison = compare(trace_picture(device, library));
  if (!messages.empty()) return {Outcome::kFailed, "", "the device says:\n" + messages};
  if (!comparison.failure.empty()) return {Outcome::kFailed, "", comparison.failure};
  char text[128];
  std::snprintf(text, sizeof text, "%u of %u texels have their values, within %.1g",
                comparison.compared, kTexels, comparison.largest_error);
  return {Outcome::kPassed, "", before + text};
}

Finding check_rules(const std::string& what, const Target& target, const std::string& device) {
  const auto start = std::chrono::steady_clock::now();
  Finding out = {Outcome::kPassed, what};
  size_t kept = 0, known = 0;
  std::string broken;
  const auto results = conformance::run_rules(target, device, kRules, nullptr, nullptr);
  for (const conformance::RuleResult& result : results) {
    if (result.outcome == conformance::Outcome::kPassed) ++kept;
    if (result.outcome == conformance::Outcome::kKnownDeviation) ++known;
    if (result.outcome != conformance::Outcome::kFailed) continue;
    broken += std::string(result.rule->id) + " " + result.rule->title + ": " + result.detail;
  }
  if (!broken.empty() || kept == 0) out.outcome = Outcome::kFailed;
  out.detail = std::to_string(kept) + " of " + std::to_string(results.size()) + " are kept";
  if (known > 0) out.detail += ", " + std::to_string(known) + " broken by a known fault";
  if (!broken.empty()) out.detail += "\n" + broken;
  out.seconds = seconds_since(start);
  return out;
}

rtapi::ShaderCompileOptions compile_options() {
  rtapi::ShaderCompileOptions out;
  out.File = "picture.hlsl";
  out.Source = picture_source();
  out.Spirv = false;
  return out;
}

Finding check_interpreter() {
  rtapi::ShaderCompileOptions options = compile_options();
  options.Interpret = true;
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  if (!compiled.Status) return {Outcome::kFailed, "", compiled.Status.error().message};
  return check_picture("embree", compiled.Library, "");
}

// In a cache of its own, so that the compiler runs.
Finding check_native(const Settings& settings) {
  const auto compiler = hlsl::find_host_compiler();
  if (!compiler) {
    const bool wanted = settings.require_compiler || !hlsl::environment("KAAMOS_CXX").empty();
    return {wanted ? Outcome::kFailed : Outcome::kAbsent, "",
            compiler.error() +
                (wanted ? "" : "; until then shaders compiled at run time are interpreted")};
  }
  std::string cache = (std::filesystem::temp_directory_path() / "kaamos-verify-XXXXXX").string();
  if (mkdtemp(cache.data()) == nullptr) {
    return {Outcome::kFailed, "", "cannot make a folder \"" + cache + "\" for what is compiled"};
  }
  rtapi::ShaderCompileOptions options = compile_options();
  options.CacheDirectory = cache;
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  Finding out;
  if (compiled.Status) {
    out = check_picture("embree", compiled.Library, "by " + compiler->program.string() + "; ");
  } else {
    out.detail = compiled.Status.error().message;
  }
  std::error_code ignored;
  std::filesystem::remove_all(cache, ignored);
  return out;
}

// The variable that names a Vulkan driver or device; empty if none does.
std::string names_a_driver() {
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "KAAMOS_VULKAN_DEVICE"}) {
    if (!hlsl::environment(name).empty()) return name;
  }
  return "";
}

// Why the backend may not be absent; empty if it may.
std::string why_needed(const std::string& backend, const Settings& settings) {
  if (backend == "embree") return "every copy has it";
  if (settings.require_vulkan) return "it is required";
  const std::string name = names_a_driver();
  return name.empty() ? "" : "$" + name + " names a driver";
}

}  // namespace

std::vector<Finding> run_checks(const Settings& settings,
                                const std::function<void(const Finding&)>& on_finding) {
  std::vector<Finding> out;
  const auto add = [&](const Finding& finding) {
    out.push_back(finding);
    on_finding(out.back());
  };
  for (const char* backend : {"embree", "vulkan"}) {
    const std::string name = backend;
    Target target;
    target.backend = name;
    const conformance::DeviceCheck device = conformance::check_device(target);
    if (!device.error.empty()) {
      const std::string needed = why_needed(name, settings);
      add({needed.empty() ? Outcome::kAbsent : Outcome::kFailed, name + ": device",
           device.error + (needed.empty() ? "" : "\n" + needed)});
      continue;
    }
    add({Outcome::kPassed, name + ": device", device.name});
    add(run_apart(name + ": picture", [&] { return check_picture(name, built_in_library(), ""); }));
    add(check_rules(name + ": rules", target, device.name));
  }
  add(run_apart("interpreter", check_interpreter));
  add(run_apart("native code", [&] { return check_native(settings); }));
  return out;
}

}  // namespace kaamos::verify
