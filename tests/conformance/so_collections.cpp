// SPDX-License-Identifier: MIT
//
// State objects: hit groups, configs, collections.
#include <shaders/stack.h>

#include "tests/conformance/compile.h"
#include "tests/conformance/states.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using Bytes = std::vector<uint32_t>;

void which_shaders_a_group_takes(Context& t) {
  for (const HitGroupType type : {HitGroupType::kTriangles, HitGroupType::kProceduralPrimitive}) {
    const bool boxes = type == HitGroupType::kProceduralPrimitive;
    for (uint32_t shaders = 0; shaders < 8; ++shaders) {
      StateObjectDesc desc = complete(t);
      HitGroupDesc group =
          triangles("group", (shaders & 1) != 0 ? "HitA" : "", (shaders & 2) != 0 ? "AnyA" : "");
      if ((shaders & 4) != 0) group.IntersectionShaderImport = "BoxA";
      group.Type = type;
      desc.Add(group);
      const std::string what = std::string(boxes ? "boxes" : "triangles") + " with" +
                               ((shaders & 1) != 0 ? " closest-hit" : "") +
                               ((shaders & 2) != 0 ? " any-hit" : "") +
                               ((shaders & 4) != 0 ? " intersection" : "");
      if (boxes == ((shaders & 4) != 0)) {
        t.accepted(what, make(t, desc));
      } else {
        t.refused(what, make(t, desc), "KA0516");
      }
    }
  }
  StateObjectDesc wrong = complete(t);
  wrong.Add(triangles("group", "AnyA"));
  t.refused("an any-hit shader as closest-hit shader", make(t, wrong), "KA0517");
}

void groups_in_hlsl(Context& t) {
  StateObjectDesc desc = configs();
  desc.Add(subobjects(
      named({"HitA", "AnyA", "BoxA", "Triangles", "OnlyClosest", "OnlyAny", "Boxes", "OnlyBox"})));
  const auto pipeline = make(t, desc).value();
  struct Expected {
    const char* group;
    bool closest, any, intersection;
  };
  for (const Expected& each :
       {Expected{"Triangles", true, true, false}, Expected{"OnlyClosest", true, false, false},
        Expected{"OnlyAny", false, true, false}, Expected{"Boxes", true, true, true},
        Expected{"OnlyBox", false, false, true}}) {
    const std::string group = each.group;
    t.holds(group + " is there", has(pipeline, group));
    const auto present = [&](const char* shader) {
      return pipeline.GetShaderStackSize(group + "::" + shader) != kNoShaderStackSize;
    };
    t.equal(group + ": closest hit", present("closesthit"), each.closest);
    t.equal(group + ": any hit", present("anyhit"), each.any);
    t.equal(group + ": intersection", present("intersection"), each.intersection);
  }
  const std::string shaders = shader_of("closesthit", "p.value = 1;");
  t.accepted("two strings for triangles",
             compile(shaders + "TriangleHitGroup G = {\"\", \"Shader\"};"));
  t.accepted("three strings for boxes",
             compile(shaders + "ProceduralPrimitiveHitGroup G = {\"\", \"Shader\", \"Box\"};"));
  t.refused("three strings for triangles",
            compile(shaders + "TriangleHitGroup G = {\"\", \"Shader\", \"Box\"};"));
  t.refused("two strings for boxes",
            compile(shaders + "ProceduralPrimitiveHitGroup G = {\"\", \"Shader\"};"));
}

void recursion_depths(Context& t) {
  for (const uint32_t depth : {0u, 1u, 31u}) {
    StateObjectDesc desc = configs(kPipeline, kNoFlags, depth);
    desc.Add(states(named({"MissA"})));
    t.accepted("depth " + std::to_string(depth), make(t, desc));
  }
  for (const uint32_t depth : {32u, 1000u, ~0u}) {
    StateObjectDesc desc = configs(kPipeline, kNoFlags, depth);
    desc.Add(states(named({"MissA"})));
    t.refused("depth " + std::to_string(depth), make(t, desc), "KA0519");
  }
}

Device old_device(Context& t) {
  DeviceDesc desc = t.target().device_desc();
  desc.Tier = RaytracingTier::kTier1_0;
  return CreateDevice(desc).value();
}

