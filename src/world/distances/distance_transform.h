#pragma once

#include <vector>

namespace mocha {

/// A squared distance that stands for "no site": finite, so that the transform's algebra holds.
constexpr float kNoSite = 1e12f;

/// Squared Euclidean distances [cells^2] from every point of a lattice, row by row, to the nearest
/// site, in place: `squared` holds 0 at the sites and kNoSite elsewhere. Exact (Felzenszwalb and
/// Huttenlocher 2012).
void distance_transform(std::vector<float>& squared, int columns, int rows);
/// The same, right only in the rows from the first to before the end.
void distance_transform(std::vector<float>& squared, int columns, int rows, int first_row,
                        int end_row);

/// The same in space, layer by layer.
void distance_transform_in_space(std::vector<float>& squared, int columns, int rows, int layers);

}  // namespace mocha
