// SPDX-License-Identifier: MIT
#include <kaamos/shader/abi.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/explain/scene.h"

using namespace rtapi;
namespace shader = kaamos::shader;

KAAMOS_EXPLAIN_SUITE(Explain);

namespace {

// The text without the two lines that name device and executor.
std::string tree_of(const PixelExplanation& explanation) {
  const std::string text = ToText(explanation);
  return text.substr(text.find('\n', text.find('\n') + 1) + 1);
}

}  // namespace

TEST_P(Explain, IgnoredHitsOfALeafAreShownInOrderAndSoIsEverythingElse) {
  CommandList list = record();
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 0}).value();
  const std::string expected = R"(ray generation "ExplainRayGen"
  ray generation record 0, "ExplainRayGen"
  TraceRay, depth 1
    scene: buffer "top level" + 0 (SIZE bytes)
    flags: CULL_BACK_FACING_TRIANGLES; mask 0x1
    ray: origin (0.25, 0.25, 0), direction (0, 0, 1), t 0 to 6.5
    records: ray contribution 0, geometry multiplier 2, miss index 0
    payload before: color = 0 0 0, leaves = 0
    7 candidates, front to back:
      t 1: instance 0 (ID 10), geometry 0, triangle 0, front face: ignored (any-hit "LeafAnyHit" ignored it)
        any-hit "LeafAnyHit": ignored
          hit group record 0 = 0 (ray) + 2 (multiplier) * 0 (geometry) + 0 (instance), "Leaf"
          attributes: barycentrics = 0.25 0.25
          payload before: color = 0 0 0, leaves = 0
          payload after: color = 0 0 0, leaves = 1
      t 2: instance 1 (ID 11), geometry 0, triangle 0, front face: ignored (any-hit "LeafAnyHit" ignored it)
        any-hit "LeafAnyHit": ignored
          hit group record 0 = 0 (ray) + 2 (multiplier) * 0 (geometry) + 0 (instance), "Leaf"
          attributes: barycentrics = 0.25 0.25
          payload before: color = 0 0 0, leaves = 1
          payload after: color = 0 0 0, leaves = 2
      t 3: instance 2 (ID 12), geometry 0, triangle 0, front face: masked (InstanceMask 0x02 & InstanceInclusionMask 0x01 is 0)
      t 4: instance 3 (ID 13), geometry 0, triangle 0, back face: culled (back face, CULL_BACK_FACING_TRIANGLES)
      t 5: instance 4 (ID 14), geometry 0, triangle 0, front face: committed (opaque by the geometry's flags)
      t 6: instance 5 (ID 15), geometry 0, triangle 0, front face: behind (not in front of the committed hit at t 5)
      t 7: instance 6 (ID 16), geometry 0, triangle 0, front face: out of range (not in front of TMax 6.5)
    hit at t 5
    closest-hit "WallHit"
      hit group record 2 = 0 (ray) + 2 (multiplier) * 0 (geometry) + 2 (instance), "Wall"
      attributes: barycentrics = 0.25 0.25
      payload before: color = 0 0 0, leaves = 2
      TraceRay, depth 2
        scene: buffer "top level" + 0 (SIZE bytes)
        flags: ACCEPT_FIRST_HIT_AND_END_SEARCH | SKIP_CLOSEST_HIT_SHADER; mask 0x1
        ray: origin (0.25, 0.25, 4.5), direction (0, 0, -1), t 0 to 10
        records: ray contribution 1, geometry multiplier 2, miss index 1
        payload before: open = 0
        4 candidates, front to back:
          t 0.5: instance 3 (ID 13), geometry 0, triangle 0, front face: committed (opaque by the geometry's flags)
          t 1.5: instance 2 (ID 12), geometry 0, triangle 0, back face: masked (InstanceMask 0x02 & InstanceInclusionMask 0x01 is 0)
          t 2.5: instance 1 (ID 11), geometry 0, triangle 0, back face: not reached (the search had ended)
          t 3.5: instance 0 (ID 10), geometry 0, triangle 0, back face: not reached (the search had ended)
        hit at t 0.5
        payload after: open = 0
      payload after: color = 0 0 0, leaves = 2
    payload after: color = 0 0 0, leaves = 2
)";
  std::string text = tree_of(explanation);
  const std::string size = std::to_string(top_level_.size()) + " bytes";
  for (size_t at; (at = text.find(size)) != std::string::npos;) {
    text.replace(at, size.size(), "SIZE bytes");
  }
  EXPECT_EQ(text, expected);
}

