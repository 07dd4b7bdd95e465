// SPDX-License-Identifier: MIT
//
// State objects: what they consist of, and what is associated with what.
#include "tests/conformance/compile.h"
#include "tests/conformance/states.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using Bytes = std::vector<uint32_t>;

void types_of_state_objects(Context& t) {
  t.equal("COLLECTION", static_cast<uint32_t>(kCollection), 0u);
  t.equal("RAYTRACING_PIPELINE", static_cast<uint32_t>(kPipeline), 3u);
  const auto collection = make(t, complete(t, named({"MissA"}), kCollection)).value();
  StateObjectDesc outer = complete(t, named({"MissB"}), kCollection);
  outer.Add(ExistingCollectionDesc::Of(collection));
  t.refused("a collection in a collection", make(t, outer), "KA0501");
  outer.Type = kPipeline;
  t.accepted("a collection in a pipeline", make(t, outer));
  StateObjectDesc nested = configs();
  nested.Add(ExistingCollectionDesc::Of(make(t, complete(t)).value()));
  t.refused("a pipeline as a collection", make(t, nested));
  for (const uint32_t type : {1u, 2u, 4u, ~0u}) {
    StateObjectDesc other = complete(t);
    other.Type = static_cast<StateObjectType>(type);
    t.refused("type " + std::to_string(type), make(t, other));
  }
}

void refusals_say_why(Context& t) {
  StateObjectDesc desc = complete(t);
  t.accepted("a pipeline", make(t, desc));
  desc.Add(triangles("group", "NotThere"));
  const auto refused = make(t, desc);
  t.refused("an unknown import", refused);
  if (refused) return;
  t.equal("E_INVALIDARG", refused.error().code == ErrorCode::kInvalidArgument, true);
  const std::string& message = refused.error().message;
  t.holds("the message begins with its id", message.rfind(refused.error().id.text(), 0) == 0);
  for (const char* part : {"\"group\"", "\"NotThere\""}) {
    t.holds(std::string("the message names ") + part, message.find(part) != std::string::npos);
  }
}

void libraries_from_6_3(Context& t) {
  const std::string source = shader_of("miss", "p.value = 1;");
  t.accepted("lib_6_3", compile(source, "lib_6_3"));
  t.refused("lib_6_2", compile(source, "lib_6_2"));
  t.refused("lib_6_1", compile(source, "lib_6_1"));
  StateObjectDesc desc = configs();
  desc.Add(DxilLibraryDesc{});
  t.refused("an empty library", make(t, desc));
}

void export_lists(Context& t) {
  const auto all = make(t, complete(t)).value();
  for (const char* name : {"Start", "MissA", "MissB", "CallA"}) {
    t.holds(std::string(name) + " without a list", has(all, name));
  }
  StateObjectDesc listed = complete(t, named({"MissA", "HitA"}));
  const auto some = make(t, listed).value();
  t.holds("MissA of the list", has(some, "MissA"));
  t.holds("MissB is not listed", !has(some, "MissB"));
  listed.Add(triangles("group", "HitA", "AnyA"));
  t.refused("a group of a shader that is not listed", make(t, listed), "KA0518");
  t.refused("a listed name that the library lacks", make(t, complete(t, named({"Nowhere"}))),
            "KA0503");
  StateObjectDesc outer = configs();
  outer.Add(
      ExistingCollectionDesc::Of(make(t, complete(t, {}, kCollection)).value(), named({"MissA"})));
  const auto of_collection = make(t, outer).value();
  t.holds("MissA of the collection", has(of_collection, "MissA"));
  t.holds("MissB of the collection", !has(of_collection, "MissB"));
}

