// SPDX-License-Identifier: MIT
#include "runtime/embree/draw_shaders.h"

#include "runtime/backend/backend.h"
#include "runtime/checks/names.h"
#include "runtime/checks/report.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/fiber_group.h"
#include "runtime/embree/parallel.h"
#include "runtime/errors/text.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::embree {
namespace {

constexpr uint32_t kQuadLanes = 4;

void bind_shader(const runtime::LinkedShader& shader, const shader::DispatchConstants& constants,
                 std::vector<shader::BoundResource>& bound) {
  if (shader.code == nullptr || (shader.code->flags & shader::kExportReadsBound) == 0) return;
  bound.resize(shader.slots.size());
  shader::Invocation invocation;
  invocation.dispatch = &constants;
  invocation.slots = shader.slots.data();
  shader::bind(invocation, shader.code->bindings, shader.code->binding_count, bound.data());
}

struct QuadCall {
  shader::PixelThreadFn code = nullptr;
  shader::PixelLanes* lanes = nullptr;
};

void run_quad_lane(FiberThread& thread) {
  const auto& call = *static_cast<const QuadCall*>(thread.run->context);
  if ((call.lanes->active >> thread.first & 1) == 0) return;
  call.code(thread.invocation, *call.lanes, thread.run->group, thread.first);
}

// Runs the shaders of one thread. The worker stays with it from draw to draw.
class DrawThread final : public raster::ShaderThread {
 public:
  // Begins with the first draw, so that a fault before any shader runs has a label.
  explicit DrawThread(std::deque<RunningDraw>& draws) : draws_(draws) { begin(0); }
  ~DrawThread() override { end(); }
  DrawThread(const DrawThread&) = delete;
  DrawThread& operator=(const DrawThread&) = delete;

  void vertices(uint32_t draw, const shader::VertexLanes& lanes) override {
    begin(draw);
    const runtime::LinkedGraphics& linked = current_->pipeline().linked();
    worker_.running = &current_->pipeline().vertex();
    shader::Invocation invocation = invoke(linked.vertex, current_->vertex_bound);
    linked.vertex_desc().vertex(invocation, lanes);
  }

  void primitive(uint32_t draw, const shader::GeometryInputs& inputs,
                 shader::GeometryStream& stream) override {
    begin(draw);
    const runtime::LinkedGraphics& linked = current_->pipeline().linked();
    worker_.running = &current_->pipeline().geometry();
    shader::Invocation invocation = invoke(linked.geometry, current_->geometry_bound);
    linked.geometry_desc().geometry(invocation, inputs, stream);
  }

  void pixels(uint32_t draw, shader::PixelLanes& lanes) override {
    begin(draw);
    const runtime::LinkedGraphics& linked = current_->pipeline().linked();
    worker_.running = &current_->pipeline().pixel();
    shader::Invocation invocation = invoke(linked.pixel, current_->pixel_bound);
    const shader::GraphicsDesc& code = linked.pixel_desc();
    if (code.pixel != nullptr) return code.pixel(invocation, lanes);
    const QuadCall call = {code.pixel_thread, &lanes};
    FiberGroup group;
    group.worker = &worker_;
    group.group.wave_lanes = kQuadLanes;
    group.invocation = invocation;
    group.body = run_quad_lane;
    group.context = &call;
    run_fibers(group, shader::kGraphicsLanes, 1, kQuadLanes);
    if (group.split_quad && current_->dispatch.context != nullptr) report_split_quad();
    if (group.failed) remove_device(worker_, worker_.fault_reason);
  }

  Worker& worker() { return worker_; }

 private:
  // [RAS-88]
  void report_split_quad() const {
    const std::string& name = current_->pipeline().linked().pixel.name;
    current_->dispatch.context->reporter->report(
        checks::Id::kDivergentDerivative,
        "pixel shader " + errors::in_quotes(name) +
            " takes a derivative, or samples with an implicit level, where not all pixels of a 2 "
            "x 2 quad take part; D3D12 leaves the result undefined, here missing pixels count as "
            "0. Do it before the branch or loop, or use SampleLevel or SampleGrad.");
  }
  void begin(uint32_t draw) {
    RunningDraw* const next = &draws_[draw];
    if (next == current_) return;
    end();
    current_ = next;
    begin_worker(next->dispatch, worker_);
  }
  void end() {
    if (current_ == nullptr) return;
    end_worker(worker_);
    worker_.counters = {};
  }
  shader::Invocation invoke(const runtime::LinkedShader& shader,
                            const std::vector<shader::BoundResource>& bound) {
    shader::Invocation invocation;
    invocation.dispatch = &current_->dispatch.abi;
    invocation.slots = shader.slots.data();
    invocation.backend = &worker_;
    invocation.bound = bound.empty() ? nullptr : bound.data();
    return invocation;
  }

  std::deque<RunningDraw>& draws_;
  RunningDraw* current_ = nullptr;
  Worker worker_;
};

struct TaskCall {
  raster::Workers::Task task;
  const void* context;
  uint32_t number;
  DrawThread* thread;
};

void call_task(void* argument) {
  const auto& call = *static_cast<const TaskCall*>(argument);
  call.task(call.context, call.number, *call.thread);
}

}  // namespace

void begin_draw(const DispatchEnvironment& environment, RunningDraw& draw) {
  begin_dispatch(environment, draw.command.bindings, draw.dispatch);
  draw.dispatch.label = draw.label.c_str();
  const runtime::LinkedGraphics& linked = draw.pipeline().linked();
  bind_shader(linked.vertex, draw.dispatch.abi, draw.vertex_bound);
  bind_shader(linked.geometry, draw.dispatch.abi, draw.geometry_bound);
  bind_shader(linked.pixel, draw.dispatch.abi, draw.pixel_bound);
  draw.dispatch.begun.store(true, std::memory_order_release);
}

void DrawWorkers::run(uint32_t count, Task task, const void* context) {
  parallel_ranges(*environment_.arena, count, [&](uint64_t begin, uint64_t end) {
    const shader::FloatMode float_mode;
    DrawThread thread(draws_);
    for (uint64_t i = begin; i < end && !failed(); ++i) {
      TaskCall call = {task, context, static_cast<uint32_t>(i), &thread};
      if (run_guarded(thread.worker(), call_task, &call)) continue;
      record_removal(thread.worker());
      failed_.store(true, std::memory_order_relaxed);
    }
  });
}

}  // namespace kaamos::embree