TEST_P(Explain, TheListRunsAndTheReplayLeavesNoTrace) {
  CommandList list = record();
  ASSERT_TRUE(ExplainPixel(queue_, list, {.X = 3}).ok());
  // The shader adds to what is there, so it would be added twice if the replay's writes stayed.
  const std::vector<float> with = results();
  CommandList plain = record();
  queue_.ExecuteAndWait(plain).value();
  EXPECT_EQ(with, results());
  EXPECT_EQ(with[3], 2.0f);   // leaves in front of the wall
  EXPECT_EQ(with[12], 3.0f);  // where the sphere reports its hit
}

TEST_P(Explain, AReportedHitCountsInsideTheRangeOnly) {
  CommandList list = record();
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 3}).value();
  ASSERT_EQ(explanation.RayGeneration.size(), 1u);
  const ExplainedCall& trace = explanation.RayGeneration[0].Calls.at(0);
  ASSERT_EQ(trace.Candidates.size(), 1u);
  const ExplainedCandidate& box = trace.Candidates[0];
  EXPECT_TRUE(box.Procedural);
  EXPECT_NEAR(box.T, 2, 1e-5);
  EXPECT_EQ(box.Outcome, CandidateOutcome::kCommitted);
  const ExplainedShader& shader = box.Shaders.at(0);
  EXPECT_EQ(shader.Name, "SphereIntersection");
  ASSERT_EQ(shader.Calls.size(), 2u);
  EXPECT_EQ(shader.Calls[0].Note, "rejected: t is not between TMin 0 and 6.5");
  EXPECT_EQ(shader.Calls[1].Note, "accepted");
  EXPECT_EQ(trace.HitT, 3);
  const ExplainedShader& hit = trace.Shaders.at(0);
  EXPECT_EQ(hit.Name, "SphereHit");
  EXPECT_EQ(hit.Record.Index, 4u);
  EXPECT_EQ(hit.Attributes.at(0).Text, "3");
  EXPECT_EQ(hit.After.at(0).Text, "3 0 0");
}

TEST_P(Explain, ARayQueryTellsWhatItsShaderDecided) {
  CommandList list = record();
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 1}).value();
  const ExplainedCall& query = explanation.RayGeneration.at(0).Calls.at(0);
  EXPECT_EQ(query.Kind, ExplainedCallKind::kRayQuery);
  ASSERT_EQ(query.Candidates.size(), 7u);
  const CandidateOutcome expected[] = {CandidateOutcome::kNotCommitted,
                                       CandidateOutcome::kCommitted,
                                       CandidateOutcome::kMasked,
                                       CandidateOutcome::kCulledByFace,
                                       CandidateOutcome::kBehindCommittedHit,
                                       CandidateOutcome::kBehindCommittedHit,
                                       CandidateOutcome::kOutsideRange};
  for (size_t i = 0; i < 7; ++i) EXPECT_EQ(query.Candidates[i].Outcome, expected[i]) << i;
  EXPECT_EQ(query.HitT, 2);
  EXPECT_FLOAT_EQ(results()[4], 2.0f);  // within the error of Embree's reciprocal
}

TEST_P(Explain, ACallableShowsItsDataBeforeAndAfter) {
  CommandList list = record();
  const PixelExplanation explanation = ExplainPixel(queue_, list, {.X = 2}).value();
  const std::string expected = R"(ray generation "ExplainRayGen"
  ray generation record 0, "ExplainRayGen"
  CallShader
    data before: uv = 0.5 0.25, done = false
    callable "Tint"
      callable record 0 = 0 (shader index), "Tint"
    data after: uv = 1 0.5, done = true
)";
  EXPECT_EQ(tree_of(explanation), expected);
}