void renames(Context& t) {
  const std::string mangled = states().DXILLibrary.FindExport("MissA")->MangledName;
  StateObjectDesc desc = complete(t, {{"HitOne", "HitA"},
                                      {"HitTwo", "HitA"},
                                      {"Sky", mangled},
                                      {"Start", ""},
                                      {"CallOne", "CallA"},
                                      {"CallTwo", "CallA"},
                                      {"CallB", "CallB"}});
  desc.Add(triangles("one", "HitOne"));
  desc.Add(triangles("two", "HitTwo"));
  desc.Associate(desc.Add(local(t, 1)), {"HitOne"});
  desc.Associate(desc.Add(local(t, 2)), {"HitTwo"});
  const auto pipeline = make(t, desc).value();
  t.equal("local arguments of one function under two names", local_bytes(pipeline, {"one", "two"}),
          Bytes{4, 8});
  t.holds("renamed by its mangled name", has(pipeline, "Sky"));
  t.holds("the old name is gone", !has(pipeline, "MissA") && !has(pipeline, "CallA"));
  t.equal("answers under both names", call(t, pipeline, {"CallOne", "CallTwo"}), Bytes{1, 1});
}

void a_library_twice(Context& t) {
  StateObjectDesc desc = complete(t, named({"Start", "CallA"}));
  desc.Add(states(named({"CallB"})));
  const auto pipeline = make(t, desc).value();
  t.equal("answers", call(t, pipeline, {"CallB", "CallA"}), Bytes{2, 1});
  desc.Add(states({{"CallC", "CallA"}}));
  t.accepted("the same function under another name", make(t, desc));
  desc.Add(states(named({"CallA"})));
  t.refused("the same name again", make(t, desc), "KA0504");
  StateObjectDesc groups = complete(t);
  groups.Add(triangles("MissA"));
  t.refused("a hit group of a shader's name", make(t, groups), "KA0504");
}

void mangled_names(Context& t) {
  const ShaderLibrary library = states().DXILLibrary;
  const auto pipeline = make(t, complete(t)).value();
  const std::string mangled = library.FindExport("MissA")->MangledName;
  const auto* by_name = pipeline.GetShaderIdentifier("MissA");
  const auto* by_mangled = pipeline.GetShaderIdentifier(mangled);
  t.holds("both names are found", by_name != nullptr && by_mangled != nullptr);
  t.holds("they name the same",
          by_name != nullptr && by_mangled != nullptr && *by_name == *by_mangled);
  StateObjectDesc imports = complete(t);
  imports.Add(triangles("group", library.FindExport("HitA")->MangledName));
  t.accepted("a group's import by mangled name", make(t, imports));
  std::vector<std::string> overloads;
  for (const ShaderExportInfo& each : library.GetExports()) {
    if (each.Name == "Scaled") overloads.push_back(each.MangledName);
  }
  t.equal("overloads", overloads.size(), size_t{2});
  t.refused("renaming an overloaded name", make(t, complete(t, {{"Twice", "Scaled"}})), "KA0505");
  for (const std::string& each : overloads) {
    t.accepted("renaming one by its mangled name", make(t, complete(t, {{"Twice", each}})));
  }
}

// --- associations ---

// Two miss shaders and the configs.
StateObjectDesc misses(Context& t, StateObjectType type = kPipeline,
                       StateObjectFlags flags = kNoFlags) {
  return complete(t, named({"MissA", "MissB"}), type, flags);
}

void default_associations(Context& t) {
  StateObjectDesc desc = misses(t);
  const uint32_t three = desc.Add(local(t, 3));
  t.equal("not associated: all", local_bytes(make(t, desc).value(), {"MissA", "MissB"}),
          Bytes{12, 12});
  desc.Associate(three, {});
  t.equal("an empty list: all", local_bytes(make(t, desc).value(), {"MissA", "MissB"}),
          Bytes{12, 12});
  StateObjectDesc hlsl = configs();
  hlsl.Add(subobjects(named({"MissA", "MissB", "Three"})));
  t.equal("declared in HLSL", local_bytes(make(t, hlsl).value(), {"MissA", "MissB"}),
          Bytes{12, 12});
}

