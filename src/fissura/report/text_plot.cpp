#include "fissura/report/text_plot.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <vector>

namespace fissura::report {

namespace {

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double v) { low = std::min(low, v), high = std::max(high, v); }
  /// Halves: the difference of the largest numbers is none.
  double share(double v) const {
    double const half = high / 2 - low / 2;
    return half > 0 ? (v / 2 - low / 2) / half : 0.5;
  }
};

/// A picture of dots, row 0 at the top; lines are drawn between neighbours.
class Raster {
 public:
  Raster(int width, int height)
      : width_(width), height_(height), dot_(static_cast<std::size_t>(width * height), 0) {}
  bool at(int x, int y) const { return dot_[static_cast<std::size_t>(y * width_ + x)] != 0; }
  void line(double x0, double y0, double x1, double y1) {
    int const steps =
        std::max(1, static_cast<int>(std::ceil(std::max(std::abs(x1 - x0), std::abs(y1 - y0)))));
    for (int i = 0; i <= steps; ++i) {
      double const s = static_cast<double>(i) / steps;
      set(x0 + s * (x1 - x0), y0 + s * (y1 - y0));
    }
  }

 private:
  void set(double x, double y) {
    int const i = std::clamp(static_cast<int>(std::lround(x)), 0, width_ - 1);
    int const j = std::clamp(static_cast<int>(std::lround(y)), 0, height_ - 1);
    dot_[static_cast<std::size_t>(j * width_ + i)] = 1;
  }
  int width_, height_;
  std::vector<char> dot_;
};

/// The Braille sign of the 2 x 4 dots at (2 column, 4 row), as UTF-8.
std::string braille(Raster const& r, int column, int row) {
  constexpr int bit[4][2] = {{0, 3}, {1, 4}, {2, 5}, {6, 7}};
  unsigned sign = 0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 2; ++x)
      if (r.at(2 * column + x, 4 * row + y)) sign |= 1u << bit[y][x];
  if (sign == 0) return " ";
  return {static_cast<char>(0xE2), static_cast<char>(0xA0 | sign >> 6),
          static_cast<char>(0x80 | (sign & 63))};
}

} // namespace

std::string text_plot(std::span<double const> x, std::span<double const> y, std::string const& x_label,
                      std::string const& y_label, TextPlot const& size) {
  Extent wide, tall;
  std::size_t points = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) wide.take(x[i]), tall.take(y[i]), ++points;
  if (points < 2) return {};
  int const across = size.dots ? 2 : 1, down = size.dots ? 4 : 1;
  Raster raster(across * size.width, down * size.height);
  auto const px = [&](double v) { return wide.share(v) * (across * size.width - 1); };
  auto const py = [&](double v) { return (1 - tall.share(v)) * (down * size.height - 1); };
  for (std::size_t i = 1; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i]) && std::isfinite(x[i - 1]) && std::isfinite(y[i - 1]))
      raster.line(px(x[i - 1]), py(y[i - 1]), px(x[i]), py(y[i]));

  std::string text = y_label + "\n";
  for (int row = 0; row < size.height; ++row) {
    double const value = row == 0 ? tall.high : tall.low;
    text +=
        row == 0 || row == size.height - 1 ? fmt::format("{:>10.4g} |", value) : fmt::format("{:>10} |", "");
    for (int column = 0; column < size.width; ++column)
      text += size.dots ? braille(raster, column, row) : raster.at(column, row) ? "*" : " ";
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  text += fmt::format("{:>10} +{:-<{}}\n", "", "", size.width);
  std::string const low = fmt::format("{:.4g}", wide.low), high = fmt::format("{:.4g}", wide.high);
  text += fmt::format("{:>12}{} {:>{}}\n", "", low, high + " " + x_label,
                      std::max(1, size.width - static_cast<int>(low.size()) - 1));
  return text;
}

std::string progress_bar(double share, int width) {
  double const part = share > 0 ? std::min(share, 1.0) : 0; // not a number is nothing done
  int const done = static_cast<int>(std::lround(part * width));
  return fmt::format("{:#<{}}{:.<{}}", "", done, "", width - done);
}

} // namespace fissura::report
