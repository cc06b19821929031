#include "python/arguments.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace mocha {
namespace {

namespace py = pybind11;

constexpr double kLeastResolution_m = 1e-4;
constexpr py::ssize_t kMostCells = 100'000'000;

std::invalid_argument fault(const std::string& name, const std::string& wanted,
                            const py::object& found) {
  return std::invalid_argument(name + ": has to be " + wanted + ", and is " +
                               py::repr(found).cast<std::string>());
}

std::vector<double> to_numbers(const char* name, const char* wanted, const py::object& object,
                               std::size_t least, std::size_t most) {
  std::vector<double> numbers;
  try {
    numbers = object.cast<std::vector<double>>();
  } catch (const py::cast_error&) {
    throw fault(name, wanted, object);
  }
  const bool finite = std::all_of(numbers.begin(), numbers.end(),
                                  [](double number) { return std::isfinite(number); });
  if (!finite || numbers.size() < least || numbers.size() > most) throw fault(name, wanted, object);
  return numbers;
}

/// As Python writes flags, numbers and lists of them, YAML reads them, too.
std::string yaml_of(py::object value) {
  if (py::isinstance<py::sequence>(value) && !py::isinstance<py::str>(value)) {
    if (const auto array = py::array::ensure(value)) value = array.attr("tolist")();
  }
  return py::str(value).cast<std::string>();
}

using Cells = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

Cells to_cells(const py::object& object) {
  const char* const wanted = "a 2-D numpy array of integers, not empty";
  if (!py::isinstance<py::array>(object)) throw fault("grid", wanted, py::type::of(object));
  const py::array array(object);
  const bool integers = array.dtype().kind() == 'i' || array.dtype().kind() == 'u';
  if (!integers || array.ndim() != 2 || array.size() == 0 || array.size() > kMostCells) {
    const py::str shape = py::str("of {}, with the shape {}");
    throw fault("grid", wanted, shape.format(array.dtype(), array.attr("shape")));
  }
  return Cells(array);
}

}  // namespace

OccupancyGrid to_grid(const py::object& cells, double resolution_m, const py::object& origin) {
  const Cells values = to_cells(cells);
  if (!(resolution_m >= kLeastResolution_m) || !std::isfinite(resolution_m))
    throw fault("resolution_m", "finite and at least 0.0001 m", py::float_(resolution_m));
  const std::vector<double> corner = to_numbers("origin", "(x, y), finite numbers", origin, 2, 2);
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.origin = {corner[0], corner[1]};
  grid.height = static_cast<int>(values.shape(0));
  grid.width = static_cast<int>(values.shape(1));
  grid.cells.resize(static_cast<std::size_t>(values.size()));
  std::transform(values.data(), values.data() + values.size(), grid.cells.begin(),
                 [](std::int64_t value) {
                   if (value < -1 || value > 100)
                     throw fault("grid", "of -1 (unknown) or 0 to 100 (per cent) in each cell",
                                 py::int_(value));
                   return cell_of_probability(static_cast<std::int8_t>(value));
                 });
  return grid;
}

Pose to_start(const py::object& start) {
  const std::vector<double> pose = to_numbers("start", "(x, y, yaw), finite numbers", start, 3, 3);
  return {{pose[0], pose[1]}, pose[2]};
}

Goal to_goal(const py::object& goal) {
  const std::vector<double> place =
      to_numbers("goal", "(x, y) or (x, y, yaw), finite numbers", goal, 2, 3);
  Goal result{{place[0], place[1]}, {}};
  if (place.size() == 3) result.yaw_rad = place[2];
  return result;
}

Eigen::Vector3d to_place(const char* name, const py::object& place) {
  const std::vector<double> at = to_numbers(name, "(x, y, z), finite numbers", place, 3, 3);
  return {at[0], at[1], at[2]};
}

Tube<3> to_ball(const char* name, const py::object& ball) {
  const char* const wanted = "(x, y, z, vx, vy, vz, radius), numbers within 1e6, radius at least 0";
  const std::vector<double> at = to_numbers(name, wanted, ball, 7, 7);
  const auto is_large = [](double number) { return std::abs(number) >= 1e6; };
  if (at[6] < 0.0 || std::any_of(at.begin(), at.end(), is_large)) throw fault(name, wanted, ball);
  return steady_tube<3>({at[0], at[1], at[2]}, {at[3], at[4], at[5]}, at[6]);
}

void assign(const py::dict& parameters, ParameterTable& values) {
  YAML::Node node(YAML::NodeType::Map);
  for (const auto& [name, value] : parameters) {
    node[py::str(name).cast<std::string>()] = yaml_of(py::reinterpret_borrow<py::object>(value));
  }
  values.assign(node, "parameters");
}

}  // namespace mocha
