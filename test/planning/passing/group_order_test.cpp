#include "planning/passing/group_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planning/passing/cell_world.h"
#include "world/obstacle.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Rows = std::vector<std::string>;

constexpr PassingPace kPace = {1.0, 0.5, 1.0, false, 1.0};

/// Members a, b, c ... from where the letters are in the first to where they are in the second; who
/// is not there has no goal.
std::vector<PassingMember> members_of(const Rows& starts, const Rows& goals) {
  std::vector<PassingMember> members;
  for (const Vector2& place : test::letters_of(starts)) {
    const char letter = static_cast<char>('a' + members.size());
    members.push_back({std::string(1, letter), place, std::nullopt});
    for (int row = 0; row < static_cast<int>(goals.size()); ++row) {
      const auto column = goals[row].find(letter);
      if (column != std::string::npos)
        members.back().goal = test::centre_of_cell(goals, row, static_cast<int>(column));
    }
  }
  return members;
}

std::optional<GroupOrder> order_in(const Rows& starts, const Rows& goals,
                                   std::vector<BlockedDisc> blocked = {}) {
  return order_group({*test::static_map_of_cells(starts), std::move(blocked)},
                     members_of(starts, goals), test::graph_options(), kPace);
}

/// Where a member is after all its moves.
Vector2 end_of(const GroupOrder& group, std::size_t member, const std::vector<PassingMember>& all) {
  const auto& turns = group.order[member];
  return turns.empty() ? all[member].place : turns.back().path.back();
}

TEST(GroupOrder, LeadsAllToTheirGoalsWhereThatIsPossible) {
  int possible = 0;
  for (const auto& puzzle : test::puzzles()) {
    const auto outcome = test::solved(test::in_space(puzzle)).outcome;
    if (outcome != PassingSequence::Outcome::kFound) continue;
    ++possible;
    const auto members = members_of(puzzle.starts, puzzle.goals);
    const auto group = order_in(puzzle.starts, puzzle.goals);
    ASSERT_TRUE(group) << puzzle.name;
    ASSERT_EQ(group->order.size(), members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
      EXPECT_TRUE(group->gets_there[i]) << puzzle.name << i;
      EXPECT_LT((end_of(*group, i, members) - *members[i].goal).norm(), 0.03) << puzzle.name << i;
      Vector2 place = members[i].place;
      for (const PassingTurn& turn : group->order[i]) {
        EXPECT_LT((turn.path.front() - place).norm(), 0.03);
        EXPECT_LE(turn.path.size(), kMostTurnPlaces);
        place = turn.path.back();
      }
    }
  }
  EXPECT_GE(possible, 3);
}

/// Seven on nine cells, as in loop-chain of Okumura's puzzles; two do not stand in the middle.
TEST(GroupOrder, GivesUpNoGoalWhereManyStandClose) {
  const Rows starts = {"edc.", "f#b#", "g.a#"};
  const Rows goals = {"cde.", "b#f#", "a.g#"};
  auto members = members_of(starts, goals);
  members[0].place.y() += 0.05;
  members[6].place.y() += 0.05;
  const auto group =
      order_group({*test::static_map_of_cells(starts), {}}, members, test::graph_options(), kPace);
  ASSERT_TRUE(group);
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_TRUE(group->gets_there[i]) << i;
    EXPECT_LT((end_of(*group, i, members) - *members[i].goal).norm(), 0.03) << i;
  }
}

/// How near a way comes to a place.
double gap_m(const std::vector<Vector2>& path, const Vector2& place) {
  double least_m = (path.front() - place).norm();
  for (std::size_t i = 1; i < path.size(); ++i)
    least_m = std::min(least_m, (nearest_on_segment(place, path[i - 1], path[i]) - place).norm());
  return least_m;
}

bool may_begin(const PassingTurn& turn, const std::vector<std::size_t>& made) {
  return std::all_of(turn.after.begin(), turn.after.end(), [&](const PassingProgress& progress) {
    return made[progress.robot] >= progress.moves;
  });
}

/// Makes the moves one by one, whichever the order allows, drawn by lot; each has to keep away from
/// where the others are. Returns where all are in the end.
std::vector<Vector2> drive(const PassingOrder& order, std::vector<Vector2> places, int seed) {
  std::mt19937 random(seed);
  std::vector<std::size_t> made(order.size(), 0);
  for (;;) {
    std::vector<std::size_t> next;
    for (std::size_t robot = 0; robot < order.size(); ++robot) {
      const bool is_through = made[robot] == order[robot].size();
      if (!is_through && may_begin(order[robot][made[robot]], made)) next.push_back(robot);
    }
    if (next.empty()) return places;
    const std::size_t robot = next[random() % next.size()];
    const std::vector<Vector2>& path = order[robot][made[robot]++].path;
    EXPECT_LT((path.front() - places[robot]).norm(), 0.03);
    for (std::size_t other = 0; other < order.size(); ++other) {
      if (other == robot) continue;
      const double apart_m = std::min(test::kApart_m, (places[other] - path.front()).norm());
      EXPECT_GE(gap_m(path, places[other]), apart_m - 0.03);
    }
    places[robot] = path.back();
  }
}

