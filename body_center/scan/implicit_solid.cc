#include "body_center/scan/implicit_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"

namespace fitroom::body_center {
namespace {

// A value that stands for "nothing near" (unit: metre).
constexpr double kFar = 1.0;
// How far a shape's influence reaches beyond its box: more than a part's and a group's widest blend (unit: metre).
constexpr double kReach = 0.09;
// The rounding between the soles' rim and the floor (unit: metre).
constexpr double kFloorBlend = 0.004;

// The polynomial smooth minimum: equals min(a, b) where they differ by more than `blend`.
double SmoothMin(double a, double b, double blend) {
  const double overlap = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - (blend > 0.0 ? overlap * overlap / (4.0 * blend) : 0.0);
}

// Returns the factor by which a superellipse with `exponent` must grow to pass through (u, v), both not negative and
// scaled to its half axes.
double SuperellipseGauge(double u, double v, double exponent) {
  if (exponent == 2.0) return std::sqrt(u * u + v * v);
  const double larger = std::max(u, v);
  if (larger == 0.0) return 0.0;
  return larger * std::pow(1.0 + std::pow(std::min(u, v) / larger, exponent), 1.0 / exponent);
}

class Sweep final : public Shape {
 public:
  Sweep(const Eigen::Isometry3d& world_from_sweep, std::vector<SweptSection> sections)
      : sweep_from_world_(world_from_sweep.inverse()),
        start_(sections.front().position),
        end_(sections.back().position) {
    FR_CHECK(sections.size() >= 2 && end_ > start_);
    for (int i = 0; i <= kSampleCount; ++i) {
      samples_.push_back(Interpolate(sections, start_ + (end_ - start_) * i / kSampleCount));
    }
    Eigen::AlignedBox3d box;
    for (const SweptSection& sample : samples_) {
      const double widest = sample.half_width;
      box.extend(Eigen::Vector3d(sample.centre.x() - widest, sample.centre.y() - sample.back, sample.position));
      box.extend(Eigen::Vector3d(sample.centre.x() + widest, sample.centre.y() + sample.front, sample.position));
    }
    bounds_ = box.transformed(world_from_sweep);
  }

  double Evaluate(const Eigen::Vector3d& point) const override {
    const Eigen::Vector3d local = sweep_from_world_ * point;
    const double place = std::clamp((local.z() - start_) / (end_ - start_), 0.0, 1.0) * kSampleCount;
    const int index = std::min(static_cast<int>(place), kSampleCount - 1);
    const double t = place - index;
    const SweptSection& a = samples_[static_cast<size_t>(index)];
    const SweptSection& b = samples_[static_cast<size_t>(index) + 1];
    const auto mix = [t](double from, double to) { return from + t * (to - from); };
    const double u = local.x() - mix(a.centre.x(), b.centre.x());
    const double v = local.y() - mix(a.centre.y(), b.centre.y());
    const double depth = v >= 0.0 ? mix(a.front, b.front) : mix(a.back, b.back);
    const double exponent = v >= 0.0 ? mix(a.front_exponent, b.front_exponent) : mix(a.back_exponent, b.back_exponent);
    const double gauge =
        SuperellipseGauge(std::abs(u) / mix(a.half_width, b.half_width), std::abs(v) / depth, exponent);
    // Distance along the ray from the centre; at the centre itself the smaller half axis.
    const double radius = std::hypot(u, v);
    const double side = gauge > 1e-9 ? radius * (1.0 - 1.0 / gauge) : -std::min(a.half_width, depth);
    const double beyond = std::max(start_ - local.z(), local.z() - end_);
    if (beyond <= 0.0) return std::max(side, beyond);
    return side <= 0.0 ? beyond : std::hypot(side, beyond);
  }

  Eigen::AlignedBox3d Bounds() const override { return bounds_; }

 private:
  static constexpr int kSampleCount = 400;

  // Catmull-Rom interpolation with tangents for uneven spacing.
  static SweptSection Interpolate(const std::vector<SweptSection>& sections, double position) {
    size_t i = 0;
    while (i + 2 < sections.size() && sections[i + 1].position < position) ++i;
    const SweptSection& p1 = sections[i];
    const SweptSection& p2 = sections[i + 1];
    const SweptSection& p0 = i > 0 ? sections[i - 1] : p1;
    const SweptSection& p3 = i + 2 < sections.size() ? sections[i + 2] : p2;
    const double h = p2.position - p1.position;
    const double t = std::clamp((position - p1.position) / h, 0.0, 1.0);
    const auto blend = [&](auto member) {
      const double slope = (member(p2) - member(p1)) / h;
      const double m1 = &p0 == &p1 ? slope : (member(p2) - member(p0)) / (p2.position - p0.position);
      const double m2 = &p3 == &p2 ? slope : (member(p3) - member(p1)) / (p3.position - p1.position);
      const double t2 = t * t, t3 = t2 * t;
      return (2 * t3 - 3 * t2 + 1) * member(p1) + (t3 - 2 * t2 + t) * h * m1 + (3 * t2 - 2 * t3) * member(p2) +
             (t3 - t2) * h * m2;
    };
    SweptSection section;
    section.position = position;
    section.centre.x() = blend([](const SweptSection& s) { return s.centre.x(); });
    section.centre.y() = blend([](const SweptSection& s) { return s.centre.y(); });
    section.half_width = blend([](const SweptSection& s) { return s.half_width; });
    section.front = blend([](const SweptSection& s) { return s.front; });
    section.back = blend([](const SweptSection& s) { return s.back; });
    section.front_exponent = blend([](const SweptSection& s) { return s.front_exponent; });
    section.back_exponent = blend([](const SweptSection& s) { return s.back_exponent; });
    return section;
  }

