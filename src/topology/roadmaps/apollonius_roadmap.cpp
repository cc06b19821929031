#include "topology/roadmaps/apollonius_roadmap.h"

// CGAL asserts of its results in doubles what holds for exact numbers only.
#define CGAL_NDEBUG
#include <CGAL/Apollonius_graph_2.h>
#include <CGAL/Apollonius_graph_filtered_traits_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

namespace mocha {
namespace {

using Traits = CGAL::Apollonius_graph_filtered_traits_2<CGAL::Simple_cartesian<double>>;
using Site = Traits::Site_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<
    int, Traits, CGAL::Apollonius_graph_vertex_base_2<Traits, false>>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<int, Traits>;
using Graph =
    CGAL::Apollonius_graph_2<Traits, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostCoordinate_m = 1e6;
constexpr double kSamePlace_m = 1e-6;   // up to this, distances to a vertex are the same
constexpr double kRimClearances = 4.0;  // between what is to be gone round and the virtual wall
constexpr double kWallRadii = 10.0;     // of the circles that make the wall, in half diagonals

void check(bool right, const std::string& name, const std::string& value,
           const std::string& expected) {
  if (right) return;
  throw std::invalid_argument("apollonius_roadmap: " + name + " = " + value + ": expected " +
                              expected);
}

void check_point(const Vector2& p, const std::string& name) {
  check((p.array().abs() <= kMostCoordinate_m).all(), name,
        "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ")",
        "coordinates of at most 1e6 m");
}

/// Every other of them last, of the rest every other before those, and so on. What lies in a row
/// comes in a row, and CGAL is slow where each one is inserted at the row's end.
std::vector<Circle> coarse_to_fine(const std::vector<Circle>& circles) {
  std::size_t step = 1;
  while (step < circles.size()) step *= 2;
  std::vector<Circle> ordered;
  for (; step > 0; step /= 2) {
    for (std::size_t i = step - 1; i < circles.size(); i += 2 * step) ordered.push_back(circles[i]);
  }
  return ordered;
}

/// All circles and the virtual wall, largest first: none is inside of a later one.
std::vector<Circle> all_circles(const std::vector<ObstacleGroup>& groups, Eigen::AlignedBox2d box,
                                double required_m) {
  std::vector<Circle> circles;
  for (const ObstacleGroup& group : groups) {
    for (const Circle& circle : group.cover) {
      check_point(circle.centre, "centre of a circle");
      check(circle.radius_m >= 0.0 && circle.radius_m <= kMostCoordinate_m, "radius_m of a circle",
            std::to_string(circle.radius_m), "0 to 1e6 m");
      box.extend(Vector2(circle.centre.array() - circle.radius_m));
      box.extend(Vector2(circle.centre.array() + circle.radius_m));
      circles.push_back(circle);
    }
  }
  circles = coarse_to_fine(circles);
  const Vector2 half = 0.5 * box.sizes().array() + kRimClearances * required_m;
  const double radius_m = kWallRadii * half.norm();
  for (const double side : {-1.0, 1.0}) {
    circles.push_back({box.center() + Vector2(side * (half.x() + radius_m), 0.0), radius_m});
    circles.push_back({box.center() + Vector2(0.0, side * (half.y() + radius_m)), radius_m});
  }
  std::stable_sort(circles.begin(), circles.end(),
                   [](const Circle& a, const Circle& b) { return a.radius_m > b.radius_m; });
  return circles;
}

Site site_of(const Circle& circle) {
  return {{circle.centre.x(), circle.centre.y()}, circle.radius_m};
}

/// The circle that touches three others, by Newton's method from CGAL's answer, which loses digits
/// where radii differ much and is none at all where circles touch from inside.
Skeleton::Vertex touching(const std::array<Circle, 3>& circles) {
  const Site guess = Traits().construct_Apollonius_site_2_object()(
      site_of(circles[0]), site_of(circles[1]), site_of(circles[2]));
  Vector2 p(guess.point().x(), guess.point().y());
  if (!p.allFinite()) p = circles[2].centre;
  const auto gaps_m = [&](const Vector2& at) {
    return Eigen::Vector3d(gap(at, circles[0]).distance_m, gap(at, circles[1]).distance_m,
                           gap(at, circles[2]).distance_m);
  };
  const auto spread_m = [](const Eigen::Vector3d& g) { return g.maxCoeff() - g.minCoeff(); };
  Eigen::Vector3d gaps = gaps_m(p);
  for (int iteration = 0; iteration < 4; ++iteration) {
    const Vector2 from_first = (p - circles[0].centre).normalized();
    Eigen::Matrix2d slopes;
    slopes.row(0) = (p - circles[1].centre).normalized() - from_first;
    slopes.row(1) = (p - circles[2].centre).normalized() - from_first;
    const Vector2 next = p - slopes.inverse() * Vector2(gaps[1] - gaps[0], gaps[2] - gaps[0]);
    const Eigen::Vector3d next_gaps = gaps_m(next);
    if (!(spread_m(next_gaps) < spread_m(gaps))) break;
    p = next;
    gaps = next_gaps;
  }
  return {p, spread_m(gaps) < kSamePlace_m ? gaps.minCoeff() : -kInfinity};
}

/// The graph's finite faces become vertices, in an order that does not depend on where in memory
/// the graph keeps them.
std::vector<Skeleton::Vertex> number_faces(Graph& graph, const std::vector<Circle>& sites) {
  using Key = std::array<int, 3>;
  std::vector<std::pair<Key, Graph::Face_handle>> faces;
  for (auto face = graph.all_faces_begin(); face != graph.all_faces_end(); ++face) {
    face->info() = -1;
    if (graph.is_infinite(face)) continue;
    Key key = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    faces.push_back({key, face});
  }
  std::sort(faces.begin(), faces.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Skeleton::Vertex> vertices;
  for (const auto& [key, face] : faces) {
    face->info() = static_cast<int>(vertices.size());
    vertices.push_back(touching({sites[key[0]], sites[key[1]], sites[key[2]]}));
  }
  return vertices;
}

Skeleton skeleton_of(const std::vector<Circle>& circles) {
  Skeleton skeleton;
  Graph graph;
  Graph::Vertex_handle last;
  for (const Circle& circle : circles) {
    const Site site = site_of(circle);
    const Graph::Vertex_handle added =
        skeleton.sites.empty() ? graph.insert(site) : graph.insert(site, last);
    if (added == Graph::Vertex_handle()) continue;  // inside of another
    added->info() = static_cast<int>(skeleton.sites.size());
    skeleton.sites.push_back(circle);
    last = added;
  }
  skeleton.vertices = number_faces(graph, skeleton.sites);
  for (auto edge = graph.finite_edges_begin(); edge != graph.finite_edges_end(); ++edge) {
    const auto& [face, opposite] = *edge;
    std::array<int, 2> sites = {face->vertex((opposite + 1) % 3)->info(),
                                face->vertex((opposite + 2) % 3)->info()};
    std::sort(sites.begin(), sites.end());
    const Bisector bisector(skeleton.sites[sites[0]], skeleton.sites[sites[1]]);
    std::array<std::pair<double, int>, 2> ends;
    const std::array<int, 2> faces = {face->info(), face->neighbor(opposite)->info()};
    for (int i = 0; i < 2; ++i) {
      // Only pieces of the virtual wall share an arc without end. It passes between their centres.
      ends[i] = {faces[i] < 0 ? 0.0 : bisector.parameter(skeleton.vertices[faces[i]].position),
                 faces[i]};
    }
    std::sort(ends.begin(), ends.end());
    skeleton.arcs.push_back(
        {sites, bisector, {ends[0].first, ends[1].first}, {ends[0].second, ends[1].second}});
  }
  std::sort(skeleton.arcs.begin(), skeleton.arcs.end(),
            [](const Skeleton::Arc& a, const Skeleton::Arc& b) {
              return std::tie(a.sites, a.range, a.ends) < std::tie(b.sites, b.range, b.ends);
            });
  return skeleton;
}

}  // namespace

Roadmap<2> apollonius_roadmap(const std::vector<ObstacleGroup>& groups,
                              const Eigen::AlignedBox2d& bounds, const Vector2& start,
                              const Vector2& goal, const SkeletonOptions& options) {
  check(options.required_clearance_m > 0.0 && options.required_clearance_m <= kMostCoordinate_m,
        "required_clearance_m", std::to_string(options.required_clearance_m), "above 0 to 1e6 m");
  check_point(bounds.min(), "least corner of the bounds");
  check_point(bounds.max(), "greatest corner of the bounds");
  check(!bounds.isEmpty(), "size of the bounds", std::to_string(bounds.sizes().minCoeff()),
        "at least 0 m");
  check_point(start, "start");
  check_point(goal, "goal");
  Eigen::AlignedBox2d box = bounds;
  box.extend(start).extend(goal);
  const Skeleton skeleton = skeleton_of(all_circles(groups, box, options.required_clearance_m));
  return roadmap_on(skeleton, start, goal, options);
}

}  // namespace mocha