TEST_P(Explain, JsonHoldsTheTree) {
  CommandList list = record();
  const auto json = nlohmann::json::parse(ToJson(ExplainPixel(queue_, list, {.X = 0}).value()));
  const auto& trace = json["ray_generation"][0]["calls"][0];
  EXPECT_EQ(trace["call"], "TraceRay");
  EXPECT_EQ(trace["flag_names"], "CULL_BACK_FACING_TRIANGLES");
  ASSERT_EQ(trace["candidates"].size(), 7u);
  EXPECT_EQ(trace["candidates"][0]["outcome"], "ignored");
  EXPECT_EQ(trace["candidates"][0]["shaders"][0]["after"][1]["value"], "1");
  EXPECT_EQ(trace["candidates"][4]["record"]["index"], 2);
  const auto& nested = trace["shaders"][0]["calls"][0];
  EXPECT_EQ(nested["depth"], 2);
  EXPECT_EQ(nested["hit_t"], 0.5);
}

TEST_P(Explain, StatisticsCountWhatTheTreeShows) {
  CommandList list = record();
  const DispatchStatistics statistics = CollectPixelStatistics(queue_, list).value();
  ASSERT_EQ(statistics.Pixels.size(), 4u);
  const PixelStatistics& primary = statistics.Pixels[0];
  EXPECT_EQ(primary.TraceRayCalls, 2u);
  EXPECT_EQ(primary.Candidates, 4u);  // two leaves, the wall, the shadow's blocker
  EXPECT_EQ(primary.AnyHitCalls, 2u);
  EXPECT_EQ(primary.MaxDepth, 2u);
  EXPECT_EQ(statistics.Pixels[1].RayQueries, 1u);
  EXPECT_EQ(statistics.Pixels[1].Candidates, 2u);
  EXPECT_EQ(statistics.Pixels[2].CallableCalls, 1u);
  EXPECT_EQ(statistics.Pixels[3].IntersectionCalls, 1u);
  EXPECT_EQ(results()[3], 2.0f);
}

TEST_P(Explain, AFaultOfAShaderEndsTheReplayAndTheTreeUpToThereIsReturned) {
  // The descriptor of the wall's colors, pointed at an address without memory.
  shader::Descriptor* slot = nullptr;
  const size_t handle = heap_.GetCPUDescriptorHandle(2).ptr;
  std::memcpy(&slot, &handle, sizeof slot);
  slot->address = 0x10000;
  CommandList list = record();
  const auto explanation = ExplainPixel(queue_, list, {.X = 0});
  ASSERT_TRUE(explanation.ok()) << explanation.error().message;
  EXPECT_EQ(explanation->Removal, "signal 11 at address 0x10000");
  const ExplainedCall& trace = explanation->RayGeneration.at(0).Calls.at(0);
  EXPECT_EQ(trace.Candidates.size(), 7u);
  EXPECT_EQ(trace.Shaders.at(0).Name, "WallHit");
  EXPECT_EQ(trace.Shaders.at(0).Calls.size(), 1u);
  EXPECT_FALSE(device_.GetDeviceRemovedReason().ok());
}

TEST_P(Explain, ErrorsNameWhatIsWrong) {
  CommandList list = record();
  CommandQueue none;
  EXPECT_EQ(ExplainPixel(none, list, {}).error().id.text(), "KA0904");
  CommandList empty;
  EXPECT_EQ(ExplainPixel(queue_, empty, {}).error().id.text(), "KA0904");
  EXPECT_EQ(ExplainPixel(queue_, list, {.X = 4}).error().message,
            "KA0916 cannot explain the pixel: index (4, 0, 0) is outside the dispatch (4 x 1 x 1)");
  CommandList again = record();
  EXPECT_EQ(ExplainPixel(queue_, again, {.Dispatch = 1}).error().message,
            "KA0916 cannot explain the pixel: Dispatch is 1, but the list has only 1 calls of "
            "DispatchRays");
}

TEST_P(Explain, MemoryFreedAfterRecordingIsTheErrorOfTheQueueAndNothingRuns) {
  CommandList list = record();
  ASSERT_TRUE(list.Close().ok());
  const std::vector<float> before = results();
  tables_[0] = {};
  const auto pixel = ExplainPixel(queue_, list, {.X = 3});
  ASSERT_FALSE(pixel.ok());
  EXPECT_EQ(pixel.error().id.text(), "KA0856");
  EXPECT_EQ(pixel.error().message, queue_.ExecuteCommandLists({list}).error().message);
  EXPECT_FALSE(CollectPixelStatistics(queue_, list, {}).ok());
  EXPECT_TRUE(device_.GetDeviceRemovedReason().ok());
  EXPECT_EQ(results(), before);
}