  Eigen::Isometry3d sweep_from_world_;
  double start_;
  double end_;
  std::vector<SweptSection> samples_;
  Eigen::AlignedBox3d bounds_;
};

class RoundCone final : public Shape {
 public:
  RoundCone(const Eigen::Vector3d& start, double start_radius, const Eigen::Vector3d& end, double end_radius)
      : start_(start), axis_(end - start), start_radius_(start_radius), end_radius_(end_radius) {}

  double Evaluate(const Eigen::Vector3d& point) const override {
    const Eigen::Vector3d offset = point - start_;
    const double t = std::clamp(offset.dot(axis_) / axis_.squaredNorm(), 0.0, 1.0);
    return (offset - t * axis_).norm() - (start_radius_ + t * (end_radius_ - start_radius_));
  }

  Eigen::AlignedBox3d Bounds() const override {
    const Eigen::Vector3d end = start_ + axis_;
    Eigen::AlignedBox3d box(start_.array() - start_radius_, start_.array() + start_radius_);
    box.extend(Eigen::AlignedBox3d(end.array() - end_radius_, end.array() + end_radius_));
    return box;
  }

 private:
  Eigen::Vector3d start_;
  Eigen::Vector3d axis_;
  double start_radius_;
  double end_radius_;
};

class Ellipsoid final : public Shape {
 public:
  Ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii) : centre_(centre), radii_(radii) {}

  // First-order distance: the gauge minus one, divided by the gauge's gradient.
  double Evaluate(const Eigen::Vector3d& point) const override {
    const Eigen::Vector3d offset = point - centre_;
    const double gauge = offset.cwiseQuotient(radii_).norm();
    const double slope = offset.cwiseQuotient(radii_.cwiseProduct(radii_)).norm();
    return slope > 1e-9 ? gauge * (gauge - 1.0) / slope : -radii_.minCoeff();
  }

  Eigen::AlignedBox3d Bounds() const override { return {centre_ - radii_, centre_ + radii_}; }

 private:
  Eigen::Vector3d centre_;
  Eigen::Vector3d radii_;
};

}  // namespace

std::shared_ptr<const Shape> MakeSweep(const Eigen::Isometry3d& world_from_sweep, std::vector<SweptSection> sections) {
  return std::make_shared<Sweep>(world_from_sweep, std::move(sections));
}

std::shared_ptr<const Shape> MakeRoundCone(const Eigen::Vector3d& start, double start_radius,
                                           const Eigen::Vector3d& end, double end_radius) {
  return std::make_shared<RoundCone>(start, start_radius, end, end_radius);
}

std::shared_ptr<const Shape> MakeEllipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii) {
  return std::make_shared<Ellipsoid>(centre, radii);
}

void ImplicitSolid::AddGroup(Region region, double blend) { groups_.push_back({{}, blend, region}); }

void ImplicitSolid::Add(std::shared_ptr<const Shape> shape, double blend) {
  const Eigen::AlignedBox3d bounds = shape->Bounds();
  groups_.back().parts.push_back({std::move(shape), bounds, blend, false});
}

void ImplicitSolid::Carve(std::shared_ptr<const Shape> shape, double blend) {
  const Eigen::AlignedBox3d bounds = shape->Bounds();
  groups_.back().parts.push_back({std::move(shape), bounds, blend, true});
}

double ImplicitSolid::EvaluateGroup(const Group& group, const Eigen::Vector3d& point) {
  double value = kFar;
  for (const Part& part : group.parts) {
    if (part.carved) {
      value = -SmoothMin(-value, part.shape->Evaluate(point), part.blend);
    } else {
      value = SmoothMin(value, part.shape->Evaluate(point), part.blend);
    }
  }
  return value;
}

double ImplicitSolid::Evaluate(const Eigen::Vector3d& point) const {
  double value = kFar;
  for (const Group& group : groups_) value = SmoothMin(value, EvaluateGroup(group, point), group.blend);
  return -SmoothMin(-value, point.y(), kFloorBlend);
}

Eigen::Vector3d ImplicitSolid::Gradient(const Eigen::Vector3d& point) const {
  constexpr double kStep = 1e-4;
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (Evaluate(point + step) - Evaluate(point - step)) / (2.0 * kStep);
  }
  return gradient;
}

ImplicitSolid::Region ImplicitSolid::RegionAt(const Eigen::Vector3d& point) const {
  Region nearest = Region::kTorso;
  double least = kFar;
  for (const Group& group : groups_) {
    const double value = EvaluateGroup(group, point);
    if (value < least) {
      least = value;
      nearest = group.region;
    }
  }
  return nearest;
}

ImplicitSolid ImplicitSolid::RestrictedTo(const Eigen::AlignedBox3d& box) const {
  const Eigen::AlignedBox3d reach(box.min().array() - kReach, box.max().array() + kReach);
  ImplicitSolid restricted;
  for (const Group& group : groups_) {
    Group kept{{}, group.blend, group.region};
    for (const Part& part : group.parts) {
      if (part.bounds.intersects(reach)) kept.parts.push_back(part);
    }
    if (!kept.parts.empty()) restricted.groups_.push_back(std::move(kept));
  }
  return restricted;
}

ImplicitSolid ImplicitSolid::Without(Region region) const {
  ImplicitSolid kept;
  for (const Group& group : groups_) {
    if (group.region != region) kept.groups_.push_back(group);
  }
  return kept;
}

Eigen::AlignedBox3d ImplicitSolid::Bounds() const {
  Eigen::AlignedBox3d box;
  for (const Group& group : groups_) {
    for (const Part& part : group.parts) {
      if (!part.carved) box.extend(part.bounds);
    }
  }
  return box;
}

}  // namespace fitroom::body_center
