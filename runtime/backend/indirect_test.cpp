// SPDX-License-Identifier: MIT
//
// Runs on a device whose addresses are not host addresses.
#include "runtime/backend/indirect.h"

#include <gtest/gtest.h>

#include <cstring>

#include "runtime/backend/backend.h"
#include "runtime/backend/errors.h"

namespace kaamos::runtime {
namespace {

struct Memory final : BackendBuffer {
  Memory(uint64_t at, uint64_t size) : start(at), bytes(size) {}
  uint64_t address() const override { return start; }
  uint64_t size_bytes() const override { return bytes.size(); }
  uint8_t* host() const override { return visible ? bytes.data() : nullptr; }
  uint64_t start;
  mutable std::vector<uint8_t> bytes;
  bool visible = true;
};

class Indirect : public ::testing::Test {
 protected:
  static constexpr uint64_t kTable = uint64_t{1} << 40;
  static constexpr uint64_t kArguments = kTable + 65536;

  Indirect() {
    for (const auto& [address, size, name] :
         {std::tuple{kTable, 4096, "tables"}, {kArguments, 1024, "arguments"}}) {
      Allocation allocation;
      allocation.address = address;
      allocation.size_bytes = size;
      allocation.name = name;
      addresses_.insert(allocation);
    }
    layout_.root_arguments = {{0, 8, 4, 0, 0}, {4, 16, 8, 1, 256}};
    layout_.work = IndirectWork::kDispatchRays;
    layout_.work_offset = 12;
    layout_.packed_bytes = 116;
    layout_.stride_bytes = 120;
    command_.max_count = 3;
    command_.arguments = arguments_;
    command_.arguments_offset = 4;
    command_.pipeline_stack_bytes = 77;
    RootArguments inherited;
    inherited.bytes.fill(9);
    command_.state.root_arguments = std::make_shared<RootArguments>(inherited);
    for (uint32_t i = 0; i < 3; ++i) set(i, 10 + i, i > 0 ? kTable + 256 * i : 0, rays(i + 1));
  }
  static rtapi::DispatchRaysDesc rays(uint32_t width) {
    rtapi::DispatchRaysDesc desc;
    desc.RayGenerationShaderRecord = {kTable + 64, 32};
    desc.Width = width;
    desc.Height = desc.Depth = 1;
    return desc;
  }
  void set(uint32_t index, uint32_t constant, uint64_t view, const rtapi::DispatchRaysDesc& desc) {
    uint8_t* at = arguments_->bytes.data() + 4 + 120 * index;
    std::memcpy(at, &constant, 4);
    std::memcpy(at + 4, &view, 8);
    std::memcpy(at + 12, &desc, sizeof(desc));
  }
  rtapi::Status run() {
    ran_.clear();
    indices_.clear();
    command_.layout = std::make_shared<IndirectLayout>(layout_);
    return execute_indirect(addresses_, command_, "ExecuteIndirect, command 7",
                            [&](const Command& dispatch, uint32_t index) {
                              indices_.push_back(index);
                              ran_.push_back(dispatch);
                              return result_;
                            });
  }
  // The message of the error that the third command causes.
  std::string refusal_of(uint64_t view, const rtapi::DispatchRaysDesc& desc) {
    set(2, 0, view, desc);
    const rtapi::Status status = run();
    EXPECT_EQ(ran_.size(), 2u);
    if (status.ok()) return "accepted";
    EXPECT_EQ(status.error().id.text(), "KA0898");
    EXPECT_EQ(status.error().code, rtapi::ErrorCode::kDeviceRemoved);
    EXPECT_NE(status.error().message.find("indirect command 2 of ExecuteIndirect, command 7"),
              std::string::npos);
    EXPECT_NE(status.error().message.find("byte 244 of buffer \"arguments\""), std::string::npos);
    return status.error().message;
  }
  static bool says(const std::string& message, const char* part) {
    return message.find(part) != std::string::npos;
  }

