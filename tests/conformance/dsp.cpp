// SPDX-License-Identifier: MIT
//
// DispatchRays and ExecuteIndirect.
#include <shaders/dispatch.h>

#include <algorithm>
#include <array>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr char kSignature[] = "SRV(t0), SRV(t1), UAV(u0), RootConstants(b0, num32BitConstants = 2)";
constexpr char kOrdinal[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 1, num32BitConstants = 1)";

using Record = std::function<void(CommandList&)>;

class Dispatches : public Program {
 public:
  explicit Dispatches(Context& t)
      : Program(t, kaamos_shaders_dispatch(), {"CountCell", "LastCell", "Note", "NoteNumbers"},
                kSignature),
        context_(t) {
    local(kOrdinal, {"Note"});
    create();
  }

  // A record of this shader in a table of its own.
  DispatchRaysDesc rays(const std::string& shader, uint32_t width = 1, uint32_t height = 1,
                        uint32_t depth = 1, uint32_t ordinal = 0) {
    ShaderTable table(pipeline, shader);
    std::vector<LocalArgument> arguments;
    if (shader == "Note") arguments.push_back(LocalArgument::Constants(ordinal));
    table.AddRecord(shader, arguments).value();
    table.Build(context_.device()).value();
    keep_.push_back(table);
    DispatchRaysDesc out;
    out.RayGenerationShaderRecord = table.GetRecord(0);
    out.Width = width;
    out.Height = height;
    out.Depth = depth;
    return out;
  }

  PipelineState kernel(const std::string& entry) {
    return context_.device()
        .CreateComputePipelineState(
            {global, LoadShaderLibrary(kaamos_shaders_dispatch()).value(), entry, entry})
        .value();
  }

  // A list with the pipeline set and `words` bound to u0.
  CommandList list(const Buffer& words) {
    CommandList out = context_.device().CreateCommandList().value();
    out.SetComputeRootSignature(global);
    out.SetPipelineState1(pipeline);
    out.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
    return out;
  }
  Status close(const Record& record) {
    CommandList out = list(context_.zeros(64));
    record(out);
    return out.Close();
  }
  std::vector<uint32_t> words_of(const Record& record) {
    const Buffer words = context_.zeros(kWordBytes);
    CommandList out = list(words);
    record(out);
    context_.queue().ExecuteAndWait(out).value();
    return context_.read(words);
  }

 private:
  Context& context_;
  std::vector<ShaderTable> keep_;
};

std::vector<uint32_t> cut(const std::vector<uint32_t>& words, size_t begin, size_t count) {
  return {words.begin() + begin, words.begin() + begin + count};
}

void up_to_2_30_threads(Context& t) {
  Dispatches program(t);
  const auto closes = [&](uint32_t width, uint32_t height, uint32_t depth) {
    return program.close(
        [&](CommandList& list) { list.DispatchRays(program.rays("Note", width, height, depth)); });
  };
  t.accepted("2^30 x 1 x 1", closes(1u << 30, 1, 1));
  t.accepted("1 x 2^15 x 2^15", closes(1, 1u << 15, 1u << 15));
  t.refused("2^30 + 1", closes((1u << 30) + 1, 1, 1), "KA0814");
  t.refused("2^16 x 2^15 x 1", closes(1u << 16, 1u << 15, 1), "KA0814");
  t.refused("2^32 - 1 in each dimension", closes(~0u, ~0u, ~0u), "KA0814");
  // No single dimension has a limit of its own.
  const uint32_t sizes[][3] = {{70001, 1, 1}, {1, 70001, 1}, {1, 1, 70001}, {257, 3, 70}};
  for (const auto& size : sizes) {
    const auto words = program.words_of([&](CommandList& list) {
      list.DispatchRays(program.rays("LastCell", size[0], size[1], size[2]));
    });
    t.equal("threads", words[0], size[0] * size[1] * size[2]);
    t.equal("index of the last thread", cut(words, 1, 3), {size[0] - 1, size[1] - 1, size[2] - 1});
  }
}

