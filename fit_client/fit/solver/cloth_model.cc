#include "fit_client/fit/solver/cloth_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include <Eigen/Geometry>

namespace fitroom {
namespace {

constexpr int kParticlesPerChunk =
    1500;                              // Small enough for the first-level cache to help, large enough to hide hand-out.
constexpr int kParticlesPerLeaf = 32;  // Bisection for locality stops here.

int FindRoot(std::vector<int>& parent, int index) {
  while (parent[static_cast<size_t>(index)] != index) {
    parent[static_cast<size_t>(index)] = parent[static_cast<size_t>(parent[static_cast<size_t>(index)])];
    index = parent[static_cast<size_t>(index)];
  }
  return index;
}

// One edge of the merged mesh with what its one or more triangles say about it.
struct EdgeUse {
  int low = 0;
  int high = 0;
  int opposite = 0;  // The triangle's third particle.
  int triangle = 0;
  int low_vertex = 0;  // Of the mesh: differs between the two sides of a seam.
  int high_vertex = 0;
  double rest_length = 0.0;
};

}  // namespace

// Builds one ClothModel, step by step.
class ClothModelBuilder {
 public:
  ClothModelBuilder(const ClothMesh& mesh, const ClothMaterial& material, std::span<const SeamPair> welds)
      : mesh_(mesh), material_(material), welds_(welds) {}

  Result<ClothModel> Build() {
    FR_RETURN_IF_ERROR(CheckInput());
    NumberParticles();
    FR_RETURN_IF_ERROR(ComputeMasses());
    CollectEdgeUses();
    MakeConstraints();
    return std::move(model_);
  }

 private:
  using Spring = std::tuple<int, int, float, float>;  // Ends, rest length, compliance.

  Status CheckInput() const;
  void NumberParticles();
  void Bisect(std::vector<int>& order, size_t begin, size_t end, int depth,
              const std::vector<Eigen::Vector3d>& centres);
  Status ComputeMasses();
  void CollectEdgeUses();
  void MakeConstraints();
  void AddBend(const EdgeUse& first, const EdgeUse& second);
  // Returns the chunk that holds all given particles, or the border.
  template <size_t kCount>
  ClothChunk& ChunkOf(const std::array<int, kCount>& particles);
  template <typename Constraint, typename ParticlesOf>
  std::vector<std::vector<Constraint>> ByColour(const std::vector<Constraint>& constraints,
                                                const ParticlesOf& particles_of) const;
  void MakeBatches(const std::vector<Spring>& springs, int idle, ClothChunk& chunk) const;
  void ColourBends(ClothChunk& chunk) const;

  double RestArea(int triangle) const {
    const Eigen::Vector3i& corners = mesh_.triangles[static_cast<size_t>(triangle)];
    const Eigen::Vector3d& a = Rest(corners[0]);
    return 0.5 * (Rest(corners[1]) - a).cross(Rest(corners[2]) - a).norm();
  }
  const Eigen::Vector3d& Rest(int vertex) const { return mesh_.rest_positions[static_cast<size_t>(vertex)]; }

  const ClothMesh& mesh_;
  const ClothMaterial& material_;
  std::span<const SeamPair> welds_;
  ClothModel model_;
  std::vector<int> chunk_of_particle_;
  std::vector<size_t> chunk_begins_;  // First particle of each chunk.
  std::vector<EdgeUse> edge_uses_;    // Sorted by edge.
};

Status ClothModelBuilder::CheckInput() const {
  const int vertex_count = static_cast<int>(mesh_.rest_positions.size());
  if (vertex_count == 0 || mesh_.triangles.empty()) return InvalidArgument("CLOTH_EMPTY", "the cloth has no triangles");
  for (int vertex = 0; vertex < vertex_count; ++vertex) {
    if (!Rest(vertex).allFinite()) {
      return InvalidArgument("CLOTH_NOT_FINITE",
                             "the rest position of cloth vertex " + std::to_string(vertex) + " is not finite");
    }
  }
  for (const Eigen::Vector3i& triangle : mesh_.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= vertex_count) {
      return InvalidArgument("CLOTH_INDEX_OUT_OF_RANGE", "a triangle of the cloth names a vertex that does not exist");
    }
  }
  for (const SeamPair& pair : welds_) {
    if (std::min(pair.a, pair.b) < 0 || std::max(pair.a, pair.b) >= vertex_count) {
      return InvalidArgument("SEAM_INDEX_OUT_OF_RANGE", "a seam pair names a vertex that does not exist");
    }
  }
  if (!(material_.areal_density > 0.0) || !(material_.stretch_stiffness > 0.0) || material_.bending_stiffness < 0.0) {
    return InvalidArgument("MATERIAL_OUT_OF_RANGE", "density and stretch stiffness must be positive");
  }
  return Status();
}

