#include "perception/mapping/png_image.h"

#include <png.h>

#include <stdexcept>
#include <vector>

namespace mocha {
namespace {

constexpr int kChannels = 4;  // red, green, blue, opacity
constexpr int kOpaque = 255;

/// libpng's own state, which it has to be told to free.
struct Decoder {
  png_image image{};

  explicit Decoder(const std::string& bytes) {
    image.version = PNG_IMAGE_VERSION;
    require(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    image.format = PNG_FORMAT_RGBA;
  }
  ~Decoder() { png_image_free(&image); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  void require(int done) const {
    if (done == 0) throw std::runtime_error(std::string("is no PNG image: ") + image.message);
  }
};

}  // namespace

bool is_png(const std::string& bytes) { return bytes.compare(0, 4, "\x89PNG") == 0; }

GreyImage read_png(const std::string& bytes, double most_pixels) {
  Decoder decoder(bytes);
  png_image& png = decoder.image;
  const double pixels = static_cast<double>(png.width) * png.height;
  if (!(pixels <= most_pixels)) throw std::runtime_error("has too many pixels");
  std::vector<png_byte> colours(PNG_IMAGE_SIZE(png));
  decoder.require(png_image_finish_read(&png, nullptr, colours.data(), 0, nullptr));
  GreyImage grey;
  grey.width = static_cast<int>(png.width);
  grey.height = static_cast<int>(png.height);
  for (std::size_t at = 0; at < colours.size(); at += kChannels) {
    grey.pixels += static_cast<char>((colours[at] + colours[at + 1] + colours[at + 2]) / 3);
    grey.opaque += static_cast<char>(colours[at + 3] == kOpaque);
  }
  return grey;
}

}  // namespace mocha
