#include "planning/passing/place_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planning/passing/cell_world.h"
#include "world/obstacle.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using test::kApart_m;
using test::kClearance_m;

double gap_m(const Vector2& place, const std::vector<Vector2>& path) {
  double least_m = (place - path.front()).norm();
  for (std::size_t i = 1; i < path.size(); ++i)
    least_m = std::min(least_m, (place - nearest_on_segment(place, path[i - 1], path[i])).norm());
  return least_m;
}

const PlaceMove* move_between(const PlaceGraph& graph, int from, int to) {
  for (const PlaceMove& move : graph.moves[from]) {
    if (move.to == to) return &move;
  }
  return nullptr;
}

TEST(PlaceGraph, PathsAreFreeAndSayWhoIsInTheirWay) {
  for (const auto& puzzle : test::puzzles()) {
    const PassingProblem problem = test::in_space(puzzle);
    const auto static_map = test::static_map_of_cells(puzzle.starts);
    const PlaceGraph& graph = problem.graph;
    int moves = 0;
    for (int from = 0; from < graph.size(); ++from) {
      for (const PlaceMove& move : graph.moves[from]) {
        ++moves;
        EXPECT_EQ(move.path.front(), graph.places[from]);
        EXPECT_EQ(move.path.back(), graph.places[move.to]);
        EXPECT_GE(move.length_m + 1e-9, (graph.places[from] - graph.places[move.to]).norm());
        for (std::size_t i = 1; i < move.path.size(); ++i) {
          for (double share = 0.0; share <= 1.0; share += 0.1) {
            const Vector2 p = move.path[i - 1] + share * (move.path[i] - move.path[i - 1]);
            EXPECT_GE(static_map->field().sample(p).distance_m, kClearance_m - 0.02);
          }
        }
        for (int other = 0; other < graph.size(); ++other) {
          const bool blocks = move.blocked_by.contains(other);
          if (other == from || other == move.to) {
            EXPECT_EQ(blocks, other == move.to);
            continue;
          }
          const double keep_m =
              std::min(kApart_m, (graph.places[other] - graph.places[from]).norm());
          EXPECT_EQ(blocks, gap_m(graph.places[other], move.path) < keep_m - 1e-3);
        }
        const PlaceMove* back = move_between(graph, move.to, from);
        ASSERT_NE(back, nullptr);
        EXPECT_DOUBLE_EQ(back->length_m, move.length_m);
      }
    }
    EXPECT_GT(moves, 2 * graph.size() - 3) << puzzle.name;  // a tree at least
  }
}

TEST(PlaceGraph, WhatIsConnectedInSpaceIsConnectedInTheGraph) {
  const test::CellPuzzle maze = {
      "maze", {"a.#...", ".##.#.", "..#.#.", "#...#b"}, {"a.#...", ".##.#.", "..#.#.", "#...#b"}};
  const PassingProblem problem = test::in_space(maze);
  const auto distances_m = distances_to(problem.graph, problem.goals[1]);
  for (int place = 0; place < problem.graph.size(); ++place)
    EXPECT_TRUE(std::isfinite(distances_m[place])) << problem.graph.places[place].transpose();
  // Down two cells and to the right, along, up three, over two and down three.
  EXPECT_NEAR(distances_m[problem.starts[0]], 13.0 * test::kCell_m, 4.0);
}

TEST(PlaceGraph, WallsPart) {
  const test::CellPuzzle rooms = {"rooms", {"a.#..", "..#.b"}, {"a.#..", "..#.b"}};
  const PassingProblem problem = test::in_space(rooms);
  EXPECT_TRUE(std::isinf(distances_to(problem.graph, problem.goals[1])[problem.starts[0]]));
}

