#include "fit_client/fit/solver/drape_opening.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fitroom {
namespace {

constexpr double kSmoothing = 0.03;     // Hoops so near along the seam are one (unit: metre).
constexpr double kLeastLack = 0.01;     // Girths agree no better; less than this closes (unit: metre).
constexpr double kOpenLack = 0.002;     // An open seam goes on until less than this is missing (unit: metre).
constexpr double kLeastLength = 0.03;   // A shorter stretch of seam is a crease (unit: metre).
constexpr double kLargestTie = 0.8;     // (unit: metre)
constexpr double kShortestTie = 0.003;  // (unit: metre)
constexpr double kAdjustment = 0.5;     // Part of a hoop's error that a look takes away.
constexpr double kLargestWay = 0.01;    // Of a tie's length in one look (unit: metre).
constexpr double kLeftToOpen = 0.003;   // A gap that lacks less of its tie has opened (unit: metre).
constexpr double kOpenToSee = 0.002;    // A gap from this on counts as open (unit: metre).

double Gap(const DrapeRun& run, int pair) {
  const SeamPair& seam = run.mesh.seams[static_cast<size_t>(pair)];
  return (run.positions[static_cast<size_t>(seam.a)] - run.positions[static_cast<size_t>(seam.b)]).norm();
}

// A gap along the body: the arc over the chord between its two sides, by the angle between the body's normals there.
double GapOnBody(const DrapeRun& run, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double chord = (b - a).norm();
  if (chord < kOpenToSee) return chord;
  const Eigen::Vector3d at_a = run.body.Query(a).gradient;
  const Eigen::Vector3d at_b = run.body.Query(b).gradient;
  const double lengths = at_a.norm() * at_b.norm();
  if (lengths < 1e-6) return chord;
  const double half = 0.5 * std::acos(std::clamp(at_a.dot(at_b) / lengths, -0.5, 1.0));
  return half > 1e-3 ? chord * half / std::sin(half) : chord;
}

// Spreads numbers of hoops to the pairs of their seams: the mean over the hoops of its kind near a pair. Pairs that no
// hoop is near get `none`.
std::vector<double> SpreadToPairs(const DrapeRun& run, std::span<const double> of_hoops, double none) {
  std::vector<double> of_pairs(run.mesh.seams.size(), none);
  for (const GarmentHoop& hoop : run.hoops) {
    for (const int pair : hoop.pairs) {
      const SeamPair& seam = run.mesh.seams[static_cast<size_t>(pair)];
      double sum = 0.0;
      double weight = 0.0;
      for (size_t other = 0; other < run.hoops.size(); ++other) {
        const GarmentHoop& near = run.hoops[other];
        const double distance =
            std::min((near.rest_start - run.mesh.rest_positions[static_cast<size_t>(seam.a)]).norm(),
                     (near.rest_start - run.mesh.rest_positions[static_cast<size_t>(seam.b)]).norm());
        if (near.is_sleeve != hoop.is_sleeve || distance > kSmoothing) continue;
        sum += near.seam_length * of_hoops[other];
        weight += near.seam_length;
      }
      if (weight > 0.0) of_pairs[static_cast<size_t>(pair)] = sum / weight;
    }
  }
  return of_pairs;
}

// The gap between one part of a hoop and the next; after the last comes the first.
double GapAfter(const DrapeRun& run, const GarmentHoop& hoop, size_t part) {
  return GapOnBody(run, hoop.parts[part].back().In(run.positions),
                   hoop.parts[(part + 1) % hoop.parts.size()].front().In(run.positions));
}

std::vector<double> LackOfHoops(const DrapeRun& run) {
  std::vector<double> lack;
  for (const GarmentHoop& hoop : run.hoops) {
    double round = hoop.ClothLength(run.positions);
    for (size_t part = 0; part < hoop.parts.size(); ++part) round += GapAfter(run, hoop, part);
    lack.push_back(round - hoop.rest_length * (1.0 + run.options.limit_strain));
  }
  return lack;
}

// A stretch of seam: hoops next to each other.
using Stretch = std::vector<const GarmentHoop*>;

// Returns the stretches of seam whose hoops' both pairs fulfil `is_open`.
template <typename IsOpen>
std::vector<Stretch> FindStretches(const DrapeRun& run, const IsOpen& is_open) {
  std::vector<std::vector<const GarmentHoop*>> hoops_of_pair(run.mesh.seams.size());
  for (const GarmentHoop& hoop : run.hoops) {
    if (!is_open(hoop.pairs[0]) || !is_open(hoop.pairs[1])) continue;
    for (const int pair : hoop.pairs) hoops_of_pair[static_cast<size_t>(pair)].push_back(&hoop);
  }
  std::vector<bool> is_taken(run.hoops.size(), false);
  const auto take = [&](const GarmentHoop* hoop) {
    const size_t index = static_cast<size_t>(hoop - run.hoops.data());
    const bool is_new = !is_taken[index];
    is_taken[index] = true;
    return is_new;
  };
  std::vector<Stretch> stretches;
  for (const auto& first : hoops_of_pair) {
    for (const GarmentHoop* hoop : first) {
      if (!take(hoop)) continue;
      Stretch stretch = {hoop};
      for (size_t next = 0; next < stretch.size(); ++next) {
        for (const int pair : stretch[next]->pairs) {
          for (const GarmentHoop* neighbour : hoops_of_pair[static_cast<size_t>(pair)]) {
            if (take(neighbour)) stretch.push_back(neighbour);
          }
        }
      }
      stretches.push_back(std::move(stretch));
    }
  }
  return stretches;
}

double LengthOf(const Stretch& stretch) {
  double length = 0.0;
  for (const GarmentHoop* hoop : stretch) length += hoop->seam_length;
  return length;
}

}  // namespace

