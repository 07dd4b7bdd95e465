// SPDX-License-Identifier: MIT
//
// The context that a rule's test works with: a device, checks, and shortcuts for making scenes.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/upload.h>

#include <concepts>
#include <cstring>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace kaamos::conformance {

struct Target {
  std::string backend = "embree";
  rtapi::TraversalPrecision precision = rtapi::TraversalPrecision::kRobust;
  bool checked = false;  // checked mode
  rtapi::RaytracingTier tier = rtapi::kHighestRaytracingTier;
  std::string name() const;  // "embree/robust", "vulkan"; checked targets have the same names
  rtapi::DeviceDesc device_desc() const;
};

// One geometry: triangles with nine floats each, or boxes.
struct Geometry {
  std::vector<float> vertices = {};
  std::vector<rtapi::RaytracingAabb> boxes = {};
  rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kOpaque;
  std::vector<float> transform = {};  // Transform3x4; empty: none
};
// A triangle around (x, 0), within 1 of it, that rays along z hit at t = z from the front.
Geometry triangle(float z, float x = 0,
                  rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kOpaque);
// A box with edges of length 2 around (x, 0, z).
Geometry box(float z, float x = 0,
             rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kOpaque);

// A device and the pipelines that tests share; making either takes a driver longer than most tests
// run.
struct SharedDevice {
  struct Pipeline {
    rtapi::StateObject object;
    rtapi::RootSignature global;
  };
  rtapi::Device device;
  std::map<std::string, Pipeline> pipelines = {};  // by Program's name for them
  // Messages of the device. Not connected where a test passes a description of its own.
  std::shared_ptr<std::vector<rtapi::Message>> messages = {};
};

class Context {
 public:
  // Errors here and below are thrown as rtapi::ResultError and fail the rule. The device belongs to
  // this context alone while it lives; a later context reuses it unless it was removed.
  explicit Context(const Target& target);
  // On a new device with further options; `desc` names the target's backend.
  Context(const rtapi::DeviceDesc& desc, const Target& target);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const Target& target() const { return target_; }
  const rtapi::Device& device() const { return device_; }
  rtapi::CommandQueue& queue() { return queue_; }
  std::map<std::string, SharedDevice::Pipeline>& pipelines() { return shared_->pipelines; }

  // From now on Standard traces by HitObject::TraceRay and Invoke.
  void trace_through_hit_objects(bool on) { hit_objects_ = on; }
  bool traces_through_hit_objects() const { return hit_objects_; }

  // Checks: a failed one fails the rule and reports what was found and expected.
  template <class T>
  void equal(const std::string& what, const T& found, const std::type_identity_t<T>& expected) {
    if (!(found == expected)) fail(what + ": " + show(found) + ", expected " + show(expected));
  }
  void close(const std::string& what, float found, float expected, float tolerance);
  // Compares a triangle's t with an expected value that is exactly a float: bit by bit, except
  // where Embree multiplies by an inexact reciprocal (robust and fast precision, CPUs without
  // AVX-512), which may be off by 2 ulps.
  bool is_distance(float found, float expected) const;
  void distance(const std::string& what, float found, float expected) {
    if (!is_distance(found, expected))
      fail(what + ": " + show(found) + ", expected " + show(expected));
  }
  void distance(const std::string& what, const std::vector<float>& found,
                const std::vector<float>& expected);
  void holds(const std::string& what, bool condition) {
    if (!condition) fail(what + ": does not hold");
  }
  // The call must have returned an error, with this id if one is given.
  void refused(const std::string& what, const rtapi::Status& status, const char* id = nullptr);
  template <class T>
  void refused(const std::string& what, const rtapi::Result<T>& result, const char* id = nullptr) {
    refused(what, result ? rtapi::Status() : rtapi::Status(result.error()), id);
  }
  void accepted(const std::string& what, const rtapi::Status& status) {
    if (!status) fail(what + ": refused with " + status.error().message);
  }
  template <class T>
  void accepted(const std::string& what, const rtapi::Result<T>& result) {
    if (!result) fail(what + ": refused with " + result.error().message);
  }
  void fail(std::string message) { failures_.push_back(std::move(message)); }
  const std::vector<std::string>& failures() const { return failures_; }
  // Messages of checked mode (KA0400 to KA0499) since the context began.
  std::vector<std::string> reports() const;

  // Buffers live as long as the context.
  template <class T>
  rtapi::Buffer upload(const std::vector<T>& elements) {
    return keep(rtapi::CreateUploadBuffer(device_, elements).value());
  }
  rtapi::Buffer zeros(uint64_t bytes);             // default heap, unordered access
  rtapi::Buffer structure_memory(uint64_t bytes);  // for acceleration structures
  std::vector<uint32_t> read(const rtapi::Buffer& buffer);

