// SPDX-License-Identifier: MIT
// A module is made without any source or syntax tree, as a second front end would make it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/builder/ir_types.h"
#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {
namespace {

class Report final : public FinishReport {
 public:
  std::vector<std::string> lines;
  bool has_errors() const override { return !lines.empty(); }
  ir::Location locate(SourcePlace place) override { return {0, place, 1}; }
  void stage_use(const StageUse& use, const ir::EntryPoint& entry) override {
    lines.push_back(std::string(use.name) + " in " + entry.name);
  }
  void no_quads(const StageUse& use, const ir::EntryPoint& entry) override {
    lines.push_back(std::string(use.name) + " without quads in " + entry.name);
  }
  void reached(const std::vector<GlobalFacts*>&, const ir::EntryPoint&) override {}
  void no_register(const BindingFacts& binding) override {
    lines.push_back("no register: " + binding.name);
  }
  void overlap(const BindingFacts& first, const BindingFacts& second,
               const std::string& shared_register, const ir::EntryPoint&) override {
    lines.push_back(first.name + ", " + second.name + " at " + shared_register);
  }
};

// A compute shader that stores a number into the buffer `out`, and another that nothing reaches.
class Made {
 public:
  Made() {
    module.ray_desc = &module.struct_pool.emplace_back();
    module.struct_pool.back().name = "RayDesc";
    out.name = "out";
    out.resource = types.resource(ir::ResourceKind::kRWByteAddressBuffer, nullptr);
    out.register_class = 1;
    out.place = 7;
    facts.bindings = {&out};
    add(main, "main");
    add(other, "other");
    main.bindings = {&out};
    ir::Expr* resource = build.expr(ir::ExprKind::kBinding, out.resource);
    out.uses.push_back(resource);
    ir::Stmt* store = build.stmt(ir::StmtKind::kStore);
    store->operands = {resource, build.uint32(4)};
    // Folded: 3.
    store->value = build.binary(ir::BinaryOp::kAdd, build.uint32(1), build.uint32(2));
    main.ir->body = {store};
    ir::EntryPoint entry;
    entry.name = "main";
    entry.function = main.ir;
    entry.stage = ir::kStageCompute;
    module.entry_points.push_back(entry);
    facts.entries.push_back({&main, 0});
  }

  void finish() { finish_module(module, build, facts, report); }

  ir::Module module;
  IrTypes types{module};
  IrBuilder build{module, types};
  BindingFacts out;
  FunctionFacts main, other;
  ModuleFacts facts;
  Report report;

 private:
  void add(FunctionFacts& function, const std::string& name) {
    function.ir = &module.function_pool.emplace_back();
    function.ir->name = function.ir->mangled = name;
    function.ir->result = types.void_type();
    facts.functions.push_back(&function);
  }
};

TEST(Builder, MakesAModuleWithoutASyntaxTree) {
  Made made;
  made.finish();
  EXPECT_TRUE(made.report.lines.empty());
  ASSERT_EQ(made.module.functions.size(), 1u);  // what nothing reaches is left out
  EXPECT_EQ(made.module.functions[0]->name, "main");
  EXPECT_EQ(made.module.functions[0]->stages, uint32_t{ir::kStageCompute});
  const ir::Expr* value = made.module.functions[0]->body[0]->value;
  ASSERT_EQ(value->kind, ir::ExprKind::kLiteral);
  EXPECT_EQ(value->literal[0], 3u);
  ASSERT_EQ(made.module.bindings.size(), 1u);
  EXPECT_EQ(made.module.bindings[0].register_index, 0u);
  EXPECT_TRUE(made.module.bindings[0].automatic);
  EXPECT_EQ(made.module.bindings[0].location.line, 7u);
  EXPECT_EQ(made.module.entry_points[0].bindings, std::vector<uint32_t>{0});
}

TEST(Builder, AutomaticRegisterAvoidsTakenOne) {
  Made made;
  BindingFacts taken = made.out;
  taken.name = "taken";
  taken.uses.clear();
  taken.has_register = true;
  made.main.bindings.push_back(&taken);
  made.facts.bindings.push_back(&taken);
  made.finish();
  EXPECT_TRUE(made.report.lines.empty());
  EXPECT_EQ(made.out.register_index, 1u);
}

TEST(Builder, ReportsWhatTheStageMayNotDo) {
  Made made;
  made.other.stage_uses.push_back(
      {.place = 1, .name = "TraceRay", .stages = ir::kStageRayGeneration});
  made.main.callees = {&made.other};
  made.facts.functions = {&made.other, &made.main};
  made.finish();
  EXPECT_EQ(made.report.lines, std::vector<std::string>{"TraceRay in main"});
}

TEST(Builder, InternsTypes) {
  ir::Module module;
  IrTypes types(module);
  EXPECT_EQ(types.vector(Scalar::kFloat32, 1), types.scalar(Scalar::kFloat32));
  EXPECT_EQ(types.array(types.scalar(Scalar::kInt32), 3),
            types.array(types.scalar(Scalar::kInt32), 3));
  EXPECT_NE(types.array(types.scalar(Scalar::kInt32), 3),
            types.array(types.scalar(Scalar::kInt32), 4));
  EXPECT_EQ(types.with_scalar(types.vector(Scalar::kFloat32, 2), Scalar::kBool),
            types.vector(Scalar::kBool, 2));
  // An append buffer is a structured buffer with a counter.
  const ir::Type* element = types.scalar(Scalar::kUint32);
  EXPECT_EQ(types.resource(ir::ResourceKind::kAppendStructuredBuffer, element),
            types.resource(ir::ResourceKind::kRWStructuredBuffer, element));
}

// [DXR: Payload access qualifiers] A field that the caller does not pass is not copied to the
// stages, and one that it may not read is zero afterwards.
TEST(Builder, TracesWithACopyOfThePayload) {
  ir::Module module;
  IrTypes types(module);
  IrBuilder build(module, types);
  ir::Struct& structure = module.struct_pool.emplace_back();
  const ir::Type* number = types.scalar(Scalar::kUint32);
  structure.fields = {{"in", number}, {"out", number}};
  ir::Variable* payload =
      build.variable("payload", types.structure(&structure), ir::Storage::kLocal);
  const PayloadLeaves leaves = {{{0}, "in", {kPayloadMiss, kPayloadCaller}, number},
                                {{1}, "out", {kPayloadCaller, kPayloadMiss}, number}};
  EXPECT_FALSE(all_access(leaves, kPayloadCaller));
  ir::Stmt* trace = build.stmt(ir::StmtKind::kTraceRay);
  const ir::Block made = trace_with_copy(build, trace, payload, leaves);
  ASSERT_EQ(made.size(), 5u);
  EXPECT_EQ(made[0]->kind, ir::StmtKind::kDeclare);
  EXPECT_EQ(made[1]->place->index, 0u);  // copy.in = payload.in
  EXPECT_EQ(made[2], trace);
  EXPECT_EQ(made[3]->value->kind, ir::ExprKind::kLiteral);  // payload.in = 0
  EXPECT_EQ(made[4]->value->kind, ir::ExprKind::kField);    // payload.out = copy.out
}

}  // namespace
}  // namespace kaamos::hlsl
