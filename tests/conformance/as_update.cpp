// SPDX-License-Identifier: MIT
//
// Acceleration structures: build flags, and updates.
#include <algorithm>

#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr BuildFlags kUpdatable = BuildFlags::kAllowUpdate;

// Runs a command that removes the device on a device of its own.
void refused_apart(Context& t, const std::string& what, const std::function<Status(Context&)>& work,
                   const char* id = "KA0793") {
  Context own(t.target());
  t.refused(what, work(own), id);
  for (const std::string& failure : own.failures()) t.fail(what + ": " + failure);
}

// Builds `first`, updates it to `changed`, and returns the status of the update.
Status updated_to(Context& t, const Inputs& first, const Inputs& changed) {
  const Buffer memory = build_new(t, first);
  return update(t, changed, memory, memory);
}

void combinations_of_build_flags(Context& t) {
  const auto expected = picture_of_bottom(t, t.bottom_level(meadow()));
  for (uint32_t bits = 0; bits < 64; ++bits) {
    const auto flags = static_cast<BuildFlags>(bits);
    const std::string what = "flags " + std::to_string(bits);
    Inputs inputs = bottom_inputs(t, meadow(), flags & ~BuildFlags::kPerformUpdate);
    const Inputs top = top_inputs(t, {}, inputs.flags);
    if ((bits & 12) == 12) {
      t.refused(what, t.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs.desc()),
                "KA0701");
      t.refused(what + ", top level",
                t.device().GetRaytracingAccelerationStructurePrebuildInfo(top.desc()), "KA0701");
      continue;
    }
    const bool updates = HasAny(flags, BuildFlags::kPerformUpdate);
    if (updates) inputs.flags = inputs.flags | kUpdatable;  // the source of an update needs it
    const Buffer memory = build_new(t, inputs);
    if (updates) {
      inputs.flags = flags;
      t.accepted(what, update(t, inputs, memory, memory));
    }
    same_picture(t, what, picture_of_bottom(t, memory), expected);
  }
  const Inputs undefined = bottom_inputs(t, {triangle(5)}, static_cast<BuildFlags>(0x1000));
  t.refused("an undefined flag",
            t.device().GetRaytracingAccelerationStructurePrebuildInfo(undefined.desc()));
}

void allow_update_is_not_gained(Context& t) {
  for (const bool top : {false, true}) {
    const auto inputs = [top](Context& c, BuildFlags flags) {
      return top ? top_inputs(c, {instance(c.bottom_level({triangle(5)}))}, flags)
                 : bottom_inputs(c, {triangle(5)}, flags);
    };
    const Buffer a = build_new(t, inputs(t, kUpdatable));
    const Inputs kept = inputs(t, kUpdatable), dropped = inputs(t, BuildFlags::kNone);
    const Buffer b = memory_for(t, kept), c = memory_for(t, kept);
    t.accepted("an update that keeps ALLOW_UPDATE", update(t, kept, b, a));
    t.accepted("an update of that", update(t, kept, c, b));
    t.accepted("an update that drops ALLOW_UPDATE", update(t, dropped, b, a));
    for (const auto last : {BuildFlags::kNone, kUpdatable}) {
      refused_apart(t, "an update of what dropped it", [&](Context& own) {
        const Buffer source = build_new(own, inputs(own, kUpdatable));
        const Buffer without = memory_for(own, inputs(own, kUpdatable));
        update(own, inputs(own, BuildFlags::kNone), without, source).value();
        return update(own, inputs(own, last), memory_for(own, inputs(own, kUpdatable)), without);
      });
    }
  }
}

