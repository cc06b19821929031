#pragma once

#include <string>

namespace mocha {

/// Grey pixels, row by row from the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  int white = 255;
  std::string pixels;
  std::string opaque;  ///< not 0 where there is a pixel at all; empty: everywhere
};

bool is_png(const std::string& bytes);

/// The bytes of a PNG file as grey, which is the mean of red, green and blue. Throws
/// std::runtime_error, saying what is wrong.
GreyImage read_png(const std::string& bytes, double most_pixels);

}  // namespace mocha