void ClothModelBuilder::NumberParticles() {
  const size_t vertex_count = mesh_.rest_positions.size();
  std::vector<int> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0);
  for (const SeamPair& pair : welds_) {
    const int a = FindRoot(parent, pair.a);
    const int b = FindRoot(parent, pair.b);
    parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::vector<int> roots;
  std::vector<int> group_of_root(vertex_count, -1);
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (FindRoot(parent, static_cast<int>(vertex)) != static_cast<int>(vertex)) continue;
    group_of_root[vertex] = static_cast<int>(roots.size());
    roots.push_back(static_cast<int>(vertex));
  }
  std::vector<Eigen::Vector3d> centres;
  for (const int root : roots) centres.push_back(Rest(root));
  std::vector<int> order(roots.size());
  std::iota(order.begin(), order.end(), 0);
  int depth = 0;
  while ((roots.size() >> depth) > static_cast<size_t>(kParticlesPerChunk)) ++depth;
  Bisect(order, 0, order.size(), depth, centres);

  std::vector<int> particle_of_group(roots.size());
  for (size_t particle = 0; particle < order.size(); ++particle) {
    particle_of_group[static_cast<size_t>(order[particle])] = static_cast<int>(particle);
  }
  model_.particle_of_vertex_.resize(vertex_count);
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) {
    const int root = FindRoot(parent, static_cast<int>(vertex));
    model_.particle_of_vertex_[vertex] =
        particle_of_group[static_cast<size_t>(group_of_root[static_cast<size_t>(root)])];
  }
  model_.masses_.assign(roots.size(), 0.0);
  model_.chunks_.resize(chunk_begins_.size());
  chunk_of_particle_.resize(roots.size());
  for (size_t chunk = 0; chunk < chunk_begins_.size(); ++chunk) {
    const size_t end = chunk + 1 < chunk_begins_.size() ? chunk_begins_[chunk + 1] : roots.size();
    model_.chunks_[chunk].first_particle = static_cast<int>(chunk_begins_[chunk]);
    model_.chunks_[chunk].particle_count = static_cast<int>(end - chunk_begins_[chunk]);
    for (size_t particle = chunk_begins_[chunk]; particle < end; ++particle) {
      chunk_of_particle_[particle] = static_cast<int>(chunk);
    }
  }
}

// Halves a range of particles along its longest side; `depth` more halvings end in chunks.
void ClothModelBuilder::Bisect(std::vector<int>& order, size_t begin, size_t end, int depth,
                               const std::vector<Eigen::Vector3d>& centres) {
  if (depth == 0) chunk_begins_.push_back(begin);
  if (depth <= 0 && end - begin <= static_cast<size_t>(kParticlesPerLeaf)) return;
  Eigen::AlignedBox3d box;
  for (size_t index = begin; index < end; ++index) box.extend(centres[static_cast<size_t>(order[index])]);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const size_t middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + static_cast<std::ptrdiff_t>(begin),
                   order.begin() + static_cast<std::ptrdiff_t>(middle),
                   order.begin() + static_cast<std::ptrdiff_t>(end), [&](int p, int q) {
                     const double at_p = centres[static_cast<size_t>(p)][axis];
                     const double at_q = centres[static_cast<size_t>(q)][axis];
                     return at_p != at_q ? at_p < at_q : p < q;
                   });
  Bisect(order, begin, middle, depth - 1, centres);
  Bisect(order, middle, end, depth - 1, centres);
}

Status ClothModelBuilder::ComputeMasses() {
  for (size_t index = 0; index < mesh_.triangles.size(); ++index) {
    const double third = material_.areal_density * RestArea(static_cast<int>(index)) / 3.0;
    std::array<int, 3> corners = {};
    for (size_t corner = 0; corner < 3; ++corner) {
      const int vertex = mesh_.triangles[index][static_cast<Eigen::Index>(corner)];
      corners[corner] = model_.particle_of_vertex_[static_cast<size_t>(vertex)];
      model_.masses_[static_cast<size_t>(corners[corner])] += third;
    }
    model_.triangles_.push_back(corners);
  }
  for (size_t vertex = 0; vertex < model_.particle_of_vertex_.size(); ++vertex) {
    if (!(model_.masses_[static_cast<size_t>(model_.particle_of_vertex_[vertex])] > 0.0)) {
      return InvalidArgument("CLOTH_PARTICLE_WITHOUT_AREA",
                             "cloth vertex " + std::to_string(vertex) + " belongs to no triangle with an area");
    }
  }
  return Status();
}

