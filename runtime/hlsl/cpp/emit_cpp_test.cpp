// SPDX-License-Identifier: MIT
//
// Tests the emitter and the host compiler alone, on a module built by hand; tests/hlsl runs what
// the front end makes of HLSL through both.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/build_library.h"
#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/ir/emitted_names.h"

namespace kaamos::hlsl {
namespace {

using namespace ir;
namespace fs = std::filesystem;

// `results.Store(id * 4, id * 3)` for each of the 8 threads of one group.
struct TripleKernel {
  Module module;

  Expr* expr(ExprKind kind, const ir::Type* type) {
    Expr& e = module.expr_pool.emplace_back();
    e.kind = kind;
    e.type = type;
    return &e;
  }

  TripleKernel() {
    module.name = "triple \"quoted\"\n.hlsl";
    module.target = "cs_6_6";
    module.files = {"triple.hlsl"};
    ir::Type& uint = module.type_pool.emplace_back();
    uint.kind = ir::TypeKind::kScalar;
    uint.scalar = ir::Scalar::kUint32;
    ir::Type& none = module.type_pool.emplace_back();
    none.kind = ir::TypeKind::kVoid;
    ir::Type& buffer = module.type_pool.emplace_back();
    buffer.kind = ir::TypeKind::kResource;
    buffer.resource = ResourceKind::kRWByteAddressBuffer;
    Binding binding;
    binding.name = "results";
    binding.type = &buffer;
    binding.register_class = 1;
    module.bindings = {binding};

    Variable& id = module.variable_pool.emplace_back();
    id.name = "register";  // a C++ keyword
    id.type = &uint;
    id.storage = Storage::kParameter;
    const auto id_value = [&] {
      Expr* e = expr(ExprKind::kVariable, &uint);
      e->variable = &id;
      return e;
    };
    const auto times = [&](uint64_t factor) {
      Expr* literal = expr(ExprKind::kLiteral, &uint);
      literal->literal = {factor};
      Expr* e = expr(ExprKind::kBinary, &uint);
      e->binary = BinaryOp::kMultiply;
      e->operands = {id_value(), literal};
      return e;
    };
    Stmt& store = module.stmt_pool.emplace_back();
    store.kind = StmtKind::kStore;
    store.operands = {expr(ExprKind::kBinding, &buffer), times(4)};
    store.value = times(3);
    store.location = {0, 7, 3};

    Function& function = module.function_pool.emplace_back();
    function.name = "Main::main";
    function.mangled = "?main@Main@@YAXI@Z";
    function.result = &none;
    function.parameters = {&id};
    function.body = {&store};
    function.location = {0, 5, 1};
    function.end_location = {0, 8, 1};
    module.functions = {&function};
    EntryPoint entry;
    entry.name = "main";
    entry.function = &function;
    entry.stage = kStageCompute;
    entry.parameters = {EntryParameter::kDispatchThreadId};
    entry.thread_group[0] = 8;
    entry.bindings = {0};
    module.entry_points = {entry};
  }
};

class EmitTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "kaamos-emit-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    cache_ = pattern;
    const auto compiler = find_host_compiler();
    ASSERT_TRUE(compiler) << compiler.error();
    compiler_ = *compiler;
  }
  void TearDown() override { fs::remove_all(cache_); }

  fs::path cache_;
  HostCompiler compiler_;
};