void pipeline_configs(Context& t) {
  StateObjectDesc with_flags;
  with_flags.Add(RaytracingShaderConfig{16, 8});
  with_flags.Add(RaytracingPipelineConfig1{1, RaytracingPipelineFlags::kSkipTriangles});
  with_flags.Add(states(named({"MissA"})));
  t.accepted("config 1 on tier 1.1", make(t, with_flags));
  const Device old = old_device(t);
  t.refused("config 1 on tier 1.0", old.CreateStateObject(with_flags), "KA0520");
  StateObjectDesc plain = configs();
  plain.Add(states(named({"MissA"})));
  t.accepted("config on tier 1.0", old.CreateStateObject(plain));
  StateObjectDesc hlsl;
  hlsl.Add(RaytracingShaderConfig{16, 8});
  hlsl.Add(subobjects(named({"MissA", "Pipeline1"})));
  t.accepted("HLSL's config 1 on tier 1.1", make(t, hlsl));
  t.refused("HLSL's config 1 on tier 1.0", old.CreateStateObject(hlsl), "KA0520");

  const auto collection = [&](const char* name, uint32_t depth) {
    StateObjectDesc desc = configs(kCollection, kNoFlags, depth);
    desc.Add(states(named({name})));
    return make(t, desc).value();
  };
  for (const uint32_t depth : {1u, 2u}) {
    StateObjectDesc outer;
    outer.Add(ExistingCollectionDesc::Of(collection("MissA", 1)));
    outer.Add(ExistingCollectionDesc::Of(collection("MissB", depth)));
    if (depth == 1) {
      t.accepted("equal depths in two collections", make(t, outer));
    } else {
      t.refused("different depths in two collections", make(t, outer), "KA0514");
    }
  }
}

void shaders_need_tier_1_1(Context& t) {
  const Device old = old_device(t);
  const auto with = [&](const Device& device, const std::string& raygen, const std::string& hit) {
    StateObjectDesc desc = configs();
    desc.Add(
        DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_stack()).value(), named({raygen, hit})});
    desc.Add(triangles("group", hit));
    desc.Add(GlobalRootSignature{
        device.CreateRootSignature("SRV(t0), UAV(u0), RootConstants(b0, num32BitConstants = 1)")
            .value()});
    return device.CreateStateObject(desc);
  };
  t.accepted("TraceRay on tier 1.0", with(old, "TraceDeep", "HitDeep"));
  t.refused("SKIP_TRIANGLES on tier 1.0", with(old, "TraceSkipping", "HitDeep"), "KA0542");
  t.refused("RayQuery on tier 1.0", with(old, "TraceDeep", "HitQuery"), "KA0542");
  t.accepted("SKIP_TRIANGLES on tier 1.1", with(t.device(), "TraceSkipping", "HitDeep"));
  t.accepted("RayQuery on tier 1.1", with(t.device(), "TraceDeep", "HitQuery"));
}

void additions_need_tier_1_1(Context& t) {
  const Device old = old_device(t);
  StateObjectDesc parent = configs(kPipeline, kAdditions);
  parent.Add(states(named({"MissA"})));
  StateObjectDesc addition = configs(kPipeline, kAdditions);
  addition.Add(states(named({"MissB"})));
  const auto made = old.CreateStateObject(parent);
  if (made) {
    t.refused("AddToStateObject on tier 1.0", old.AddToStateObject(addition, *made), "KA0533");
  }
  const auto here = make(t, parent).value();
  t.accepted("AddToStateObject on tier 1.1", t.device().AddToStateObject(addition, here));
}

void shader_configs_match(Context& t) {
  const auto collection = [&](const char* name, uint32_t payload) {
    StateObjectDesc desc = configs(kCollection, kNoFlags, 1, payload);
    desc.Add(states(named({name})));
    return ExistingCollectionDesc::Of(make(t, desc).value());
  };
  StateObjectDesc same;
  same.Add(collection("MissA", 16));
  same.Add(collection("MissB", 16));
  t.accepted("payloads of 16 and 16", make(t, same));
  StateObjectDesc different;
  different.Add(collection("MissA", 16));
  different.Add(collection("MissB", 32));
  t.refused("payloads of 16 and 32", make(t, different), "KA0513");
}