void updates_need_a_source(Context& t) {
  for (const auto flags : {BuildFlags::kNone, kUpdatable}) {
    refused_apart(t, "an update of what was built without ALLOW_UPDATE", [&](Context& own) {
      return updated_to(own, bottom_inputs(own, {triangle(5)}),
                        bottom_inputs(own, {triangle(5)}, flags));
    });
    refused_apart(t, "an update of a top level without it", [&](Context& own) {
      const auto instances = std::vector{instance(own.bottom_level({triangle(5)}))};
      return updated_to(own, top_inputs(own, instances), top_inputs(own, instances, flags));
    });
  }
  refused_apart(t, "an update of a bottom level to a top level", [](Context& own) {
    return updated_to(own, bottom_inputs(own, {triangle(5)}, kUpdatable),
                      top_inputs(own, {RaytracingInstanceDesc{}}, kUpdatable));
  });
  refused_apart(t, "an update of what was never built", [](Context& own) {
    const Inputs inputs = bottom_inputs(own, {triangle(5)}, kUpdatable);
    const Buffer memory = memory_for(own, inputs);
    return update(own, inputs, memory, memory);
  });
  const Inputs inputs = bottom_inputs(t, {triangle(5)}, kUpdatable);
  const Buffer source = build_new(t, inputs), dest = memory_for(t, inputs);
  t.refused("a source without PERFORM_UPDATE", build(t, inputs, dest, source), "KA0714");
  t.refused("PERFORM_UPDATE without a source", update(t, inputs, dest, {}));
}

void other_flags_stay(Context& t) {
  for (const bool top : {false, true}) {
    const auto inputs = [top](Context& c, BuildFlags flags) {
      return top ? top_inputs(c, {instance(c.bottom_level({triangle(5)}))}, flags)
                 : bottom_inputs(c, {triangle(5)}, flags);
    };
    const std::pair<BuildFlags, BuildFlags> changes[] = {
        {kUpdatable, kUpdatable | BuildFlags::kPreferFastTrace},
        {kUpdatable | BuildFlags::kPreferFastTrace, kUpdatable},
        {kUpdatable | BuildFlags::kPreferFastTrace, kUpdatable | BuildFlags::kPreferFastBuild},
        {kUpdatable, kUpdatable | BuildFlags::kMinimizeMemory},
        {kUpdatable | BuildFlags::kAllowCompaction, kUpdatable}};
    for (const auto& [before, after] : changes) {
      refused_apart(t,
                    std::string(top ? "top" : "bottom") + " level, from flags " +
                        std::to_string(static_cast<uint32_t>(before)) + " to " +
                        std::to_string(static_cast<uint32_t>(after)),
                    [&, from = before, to = after](Context& own) {
                      return updated_to(own, inputs(own, from), inputs(own, to));
                    });
    }
    const BuildFlags all = kUpdatable | BuildFlags::kPreferFastTrace | BuildFlags::kAllowCompaction;
    t.accepted("the same flags", updated_to(t, inputs(t, all), inputs(t, all)));
  }
}

void compaction_is_not_gained(Context& t) {
  for (const bool top : {false, true}) {
    const auto inputs = [top](Context& c, BuildFlags flags) {
      return top ? top_inputs(c, {instance(c.bottom_level({triangle(5)}))}, flags)
                 : bottom_inputs(c, {triangle(5)}, flags);
    };
    refused_apart(t, "ALLOW_COMPACTION that the source had not", [&](Context& own) {
      return updated_to(own, inputs(own, kUpdatable),
                        inputs(own, kUpdatable | BuildFlags::kAllowCompaction));
    });
  }
}

void in_place_and_elsewhere(Context& t) {
  const Inputs first = bottom_inputs(t, meadow(), kUpdatable);
  Inputs second = bottom_inputs(t, meadow(2), kUpdatable);
  const auto near = picture_of_bottom(t, t.bottom_level(meadow()));
  const auto far = picture_of_bottom(t, t.bottom_level(meadow(2)));
  t.holds("the two look different", differ(near, far));
  const Buffer source = build_new(t, first), other = memory_for(t, first);
  t.accepted("elsewhere", update(t, second, other, source));
  same_picture(t, "the source", picture_of_bottom(t, source), near);
  same_picture(t, "the result elsewhere", picture_of_bottom(t, other), far);
  t.accepted("in place", update(t, second, source, source));
  same_picture(t, "the result in place", picture_of_bottom(t, source), far);
  t.accepted("back, from elsewhere to the source", update(t, first, source, other));
  same_picture(t, "the result there", picture_of_bottom(t, source), near);
  same_picture(t, "where it came from", picture_of_bottom(t, other), far);

  for (const bool after : {true, false}) {
    refused_apart(t, "a result that overlaps its source", [after](Context& own) {
      const Inputs inputs = bottom_inputs(own, {triangle(5)}, kUpdatable);
      const Buffer memory =
          own.structure_memory(4 * sizes_of(own, inputs).ResultDataMaxSizeInBytes);
      const GpuVirtualAddress at = memory.GetGPUVirtualAddress() + 256;
      const auto build_at = [&](const Inputs& what, GpuVirtualAddress dest,
                                GpuVirtualAddress source_at) {
        const auto desc = build_desc(own, what, dest, source_at);
        return execute(own,
                       [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc); });
      };
      build_at(inputs, at, 0).value();
      Inputs updates = inputs;
      updates.flags = updates.flags | BuildFlags::kPerformUpdate;
      return build_at(updates, after ? at + 256 : at - 256, at);
    });
  }
}