void reach_of_defaults(Context& t) {
  StateObjectDesc inner = complete(t, named({"MissA"}), kCollection);
  inner.Add(local(t, 3));
  StateObjectDesc outer = configs();
  outer.Add(ExistingCollectionDesc::Of(make(t, inner).value()));
  outer.Add(states(named({"MissB"})));
  t.equal("a collection's default stays inside",
          local_bytes(make(t, outer).value(), {"MissA", "MissB"}), Bytes{12, 0});
  // Written in HLSL, an association covers the library's own exports but not those of another
  // library.
  StateObjectDesc beside = configs();
  beside.Add(subobjects(named({"MissA", "Three"})));
  beside.Add(states(named({"MissB"})));
  t.equal("a library's default stays inside",
          local_bytes(make(t, beside).value(), {"MissA", "MissB"}), Bytes{12, 0});
  StateObjectDesc around = configs();
  around.Add(subobjects(named({"MissA"})));
  around.Add(states(named({"MissB"})));
  around.Add(local(t, 2));
  t.equal("a default reaches contained libraries",
          local_bytes(make(t, around).value(), {"MissA", "MissB"}), Bytes{8, 8});
  StateObjectDesc named_one = misses(t);
  named_one.Add(local(t, 2));
  named_one.Associate(named_one.Add(local(t, 5)), {"MissB"});
  t.equal("not what is named elsewhere",
          local_bytes(make(t, named_one).value(), {"MissA", "MissB"}), Bytes{8, 20});
}

void reach_of_explicit_associations(Context& t) {
  StateObjectDesc desc = misses(t);
  const uint32_t three = desc.Add(local(t, 3));
  desc.Associate(three, {"MissC"});
  t.refused("an unknown export, in a pipeline", make(t, desc), "KA0507");
  desc.Type = kCollection;
  t.accepted("an unknown export, in a collection", make(t, desc));
  StateObjectDesc outer = configs();
  outer.Add(ExistingCollectionDesc::Of(make(t, misses(t, kCollection)).value()));
  outer.Associate(outer.Add(local(t, 3)), {"MissB"});
  t.equal("an export of a collection", local_bytes(make(t, outer).value(), {"MissA", "MissB"}),
          Bytes{0, 12});
  StateObjectDesc hlsl = configs();
  hlsl.Add(subobjects(named({"MissA", "MissB", "Three"})));
  hlsl.Add(DxilSubobjectToExportsAssociation{"Three", {"MissB"}});
  t.equal("a subobject of a library by its name",
          local_bytes(make(t, hlsl).value(), {"MissA", "MissB"}), Bytes{0, 12});
  hlsl.Add(DxilSubobjectToExportsAssociation{"Nowhere", {"MissA"}});
  t.refused("an unknown subobject, in a pipeline", make(t, hlsl));
  hlsl.Type = kCollection;
  t.accepted("an unknown subobject, in a collection", make(t, hlsl));
}

void many_associations_of_one(Context& t) {
  StateObjectDesc desc = complete(t);
  const uint32_t three = desc.Add(local(t, 3));
  for (const char* name : {"MissA", "CallA", "Start"}) desc.Associate(three, {name});
  t.equal("of MissA, CallA, Start, MissB",
          local_bytes(make(t, desc).value(), {"MissA", "CallA", "Start", "MissB"}),
          Bytes{12, 12, 12, 0});
}

void two_definitions_for_one(Context& t) {
  StateObjectDesc desc = misses(t);
  desc.Associate(desc.Add(local(t, 3)), {"MissA"});
  desc.Associate(desc.Add(local(t, 3)), {"MissA"});
  t.accepted("equal ones", make(t, desc));
  desc.Associate(desc.Add(local(t, 4)), {"MissA"});
  t.refused("different ones", make(t, desc), "KA0509");
  StateObjectDesc hlsl = configs();
  hlsl.Add(subobjects(named({"MissA", "Three", "ThreeForMissA", "Five", "FiveForMissA"})));
  t.refused("different ones in HLSL", make(t, hlsl), "KA0509");
}