void zero_launches_nothing(Context& t) {
  Dispatches program(t);
  const auto words = program.words_of([&](CommandList& list) {
    list.DispatchRays(program.rays("CountCell", 0, 5, 5));
    list.DispatchRays(program.rays("CountCell", 5, 0, 5));
    list.DispatchRays(program.rays("CountCell", 5, 5, 0));
    list.DispatchRays(program.rays("CountCell", 0, 0, 0));
    list.DispatchRays(program.rays("CountCell", 0, ~0u, ~0u));
  });
  t.equal("words", words, std::vector<uint32_t>(words.size()));
}

void each_cell_once(Context& t) {
  Dispatches program(t);
  const auto words = program.words_of(
      [&](CommandList& list) { list.DispatchRays(program.rays("CountCell", 7, 5, 3)); });
  std::vector<uint32_t> expected(words.size());
  std::fill_n(expected.begin(), 7 * 5 * 3, 1u);
  t.equal("invocations per cell", words, expected);
}

void rays_and_groups_in_one_list(Context& t) {
  Dispatches program(t);
  const PipelineState kernel = program.kernel("CountThreads");
  const auto words = program.words_of([&](CommandList& list) {
    list.DispatchRays(program.rays("CountCell", 2));
    list.SetPipelineState(kernel);
    list.SetComputeRoot32BitConstant(3, 1, 0);
    list.Dispatch(2, 1, 1);
    list.SetPipelineState1(program.pipeline);
    list.DispatchRays(program.rays("CountCell", 3));
  });
  t.equal("rays, rays and threads, rays", cut(words, 0, 4), {2u, 10u, 1u, 0u});
}

void pipeline_must_be_set(Context& t) {
  Dispatches program(t);
  const PipelineState kernel = program.kernel("CountThreads");
  CommandList list = t.device().CreateCommandList().value();
  list.SetComputeRootSignature(program.global);
  list.DispatchRays(program.rays("Note"));
  t.refused("without a pipeline", list.Close(), "KA0811");
  t.refused("with a compute pipeline", program.close([&](CommandList& each) {
    each.SetPipelineState(kernel);
    each.DispatchRays(program.rays("Note"));
  }),
            "KA0811");
  t.accepted("the device afterwards", t.device().GetDeviceRemovedReason());
}

// Every description that breaks a rule of shader tables.
std::vector<std::pair<const char*, DispatchRaysDesc>> misaligned(const DispatchRaysDesc& good) {
  const uint64_t start = good.RayGenerationShaderRecord.StartAddress;
  std::vector<std::pair<const char*, DispatchRaysDesc>> out;
  const auto add = [&](const char* what) -> DispatchRaysDesc& {
    return out.emplace_back(what, good).second;
  };
  add("raygen + 32").RayGenerationShaderRecord.StartAddress += 32;
  add("miss + 32").MissShaderTable = {start + 32, 32, 32};
  add("hit + 16").HitGroupTable = {start + 16, 32, 32};
  add("callable + 1").CallableShaderTable = {start + 1, 32, 32};
  add("miss stride 16").MissShaderTable = {start, 32, 16};
  add("hit stride 48").HitGroupTable = {start, 32, 48};
  add("callable stride 4128").CallableShaderTable = {start, 32, 4128};
  return out;
}

void tables_are_aligned(Context& t) {
  Dispatches program(t);
  for (const auto& [what, desc] : misaligned(program.rays("Note"))) {
    const DispatchRaysDesc& each = desc;
    t.refused(what, program.close([&](CommandList& list) { list.DispatchRays(each); }), "KA0813");
  }
  DispatchRaysDesc good = program.rays("CountCell", 2);
  const uint64_t start = good.RayGenerationShaderRecord.StartAddress;
  for (const uint64_t stride : {0u, 32u, 4096u}) {
    good.MissShaderTable = good.HitGroupTable = good.CallableShaderTable = {start, 32, stride};
    const auto words = program.words_of([&](CommandList& list) { list.DispatchRays(good); });
    t.equal("cells with stride " + std::to_string(stride), cut(words, 0, 3), {1u, 1u, 0u});
  }
}

