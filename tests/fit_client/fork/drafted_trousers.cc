#include "tests/fit_client/fork/drafted_trousers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace fitroom::testing {
namespace {

using Chain = std::vector<Eigen::Vector2d>;

double Length(const Chain& chain) {
  double length = 0.0;
  for (size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
  return length;
}

// The x of a chain that runs down, at a height; carried on straight beyond its upper end.
double At(const Chain& chain, double y) {
  size_t i = 1;
  while (i + 1 < chain.size() && chain[i].y() > y) ++i;
  const Eigen::Vector2d& a = chain[i - 1];
  const Eigen::Vector2d& b = chain[i];
  if (a.y() - b.y() < 1e-9) return b.x();
  const double t = std::min((a.y() - y) / (a.y() - b.y()), 1.0);
  return a.x() + t * (b.x() - a.x());
}

struct PieceDraft {
  Eigen::Vector2d waist_centre;
  double side_waist = 0.0, hip_width = 0.0;
  double extension = 0.0, drop = 0.0;
  double curve_height = 0.0, exponent = 2.0;
  double knee_inner = 0.0, hem_inner = 0.0, hem_outer = 0.0;
};

// The centre seam goes straight to the fork line at the curve's upper end and then along a superellipse.
DraftedPiece DrawPiece(const PieceDraft& d, const DraftedBody& body) {
  DraftedPiece piece;
  const double crotch = -body.rise, hem = crotch - body.inseam, knee = crotch - 0.45 * body.inseam;
  const Eigen::Vector2d start(0.0, crotch + d.curve_height);
  for (int i = 0; i < 60; ++i) piece.centre.push_back(d.waist_centre + (start - d.waist_centre) * (i / 60.0));
  for (int i = 0; i <= 200; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / 200.0;
    piece.centre.emplace_back(-d.extension + d.extension * std::pow(std::max(0.0, std::cos(angle)), 2.0 / d.exponent),
                              start.y() - (d.curve_height + d.drop) * std::pow(std::sin(angle), 2.0 / d.exponent));
  }
  // The inseam is hollowed by a centimetre between fork and knee.
  const Eigen::Vector2d tip = piece.centre.back();
  for (int i = 0; i < 80; ++i) {
    const double t = i / 80.0;
    piece.inseam.emplace_back(tip.x() + t * (d.knee_inner - tip.x()) + 0.01 * std::sin(std::numbers::pi * t),
                              tip.y() + t * (knee - tip.y()));
  }
  for (int i = 0; i <= 80; ++i) {
    const double t = i / 80.0;
    piece.inseam.emplace_back(d.knee_inner + t * (d.hem_inner - d.knee_inner), knee + t * (hem - knee));
  }
  // A parabola from waist to hip, then straight.
  for (int i = 0; i < 60; ++i) {
    const double t = i / 60.0;
    piece.outseam.emplace_back(d.hip_width - (d.hip_width - d.side_waist) * (1.0 - t) * (1.0 - t),
                               -t * body.waist_to_hip);
  }
  for (int i = 0; i <= 120; ++i) {
    const double t = i / 120.0;
    piece.outseam.emplace_back(d.hip_width + t * (d.hem_outer - d.hip_width),
                               -body.waist_to_hip + t * (hem + body.waist_to_hip));
  }
  return piece;
}

DraftedTrousers Finish(const DraftedBody& body, const PieceDraft& front, const PieceDraft& back) {
  DraftedTrousers trousers;
  trousers.body = body;
  trousers.front = DrawPiece(front, body);
  trousers.back = DrawPiece(back, body);
  for (const DraftedPiece* piece : {&trousers.front, &trousers.back}) {
    trousers.hip_girth += 2.0 * (At(piece->outseam, -body.waist_to_hip) - At(piece->centre, -body.waist_to_hip));
    const Eigen::Vector2d& tip = piece->centre.back();
    trousers.thigh_girth += At(piece->outseam, tip.y()) - tip.x();
  }
  trousers.front_rise = Length(trousers.front.centre);
  trousers.back_rise = Length(trousers.back.centre);
  return trousers;
}

// The classic trouser block: front 1/16 hip + 0.5 cm, its curve from the hip line; back a quarter of (1/12 hip + 1.5
// cm)
// + 1.5 of the front; the back's waist 2 cm up and 3.5 cm in, its fork 0.5 cm lower, its curve from 1 cm above the hip
// line.
DraftedTrousers DraftAldrich(const DraftedBody& body) {
  PieceDraft front, back;
  front.extension = body.hip / 16.0 + 0.005;
  front.waist_centre = {0.01, 0.0};
  front.side_waist = 0.01 + 0.25 * body.waist + 0.005;
  front.hip_width = 0.25 * body.hip + 0.005;
  front.curve_height = body.rise - body.waist_to_hip;
  front.exponent = 2.3;
  front.knee_inner = -0.02;
  front.hem_inner = -0.012;
  front.hem_outer = 0.20;
  back.extension = 0.25 * (body.hip / 12.0 + 0.015) + 1.5 * front.extension;
  back.drop = 0.005;
  back.waist_centre = {0.035, 0.02};
  back.side_waist = 0.035 + 0.25 * body.waist + 0.01;
  back.hip_width = 0.25 * body.hip + 0.015;
  back.curve_height = front.curve_height + 0.01;
  back.exponent = 2.2;
  back.knee_inner = -0.035;
  back.hem_inner = -0.02;
  back.hem_outer = 0.208;
  return Finish(body, front, back);
}

// Titan: forks of a quarter of each quarter arc, and the crotch raised or lowered until its seam has the measured
// length.
DraftedTrousers DraftTitan(const DraftedBody& body) {
  DraftedBody shifted = body;
  DraftedTrousers trousers;
  PieceDraft front, back;
  front.hip_width = 0.25 * body.hip * 1.02;
  front.extension = 0.25 * front.hip_width;
  front.waist_centre = {0.004, 0.0};
  front.side_waist = 0.26 * body.waist;
  front.knee_inner = -0.015;
  front.hem_inner = -0.01;
  front.hem_outer = 0.21;
  back.hip_width = 0.25 * body.hip * 1.08;
  back.extension = 0.25 * back.hip_width;
  back.drop = 0.002;
  back.waist_centre = {0.02, 0.025};
  back.side_waist = 0.02 + 0.27 * body.waist;
  back.exponent = 2.1;
  back.knee_inner = -0.018;
  back.hem_inner = -0.012;
  back.hem_outer = 0.212;
  for (int round = 0; round < 15; ++round) {
    front.curve_height = back.curve_height = 0.3 * shifted.rise;
    trousers = Finish(shifted, front, back);
    const double missing = body.crotch_length - trousers.front_rise - trousers.back_rise;
    if (std::abs(missing) < 0.001) break;
    shifted.rise += 0.5 * missing;
  }
  return trousers;
}

// GarmentCode: front hip/16, back leg - hip/2 + 5 cm - front.
DraftedTrousers DraftGarmentCode(const DraftedBody& body) {
  PieceDraft front, back;
  front.extension = body.hip / 16.0;
  front.waist_centre = {0.0, -0.005};
  front.side_waist = 0.25 * body.waist + 0.004;
  front.hip_width = 0.25 * body.hip + 0.008;
  front.curve_height = 0.08;
  front.exponent = 2.4;
  front.knee_inner = -0.018;
  front.hem_inner = -0.015;
  front.hem_outer = 0.205;
  back.extension = body.leg - 0.5 * body.hip + 0.05 - front.extension;
  back.drop = 0.004;
  back.waist_centre = {0.025, 0.02};
  back.side_waist = 0.025 + 0.25 * body.waist + 0.01;
  back.hip_width = 0.25 * body.hip + 0.012;
  back.curve_height = 0.085;
  back.knee_inner = -0.025;
  back.hem_inner = -0.02;
  back.hem_outer = 0.21;
  return Finish(body, front, back);
}

// The fork starts to fold in this far above the crotch.
constexpr double kFoldStart = 0.07;

struct Named {
  Eigen::Vector2d point;
  std::string name;  // Empty: only on the outline.
};

class Camera {
 public:
  Camera(double scale, double noise, unsigned seed) : scale_(scale), noise_(noise), state_(seed * 2654435761u + 1u) {}

  // `chain` runs clockwise on the screen; y up, in metres.
  GarmentView Take(GarmentSide side, const std::vector<Named>& chain, const std::vector<std::string>& order) {
    GarmentView view;
    view.side = side;
    view.metre_per_pixel = 1.0 / scale_;
    view.image_width = static_cast<int>(1.2 * scale_);
    view.image_height = static_cast<int>(1.4 * scale_);
    for (const Named& named : chain) {
      const Eigen::Vector2d seen(named.point.x() + 0.6, 0.15 - named.point.y());
      const Eigen::Vector2d pixel = scale_ * seen + Eigen::Vector2d(Noise(), Noise());
      view.outline.push_back(pixel);
      if (!named.name.empty()) view.points.push_back({named.name, pixel, 1.0});
    }
    const auto place = [&](const OutlinePoint& p) { return std::find(order.begin(), order.end(), p.name); };
    std::sort(view.points.begin(), view.points.end(),
              [&](const OutlinePoint& a, const OutlinePoint& b) { return place(a) < place(b); });
    return view;
  }

 private:
  double Noise() {
    state_ = state_ * 1664525u + 1013904223u;
    return noise_ * (2.0 * ((state_ >> 8) / 16777216.0) - 1.0);
  }
  double scale_, noise_;
  unsigned state_;
};

// A chain from one height to another in steps of 2 mm, with a name at the nearest step.
void Follow(std::vector<Named>& chain, double from, double to, const auto& point_at,
            const std::vector<std::pair<double, std::string>>& names) {
  const int count = std::max(2, static_cast<int>(std::abs(to - from) / 0.002));
  for (int i = 0; i <= count; ++i) chain.push_back({point_at(from + (to - from) * i / count), ""});
  for (const auto& [value, name] : names) {
    const double share = (value - from) / (to - from) * count;
    chain[chain.size() - 1 - static_cast<size_t>(count) + static_cast<size_t>(std::lround(share))].name = name;
  }
}

// The left half of a folded view, from the waist's middle outwards and down to the crotch.
std::vector<Named> FoldedHalf(const DraftedTrousers& t, bool front) {
  const double crotch = -t.body.rise, hem = crotch - t.body.inseam, knee = crotch - 0.5 * t.body.inseam;
  const auto mean = [&](Chain DraftedPiece::*chain, double y) {
    return 0.5 * (At(t.front.*chain, y) + At(t.back.*chain, y));
  };
  // Above the fork half of the tube's girth; below it the leg's outer edge, laid outwards.
  const double fold = mean(&DraftedPiece::outseam, crotch) -
                      0.5 * (At(t.front.centre, crotch + kFoldStart) + At(t.back.centre, crotch + kFoldStart));
  const auto leg = [&](double y) { return mean(&DraftedPiece::outseam, y) - mean(&DraftedPiece::inseam, y); };
  // The legs are laid so far apart that 2 cm are between their knees on each side of the middle.
  const double outer_knee = fold + mean(&DraftedPiece::outseam, knee) - mean(&DraftedPiece::outseam, crotch);
  const double spread = std::max(0.05, (0.02 + leg(knee) - outer_knee) / (crotch - knee));
  const auto outer = [&](double y) {
    if (y >= crotch) {
      return Eigen::Vector2d(
          mean(&DraftedPiece::outseam, y) - mean(&DraftedPiece::centre, std::max(y, crotch + kFoldStart)), y);
    }
    return Eigen::Vector2d(
        fold + mean(&DraftedPiece::outseam, y) - mean(&DraftedPiece::outseam, crotch) + spread * (crotch - y), y);
  };
  const auto inner = [&](double y) {
    if (y <= knee) return Eigen::Vector2d(outer(y).x() - leg(y), y);
    const double t_down = (crotch - y) / (crotch - knee);
    return Eigen::Vector2d(t_down * (outer(knee).x() - leg(knee)), y);
  };
  const double middle = (front ? t.front : t.back).centre.front().y();
  std::vector<Named> chain;
  Follow(chain, 0.0, outer(0.0).x(),
         [&](double x) {
           const double s = x / outer(0.0).x();
           return Eigen::Vector2d(x, middle * (1.0 - s * s));
         },
         {{0.0, "waist_centre"}, {outer(0.0).x(), "e1"}});
  chain.pop_back();
  Follow(chain, 0.0, hem, outer,
         {{0.0, "e1"},
          {-t.body.waist_to_hip, "hip_L"},
          {crotch, "crotch_level_L"},
          {0.75 * crotch + 0.25 * hem, "thigh_outer_L"},
          {knee, "knee_outer_L"},
          {hem, "e2"}});
  chain.pop_back();
  Follow(chain, outer(hem).x(), inner(hem).x(), [&](double x) { return Eigen::Vector2d(x, hem); },
         {{outer(hem).x(), "e2"},
          {0.5 * (outer(hem).x() + inner(hem).x()), "hem_mid_L"},
          {inner(hem).x(), "hem_inner_L"}});
  chain.pop_back();
  Follow(chain, hem, crotch, inner,
         {{hem, "hem_inner_L"},
          {knee, "knee_inner_L"},
          {0.75 * crotch + 0.25 * hem, "thigh_inner_L"},
          {crotch, "crotch"}});
  return chain;
}

GarmentView FoldedView(const DraftedTrousers& trousers, GarmentSide side, Camera& camera) {
  const bool front = side == GarmentSide::kFront;
  std::vector<Named> chain = FoldedHalf(trousers, front);
  const std::vector<Named> left = chain;
  for (size_t i = left.size() - 2; i > 0; --i) {
    const std::string name = left[i].name.empty() ? "" : TwinPointName(GarmentKind::kPants, left[i].name);
    chain.push_back({{-left[i].point.x(), left[i].point.y()}, name});
  }
  if (!front) {
    for (Named& named : chain) named.point.x() = -named.point.x();
    std::reverse(chain.begin(), chain.end());
  }
  return camera.Take(side, chain, OutlinePointNames(GarmentKind::kPants));
}

// One leg over the other: at every height the mean of front and back, whose girth the fold shares out.
GarmentView SideView(const DraftedTrousers& t, Camera& camera) {
  const double tip_y = 0.5 * (t.front.centre.back().y() + t.back.centre.back().y());
  const double hem = -t.body.rise - t.body.inseam, knee = -t.body.rise - 0.5 * t.body.inseam;
  const double top = std::max(t.front.centre.front().y(), t.back.centre.front().y());
  const auto mean = [&](Chain DraftedPiece::*chain, double y) {
    return 0.5 * (At(t.front.*chain, y) + At(t.back.*chain, y));
  };
  const auto outer = [&](double y) { return Eigen::Vector2d(mean(&DraftedPiece::outseam, y), y); };
  std::vector<Named> chain;
  const Eigen::Vector2d waist_centre(mean(&DraftedPiece::centre, top), top), waist_side = outer(0.0);
  Follow(chain, 0.0, 1.0, [&](double s) { return Eigen::Vector2d(waist_centre + s * (waist_side - waist_centre)); },
         {{0.0, "waist_centre"}, {1.0, "waist_side"}});
  chain.pop_back();
  Follow(chain, 0.0, hem, outer, {{0.0, "waist_side"}, {knee, "knee_outer"}, {hem, "hem_outer"}});
  chain.pop_back();
  const double inner_hem = mean(&DraftedPiece::inseam, hem);
  Follow(chain, outer(hem).x(), inner_hem, [&](double x) { return Eigen::Vector2d(x, hem); },
         {{outer(hem).x(), "hem_outer"}, {inner_hem, "hem_inner"}});
  chain.pop_back();
  Follow(chain, hem, tip_y, [&](double y) { return Eigen::Vector2d(mean(&DraftedPiece::inseam, y), y); },
         {{hem, "hem_inner"}, {knee, "knee_inner"}});
  chain.pop_back();
  // The curve point by point: both layers' forks lie on each other, so do their waists' lines.
  const size_t count = t.front.centre.size();
  for (size_t i = count; i-- > 0;) {
    const Eigen::Vector2d p = 0.5 * (t.front.centre[i] + t.back.centre[i]);
    if (i + 1 < count && (p - chain.back().point).norm() < 0.0015) continue;
    chain.push_back({p, i + 1 == count ? "crotch" : ""});
  }
  // Up to where the higher of both ends.
  const Eigen::Vector2d last = chain.back().point;
  for (int i = 1; i < 5; ++i) chain.push_back({last + (waist_centre - last) * (i / 5.0), ""});
  return camera.Take(GarmentSide::kSideFolded, chain, SideFoldedPointNames());
}

}  // namespace

DraftedTrousers Draft(DraftRule rule, const DraftedBody& body) {
  switch (rule) {
    case DraftRule::kAldrich:
      return DraftAldrich(body);
    case DraftRule::kTitan:
      return DraftTitan(body);
    case DraftRule::kGarmentCode:
      return DraftGarmentCode(body);
  }
  return {};
}

Garment Photograph(const DraftedTrousers& trousers, double pixels_per_metre, double noise_px, unsigned seed) {
  Camera camera(pixels_per_metre, noise_px, seed);
  Garment garment;
  garment.id = "drafted-trousers";
  garment.kind = GarmentKind::kPants;
  garment.length = trousers.body.rise + trousers.body.inseam;
  garment.front = FoldedView(trousers, GarmentSide::kFront, camera);
  garment.back = FoldedView(trousers, GarmentSide::kBack, camera);
  garment.side_folded = SideView(trousers, camera);
  return garment;
}

}  // namespace fitroom::testing
