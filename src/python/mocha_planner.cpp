// The Python module mocha_planner: plans on numpy maps. docs/library.md shows its use.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "python/arguments.h"
#include "python/config_directory.h"
#include "python/space_module.h"
#include "stack/map_planner.h"

namespace mocha {
namespace {

namespace py = pybind11;

PlanResult plan(const py::object& cells, double resolution_m, const py::object& start,
                const py::object& goal, const py::object& origin, const std::string& model,
                const py::dict& parameters) {
  const OccupancyGrid map = to_grid(cells, resolution_m, origin);
  const Pose from = to_start(start);
  const Goal to = to_goal(goal);
  const std::string config = config_directory();
  ParameterTable values = ParameterTable::from_schema(config + "/global_planner.yaml");
  assign(parameters, values);
  const MapPlanner planner(load_robot_model(config, model), PlannerOptions::from(values));
  const py::gil_scoped_release others_may_run;
  return planner.plan(map, from, to);
}

py::array_t<double> to_array(const std::vector<Vector2>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  for (std::size_t i = 0; i < points.size(); ++i) {
    array.mutable_at(i, 0) = points[i].x();
    array.mutable_at(i, 1) = points[i].y();
  }
  return array;
}

double duration_s(const Motion& motion) { return motion.end_time() - motion.start_time(); }

/// Every `step_s` from begin to end, both of them included.
py::dict sample(const Motion& motion, double step_s) {
  constexpr double kMostSamples = 1e7;
  const double steps = std::ceil(duration_s(motion) / step_s);
  if (!(step_s > 0.0) || !(steps < kMostSamples))
    throw std::invalid_argument("step_s: has to be above 0 s, and no less than 1e-7 of the motion");
  const auto count = static_cast<py::ssize_t>(steps) + 1;
  py::array_t<double> time_s(count), x_m(count), y_m(count), yaw_rad(count), speed_mps(count),
      yaw_rate_radps(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const double t = std::min(motion.start_time() + i * step_s, motion.end_time());
    const MotionState state = motion.at(t);
    time_s.mutable_at(i) = t;
    x_m.mutable_at(i) = state.pose.position.x();
    y_m.mutable_at(i) = state.pose.position.y();
    yaw_rad.mutable_at(i) = state.pose.yaw_rad;
    speed_mps.mutable_at(i) = state.speed;
    yaw_rate_radps.mutable_at(i) = state.yaw_rate;
  }
  using py::literals::operator""_a;
  return py::dict("time_s"_a = time_s, "x_m"_a = x_m, "y_m"_a = y_m, "yaw_rad"_a = yaw_rad,
                  "speed_mps"_a = speed_mps, "yaw_rate_radps"_a = yaw_rate_radps);
}

/// Of a plan or a candidate; None where there is none.
template <typename Planned>
py::object motion_of(const Planned& planned) {
  return planned.motion.empty() ? py::object(py::none()) : py::cast(planned.motion);
}

template <typename Planned>
bool is_certified(const Planned& planned) {
  return planned.reason == PlanReason::kSolved;
}

void add_types(py::module_& module) {
  py::class_<Motion>(module, "Motion",
                     "What the robot does from rest to rest, as functions of time.")
      .def_property_readonly("duration_s", &duration_s)
      .def_property_readonly("length_m", &Motion::length_m)
      .def(
          "sample", &sample, py::arg("step_s") = 0.05,
          "A dict of arrays, one value every step_s and one at the end: time_s, x_m, y_m, yaw_rad, "
          "speed_mps (negative when backward), yaw_rate_radps.");
  py::class_<PlanCandidate>(module, "Candidate",
                            "One way to the goal, of a topological class of its own.")
      .def_property_readonly("certified", &is_certified<PlanCandidate>)
      .def_property_readonly("outcome", &outcome, "\"solved\", or why it is not certified.")
      .def_readonly("selected", &PlanCandidate::selected, "Whether this is the plan.")
      .def_readonly("cost", &PlanCandidate::cost)
      .def_property_readonly(
          "terms",
          [](const PlanCandidate& c) {
            py::dict terms;
            for (const auto& [name, value] : c.terms) terms[name.c_str()] = value;
            return terms;
          },
          "The cost by its parts.")
      .def_readonly("signature", &PlanCandidate::signature,
                    "Its class: how often it passes each obstacle, on which side.")
      .def_property_readonly(
          "path", [](const PlanCandidate& c) { return to_array(c.path); },
          "The path (n x 2) that it was made of.")
      .def_property_readonly(
          "fallbacks",
          [](const PlanCandidate& c) {
            py::list sentences;
            for (const Fallback& each : c.fallbacks) sentences.append(describe(each));
            return sentences;
          },
          "What was done in place of what is done as a rule, why and where.")
      .def_property_readonly("motion", &motion_of<PlanCandidate>, "A Motion, or None.");
  py::class_<PlanResult>(module, "Plan", "The cheapest certified motion, or why there is none.")
      .def_property_readonly("solved", &is_certified<PlanResult>)
      .def_property_readonly(
          "reason", [](const PlanResult& p) { return to_text(p.reason); },
          "\"solved\", or why not, such as \"goal occupied\".")
      .def_readonly("message", &PlanResult::message, "The same in a sentence.")
      .def_property_readonly(
          "goal", [](const PlanResult& p) { return py::make_tuple(p.goal.x(), p.goal.y()); },
          "Where it leads: the goal, or the nearest free place.")
      .def_readonly("candidates", &PlanResult::candidates, "One for each class.")
      .def_property_readonly("motion", &motion_of<PlanResult>, "A Motion, or None.");
}

}  // namespace

PYBIND11_MODULE(mocha_planner, module) {
  module.doc() = "Motion planning for small ground robots, on occupancy grids, without ROS.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const ParameterError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  add_types(module);
  add_space_planning(module);
  module.def(
      "plan", &plan, py::arg("grid"), py::arg("resolution_m"), py::arg("start"), py::arg("goal"),
      py::arg("origin") = py::make_tuple(0.0, 0.0), py::arg("model") = "rover",
      py::arg("parameters") = py::dict(),
      R"(Plans from rest at start (x, y, yaw) to goal (x, y) or (x, y, yaw); metres and radians.

grid: 2-D array of integers as nav_msgs/OccupancyGrid has them: -1 unknown, 0 to 100 per cent
    occupied; grid[0, 0] is the cell at origin (x, y), grid[row, column] lies row cells above it.
model: a robot of config/robots, or the path of a file like these.
parameters: values by name, as config/global_planner.yaml lists them.
Bad arguments raise ValueError.)");
}

}  // namespace mocha