void desc_is_copied(Context& t) {
  Dispatches program(t);
  const DispatchRaysDesc first = program.rays("Note", 2, 1, 1, 5);
  const DispatchRaysDesc second = program.rays("Note", 9, 1, 1, 6);
  const Buffer words = t.zeros(kWordBytes);
  CommandList list = program.list(words);
  DispatchRaysDesc desc = first;
  list.DispatchRays(desc);
  desc = second;
  t.queue().ExecuteAndWait(list).value();
  const auto found = t.read(words);
  t.equal("dispatches", found[0], 1u);
  t.equal("ordinal and width", cut(found, 10, 2), {5u, 2u});
}

void dimensions_are_those_of_the_desc(Context& t) {
  Dispatches program(t);
  for (const auto& size : {std::array{6u, 1u, 1u}, {1u, 7u, 1u}, {5u, 4u, 3u}}) {
    const auto words = program.words_of([&](CommandList& list) {
      list.DispatchRays(program.rays("LastCell", size[0], size[1], size[2]));
    });
    t.equal("dimensions", cut(words, 4, 3), {size[0], size[1], size[2]});
  }
}

// --- ExecuteIndirect ---

using Type = IndirectArgumentType;

IndirectArgumentDesc plain(Type type) {
  return {.Type = type};
}
IndirectArgumentDesc constants(uint32_t offset, uint32_t count) {
  return {.Type = Type::kConstant, .Constant = {3, offset, count}};
}

// Commands as bytes, without padding.
struct Arguments {
  template <class T>
  Arguments& put(const T& value) {
    const auto* begin = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof(T));
    return *this;
  }
  Arguments& pad_to(size_t size) {
    bytes.resize(size);
    return *this;
  }
  std::vector<std::byte> bytes;
};

constexpr uint32_t kConstantAndRays = 4 + sizeof(DispatchRaysDesc);

CommandSignature constant_and_rays(Context& t, const Dispatches& program,
                                   uint32_t stride = kConstantAndRays) {
  return t.device()
      .CreateCommandSignature({stride, {constants(0, 1), plain(Type::kDispatchRays)}},
                              program.global)
      .value();
}

void three_commands_of_which_two_count(Context& t) {
  static_assert(sizeof(DispatchRaysDesc) == 104);
  Dispatches program(t);
  const CommandSignature signature = constant_and_rays(t, program, 160);
  Arguments arguments;
  arguments.pad_to(8);  // the offset of the first command
  for (uint32_t i = 0; i < 3; ++i) {
    arguments.put(uint32_t{40 + i}).put(program.rays("Note", i + 1, 2, 1, 50 + i));
    arguments.pad_to(8 + 160 * (i + 1));
  }
  const Buffer buffer = t.upload(arguments.bytes);
  const auto run = [&](const Buffer& count, uint64_t offset, uint32_t max = 3) {
    return program.words_of([&](CommandList& list) {
      list.SetComputeRoot32BitConstant(3, 99, 1);  // inherited
      list.ExecuteIndirect(signature, max, buffer, 8, count, offset);
    });
  };
  const Buffer counts = t.upload(std::vector<uint32_t>{2, 0, 4, ~0u});
  for (const auto& [offset, expected] : {std::pair{0u, 2u}, {4u, 0u}, {8u, 3u}, {12u, 3u}}) {
    const auto words = run(counts, offset);
    t.equal("commands", words[0], expected);
    for (uint32_t i = 0; i < expected; ++i) {
      t.equal("number, inherited, ordinal, size", cut(words, 8 + 8 * i, 6),
              {40 + i, 99u, 50 + i, i + 1, 2u, 1u});
    }
  }
  t.equal("commands without a count buffer", run({}, 0)[0], 3u);
  t.equal("commands of at most two", run(counts, 12, 2)[0], 2u);
  t.equal("commands of at most none", run(counts, 12, 0)[0], 0u);
}

