#include "fit_client/fit/panels/outline_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {
namespace {

// A knot nearer to its neighbour than this is not sampled (unit: pitch).
constexpr double kLeastSpan = 0.8;
// A short span that would become one longer edge is halved instead (unit: pitch).
constexpr double kLongestStep = 1.3;

constexpr int kStepsPerEdge = 16;  // Of the sum over edges whose length changes along the outline.

// Counts the edges along a section from its beginning, whose length may change on the way.
class EdgeCount {
 public:
  EdgeCount(const OutlineSection& section, const std::vector<double>& arcs, const MeshSize& size) {
    const int steps = 1 + static_cast<int>(std::ceil(kStepsPerEdge * arcs.back() / size.PitchOf(size.level_count())));
    step_ = arcs.back() / steps;
    for (int i = 0; i < steps; ++i) {
      sums_.push_back(sums_.back() + step_ / size.At(InterpolateChain(section.points, arcs, (i + 0.5) * step_)));
    }
  }

  double Until(double arc) const {
    const size_t i = std::min(static_cast<size_t>(std::max(0.0, arc / step_)), sums_.size() - 2);
    return sums_[i] + (arc / step_ - static_cast<double>(i)) * (sums_[i + 1] - sums_[i]);
  }
  // Returns the arc length after so many edges.
  double ArcAfter(double count) const {
    const auto above = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, count);
    const size_t i = static_cast<size_t>(above - sums_.begin()) - 1;
    return step_ * (static_cast<double>(i) + (count - sums_[i]) / (sums_[i + 1] - sums_[i]));
  }

 private:
  double step_ = 0.0;                 // (unit: metre)
  std::vector<double> sums_ = {0.0};  // Edges before each step.
};

// Where `count` equal edges between two stops end, the stops left out; edges as long as `edges` wants them, where it is
// given.
void AddBetween(double from, double to, int count, const EdgeCount* edges, std::vector<double>& samples) {
  const double first = edges != nullptr ? edges->Until(from) : 0.0;
  const double all = edges != nullptr ? edges->Until(to) - first : 0.0;
  for (int k = 1; k < count; ++k) {
    samples.push_back(edges != nullptr ? edges->ArcAfter(first + all * k / count) : from + (to - from) * k / count);
  }
}

// The arc lengths of the samples of one section, from 0 to its length.
std::vector<double> SampleArcs(const OutlineSection& section, const std::vector<double>& arcs, const MeshSize& size) {
  const double end = arcs.back();
  std::optional<EdgeCount> edges;
  if (size.level_count() > 0) edges.emplace(section, arcs, size);
  std::vector<double> stops = {0.0};
  for (const SectionKnot& knot : section.knots) {
    const double arc = arcs[static_cast<size_t>(knot.index)];
    const double pitch = size.At(section.points[static_cast<size_t>(knot.index)]);
    if (arc - stops.back() >= kLeastSpan * pitch && end - arc >= kLeastSpan * pitch) stops.push_back(arc);
  }
  stops.push_back(end);
  std::vector<double> samples = {0.0};
  for (size_t i = 1; i < stops.size(); ++i) {
    const double span = stops[i] - stops[i - 1];
    const double wanted = edges ? edges->Until(stops[i]) - edges->Until(stops[i - 1]) : span / size.pitch();
    int count = std::max(1, static_cast<int>(std::lround(wanted)));
    if (wanted / count > kLongestStep) ++count;
    // One edge between two sewn corners would be sewn up itself: an opening has at least two.
    if (section.kind == SectionKind::kOpening && stops.size() == 2) count = std::max(count, 2);
    AddBetween(stops[i - 1], stops[i], count, edges ? &*edges : nullptr, samples);
    samples.push_back(stops[i]);
  }
  return samples;
}

// `sample_arcs` holds the arc lengths of each section's samples.
OutlineSamples SampleAtArcs(const PanelPattern& panel, const std::vector<std::vector<double>>& sample_arcs) {
  OutlineSamples outline;
  for (size_t s = 0; s < panel.sections.size(); ++s) {
    const OutlineSection& section = panel.sections[s];
    const std::vector<double> arcs = CumulativeLengths(section.points);
    const std::vector<double>& samples = sample_arcs[s];
    const int first = static_cast<int>(outline.points.size());
    std::vector<int> indices;
    for (size_t i = 0; i + 1 < samples.size(); ++i) {
      indices.push_back(first + static_cast<int>(i));
      outline.points.push_back(InterpolateChain(section.points, arcs, samples[i]));
      outline.pixels.push_back(InterpolateChain(section.pixels, arcs, samples[i]));
    }
    indices.push_back(first + static_cast<int>(samples.size()) - 1);  // The next section's first.
    for (const SectionKnot& knot : section.knots) {
      const bool seen = std::any_of(outline.named.begin(), outline.named.end(),
                                    [&](const OutlineSamples::Named& named) { return named.name == knot.name; });
      if (seen) continue;
      const double arc = arcs[static_cast<size_t>(knot.index)];
      const auto nearer = [&](double a, double b) { return std::abs(a - arc) < std::abs(b - arc); };
      const auto nearest = std::min_element(samples.begin(), samples.end(), nearer) - samples.begin();
      outline.named.push_back({knot.name, indices[static_cast<size_t>(nearest)]});
    }
    outline.samples_of_section.push_back(std::move(indices));
  }
  // The last section ends where the first began.
  const int count = static_cast<int>(outline.points.size());
  for (int& sample : outline.samples_of_section.back()) sample %= count;
  for (OutlineSamples::Named& named : outline.named) named.sample %= count;
  outline.sewn.assign(outline.points.size(), false);
  for (size_t s = 0; s < panel.sections.size(); ++s) {
    if (panel.sections[s].kind != SectionKind::kSeam) continue;
    for (const int sample : outline.samples_of_section[s]) outline.sewn[static_cast<size_t>(sample)] = true;
  }
  return outline;
}

}  // namespace

OutlineSamples SampleOutline(const PanelPattern& panel, const MeshSize& size) {
  std::vector<std::vector<double>> sample_arcs;
  for (const OutlineSection& section : panel.sections) {
    sample_arcs.push_back(SampleArcs(section, CumulativeLengths(section.points), size));
  }
  return SampleAtArcs(panel, sample_arcs);
}

std::vector<double> SampleShares(const OutlineSection& section, const MeshSize& size) {
  std::vector<double> shares = SampleArcs(section, CumulativeLengths(section.points), size);
  const double length = shares.back();
  for (double& share : shares) share /= length;
  return shares;
}

OutlineSamples SampleOutlineAt(const PanelPattern& panel, const std::vector<std::vector<double>>& shares) {
  std::vector<std::vector<double>> sample_arcs = shares;
  for (size_t s = 0; s < panel.sections.size(); ++s) {
    const double length = ChainLength(panel.sections[s].points);
    for (double& arc : sample_arcs[s]) arc *= length;
  }
  return SampleAtArcs(panel, sample_arcs);
}

}  // namespace fitroom::panels