void state_objects_override_libraries(Context& t) {
  const auto in_hlsl = [&](StateObjectType type) {
    StateObjectDesc desc = configs(type);
    desc.Add(subobjects(named({"MissA", "MissB", "Three", "ThreeForMissA"})));
    return desc;
  };
  StateObjectDesc plain = in_hlsl(kPipeline);
  t.equal("the library alone", local_bytes(make(t, plain).value(), {"MissA", "MissB"}),
          Bytes{12, 0});
  StateObjectDesc by_name = plain;
  by_name.Associate(by_name.Add(local(t, 2)), {"MissA"});
  t.equal("overridden by name", local_bytes(make(t, by_name).value(), {"MissA", "MissB"}),
          Bytes{8, 0});
  StateObjectDesc by_default = plain;
  by_default.Associate(by_default.Add(local(t, 2)), {});
  t.equal("overridden by a default", local_bytes(make(t, by_default).value(), {"MissA", "MissB"}),
          Bytes{8, 8});
  // A library in a collection in a pipeline.
  StateObjectDesc inner = in_hlsl(kCollection);
  inner.Associate(inner.Add(local(t, 2)), {"MissA"});
  StateObjectDesc outer = configs();
  outer.Add(ExistingCollectionDesc::Of(make(t, inner).value()));
  t.equal("overridden in the collection", local_bytes(make(t, outer).value(), {"MissA"}), Bytes{8});
  outer.Associate(outer.Add(local(t, 5)), {"MissA"});
  t.refused("overriding a collection", make(t, outer), "KA0509");
}

void hit_group_associations(Context& t) {
  StateObjectDesc base = complete(t);
  base.Add(triangles("group", "HitA", "AnyA"));
  const auto with = [&](std::vector<std::pair<uint32_t, std::string>> given) {
    StateObjectDesc desc = base;
    for (const auto& [constants, name] : given) {
      desc.Associate(desc.Add(local(t, constants)), {name});
    }
    return make(t, desc);
  };
  const auto bytes = [&](Result<StateObject> object) {
    return local_bytes(object.value(), {"group"});
  };
  t.equal("of the group", bytes(with({{3, "group"}})), Bytes{12});
  t.equal("of one shader", bytes(with({{3, "HitA"}})), Bytes{12});
  t.equal("of group and shader, equal", bytes(with({{3, "group"}, {3, "AnyA"}})), Bytes{12});
  t.refused("of group and shader, different", with({{3, "group"}, {4, "AnyA"}}), "KA0510");
  t.equal("of both shaders, equal", bytes(with({{3, "HitA"}, {3, "AnyA"}})), Bytes{12});
  t.refused("of both shaders, different", with({{3, "HitA"}, {4, "AnyA"}}), "KA0510");
}

void required_subobjects(Context& t) {
  StateObjectDesc no_shader_config;
  no_shader_config.Add(RaytracingPipelineConfig{1});
  no_shader_config.Add(states(named({"MissA"})));
  t.refused("no shader config", make(t, no_shader_config), "KA0511");
  StateObjectDesc no_pipeline_config;
  no_pipeline_config.Add(RaytracingShaderConfig{16, 8});
  no_pipeline_config.Add(states(named({"MissA"})));
  t.refused("no pipeline config", make(t, no_pipeline_config), "KA0512");

  StateObjectDesc desc = configs();
  desc.Add(states(named({"MissA", "MissB"})));
  t.accepted("no root signature where none is needed", make(t, desc));
  StateObjectDesc some = desc;
  some.Associate(0, {"MissA"});
  t.refused("a shader config for one export of two", make(t, some), "KA0511");
  some.Associate(some.Add(RaytracingShaderConfig{32, 8}), {"MissB"});
  t.refused("different shader configs", make(t, some), "KA0513");
  StateObjectDesc depths = desc;
  depths.Associate(1, {"MissA"});
  depths.Associate(depths.Add(RaytracingPipelineConfig{2}), {"MissB"});
  t.refused("different pipeline configs", make(t, depths), "KA0514");
  // The state object config is local: a collection's says nothing about the pipeline.
  StateObjectDesc outer = configs();
  outer.Add(ExistingCollectionDesc::Of(make(t, misses(t, kCollection, kAdditions)).value()));
  const auto pipeline = make(t, outer).value();
  StateObjectDesc addition = configs(kPipeline, kAdditions);
  addition.Add(states({{"MissC", "MissA"}}));
  t.refused("a flag of a collection is not the pipeline's",
            t.device().AddToStateObject(addition, pipeline), "KA0533");
}