void indirect_views_and_the_state_afterwards(Context& t) {
  Dispatches program(t);
  const CommandSignature signature =
      t.device()
          .CreateCommandSignature({112,
                                   {{.Type = Type::kShaderResourceView, .ShaderResourceView = {1}},
                                    plain(Type::kDispatchRays)}},
                                  program.global)
          .value();
  Arguments arguments;
  for (const uint32_t value : {81u, 82u}) {
    arguments.put(t.upload(std::vector<uint32_t>(16, value)).GetGPUVirtualAddress());
    arguments.put(program.rays("NoteNumbers"));
  }
  const auto words = program.words_of(
      [&](CommandList& list) { list.ExecuteIndirect(signature, 2, t.upload(arguments.bytes), 0); });
  t.equal("words behind the views", std::vector<uint32_t>{words[8], words[16]}, {81u, 82u});

  const CommandSignature constant = constant_and_rays(t, program);
  Arguments one;
  one.put(7u).put(program.rays("Note"));
  const auto after = program.words_of([&](CommandList& list) {
    list.SetComputeRoot32BitConstant(3, 5, 0);
    list.SetComputeRoot32BitConstant(3, 6, 1);
    list.ExecuteIndirect(constant, 1, t.upload(one.bytes), 0);
    list.DispatchRays(program.rays("Note"));
  });
  t.equal("constants of the command", cut(after, 8, 2), {7u, 6u});
  t.equal("constants afterwards", cut(after, 16, 2), {0u, 6u});
}

void indirect_groups(Context& t) {
  Dispatches program(t);
  const CommandSignature signature =
      t.device()
          .CreateCommandSignature({16, {constants(0, 1), plain(Type::kDispatch)}}, program.global)
          .value();
  Arguments arguments;
  arguments.put(1u).put(DispatchArguments{2, 3, 1});
  arguments.put(2u).put(DispatchArguments{0, 3, 1});
  arguments.put(3u).put(DispatchArguments{1, 1, 1});
  const auto words = program.words_of([&](CommandList& list) {
    list.SetPipelineState(program.kernel("CountThreads"));
    list.ExecuteIndirect(signature, 3, t.upload(arguments.bytes), 0);
  });
  t.equal("threads by number", cut(words, 0, 4), {0u, 24u, 0u, 4u});
}

void signatures_that_are_refused(Context& t) {
  Dispatches program(t);
  const auto make = [&](std::vector<IndirectArgumentDesc> arguments, uint32_t stride = 256) {
    return t.device().CreateCommandSignature({stride, std::move(arguments)}, program.global);
  };
  const auto rays = plain(Type::kDispatchRays);
  t.accepted("only DispatchRays", make({rays}, 104));
  t.accepted("constants before it", make({constants(0, 2), rays}, 112));
  t.refused("a constant after it", make({rays, constants(0, 1)}), "KA0540");
  t.refused("twice", make({rays, rays}), "KA0540");
  for (const Type type : {Type::kDispatch, Type::kDraw, Type::kDrawIndexed, Type::kDispatchMesh,
                          Type::kVertexBufferView, Type::kIndexBufferView}) {
    t.refused("with type " + std::to_string(static_cast<uint32_t>(type)), make({plain(type), rays}),
              "KA0540");
  }
  t.refused("no dispatch", make({constants(0, 1)}), "KA0540");
  t.refused("stride 100", make({rays}, 100), "KA0540");
  t.refused("root argument without a root signature",
            t.device().CreateCommandSignature({256, {constants(0, 1), rays}}), "KA0540");
  DeviceDesc old = t.target().device_desc();
  old.Tier = RaytracingTier::kTier1_0;
  t.refused("on a device of tier 1.0",
            CreateDevice(old).value().CreateCommandSignature({104, {rays}}), "KA0541");
}