std::vector<double> FindOpenings(const DrapeRun& run) {
  std::vector<double> ties = run.tie_lengths;
  ties.resize(run.mesh.seams.size(), 0.0);
  const std::vector<double> lack = SpreadToPairs(run, LackOfHoops(run), 0.0);
  const auto lack_at = [&](int pair) { return lack[static_cast<size_t>(pair)]; };
  for (const Stretch& stretch : FindStretches(run, [&](int pair) { return lack_at(pair) > kOpenLack; })) {
    double largest = 0.0;
    for (const GarmentHoop* hoop : stretch)
      largest = std::max({largest, lack_at(hoop->pairs[0]), lack_at(hoop->pairs[1])});
    if (largest < kLeastLack || LengthOf(stretch) < kLeastLength) continue;
    for (const GarmentHoop* hoop : stretch) {
      for (const int pair : hoop->pairs) {
        double& tie = ties[static_cast<size_t>(pair)];
        if (tie <= 0.0) tie = std::clamp(std::max(lack_at(pair), Gap(run, pair)), kShortestTie, kLargestTie);
      }
    }
  }
  return ties;
}

double LargestLack(const DrapeRun& run) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const std::vector<double> lack = SpreadToPairs(run, LackOfHoops(run), kNone);
  return lack.empty() ? kNone : *std::max_element(lack.begin(), lack.end());
}

double AdjustTies(DrapeRun& run, bool may_shorten) {
  std::vector<double> errors;
  for (const GarmentHoop& hoop : run.hoops) {
    errors.push_back(hoop.ClothLength(run.positions) - hoop.rest_length * (1.0 + run.options.limit_strain));
  }
  const std::vector<double> of_pairs = SpreadToPairs(run, errors, 0.0);
  double largest = 0.0;
  for (size_t pair = 0; pair < run.tie_lengths.size(); ++pair) {
    double& tie = run.tie_lengths[pair];
    if (tie <= 0.0) continue;
    const double error = may_shorten ? of_pairs[pair] : std::max(0.0, of_pairs[pair]);
    if (error > 0.0 || tie > kShortestTie) largest = std::max(largest, std::abs(error));
    // Ties are rigid: they are shortened from where the seam is, and not lengthened far beyond it.
    const double gap = Gap(run, static_cast<int>(pair));
    const double way = std::clamp(kAdjustment * error, -kLargestWay, kLargestWay);
    tie = way < 0.0 ? std::min(tie, gap) + way : std::min(tie + way, std::max(tie, gap + kLargestWay));
    tie = std::clamp(tie, kShortestTie, kLargestTie);
  }
  return largest;
}

