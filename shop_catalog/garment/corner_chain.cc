#include "shop_catalog/garment/corner_chain.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "common/base/check.h"
#include "shop_catalog/garment/outline.h"

namespace fitroom::shop_catalog {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kSampleCount = 320;        // About 1.3 % of a T-shirt's height apart.
constexpr int kCoarseSampleCount = 160;  // For the search over tilts.
constexpr double kInfinity = std::numeric_limits<double>::infinity();

CornerModel Mirrored(CornerModel model) {
  model.across.mean = -model.across.mean;
  return model;
}

// Passed the other way and mirrored, a direction changes its sign.
PieceModel Mirrored(PieceModel model) {
  model.direction_deg.mean = -model.direction_deg.mean;
  return model;
}

template <typename Model>
void AppendMirrored(std::vector<Model>& models, const std::vector<Model>& left, size_t skip) {
  for (size_t i = left.size(); i > skip; --i) models.push_back(Mirrored(left[i - 1]));
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

// The sample on the middle line at the bottom or the top: no corner is there, so the chain may start and end at it.
size_t EndOfMiddle(const UprightOutline& upright, bool at_top) {
  size_t best = 0;
  const auto score = [&](size_t i) {
    return (at_top ? -upright.down[i] : upright.down[i]) - 2.0 * std::abs(upright.across[i]);
  };
  for (size_t i = 1; i < upright.down.size(); ++i) {
    if (score(i) > score(best)) best = i;
  }
  return best;
}

struct ChainResult {
  double cost = kInfinity;
  std::vector<int> sample;  // Indices into the samples.
  std::vector<double> corner_cost;
};

double CornerCost(const CornerModel& model, double turn, double across, double down) {
  return 0.6 * model.turn_deg.Cost(turn / kDegree) + 0.5 * model.across.Cost(across) + 0.5 * model.down.Cost(down);
}

// The piece that joins the chain's ends, the hem of a top or the waist of a bottom, is as straight as any: legs are no
// hem.
double ClosingCost(const CornerTemplate& chain, const Polygon& samples, const ChainResult& result, double step) {
  const int n = static_cast<int>(samples.size());
  const int first = result.sample.front(), last = result.sample.back();
  const double arc = step * ((first - last + n) % n);
  const double chord = (samples[static_cast<size_t>(first)] - samples[static_cast<size_t>(last)]).norm();
  const double winding = std::max(chain.closing_winding.mean, arc / std::max(chord, step));
  return 0.7 * chain.closing_winding.Cost(winding, 30.0);
}

// Finds the cheapest chain of corners under one tilt, by dynamic programming over the samples in clockwise order.
ChainResult FindChain(const CornerTemplate& chain, const Polygon& samples, const std::vector<double>& turns,
                      const Eigen::Vector2d& centre, double tilt) {
  const UprightOutline upright = Straighten(samples, centre, tilt);
  const int n = static_cast<int>(samples.size());
  const auto start = static_cast<int>(EndOfMiddle(upright, chain.starts_at_top));
  const double step = Perimeter(samples) / n / upright.height;
  const int corner_count = static_cast<int>(chain.corners.size());
  const auto real = [&](int i) { return static_cast<size_t>((start + i) % n); };

  std::vector<std::vector<double>> cost(chain.corners.size(), std::vector<double>(static_cast<size_t>(n), kInfinity));
  std::vector<std::vector<int>> from(chain.corners.size(), std::vector<int>(static_cast<size_t>(n), -1));
  for (int corner = 0; corner < corner_count; ++corner) {
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
  result.sample.resize(chain.corners.size());
  result.corner_cost.resize(chain.corners.size());
  for (int corner = corner_count - 1; corner >= 0; --corner) {
    const size_t at = real(index);
    const auto c = static_cast<size_t>(corner);
    result.sample[c] = static_cast<int>(at);
    result.corner_cost[c] = CornerCost(chain.corners[c], turns[at], upright.across[at], upright.down[at]);
    index = from[c][static_cast<size_t>(index)];
  }
  result.cost += ClosingCost(chain, samples, result, step * upright.height);
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

Search SearchTilts(const CornerTemplate& chain, const Polygon& outline, int sample_count,
                   std::span<const double> tilts_deg) {
  Search search;
  search.samples = Resample(outline, sample_count);
  const std::vector<double> turns = TurnsOf(search.samples);
  const Eigen::Vector2d centre = Centroid(search.samples);
  for (const double tilt_deg : tilts_deg) {
    const ChainResult found = FindChain(chain, search.samples, turns, centre, tilt_deg * kDegree);
    if (found.cost >= search.chain.cost) continue;
    search.chain = found;
    search.tilt = tilt_deg * kDegree;
  }
  return search;
}

constexpr std::array<double, 11> kTiltsDeg = {0.0, -8.0, 8.0, -16.0, 16.0, -24.0, 24.0, -32.0, 32.0, -40.0, 40.0};

}  // namespace

CornerTemplate FromBottom(std::string name, const std::vector<CornerModel>& left, const std::vector<PieceModel>& pieces,
                          const PieceModel& across_middle) {
  FR_CHECK(pieces.size() + 1 == left.size());
  CornerTemplate made{std::move(name), left, pieces, /*starts_at_top=*/false, {1.06, 0.10}};
  AppendMirrored(made.corners, left, 0);
  made.pieces.push_back(across_middle);
  AppendMirrored(made.pieces, pieces, 0);
  return made;
}

CornerTemplate FromTop(std::string name, const std::vector<CornerModel>& left, const std::vector<PieceModel>& pieces) {
  FR_CHECK(pieces.size() + 1 == left.size());
  CornerTemplate made{std::move(name), {}, {}, /*starts_at_top=*/true, {1.06, 0.10}};
  AppendMirrored(made.corners, left, 1);
  made.corners.insert(made.corners.end(), left.begin(), left.end());
  AppendMirrored(made.pieces, pieces, 0);
  made.pieces.insert(made.pieces.end(), pieces.begin(), pieces.end());
  return made;
}

CornerTemplate FromTop(std::string name, const std::vector<CornerModel>& left, const std::vector<PieceModel>& pieces,
                       const PieceModel& across_middle) {
  FR_CHECK(pieces.size() + 1 == left.size());
  CornerTemplate made{std::move(name), {}, {}, /*starts_at_top=*/true, {1.06, 0.10}};
  AppendMirrored(made.corners, left, 0);
  made.corners.insert(made.corners.end(), left.begin(), left.end());
  AppendMirrored(made.pieces, pieces, 0);
  made.pieces.push_back(across_middle);
  made.pieces.insert(made.pieces.end(), pieces.begin(), pieces.end());
  return made;
}

double MatchCost(const Polygon& outline, const CornerTemplate& chain) {
  if (outline.size() < 32) return kInfinity;
  return SearchTilts(chain, outline, kCoarseSampleCount, kTiltsDeg).chain.cost /
         static_cast<double>(chain.corners.size());
}

double HeightAlong(const Polygon& outline, double tilt) { return Straighten(outline, Centroid(outline), tilt).height; }

std::optional<CornerMatch> MatchCorners(const Polygon& outline, const CornerTemplate& chain) {
  if (outline.size() < 32) return std::nullopt;
  const Search coarse = SearchTilts(chain, outline, kCoarseSampleCount, kTiltsDeg);
  if (!std::isfinite(coarse.chain.cost)) return std::nullopt;
  const double tilt_deg = coarse.tilt / kDegree;
  const Search search =
      SearchTilts(chain, outline, kSampleCount, std::array<double, 3>{tilt_deg, tilt_deg - 4.0, tilt_deg + 4.0});
  const ChainResult& best = search.chain;
  if (!std::isfinite(best.cost)) return std::nullopt;
  CornerMatch match;
  match.cost = best.cost / static_cast<double>(chain.corners.size());
  match.tilt = search.tilt;
  match.height = HeightAlong(search.samples, search.tilt);
  const SampledOutline fine(outline, std::max(0.5, 0.002 * match.height));
  for (size_t c = 0; c < chain.corners.size(); ++c) {
    const CornerModel& model = chain.corners[c];
    const Snapped snapped =
        SnapToTurn(fine, search.samples[static_cast<size_t>(best.sample[c])], model.snap_window * match.height,
                   model.snap_arm * match.height, model.turn_deg.mean > 0.0);
    match.pixel.push_back(snapped.pixel);
    const double sharpness = std::clamp(std::abs(snapped.turn) / (model.sharp_deg * kDegree), 0.0, 1.0);
    match.confidence.push_back(std::clamp(std::exp(-0.15 * best.corner_cost[c]) * (0.4 + 0.6 * sharpness), 0.0, 1.0));
  }
  return match;
}

}  // namespace fitroom::shop_catalog
