#pragma once

#include <array>
#include <vector>

#include "topology/roadmaps/bisector.h"
#include "topology/roadmaps/roadmap.h"
#include "world/obstacle.h"

namespace mocha {

/// The lines between circles that are as far from all of them as can be: the vertices and edges of
/// the circles' Voronoi diagram.
struct Skeleton {
  /// A point that is equally far from three circles, which are its nearest.
  struct Vertex {
    Vector2 position;
    double clearance_m;
  };

  /// What parts the cells of two circles, from one vertex to another.
  struct Arc {
    std::array<int, 2> sites;
    Bisector bisector;
    std::array<double, 2> range;  ///< of the bisector's parameter, ascending
    std::array<int, 2> ends;      ///< vertices; -1 where no arc goes on
  };

  std::vector<Circle> sites;  ///< none inside of another
  std::vector<Vertex> vertices;
  std::vector<Arc> arcs;
};

struct SkeletonOptions {
  double required_clearance_m;  ///< of the robot's centre, above 0; closer is forbidden
  /// Around a start that stands closer than required, places no closer than the start are allowed.
  double escape_radius_m;
};

/// The roadmap of all of the skeleton that is wide enough, with start and goal.
///
/// Nodes after start and goal are vertices, then at most two places where an arc is split: those
/// which start and goal meet straight away from their nearest circles. So they hang together if and
/// only if they do anywhere at the required clearance. They also have straight edges to vertices
/// around and, where the line is free, to each other; none if they are closer to a circle than is
/// allowed. Edges along arcs have chords that lose at most 2 % of clearance; the clearance stated
/// is the arc's.
Roadmap<2> roadmap_on(const Skeleton& skeleton, const Vector2& start, const Vector2& goal,
                      const SkeletonOptions& options);

}  // namespace mocha
