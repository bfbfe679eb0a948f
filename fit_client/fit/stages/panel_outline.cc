#include "fit_client/fit/stages/panel_outline.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace fitroom {

Result<PanelOutline> PanelOutline::Trace(const ClothMesh& cloth, int panel) {
  std::set<std::pair<int, int>> directed;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    if (cloth.panel_of_particle[static_cast<size_t>(triangle[0])] != panel) continue;
    for (int k = 0; k < 3; ++k) directed.emplace(triangle[k], triangle[(k + 1) % 3]);
  }
  std::map<int, int> next;
  size_t boundary_count = 0;
  for (const auto& [from, to] : directed) {
    if (directed.contains({to, from})) continue;
    next[from] = to;
    ++boundary_count;
  }
  const Status broken = InvalidArgument(
      "PANEL_OUTLINE", "the " + std::string(panel == 0 ? "front" : "back") + " panel's outline is not one closed loop");
  if (next.empty() || next.size() != boundary_count) return broken;
  std::vector<int> loop;
  for (int particle = next.begin()->first; loop.size() <= next.size();) {
    loop.push_back(particle);
    const auto following = next.find(particle);
    if (following == next.end()) return broken;
    particle = following->second;
    if (particle == loop.front()) break;
  }
  if (loop.size() != next.size()) return broken;
  return PanelOutline(cloth, panel, std::move(loop));
}

Result<size_t> PanelOutline::PlaceOf(std::string_view name) const {
  const std::string full = std::string(panel_ == 0 ? "front/" : "back/") + std::string(name);
  for (const NamedParticle& named : cloth_->named_particles) {
    if (named.name != full) continue;
    const auto place = std::find(loop_.begin(), loop_.end(), named.particle);
    if (place != loop_.end()) return static_cast<size_t>(place - loop_.begin());
  }
  return NotFound("POINT_MISSING", "the garment has no outline point " + full);
}

Result<std::vector<int>> PanelOutline::Section(std::string_view from, std::string_view to) const {
  FR_ASSIGN_OR_RETURN(const size_t begin, PlaceOf(from));
  FR_ASSIGN_OR_RETURN(const size_t end, PlaceOf(to));
  const size_t size = loop_.size();
  const size_t forward = (end + size - begin) % size;
  const bool goes_forward = forward <= size - forward;
  const size_t step_count = goes_forward ? forward : size - forward;
  std::vector<int> chain;
  chain.reserve(step_count + 1);
  for (size_t k = 0; k <= step_count; ++k) {
    chain.push_back(loop_[goes_forward ? (begin + k) % size : (begin + size - k) % size]);
  }
  return chain;
}

std::vector<double> RestArcLengths(const ClothMesh& cloth, const std::vector<int>& chain) {
  std::vector<double> lengths;
  lengths.reserve(chain.size());
  for (size_t i = 0; i < chain.size(); ++i) {
    const auto position = [&](size_t k) { return cloth.rest_positions[static_cast<size_t>(chain[k])]; };
    lengths.push_back(i == 0 ? 0.0 : lengths.back() + (position(i) - position(i - 1)).norm());
  }
  return lengths;
}

}  // namespace fitroom
