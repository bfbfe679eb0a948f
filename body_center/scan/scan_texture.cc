#include "body_center/scan/scan_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "body_center/scan/random_source.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr int kImageSide = 2048;  // (unit: pixel)
constexpr int kMargin = 6;        // Round each half, filled by carrying colours outwards (unit: pixel).

const Vector3d kSkin(226, 188, 163);
const Vector3d kWear(88, 104, 124);
const Vector3d kCap(70, 78, 90);
const Vector3d kLips(196, 120, 112);
const Vector3d kBrow(120, 92, 76);
const Vector3d kEye(70, 62, 60);

// Returns 0 below `edge`, 1 above it, and a ramp 3 mm wide between.
double Above(double value, double edge) { return std::clamp((value - edge) / 0.003 + 0.5, 0.0, 1.0); }

// How far the point is covered by top or shorts. Heights in the reference figure.
double WearCover(const Vector3d& p, ImplicitSolid::Region region) {
  const double x = std::abs(p.x());
  double cover = Above(p.y(), 0.745) * (1.0 - Above(p.y(), 1.0));
  if (region == ImplicitSolid::Region::kTorso) {
    // Top with a scooped neck and straps.
    const double neckline = p.z() > 0.0 ? 1.262 + 0.9 * x * x : 1.285 + 0.5 * x * x;
    const double band = Above(p.y(), 1.135) * (1.0 - Above(p.y(), neckline));
    const double strap = Above(p.y(), 1.2) * Above(x, 0.072) * (1.0 - Above(x, 0.112));
    cover = std::max({cover, band, strap});
  }
  return region == ImplicitSolid::Region::kArm ? 0.0 : cover;
}

Vector3d FaceColour(const Vector3d& p, const Vector3d& skin) {
  const auto ellipse = [&p](double x, double y, double a, double b) {
    return std::clamp(2.0 - 2.0 * std::hypot((std::abs(p.x()) - x) / a, (p.y() - y) / b), 0.0, 1.0);
  };
  Vector3d colour = skin;
  const auto paint = [&colour](const Vector3d& ink, double amount) { colour += amount * (ink - colour); };
  if (p.z() > 0.07) {
    paint(kLips, 0.8 * ellipse(0.0, 1.501, 0.026, 0.011));
    paint(kEye, 0.8 * ellipse(0.032, 1.565, 0.015, 0.006));
    paint(kBrow, 0.75 * ellipse(0.033, 1.586 - 0.9 * std::pow(std::abs(p.x()) - 0.03, 2) / 0.03, 0.022, 0.005));
  }
  // The cap's rim runs from the forehead down to the nape, behind the ears.
  paint(kCap, Above(p.y(), 1.589 + 0.37 * p.z()));
  return colour;
}

Vector3d ColourAt(const Vector3d& p, ImplicitSolid::Region region, double mottle) {
  Vector3d colour = kSkin + mottle * Vector3d(2.0, 2.5, 2.5);
  if (region == ImplicitSolid::Region::kHead) colour = FaceColour(p, colour);
  const double cover = WearCover(p, region);
  return colour + cover * (kWear + mottle * Vector3d(1.5, 1.5, 1.5) - colour);
}

// Places the mesh on the picture's two halves.
class Layout {
 public:
  explicit Layout(const TriangleMesh& mesh) : bounds_(ComputeBounds(mesh)) {
    const Vector3d size = bounds_.sizes();
    pixels_per_metre_ = std::min((kImageSide / 2 - 2 * kMargin) / size.x(), (kImageSide - 2 * kMargin) / size.y());
  }
  // Returns the place in pixels, origin top left.
  Vector2d Place(const Vector3d& point, bool at_front) const {
    const double across = at_front ? point.x() - bounds_.min().x() : bounds_.max().x() - point.x();
    return {kMargin + across * pixels_per_metre_ + (at_front ? 0.0 : kImageSide / 2),
            kMargin + (bounds_.max().y() - point.y()) * pixels_per_metre_};
  }

 private:
  Eigen::AlignedBox3d bounds_;
  double pixels_per_metre_;
};

