// SPDX-License-Identifier: MIT
//
// Payload access qualifiers. Fields that DXR leaves undefined are 0 here, and a NULL shader leaves
// fields unchanged.
#include <shaders/qualified.h>
#include <shaders/qualified66.h>
#include <shaders/standard.h>

#include "tests/conformance/compile.h"
#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// Indices into what qualified.hlsl's note() writes.
enum Field : uint32_t {
  kToStages,
  kAnswer,
  kKept,
  kEverywhere,
  kOfAnyHit,
  kList,
  kNone = 8,
  kInnerToMiss,
  kInnerAnswer,
  kFields
};
using Words = std::vector<uint32_t>;

Words part(const Words& words, uint32_t byte_offset) {
  const auto first = words.begin() + byte_offset / 4;
  return Words(first, first + kFields);
}
Words seen_by_shader(const Words& words) {
  return part(words, 256);
}
Words seen_after(const Words& words) {
  return part(words, 512);
}

// Adds qualified.hlsl, which is a library of its own: a lib_6_7 has only payloads with qualifiers.
void add_qualified(Program& program, const std::vector<std::string>& exports) {
  DxilLibraryDesc code;
  code.DXILLibrary = LoadShaderLibrary(kaamos_shaders_qualified()).value();
  for (const std::string& name : exports) code.Exports.push_back({name, ""});
  program.desc.Add(code);
}

// One ray against one triangle; hit record 0 belongs to group "Qualified".
struct Qualified : Standard {
  explicit Qualified(Context& t, const char* closest = "ClosestQualified", const char* any = "")
      : Standard(t), context(&t), any_hit(*any != 0) {
    add_qualified(*this, {"TraceQualified", "ClosestQualified", "ClosestIdle", "ClosestNested",
                          "MissQualified", "AnyQualified"});
    group("Qualified", closest, any);
    if (any_hit) local(kRecordSignature, {"Qualified"});
    raygen("TraceQualified");
    miss("MissQualified");
  }

  Words trace_one(uint32_t flags = 0, uint32_t ordinal = 0, bool hits = true) {
    hit("Qualified", any_hit
                         ? std::vector<LocalArgument>{LocalArgument::Constants(Constants{ordinal})}
                         : std::vector<LocalArgument>{});
    return trace_record(flags, hits);
  }
  Words trace_record(uint32_t flags = 0, bool hits = true) {
    const auto geometry = any_hit ? RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation
                                  : RaytracingGeometryFlags::kOpaque;
    scene = context->scene({triangle(5, hits ? 0.0f : 100.0f, geometry)});
    Ray ray;
    ray.flags = flags;
    prepare({ray});
    return run();
  }

  Context* context;
  bool any_hit;
};

void refused_with(Context& t, const std::string& what, const Status& status, const char* id) {
  t.refused(what, status);
  if (status || status.error().message.find(id) != std::string::npos) return;
  t.fail(what + ": expected " + id + ", found " + status.error().message);
}

constexpr char kPlainField[] =
    "struct [raypayload] P { uint value; };\n"
    "[shader(\"miss\")] void Miss(inout P p) { p.value = 1; }\n";

void availability(Context& t) {
  t.accepted("a payload field without qualifiers in lib_6_5", compile(kPlainField, "lib_6_5"));
  t.accepted("the same in lib_6_6", compile(kPlainField, "lib_6_6"));
  refused_with(t, "the same in lib_6_6 with -enable-payload-qualifiers",
               compile(kPlainField, "lib_6_6", true), "KA2612");
  refused_with(t, "the same in lib_6_7", compile(kPlainField, "lib_6_7"), "KA2612");
  refused_with(t, "the same in lib_6_8", compile(kPlainField, "lib_6_8"), "KA2612");
  t.accepted("the same in lib_6_7 with -disable-payload-qualifiers",
             compile(kPlainField, "lib_6_7", false));
  refused_with(t, "lib_6_5 with -enable-payload-qualifiers", compile(kPlainField, "lib_6_5", true),
               "KA2610");
}

