#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planning/passing/passing_search.h"
#include "topology/grid_world.h"

namespace mocha::test {

/// A puzzle of square cells as in multi-agent path finding: '#' is solid, all else free; robot k
/// starts at the letter 'a' + k of `starts` and is to get to that of `goals`. Rows from the north.
struct CellPuzzle {
  std::string name;
  std::vector<std::string> starts;
  std::vector<std::string> goals;
};

inline constexpr double kCell_m = 1.2;
/// What two rovers keep between their centres, and one keeps from walls, at low speed.
inline constexpr double kApart_m = 0.96;
inline constexpr double kClearance_m = 0.36;

inline Vector2 centre_of_cell(const std::vector<std::string>& rows, int row, int column) {
  return kCell_m * Vector2(column + 0.5, static_cast<double>(rows.size()) - row - 0.5);
}

inline std::shared_ptr<const StaticMap> static_map_of_cells(const std::vector<std::string>& rows) {
  const Vector2 high = kCell_m * Vector2(rows[0].size(), rows.size());
  const Vector2 border = Vector2::Constant(0.2);
  OccupancyGrid grid = free_grid(-border, high + border, 0.05);
  fill_box(grid, -border, {0.0, high.y() + 0.2});
  fill_box(grid, {high.x(), -0.2}, high + border);
  fill_box(grid, -border, {high.x() + 0.2, 0.0});
  fill_box(grid, {-0.2, high.y()}, high + border);
  for (int row = 0; row < static_cast<int>(rows.size()); ++row) {
    for (int column = 0; column < static_cast<int>(rows[row].size()); ++column) {
      const Vector2 half = Vector2::Constant(0.5 * kCell_m);
      const Vector2 centre = centre_of_cell(rows, row, column);
      if (rows[row][column] == '#') fill_box(grid, centre - half, centre + half);
    }
  }
  return static_map_of(grid);
}

/// Where the letters are, by robot.
inline std::vector<Vector2> letters_of(const std::vector<std::string>& rows) {
  std::vector<Vector2> places;
  for (char letter = 'a';; ++letter) {
    bool found = false;
    for (int row = 0; row < static_cast<int>(rows.size()); ++row) {
      const auto column = rows[row].find(letter);
      if (column == std::string::npos) continue;
      places.push_back(centre_of_cell(rows, row, static_cast<int>(column)));
      found = true;
    }
    if (!found) return places;
  }
}

inline PlaceGraphOptions graph_options() {
  return {{kClearance_m, kClearance_m + 0.2, 1.0, 0.0}, kApart_m};
}

/// The places of cell centres alone, and moves to the four neighbours, each blocked by its end.
inline PassingProblem on_cells(const CellPuzzle& puzzle) {
  PassingProblem problem;
  std::vector<Vector2> centres;
  const auto& rows = puzzle.starts;
  for (int row = 0; row < static_cast<int>(rows.size()); ++row) {
    for (int column = 0; column < static_cast<int>(rows[row].size()); ++column) {
      if (rows[row][column] != '#') centres.push_back(centre_of_cell(rows, row, column));
    }
  }
  problem.graph.places = centres;
  problem.graph.moves.resize(centres.size());
  const int count = static_cast<int>(centres.size());
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < count; ++b) {
      const double length_m = (centres[a] - centres[b]).norm();
      if (a == b || length_m > 1.01 * kCell_m) continue;
      problem.graph.moves[a].push_back({b, length_m, {centres[a], centres[b]}, {b}});
    }
  }
  const auto number = [&](const Vector2& place) {
    const auto found = std::find_if(centres.begin(), centres.end(), [&](const Vector2& centre) {
      return (centre - place).norm() < 1e-6;
    });
    return static_cast<int>(found - centres.begin());
  };
  for (const Vector2& start : letters_of(puzzle.starts)) problem.starts.push_back(number(start));
  for (const Vector2& goal : letters_of(puzzle.goals)) problem.goals.push_back(number(goal));
  return problem;
}

/// The same in continuous space, as robots see it.
inline PassingProblem in_space(const CellPuzzle& puzzle) {
  PassingProblem problem;
  std::vector<Vector2> fixed;
  const auto number = [&](const Vector2& place) {
    const auto found = std::find_if(fixed.begin(), fixed.end(), [&](const Vector2& known) {
      return (known - place).norm() < 1e-6;
    });
    if (found == fixed.end()) fixed.push_back(place);
    return static_cast<int>(
        std::find_if(fixed.begin(), fixed.end(),
                     [&](const Vector2& known) { return (known - place).norm() < 1e-6; }) -
        fixed.begin());
  };
  for (const Vector2& start : letters_of(puzzle.starts)) problem.starts.push_back(number(start));
  for (const Vector2& goal : letters_of(puzzle.goals)) problem.goals.push_back(number(goal));
  const auto static_map = static_map_of_cells(puzzle.starts);
  problem.graph =
      make_place_graph({*static_map, {}}, static_map->bounds(), {fixed, {}}, graph_options());
  return problem;
}

/// With so many steps of the search.
inline PassingSequence solved(
    const PassingProblem& problem, int most_steps = 1000000,
    const std::function<bool()>& should_stop = [] { return false; }) {
  return find_passing(problem, most_steps, should_stop);
}

inline const std::vector<CellPuzzle>& puzzles() {
  static const std::vector<CellPuzzle> puzzles = {
      {"tunnel",  // of pibt2 (Okumura)
       {".###", "d...", ".###", "c###", "b###", "a###"},
       {".###", "....", "a###", "b###", "c###", "d###"}},
      {"corners",  // the same
       {"a####", "b...#", "#.#.#", "#...c", "####d"},
       {"d####", "c...#", "#.#.#", "#...b", "####a"}},
      {"tree",  // the same
       {"#c#", "#b.", "#.#", ".a."},
       {"#a#", "#c.", "#.#", ".b."}},
      {"siding", {"ab...cd", "###.###"}, {"cd...ab", "###.###"}},
      {"comb", {"abcd.", "#.#.#"}, {"dcba.", "#.#.#"}},
      {"ring", {"abc", "h#d", "gfe", ".##"}, {"bcd", "a#e", "hgf", ".##"}},
  };
  return puzzles;
}

}  // namespace mocha::test
