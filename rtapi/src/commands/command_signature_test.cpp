// SPDX-License-Identifier: MIT
#include "rtapi/testing/command_list_fixture.h"
#include "rtapi/testing/expect_error.h"

namespace rtapi::testing {
namespace {

using Type = IndirectArgumentType;
namespace runtime = kaamos::runtime;

IndirectArgumentDesc Plain(Type type) {
  return {.Type = type};
}
IndirectArgumentDesc Constant(uint32_t parameter, uint32_t offset, uint32_t count) {
  return {.Type = Type::kConstant, .Constant = {parameter, offset, count}};
}
IndirectArgumentDesc View(Type type, uint32_t parameter) {
  return {.Type = type, .ShaderResourceView = {parameter}};
}

class CommandSignatureTest : public CommandListTest {
 protected:
  CommandSignatureTest() {
    signature_ = Global("RootConstants(num32BitConstants=4, b0), CBV(b1), SRV(t0), UAV(u0)");
    LibraryBuilder builder;
    builder.Export("Kernel", Stage::kCompute);
    kernel_ =
        device_.CreateComputePipelineState({.pRootSignature = signature_, .CS = builder.Build()})
            .value();
  }
  Status Create(std::vector<IndirectArgumentDesc> arguments, uint32_t stride = 256,
                bool with_root_signature = true) {
    auto made = device_.CreateCommandSignature({stride, std::move(arguments)},
                                               with_root_signature ? signature_ : RootSignature());
    return made.ok() ? Status() : Status(made.error());
  }
  RootSignature signature_;
  PipelineState kernel_;
};

TEST_F(CommandSignatureTest, DSP_09_OneDispatchAtTheEnd) {
  EXPECT_OK(Create({Plain(Type::kDispatchRays)}, 104, false));
  EXPECT_OK(Create({Plain(Type::kDispatch)}, 12, false));
  EXPECT_ERROR(Create({}), "KA0540", "no arguments");
  EXPECT_ERROR(Create({Constant(0, 0, 4)}), "KA0540", "not a draw or dispatch");
  EXPECT_ERROR(Create({Plain(Type::kDispatchRays), Constant(0, 0, 4)}), "KA0540", "argument 0",
               "must be the last");
  EXPECT_ERROR(Create({Plain(Type::kDispatch), Plain(Type::kDispatchRays)}), "KA0540", "only one");
  for (Type type : {Type::kDraw, Type::kDrawIndexed, Type::kDispatchMesh, static_cast<Type>(77)}) {
    EXPECT_ERROR(Create({Plain(type), Plain(Type::kDispatchRays)}), "KA0540", "argument 0");
  }
}

TEST_F(CommandSignatureTest, RAS_147_DrawsComeLast) {
  const auto vertices = [](uint32_t slot) {
    return IndirectArgumentDesc{.Type = Type::kVertexBufferView, .VertexBuffer = {slot}};
  };
  const auto indices = Plain(Type::kIndexBufferView);
  EXPECT_OK(Create({Plain(Type::kDraw)}, 16, false));
  EXPECT_OK(Create({vertices(0), vertices(31), indices, Plain(Type::kDrawIndexed)}, 68, false));
  EXPECT_OK(Create({Constant(0, 0, 1), Plain(Type::kDrawIndexed)}, 24));
  EXPECT_ERROR(Create({Plain(Type::kDraw), Constant(0, 0, 1)}), "KA0540", "must be the last");
  EXPECT_ERROR(Create({Constant(0, 0, 1), Plain(Type::kDraw)}, 256, false), "KA0540",
               "root signature");
  EXPECT_ERROR(Create({indices, Plain(Type::kDrawIndexed)}, 32), "KA0540", "36");
  EXPECT_ERROR(Create({vertices(32), Plain(Type::kDraw)}), "KA0540", "vertex buffer 32");
  EXPECT_ERROR(Create({vertices(2), vertices(2), Plain(Type::kDraw)}), "KA0540", "second time");
  EXPECT_ERROR(Create({indices, indices, Plain(Type::kDraw)}), "KA0540", "index buffer");
  EXPECT_ERROR(Create({vertices(0), Plain(Type::kDispatch)}), "KA0540", "is a dispatch");
}

TEST_F(CommandSignatureTest, StrideHoldsTheArguments) {
  EXPECT_ERROR(Create({Plain(Type::kDispatchRays)}, 100), "KA0540", "104");
  EXPECT_ERROR(Create({Plain(Type::kDispatchRays)}, 106), "KA0540", "multiple of 4");
  EXPECT_OK(Create({Constant(0, 1, 3), Plain(Type::kDispatch)}, 24));
  EXPECT_ERROR(Create({Constant(0, 1, 3), Plain(Type::kDispatch)}, 20), "KA0540", "24");
}

TEST_F(CommandSignatureTest, RootArgumentsAreThoseOfTheRootSignature) {
  const auto end = Plain(Type::kDispatch);
  EXPECT_ERROR(Create({Constant(0, 0, 1), end}, 256, false), "KA0540", "pass the root signature");
  EXPECT_ERROR(Create({Constant(4, 0, 1), end}), "KA0540", "parameter 4", "has 4");
  EXPECT_ERROR(Create({Constant(1, 0, 1), end}), "KA0540", "type 2");
  EXPECT_ERROR(Create({View(Type::kConstantBufferView, 2), end}), "KA0540", "type 3");
  EXPECT_ERROR(Create({Constant(0, 3, 2), end}), "KA0540", "3..5");
  EXPECT_ERROR(Create({Constant(0, 0xFFFFFFFF, 2), end}), "KA0540");
  EXPECT_ERROR(Create({Constant(0, 0, 0), end}), "KA0540", "at least 1");
  EXPECT_ERROR(Create({Constant(0, 2, 2), Constant(0, 0, 1), end}), "KA0540", "sort");
  EXPECT_ERROR(Create({Constant(0, 0, 2), Constant(0, 1, 1), end}), "KA0540", "once");
  EXPECT_ERROR(
      Create({View(Type::kShaderResourceView, 2), View(Type::kConstantBufferView, 1), end}),
      "KA0540", "sort");
  EXPECT_ERROR(
      Create({View(Type::kShaderResourceView, 2), View(Type::kShaderResourceView, 2), end}),
      "KA0540");
  EXPECT_OK(Create({Constant(0, 0, 1), Constant(0, 2, 1), View(Type::kConstantBufferView, 1),
                    View(Type::kShaderResourceView, 2), View(Type::kUnorderedAccessView, 3), end}));
  auto local = Local("SRV(t0)");
  EXPECT_ERROR(device_.CreateCommandSignature({104, {Plain(Type::kDispatchRays)}}, local),
               "KA0536");
}

TEST_F(CommandSignatureTest, Tier10HasNoIndirectRays) {
  const Device old = CreateNullDevice({.Tier = RaytracingTier::kTier1_0});
  EXPECT_ERROR(old.CreateCommandSignature({104, {Plain(Type::kDispatchRays)}}), "KA0541");
  EXPECT_OK(old.CreateCommandSignature({12, {Plain(Type::kDispatch)}}));
}

class ExecuteIndirectTest : public CommandSignatureTest {
 protected:
  ExecuteIndirectTest() {
    indirect_ =
        device_
            .CreateCommandSignature(
                {32,
                 {Constant(0, 1, 1), View(Type::kShaderResourceView, 2), Plain(Type::kDispatch)}},
                signature_)
            .value();
    buffer_ = MakeBuffer(120);  // three commands of 32 bytes, and 24 bytes for a fourth
    count_ = MakeBuffer(8);
  }
  template <class F>
  Status With(F&& record) {
    return Record([&](CommandList& l) {
      l.SetComputeRootSignature(signature_);
      l.SetPipelineState(kernel_);
      record(l);
    });
  }
  CommandSignature indirect_;
  Buffer buffer_, count_;
};

TEST_F(ExecuteIndirectTest, RecordsTheStateOfTheMoment) {
  list_.SetComputeRootSignature(signature_);
  list_.SetPipelineState(kernel_);
  list_.SetComputeRoot32BitConstants(0, std::array<uint32_t, 4>{1, 2, 3, 4});
  list_.SetComputeRootShaderResourceView(2, buffer_.GetGPUVirtualAddress());
  list_.SetComputeRootUnorderedAccessView(3, buffer_.GetGPUVirtualAddress());
  list_.ExecuteIndirect(indirect_, 4, buffer_, 0, count_, 4);
  list_.Dispatch(1, 1, 1);
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok());
  const auto& command = Executed<runtime::ExecuteIndirectCommand>(0);
  EXPECT_EQ(command.max_count, 4u);
  EXPECT_EQ(command.count_offset, 4u);
  EXPECT_EQ(command.layout->work, runtime::IndirectWork::kDispatch);
  EXPECT_EQ(command.layout->work_offset, 12u);
  EXPECT_EQ(command.layout->root_arguments[0].dest_offset, 4u);
  const auto word = [&](const runtime::RootBindings& state, uint32_t at) {
    uint32_t value;
    std::memcpy(&value, state.root_arguments->bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(word(command.state, 4), 2u);
  // After the call, what the signature sets is zero and null; the rest is unchanged.
  const auto& after = Executed<runtime::DispatchCommand>(1).state;
  EXPECT_EQ(word(after, 0), 1u);
  EXPECT_EQ(word(after, 4), 0u);
  EXPECT_EQ(word(after, 8), 3u);
  EXPECT_EQ(word(after, signature_.GetArgumentOffset(2)), 0u);
  EXPECT_NE(word(after, signature_.GetArgumentOffset(3) + 4), 0u);
}

TEST_F(ExecuteIndirectTest, Errors) {
  EXPECT_OK(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 4, buffer_, 0); }));
  EXPECT_OK(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 0, buffer_, 120); }));
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect({}, 1, buffer_, 0); }), "KA0904");
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 1, {}, 0); }), "KA0904",
               "argument buffer");
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 5, buffer_, 0); }), "KA0816",
               "0..152", "120");
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 4, buffer_, 4); }),
               "KA0816");
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 1, buffer_, 2); }), "KA0816",
               "multiple of 4");
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect(indirect_, ~0u, buffer_, ~3ull); }),
               "KA0816");
  EXPECT_ERROR(
      With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 1, buffer_, 0, count_, 8); }),
      "KA0816", "count buffer");
  EXPECT_ERROR(
      With([&](CommandList& l) { l.ExecuteIndirect(indirect_, 1, buffer_, 0, count_, 1); }),
      "KA0816", "count buffer");
}

TEST_F(ExecuteIndirectTest, PipelineAndRootSignatureFit) {
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetComputeRootSignature(signature_);
                 l.ExecuteIndirect(indirect_, 1, buffer_, 0);
               }),
               "KA0811");
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetPipelineState(kernel_);
                 l.ExecuteIndirect(indirect_, 1, buffer_, 0);
               }),
               "KA0816", "root signature");
  auto rays = device_.CreateCommandSignature({104, {Plain(Type::kDispatchRays)}}).value();
  EXPECT_ERROR(With([&](CommandList& l) { l.ExecuteIndirect(rays, 1, buffer_, 0); }), "KA0811",
               "SetPipelineState1");
  EXPECT_OK(Record([&](CommandList& l) {
    l.SetPipelineState1(Make(Base()).value());
    l.ExecuteIndirect(rays, 1, buffer_, 0);
  }));
}

}  // namespace
}  // namespace rtapi::testing