void FillTriangle(const std::array<Vector2d, 3>& place, const std::array<Vector3d, 3>& colour,
                  std::vector<Vector3f>& ink, std::vector<uint8_t>& inked) {
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double area = cross(place[1] - place[0], place[2] - place[0]);
  if (std::abs(area) < 1e-9) return;
  const auto span = [&place](int axis) {
    const double low = std::min({place[0][axis], place[1][axis], place[2][axis]});
    const double high = std::max({place[0][axis], place[1][axis], place[2][axis]});
    return std::pair<int, int>(std::max(0, static_cast<int>(low)),
                               std::min(kImageSide - 1, static_cast<int>(high) + 1));
  };
  const auto [x0, x1] = span(0);
  const auto [y0, y1] = span(1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vector2d pixel(x + 0.5, y + 0.5);
      const double a = cross(place[1] - pixel, place[2] - pixel) / area;
      const double b = cross(place[2] - pixel, place[0] - pixel) / area;
      const double c = 1.0 - a - b;
      if (std::min({a, b, c}) < -1e-6) continue;
      const size_t index = static_cast<size_t>(y) * kImageSide + static_cast<size_t>(x);
      ink[index] = (a * colour[0] + b * colour[1] + c * colour[2]).cast<float>();
      inked[index] = 1;
    }
  }
}

// Carries the colours outwards by one pixel, so that filtering at the rim meets no background.
void CarryOutwards(std::vector<Vector3f>& ink, std::vector<uint8_t>& inked) {
  const std::vector<uint8_t> before = inked;
  for (int y = 1; y + 1 < kImageSide; ++y) {
    for (int x = 1; x + 1 < kImageSide; ++x) {
      const size_t index = static_cast<size_t>(y) * kImageSide + static_cast<size_t>(x);
      if (before[index] != 0) continue;
      Vector3f sum = Vector3f::Zero();
      int count = 0;
      for (const size_t neighbour : {index - 1, index + 1, index - kImageSide, index + kImageSide}) {
        if (before[neighbour] == 0) continue;
        sum += ink[neighbour];
        ++count;
      }
      if (count == 0) continue;
      ink[index] = sum / static_cast<float>(count);
      inked[index] = 1;
    }
  }
}

Image ToImage(const std::vector<Vector3f>& ink) {
  Image image;
  image.width = kImageSide;
  image.height = kImageSide;
  image.channels = 3;
  image.pixels.reserve(ink.size() * 3);
  for (const Vector3f& colour : ink) {
    for (int i = 0; i < 3; ++i) {
      image.pixels.push_back(static_cast<uint8_t>(std::clamp(std::lround(colour[i]), 0L, 255L)));
    }
  }
  return image;
}

}  // namespace

ScanTexture PaintScanTexture(const TriangleMesh& mesh, const ImplicitSolid& solid, uint64_t seed) {
  RandomSource random(seed ^ 0x7465787475726575u);
  std::vector<Vector3d> colours;
  colours.reserve(mesh.vertices.size());
  for (const Vector3d& vertex : mesh.vertices) {
    colours.push_back(ColourAt(vertex, solid.RegionAt(vertex), random.Normal()));
  }
  const Layout layout(mesh);
  const size_t pixel_count = size_t{kImageSide} * kImageSide;
  std::vector<Vector3f> ink(pixel_count, kSkin.cast<float>());
  std::vector<uint8_t> inked(pixel_count, 0);
  ScanTexture texture;
  std::array<std::vector<int>, 2> index_of;
  for (std::vector<int>& indices : index_of) indices.assign(mesh.vertices.size(), -1);
  for (const Vector3i& triangle : mesh.triangles) {
    std::array<Vector3d, 3> corner, colour;
    for (size_t i = 0; i < 3; ++i) {
      corner[i] = mesh.vertices[static_cast<size_t>(triangle[static_cast<int>(i)])];
      colour[i] = colours[static_cast<size_t>(triangle[static_cast<int>(i)])];
    }
    const bool at_front = (corner[1] - corner[0]).cross(corner[2] - corner[0]).z() >= 0.0;
    std::array<Vector2d, 3> place;
    Vector3i indices;
    for (size_t i = 0; i < 3; ++i) {
      place[i] = layout.Place(corner[i], at_front);
      int& index = index_of[at_front ? 0 : 1][static_cast<size_t>(triangle[static_cast<int>(i)])];
      if (index < 0) {
        index = static_cast<int>(texture.coordinates.size());
        texture.coordinates.emplace_back(static_cast<float>(place[i].x() / kImageSide),
                                         static_cast<float>(1.0 - place[i].y() / kImageSide));
      }
      indices[static_cast<int>(i)] = index;
    }
    texture.triangles.push_back(indices);
    FillTriangle(place, colour, ink, inked);
  }
  for (int i = 0; i < kMargin; ++i) CarryOutwards(ink, inked);
  texture.image = ToImage(ink);
  return texture;
}

}  // namespace fitroom::body_center