void duplicates_and_ties(Context& t) {
  StateObjectDesc desc = misses(t);
  desc.Add(RaytracingShaderConfig{16, 8});
  desc.Add(RaytracingPipelineConfig{1});
  t.accepted("equal configs twice", make(t, desc));
  StateObjectDesc two = misses(t);
  const uint32_t other = two.Add(RaytracingPipelineConfig{7});
  t.refused("two different defaults", make(t, two));
  two.Associate(other, {});
  t.accepted("an empty association picks one", make(t, two));
  StateObjectDesc empty = misses(t);
  empty.Add(local(t, 3));
  empty.Associate(empty.Add(local(t, 5)), {});
  t.equal("an empty association beats what is in none",
          local_bytes(make(t, empty).value(), {"MissA"}), Bytes{20});
  StateObjectDesc used = misses(t);
  used.Associate(used.Add(local(t, 3)), {"MissA"});
  t.equal("what is associated by name is no default",
          local_bytes(make(t, used).value(), {"MissA", "MissB"}), Bytes{12, 0});
  StateObjectDesc several = misses(t);
  several.Add(local(t, 3));
  several.Add(local(t, 5));
  t.equal("of several none", local_bytes(make(t, several).value(), {"MissA"}), Bytes{0});
}

void missing_objects(Context& t) {
  for (const StateObjectType type : {kPipeline, kCollection}) {
    const std::string where = type == kPipeline ? " in a pipeline" : " in a collection";
    for (const size_t missing : {size_t{0}, size_t{1}, size_t{2}}) {
      StateObjectDesc desc = complete(t, named({"Start"}), type);
      desc.Subobjects.erase(desc.Subobjects.begin() + missing);
      const char* const what[] = {"shader config", "pipeline config", "root signature"};
      t.refused(std::string("no ") + what[missing] + where, make(t, desc));
    }
  }
  StateObjectDesc hlsl;
  hlsl.Add(subobjects(named({"Start", "Shaders", "Pipeline", "Global"})));
  t.accepted("all of it in HLSL", make(t, hlsl));
  for (const size_t missing : {size_t{1}, size_t{2}, size_t{3}}) {
    StateObjectDesc fewer = hlsl;
    auto& exports = std::get<DxilLibraryDesc>(fewer.Subobjects[0]).Exports;
    const std::string name = exports[missing].Name;
    exports.erase(exports.begin() + missing);
    t.refused("HLSL's " + name + " is not exported", make(t, fewer));
  }
  StateObjectDesc merely = configs();
  merely.Add(subobjects(named({"MissA", "Three", "ThreeForMissA"})));
  merely.Add(local(t, 2));
  t.equal("a local root signature that is merely declared overrides HLSL's",
          local_bytes(make(t, merely).value(), {"MissA"}), Bytes{8});
}

}  // namespace

std::vector<RuleTest> so_tests() {
  return {{"SO-01", types_of_state_objects},
          {"SO-02", refusals_say_why},
          {"SO-03", libraries_from_6_3},
          {"SO-04", export_lists},
          {"SO-05", renames},
          {"SO-06", a_library_twice},
          {"SO-07", mangled_names},
          {"SO-10", default_associations},
          {"SO-11", reach_of_defaults},
          {"SO-12", reach_of_explicit_associations},
          {"SO-13", many_associations_of_one},
          {"SO-14", two_definitions_for_one},
          {"SO-15", state_objects_override_libraries},
          {"SO-16", hit_group_associations},
          {"SO-17, ERR-25", required_subobjects},
          {"SO-18, ERR-25", duplicates_and_ties},
          {"SO-19, ERR-25", missing_objects}};
}

}  // namespace kaamos::conformance