void ClothModelBuilder::CollectEdgeUses() {
  for (size_t index = 0; index < mesh_.triangles.size(); ++index) {
    for (int corner = 0; corner < 3; ++corner) {
      const int from = mesh_.triangles[index][corner];
      const int to = mesh_.triangles[index][(corner + 1) % 3];
      const int p = model_.triangles_[index][static_cast<size_t>(corner)];
      const int q = model_.triangles_[index][static_cast<size_t>((corner + 1) % 3)];
      const int opposite = model_.triangles_[index][static_cast<size_t>((corner + 2) % 3)];
      if (p == q) continue;  // Both ends sewn onto each other.
      const bool rising = p < q;
      edge_uses_.push_back({std::min(p, q), std::max(p, q), opposite, static_cast<int>(index), rising ? from : to,
                            rising ? to : from, (Rest(from) - Rest(to)).norm()});
    }
  }
  std::sort(edge_uses_.begin(), edge_uses_.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
}

template <size_t kCount>
ClothChunk& ClothModelBuilder::ChunkOf(const std::array<int, kCount>& particles) {
  const int chunk = chunk_of_particle_[static_cast<size_t>(particles[0])];
  for (const int particle : particles) {
    if (chunk_of_particle_[static_cast<size_t>(particle)] != chunk) return model_.border_;
  }
  return model_.chunks_[static_cast<size_t>(chunk)];
}

void ClothModelBuilder::MakeConstraints() {
  std::vector<std::vector<Spring>> springs(model_.chunks_.size() + 1);
  for (size_t begin = 0; begin < edge_uses_.size();) {
    size_t end = begin;
    double area = 0.0;
    double length = 0.0;
    while (end < edge_uses_.size() && edge_uses_[end].low == edge_uses_[begin].low &&
           edge_uses_[end].high == edge_uses_[begin].high) {
      area += RestArea(edge_uses_[end].triangle);
      length += edge_uses_[end].rest_length;
      ++end;
    }
    length /= static_cast<double>(end - begin);
    const std::array<int, 2> edge = {edge_uses_[begin].low, edge_uses_[begin].high};
    model_.edges_.push_back(edge);
    if (length > 0.0 && area > 0.0) {
      const double compliance = length * length / (material_.stretch_stiffness * area);
      const ClothChunk& chunk = ChunkOf(edge);
      const size_t target =
          &chunk == &model_.border_ ? model_.chunks_.size() : static_cast<size_t>(&chunk - model_.chunks_.data());
      springs[target].emplace_back(edge[0], edge[1], static_cast<float>(length), static_cast<float>(compliance));
    }
    // A seam is sewn from two panels that each lie flat for themselves: no bending resistance across it.
    if (end - begin == 2) AddBend(edge_uses_[begin], edge_uses_[begin + 1]);
    begin = end;
  }
  ColourBends(model_.border_);
  for (size_t chunk = 0; chunk < model_.chunks_.size(); ++chunk) {
    ColourBends(model_.chunks_[chunk]);
    MakeBatches(springs[chunk], model_.particle_count() + static_cast<int>(chunk), model_.chunks_[chunk]);
  }
  MakeBatches(springs.back(), model_.particle_count() + static_cast<int>(model_.chunks_.size()), model_.border_);
}

void ClothModelBuilder::AddBend(const EdgeUse& first, const EdgeUse& second) {
  const bool is_seam = first.low_vertex != second.low_vertex || first.high_vertex != second.high_vertex;
  if (is_seam || !(material_.bending_stiffness > 0.0)) return;
  const std::array<int, 4> particles = {first.low, first.high, first.opposite, second.opposite};
  const auto rest_opposite = [&](const EdgeUse& use) {
    for (const int vertex : mesh_.triangles[static_cast<size_t>(use.triangle)]) {
      if (model_.particle_of_vertex_[static_cast<size_t>(vertex)] == use.opposite) return Rest(vertex);
    }
    return Rest(use.low_vertex);
  };
  const Eigen::Vector3d x0 = Rest(first.low_vertex);
  const Eigen::Vector3d x1 = Rest(first.high_vertex);
  const auto cotangent = [](const Eigen::Vector3d& at, const Eigen::Vector3d& to_a, const Eigen::Vector3d& to_b) {
    const Eigen::Vector3d u = to_a - at;
    const Eigen::Vector3d v = to_b - at;
    return u.dot(v) / std::max(u.cross(v).norm(), 1e-12);
  };
  const Eigen::Vector3d x2 = rest_opposite(first);
  const Eigen::Vector3d x3 = rest_opposite(second);
  const double c01 = cotangent(x0, x1, x2);
  const double c02 = cotangent(x0, x1, x3);
  const double c03 = cotangent(x1, x0, x2);
  const double c04 = cotangent(x1, x0, x3);
  const std::array<double, 4> k = {c03 + c04, c01 + c02, -(c01 + c03), -(c02 + c04)};
  const double area = RestArea(first.triangle) + RestArea(second.triangle);
  if (!(area > 0.0)) return;
  BendConstraint bend;
  bend.particles = particles;
  double weight = 0.0;
  for (size_t index = 0; index < 4; ++index) {
    bend.coefficients[index] = static_cast<float>(k[index]);
    weight += k[index] * k[index] / model_.masses_[static_cast<size_t>(particles[index])];
  }
  bend.weight = static_cast<float>(weight);
  bend.compliance = static_cast<float>(area / (3.0 * material_.bending_stiffness));
  ChunkOf(particles).bend.push_back(bend);
}

// Colours constraints greedily so that no two of one colour share a particle, and returns their order by colour.
// Neighbours in this order do not wait for each other's results, and four springs fit a batch.
template <typename Constraint, typename ParticlesOf>
std::vector<std::vector<Constraint>> ClothModelBuilder::ByColour(const std::vector<Constraint>& constraints,
                                                                 const ParticlesOf& particles_of) const {
  std::vector<uint64_t> used(static_cast<size_t>(model_.particle_count()), 0);  // One bit a colour.
  std::vector<std::vector<Constraint>> colours;
  for (const Constraint& constraint : constraints) {
    uint64_t taken = 0;
    for (const int particle : particles_of(constraint)) taken |= used[static_cast<size_t>(particle)];
    // Vertices with dozens of neighbours exhaust the colours; what is left goes one by one, a colour each.
    const size_t colour = taken == ~uint64_t{0} ? colours.size() : static_cast<size_t>(std::countr_one(taken));
    if (colour >= colours.size()) colours.resize(colour + 1);
    colours[colour].push_back(constraint);
    if (colour >= 64) continue;
    for (const int particle : particles_of(constraint)) used[static_cast<size_t>(particle)] |= uint64_t{1} << colour;
  }
  return colours;
}

void ClothModelBuilder::MakeBatches(const std::vector<Spring>& springs, int idle, ClothChunk& chunk) const {
  std::vector<StretchBatch>& batches = chunk.stretch;
  const auto ends = [](const Spring& spring) { return std::array<int, 2>{std::get<0>(spring), std::get<1>(spring)}; };
  for (const std::vector<Spring>& colour : ByColour(springs, ends)) {
    for (size_t index = 0; index < colour.size(); ++index) {
      const size_t lane = index % 4;
      if (lane == 0) {
        batches.emplace_back();
        batches.back().a.fill(idle);
        batches.back().b.fill(idle);
      }
      std::tie(batches.back().a[lane], batches.back().b[lane], batches.back().rest_length[lane],
               batches.back().compliance[lane]) = colour[index];
    }
    chunk.stretch_colour_ends.push_back(static_cast<int>(batches.size()));
  }
}

void ClothModelBuilder::ColourBends(ClothChunk& chunk) const {
  const auto colours = ByColour(chunk.bend, [](const BendConstraint& bend) { return bend.particles; });
  chunk.bend.clear();
  for (const std::vector<BendConstraint>& colour : colours) {
    chunk.bend.insert(chunk.bend.end(), colour.begin(), colour.end());
    chunk.bend_colour_ends.push_back(static_cast<int>(chunk.bend.size()));
  }
}

Result<ClothModel> ClothModel::Create(const ClothMesh& mesh, const ClothMaterial& material,
                                      std::span<const SeamPair> welds) {
  return ClothModelBuilder(mesh, material, welds).Build();
}

}  // namespace fitroom