TEST(PlaceGraph, StaysInsideItsWindow) {
  const std::vector<std::string> rows = {".....", "....."};
  const auto static_map = test::static_map_of_cells(rows);
  const Eigen::AlignedBox2d window(Vector2(0.0, 0.0), Vector2(3.0, 2.4));
  const PlaceGraph graph =
      make_place_graph({*static_map, {}}, window, {{{0.6, 0.6}}, {}}, test::graph_options());
  EXPECT_GE(graph.size(), 5);
  for (const Vector2& place : graph.places) EXPECT_TRUE(window.contains(place));
}

TEST(PlaceGraph, ChoosesNoPlacesWhereTheGroundWasNotSeen) {
  const std::vector<std::string> rows = {".....", "....."};
  const auto static_map = test::static_map_of_cells(rows);
  const Circle hidden{{4.8, 1.2}, 0.6};
  const PrimitiveField<2> unseen({hidden}, 1.0);
  const Vector2 goal = hidden.centre;
  const PlaceGraph graph = make_place_graph({*static_map, {}, &unseen}, static_map->bounds(),
                                            {{goal}, {{0.6, 0.6}}}, test::graph_options());
  ASSERT_GE(graph.size(), 6);
  for (int place = 2; place < graph.size(); ++place) {
    EXPECT_GE((graph.places[place] - hidden.centre).norm(),
              hidden.radius_m + test::graph_options().travel.required_clearance_m);
  }
  EXPECT_TRUE(std::isfinite(distances_to(graph, 0)[1]));
}

TEST(PlaceGraph, WhoStartsAtAPlaceIsThereAlready) {
  const std::vector<std::string> rows = {".....", "....."};
  const auto static_map = test::static_map_of_cells(rows);
  const auto graph_from = [&](const std::vector<Vector2>& starts) {
    return make_place_graph({*static_map, {}}, static_map->bounds(), {{{0.6, 0.6}}, starts},
                            test::graph_options());
  };
  const PlaceGraph before = graph_from({});
  const PlaceGraph graph = graph_from({before.places.back()});
  EXPECT_EQ(graph.size(), before.size());
  for (const auto& moves : graph.moves) {
    for (const PlaceMove& move : moves) {
      EXPECT_GE(move.path.size(), 2u);
      EXPECT_GT(move.length_m, 0.1);
    }
  }
}

TEST(PlaceGraph, RobotsThatAreTooCloseCanLeaveEachOther) {
  const std::vector<std::string> rows = {"....."};
  const auto static_map = test::static_map_of_cells(rows);
  const PlaceGraph graph = make_place_graph({*static_map, {}}, static_map->bounds(),
                                            {{{2.7, 0.6}, {3.3, 0.6}}, {}}, test::graph_options());
  ASSERT_FALSE(graph.moves[0].empty());
  bool leaves = false;
  for (const PlaceMove& move : graph.moves[0]) {
    const bool blocked = move.blocked_by.contains(1);
    const bool away = graph.places[move.to].x() < 2.7;
    EXPECT_EQ(blocked, !away);
    leaves = leaves || away;
  }
  EXPECT_TRUE(leaves);
}

TEST(PlaceGraph, AStartKeepsNoPlaceFromBeingChosenBesideIt) {
  const std::vector<std::string> rows = {"......"};
  const auto static_map = test::static_map_of_cells(rows);
  const auto graph_from = [&](const FixedPlaces& fixed) {
    return make_place_graph({*static_map, {}}, static_map->bounds(), fixed, test::graph_options());
  };
  const Vector2 end(0.6, 0.6);
  const PlaceGraph without = graph_from({{end}, {}});
  for (double x = 1.2; x < 6.0; x += 0.13) {
    const PlaceGraph graph = graph_from({{end}, {{x, 0.6}}});
    EXPECT_NEAR(graph.size(), without.size() + 0.5, 0.5) << x;  // the same where it starts at one
    EXPECT_EQ(graph.places[1], Vector2(x, 0.6));
    EXPECT_GE(graph.moves[1].size(), 2u) << x;  // to both sides
    for (const double distance_m : distances_to(graph, 1)) EXPECT_TRUE(std::isfinite(distance_m));
  }
}

}  // namespace
}  // namespace mocha
