#include "fit_client/render/label.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace fitroom::render {
namespace {

constexpr double kGlyphHeight = 6.0;  // Strokes live on a grid of 4 x 6.
constexpr double kAdvance = 6.0;      // From letter to letter, on the same grid.

// Returns a letter's strokes: polylines separated by spaces, each point two digits, x (0 to 4) and y (0 to 6, upwards).
std::string_view StrokesOf(char letter) {
  static constexpr std::string_view kLetters[26] = {
      "002640 1232",                // A
      "00063645443303 3342413000",  // B
      "4536160501103041",           // C
      "00062644422000",             // D
      "46060040 0333",              // E
      "460600 0333",                // F
      "45361605011030414323",       // G
      "0006 4046 0343",             // H
      "1030 2026 1636",             // I
      "4641301001",                 // J
      "0006 4602 1340",             // K
      "060040",                     // L
      "0006234640",                 // M
      "00064046",                   // N
      "100105163645413010",         // O
      "00063645443303",             // P
      "100105163645413010 2240",    // Q
      "00063645443303 2340",        // R
      "453616050413334241301001",   // S
      "0646 2026",                  // T
      "060110304146",               // U
      "062046",                     // V
      "0610243046",                 // W
      "0046 0640",                  // X
      "062346 2320",                // Y
      "06460040",                   // Z
  };
  static constexpr std::string_view kDigits[10] = {
      "100105163645413010",                // 0
      "152620 1030",                       // 1
      "05163645440040",                    // 2
      "05163645443323 334241301001",       // 3
      "30360242",                          // 4
      "460603334241301001",                // 5
      "4536160501103041423303",            // 6
      "064610",                            // 7
      "13040516364544331302011030414233",  // 8
      "0110304145361605041343",            // 9
  };
  if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  if (letter >= 'A' && letter <= 'Z') return kLetters[letter - 'A'];
  if (letter >= '0' && letter <= '9') return kDigits[letter - '0'];
  switch (letter) {
    case '.':
      return "2020";
    case '-':
      return "1333";
    case '/':
      return "0046";
    case ':':
      return "2121 2424";
    case '(':
      return "36252130";
    case ')':
      return "16252110";
    case '%':
      return "0046 0505 4141";
    case '+':
      return "2125 0343";
    default:
      return "";
  }
}

double DistanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double squared_length = ab.squaredNorm();
  const double t = squared_length > 0.0 ? std::clamp((point - a).dot(ab) / squared_length, 0.0, 1.0) : 0.0;
  return (point - a - t * ab).norm();
}

struct Stroke {
  Eigen::Vector2d from, to;  // (unit: pixel)
};

std::vector<Stroke> LayOut(char letter, double x, double y, double scale) {
  std::vector<Stroke> strokes;
  const std::string_view points = StrokesOf(letter);
  const auto place = [&](size_t i) {
    return Eigen::Vector2d(x + scale * (points[i] - '0'), y + scale * (kGlyphHeight - (points[i + 1] - '0')));
  };
  for (size_t i = 0; i + 3 < points.size(); i += 2) {
    if (points[i + 2] == ' ') {
      ++i;  // Over the space; the loop steps over the last point.
      continue;
    }
    strokes.push_back({place(i), place(i + 2)});
  }
  return strokes;
}

}  // namespace

double MeasureLabel(std::string_view text, const LabelStyle& style) {
  if (text.empty()) return 0.0;
  return (static_cast<double>(text.size()) * kAdvance - 2.0) * style.height / kGlyphHeight;
}

void DrawLabel(Image& image, std::string_view text, double x, double y, const LabelStyle& style) {
  const double scale = style.height / kGlyphHeight;
  const double half_width = 0.5 * style.stroke_width;
  for (size_t i = 0; i < text.size(); ++i) {
    const double left = x + static_cast<double>(i) * kAdvance * scale;
    const std::vector<Stroke> strokes = LayOut(text[i], left, y, scale);
    if (strokes.empty()) continue;
    const int x0 = std::max(0, static_cast<int>(std::floor(left - half_width - 1.0)));
    const int x1 = std::min(image.width - 1, static_cast<int>(std::ceil(left + 4.0 * scale + half_width + 1.0)));
    const int y0 = std::max(0, static_cast<int>(std::floor(y - half_width - 1.0)));
    const int y1 = std::min(image.height - 1, static_cast<int>(std::ceil(y + style.height + half_width + 1.0)));
    for (int row = y0; row <= y1; ++row) {
      for (int column = x0; column <= x1; ++column) {
        double distance = std::numeric_limits<double>::max();
        for (const Stroke& stroke : strokes) {
          distance = std::min(distance, DistanceToSegment({column + 0.5, row + 0.5}, stroke.from, stroke.to));
        }
        const double cover = std::clamp(half_width + 0.5 - distance, 0.0, 1.0);
        if (cover <= 0.0) continue;
        uint8_t* pixel = image.at(column, row);
        for (size_t c = 0; c < static_cast<size_t>(std::min(image.channels, 3)); ++c) {
          pixel[c] = static_cast<uint8_t>(std::lround(pixel[c] + cover * (style.colour[c] - pixel[c])));
        }
      }
    }
  }
}

}  // namespace fitroom::render