void updates_take_the_sources_memory(Context& t) {
  const BuildFlags flags = kUpdatable | BuildFlags::kAllowCompaction;
  Geometry many;
  for (int i = 0; i < 400; ++i) {
    const Geometry one = triangle(50, 10 * static_cast<float>(i));
    many.vertices.insert(many.vertices.end(), one.vertices.begin(), one.vertices.end());
  }
  Inputs inputs = bottom_inputs(t, {many}, flags);
  const Buffer compact = copy_new(t, build_new(t, inputs), CopyMode::kCompact);
  for (float& z : many.vertices) z = z == 50 ? 70 : z;
  inputs.geometries = t.describe({many});
  const uint64_t bytes = info_of(t, compact, InfoType::kCurrentSize)[0];
  t.equal("bytes of the compacted structure", compact.size(), bytes);
  const Buffer other = t.structure_memory(bytes);
  t.accepted("into as much memory", update(t, inputs, other, compact));
  t.close("t there", t_of_bottom(t, other), 70, 1e-2f);
  t.close("t of the source", t_of_bottom(t, compact), 50, 1e-2f);
  t.accepted("in place", update(t, inputs, compact, compact));
  t.close("t in place", t_of_bottom(t, compact), 70, 1e-2f);
}

void chained_updates(Context& t) {
  Inputs inputs = bottom_inputs(t, meadow(), kUpdatable);
  const Buffer first = build_new(t, inputs), second = memory_for(t, inputs);
  // Alternates between two sets of inputs, so that each update changes something; the second comes
  // last.
  auto updating = inputs;
  updating.flags = kUpdatable | BuildFlags::kPerformUpdate;
  const std::vector<RaytracingGeometryDesc> sets[] = {t.describe(meadow(3)), t.describe(meadow(1))};
  const uint64_t places[] = {first.GetGPUVirtualAddress(), second.GetGPUVirtualAddress()};
  auto desc = build_desc(t, updating, places[1], places[0]);
  CommandList list = t.device().CreateCommandList().value();
  for (int i = 0; i < 1000; ++i) {
    updating.geometries = sets[i % 2];
    desc.Inputs = updating.desc();
    desc.SourceAccelerationStructureData = places[i % 2];
    desc.DestAccelerationStructureData = places[(i + 1) % 2];
    list.BuildRaytracingAccelerationStructure(desc);
    list.ResourceBarrier(ResourceBarrier::Uav());
  }
  t.accepted("1000 updates", t.queue().ExecuteAndWait(list));
  same_picture(t, "after 1000 updates", picture_of_bottom(t, first),
               picture_of_bottom(t, t.bottom_level(meadow(1))));
  same_picture(t, "after 999", picture_of_bottom(t, second),
               picture_of_bottom(t, t.bottom_level(meadow(3))));
}

void preferences_change_no_hits(Context& t) {
  const auto expected = picture_of_bottom(t, t.bottom_level(meadow()));
  for (const auto flags :
       {BuildFlags::kPreferFastTrace, BuildFlags::kPreferFastBuild, BuildFlags::kMinimizeMemory,
        BuildFlags::kPreferFastBuild | BuildFlags::kMinimizeMemory}) {
    const Buffer bottom = build_new(t, bottom_inputs(t, meadow(), flags));
    same_picture(t, "flags " + std::to_string(static_cast<uint32_t>(flags)),
                 picture(t, build_new(t, top_inputs(t, {instance(bottom)}, flags))), expected);
  }
}