void set_payload_limit(Program& program, uint32_t bytes) {
  for (StateSubobject& each : program.desc.Subobjects) {
    if (auto* config = std::get_if<RaytracingShaderConfig>(&each)) {
      config->MaxPayloadSizeInBytes = bytes;
    }
  }
}

void payload_limit(Context& t) {
  Program qualified(t, kaamos_shaders_qualified(),
                    {"TraceQualified", "ClosestQualified", "MissQualified"});
  set_payload_limit(qualified, 0);
  qualified.group("Group", "ClosestQualified");
  qualified.raygen("TraceQualified");
  qualified.miss("MissQualified");
  qualified.hit("Group");
  qualified.scene = t.scene({triangle(5)});
  qualified.rays = t.upload(std::vector<Ray>{Ray{}});
  t.equal("answer with MaxPayloadSizeInBytes of 0", seen_after(qualified.run())[kAnswer], 101u);

  Program plain(t, kaamos_shaders_standard(), {"Miss"});
  plain.local(kRecordSignature, {"Miss"});
  set_payload_limit(plain, 0);
  t.refused("a payload without qualifiers, with a limit of 0", plain.try_create());
  Program older(t, kaamos_shaders_qualified66(), {"MissQualified66"});
  set_payload_limit(older, 0);
  t.refused("a payload with qualifiers in lib_6_6, with a limit of 0", older.try_create());
  set_payload_limit(older, 44);
  t.accepted("the same with a limit of 44", older.try_create());
}

void annotated_and_plain_payloads(Context& t) {
  Standard program(t);
  add_qualified(program, {"TraceQualified", "ClosestQualified", "MissQualified"});
  program.group("Qualified", "ClosestQualified");
  program.raygen("TraceQualified");
  program.raygen("Trace");
  program.hit("Qualified");
  program.record("Plain");
  program.miss("MissQualified");
  program.miss_records(1);
  program.scene = t.scene({triangle(5)});
  program.prepare({Ray{}});
  t.equal("answer in the annotated payload", seen_after(program.run())[kAnswer], 101u);
  Ray plain;
  plain.contribution = plain.miss = 1;
  program.prepare({plain});
  DispatchRaysDesc dispatch = program.tables();
  dispatch.RayGenerationShaderRecord = program.shader_tables[0].GetRecord(1);
  t.equal("end in the plain payload", seen_of(program.run(dispatch), 1)[0].end, kClosestHitRan);
}

void fields_are_copied_by_stage(Context& t) {
  Qualified hits(t);
  Words words = hits.trace_one();
  t.equal("what the closest-hit shader sees", seen_by_shader(words),
          Words{10, 0, 0, 13, 0, 0, 0, 0, 0, 0, 0});
  t.equal("what the caller sees after it", seen_after(words),
          Words{0, 101, 12, 103, 14, 0, 0, 0, 0, 0, 110});
  Qualified misses(t);
  words = misses.trace_one(0, 0, false);
  t.equal("what the miss shader sees", seen_by_shader(words),
          Words{10, 0, 0, 13, 0, 0, 0, 0, 0, 19, 0});
  t.equal("what the caller sees after it", seen_after(words),
          Words{0, 201, 12, 203, 14, 0, 0, 0, 0, 0, 210});
}

void idle_stages_change_nothing(Context& t) {
  constexpr uint32_t kForceOpaque = 1;
  Qualified opaque(t, "ClosestIdle", "AnyQualified");
  t.equal("ofAnyHit where no any-hit shader ran",
          seen_after(opaque.trace_one(kForceOpaque, 2))[kOfAnyHit], 14u);
  struct Case {
    uint32_t ordinal;
    uint32_t of_any_hit;
    uint32_t everywhere;
    const char* what;
  };
  for (const Case& each : {Case{1, 0, 13, "an any-hit shader that writes nothing"},
                           Case{2, 304, 14, "one that writes"},
                           Case{4, 304, 14, "one that writes and ends the search"},
                           Case{5, 304, 21, "one that does it in a function"}}) {
    Qualified program(t, "ClosestIdle", "AnyQualified");
    const Words after = seen_after(program.trace_one(0, each.ordinal));
    t.equal(std::string("ofAnyHit after ") + each.what, after[kOfAnyHit], each.of_any_hit);
    t.equal(std::string("everywhere after ") + each.what, after[kEverywhere], each.everywhere);
    t.equal(std::string("kept after ") + each.what, after[kKept], 12u);
  }
  Qualified ignored(t, "ClosestIdle", "AnyQualified");
  const Words seen = seen_by_shader(ignored.trace_one(0, 3));
  t.equal("everywhere in the miss shader after an ignored hit", seen[kEverywhere], 14u);
  t.equal("toStages there", seen[kToStages], 10u);
  t.equal("list[1] there", seen[kList + 1], 306u);
}

