#include "python/space_module.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "python/arguments.h"
#include "python/config_directory.h"
#include "python/signal_watch.h"
#include "python/steady_now.h"
#include "stack/space_planning.h"
#include "trajectory/arc_length.h"

namespace mocha {
namespace {

namespace py = pybind11;

std::unique_ptr<SpacePlanner> make_planner(const std::filesystem::path& map_file,
                                           const py::dict& parameters,
                                           const std::vector<py::object>& held) {
  if (parameters.contains("map_file"))
    throw std::invalid_argument("parameters: map_file has to be given as the argument map_file");
  ParameterTable values = ParameterTable::from_schema(config_directory() + "/space_planner.yaml");
  assign(parameters, values);
  YAML::Node map;
  map["map_file"] = map_file.string();
  values.assign(map, "SpacePlanner");
  const SpacePlannerOptions options = SpacePlannerOptions::from(values);
  const Eigen::Vector3d room = Eigen::Vector3d::Constant(options.required_clearance_m());
  Eigen::AlignedBox3d box;
  for (const py::object& place : held) {
    const Eigen::Vector3d at = to_place("held", place);
    box.extend(at - room);
    box.extend(at + room);
  }
  const py::gil_scoped_release others_may_run;
  return make_space_planner(values, box, steady_now_s);
}

/// What of a kind the map holds, by its name.
py::dict count_curves(const ObstacleCurves& found) {
  struct Counts {
    int columns = 0;
    int loops = 0;
    int arches = 0;
    void operator()(const Column&) { ++columns; }
    void operator()(const Loop&) { ++loops; }
    void operator()(const Arch&) { ++arches; }
  } counts;
  for (const auto& curve : found.curves) std::visit(counts, curve);
  using py::literals::operator""_a;
  return py::dict("columns"_a = counts.columns, "loops"_a = counts.loops,
                  "arches"_a = counts.arches, "bodies"_a = found.bodies,
                  "surface_voxels"_a = found.surface_voxels);
}

py::list corners_of(const ObstacleCurves& found) {
  py::list curves;
  for (const auto& curve : found.curves) {
    if (const auto* column = std::get_if<Column>(&curve)) {
      curves.append(py::make_tuple("column", column->foot));
    } else if (const auto* loop = std::get_if<Loop>(&curve)) {
      curves.append(py::make_tuple("loop", loop->corners));
    } else {
      curves.append(py::make_tuple("arch", std::get<Arch>(curve).corners));
    }
  }
  return curves;
}

/// Every `step_s` from begin to end, both of them included: times, places and speeds.
py::dict sample_curve(const SpaceCandidate& candidate, double step_s) {
  constexpr double kLeastStep_s = 1e-4;
  if (!(step_s >= kLeastStep_s) || !std::isfinite(step_s))
    throw std::invalid_argument("step_s: has to be finite and at least 0.0001 s, and is " +
                                py::repr(py::float_(step_s)).cast<std::string>());
  const double duration_s = candidate.curve.pieces() > 0 ? candidate.curve.duration() : 0.0;
  std::vector<double> time_s, speed_mps;
  std::vector<Eigen::Vector3d> place;
  const int steps = static_cast<int>(std::ceil(duration_s / step_s));
  for (int i = 0; candidate.curve.pieces() > 0 && i <= steps; ++i) {
    time_s.push_back(std::min(i * step_s, duration_s));
    place.push_back(candidate.curve.position(time_s.back()));
    speed_mps.push_back(candidate.curve.derivative(time_s.back(), 1).norm());
  }
  using py::literals::operator""_a;
  return py::dict("time_s"_a = time_s, "place_m"_a = place, "speed_mps"_a = speed_mps);
}

void add_candidate(py::module_& module) {
  py::class_<SpaceCandidate>(module, "SpaceCandidate", "One way through space, of its own class.")
      .def_property_readonly(
          "certified", [](const SpaceCandidate& c) { return c.reason == PlanReason::kSolved; })
      .def_property_readonly(
          "outcome", [](const SpaceCandidate& c) { return outcome(c); },
          "\"solved\", or why it is not certified.")
      .def_readonly("cost", &SpaceCandidate::cost)
      .def_property_readonly(
          "terms",
          [](const SpaceCandidate& c) {
            py::dict terms;
            for (const auto& [name, value] : c.terms) terms[name.c_str()] = value;
            return terms;
          },
          "The cost by its parts.")
      .def_property_readonly(
          "fallback",
          [](const SpaceCandidate& c) { return c.fallback ? describe(*c.fallback) : ""; },
          "Why plain waypoints were optimised instead of camouflage; \"\" where they were not.")
      .def_readonly("evaluations", &SpaceCandidate::evaluations)
      .def_readonly("signature", &SpaceCandidate::signature,
                    "Its class: the linking number with each curve of the map.")
      .def_readonly("path", &SpaceCandidate::path, "What it was made of: a list of (x, y, z).")
      .def_property_readonly(
          "duration_s",
          [](const SpaceCandidate& c) { return c.curve.pieces() > 0 ? c.curve.duration() : 0.0; })
      .def_property_readonly(
          "length_m",
          [](const SpaceCandidate& c) { return c.curve.pieces() > 0 ? arc_length(c.curve) : 0.0; })
      .def("sample", &sample_curve, py::arg("step_s") = 0.05,
           "A dict of lists, one value every step_s and one at the end: time_s, place_m, "
           "speed_mps.");
}

void add_plan(py::module_& module) {
  py::class_<SpacePlan>(module, "SpacePlan", "The cheapest certified trajectory, or why none.")
      .def_property_readonly("solved",
                             [](const SpacePlan& p) { return p.reason == PlanReason::kSolved; })
      .def_property_readonly("reason", [](const SpacePlan& p) { return to_text(p.reason); })
      .def_readonly("message", &SpacePlan::message, "The same in a sentence.")
      .def_readonly("took_s", &SpacePlan::took_s, "Searching and optimising.")
      .def_readonly("candidates", &SpacePlan::candidates,
                    "One for each class; certified ones first, the cheapest of them first.");
}

SpacePlan plan_in_space(SpacePlanner& planner, const py::object& start, const py::object& goal,
                        const std::vector<py::object>& moving) {
  SpaceQuery query{to_place("start", start), to_place("goal", goal)};
  for (const py::object& ball : moving) query.moving.push_back(to_ball("moving", ball));
  SignalWatch signals;
  query.should_stop = [&] { return signals.has_raised(); };
  SpacePlan plan;
  {
    const py::gil_scoped_release others_may_run;
    plan = planner.plan(query);
  }
  signals.rethrow();
  return plan;
}

py::object curves_around(SpacePlanner& planner, const py::object& start) {
  const Eigen::Vector3d from = to_place("start", start);
  std::shared_ptr<const SpaceRegion> region;
  {
    const py::gil_scoped_release others_may_run;
    region = planner.region_of(from);
  }
  if (!region) return py::none();
  using py::literals::operator""_a;
  return py::dict("counts"_a = count_curves(region->curves()),
                  "curves"_a = corners_of(region->curves()));
}

void add_planner(py::module_& module) {
  py::class_<SpacePlanner>(module, "SpacePlanner", R"(Plans in an OctoMap, in three dimensions.

map_file: .bt or .ot. parameters: values by name, as config/space_planner.yaml lists them; bounds
may be a list, a tuple or an array. held: places (x, y, z) that the map is to reach as far as, if it
knows less.
Bad arguments raise ValueError; a map that cannot be used, RuntimeError.)")
      .def(py::init(&make_planner), py::arg("map_file"), py::arg("parameters") = py::dict(),
           py::arg("held") = std::vector<py::object>())
      .def("plan", &plan_in_space, py::arg("start"), py::arg("goal"),
           py::arg("moving") = std::vector<py::object>(),
           "From rest at start to rest at goal, (x, y, z) [m], past balls that move: each (x, y, "
           "z, vx, vy, vz, radius) [m, m/s], when the motion begins.")
      .def("curves", &curves_around, py::arg("start"),
           "What tells classes apart where one comes from start, or None: how many curves of each "
           "kind and what is none, and their corners.")
      .def(
          "surface", [](const SpacePlanner& p) { return p.field().surface(); },
          "For pictures: the centres of solid cells beside open ones.")
      .def_property_readonly("resolution_m",
                             [](const SpacePlanner& p) { return p.field().resolution_m(); })
      .def_property_readonly(
          "bounds",
          [](const SpacePlanner& p) {
            return py::make_tuple(p.field().bounds().min(), p.field().bounds().max());
          },
          "The lowest and the highest corner of where the robot may be.");
}

}  // namespace

void add_space_planning(py::module_& module) {
  add_candidate(module);
  add_plan(module);
  add_planner(module);
}

}  // namespace mocha
