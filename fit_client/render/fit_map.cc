#include "fit_client/render/fit_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "fit_client/render/garment_surface.h"
#include "fit_client/render/label.h"
#include "fit_client/render/renderer.h"

namespace fitroom::render {
namespace {

constexpr int kWidth = 600;              // Of each view (unit: pixel).
constexpr int kHeight = 900;             // (unit: pixel)
constexpr int kGap = 6;                  // (unit: pixel)
constexpr int kLegendHeight = 110;       // (unit: pixel)
constexpr int kBandPixels = 64;          // Of the colour strip that serves as texture.
constexpr double kSubjectMargin = 0.06;  // Round the garment (unit: metre).

Colour Rgb(int red, int green, int blue) {
  return Colour(static_cast<float>(red), static_cast<float>(green), static_cast<float>(blue)) / 255.0F;
}

std::string Percent(double part) {
  char text[16];
  std::snprintf(text, sizeof(text), "%.0f", 100.0 * part);
  return text;
}

uint8_t Byte(float part) { return static_cast<uint8_t>(std::lround(255.0F * std::clamp(part, 0.0F, 1.0F))); }

// The bands side by side, each of its one colour.
Image MakeStrip(const MapScale& scale) {
  Image strip = MakeImage(kBandPixels * static_cast<int>(scale.bands.size()), 4, 3);
  for (int y = 0; y < strip.height; ++y) {
    for (int x = 0; x < strip.width; ++x) {
      const Colour& colour = scale.bands[static_cast<size_t>(x / kBandPixels)].colour;
      for (int c = 0; c < 3; ++c) strip.at(x, y)[c] = Byte(colour[c]);
    }
  }
  return strip;
}

void FillBox(Image& image, int x, int y, int width, int height, const Colour& colour) {
  for (int row = y; row < y + height; ++row) {
    for (int column = x; column < x + width; ++column) {
      const bool is_border = row == y || row == y + height - 1 || column == x || column == x + width - 1;
      for (int c = 0; c < 3; ++c) image.at(column, row)[c] = is_border ? uint8_t{90} : Byte(colour[c]);
    }
  }
}

void DrawLegend(Image& sheet, const MapScale& scale, int top) {
  constexpr int kMargin = 24;
  constexpr int kSwatchHeight = 30;
  LabelStyle title;
  title.height = 15.0;
  DrawLabel(sheet, scale.title, kMargin, top + 12, title);
  LabelStyle label;
  label.height = 11.0;
  label.stroke_width = 1.5;
  const int count = static_cast<int>(scale.bands.size());
  const int band_width = (sheet.width - 2 * kMargin) / count;
  for (int b = 0; b < count; ++b) {
    const MapBand& band = scale.bands[static_cast<size_t>(b)];
    FillBox(sheet, kMargin + b * band_width, top + 38, band_width - 4, kSwatchHeight, band.colour);
    DrawLabel(sheet, band.label, kMargin + b * band_width + 2, top + 38 + kSwatchHeight + 10, label);
  }
}

Status Bad(const char* what) { return InvalidArgument("BAD_MAP_REQUEST", what); }

Status CheckRequest(const FitMapRequest& request) {
  if (request.body == nullptr || request.cloth == nullptr) return Bad("a map needs a body and a cloth");
  if (request.scale.bands.empty()) return Bad("a map's scale needs a band");
  if (request.positions.size() != request.cloth->panel_of_particle.size())
    return Bad("a map needs one position a particle");
  if (request.values.size() != request.positions.size() && request.values.size() != request.cloth->triangles.size()) {
    return Bad("a map needs one value a particle or one a triangle");
  }
  return Status();
}

}  // namespace

MapScale StrainScale(double tight, double limit) {
  const double snug = std::min(0.02, 0.5 * tight);
  return {"STRAIN %: HOW MUCH LONGER THE CLOTH IS PULLED",
          {{0.0, "0-" + Percent(snug) + " NONE", Rgb(226, 232, 240)},
           {snug, Percent(snug) + "-" + Percent(tight) + " SNUG", Rgb(242, 192, 76)},
           {tight, Percent(tight) + "-" + Percent(limit) + " TIGHT", Rgb(214, 94, 42)},
           {limit, "ABOVE " + Percent(limit) + " TOO FAR", Rgb(84, 12, 58)}}};
}

MapScale PressureScale() {
  return {"PRESSURE ON THE BODY (KPA)",
          {{0.0, "BELOW 0.4 NONE", Rgb(226, 232, 240)},
           {400.0, "0.4-1.3 COMFORT", Rgb(244, 200, 96)},
           {1300.0, "1.3-2.0 CRITICAL", Rgb(222, 128, 48)},
           {2000.0, "2.0-3.3 MEDICAL", Rgb(166, 48, 44)},
           {3300.0, "ABOVE 3.3 TOO HIGH", Rgb(58, 8, 52)}}};
}

MapScale GapScale() {
  return {"ROOM BETWEEN BODY AND CLOTH (MM)",
          {{0.0, "0-6 LIES ON IT", Rgb(10, 48, 100)},
           {0.006, "6-20 NEAR", Rgb(48, 122, 184)},
           {0.020, "20-50 LOOSE", Rgb(146, 194, 224)},
           {0.050, "ABOVE 50 STANDS OFF", Rgb(232, 241, 248)}}};
}

double PlaceOnScale(const MapScale& scale, double value) {
  if (!std::isfinite(value)) value = 0.0;
  size_t band = 0;
  while (band + 1 < scale.bands.size() && value >= scale.bands[band + 1].from) ++band;
  const double from = scale.bands[band].from;
  // The last band has no end: it takes the width of the one before.
  const double width = band + 1 < scale.bands.size() ? scale.bands[band + 1].from - from
                       : band > 0                    ? from - scale.bands[band - 1].from
                                                     : 1.0;
  const double part = width > 0.0 ? std::clamp((value - from) / width, 0.0, 1.0) : 0.0;
  return (static_cast<double>(band) + part) / static_cast<double>(scale.bands.size());
}

std::vector<double> SpreadToParticles(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                      const std::vector<double>& triangle_values) {
  const std::vector<int> welded = WeldParticles(cloth, positions);
  std::vector<double> sums(positions.size(), 0.0);
  std::vector<int> counts(positions.size(), 0);
  for (size_t t = 0; t < cloth.triangles.size() && t < triangle_values.size(); ++t) {
    if (!std::isfinite(triangle_values[t])) continue;
    for (const int corner : cloth.triangles[t]) {
      const auto root = static_cast<size_t>(welded[static_cast<size_t>(corner)]);
      sums[root] += triangle_values[t];
      ++counts[root];
    }
  }
  std::vector<double> values(positions.size(), 0.0);
  for (size_t i = 0; i < values.size(); ++i) {
    const auto root = static_cast<size_t>(welded[i]);
    if (counts[root] > 0) values[i] = sums[root] / counts[root];
  }
  return values;
}

Result<Image> DrawFitMap(const FitMapRequest& request) {
  FR_RETURN_IF_ERROR(CheckRequest(request));
  const Image strip = MakeStrip(request.scale);
  const bool is_by_particle = request.values.size() == request.positions.size();
  const std::vector<double> values =
      is_by_particle ? request.values : SpreadToParticles(*request.cloth, request.positions, request.values);
  ClothMesh coloured = *request.cloth;
  coloured.texture_coordinates.resize(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    // Half a pixel inside, so that the ends' colours stay theirs.
    const double place = std::clamp(PlaceOnScale(request.scale, values[i]), 0.004, 0.996);
    coloured.texture_coordinates[i] = Eigen::Vector2d(place, 0.5);
  }
  Scene scene;
  scene.body = request.body;
  scene.garments = request.others;
  scene.garments.push_back({&coloured, request.positions, &strip, &strip});
  Eigen::AlignedBox3d subject;
  for (const Eigen::Vector3d& position : request.positions) subject.extend(position);
  subject.min().array() -= kSubjectMargin;
  subject.max().array() += kSubjectMargin;
  const std::array<Camera, 2> cameras = {Camera{ViewDirection::kFront, subject, kWidth, kHeight},
                                         Camera{ViewDirection::kBack, subject, kWidth, kHeight}};
  FR_ASSIGN_OR_RETURN(Renderer renderer, Renderer::Create());
  FR_ASSIGN_OR_RETURN(const std::vector<Image> views, renderer.Draw(scene, cameras));
  Image sheet = MakeImage(2 * kWidth + kGap, kHeight + kLegendHeight, 3);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), uint8_t{255});
  for (size_t v = 0; v < views.size(); ++v) {
    const int left = static_cast<int>(v) * (kWidth + kGap);
    for (int row = 0; row < kHeight; ++row) {
      std::memcpy(sheet.at(left, row), views[v].at(0, row), static_cast<size_t>(kWidth) * 3);
    }
    DrawLabel(sheet, v == 0 ? "FRONT" : "BACK", left + 14, 14);
  }
  DrawLegend(sheet, request.scale, kHeight);
  return sheet;
}

}  // namespace fitroom::render
