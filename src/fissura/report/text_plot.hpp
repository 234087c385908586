#pragma once
// A curve as text, for a terminal.
#include <span>
#include <string>

namespace fissura::report {

struct TextPlot {
  int width = 64, height = 12; ///< characters of the picture, without its labels
  bool dots = true;            ///< Braille dots, eight to a character; else one `*` per character
};

/// y over x with the ends of both axes beside them; empty where fewer than two points are finite.
std::string text_plot(std::span<double const> x, std::span<double const> y, std::string const& x_label,
                      std::string const& y_label, TextPlot const& size);

/// "########........" `width` characters wide for a share from 0 to 1.
std::string progress_bar(double share, int width);

} // namespace fissura::report
