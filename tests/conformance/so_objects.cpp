// SPDX-License-Identifier: MIT
//
// State objects: identifiers, stack and recursion, additions.
#include <rtapi/error_ids.h>
#include <shaders/stack.h>

#include <algorithm>

#include "tests/conformance/program.h"
#include "tests/conformance/states.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using Bytes = std::vector<uint32_t>;

void which_exports_have_identifiers(Context& t) {
  for (const StateObjectType type : {kPipeline, kCollection}) {
    const std::string where = type == kPipeline ? " in a pipeline" : " in a collection";
    StateObjectDesc desc = complete(t, {}, type);
    desc.Add(triangles("group", "HitA", "AnyA"));
    const auto object = make(t, desc).value();
    for (const char* name : {"Start", "MissA", "CallA", "group"}) {
      const auto* identifier = object.GetShaderIdentifier(name);
      t.holds(name + where, identifier != nullptr);
      if (identifier == nullptr) continue;
      const ShaderIdentifier bytes = *identifier;
      t.accepted("another object", make(t, desc));
      t.holds(name + (where + ": pointer and bytes stay"),
              object.GetShaderIdentifier(name) == identifier && *identifier == bytes);
    }
    for (const char* name :
         {"HitA", "AnyA", "BoxA", "Scaled", "Nowhere", "", "GROUP", "group::closesthit"}) {
      t.holds(std::string("none for \"") + name + "\"" + where, !has(object, name));
    }
  }
}

void which_names_have_stack_sizes(Context& t) {
  StateObjectDesc desc = complete(t);
  desc.Add(triangles("group", "HitA", "AnyA"));
  HitGroupDesc boxes = triangles("boxes", "");
  boxes.Type = HitGroupType::kProceduralPrimitive;
  boxes.IntersectionShaderImport = "BoxA";
  desc.Add(boxes);
  const auto pipeline = make(t, desc).value();
  for (const char* name :
       {"Start", "MissA", "CallA", "group::closesthit", "group::anyhit", "boxes::intersection"}) {
    t.holds(std::string(name) + " has one", pipeline.GetShaderStackSize(name) < 0xFFFFFFFF);
  }
  for (const char* name : {"group", "HitA", "AnyA", "BoxA", "Nowhere", "", "group::AnyHit",
                           "group::intersection", "boxes::anyhit", "boxes::closesthit",
                           "group::", "::anyhit", "MissA::closesthit", "nogroup::anyhit"}) {
    t.equal(std::string("\"") + name + "\"", pipeline.GetShaderStackSize(name),
            uint64_t{0xFFFFFFFF});
  }
}

void stack_sizes_everywhere_the_same(Context& t) {
  StateObjectDesc one = complete(t);
  one.Add(triangles("group"));
  StateObjectDesc two = configs(kPipeline, kNoFlags, 9, 64);
  two.Add(global(t));
  two.Add(states(named({"Start", "CallA", "HitA", "AnyA"})));
  two.Add(triangles("group", "HitA", "AnyA"));
  const auto a = make(t, one).value();
  const auto b = make(t, two).value();
  for (const char* name : {"Start", "CallA", "group::closesthit"}) {
    t.equal(name, a.GetShaderStackSize(name), b.GetShaderStackSize(name));
  }
}

void default_stack_size(Context& t) {
  for (const uint32_t depth : {0u, 1u, 5u}) {
    StateObjectDesc desc = configs(kPipeline, kNoFlags, depth);
    desc.Add(global(t));
    desc.Add(states());
    HitGroupDesc boxes = triangles("boxes", "HitA", "AnyA");
    boxes.Type = HitGroupType::kProceduralPrimitive;
    boxes.IntersectionShaderImport = "BoxA";
    desc.Add(boxes);
    const auto pipeline = make(t, desc).value();
    const auto most = [&](std::initializer_list<const char*> names) {
      uint64_t out = 0;
      for (const char* name : names) out = std::max(out, pipeline.GetShaderStackSize(name));
      return out;
    };
    const uint64_t raygen = most({"Start", "Idle"});
    const uint64_t closest = most({"boxes::closesthit"});
    const uint64_t miss = most({"MissA", "MissB"});
    const uint64_t any = most({"boxes::anyhit"});
    const uint64_t intersection = most({"boxes::intersection"});
    const uint64_t callable = most({"CallA", "CallB"});
    const uint64_t first = depth > 0 ? std::max({closest, miss, intersection + any}) : 0;
    const uint64_t further = depth > 1 ? (depth - 1) * std::max(closest, miss) : 0;
    t.equal("stack of depth " + std::to_string(depth), pipeline.GetPipelineStackSize(),
            raygen + first + further + 2 * callable);
  }
}