void updates_of_triangles(Context& t) {
  const Inputs first = bottom_inputs(t, meadow(), kUpdatable);
  auto moved = meadow(1.5f);
  moved[1].transform = {1.2f, 0, 0, -0.3f, 0, 0.8f, 0.1f, 0, 0, 0, 1, 1};
  const Inputs second = bottom_inputs(t, moved, kUpdatable);
  const Buffer memory = build_new(t, first);
  t.accepted("new vertices and a new transform", update(t, second, memory, memory));
  same_picture(t, "after it", picture_of_bottom(t, memory),
               picture_of_bottom(t, t.bottom_level(moved)));
  auto without = meadow();
  without[1].transform.clear();
  refused_apart(t, "a transform that becomes NULL", [&](Context& own) {
    return updated_to(own, bottom_inputs(own, meadow(), kUpdatable),
                      bottom_inputs(own, without, kUpdatable));
  });
  refused_apart(t, "a transform that was NULL", [&](Context& own) {
    return updated_to(own, bottom_inputs(own, without, kUpdatable),
                      bottom_inputs(own, meadow(), kUpdatable));
  });
}

void updates_of_boxes(Context& t) {
  // The boxes move in from far away and from each other's places.
  auto before = boxes();
  std::swap(before[0].boxes[0], before[0].boxes[1]);
  before[1] = box(11, 4000);
  const Buffer memory = build_new(t, bottom_inputs(t, before, kUpdatable));
  const Buffer scene = t.top_level({instance(memory)});
  t.holds("the third box is met where it was", (boxes_met(t, scene, 4000) & 0x100) != 0);
  t.accepted("moved boxes", update(t, bottom_inputs(t, boxes(), kUpdatable), memory, memory));
  meets_boxes(t, "after it", t.top_level({instance(memory)}));
}

