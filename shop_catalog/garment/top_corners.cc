#include "shop_catalog/garment/top_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "shop_catalog/garment/outline.h"

namespace fitroom::shop_catalog {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kSampleCount = 320;        // About 1.3 % of a T-shirt's height apart.
constexpr int kCoarseSampleCount = 160;  // For the search over tilts.
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A value that is expected, and how far off it costs one unit. Costs grow with the square up to a cap, so that one torn
// or folded corner does not drag the others along.
struct Expected {
  double mean;
  double deviation;
  double Cost(double value, double cap = 9.0) const {
    const double d = (value - mean) / deviation;
    return std::min(cap, d * d);
  }
};

// What a corner on the image's left looks like; the right one is its mirror image. Lengths are parts of the garment's
// height, `across` from the middle line, `down` from the highest point. Tuned by hand on proportions of T-shirts from
// fitted to boxy, sleeves level to 60 degrees down; long sleeves fall outside.
struct CornerModel {
  Expected turn_deg;
  Expected across;
  Expected down;
};
constexpr CornerModel kHem = {{85, 35}, {-0.33, 0.09}, {0.98, 0.04}};
constexpr CornerModel kUnderarm = {{-80, 40}, {-0.33, 0.09}, {0.38, 0.09}};
constexpr CornerModel kSleeveBottom = {{80, 35}, {-0.47, 0.13}, {0.38, 0.13}};
constexpr CornerModel kSleeveTop = {{85, 35}, {-0.55, 0.13}, {0.24, 0.12}};
constexpr CornerModel kNeck = {{55, 18}, {-0.13, 0.09}, {0.03, 0.05}};

// What the outline does from one corner to the next, on the image's left.
struct PieceModel {
  Expected direction_deg;  // 0 right, 90 down.
  Expected length;         // Of the chord, as part of the garment's height.
  Expected winding;        // Arc length over chord; less than expected costs nothing.
};
constexpr PieceModel kSide = {{-90, 14}, {0.60, 0.12}, {1.03, 0.08}};
constexpr PieceModel kSleeveUnder = {{145, 30}, {0.17, 0.09}, {1.08, 0.25}};
constexpr PieceModel kSleeveEnd = {{-115, 28}, {0.20, 0.07}, {1.02, 0.08}};
constexpr PieceModel kShoulder = {{-27, 14}, {0.45, 0.12}, {1.03, 0.07}};
constexpr PieceModel kNeckline = {{0, 10}, {0.26, 0.06}, {1.06, 0.25}};

struct Chain {
  std::array<CornerModel, kTopCornerCount> corners;
  std::array<PieceModel, kTopCornerCount - 1> pieces;
};

CornerModel Mirrored(CornerModel model) {
  model.across.mean = -model.across.mean;
  return model;
}

// Passed the other way and mirrored, a direction changes its sign.
PieceModel Mirrored(PieceModel model) {
  model.direction_deg.mean = -model.direction_deg.mean;
  return model;
}

const Chain& TopChain() {
  static const Chain chain = {{kHem, kUnderarm, kSleeveBottom, kSleeveTop, kNeck, Mirrored(kNeck), Mirrored(kSleeveTop),
                               Mirrored(kSleeveBottom), Mirrored(kUnderarm), Mirrored(kHem)},
                              {kSide, kSleeveUnder, kSleeveEnd, kShoulder, kNeckline, Mirrored(kShoulder),
                               Mirrored(kSleeveEnd), Mirrored(kSleeveUnder), Mirrored(kSide)}};
  return chain;
}

double AngleDifferenceDeg(double a, double b) {
  double difference = std::fmod(a - b, 360.0);
  if (difference > 180.0) difference -= 360.0;
  if (difference < -180.0) difference += 360.0;
  return difference;
}

Eigen::Vector2d Centroid(const Polygon& polygon) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double twice_area = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    sum += cross * (a + b);
    twice_area += cross;
  }
  return sum / (3.0 * twice_area);
}

// The outline seen upright under one assumed tilt, starting at the bottom of the middle line.
struct UprightOutline {
  std::vector<double> across;  // Of each sample, part of the height, from the middle line.
  std::vector<double> down;    // Of each sample, part of the height, from the top.
  double height = 0.0;         // (unit: pixel)
};

UprightOutline Straighten(const Polygon& samples, const Eigen::Vector2d& centre, double tilt) {
  UprightOutline upright;
  const Eigen::Vector2d right(std::cos(tilt), std::sin(tilt));
  const Eigen::Vector2d downward(-std::sin(tilt), std::cos(tilt));
  double top = kInfinity;
  double bottom = -kInfinity;
  for (const Eigen::Vector2d& p : samples) {
    upright.across.push_back((p - centre).dot(right));
    upright.down.push_back((p - centre).dot(downward));
    top = std::min(top, upright.down.back());
    bottom = std::max(bottom, upright.down.back());
  }
  upright.height = bottom - top;
  for (double& value : upright.across) value /= upright.height;
  for (double& value : upright.down) value = (value - top) / upright.height;
  return upright;
}

