#include "fit_client/fit/stages/bottom_outline.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "fit_client/fit/stages/panel_outline.h"

namespace fitroom {
namespace {

enum class EdgeKind { kOpen, kSide, kCentre };  // Sewn to nothing, to the other panel, to the same panel.

// A stretch of a piece's outline that is sewn in one way.
struct Run {
  EdgeKind kind = EdgeKind::kOpen;
  int panel = 0;
  std::vector<int> particles;
};

Status Broken(const std::string& what) {
  return InvalidArgument("BOTTOM_OUTLINE", what + "; check the outline points of the garment");
}

bool Contains(const std::vector<int>& chain, int particle) {
  return std::find(chain.begin(), chain.end(), particle) != chain.end();
}

// Cuts the outlines of all pieces into runs.
class RunFinder {
 public:
  explicit RunFinder(const ClothMesh& cloth) : cloth_(cloth) {
    for (const SeamPair& pair : cloth.seams) {
      partners_[pair.a].push_back(pair.b);
      partners_[pair.b].push_back(pair.a);
    }
    std::set<std::pair<int, int>> directed;
    for (const Eigen::Vector3i& triangle : cloth.triangles) {
      for (int k = 0; k < 3; ++k) directed.emplace(triangle[k], triangle[(k + 1) % 3]);
    }
    for (const auto& [from, to] : directed) {
      if (!directed.contains({to, from})) {
        next_[from] = to;
        ++boundary_count_;
      }
    }
  }

  Result<std::vector<Run>> Find() const {
    if (next_.size() != boundary_count_) return Broken("a piece's outline touches itself");
    std::vector<Run> runs;
    std::set<int> visited;
    for (const auto& [start, after] : next_) {
      if (visited.contains(start)) continue;
      std::vector<int> loop;
      for (int particle = start; visited.insert(particle).second;) {
        loop.push_back(particle);
        const auto following = next_.find(particle);
        if (following == next_.end()) return Broken("a piece's outline is not closed");
        particle = following->second;
      }
      CutLoop(loop, runs);
    }
    return runs;
  }

 private:
  EdgeKind KindOf(int from, int to) const {
    const auto a = partners_.find(from);
    const auto b = partners_.find(to);
    if (a == partners_.end() || b == partners_.end()) return EdgeKind::kOpen;
    for (const int p : a->second) {
      for (const int q : b->second) {
        const auto after_q = next_.find(q);
        const auto after_p = next_.find(p);
        const bool adjacent =
            (after_q != next_.end() && after_q->second == p) || (after_p != next_.end() && after_p->second == q);
        if (!adjacent) continue;
        const int here = cloth_.panel_of_particle[static_cast<size_t>(from)];
        return cloth_.panel_of_particle[static_cast<size_t>(p)] == here ? EdgeKind::kCentre : EdgeKind::kSide;
      }
    }
    return EdgeKind::kOpen;
  }

  void CutLoop(const std::vector<int>& loop, std::vector<Run>& runs) const {
    const size_t size = loop.size();
    std::vector<EdgeKind> kinds;
    for (size_t k = 0; k < size; ++k) kinds.push_back(KindOf(loop[k], loop[(k + 1) % size]));
    size_t begin = 0;
    while (begin < size && kinds[begin] == kinds[(begin + size - 1) % size]) ++begin;
    if (begin == size) begin = 0;
    for (size_t done = 0; done < size;) {
      Run run;
      run.kind = kinds[(begin + done) % size];
      run.panel = cloth_.panel_of_particle[static_cast<size_t>(loop[0])];
      run.particles.push_back(loop[(begin + done) % size]);
      while (done < size && kinds[(begin + done) % size] == run.kind) {
        ++done;
        run.particles.push_back(loop[(begin + done) % size]);
      }
      runs.push_back(std::move(run));
    }
  }

  const ClothMesh& cloth_;
  std::map<int, std::vector<int>> partners_;
  std::map<int, int> next_;
  size_t boundary_count_ = 0;
};

// The corners of the waist and of the outer hems on one panel.
struct Corners {
  std::array<int, 2> waist = {-1, -1};  // e1, e3
  std::array<int, 2> hem = {-1, -1};    // e2, e4
};

Result<std::array<Corners, 2>> FindCorners(const ClothMesh& cloth) {
  std::array<Corners, 2> corners;
  for (const NamedParticle& named : cloth.named_particles) {
    const size_t slash = named.name.find('/');
    if (slash == std::string::npos) continue;
    Corners& at = corners[named.name.substr(0, slash) == "front" ? 0 : 1];
    const std::string point = named.name.substr(slash + 1);
    if (point == "e1") at.waist[0] = named.particle;
    if (point == "e3") at.waist[1] = named.particle;
    if (point == "e2") at.hem[0] = named.particle;
    if (point == "e4") at.hem[1] = named.particle;
  }
  for (const Corners& at : corners) {
    for (const size_t side : {0, 1}) {
      if (at.waist[side] < 0 || at.hem[side] < 0) return Broken("the garment lacks one of the corners e1 to e4");
    }
  }
  return corners;
}

// Sorts runs into the seams of a bottom.
class BottomSorter {
 public:
  BottomSorter(const ClothMesh& cloth, const std::array<Corners, 2>& corners) : cloth_(cloth), corners_(corners) {}

