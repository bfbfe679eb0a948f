#include "fit_client/fit/panels/view_samples.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace fitroom::panels {
namespace {

constexpr double kSampleSpacing = 0.008;  // (unit: metre)
constexpr double kSameKnot = 0.002;       // Knots closer than this share a sample (unit: metre).
constexpr int kMaxSamplesPerInterval = 400;

// Returns the direction of the wearer's left in a plane of points, x already towards the left: the smallest
// eigenvector of the quadratic form that sums, over pairs of mirrored samples, the part of their difference across the
// direction and the part of their midpoints along it.
Eigen::Vector2d LeftDirection(const std::vector<SectionLayout>& layout, const std::vector<Polyline>& sections) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d towards_left = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> differences, middles;
  for (size_t s = 0; s < layout.size(); ++s) {
    if (layout[s].own_per_panel) continue;
    const Polyline& own = sections[s];
    const Polyline& other = sections[static_cast<size_t>(layout[s].mirror)];
    const bool is_left = layout[s].name.ends_with("_L");
    if (!is_left) continue;
    for (size_t i = 0; i < own.size(); ++i) {
      differences.push_back(own[i] - other[own.size() - 1 - i]);
      middles.push_back(0.5 * (own[i] + other[own.size() - 1 - i]));
      centre += middles.back();
      towards_left += differences.back();
    }
  }
  centre /= static_cast<double>(middles.size());
  Eigen::Matrix2d form = Eigen::Matrix2d::Zero();
  for (size_t i = 0; i < middles.size(); ++i) {
    const Eigen::Vector2d across(-differences[i].y(), differences[i].x());
    const Eigen::Vector2d off = 2.0 * (middles[i] - centre);
    form += across * across.transpose() + off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(form);
  Eigen::Vector2d direction = solver.eigenvectors().col(0);
  if (direction.dot(towards_left) < 0.0) direction = -direction;
  return direction;
}

}  // namespace

KnotIndices ChooseKnotIndices(const std::vector<SectionLayout>& layout, const std::vector<const ViewOutline*>& views) {
  const auto mean_length = [&](size_t section, size_t interval) {
    const size_t mirror = static_cast<size_t>(layout[section].mirror);
    const size_t mirrored_interval = layout[section].knots.size() - 2 - interval;
    double sum = 0.0;
    for (const ViewOutline* view : views) {
      sum += 0.5 * view->metre_per_pixel *
             (ChainLength(view->chains[section][interval]) + ChainLength(view->chains[mirror][mirrored_interval]));
    }
    return sum / static_cast<double>(views.size());
  };
  KnotIndices indices(layout.size());
  for (size_t s = 0; s < layout.size(); ++s) {
    indices[s].push_back(0);
    for (size_t k = 0; k + 1 < layout[s].knots.size(); ++k) {
      const double length = mean_length(s, k);
      const int count = length < kSameKnot ? 0
                                           : std::clamp(static_cast<int>(std::ceil(length / kSampleSpacing)), 1,
                                                        kMaxSamplesPerInterval);
      indices[s].push_back(indices[s].back() + count);
    }
  }
  return indices;
}

ViewSamples SampleUpright(const std::vector<SectionLayout>& layout, const KnotIndices& knots, const ViewOutline& view,
                          double length) {
  const double length_in_pixels = length / view.metre_per_pixel;
  const double mirror = view.side == GarmentSide::kFront ? 1.0 : -1.0;
  ViewSamples samples;
  for (size_t s = 0; s < layout.size(); ++s) {
    Polyline pixels = {view.chains[s].front().front()};
    for (size_t k = 0; k + 1 < knots[s].size(); ++k) {
      const int count = knots[s][k + 1] - knots[s][k];
      if (count == 0) continue;
      const Polyline part = SampleChain(view.chains[s][k], count, length_in_pixels);
      pixels.back() = part.front();
      pixels.insert(pixels.end(), part.begin() + 1, part.end());
    }
    Polyline points;
    for (const Eigen::Vector2d& p : pixels) points.emplace_back(mirror * p.x(), -p.y());
    samples.pixels.push_back(std::move(pixels));
    samples.points.push_back(std::move(points));
  }
  // A corner is the end of one section and the start of the next: both on one place, also where knots were merged.
  for (size_t s = 0; s < layout.size(); ++s) {
    const size_t next = (s + 1) % layout.size();
    samples.pixels[s].back() = samples.pixels[next].front();
    samples.points[s].back() = samples.points[next].front();
  }

  const Eigen::Vector2d left = LeftDirection(layout, samples.points);
  Eigen::Matrix2d upright_from_photo;
  upright_from_photo << left.x(), left.y(), -left.y(), left.x();
  upright_from_photo *= view.metre_per_pixel;
  for (Polyline& points : samples.points) {
    for (Eigen::Vector2d& p : points) p = upright_from_photo * p;
  }
  CentreOnSeams(layout, samples);
  return samples;
}

void CentreOnSeams(const std::vector<SectionLayout>& layout, ViewSamples& samples) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (size_t s = 0; s < layout.size(); ++s) {
    if (layout[s].own_per_panel) continue;
    for (const Eigen::Vector2d& p : samples.points[s]) centre += p;
    count += static_cast<double>(samples.points[s].size());
  }
  centre /= count;
  for (Polyline& points : samples.points) {
    for (Eigen::Vector2d& p : points) p -= centre;
  }
}

void LevelUpperOpening(ViewSamples& samples) {
  const Eigen::Vector2d left = (samples.points.front().front() - samples.points.front().back()).normalized();
  if (!left.allFinite()) return;
  Eigen::Matrix2d level_from_upright;
  level_from_upright << left.x(), left.y(), -left.y(), left.x();
  for (Polyline& points : samples.points) {
    for (Eigen::Vector2d& p : points) p = level_from_upright * p;
  }
}

Polyline Mirrored(const Polyline& points) {
  Polyline mirrored(points.rbegin(), points.rend());
  for (Eigen::Vector2d& p : mirrored) p.x() = -p.x();
  return mirrored;
}

void MoveEnds(Polyline& points, const Eigen::Vector2d& first, const Eigen::Vector2d& last) {
  const std::vector<double> arcs = CumulativeLengths(points);
  const Eigen::Vector2d at_first = first - points.front();
  const Eigen::Vector2d at_last = last - points.back();
  for (size_t i = 0; i < points.size(); ++i) {
    const double t = arcs.back() > 0.0 ? arcs[i] / arcs.back() : 0.0;
    points[i] += (1.0 - t) * at_first + t * at_last;
  }
  points.front() = first;
  points.back() = last;
}

}  // namespace fitroom::panels