// The sample on the middle line at the bottom: no corner of a top is there, so the chain may start and end at it.
size_t BottomMiddle(const UprightOutline& upright) {
  size_t best = 0;
  const auto score = [&](size_t i) { return upright.down[i] - 2.0 * std::abs(upright.across[i]); };
  for (size_t i = 1; i < upright.down.size(); ++i) {
    if (score(i) > score(best)) best = i;
  }
  return best;
}

struct ChainResult {
  double cost = kInfinity;
  std::array<int, kTopCornerCount> sample{};  // Indices into the samples.
  std::array<double, kTopCornerCount> corner_cost{};
};

double CornerCost(const CornerModel& model, double turn, double across, double down) {
  return 0.6 * model.turn_deg.Cost(turn / kDegree) + 0.5 * model.across.Cost(across) + 0.5 * model.down.Cost(down);
}

// Finds the cheapest chain of corners under one tilt, by dynamic programming over the samples in clockwise order.
ChainResult FindChain(const Polygon& samples, const std::vector<double>& turns, const Eigen::Vector2d& centre,
                      double tilt) {
  const UprightOutline upright = Straighten(samples, centre, tilt);
  const int n = static_cast<int>(samples.size());
  const auto start = static_cast<int>(BottomMiddle(upright));
  const double step = Perimeter(samples) / n / upright.height;
  const Chain& chain = TopChain();
  const auto real = [&](int i) { return static_cast<size_t>((start + i) % n); };

  std::vector<std::vector<double>> cost(kTopCornerCount, std::vector<double>(static_cast<size_t>(n), kInfinity));
  std::vector<std::vector<int>> from(kTopCornerCount, std::vector<int>(static_cast<size_t>(n), -1));
  for (int corner = 0; corner < kTopCornerCount; ++corner) {
    const CornerModel& model = chain.corners[static_cast<size_t>(corner)];
    for (int i = 1; i < n; ++i) {
      const size_t at = real(i);
      const double own = CornerCost(model, turns[at], upright.across[at], upright.down[at]);
      if (own > 11.0) continue;  // Far off in every respect.
      if (corner == 0) {
        cost[0][static_cast<size_t>(i)] = own;
        continue;
      }
      const PieceModel& piece = chain.pieces[static_cast<size_t>(corner - 1)];
      double best = kInfinity;
      int best_from = -1;
      for (int j = 1; j < i; ++j) {
        const double before = cost[static_cast<size_t>(corner - 1)][static_cast<size_t>(j)];
        if (before >= best) continue;
        const size_t last = real(j);
        const double dx = upright.across[at] - upright.across[last];
        const double dy = upright.down[at] - upright.down[last];
        const double chord = std::sqrt(dx * dx + dy * dy);
        if (chord < 0.02) continue;
        const double winding = std::max(piece.winding.mean, (i - j) * step / chord);
        double total = before + 0.4 * piece.length.Cost(chord) + 0.7 * piece.winding.Cost(winding, 16.0);
        if (total >= best) continue;
        const double direction = std::atan2(dy, dx) / kDegree;
        total += 0.6 * std::min(16.0, std::pow(AngleDifferenceDeg(direction, piece.direction_deg.mean) /
                                                   piece.direction_deg.deviation,
                                               2.0));
        if (total < best) {
          best = total;
          best_from = j;
        }
      }
      cost[static_cast<size_t>(corner)][static_cast<size_t>(i)] = best + own;
      from[static_cast<size_t>(corner)][static_cast<size_t>(i)] = best_from;
    }
  }

  ChainResult result;
  const std::vector<double>& last = cost.back();
  int index = static_cast<int>(std::min_element(last.begin(), last.end()) - last.begin());
  result.cost = last[static_cast<size_t>(index)];
  if (!std::isfinite(result.cost)) return result;
  for (int corner = kTopCornerCount - 1; corner >= 0; --corner) {
    const size_t at = real(index);
    const auto c = static_cast<size_t>(corner);
    result.sample[c] = static_cast<int>(at);
    result.corner_cost[c] = CornerCost(chain.corners[c], turns[at], upright.across[at], upright.down[at]);
    index = from[c][static_cast<size_t>(index)];
  }
  return result;
}

// Moves a corner to the sharpest turn of its kind within a small window of the finely sampled outline.
struct Snapped {
  Eigen::Vector2d pixel;
  double turn = 0.0;  // (unit: radian)
};