void arguments_written_by_a_shader(Context& t) {
  Dispatches program(t);
  const CommandSignature signature = constant_and_rays(t, program);
  const uint64_t record = program.rays("Note", 1, 1, 1, 60).RayGenerationShaderRecord.StartAddress;
  const Buffer source = t.upload(std::vector<uint64_t>{record});
  const Buffer arguments = t.zeros(2 * kConstantAndRays);
  const PipelineState kernel = program.kernel("WriteArguments");
  const Buffer words = t.zeros(kWordBytes);
  CommandList list = program.list(arguments);
  list.SetPipelineState(kernel);
  list.SetComputeRootShaderResourceView(1, source.GetGPUVirtualAddress());
  list.Dispatch(1, 1, 1);
  list.ResourceBarrier(ResourceBarrier::Transition(arguments, ResourceStates::kUnorderedAccess,
                                                   ResourceStates::kIndirectArgument));
  list.SetPipelineState1(program.pipeline);
  list.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
  list.ExecuteIndirect(signature, 2, arguments, 0);
  t.queue().ExecuteAndWait(list).value();
  const auto found = t.read(words);
  t.equal("commands", found[0], 2u);
  t.equal("the first: number, inherited, ordinal, size", cut(found, 8, 6),
          {70u, 0u, 60u, 3u, 2u, 1u});
  t.equal("the second", cut(found, 16, 6), {71u, 0u, 60u, 4u, 1u, 1u});
}

// Our policy for GPU memory that holds arguments against the rules: the command does not run, the
// device is removed, and the message says which command and why.
void bad_indirect_arguments(Context& t) {
  const auto run = [&](const char* what, void (*spoil)(DispatchRaysDesc&)) {
    Context own(t.target());
    Dispatches program(own);
    DispatchRaysDesc desc = program.rays("Note");
    Arguments arguments;
    arguments.put(0u).put(desc);
    spoil(desc);
    arguments.put(1u).put(desc);
    const Buffer words = own.zeros(kWordBytes);
    CommandList list = program.list(words);
    list.ExecuteIndirect(constant_and_rays(own, program), 2, own.upload(arguments.bytes), 0);
    t.refused(what, own.queue().ExecuteAndWait(list), "KA0898");
    t.refused(std::string(what) + ": the device", own.device().GetDeviceRemovedReason(), "KA0898");
  };
  run("raygen + 32", [](DispatchRaysDesc& d) { d.RayGenerationShaderRecord.StartAddress += 32; });
  run("hit stride 48", [](DispatchRaysDesc& d) {
    d.HitGroupTable = {d.RayGenerationShaderRecord.StartAddress, 32, 48};
  });
  run("miss table outside every buffer", [](DispatchRaysDesc& d) {
    d.MissShaderTable = {0xDEADBEEFDEADBE00, 64, 32};
  });
  run("more than 2^30 threads", [](DispatchRaysDesc& d) { d.Width = d.Height = d.Depth = ~0u; });
}

}  // namespace

std::vector<RuleTest> dsp_tests() {
  return {{"DSP-01", up_to_2_30_threads},
          {"DSP-02", zero_launches_nothing},
          {"DSP-03", each_cell_once},
          {"DSP-05", rays_and_groups_in_one_list},
          {"DSP-06", pipeline_must_be_set},
          {"DSP-07", tables_are_aligned},
          {"DSP-08", desc_is_copied},
          {"DSP-09", three_commands_of_which_two_count, "KA0485"},
          {"DSP-09", indirect_views_and_the_state_afterwards, "KA0485"},
          {"DSP-09", indirect_groups, "KA0485"},
          {"DSP-09, ERR-30", signatures_that_are_refused},
          {"DSP-10", arguments_written_by_a_shader},
          {"DSP-10", bad_indirect_arguments},
          {"DSP-11", dimensions_are_those_of_the_desc}};
}

}  // namespace kaamos::conformance
