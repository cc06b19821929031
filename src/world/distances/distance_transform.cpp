#include "world/distances/distance_transform.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace mocha {
namespace {

constexpr float kFar = 1e6f;  // cells; its square is kNoSite

/// Of two numbers, in the form that compilers vectorise.
float lesser(float a, float b) { return a < b ? a : b; }

/// Squared distances within each column, by a sweep up and one down over whole rows.
void transform_columns(float* squared, int columns, int rows) {
  std::vector<float> away(columns, kFar);  // from the nearest site behind
  for (int y = 0; y < rows; ++y) {
    float* row = squared + static_cast<std::size_t>(y) * columns;
    for (int x = 0; x < columns; ++x) row[x] = away[x] = lesser(row[x], away[x] + 1.0f);
  }
  std::fill(away.begin(), away.end(), kFar);
  for (int y = rows - 1; y >= 0; --y) {
    float* row = squared + static_cast<std::size_t>(y) * columns;
    for (int x = 0; x < columns; ++x) {
      away[x] = lesser(row[x], away[x] + 1.0f);
      const float capped = lesser(away[x], kFar);
      row[x] = capped * capped;
    }
  }
}

/// Squared distances along one row to parabolas f(q) + (x - q)^2, in place.
class RowTransform {
 public:
  explicit RowTransform(int columns)
      : height_(columns), vertex_(columns), boundary_(columns + 1), half_inverse_(columns) {
    for (int i = 1; i < columns; ++i) half_inverse_[i] = 0.5 / i;
  }

  /// Nothing reaches across a site, so each stretch between two of them is on its own.
  void run(float* row, int count) {
    for (int end = 0; end < count;) {
      int begin = end;
      while (begin < count && row[begin] == 0.0f) ++begin;
      if (begin == count) return;
      end = begin + 1;
      while (end < count && row[end] != 0.0f) ++end;
      const int from = std::max(begin - 1, 0);
      stretch(row + from, std::min(end + 1, count) - from);
    }
  }

 private:
  void stretch(float* row, int count) {
    for (int q = 0; q < count; ++q) height_[q] = row[q] + static_cast<double>(q) * q;
    const int last = envelope(count);
    if (last < 0) return;
    boundary_[last + 1] = count - 1;
    int x = 0;
    for (int k = 0; k <= last; ++k) {
      const int vertex = vertex_[k];
      const auto value = static_cast<float>(height_[vertex] - static_cast<double>(vertex) * vertex);
      const double boundary = std::min(boundary_[k + 1], count - 1.0);
      const int end = boundary < 0.0 ? 0 : static_cast<int>(boundary) + 1;
      for (; x < end; ++x) {
        const auto away = static_cast<float>(x - vertex);
        row[x] = away * away + value;
      }
    }
  }

  /// Which parabolas are the lowest somewhere, and from where on; returns the number of the last
  /// one, -1 without any.
  int envelope(int count) {
    int last = -1;
    for (int q = 0; q < count; ++q) {
      if (height_[q] >= kNoSite) continue;
      double start = 0.0;
      while (last >= 0) {
        start = (height_[q] - height_[vertex_[last]]) * half_inverse_[q - vertex_[last]];
        if (start > boundary_[last]) break;
        --last;
      }
      vertex_[++last] = q;
      boundary_[last] = last > 0 ? start : -std::numeric_limits<double>::infinity();
    }
    return last;
  }

  std::vector<double> height_;  // of the parabolas at 0
  std::vector<int> vertex_;
  std::vector<double> boundary_;      // to the parabola before
  std::vector<double> half_inverse_;  // 1 / 2i
};

}  // namespace

void distance_transform(std::vector<float>& squared, int columns, int rows) {
  distance_transform(squared, columns, rows, 0, rows);
}

void distance_transform(std::vector<float>& squared, int columns, int rows, int first_row,
                        int end_row) {
  transform_columns(squared.data(), columns, rows);
  RowTransform row(columns);
  for (int y = first_row; y < end_row; ++y)
    row.run(&squared[static_cast<std::size_t>(y) * columns], columns);
}

void distance_transform_in_space(std::vector<float>& squared, int columns, int rows, int layers) {
  const std::size_t layer = static_cast<std::size_t>(columns) * rows;
  RowTransform row(columns);
  for (int z = 0; z < layers; ++z) {
    float* const in_layer = squared.data() + z * layer;
    transform_columns(in_layer, columns, rows);
    for (int y = 0; y < rows; ++y)
      row.run(in_layer + static_cast<std::size_t>(y) * columns, columns);
  }
  RowTransform upward(layers);
  std::vector<float> upright(static_cast<std::size_t>(columns) * layers);
  for (int y = 0; y < rows; ++y) {
    float* const first = squared.data() + static_cast<std::size_t>(y) * columns;
    for (int z = 0; z < layers; ++z) {
      for (int x = 0; x < columns; ++x)
        upright[static_cast<std::size_t>(x) * layers + z] = first[z * layer + x];
    }
    for (int x = 0; x < columns; ++x)
      upward.run(&upright[static_cast<std::size_t>(x) * layers], layers);
    for (int z = 0; z < layers; ++z) {
      for (int x = 0; x < columns; ++x)
        first[z * layer + x] = upright[static_cast<std::size_t>(x) * layers + z];
    }
  }
}

}  // namespace mocha