TEST_F(EmitTest, AKernelRuns) {
  const TripleKernel kernel;
  const SharedObject built =
      build_shared_object(compiler_, emit_cpp(kernel.module, {}), Optimisation::kFull, cache_);
  ASSERT_EQ(built.error.message(), "");
  void* handle = dlopen(built.path.c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(handle, nullptr) << dlerror();
  const auto entry =
      reinterpret_cast<shader::LibraryEntryPointFn>(dlsym(handle, shader::kLibraryEntryPoint));
  ASSERT_NE(entry, nullptr);
  const shader::LibraryDesc& library = *entry();
  EXPECT_EQ(library.abi_version, shader::kAbiVersion);
  EXPECT_STREQ(library.name, "triple \"quoted\"\n.hlsl");
  ASSERT_EQ(library.export_count, 1u);
  ASSERT_NE(library.exports[0].compute, nullptr);
  ASSERT_NE(library.exports[0].compute->group, nullptr);
  EXPECT_STREQ(library.exports[0].mangled_name, "?main@Main@@YAXI@Z");

  uint32_t results[9] = {};
  const uint64_t address = reinterpret_cast<uintptr_t>(results);
  shader::DispatchConstants dispatch;
  dispatch.root_arguments = reinterpret_cast<const uint8_t*>(&address);
  shader::BindingSlot slot;
  slot.source = shader::SlotSource::kRootDescriptor;
  slot.kind = shader::DescriptorKind::kRawBuffer;
  slot.access = shader::DescriptorAccess::kUnorderedAccess;
  shader::Invocation invocation;
  invocation.dispatch = &dispatch;
  invocation.slots = &slot;
  shader::ComputeGroup group;
  library.exports[0].compute->group(invocation, group);
  for (uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(results[i], i * 3);
  }
  EXPECT_EQ(results[8], 0u);
  dlclose(handle);
}

TEST_F(EmitTest, ALibraryHasTheSpirvOfItsExports) {
  const TripleKernel kernel;
  const auto export_of = [&](bool spirv, bool from_cache) {
    const SharedObject built =
        build_library(compiler_, kernel.module,
                      {.optimisation = Optimisation::kNone, .spirv = spirv, .cache = cache_});
    EXPECT_EQ(built.error.message(), "");
    EXPECT_EQ(built.from_cache, from_cache);
    void* handle = dlopen(built.path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const auto entry =
        reinterpret_cast<shader::LibraryEntryPointFn>(dlsym(handle, shader::kLibraryEntryPoint));
    return entry()->exports[0];
  };
  EXPECT_EQ(export_of(false, false).spirv, nullptr);
  const shader::ExportDesc with = export_of(true, false);
  ASSERT_GT(with.spirv_words, 5u);
  EXPECT_EQ(with.spirv[0], 0x07230203u);
  EXPECT_EQ(export_of(true, true).spirv_words, with.spirv_words);
  EXPECT_EQ(export_of(false, true).spirv_words, 0u);
}

TEST_F(EmitTest, TheCacheKnowsWhatItBuilt) {
  const std::string source = emit_cpp(TripleKernel().module, {});
  const SharedObject first = build_shared_object(compiler_, source, Optimisation::kNone, cache_);
  ASSERT_EQ(first.error.message(), "");
  EXPECT_FALSE(first.from_cache);
  const SharedObject again = build_shared_object(compiler_, source, Optimisation::kNone, cache_);
  EXPECT_TRUE(again.from_cache);
  EXPECT_EQ(again.path, first.path);
  const SharedObject other =
      build_shared_object(compiler_, source + "\n", Optimisation::kNone, cache_);
  EXPECT_FALSE(other.from_cache);
  EXPECT_NE(other.path, first.path);
  size_t entries = 0;
  for (const auto& entry : fs::directory_iterator(cache_)) {
    // Two objects and the headers, and nothing left over from building them.
    if (!entry.path().filename().string().starts_with("headers-")) ++entries;
  }
  EXPECT_EQ(entries, 2u);
}

TEST_F(EmitTest, AFailedCompilationSaysWhatTheCompilerSaid) {
  const SharedObject built =
      build_shared_object(compiler_, "int broken = ;", Optimisation::kNone, cache_);
  EXPECT_TRUE(built.path.empty());
  EXPECT_NE(built.error.text.find("failed with exit code"), std::string::npos) << built.error.text;
  EXPECT_NE(built.error.text.find("error:"), std::string::npos) << built.error.text;
}

TEST_F(EmitTest, ACacheThatCannotBeWrittenIsAnError) {
  const fs::path file = cache_ / "file";
  std::ofstream(file) << "x";
  const SharedObject built = build_shared_object(compiler_, "", Optimisation::kNone, file / "in");
  EXPECT_NE(built.error.text.find("KAAMOS_CACHE_DIR"), std::string::npos) << built.error.text;
}

TEST(HostCompilerTest, AMissingCompilerIsNamed) {
  setenv("KAAMOS_CXX", "/nowhere/c++", 1);
  const std::string error = find_host_compiler().error();
  unsetenv("KAAMOS_CXX");
  EXPECT_NE(error.find("/nowhere/c++"), std::string::npos) << error;
}

TEST(EmitNamesTest, NamesAreValidAndStayReadable) {
  EXPECT_EQ(cpp_identifier("Payload"), "Payload");
  EXPECT_EQ(cpp_identifier("Scene::Vertex<float>"), "Scene_Vertex_float_");
  EXPECT_EQ(cpp_identifier("template"), "template_");
  EXPECT_EQ(cpp_identifier("__a__b"), "v_a_b");
  EXPECT_EQ(cpp_identifier(""), "t");
}

TEST(EmitNamesTest, AnInnerScopeNeverHidesAnOuterName) {
  ScopedNames names;
  names.push();
  EXPECT_EQ(names.declare("i"), "i");
  names.push();
  EXPECT_EQ(names.declare("i"), "i_2");
  names.pop();
  names.push();
  EXPECT_EQ(names.declare("j"), "j");
  names.pop();
  EXPECT_EQ(names.declare("i"), "i_2");
}

}  // namespace
}  // namespace kaamos::hlsl