Snapped SnapToTurn(const SampledOutline& outline, const Eigen::Vector2d& guess, double window, double arm_length,
                   bool convex) {
  const int reach = std::max(1, static_cast<int>(std::lround(window / outline.step())));
  const int arm = std::max(2, static_cast<int>(std::lround(arm_length / outline.step())));
  const int middle = outline.IndexNear(guess);
  Snapped best{outline.at(middle), 0.0};
  double best_score = -kInfinity;
  for (int i = middle - reach; i <= middle + reach; ++i) {
    // Two lengths of arm together: the long one sees the corner, the short one where it is.
    const double turn = 0.6 * outline.TurnAt(i, arm) + 0.4 * outline.TurnAt(i, std::max(2, arm / 2));
    const double off = (i - middle) / (1.0 * reach);
    const double score = (convex ? turn : -turn) - 0.25 * off * off;
    if (score > best_score) {
      best_score = score;
      best = {outline.at(i), turn};
    }
  }
  return best;
}

std::vector<double> TurnsOf(const Polygon& samples) {
  const SampledOutline outline(samples, Perimeter(samples) / static_cast<double>(samples.size()));
  // Turns are seen over 4 to 6 % of the height, whatever the number of samples.
  const int arm = std::max(1, static_cast<int>(samples.size()) / 107);
  std::vector<double> turns;
  for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
    turns.push_back(0.5 * (outline.TurnAt(i, arm) + outline.TurnAt(i, arm + std::max(1, arm * 2 / 3))));
  }
  return turns;
}

struct Search {
  ChainResult chain;
  double tilt = 0.0;  // (unit: radian)
  Polygon samples;
};

Search SearchTilts(const Polygon& outline, int sample_count, std::span<const double> tilts_deg) {
  Search search;
  search.samples = Resample(outline, sample_count);
  const std::vector<double> turns = TurnsOf(search.samples);
  const Eigen::Vector2d centre = Centroid(search.samples);
  for (const double tilt_deg : tilts_deg) {
    const ChainResult chain = FindChain(search.samples, turns, centre, tilt_deg * kDegree);
    if (chain.cost >= search.chain.cost) continue;
    search.chain = chain;
    search.tilt = tilt_deg * kDegree;
  }
  return search;
}

constexpr std::array<double, 11> kTiltsDeg = {0.0, -8.0, 8.0, -16.0, 16.0, -24.0, 24.0, -32.0, 32.0, -40.0, 40.0};

}  // namespace

double TopShapeCost(const Polygon& outline) {
  if (outline.size() < 32) return kInfinity;
  return SearchTilts(outline, kCoarseSampleCount, kTiltsDeg).chain.cost / kTopCornerCount;
}

std::optional<TopCorners> FindTopCorners(const Polygon& outline) {
  if (outline.size() < 32) return std::nullopt;
  const Search coarse = SearchTilts(outline, kCoarseSampleCount, kTiltsDeg);
  if (!std::isfinite(coarse.chain.cost)) return std::nullopt;
  const double tilt_deg = coarse.tilt / kDegree;
  const Search search =
      SearchTilts(outline, kSampleCount, std::array<double, 3>{tilt_deg, tilt_deg - 4.0, tilt_deg + 4.0});
  const ChainResult& best = search.chain;
  if (!std::isfinite(best.cost)) return std::nullopt;
  const Polygon& samples = search.samples;
  const Eigen::Vector2d centre = Centroid(samples);

  TopCorners corners;
  corners.cost = best.cost / kTopCornerCount;
  corners.height = Straighten(samples, centre, search.tilt).height;
  const SampledOutline fine(outline, std::max(0.5, 0.002 * corners.height));
  for (size_t c = 0; c < kTopCornerCount; ++c) {
    const bool is_underarm = c == kUnderarmLeft || c == kUnderarmRight;
    const bool is_neck = c == kNeckLeft || c == kNeckRight;
    const Eigen::Vector2d guess = samples[static_cast<size_t>(best.sample[c])];
    const double h = corners.height;
    const Snapped snapped =
        SnapToTurn(fine, guess, (is_neck ? 0.03 : 0.025) * h, (is_neck ? 0.025 : 0.035) * h, !is_underarm);
    corners.pixel[c] = snapped.pixel;
    const double sharpness = std::clamp(std::abs(snapped.turn) / (is_neck ? 35 * kDegree : 60 * kDegree), 0.0, 1.0);
    const double fit = std::exp(-0.15 * best.corner_cost[c]);
    corners.confidence[c] = std::clamp(fit * (0.4 + 0.6 * sharpness), 0.0, 1.0);
  }
  const Eigen::Vector2d neck = 0.5 * (corners.pixel[kNeckLeft] + corners.pixel[kNeckRight]);
  const Eigen::Vector2d hem = 0.5 * (corners.pixel[kHemLeft] + corners.pixel[kHemRight]);
  corners.tilt = std::atan2(neck.x() - hem.x(), hem.y() - neck.y());
  corners.height = Straighten(samples, centre, corners.tilt).height;
  return corners;
}

}  // namespace fitroom::shop_catalog