// State objects that each lack one thing.
std::vector<std::pair<const char*, StateObjectDesc>> incomplete(Context& t,
                                                                StateObjectFlags flags) {
  std::vector<std::pair<const char*, StateObjectDesc>> out;
  const char* const what[] = {"shader config", "pipeline config", "root signature"};
  StateObjectDesc whole = complete(t, named({"Start", "HitA"}), kCollection);
  for (size_t i = 0; i < 3; ++i) {
    StateObjectDesc desc = whole;
    desc.Subobjects.erase(desc.Subobjects.begin() + i);
    out.emplace_back(what[i], desc);
  }
  StateObjectDesc import = whole;
  import.Add(triangles("group", "HitA", "AnyA"));
  out.emplace_back("imported shader", import);
  if (flags != kNoFlags) {
    for (auto& each : out) each.second.Add(StateObjectConfig{flags});
  }
  return out;
}

void a_default_collection_is_complete(Context& t) {
  t.accepted("a complete one", make(t, complete(t, {}, kCollection)));
  for (const auto& [what, desc] : incomplete(t, kNoFlags)) {
    t.refused(std::string("without ") + what, make(t, desc));
  }
}

void a_collection_may_stay_unresolved(Context& t) {
  for (const auto& [what, desc] : incomplete(t, kMayStayUnresolved)) {
    const auto collection = make(t, desc);
    t.accepted(std::string("without ") + what, collection);
    if (!collection) continue;
    const bool import = std::string(what) == "imported shader";
    const char* const name = import ? "group" : "Start";
    t.holds(std::string(name) + " has no identifier without " + what, !has(*collection, name));
    StateObjectDesc outer = configs();
    outer.Add(global(t));
    outer.Add(states(named({"AnyA"})));
    outer.Add(ExistingCollectionDesc::Of(*collection));
    const auto pipeline = make(t, outer);
    t.accepted(std::string("the pipeline that adds the ") + what, pipeline);
    if (pipeline) t.holds(std::string(name) + " in the pipeline", has(*pipeline, name));
  }
}

void others_may_use_a_collection(Context& t) {
  for (const StateObjectFlags flags : {kNoFlags, kOthersMayUse}) {
    const bool usable = flags == kOthersMayUse;
    const std::string with = usable ? " with the flag" : " without the flag";
    StateObjectDesc inner = complete(t, {}, kCollection, flags);
    const auto collection = make(t, inner).value();
    StateObjectDesc outer = configs();
    outer.Add(ExistingCollectionDesc::Of(collection));
    const auto plain = make(t, outer).value();
    t.equal("its entry points" + with, call(t, plain, {"CallB", "CallA"}), Bytes{2, 1});
    outer.Add(triangles("group", "HitA"));
    if (usable) {
      t.accepted("a group of its shader" + with, make(t, outer));
    } else {
      t.refused("a group of its shader" + with, make(t, outer), "KA0525");
    }
    // An association that reaches outside its collection.
    StateObjectDesc speaker = configs(kCollection, flags);
    speaker.Add(states(named({"MissA"})));
    speaker.Associate(speaker.Add(local(t, 3)), {"MissA", "MissB"});
    StateObjectDesc listener = configs();
    listener.Add(ExistingCollectionDesc::Of(make(t, speaker).value()));
    listener.Add(states(named({"MissB"})));
    t.equal("an association that reaches outside" + with,
            local_bytes(make(t, listener).value(), {"MissA", "MissB"}),
            usable ? Bytes{12, 12} : Bytes{12, 0});
  }
}