bool HasOpened(const DrapeRun& run) {
  for (size_t pair = 0; pair < run.tie_lengths.size(); ++pair) {
    if (Gap(run, static_cast<int>(pair)) < run.tie_lengths[pair] - kLeftToOpen) return false;
  }
  return true;
}

std::vector<Attachment> WidenBelt(const DrapeRun& run) {
  std::vector<Attachment> belt = run.belt;
  const size_t count = belt.size();
  for (size_t index = 0; index < run.tie_lengths.size(); ++index) {
    const double gap = run.tie_lengths[index];
    if (gap <= 0.0 || count < 3) continue;
    const SeamPair& seam = run.mesh.seams[index];
    const auto place_of = [&](int vertex) {
      return static_cast<size_t>(
          std::find_if(belt.begin(), belt.end(), [&](const Attachment& held) { return held.particle == vertex; }) -
          belt.begin());
    };
    const size_t a = place_of(seam.a);
    const size_t b = place_of(seam.b);
    if (a == count || b == count) continue;
    // The edge as a chain from one side of the gap round the body to the other.
    const size_t first = (a + 1) % count == b ? b : a;
    if ((first == b ? (a + 1) % count : (b + 1) % count) != first) continue;
    std::vector<double> way = {0.0};
    std::vector<Eigen::Vector3d> places = {belt[first].target};
    for (size_t k = 1; k < count; ++k) {
      places.push_back(belt[(first + k) % count].target);
      way.push_back(way.back() + (places[k] - places[k - 1]).norm());
    }
    const double whole = way.back();
    if (!(gap < 0.8 * whole)) continue;
    for (size_t k = 0; k < count; ++k) {
      const double wanted = 0.5 * gap + way[k] * (whole - gap) / whole;
      const auto above = std::lower_bound(way.begin() + 1, way.end() - 1, wanted);
      const size_t to = static_cast<size_t>(above - way.begin());
      const double part = way[to] > way[to - 1] ? (wanted - way[to - 1]) / (way[to] - way[to - 1]) : 0.0;
      belt[(first + k) % count].target = places[to - 1] + part * (places[to] - places[to - 1]);
    }
  }
  return belt;
}

std::vector<SeamOpening> MeasureOpenings(const DrapeRun& run) {
  std::vector<SeamOpening> openings;
  if (run.tie_lengths.empty()) return openings;
  const std::vector<double> lack = LackOfHoops(run);
  const auto is_open = [&](int pair) {
    return run.tie_lengths[static_cast<size_t>(pair)] > 0.0 && Gap(run, pair) > kOpenToSee;
  };
  for (const Stretch& stretch : FindStretches(run, is_open)) {
    SeamOpening opening;
    opening.seam_length = LengthOf(stretch);
    opening.is_sleeve = stretch.front()->is_sleeve;
    double sum = 0.0;
    for (const GarmentHoop* hoop : stretch) {
      sum += hoop->rest_start.x();
      const double missing = lack[static_cast<size_t>(hoop - run.hoops.data())];
      if (missing <= opening.lacking_girth) continue;
      opening.lacking_girth = missing;
      const SeamPair& seam = run.mesh.seams[static_cast<size_t>(hoop->pairs[0])];
      opening.place = 0.5 * (run.positions[static_cast<size_t>(seam.a)] + run.positions[static_cast<size_t>(seam.b)]);
      opening.gap = GapAfter(run, *hoop, hoop->parts.size() - 1);
    }
    opening.is_left = sum > 0.0;
    if (opening.lacking_girth > 0.0) openings.push_back(opening);
  }
  std::stable_sort(openings.begin(), openings.end(),
                   [](const SeamOpening& a, const SeamOpening& b) { return a.lacking_girth > b.lacking_girth; });
  return openings;
}

}  // namespace fitroom
