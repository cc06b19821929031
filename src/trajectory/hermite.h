#pragma once

namespace mocha {

// The algebra of one polynomial piece of degree 2S - 1 in normalised time, u in [0, 1]. Its ends
// are given by their derivatives 0 .. S-1 (columns k). What bends the piece is its gap: by how much
// the end misses the Taylor expansion of order S - 1 about the start. Coefficients S .. 2S-1 and
// the effort depend on the gap alone.

constexpr double falling_factorial(int n, int k) {
  double product = 1.0;
  for (int j = 0; j < k; ++j) product *= n - j;
  return product;
}

/// 1 / (column - row)!: what derivative `column` at u = 0 adds to derivative `row` at u = 1.
constexpr double taylor_weight(int row, int column) {
  return 1.0 / falling_factorial(column - row, column - row);
}

template <int S>
struct HermiteTable {
  double entries[S][S] = {};
  constexpr double& operator()(int row, int column) { return entries[row][column]; }
  constexpr double operator()(int row, int column) const { return entries[row][column]; }
};

/// Entry (k, j): coefficient S + j by gap k. The polynomial is u^S q(u); q is expanded about u = 1
/// by dividing the gap's polynomial by u^S, then about u = 0.
template <int S>
constexpr HermiteTable<S> coefficients_by_gap() {
  constexpr auto binomial = [](int n, int k) {
    return falling_factorial(n, k) / falling_factorial(k, k);
  };
  HermiteTable<S> table{};
  for (int k = 0; k < S; ++k) {
    for (int j = 0; j < S; ++j) {
      for (int m = j > k ? j : k; m < S; ++m) {
        const double sign = (j + k) % 2 == 0 ? 1.0 : -1.0;
        table(k, j) +=
            sign * binomial(m, j) * binomial(S - 1 + m - k, m - k) / falling_factorial(k, k);
      }
    }
  }
  return table;
}

/// Symmetric; the effort of a piece is the sum of (k, l) gap_k . gap_l, so row k is half its
/// derivative by derivative k at the end. Integrating by parts, that is (-1)^(S-1-k) times
/// derivative 2S - 1 - k of the polynomial at u = 1.
template <int S>
constexpr HermiteTable<S> forces_by_gap() {
  constexpr auto coefficients = coefficients_by_gap<S>();
  HermiteTable<S> table{};
  for (int k = 0; k < S; ++k) {
    for (int l = 0; l < S; ++l) {
      const double sign = (S - 1 - k) % 2 == 0 ? 1.0 : -1.0;
      for (int j = S - 1 - k; j < S; ++j) {
        table(k, l) += sign * falling_factorial(S + j, 2 * S - 1 - k) * coefficients(l, j);
      }
    }
  }
  return table;
}

/// Entry (k, l): force at the end's derivative k by the start's derivative l.
template <int S>
constexpr HermiteTable<S> forces_by_start() {
  constexpr auto forces = forces_by_gap<S>();
  HermiteTable<S> table{};
  for (int k = 0; k < S; ++k) {
    for (int l = 0; l < S; ++l) {
      for (int j = 0; j <= l; ++j) table(k, l) -= forces(k, j) * taylor_weight(j, l);
    }
  }
  return table;
}

}  // namespace mocha