  // Descs of these geometries, whose data goes into upload buffers.
  std::vector<rtapi::RaytracingGeometryDesc> describe(const std::vector<Geometry>& geometries);
  rtapi::Buffer bottom_level(const std::vector<Geometry>& geometries);
  rtapi::Buffer top_level(const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  // Makes a bottom level of these and a top level with one instance of it.
  rtapi::Buffer scene(const std::vector<Geometry>& geometries, uint32_t contribution = 0,
                      uint32_t flags = 0);
  rtapi::Buffer build(const rtapi::BuildRaytracingAccelerationStructureInputs& inputs);

 private:
  Context(std::unique_ptr<SharedDevice> shared, const Target& target, bool goes_on);
  rtapi::Buffer keep(rtapi::Buffer buffer);
  static std::string show(std::integral auto value) { return std::to_string(value); }
  static std::string show(std::floating_point auto value) { return show_float(value); }
  template <class T>
  static std::string show(const std::vector<T>& values) {
    std::string out;
    for (const T value : values) out += (out.empty() ? "{" : ", ") + show(value);
    return out + (out.empty() ? "{}" : "}");
  }
  static std::string show_float(double value);

  Target target_;
  std::unique_ptr<SharedDevice> shared_;
  bool goes_on_ = false;  // a later context may reuse the device
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  std::vector<rtapi::Buffer> keep_;
  std::vector<std::string> failures_;
  bool hit_objects_ = false;
};

rtapi::RaytracingInstanceDesc instance(const rtapi::Buffer& bottom_level, float x = 0,
                                       uint32_t contribution = 0, uint32_t flags = 0);

// The test of one or more rules. `rules` lists them: "SBT-03, SBT-04".
struct RuleTest {
  const char* rules;
  void (*run)(Context& t);
  // Messages of checked mode that the test's violations must cause, "KA0401, KA0402"; any others
  // are false alarms. "*": the test is about what checked mode reports.
  const char* provokes = "";
};
struct Section {
  const char* name;  // "sbt_undefined"
  std::vector<RuleTest> tests;
};
std::vector<RuleTest> sbt_tests();
std::vector<RuleTest> sbt_undefined_tests();
std::vector<RuleTest> root_tests();
std::vector<RuleTest> flg_tests();
std::vector<RuleTest> flg_legality_tests();
std::vector<RuleTest> trv_tests();
std::vector<RuleTest> trv_any_hit_tests();
std::vector<RuleTest> trv_inactive_tests();
std::vector<RuleTest> trv_random_tests();
std::vector<RuleTest> trv_report_tests();
std::vector<RuleTest> trv_edge_tests();
std::vector<RuleTest> sv_tests();
std::vector<RuleTest> pay_tests();
std::vector<RuleTest> so_tests();
std::vector<RuleTest> so_collection_tests();
std::vector<RuleTest> so_object_tests();
std::vector<RuleTest> dsp_tests();
std::vector<RuleTest> as_build_tests();
std::vector<RuleTest> as_memory_tests();
std::vector<RuleTest> as_info_tests();
std::vector<RuleTest> as_update_tests();
std::vector<RuleTest> as_copy_tests();
std::vector<RuleTest> pay_qualifier_tests();
std::vector<RuleTest> rq_tests();
std::vector<RuleTest> ser_tests();
std::vector<RuleTest> ser_compile_tests();
std::vector<RuleTest> omm_tests();
std::vector<RuleTest> top_tests();
std::vector<RuleTest> ptl_tests();
std::vector<RuleTest> cls_tests();
std::vector<RuleTest> omm_build_tests();
std::vector<RuleTest> err_tests();
std::vector<RuleTest> ras_assembler_tests();
std::vector<RuleTest> ras_element_tests();
std::vector<RuleTest> ras_link_tests();
std::vector<RuleTest> ras_clip_tests();
std::vector<RuleTest> ras_viewport_tests();
std::vector<RuleTest> ras_coverage_tests();
std::vector<RuleTest> ras_line_tests();
std::vector<RuleTest> ras_geometry_tests();
std::vector<RuleTest> ras_source_tests();
std::vector<RuleTest> ras_depth_tests();
std::vector<RuleTest> ras_attribute_tests();
std::vector<RuleTest> ras_quad_tests();
std::vector<RuleTest> ras_lod_tests();
std::vector<RuleTest> ras_order_tests();
std::vector<RuleTest> ras_output_tests();
std::vector<RuleTest> ras_blend_tests();
std::vector<RuleTest> ras_clear_tests();
std::vector<RuleTest> ras_draw_tests();
std::vector<RuleTest> ras_random_tests();

}  // namespace kaamos::conformance