/// They are too many for the search for the fewest moves.
TEST(GroupOrder, LeadsTenToTheirGoals) {
  const Rows starts = {"abcde", ".....", "fghij"};
  const Rows goals = {"jihgf", ".....", "edcba"};
  const auto members = members_of(starts, goals);
  const auto group = order_in(starts, goals);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>(10, true));
  for (int seed = 0; seed < 20; ++seed) {
    const auto ends = drive(group->order, test::letters_of(starts), seed);
    for (std::size_t i = 0; i < members.size(); ++i)
      EXPECT_LT((ends[i] - *members[i].goal).norm(), 0.03) << members[i].name;
  }
}

TEST(GroupOrder, WhoHasNoGoalMakesRoom) {
  const Rows starts = {"a.b..", "##.##"};
  const auto members = members_of(starts, {"....a", "##.##"});
  const auto group = order_in(starts, {"....a", "##.##"});
  ASSERT_TRUE(group);
  EXPECT_TRUE(group->gets_there[0]);
  EXPECT_FALSE(group->gets_there[1]);
  EXPECT_FALSE(group->order[1].empty());
  EXPECT_GT((end_of(*group, 1, members) - *members[0].goal).norm(), test::kApart_m - 0.03);
}

/// In a tube, two cannot change places.
TEST(GroupOrder, TheLowestRankGivesUpWhereNotAllCanGetThere) {
  const Rows starts = {".a.b."};
  const Rows goals = {"b..a."};
  const auto members = members_of(starts, goals);
  const auto group = order_in(starts, goals);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>({true, false}));
  EXPECT_LT((end_of(*group, 0, members) - *members[0].goal).norm(), 0.03);
}

TEST(GroupOrder, NothingWhereNotEvenTheFirstCanGetThere) {
  EXPECT_FALSE(order_in({".a.b."}, {"....a"}));
}

TEST(GroupOrder, OnlyTheLowestRankGivesUpWhereTheOthersCanPass) {
  const Rows starts = {"ab.c.", "##.##"};
  const Rows goals = {".a...", "##b##"};  // c is walled out below
  const auto members = members_of(starts, goals);
  auto with_far_goal = members;
  with_far_goal[2].goal = Vector2(0.6, 0.6);  // in the wall
  const auto group = order_group({*test::static_map_of_cells(starts), {}}, with_far_goal,
                                 test::graph_options(), kPace);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>({true, true, false}));
}

TEST(GroupOrder, AGoalOutOfReachIsGivenUpWhateverTheRank) {
  const Rows starts = {"a.b.", "....", "####", "...."};
  auto members = members_of(starts, {"b.a.", "....", "####", "...."});
  members[0].goal = test::centre_of_cell(starts, 3, 1);  // beyond the wall
  const auto group =
      order_group({*test::static_map_of_cells(starts), {}}, members, test::graph_options(), kPace);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>({false, true}));
  EXPECT_LT((end_of(*group, 1, members) - *members[1].goal).norm(), 0.03);
}

TEST(GroupOrder, OfGoalsThatAreTooNearToEachOtherTheHigherRankGetsItsOwn) {
  const Rows starts = {"a...b"};
  auto members = members_of(starts, starts);
  for (const double apart_m : {0.0, 0.01, 0.9 * test::kApart_m}) {
    members[0].goal = Vector2(3.0, 0.6);
    members[1].goal = Vector2(3.0 + apart_m, 0.6);
    const auto group = order_group({*test::static_map_of_cells(starts), {}}, members,
                                   test::graph_options(), kPace);
    ASSERT_TRUE(group);
    EXPECT_EQ(group->gets_there, std::vector<bool>({true, false})) << apart_m;
  }
  members[1].goal = Vector2(3.0 + 1.1 * test::kApart_m, 0.6);
  const auto group =
      order_group({*test::static_map_of_cells(starts), {}}, members, test::graph_options(), kPace);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>({true, true}));
}

TEST(GroupOrder, WhoCannotStandBesideAHigherRankCostsNoThirdItsGoal) {
  const Rows starts = {"a...b", "....c"};
  auto members = members_of(starts, {".....", "c...."});
  members[0].goal = Vector2(3.0, 1.8);
  members[1].goal = Vector2(3.5, 1.8);
  const auto group =
      order_group({*test::static_map_of_cells(starts), {}}, members, test::graph_options(), kPace);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>({true, false, true}));
}