  Result<BottomOutline> Sort(const std::vector<Run>& runs) {
    for (const Run& run : runs) {
      if (run.kind == EdgeKind::kSide) FR_RETURN_IF_ERROR(AddSideRun(run));
      if (run.kind == EdgeKind::kCentre) AddCentreRun(run);
    }
    for (const auto& side : outline_.outseams) {
      for (const BottomOutline::Chain& chain : side) {
        if (chain.particles.empty()) return Broken("an outseam from waist to hem is not sewn");
      }
    }
    FR_RETURN_IF_ERROR(AddWaist(runs));
    CollectCrotch();
    return std::move(outline_);
  }

 private:
  const Corners& CornersOf(const Run& run) const { return corners_[static_cast<size_t>(run.panel)]; }
  double Height(int particle) const { return cloth_.rest_positions[static_cast<size_t>(particle)].y(); }
  double Abscissa(int particle) const { return cloth_.rest_positions[static_cast<size_t>(particle)].x(); }
  std::vector<int> Downwards(std::vector<int> chain) const {
    if (Height(chain.front()) < Height(chain.back())) std::reverse(chain.begin(), chain.end());
    return chain;
  }

  Status AddSideRun(const Run& run) {
    for (const size_t side : {0, 1}) {
      if (!Contains(run.particles, CornersOf(run).waist[side])) continue;
      outline_.outseams[side][static_cast<size_t>(run.panel)] = {Downwards(run.particles), run.panel,
                                                                 static_cast<int>(side)};
      return Status();
    }
    // An inseam: of one leg, or of both with the crotch between them.
    const auto highest = std::max_element(run.particles.begin(), run.particles.end(),
                                          [this](int a, int b) { return Height(a) < Height(b); });
    const std::vector<int> before(run.particles.begin(), highest + 1);
    const std::vector<int> after(highest, run.particles.end());
    for (const std::vector<int>& part : {before, after}) {
      if (part.size() < 2) continue;
      const std::vector<int> chain = Downwards(part);
      inseam_runs_.push_back({chain, run.panel, 0});
    }
    return Status();
  }

  void AddCentreRun(const Run& run) {
    outline_.centre_seams[static_cast<size_t>(run.panel)].push_back({Downwards(run.particles), run.panel, 0});
  }

  Status AddWaist(const std::vector<Run>& runs) {
    std::array<std::vector<std::vector<int>>, 2> edges;  // [panel], each from the wearer's right to the left.
    for (const Run& run : runs) {
      if (run.kind != EdgeKind::kOpen) continue;
      const Corners& at = CornersOf(run);
      const bool left = run.particles.front() == at.waist[0] || run.particles.back() == at.waist[0];
      const bool right = run.particles.front() == at.waist[1] || run.particles.back() == at.waist[1];
      if (!left && !right) continue;
      std::vector<int> edge = run.particles;
      if (edge.front() == at.waist[0] || edge.back() == at.waist[1]) std::reverse(edge.begin(), edge.end());
      auto& list = edges[static_cast<size_t>(run.panel)];
      list.insert(right ? list.begin() : list.end(), std::move(edge));
    }
    double front_length = 0.0;
    for (const auto& edge : edges[0]) front_length += RestArcLengths(cloth_, edge).back();
    if (edges[0].empty() || edges[1].empty()) return Broken("the waist is not an open edge from e3 to e1");
    double begin = -0.5 * front_length;
    for (const auto& edge : edges[0]) begin = AddWaistEdge(edge, begin);
    for (auto edge = edges[1].rbegin(); edge != edges[1].rend(); ++edge) {  // Behind, the way leads back to the right.
      std::vector<int> reversed(edge->rbegin(), edge->rend());
      begin = AddWaistEdge(reversed, begin);
    }
    outline_.waist_girth = begin + 0.5 * front_length;
    return Status();
  }

  double AddWaistEdge(const std::vector<int>& edge, double begin) {
    const std::vector<double> lengths = RestArcLengths(cloth_, edge);
    for (size_t k = 0; k < edge.size(); ++k) outline_.waist.push_back({edge[k], begin + lengths[k]});
    return begin + lengths.back();
  }

  // Tells left inseams from right ones by the outseam that lies on the same hem.
  void CollectCrotch() {
    for (BottomOutline::Chain& chain : inseam_runs_) {
      const Corners& at = corners_[static_cast<size_t>(chain.panel)];
      const double end = Abscissa(chain.particles.back());
      const bool left = std::abs(end - Abscissa(at.hem[0])) < std::abs(end - Abscissa(at.hem[1]));
      chain.side = left ? 0 : 1;
      outline_.crotch.push_back(chain.particles.front());
      outline_.inseams[left ? 0 : 1].push_back(std::move(chain));
    }
    for (auto& panel : outline_.centre_seams) {
      for (BottomOutline::Chain& seam : panel) {
        for (const BottomOutline::Chain& inseam : outline_.inseams[1]) {
          if (inseam.particles.front() == seam.particles.back()) seam.side = 1;
        }
      }
    }
    std::sort(outline_.crotch.begin(), outline_.crotch.end());
    outline_.crotch.erase(std::unique(outline_.crotch.begin(), outline_.crotch.end()), outline_.crotch.end());
  }

  const ClothMesh& cloth_;
  const std::array<Corners, 2>& corners_;
  std::vector<BottomOutline::Chain> inseam_runs_;
  BottomOutline outline_;
};

}  // namespace

Result<BottomOutline> FindBottomOutline(const ClothMesh& cloth) {
  FR_ASSIGN_OR_RETURN(const auto corners, FindCorners(cloth));
  FR_ASSIGN_OR_RETURN(const std::vector<Run> runs, RunFinder(cloth).Find());
  return BottomSorter(cloth, corners).Sort(runs);
}

}  // namespace fitroom
