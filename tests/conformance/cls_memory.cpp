// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: arguments and results of operations on clusters in GPU memory.
#include <algorithm>
#include <random>
#include <string>
#include <utility>

#include "tests/conformance/cls.h"

namespace kaamos::conformance::cls {

namespace {

using Words = std::vector<uint64_t>;
using Resolution = RtasOperationAddressResolutionFlags;

std::vector<ClusterArgs> row_of_clusters(Context& t, uint32_t count) {
  std::vector<ClusterArgs> all;
  for (uint32_t i = 0; i < count; ++i) {
    all.push_back(
        cluster(t, triangle(static_cast<float>(5 + i), 10.f * static_cast<float>(i)), 0, i));
  }
  return all;
}

// What a top level of these clusters shows at 0, 10, 20, ...
void shows(Context& t, const std::string& what, Words clusters, const std::vector<float>& depths) {
  std::vector<float> places;
  for (size_t i = 0; i < depths.size(); ++i) places.push_back(10.f * static_cast<float>(i));
  t.distance(what, depths_at(t, top_of(t, level_of(t, clusters)), places), depths);
}

void counts(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Buffer args = t.upload(row_of_clusters(t, 5));
  const TrianglesDesc desc = triangles_desc(5);
  for (const uint32_t counter : {0u, 3u, 100u}) {
    Batch batch = batch_of(t, inputs_of(desc), args, 8);
    batch.data.IndirectArgumentArraySize =
        t.upload(std::vector<uint32_t>{counter}).GetGPUVirtualAddress();
    t.accepted("a build", run(t, inputs_of(desc), batch));
    const uint32_t expected = std::min(counter, 5u);
    const Words addresses = addresses_in(t, batch);
    const Words sizes = sizes_in(t, batch);
    const auto written = [](uint64_t word) { return word != kUntouched; };
    t.equal("addresses of " + std::to_string(counter),
            std::count_if(addresses.begin(), addresses.end(), written), expected);
    t.equal("sizes of " + std::to_string(counter),
            std::count_if(sizes.begin(), sizes.end(), written), expected);
    t.holds("the first ones", addresses[expected] == kUntouched && sizes[expected] == kUntouched);
  }
  Batch all = batch_of(t, inputs_of(desc), args, 8);
  t.accepted("without a counter", run(t, inputs_of(desc), all));
  Words addresses = addresses_in(t, all);
  addresses.resize(5);
  own.noted("counts", "");
  shows(t, "all five", addresses, {5, 6, 7, 8, 9});
  all.data.IndirectArgumentArraySize =
      t.upload(std::vector<uint32_t>{2, 2}).GetGPUVirtualAddress() + 2;
  t.refused("an odd counter",
            record(t, [&](CommandList& l) { add_operation(l, inputs_of(desc), all); }), "KA0749");
}

void strides(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  struct Padded {
    ClusterArgs args;
    uint64_t padding = ~uint64_t{0};
  };
  std::vector<Padded> padded;
  for (const ClusterArgs& each : row_of_clusters(t, 3)) padded.push_back({each});
  const TrianglesDesc desc = triangles_desc(3);
  Batch batch = batch_of(t, inputs_of(desc), t.upload(padded));
  batch.data.IndirectArgumentArray.StrideInBytes = sizeof(Padded);
  batch.data.ResultAddressArray.StrideInBytes = 24;
  batch.data.ResultSizeArray.StrideInBytes = 16;
  t.accepted("strides", run(t, inputs_of(desc), batch));
  const Words addresses = addresses_in(t, batch);
  const Words sizes = sizes_in(t, batch);
  for (const size_t between : {1u, 2u, 4u, 5u}) {
    t.equal("between addresses", addresses[between], kUntouched);
  }
  t.holds("between sizes", sizes[1] == kUntouched && sizes[3] == kUntouched);
  own.noted("strides", "");
  shows(t, "with strides", {addresses[0], addresses[3], addresses[6]}, {5, 6, 7});
  const auto refused = [&](const char* what, auto change) {
    Batch bad = batch;
    change(bad.data);
    t.refused(what, record(t, [&](CommandList& l) { add_operation(l, inputs_of(desc), bad); }),
              "KA0749");
  };
  refused("arguments' stride", [](auto& d) { d.IndirectArgumentArray.StrideInBytes = 84; });
  refused("addresses' stride", [](auto& d) { d.ResultAddressArray.StrideInBytes = 12; });
  refused("sizes' stride", [](auto& d) { d.ResultSizeArray.StrideInBytes = 4; });
  refused("arguments' address", [](auto& d) { d.IndirectArgumentArray.StartAddress += 4; });
  refused("results' address", [](auto& d) { d.BatchResultData += 64; });
  refused("no results", [](auto& d) { d.BatchResultData = 0; });
  refused("scratch", [](auto& d) { d.BatchScratchData += 16; });
  refused("no scratch", [](auto& d) { d.BatchScratchData = 0; });
  refused("undefined resolution",
          [](auto& d) { d.AddressResolutionFlags = static_cast<Resolution>(0x40); });
}

void implicit(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const TrianglesDesc desc = triangles_desc(5);
  Batch batch = batch_of(t, inputs_of(desc), t.upload(row_of_clusters(t, 5)));
  t.accepted("a build", run(t, inputs_of(desc), batch));
  Words addresses = addresses_in(t, batch);
  const Words sizes = sizes_in(t, batch);
  const uint64_t first = batch.memory.GetGPUVirtualAddress();
  const uint64_t total =
      t.device().GetRTASOperationPrebuildInfo(inputs_of(desc)).ResultDataMaxSizeInBytes;
  for (int i = 0; i < 5; ++i) {
    t.equal("alignment", addresses[i] % kRtasClasByteAlignment, 0u);
    t.equal("size", sizes[i] % kRtasClasByteAlignment, 0u);
    t.holds("inside", addresses[i] >= first && addresses[i] + sizes[i] <= first + total);
    for (int k = 0; k < i; ++k) {
      t.holds("disjoint",
              addresses[k] + sizes[k] <= addresses[i] || addresses[i] + sizes[i] <= addresses[k]);
    }
  }
  batch.data.ResultAddressArray = {};
  batch.data.ResultSizeArray = {};
  t.accepted("without arrays", run(t, inputs_of(desc), batch));
  own.noted("all of it", "");
}

void explicit_ones(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  TrianglesDesc desc = triangles_desc(3);
  desc.Mode = Mode::kExplicitDestinations;
  const auto in = inputs_of(desc);
  const uint64_t each = t.device().GetRTASOperationPrebuildInfo(in).ResultDataMaxSizeInBytes;
  const uint64_t memory = t.structure_memory(4 * each).GetGPUVirtualAddress();
  Batch batch = batch_of(t, in, t.upload(row_of_clusters(t, 3)));
  batch.data.BatchResultData = 0;
  const auto build_at = [&](const Words& addresses) {
    batch.data.ResultAddressArray = {t.upload(addresses).GetGPUVirtualAddress(), 0};
    t.accepted("a build", run(t, in, batch));
  };
  build_at({memory + 2 * each, memory, memory + each});
  own.noted("anywhere", "");
  shows(t, "anywhere", {memory + 2 * each, memory, memory + each}, {5, 6, 7});
  build_at({memory + 2 * each, 0, memory + each});
  own.noted("nowhere", "argument 1");
  t.equal("its size", sizes_in(t, batch)[1], 0u);
  build_at({memory + 64, memory + each, memory + 2 * each});
  own.noted("misaligned", "multiple of 128");
  build_at({memory, memory + 128, memory + 2 * each});
  own.noted("overlapping", "overlap");
  build_at({memory, memory + each, memory + 4 * each - 128});
  own.noted("at the end", "argument 2");
  build_at({memory, memory + each, t.zeros(1 << 16).GetGPUVirtualAddress()});
  own.noted("in a plain buffer", "argument 2");
  batch.data.ResultAddressArray = {};
  t.refused("no addresses", record(t, [&](CommandList& l) { add_operation(l, in, batch); }),
            "KA0749");
}

void only_sizes(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  TrianglesDesc desc = triangles_desc(3);
  const Buffer args = t.upload(row_of_clusters(t, 3));
  const Batch built = batch_of(t, inputs_of(desc), args);
  t.accepted("a build", run(t, inputs_of(desc), built));
  desc.Mode = Mode::kGetSizes;
  t.equal("prebuild",
          t.device().GetRTASOperationPrebuildInfo(inputs_of(desc)).ResultDataMaxSizeInBytes, 0u);
  Batch batch = batch_of(t, inputs_of(desc), args);
  batch.data.BatchResultData = 0;
  t.accepted("sizes", run(t, inputs_of(desc), batch));
  t.equal("addresses", addresses_in(t, batch)[0], kUntouched);
  const Words sizes = sizes_in(t, batch);
  std::vector<ClusterArgs> without = row_of_clusters(t, 3);
  for (auto& each : without) each.VertexBuffer = each.IndexBuffer = 0;
  Batch bare = batch_of(t, inputs_of(desc), t.upload(without));
  t.accepted("sizes without vertices", run(t, inputs_of(desc), bare));
  for (int i = 0; i < 3; ++i) {
    t.holds("the final size is no larger", sizes_in(t, built)[i] <= sizes[i]);
    t.holds("without vertices it is no smaller", sizes_in(t, bare)[i] >= sizes[i]);
  }
  own.noted("all of it", "");
  batch.data.ResultSizeArray = {};
  t.refused("nowhere to write",
            record(t, [&](CommandList& l) { add_operation(l, inputs_of(desc), batch); }), "KA0749");
}

void prebuild_sizes(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto size_of = [&](const TrianglesDesc& desc) {
    return t.device().GetRTASOperationPrebuildInfo(inputs_of(desc)).ResultDataMaxSizeInBytes;
  };
  std::mt19937 random(5);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  for (int i = 0; i < 50; ++i) {
    TrianglesDesc a = triangles_desc(1 + below(100));
    a.Limits.MaxTotalTriangleCount = below(20000);
    a.Limits.MaxTotalVertexCount = below(20000);
    TrianglesDesc b = a;
    b.Limits.MaxArgCount = 1 + below(100);
    b.Limits.MaxTotalTriangleCount = below(20000);
    TrianglesDesc both = a;
    both.Limits.MaxArgCount += b.Limits.MaxArgCount;
    both.Limits.MaxTotalTriangleCount += b.Limits.MaxTotalTriangleCount;
    both.Limits.MaxTotalVertexCount += b.Limits.MaxTotalVertexCount;
    t.holds("two batches fit one of both", size_of(a) + size_of(b) <= size_of(both));
  }
  const TrianglesDesc base = triangles_desc(20);
  for (uint32_t RtasClusterLimits::*field :
       {&RtasClusterLimits::MaxArgCount, &RtasClusterLimits::MaxTriangleCountPerCluster,
        &RtasClusterLimits::MaxVertexCountPerCluster, &RtasClusterLimits::MaxTotalTriangleCount,
        &RtasClusterLimits::MaxTotalVertexCount}) {
    for (const Mode mode : {Mode::kImplicitDestinations, Mode::kExplicitDestinations}) {
      uint64_t before = 0;
      for (uint32_t value = 0; value <= 256; value += 32) {
        TrianglesDesc desc = base;
        desc.Mode = mode;
        desc.Limits.*field = value;
        t.holds("a larger limit takes no less", size_of(desc) >= before);
        before = size_of(desc);
      }
    }
  }
  TrianglesDesc empty = triangles_desc(3);
  empty.Limits.MaxTotalTriangleCount = empty.Limits.MaxTotalVertexCount = 0;
  t.holds("of empty clusters", size_of(empty) > 0);
}

void bad_inputs(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const TrianglesDesc good = triangles_desc(1);
  Batch batch = batch_of(t, inputs_of(good), t.upload(row_of_clusters(t, 1)));
  const auto refused = [&](const char* what, auto change) {
    TrianglesDesc desc = good;
    change(desc);
    t.refused(what, record(t, [&](CommandList& l) { add_operation(l, inputs_of(desc), batch); }),
              "KA0748");
  };
  refused("both hints", [](auto& d) { d.Flags = Flags::kFastTrace | Flags::kFastOperation; });
  refused("an undefined flag", [](auto& d) { d.Flags = static_cast<Flags>(0x200); });
  refused("an undefined mode", [](auto& d) { d.Mode = static_cast<Mode>(3); });
  refused("no indices", [](auto& d) { d.IndexFormat = RtasIndexFormat::kNone; });
  refused("indices of 3 bytes", [](auto& d) { d.IndexFormat = static_cast<RtasIndexFormat>(3); });
  refused("no vertices", [](auto& d) { d.VertexFormat = RtasVertexFormat::kNone; });
  refused("257 triangles", [](auto& d) { d.Limits.MaxTriangleCountPerCluster = 257; });
  refused("257 vertices", [](auto& d) { d.Limits.MaxVertexCountPerCluster = 257; });
  refused("a geometry index", [](auto& d) { d.Limits.MaxGeometryIndexValue = 1 << 24; });
  RtasClasInputsDesc level = level_desc();
  level.Flags = Flags::kAllowDataAccess;
  t.refused("data access of a bottom level",
            record(t, [&](CommandList& l) { add_operation(l, inputs_of(level), batch); }),
            "KA0748");
}

void indirected(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const TrianglesDesc desc = triangles_desc(3);
  const Buffer args = t.upload(row_of_clusters(t, 3));
  const Buffer counter = t.upload(std::vector<uint32_t>{2});
  const auto try_one = [&](const char* what, Resolution flag, auto field) {
    Batch batch = batch_of(t, inputs_of(desc), args);
    batch.data.IndirectArgumentArraySize = counter.GetGPUVirtualAddress();
    uint64_t& address = field(batch.data);
    const Buffer hop = t.upload(Words{address});
    address = hop.GetGPUVirtualAddress();
    batch.data.AddressResolutionFlags = flag;
    t.accepted(what, run(t, inputs_of(desc), batch));
    own.noted(what, "");
    const Words addresses = addresses_in(t, batch);
    shows(t, what, {addresses[0], addresses[1]}, {5, 6, -1});
    t.equal(std::string(what) + ", the third", addresses[2], kUntouched);
    address += 4;
    t.refused(what, record(t, [&](CommandList& l) { add_operation(l, inputs_of(desc), batch); }),
              "KA0749");
    address -= 4;
    if (flag == Resolution::kIndirectedBatchScratch) return;
    overwrite(hop, Words{0x123456789000});
    t.accepted(what, run(t, inputs_of(desc), batch));
    t.holds(std::string(what) + ": a note", !std::exchange(*own.notes, {}).empty());
  };
  using Data = RtasBatchedOperationData;
  try_one("results", Resolution::kIndirectedBatchResult,
          [](Data& d) -> uint64_t& { return d.BatchResultData; });
  try_one("scratch", Resolution::kIndirectedBatchScratch,
          [](Data& d) -> uint64_t& { return d.BatchScratchData; });
  try_one("addresses", Resolution::kIndirectedDestinationAddressArray,
          [](Data& d) -> uint64_t& { return d.ResultAddressArray.StartAddress; });
  try_one("sizes", Resolution::kIndirectedResultSizeArray,
          [](Data& d) -> uint64_t& { return d.ResultSizeArray.StartAddress; });
  try_one("arguments", Resolution::kIndirectedIndirectArgumentArray,
          [](Data& d) -> uint64_t& { return d.IndirectArgumentArray.StartAddress; });
  try_one("count", Resolution::kIndirectedIndirectArgumentCount,
          [](Data& d) -> uint64_t& { return d.IndirectArgumentArraySize; });
}

void sources_go(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  std::vector<float> vertices = triangle(5).vertices;
  const Buffer positions = t.upload(vertices);
  const Buffer indices = t.upload(std::vector<uint8_t>{0, 1, 2});
  ClusterArgs args = cluster(t, vertices, {0, 1, 2});
  args.VertexBuffer = positions.GetGPUVirtualAddress();
  args.IndexBuffer = indices.GetGPUVirtualAddress();
  const TrianglesDesc desc = triangles_desc(1);
  const Buffer arguments = t.upload(std::vector<ClusterArgs>{args});
  const Batch batch = batch_of(t, inputs_of(desc), arguments);
  t.accepted("a build", run(t, inputs_of(desc), batch));
  overwrite(positions, std::vector<float>(9, 0));
  overwrite(indices, std::vector<uint8_t>(3, 200));
  overwrite(arguments, std::vector<ClusterArgs>(1));
  shows(t, "after its sources", {addresses_in(t, batch)[0]}, {5});
}

void tools(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const TrianglesDesc desc = triangles_desc(2);
  Batch batch = batch_of(t, inputs_of(desc), t.upload(row_of_clusters(t, 2)));
  const Buffer info = t.upload(Words(6, kUntouched));
  batch.data.ToolsInfo = info.GetGPUVirtualAddress();
  t.accepted("a build", run(t, inputs_of(desc), batch));
  const Words sizes = sizes_in(t, batch);
  const Words addresses = addresses_in(t, batch);
  t.equal("info", words64(t.read(info)),
          {2, sizes[0], sizes[1], addresses[0], addresses[1], kUntouched});
}

void not_copied(Context& outer) {
  for (const auto mode : {CopyMode::kClone, CopyMode::kCompact}) {
    Own own(outer);
    Context& t = own.t;
    const TrianglesDesc desc = triangles_desc(1);
    const Batch batch = batch_of(t, inputs_of(desc), t.upload(row_of_clusters(t, 1)));
    t.accepted("a build", run(t, inputs_of(desc), batch));
    t.refused("a copy of a cluster", copy(t, t.structure_memory(1 << 16), batch.memory, mode),
              "KA0796");
  }
}

// Operations of one call that do not depend on each other, in every order.
void any_order(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const TrianglesDesc desc = triangles_desc(2);
  RtasClusterTemplateTrianglesInputsDesc template_desc;
  template_desc.Limits = desc.Limits;
  const RtasOperationInputs inputs[] = {inputs_of(desc), inputs_of(desc), inputs_of(template_desc)};
  RtasBuildClusterTemplatesFromTrianglesArgs of_template;
  of_template.TrianglesArgs = cluster(t, triangle(5), 9);
  of_template.TrianglesArgs.VertexBuffer = 0;
  const Buffer arguments[] = {
      t.upload(row_of_clusters(t, 2)),
      t.upload(std::vector<ClusterArgs>(2, cluster(t, triangle(9, 20)))),
      t.upload(std::vector<RtasBuildClusterTemplatesFromTrianglesArgs>(2, of_template))};
  std::vector<size_t> order = {0, 1, 2};
  do {
    std::vector<Batch> batches;
    std::vector<RtasOperationDesc> descs(3);
    for (size_t i = 0; i < 3; ++i) batches.push_back(batch_of(t, inputs[i], arguments[i]));
    for (size_t i = 0; i < 3; ++i) {
      descs[i].pInputs = &inputs[order[i]];
      descs[i].pBatchedOperationData = &batches[order[i]].data;
    }
    t.accepted("a call",
               execute(t, [&](CommandList& list) { list.ExecuteIndirectRTASOperations(descs); }));
    const Words first = addresses_in(t, batches[0]);
    shows(t, "clusters of two operations", {first[0], first[1], addresses_in(t, batches[1])[0]},
          {5, 6, 9});
    RtasInstantiateClusterTemplateInputsDesc instantiate;
    instantiate.Limits = desc.Limits;
    RtasInstantiateClusterTemplatesArgs args;
    args.ClusterTemplate = addresses_in(t, batches[2])[1];
    args.VertexBuffer = {t.upload(triangle(7).vertices).GetGPUVirtualAddress(), 0};
    shows(t, "a template",
          build(t, instantiate, std::vector<RtasInstantiateClusterTemplatesArgs>{args}), {7});
  } while (std::next_permutation(order.begin(), order.end()));
  own.noted("all of it", "");
}

// Arguments that no application means; whatever happens, it ends and the device goes on.
void nonsense(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  std::mt19937_64 random(11);
  const uint64_t somewhere = t.zeros(1 << 12).GetGPUVirtualAddress();
  const auto address = [&]() -> uint64_t {
    switch (random() % 4) {
      case 0:
        return random();
      case 1:
        return 0;
      default:
        return somewhere + random() % (1 << 13);
    }
  };
  for (int round = 0; round < 60; ++round) {
    TrianglesDesc desc = triangles_desc(8, Flags::kAllowOmm);
    desc.VertexFormat = static_cast<RtasVertexFormat>(1 + random() % 14);
    desc.GeometryIndexAndFlagsIndexFormat = static_cast<RtasIndexFormat>(1u << random() % 3);
    desc.OpacityMicromapIndexFormat = static_cast<RtasIndexFormat>(1u << random() % 3);
    desc.IndexFormat = static_cast<RtasIndexFormat>(1u << random() % 3);
    std::vector<ClusterArgs> all(8);
    for (ClusterArgs& args : all) {
      const auto words = reinterpret_cast<uint16_t*>(&args);
      for (size_t i = 0; i < 16; ++i) words[i] = static_cast<uint16_t>(random());
      if (random() % 4 != 0) args.TriangleCount %= 257;
      if (random() % 4 != 0) args.VertexCount %= 257;
      for (uint16_t* stride :
           {&args.VertexBufferStride, &args.IndexBufferStride,
            &args.OpacityMicromapIndexBufferStride, &args.GeometryIndexAndFlagsArrayStride}) {
        if (random() % 4 != 0) *stride %= 5;
      }
      args.VertexBuffer = address();
      args.IndexBuffer = address();
      args.GeometryIndexAndFlagsArray = address();
      args.GeometryIndexAndFlagsIndexBuffer = address();
      args.OpacityMicromapArray = address();
      args.OpacityMicromapIndexBuffer = address();
    }
    Batch batch = batch_of(t, inputs_of(desc), t.upload(all));
    t.accepted("nonsense", run(t, inputs_of(desc), batch));
    std::vector<LevelArgs> levels(4);
    for (LevelArgs& args : levels) {
      args.ClasAddressCount = static_cast<uint32_t>(random() % 3 == 0 ? random() : random() % 9);
      args.ClasAddressStride = static_cast<uint32_t>(random() % 3 * 8);
      args.ClasAddressArray =
          random() % 2 != 0 ? address() : batch.data.ResultAddressArray.StartAddress;
    }
    const auto level = level_desc(4, 1 << 20);
    t.accepted("levels of nonsense",
               run(t, inputs_of(level), batch_of(t, inputs_of(level), t.upload(levels))));
  }
  own.notes->clear();
  shows(t, "afterwards", build(t, triangles_desc(2), row_of_clusters(t, 2)), {5, 6});
}

void many(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  constexpr uint32_t kCount = 100'000;
  std::vector<float> vertices;
  for (uint32_t i = 0; i < kCount; ++i) {
    const auto corners = triangle(static_cast<float>(5 + i % 4), 10.f * static_cast<float>(i));
    vertices.insert(vertices.end(), corners.vertices.begin(), corners.vertices.end());
  }
  const uint64_t first = t.upload(vertices).GetGPUVirtualAddress();
  std::vector<ClusterArgs> all(kCount, cluster(t, triangle(5)));
  for (uint32_t i = 0; i < kCount; ++i) {
    all[i].ClusterID = i;
    all[i].VertexBuffer = first + 36 * uint64_t{i};
  }
  TrianglesDesc desc = triangles_desc(1);
  desc.Limits.MaxArgCount = kCount;
  desc.Limits.MaxTriangleCountPerCluster = 1;
  desc.Limits.MaxVertexCountPerCluster = 3;
  desc.Limits.MaxTotalTriangleCount = kCount;
  desc.Limits.MaxTotalVertexCount = 3 * kCount;
  const Buffer top = top_of(t, level_of(t, build(t, desc, all)));
  own.noted("all of it", "");
  t.distance("some of them", depths_at(t, top, {0, 10, 30, 543210, 999990}), {5, 6, 8, 6, 8});
}

}  // namespace

std::vector<RuleTest> memory_tests() {
  return {{"IND-02", any_order},
          {"IND-07, IND-11", counts},
          {"IND-08, IND-09, IND-16", strides},
          {"IND-10, IND-12", implicit},
          {"IND-13", explicit_ones},
          {"IND-14, IND-19, IND-21, IND-23", only_sizes},
          {"IND-20, IND-22, IND-26", prebuild_sizes},
          {"CLS-16", bad_inputs},
          {"IND-15", indirected},
          {"IND-18", sources_go},
          {"IND-10", tools},
          {"IND-24", not_copied},
          {"CLS-42", many},
          {"IND-27", nonsense}};
}

}  // namespace kaamos::conformance::cls