// Our policy: changes that the descs reveal are refused; changed indices are ignored in favour of
// the build's.
void what_updates_may_not_change(Context& t) {
  const auto check = [&](const char* what, const std::function<void(Context&, Inputs&)>& change) {
    refused_apart(t, what, [&](Context& own) {
      Inputs inputs = bottom_inputs(own, meadow(), kUpdatable);
      for (auto& each : inputs.geometries) {
        std::vector<uint32_t> indices(each.Triangles.VertexCount);
        for (uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
        each.Triangles.IndexFormat = Format::kR32Uint;
        each.Triangles.IndexCount = each.Triangles.VertexCount;
        each.Triangles.IndexBuffer = own.upload(indices).GetGPUVirtualAddress();
      }
      Inputs changed = inputs;
      change(own, changed);
      return updated_to(own, inputs, changed);
    });
  };
  check("fewer indices", [](Context&, Inputs& in) { in.geometries[0].Triangles.IndexCount -= 3; });
  check("fewer vertices",
        [](Context&, Inputs& in) { in.geometries[0].Triangles.VertexCount -= 3; });
  check("16-bit indices",
        [](Context&, Inputs& in) { in.geometries[0].Triangles.IndexFormat = Format::kR16Uint; });
  check("another vertex format", [](Context&, Inputs& in) {
    in.geometries[0].Triangles.VertexFormat = Format::kR32G32Float;
  });
  check("other flags",
        [](Context&, Inputs& in) { in.geometries[0].Flags = RaytracingGeometryFlags::kNone; });
  check("fewer geometries", [](Context&, Inputs& in) { in.geometries.pop_back(); });
  check("geometries in another order",
        [](Context&, Inputs& in) { std::swap(in.geometries[0], in.geometries[1]); });
  check("boxes", [](Context& own, Inputs& in) { in.geometries = own.describe({box(5), box(6)}); });

  Inputs indexed = bottom_inputs(t, {triangle(5)}, kUpdatable);
  auto& desc = indexed.geometries[0].Triangles;
  const Buffer indices = t.upload(std::vector<uint32_t>{0, 1, 2});
  desc.IndexFormat = Format::kR32Uint;
  desc.IndexCount = 3;
  desc.IndexBuffer = indices.GetGPUVirtualAddress();
  const Buffer memory = build_new(t, indexed);
  overwrite(indices, std::vector<uint32_t>{2, 2, 2});
  t.accepted("an update with other indices", update(t, indexed, memory, memory));
  t.close("t after it", t_of_bottom(t, memory), 5, 1e-3f);
}

void inputs_at_other_addresses(Context& t) {
  const Buffer memory = build_new(t, bottom_inputs(t, meadow(), kUpdatable));
  // New buffers for everything; the build's buffers hold other data by then.
  t.accepted("the update", update(t, bottom_inputs(t, meadow(1), kUpdatable), memory, memory));
  same_picture(t, "after it", picture_of_bottom(t, memory),
               picture_of_bottom(t, t.bottom_level(meadow(1))));
}

void instances_may_be_redefined(Context& t) {
  const Buffer a = t.bottom_level(meadow()), b = t.bottom_level({meadow(1)[0]});
  std::vector<RaytracingInstanceDesc> before = {instance(a), instance(b, 2, 1), instance(a, 30)};
  std::vector<RaytracingInstanceDesc> after = {instance(b, -1, 2), instance(a, 40), instance(a, 1)};
  after[0].InstanceID = 99;
  after[0].Flags = static_cast<uint32_t>(RaytracingInstanceFlags::kForceOpaque);
  after[2].InstanceMask = 1;
  after[2].InstanceID = 17;
  after[2].InstanceContributionToHitGroupIndex = 1;
  after[2].Transform[2][3] = 1;
  after[2].Flags = static_cast<uint32_t>(RaytracingInstanceFlags::kTriangleFrontCounterclockwise);
  const Buffer scene = build_new(t, top_inputs(t, before, kUpdatable));
  const auto expected = picture(t, t.top_level(after));
  t.holds("the two look different", differ(picture(t, scene), expected));
  t.accepted("an update of everything", update(t, top_inputs(t, after, kUpdatable), scene, scene));
  same_picture(t, "after it", picture(t, scene), expected);
  after.pop_back();
  refused_apart(t, "another number of instances", [&](Context& own) {
    const Buffer bottom = own.bottom_level({triangle(5)});
    return updated_to(own, top_inputs(own, {instance(bottom), instance(bottom)}, kUpdatable),
                      top_inputs(own, {instance(bottom)}, kUpdatable));
  });
}

void instances_may_be_activated(Context& t) {
  const Buffer bottom = t.bottom_level(meadow());
  const RaytracingInstanceDesc inactive, active = instance(bottom);
  const Buffer scene = build_new(t, top_inputs(t, {inactive, active}, kUpdatable));
  t.accepted("an update that swaps activity",
             update(t, top_inputs(t, {active, inactive}, kUpdatable), scene, scene));
  same_picture(t, "after it", picture(t, scene), picture(t, t.top_level({active, inactive})));
  t.accepted("an update to none",
             update(t, top_inputs(t, {inactive, inactive}, kUpdatable), scene, scene));
  t.equal("t of none", t_of_top(t, scene), -1.0f);
}

}  // namespace

std::vector<RuleTest> as_update_tests() {
  return {{"AS-50", combinations_of_build_flags},
          {"AS-51", allow_update_is_not_gained},
          {"AS-52", updates_need_a_source},
          {"AS-53", other_flags_stay},
          {"AS-54", compaction_is_not_gained},
          {"AS-55", in_place_and_elsewhere},
          {"AS-56", updates_take_the_sources_memory},
          {"AS-57", chained_updates},
          {"AS-58", preferences_change_no_hits},
          {"AS-60", updates_of_triangles},
          {"AS-61", updates_of_boxes},
          {"AS-62", what_updates_may_not_change, "KA0470"},
          {"AS-63", inputs_at_other_addresses},
          {"AS-64", instances_may_be_redefined},
          {"AS-65", instances_may_be_activated}};
}

}  // namespace kaamos::conformance