void additions_of_collections(Context& t) {
  for (const StateObjectFlags inner : {kNoFlags, kAdditions}) {
    for (const StateObjectFlags outer : {kNoFlags, kAdditions}) {
      StateObjectDesc desc = configs(kPipeline, outer);
      desc.Add(ExistingCollectionDesc::Of(
          make(t, complete(t, named({"MissA"}), kCollection, inner)).value()));
      const std::string what = std::string(inner == kNoFlags ? "plain" : "flagged") +
                               " collection in a " + (outer == kNoFlags ? "plain" : "flagged") +
                               " pipeline";
      if (inner == kNoFlags && outer == kAdditions) {
        t.refused(what, make(t, desc), "KA0526");
      } else {
        t.accepted(what, make(t, desc));
      }
    }
  }
  StateObjectDesc addition = configs(kPipeline, kAdditions);
  addition.Add(states(named({"MissB"})));
  for (const StateObjectFlags flags : {kNoFlags, kAdditions}) {
    const auto parent = make(t, complete(t, named({"MissA"}), kPipeline, flags)).value();
    const auto child = t.device().AddToStateObject(addition, parent);
    if (flags == kAdditions) {
      t.accepted("adding to a flagged pipeline", child);
    } else {
      t.refused("adding to a plain pipeline", child, "KA0533");
    }
  }
}

void collection_flags_of_pipelines(Context& t) {
  for (const StateObjectFlags flags :
       {kMayStayUnresolved, kOthersMayUse, kMayStayUnresolved | kOthersMayUse}) {
    t.accepted("a complete pipeline", make(t, complete(t, {}, kPipeline, flags)));
    StateObjectDesc desc = complete(t, {}, kPipeline, flags);
    desc.Add(triangles("group", "Nowhere"));
    t.refused("an incomplete pipeline", make(t, desc), "KA0518");
  }
}

void pipelines_are_resolved(Context& t) {
  for (auto& [what, desc] : incomplete(t, kMayStayUnresolved)) {
    StateObjectDesc outer;
    outer.Add(ExistingCollectionDesc::Of(make(t, desc).value()));
    t.refused(std::string("a pipeline of a collection without ") + what, make(t, outer));
    StateObjectDesc same = desc;
    same.Type = kPipeline;
    t.refused(std::string("a pipeline without ") + what, make(t, same));
  }
}

void references_are_held(Context& t) {
  StateObject pipeline;
  {
    StateObjectDesc inner = complete(t, {}, kCollection);
    StateObject collection = make(t, inner).value();
    StateObjectDesc outer = configs();
    outer.Add(ExistingCollectionDesc::Of(collection));
    outer.Associate(outer.Add(local(t, 3)), {"CallB"});
    pipeline = make(t, outer).value();
  }
  t.equal("local root signature", local_bytes(pipeline, {"CallB"}), Bytes{12});
  t.equal("answers", call(t, pipeline, {"CallA", "CallA"}), Bytes{1, 1});
}

void no_global_signature_and_equal_identifiers(Context& t) {
  StateObjectDesc desc = configs(kCollection);
  desc.Add(states(named({"Idle", "MissA", "HitA"})));
  desc.Add(triangles("group"));
  auto collection = make(t, desc);
  t.accepted("a collection without a global root signature", collection);
  StateObjectDesc outer = configs();
  outer.Add(ExistingCollectionDesc::Of(collection.value()));
  const auto pipeline = make(t, outer).value();
  for (const char* name : {"Idle", "MissA", "group"}) {
    const auto* a = collection->GetShaderIdentifier(name);
    const auto* b = pipeline.GetShaderIdentifier(name);
    t.holds(std::string("identifier of ") + name + " in collection and pipeline",
            a != nullptr && b != nullptr && *a == *b);
  }
}

}  // namespace

std::vector<RuleTest> so_collection_tests() {
  return {{"SO-20", which_shaders_a_group_takes},
          {"SO-21", groups_in_hlsl},
          {"SO-22", recursion_depths},
          {"SO-23", pipeline_configs},
          {"SO-23", additions_need_tier_1_1},
          {"FLG-05", shaders_need_tier_1_1},
          {"SO-24", shader_configs_match},
          {"SO-25", a_default_collection_is_complete},
          {"SO-26", a_collection_may_stay_unresolved},
          {"SO-27", others_may_use_a_collection},
          {"SO-28", additions_of_collections},
          {"SO-29", collection_flags_of_pipelines},
          {"SO-30", pipelines_are_resolved},
          {"SO-31", references_are_held},
          {"SO-32", no_global_signature_and_equal_identifiers}};
}

}  // namespace kaamos::conformance
