#include "ros_bridge/rviz/candidate_drawing.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

using visualization_msgs::Marker;

PlanCandidate candidate(double y, PlanReason reason, double cost) {
  PlanCandidate result;
  result.reason = reason;
  result.cost = cost;
  result.path = {{0.0, 0.0}, {2.0, y}, {4.0, 0.0}};
  return result;
}

std::vector<Marker> of_type(const Drawing& drawing, int type) {
  std::vector<Marker> found;
  for (const Marker& marker : drawing.markers().markers) {
    if (marker.type == type && marker.action == Marker::ADD) found.push_back(marker);
  }
  return found;
}

TEST(CandidateDrawing, ShowsCostsReasonsAndTheSelectedOne) {
  std::vector<PlanCandidate> candidates = {candidate(0.0, PlanReason::kSolved, 9.74),
                                           candidate(2.0, PlanReason::kSolved, 12.0),
                                           candidate(-2.0, PlanReason::kCannotWin, 13.0)};
  candidates[0].selected = true;
  candidates[0].motion = straight_drive(0.0, {0.0, 0.0}, 0.0, 4.0, 1.0, 1.0);
  candidates[0].path.clear();
  Drawing drawing("map", ros::Time(1.0));
  draw_candidates("candidates", candidates, drawing);
  const auto lines = of_type(drawing, Marker::LINE_STRIP);
  const auto dashes = of_type(drawing, Marker::LINE_LIST);
  const auto texts = of_type(drawing, Marker::TEXT_VIEW_FACING);
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_EQ(dashes.size(), 1u);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_GT(lines[0].scale.x, lines[1].scale.x);
  EXPECT_NE(lines[0].color.r, lines[1].color.r);
  EXPECT_EQ(texts[0].text, "9.7");
  EXPECT_EQ(texts[1].text, "12.0");
  EXPECT_EQ(texts[2].text, "> 13.0");
  EXPECT_GT(texts[1].pose.position.y, 1.5);  // where it is far from the others
  EXPECT_LT(texts[2].pose.position.y, -1.0);
}

TEST(CandidateDrawing, SaysWhatIsViolated) {
  PlanCandidate refused = candidate(1.0, PlanReason::kNotCertified, 10.0);
  refused.violation.term = ViolatedTerm::kClearance;
  Drawing drawing("map", ros::Time(1.0));
  draw_candidates("candidates", {refused}, drawing);
  EXPECT_NE(of_type(drawing, Marker::TEXT_VIEW_FACING).at(0).text.find("clearance"),
            std::string::npos);
}

TEST(CandidateDrawing, NothingToSeeIsNoFault) {
  PlanCandidate nothing;
  Drawing drawing("map", ros::Time(1.0));
  draw_candidates("candidates", {nothing, candidate(1.0, PlanReason::kSolved, 1.0)}, drawing);
  EXPECT_EQ(of_type(drawing, Marker::TEXT_VIEW_FACING).size(), 1u);
}

}  // namespace
}  // namespace mocha