TEST(GroupOrder, NobodyGoesWhereItIsBlocked) {
  const Rows starts = {"a...b", "#.#.#", "#...#"};
  const Rows goals = {"b...a", "#.#.#", "#...#"};
  const BlockedDisc disc{test::centre_of_cell(starts, 2, 2), 0.7};
  const auto free = order_in(starts, goals);
  ASSERT_TRUE(free);
  EXPECT_EQ(free->gets_there, std::vector<bool>({true, true}));
  const auto group = order_in(starts, goals, {disc});
  ASSERT_TRUE(group);
  for (const auto& turns : group->order) {
    for (const PassingTurn& turn : turns) {
      for (const Vector2& place : turn.path)
        EXPECT_GE((place - disc.centre).norm(), disc.radius_m - 0.05);
    }
  }
}

TEST(GroupOrder, TheWayThatIsBlockedIsNone) {
  const Rows starts = {"a....", "##.##"};
  const auto members = members_of(starts, {"....a", "##.##"});
  const BlockedDisc disc{test::centre_of_cell(starts, 0, 3), 0.8};
  const auto group = order_group({*test::static_map_of_cells(starts), {disc}}, members,
                                 test::graph_options(), kPace);
  if (group) {
    EXPECT_FALSE(group->gets_there[0]);
  }
}

/// The only siding is far away from both.
TEST(GroupOrder, LooksForRoomFartherAwayWhereThereIsNoneNearBy) {
  const Rows starts = {"...........ab..", "##.############"};
  const Rows goals = {"...........ba..", "##.############"};
  const auto group = order_in(starts, goals);
  ASSERT_TRUE(group);
  EXPECT_EQ(group->gets_there, std::vector<bool>({true, true}));
  double farthest_m = 1e9;
  for (const auto& turns : group->order) {
    for (const PassingTurn& turn : turns) farthest_m = std::min(farthest_m, turn.path.back().x());
  }
  EXPECT_LT(farthest_m, 4.0);
}

/// The siding nearby was not seen; the one far away was.
TEST(GroupOrder, MakesRoomOnGroundThatWasNotSeenOnlyIfNothingElseDoes) {
  const Rows starts = {"..ab...........", "##.#########.##"};
  const Rows goals = {"..ba...........", "##.#########.##"};
  const auto lowest_of_all = [&](const ObstacleField<2>* unseen, double from_x) {
    const auto group = order_group({*test::static_map_of_cells(starts), {}, unseen},
                                   members_of(starts, goals), test::graph_options(), kPace);
    EXPECT_TRUE(group && group->gets_there == std::vector<bool>({true, true}));
    double lowest_m = 1e9;
    for (const auto& turns : group->order) {
      for (const PassingTurn& turn : turns) {
        const Vector2& end = turn.path.back();
        if (end.x() >= from_x) lowest_m = std::min(lowest_m, end.y());
      }
    }
    return lowest_m;
  };
  const Circle near_siding{test::centre_of_cell(starts, 1, 2), 0.6};
  const Circle far_siding{test::centre_of_cell(starts, 1, 12), 0.6};
  const double below_m = test::centre_of_cell(starts, 0, 0).y() - 0.4;
  EXPECT_LT(lowest_of_all(nullptr, 0.0), below_m);
  const PrimitiveField<2> near_unseen({near_siding}, 1.0);
  EXPECT_LT(lowest_of_all(&near_unseen, 10.0), below_m);
  const PrimitiveField<2> both_unseen({near_siding, far_siding}, 1.0);
  EXPECT_LT(lowest_of_all(&both_unseen, 0.0), below_m);
}

TEST(GroupOrder, NothingForNobodyAndForTooMany) {
  const Rows rows = {"....."};
  const auto static_map = test::static_map_of_cells(rows);
  EXPECT_FALSE(order_group({*static_map, {}}, {}, test::graph_options(), kPace));
  const std::vector<PassingMember> many(JointStep::kMostRobots + 1,
                                        {"a", test::centre_of_cell(rows, 0, 0), std::nullopt});
  EXPECT_FALSE(order_group({*static_map, {}}, many, test::graph_options(), kPace));
}

TEST(GroupOrder, NothingWhereItIsStopped) {
  const Rows starts = {"ab...cd", "###.###"};
  const auto members = members_of(starts, {"cd...ab", "###.###"});
  EXPECT_FALSE(order_group({*test::static_map_of_cells(starts), {}}, members, test::graph_options(),
                           kPace, [] { return true; }));
}

}  // namespace
}  // namespace mocha