void bad_stack_sizes_are_dropped(Context& t) {
  auto pipeline = make(t, complete(t)).value();
  t.accepted("12345", pipeline.SetPipelineStackSize(12345));
  for (const uint64_t size : {uint64_t{0xFFFFFFFF}, uint64_t{1} << 32, ~uint64_t{0}}) {
    t.refused(std::to_string(size), pipeline.SetPipelineStackSize(size), "KA0532");
    t.equal("the size stays", pipeline.GetPipelineStackSize(), uint64_t{12345});
  }
  t.accepted("0xFFFFFFFE", pipeline.SetPipelineStackSize(0xFFFFFFFE));
  t.equal("the largest", pipeline.GetPipelineStackSize(), uint64_t{0xFFFFFFFE});
  auto collection = make(t, complete(t, {}, kCollection)).value();
  t.refused("of a collection", collection.SetPipelineStackSize(4096), "KA0532");
  t.equal("Get of a collection", collection.GetPipelineStackSize(), uint64_t{0});
}

// --- stack and recursion ---

constexpr char kStackSignature[] =
    "SRV(t0), SRV(t1), UAV(u0), RootConstants(b0, num32BitConstants = 1)";

// A triangle whose hit traces again, and a callable that calls itself, as deep as the limit allows.
class Deep : public Program {
 public:
  Deep(Context& t, const std::string& raygen_shader, uint32_t declared_depth,
       const std::string& hit_shader = "HitDeep")
      : Program(t, kaamos_shaders_stack(), {}, kStackSignature), context_(t) {
    for (StateSubobject& each : desc.Subobjects) {
      if (auto* config = std::get_if<RaytracingPipelineConfig1>(&each)) {
        config->MaxTraceRecursionDepth = declared_depth;
      }
    }
    group("Deeper group", hit_shader);
    create();
    raygen(raygen_shader);
    hit("Deeper group");
    callable("Deeper");
    scene = t.scene({triangle(5)});
    words_ = t.zeros(64);
  }
  CommandList record(uint32_t limit) {
    DispatchRaysDesc dispatch = tables_without_miss();
    dispatch.Width = dispatch.Height = dispatch.Depth = 1;
    CommandList list = context_.device().CreateCommandList().value();
    list.SetComputeRootSignature(global);
    list.SetPipelineState1(pipeline);
    list.SetComputeRootShaderResourceView(0, scene.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(2, words_.GetGPUVirtualAddress());
    list.SetComputeRoot32BitConstant(3, limit, 0);
    list.DispatchRays(dispatch);
    return list;
  }
  Status execute(uint32_t limit) {
    CommandList list = record(limit);
    return context_.queue().ExecuteAndWait(list);
  }
  uint32_t result() { return context_.read(words_)[0]; }

 private:
  Context& context_;
  Buffer words_;
};

// Runs the program with so many levels on a device of its own, and checks that this removes the
// device.
void removes(Context& t, const std::string& what, const char* id, const std::string& raygen,
             uint32_t declared_depth, uint32_t limit, uint64_t stack_bytes = 0) {
  Context own(t.target());
  Deep program(own, raygen, declared_depth);
  if (stack_bytes != 0) program.pipeline.SetPipelineStackSize(stack_bytes).value();
  t.refused(what, program.execute(limit), id);
  t.refused(what + ": the device", own.device().GetDeviceRemovedReason(), id);
}

void stack_size_of_the_recording(Context& t) {
  Deep program(t, "CallDeep", 1);
  const uint64_t enough = 1 << 16;
  t.accepted("a large stack", program.pipeline.SetPipelineStackSize(enough));
  CommandList list = program.record(20);
  t.accepted("a stack of a byte", program.pipeline.SetPipelineStackSize(1));
  t.equal("Get is the latest", program.pipeline.GetPipelineStackSize(), uint64_t{1});
  t.accepted("recorded with the large one", t.queue().ExecuteAndWait(list));
  t.equal("levels plus one", program.result(), 21u);

  Context own(t.target());
  Deep other(own, "CallDeep", 1);
  other.pipeline.SetPipelineStackSize(1).value();
  CommandList small = other.record(1);
  other.pipeline.SetPipelineStackSize(enough).value();
  t.refused("recorded with the byte", own.queue().ExecuteAndWait(small), "KA0891");
}

void stack_overflow_removes(Context& t) {
  removes(t, "endless callables", "KA0891", "CallDeep", 1, ~0u, 2048);
  removes(t, "a stack of a byte", "KA0891", "CallDeep", 1, 1, 1);
}

void recursion_depth(Context& t) {
  for (const uint32_t depth : {1u, 2u, 5u}) {
    Deep program(t, "TraceDeep", depth);
    t.accepted("depth " + std::to_string(depth), program.execute(depth));
    t.equal("levels plus one", program.result(), depth + 1);
  }
  removes(t, "a closest-hit shader that traces, depth 1", "KA0890", "TraceDeep", 1, 2);
  removes(t, "one level too many, depth 5", "KA0890", "TraceDeep", 5, 6);
  removes(t, "any trace, depth 0", "KA0890", "TraceDeep", 0, 1);
  Deep none(t, "TraceDeep", 0);
  t.accepted("no trace, depth 0", none.execute(0));
  t.equal("without a trace", none.result(), 1u);
}

void callables_do_not_count(Context& t) {
  Deep program(t, "CallDeep", 1);
  t.accepted("stack", program.pipeline.SetPipelineStackSize(1 << 18));
  t.accepted("40 nested callables", program.execute(40));
  t.equal("levels plus one", program.result(), 41u);
}

void queries_do_not_count(Context& t) {
  Deep program(t, "TraceDeep", 1, "HitQuery");
  t.accepted("a query at the largest depth", program.execute(1));
  t.equal("the query's hit", program.result(), 21u);
}

// --- additions ---

StateObjectDesc parent_of(Context& t) {
  return complete(t, named({"Start", "CallA"}), kPipeline, kAdditions);
}
StateObjectDesc addition_of(std::vector<ExportDesc> exports, StateObjectFlags flags = kAdditions) {
  StateObjectDesc desc = configs(kPipeline, flags);
  desc.Add(states(std::move(exports)));
  return desc;
}

void flags_of_additions(Context& t) {
  const auto parent = make(t, parent_of(t)).value();
  const auto plain = make(t, complete(t, named({"Start", "CallA"}))).value();
  const auto collection = make(t, complete(t, named({"CallA"}), kCollection, kAdditions)).value();
  const StateObjectDesc good = addition_of(named({"CallB"}));
  const StateObjectDesc unflagged = addition_of(named({"CallB"}), kNoFlags);
  t.accepted("both flagged", t.device().AddToStateObject(good, parent));
  t.refused("to a parent without", t.device().AddToStateObject(good, plain), "KA0533");
  t.refused("an addition without", t.device().AddToStateObject(unflagged, parent), "KA0533");
  t.refused("to a collection", t.device().AddToStateObject(good, collection), "KA0533");
  StateObjectDesc as_collection = good;
  as_collection.Type = kCollection;
  t.refused("a collection as addition", t.device().AddToStateObject(as_collection, parent),
            "KA0533");
  t.refused("to nothing", t.device().AddToStateObject(good, StateObject()));
}

void additions_stand_alone(Context& t) {
  StateObjectDesc desc = complete(t, named({"Start", "CallA", "HitA"}), kPipeline, kAdditions);
  desc.Associate(desc.Add(local(t, 3)), {"CallA"});
  const auto parent = make(t, desc).value();
  StateObjectDesc import = addition_of(named({"CallB"}));
  import.Add(triangles("group", "HitA"));
  t.refused("a group of the parent's shader", t.device().AddToStateObject(import, parent),
            "KA0518");
  t.refused("a ray generation shader without the parent's root signature",
            t.device().AddToStateObject(addition_of({{"Again", "Start"}}), parent), "KA0528");
  StateObjectDesc no_configs;
  no_configs.Add(StateObjectConfig{kAdditions});
  no_configs.Add(states(named({"CallB"})));
  t.refused("without configs", t.device().AddToStateObject(no_configs, parent));
  StateObjectDesc other = addition_of(named({"CallB"}));
  other.Associate(other.Add(local(t, 2)), {"CallA"});
  t.refused("an association with the parent's export", t.device().AddToStateObject(other, parent),
            "KA0507");
  StateObjectDesc own = addition_of(named({"CallB"}));
  own.Add(local(t, 2));
  t.equal("a default of the addition",
          local_bytes(t.device().AddToStateObject(own, parent).value(), {"CallA", "CallB"}),
          Bytes{12, 8});
}

void configs_of_additions(Context& t) {
  const auto parent = make(t, parent_of(t)).value();
  const auto add = [&](uint32_t depth, uint32_t payload) {
    StateObjectDesc desc = configs(kPipeline, kAdditions, depth, payload);
    desc.Add(states(named({"CallB"})));
    return t.device().AddToStateObject(desc, parent);
  };
  t.accepted("equal configs", add(1, 16));
  t.refused("another depth", add(2, 16), "KA0534");
  t.refused("another payload", add(1, 32), "KA0534");
}

void names_of_additions(Context& t) {
  StateObjectDesc desc =
      complete(t, named({"Start", "CallA", "HitA", "Scaled"}), kPipeline, kAdditions);
  desc.Add(triangles("group"));
  const auto parent = make(t, desc).value();
  const auto add = [&](std::vector<ExportDesc> exports, const char* group = nullptr) {
    StateObjectDesc addition = addition_of(std::move(exports));
    if (group != nullptr) addition.Add(triangles(group, "HitB"));
    return t.device().AddToStateObject(addition, parent);
  };
  t.refused("a callable of the parent's", add(named({"CallA"})), "KA0535");
  t.refused("another one under its name", add({{"CallA", "CallB"}}), "KA0535");
  t.refused("a closest-hit shader of the parent's", add(named({"HitA"})), "KA0535");
  t.refused("a group of the parent's name", add({{"HitB", "HitA"}}, "group"), "KA0535");
  t.accepted("new names", add({{"HitB", "HitA"}, {"CallB", ""}}, "other"));
  t.accepted("a function that is no entry point again", add(named({"Scaled", "CallB"})));
}

void what_an_addition_shows(Context& t) {
  const auto parent = make(t, parent_of(t)).value();
  const auto add = [&](const StateObject& to, const char* name) {
    return t.device().AddToStateObject(addition_of({{name, "CallB"}}), to).value();
  };
  const auto left = add(parent, "Left");
  const auto right = add(parent, "Right");
  const auto deep = add(left, "Deep");
  t.holds("the parent has no more than before",
          !has(parent, "Left") && !has(parent, "Right") && !has(parent, "Deep"));
  t.holds("one child", has(left, "CallA") && has(left, "Left") && !has(left, "Right"));
  t.holds("the other child", has(right, "CallA") && has(right, "Right") && !has(right, "Left"));
  t.holds("a grandchild",
          has(deep, "CallA") && has(deep, "Left") && has(deep, "Deep") && !has(deep, "Right"));
  for (const char* name : {"Start", "CallA"}) {
    t.holds(std::string("the identifier of ") + name + " stays",
            *parent.GetShaderIdentifier(name) == *deep.GetShaderIdentifier(name));
  }
  t.equal("answers of a grandchild", call(t, deep, {"CallA", "Deep"}), Bytes{1, 2});
  t.equal("answers of the parent", call(t, parent, {"CallA", "CallA"}), Bytes{1, 1});
}

void stack_size_of_additions(Context& t) {
  auto parent = make(t, parent_of(t)).value();
  parent.SetPipelineStackSize(54321).value();
  auto child = t.device().AddToStateObject(addition_of(named({"CallB"})), parent).value();
  t.equal("the parent's", child.GetPipelineStackSize(), uint64_t{54321});
  child.SetPipelineStackSize(60000).value();
  t.equal("the parent's afterwards", parent.GetPipelineStackSize(), uint64_t{54321});
}

// Our policy for identifiers that a pipeline does not know: nothing runs, and a message says so.
void new_identifiers_through_older_objects(Context& t) {
  DeviceDesc desc = t.target().device_desc();
  std::vector<ErrorId> ids;
  desc.OnMessage = [&](const Message& message) { ids.push_back(message.Id); };
  Context own(desc, t.target());
  const auto parent = make(own, parent_of(own)).value();
  const auto child = own.device().AddToStateObject(addition_of(named({"CallB"})), parent).value();
  const auto answers = call(own, parent, {"CallA", "CallB"}, &child);
  t.equal("answers through the parent", answers, Bytes{1, 77});
  t.holds("the message KA0896", std::ranges::count(ids, error_ids::backend::kRecordUnknown) > 0);
  t.equal("answers through the child", call(own, child, {"CallA", "CallB"}), Bytes{1, 2});
}

void parents_may_go(Context& t) {
  StateObject child;
  CommandList list;
  {
    StateObject parent = make(t, parent_of(t)).value();
    t.equal("the parent in use", call(t, parent, {"CallA", "CallA"}), Bytes{1, 1});
    child = t.device().AddToStateObject(addition_of(named({"CallB"})), parent).value();
    t.equal("the parent in use afterwards", call(t, parent, {"CallA", "CallA"}), Bytes{1, 1});
  }
  t.equal("answers without the parent", call(t, child, {"CallB", "CallA"}), Bytes{2, 1});
}

void one_pipeline_at_a_time(Context& t) {
  const auto collection = make(t, complete(t, {}, kCollection)).value();
  CommandList list = t.device().CreateCommandList().value();
  list.SetPipelineState1(collection);
  t.refused("SetPipelineState1 of a collection", list.Close(), "KA0811");
  CommandList empty = t.device().CreateCommandList().value();
  empty.SetPipelineState1(StateObject());
  t.refused("SetPipelineState1 of nothing", empty.Close());
  // The last pipeline set is the one that runs.
  Deep one(t, "CallDeep", 1);
  Deep other(t, "TraceDeep", 1);
  DispatchRaysDesc dispatch = one.tables();
  dispatch.Width = dispatch.Height = dispatch.Depth = 1;
  const Buffer words = t.zeros(64);
  CommandList last = t.device().CreateCommandList().value();
  last.SetComputeRootSignature(one.global);
  last.SetPipelineState1(other.pipeline);
  last.SetPipelineState1(one.pipeline);
  last.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
  last.SetComputeRoot32BitConstant(3, 2, 0);
  last.DispatchRays(dispatch);
  t.accepted("the pipeline that was set last", t.queue().ExecuteAndWait(last));
  t.equal("levels plus one", t.read(words)[0], 3u);
}

}  // namespace

std::vector<RuleTest> so_object_tests() {
  return {{"SO-40", which_exports_have_identifiers},
          {"SO-41", which_names_have_stack_sizes},
          {"SO-42", stack_sizes_everywhere_the_same},
          {"SO-43", default_stack_size},
          {"SO-44", bad_stack_sizes_are_dropped},
          {"SO-45", stack_size_of_the_recording},
          {"SO-46, ERR-02", stack_overflow_removes},
          {"SO-47", recursion_depth},
          {"SO-48", callables_do_not_count},
          {"SO-49", queries_do_not_count},
          {"SO-60, ERR-26", flags_of_additions},
          {"SO-61, ERR-26", additions_stand_alone},
          {"SO-62, ERR-26", configs_of_additions},
          {"SO-63, ERR-26", names_of_additions},
          {"SO-64", what_an_addition_shows},
          {"SO-65", stack_size_of_additions},
          {"SO-66", new_identifiers_through_older_objects},
          {"SO-67", parents_may_go},
          {"SO-70", one_pipeline_at_a_time}};
}

}  // namespace kaamos::conformance
