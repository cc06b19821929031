#include "world/distance_transform.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace mocha {
namespace {

/// Squared distances along one line to parabolas f(q) + (x - q)^2, in place.
class LineTransform {
 public:
  explicit LineTransform(int longest) : value_(longest), vertex_(longest), boundary_(longest + 1) {}

  void run(float* line, int count, std::ptrdiff_t stride) {
    for (int i = 0; i < count; ++i) value_[i] = line[i * stride];
    int last = -1;
    for (int q = 0; q < count; ++q) {
      if (value_[q] >= kNoSite) continue;
      double start = -std::numeric_limits<double>::infinity();
      while (last >= 0) {
        start = intersection(vertex_[last], q);
        if (start > boundary_[last]) break;
        --last;
        start = -std::numeric_limits<double>::infinity();
      }
      vertex_[++last] = q;
      boundary_[last] = start;
    }
    if (last < 0) return;
    int k = 0;
    for (int x = 0; x < count; ++x) {
      while (k < last && boundary_[k + 1] < x) ++k;
      const auto offset = static_cast<float>(x - vertex_[k]);
      line[x * stride] = offset * offset + value_[vertex_[k]];
    }
  }

 private:
  double intersection(int p, int q) const {
    const double fp = static_cast<double>(value_[p]) + static_cast<double>(p) * p;
    const double fq = static_cast<double>(value_[q]) + static_cast<double>(q) * q;
    return (fq - fp) / (2.0 * (q - p));
  }

  std::vector<float> value_;
  std::vector<int> vertex_;
  std::vector<double> boundary_;
};

}  // namespace

void distance_transform(std::vector<float>& squared, int columns, int rows) {
  LineTransform line(std::max(columns, rows));
  for (int y = 0; y < rows; ++y)
    line.run(&squared[static_cast<std::size_t>(y) * columns], columns, 1);
  for (int x = 0; x < columns; ++x) line.run(&squared[x], rows, columns);
}

}  // namespace mocha