  AddressMap addresses_;
  std::shared_ptr<Memory> arguments_ = std::make_shared<Memory>(kArguments, 1024);
  IndirectLayout layout_;
  ExecuteIndirectCommand command_;
  std::vector<Command> ran_;
  std::vector<uint32_t> indices_;
  rtapi::Status result_;
};

TEST_F(Indirect, EachCommandHasItsArguments) {
  ASSERT_TRUE(run());
  ASSERT_EQ(ran_.size(), 3u);
  EXPECT_EQ(indices_, (std::vector<uint32_t>{0, 1, 2}));
  for (uint32_t i = 0; i < 3; ++i) {
    const auto& each = std::get<DispatchRaysCommand>(ran_[i]);
    EXPECT_EQ(each.desc.Width, i + 1);
    EXPECT_EQ(each.pipeline_stack_bytes, 77u);
    uint32_t words[6];
    uint64_t view;
    std::memcpy(words, each.state.root_arguments->bytes.data(), sizeof(words));
    std::memcpy(&view, words + 4, sizeof(view));
    EXPECT_EQ(words[1], 0x09090909u);  // inherited
    EXPECT_EQ(words[2], 10 + i);
    EXPECT_EQ(view, i == 0 ? 0 : kTable + 256 * i);
  }
}

TEST_F(Indirect, CountIsTheSmallerOne) {
  auto count = std::make_shared<Memory>(kTable - 65536, 8);
  command_.count = count;
  command_.count_offset = 4;
  for (uint32_t value : {0u, 2u, 3u, 4u, 0xFFFFFFFFu}) {
    std::memcpy(count->bytes.data() + 4, &value, 4);
    ASSERT_TRUE(run());
    EXPECT_EQ(ran_.size(), std::min(value, 3u));
  }
}

TEST_F(Indirect, DSP_10_RulesOfTablesHold) {
  auto desc = rays(1);
  desc.HitGroupTable = {kTable + 32, 64, 32};
  EXPECT_TRUE(says(refusal_of(0, desc), "HitGroupTable starts at byte 32 of buffer \"tables\""));
  desc.HitGroupTable = {kTable, 64, 48};
  EXPECT_TRUE(says(refusal_of(0, desc), "stride of 48"));
  desc.HitGroupTable = {kTable, 8192, 64};
  EXPECT_TRUE(says(refusal_of(0, desc), "are not inside one live buffer"));
  desc.HitGroupTable = {0xFFFFFFFFFFFFFFC0, ~uint64_t{0}, 64};
  EXPECT_TRUE(says(refusal_of(0, desc), "are not inside one live buffer"));
  desc = rays(1);
  desc.RayGenerationShaderRecord.StartAddress = 0;
  EXPECT_TRUE(says(refusal_of(0, desc), "RayGenerationShaderRecord"));
  desc = rays(1u << 30);
  desc.Height = 2;
  EXPECT_TRUE(says(refusal_of(0, desc), "2^30"));
}

TEST_F(Indirect, RootViewsLieInLiveBuffers) {
  EXPECT_TRUE(says(refusal_of(kTable + 16, rays(1)), "root parameter 1 is byte 16"));
  EXPECT_TRUE(says(refusal_of(0x100, rays(1)), "no live buffer"));
}

TEST_F(Indirect, GroupsHaveALimit) {
  layout_ = {};
  layout_.packed_bytes = layout_.stride_bytes = 12;
  const uint32_t groups[] = {0, 65535, 65535, 1, 2, 3, 1, 65536, 1};
  std::memcpy(arguments_->bytes.data() + 4, groups, sizeof(groups));
  const rtapi::Status status = run();
  ASSERT_FALSE(status.ok());
  EXPECT_TRUE(says(status.error().message, "65535"));
  ASSERT_EQ(indices_, std::vector<uint32_t>{1});  // the first launches nothing
  EXPECT_EQ(std::get<DispatchCommand>(ran_[0]).groups[2], 3u);
}

TEST_F(Indirect, ZeroesLaunchNothing) {
  set(0, 0, 0, rays(0));
  auto desc = rays(5);
  desc.Height = 0;
  desc.HitGroupTable = {0xDEAD, 1, 1};
  set(1, 0, 0xDEAD, desc);
  ASSERT_TRUE(run());
  EXPECT_EQ(indices_, std::vector<uint32_t>{2});
}

TEST_F(Indirect, AnErrorEndsTheCommand) {
  result_ = make_error(Id::kShaderFault, "fault");
  const rtapi::Status status = run();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0892");
  EXPECT_EQ(ran_.size(), 1u);
}

TEST_F(Indirect, MemoryThatTheHostCannotSee) {
  arguments_->visible = false;
  const rtapi::Status status = run();
  ASSERT_FALSE(status.ok());
  EXPECT_TRUE(says(status.error().message, "upload heap"));
}

// Two draws of 20 bytes of arguments, each behind a vertex and an index buffer view.
class IndirectDraws : public Indirect {
 protected:
  IndirectDraws() {
    layout_ = {};
    layout_.buffer_views = {{0, false, 5}, {16, true, 0}};
    layout_.work = IndirectWork::kDrawIndexed;
    layout_.work_offset = 32;
    layout_.packed_bytes = layout_.stride_bytes = 52;
    command_.max_count = 2;
    auto state = std::make_shared<DrawState>();
    state->topology = rtapi::PrimitiveTopology::kTriangleList;
    state->vertex_buffers[5] = {1, 2, 3};
    state->vertex_buffers[6] = {4, 5, 6};
    command_.draw_state = std::move(state);
    command_.state.root_arguments = std::make_shared<RootArguments>();
    put(0, {kTable, 96, 12}, {kTable + 2, 6, rtapi::Format::kR16Uint}, {3, 1, 2, -4, 5});
    put(1, {}, {}, {6, 2, 0, 0, 0});
  }
  void put(uint32_t index, rtapi::VertexBufferView vertices, rtapi::IndexBufferView indices,
           rtapi::DrawIndexedArguments arguments) {
    uint8_t* at = arguments_->bytes.data() + 4 + 52 * index;
    std::memcpy(at, &vertices, 16);
    std::memcpy(at + 16, &indices, 16);
    std::memcpy(at + 32, &arguments, 20);
  }
  const DrawCommand& draw(size_t i) { return std::get<DrawCommand>(ran_.at(i)); }
};

TEST_F(IndirectDraws, RAS_145_EachIsADrawOfItsOwn) {
  ASSERT_TRUE(run().ok());
  ASSERT_EQ(ran_.size(), 2u);
  EXPECT_TRUE(draw(0).indexed);
  EXPECT_EQ(draw(0).arguments.StartIndexLocation, 2u);
  EXPECT_EQ(draw(0).arguments.BaseVertexLocation, -4);
  EXPECT_EQ(draw(0).state->vertex_buffers[5].StrideInBytes, 12u);
  EXPECT_EQ(draw(0).state->vertex_buffers[6].StrideInBytes, 6u);
  EXPECT_EQ(draw(0).state->index_buffer.SizeInBytes, 6u);
  EXPECT_EQ(draw(1).arguments.InstanceCount, 2u);
  EXPECT_EQ(draw(1).state->vertex_buffers[5].BufferLocation, 0u);
  EXPECT_EQ(draw(1).state->index_buffer.BufferLocation, 0u);
}

TEST_F(IndirectDraws, RAS_144_CountsOfZeroAreSkipped) {
  put(0, {}, {}, {0, 1, 0, 0, 0});
  put(1, {}, {}, {3, 0, 0, 0, 0});
  ASSERT_TRUE(run().ok());
  EXPECT_TRUE(ran_.empty());
}

TEST_F(IndirectDraws, RAS_148_BuffersMustBeAlive) {
  const auto error = [&] { return run().error().message; };
  put(0, {kTable, 4097, 12}, {}, {3, 1, 0, 0, 0});
  EXPECT_NE(error().find("vertex buffer 5 is 4097 bytes"), std::string::npos) << error();
  EXPECT_NE(error().find("KA0898"), std::string::npos);
  put(0, {kTable, 96, 4000}, {}, {3, 1, 0, 0, 0});
  EXPECT_NE(error().find("stride of 4000"), std::string::npos) << error();
  put(0, {}, {kTable + 2, 6, rtapi::Format::kR32Uint}, {3, 1, 0, 0, 0});
  EXPECT_NE(error().find("the index buffer"), std::string::npos) << error();
  put(0, {}, {12, 6, rtapi::Format::kR32Uint}, {3, 1, 0, 0, 0});
  EXPECT_NE(error().find("live buffer"), std::string::npos) << error();
}

TEST_F(IndirectDraws, PlainDrawsHaveFourArguments) {
  layout_.buffer_views.clear();
  layout_.work = IndirectWork::kDraw;
  layout_.work_offset = 0;
  layout_.packed_bytes = layout_.stride_bytes = 16;
  command_.max_count = 1;
  const rtapi::DrawArguments plain = {3, 4, 5, 6};
  std::memcpy(arguments_->bytes.data() + 4, &plain, sizeof plain);
  ASSERT_TRUE(run().ok());
  EXPECT_FALSE(draw(0).indexed);
  EXPECT_EQ(draw(0).arguments.StartIndexLocation, 5u);
  EXPECT_EQ(draw(0).arguments.BaseVertexLocation, 0);
  EXPECT_EQ(draw(0).arguments.StartInstanceLocation, 6u);
  EXPECT_EQ(draw(0).state, command_.draw_state);
}

}  // namespace
}  // namespace kaamos::runtime