void null_shaders(Context& t) {
  Qualified program(t);
  program.create();
  program.shader_tables[2].AddNullRecord();
  const Words words = program.trace_record();
  t.equal("what the caller sees after a NULL hit group", seen_after(words),
          Words{0, 0, 12, 13, 14, 0, 0, 0, 0, 0, 0});
}

void callers_keep_their_own(Context& t) {
  Qualified hits(t);
  t.equal("kept after a shader that writes it", seen_after(hits.trace_one())[kKept], 12u);
  Qualified nested(t, "ClosestNested");
  const Words words = nested.trace_one();
  t.equal("kept in the shader that handed its payload on", words[768 / 4], 500u);
  t.equal("kept in the outer caller", seen_after(words)[kKept], 12u);
  t.equal("answers of both nested traces", seen_after(words)[kAnswer], 402u);
}

void caller_to_caller(Context& t) {
  constexpr uint32_t kSkipClosestHit = 8;
  Qualified program(t);
  const Words words = program.trace_one(kSkipClosestHit);
  t.equal("no shader ran", seen_by_shader(words), Words(kFields));
  t.equal("what the caller sees", seen_after(words), Words{0, 0, 12, 13, 14, 0, 0, 0, 0, 0, 0});
}

void declaration_rules(Context& t) {
  const auto compiles = [](const std::string& field) {
    return compile(
        "struct [raypayload] Inner { uint i : write(miss) : read(caller); };\n"
        "struct [raypayload] P { " +
            field + "; };\n[shader(\"miss\")] void Miss(inout P p) {}\n",
        "lib_6_7");
  };
  for (const char* field :
       {"uint a : read(caller) : write(miss)", "uint a : write(caller) : read(anyhit)",
        "uint a : read() : write()", "uint a : write(anyhit) : read(anyhit)",
        "uint a : write(caller) : read(caller)", "uint a : write(anyhit) : read(miss)", "Inner a",
        "uint a[2] : write(miss, closesthit) : read(caller)"}) {
    t.accepted(field, compiles(field));
  }
  const std::pair<const char*, const char*> refused[] = {
      {"uint a", "KA2612"},
      {"Inner a : read(caller) : write(miss)", "KA2613"},
      {"uint a : read(caller) : write(miss) : write(anyhit)", "KA2614"},
      {"uint a : read(raygeneration) : write(miss)", "KA2615"},
      {"uint a : read(caller)", "KA2616"},
      {"uint a : write(caller)", "KA2616"},
      {"uint a : read(miss) : write(closesthit)", "KA2617"},
      {"uint a : read(anyhit, caller) : write(closesthit)", "KA2617"},
      {"uint a : read(caller) : write()", "KA2617"},
      {"uint a : read() : write(caller)", "KA2618"},
      {"uint a : read(closesthit, miss) : write(caller, closesthit)", "KA2618"},
  };
  for (const auto& [field, id] : refused) refused_with(t, field, compiles(field), id);
}

}  // namespace

std::vector<RuleTest> pay_qualifier_tests() {
  return {{"PAY-08", availability},
          {"PAY-09", payload_limit},
          {"PAY-10", annotated_and_plain_payloads},
          {"PAY-11", fields_are_copied_by_stage},
          {"PAY-12", idle_stages_change_nothing},
          {"PAY-13", null_shaders},
          {"PAY-14", callers_keep_their_own},
          {"PAY-15", caller_to_caller},
          {"PAY-16", declaration_rules}};
}

}  // namespace kaamos::conformance
