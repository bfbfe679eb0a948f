#include "fit_client/fit/collision/signed_distance_field_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom {
namespace {

constexpr float kNearCells = 1.25F;          // Splatting reach (unit: pitch); a cell's diagonal needs at most 1.74.
constexpr float kBandCells = 2.0F;           // Bricks are stored within this of the surface (unit: pitch).
constexpr float kTie = 1e-5F;                // Relative difference of squared distances that counts as a tie.
constexpr double kLargestCoordinate = 10.0;  // (unit: metre)
constexpr double kMargin = 0.03;             // Region beyond the body's bounds where none is asked for (unit: metre).
constexpr size_t kCoarseNodeLimit = size_t{1} << 24;
constexpr float kUnknown = std::numeric_limits<float>::infinity();

const std::array<Eigen::Vector3i, 6> kNeighbours = {Eigen::Vector3i(-1, 0, 0), Eigen::Vector3i(1, 0, 0),
                                                    Eigen::Vector3i(0, -1, 0), Eigen::Vector3i(0, 1, 0),
                                                    Eigen::Vector3i(0, 0, -1), Eigen::Vector3i(0, 0, 1)};

bool IsInside(const Eigen::Vector3i& node, const Eigen::Vector3i& count) {
  return (node.array() >= 0).all() && (node.array() < count.array()).all();
}

float AngleBetween(const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

SignedDistanceFieldBuilder::SignedDistanceFieldBuilder(const TriangleMesh& body,
                                                       const SignedDistanceFieldOptions& options, Executor& executor)
    : body_(body), options_(options), executor_(executor) {}

Result<SignedDistanceField> SignedDistanceFieldBuilder::Build() {
  FR_RETURN_IF_ERROR(CheckInput());
  FR_RETURN_IF_ERROR(LayOutRegion());
  KeepTrianglesInReach();
  if (field_.triangles_.empty()) {
    return InvalidArgument("BODY_OUT_OF_REACH", "no part of the body lies in the region that the cloth can reach");
  }
  ComputeAngleWeightedNormals();
  BinTriangles();
  const size_t slot_count = brick_of_slot_.size();
  if (slot_count == 0) {
    return InvalidArgument("BODY_OUT_OF_REACH", "no part of the body lies in the region that the cloth can reach");
  }
  field_.brick_samples_.resize(slot_count * SignedDistanceField::kBrickSampleCount);
  coarse_of_brick_.resize(slot_count * 27);
  constexpr size_t kBricksPerTask = 16;
  executor_.Run(static_cast<int>((slot_count + kBricksPerTask - 1) / kBricksPerTask), [&](int task) {
    const size_t begin = static_cast<size_t>(task) * kBricksPerTask;
    for (size_t slot = begin; slot < std::min(begin + kBricksPerTask, slot_count); ++slot) FillBrick(slot);
  });
  FillCoarseGrid();
  return std::move(field_);
}

Status SignedDistanceFieldBuilder::CheckInput() const {
  if (body_.triangles.empty()) return InvalidArgument("BODY_WITHOUT_TRIANGLES", "the body has no triangles");
  if (!(options_.pitch > 1e-4) || options_.pitch > 0.1) {
    return InvalidArgument("PITCH_OUT_OF_RANGE", "the distance field's pitch must lie in 0.1 mm ... 100 mm");
  }
  for (size_t index = 0; index < body_.vertices.size(); ++index) {
    const Eigen::Vector3d& vertex = body_.vertices[index];
    if (!vertex.allFinite() || vertex.cwiseAbs().maxCoeff() > kLargestCoordinate) {
      return InvalidArgument("BODY_COORDINATE_OUT_OF_RANGE", "body vertex " + std::to_string(index) +
                                                                 " is not finite or further than 10 m from the origin;"
                                                                 " is the unit metres?");
    }
  }
  const int vertex_count = static_cast<int>(body_.vertices.size());
  for (const Eigen::Vector3i& triangle : body_.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= vertex_count) {
      return InvalidArgument("BODY_INDEX_OUT_OF_RANGE", "a triangle of the body names a vertex that does not exist");
    }
  }
  return Status();
}

Status SignedDistanceFieldBuilder::LayOutRegion() {
  Eigen::AlignedBox3d region = ComputeBounds(body_);
  region.extend((region.min().array() - kMargin).matrix().eval());
  region.extend((region.max().array() + kMargin).matrix().eval());
  if (options_.region.has_value()) region = region.intersection(*options_.region);
  if (region.isEmpty()) {
    return InvalidArgument("BODY_OUT_OF_REACH", "no part of the body lies in the region that the cloth can reach");
  }
  field_.pitch_ = options_.pitch;
  const double brick_size = options_.pitch * SignedDistanceField::kBrickCells;
  field_.brick_count_ = (region.sizes() / brick_size).array().ceil().matrix().cast<int>().cwiseMax(1);
  field_.coarse_count_ = (field_.brick_count_ * SignedDistanceField::kCoarsePerBrick + Eigen::Vector3i::Ones()).eval();
  const Eigen::Vector3d size = field_.brick_count_.cast<double>() * brick_size;
  field_.region_ = Eigen::AlignedBox3d(region.min(), region.min() + size);
  if (field_.coarse_count_.cast<double>().prod() > static_cast<double>(kCoarseNodeLimit)) {
    return ResourceExhausted("DISTANCE_FIELD_TOO_LARGE", "the region needs too many samples at this pitch");
  }
  return Status();
}

void SignedDistanceFieldBuilder::KeepTrianglesInReach() {
  const Eigen::Vector3d origin = field_.region_.min();
  const Eigen::Vector3f low = Eigen::Vector3f::Constant(static_cast<float>(-4.0 * field_.pitch_));
  const Eigen::Vector3f high = field_.region_.sizes().cast<float>() - low;
  field_.vertices_.reserve(body_.vertices.size());
  for (const Eigen::Vector3d& vertex : body_.vertices) field_.vertices_.push_back((vertex - origin).cast<float>());
  field_.triangles_.reserve(body_.triangles.size());
  for (const Eigen::Vector3i& triangle : body_.triangles) {
    const Eigen::Vector3f& a = field_.vertices_[static_cast<size_t>(triangle[0])];
    const Eigen::Vector3f& b = field_.vertices_[static_cast<size_t>(triangle[1])];
    const Eigen::Vector3f& c = field_.vertices_[static_cast<size_t>(triangle[2])];
    const Eigen::Vector3f triangle_low = a.cwiseMin(b).cwiseMin(c);
    const Eigen::Vector3f triangle_high = a.cwiseMax(b).cwiseMax(c);
    if ((triangle_high.array() < low.array()).any() || (triangle_low.array() > high.array()).any()) continue;
    field_.triangles_.push_back(triangle);
  }
}

void SignedDistanceFieldBuilder::ComputeAngleWeightedNormals() {
  field_.vertex_normals_.assign(field_.vertices_.size(), Eigen::Vector3f::Zero());
  for (const Eigen::Vector3i& triangle : field_.triangles_) {
    const Eigen::Vector3f& a = field_.vertices_[static_cast<size_t>(triangle[0])];
    const Eigen::Vector3f& b = field_.vertices_[static_cast<size_t>(triangle[1])];
    const Eigen::Vector3f& c = field_.vertices_[static_cast<size_t>(triangle[2])];
    const Eigen::Vector3f normal = (b - a).cross(c - a).normalized();
    const float angle_a = AngleBetween(b - a, c - a);
    const float angle_b = AngleBetween(c - b, a - b);
    field_.vertex_normals_[static_cast<size_t>(triangle[0])] += normal * angle_a;
    field_.vertex_normals_[static_cast<size_t>(triangle[1])] += normal * angle_b;
    field_.vertex_normals_[static_cast<size_t>(triangle[2])] +=
        normal * std::max(0.0F, static_cast<float>(M_PI) - angle_a - angle_b);
  }
}

SignedDistanceFieldBuilder::Box SignedDistanceFieldBuilder::BricksNear(const Eigen::Vector3i& triangle) const {
  const Eigen::Vector3f& a = field_.vertices_[static_cast<size_t>(triangle[0])];
  const Eigen::Vector3f& b = field_.vertices_[static_cast<size_t>(triangle[1])];
  const Eigen::Vector3f& c = field_.vertices_[static_cast<size_t>(triangle[2])];
  const float pitch = static_cast<float>(field_.pitch_);
  const float brick_size = pitch * SignedDistanceField::kBrickCells;
  const Eigen::Array3f low = (a.cwiseMin(b).cwiseMin(c).array() - kBandCells * pitch) / brick_size;
  const Eigen::Array3f high = (a.cwiseMax(b).cwiseMax(c).array() + kBandCells * pitch) / brick_size;
  Box box;
  box.low = low.floor().cast<int>().matrix().cwiseMax(0);
  box.high = high.floor().cast<int>().matrix().cwiseMin(field_.brick_count_ - Eigen::Vector3i::Ones());
  return box;
}

void SignedDistanceFieldBuilder::BinTriangles() {
  const auto for_each_brick = [&](const Eigen::Vector3i& triangle, const auto& visit) {
    const Box box = BricksNear(triangle);
    for (int z = box.low.z(); z <= box.high.z(); ++z) {
      for (int y = box.low.y(); y <= box.high.y(); ++y) {
        for (int x = box.low.x(); x <= box.high.x(); ++x) visit(field_.BrickIndex({x, y, z}));
      }
    }
  };
  std::vector<uint32_t> count(field_.brick_count_.cast<Eigen::Index>().prod(), 0);
  for (const Eigen::Vector3i& triangle : field_.triangles_) {
    for_each_brick(triangle, [&](size_t brick) { ++count[brick]; });
  }
  field_.brick_slot_.assign(count.size(), -1);
  field_.brick_triangles_begin_.assign(1, 0);
  for (int z = 0; z < field_.brick_count_.z(); ++z) {
    for (int y = 0; y < field_.brick_count_.y(); ++y) {
      for (int x = 0; x < field_.brick_count_.x(); ++x) {
        const size_t brick = field_.BrickIndex({x, y, z});
        if (count[brick] == 0) continue;
        field_.brick_slot_[brick] = static_cast<int32_t>(brick_of_slot_.size());
        brick_of_slot_.emplace_back(x, y, z);
        field_.brick_triangles_begin_.push_back(field_.brick_triangles_begin_.back() + count[brick]);
      }
    }
  }
  field_.brick_triangles_.resize(field_.brick_triangles_begin_.back());
  std::vector<uint32_t> next(field_.brick_triangles_begin_.begin(), field_.brick_triangles_begin_.end() - 1);
  for (size_t index = 0; index < field_.triangles_.size(); ++index) {
    for_each_brick(field_.triangles_[index], [&](size_t brick) {
      field_.brick_triangles_[next[static_cast<size_t>(field_.brick_slot_[brick])]++] = static_cast<uint32_t>(index);
    });
  }
}

void SignedDistanceFieldBuilder::Consider(const SignedDistanceField& field, const Eigen::Vector3f& point,
                                          int32_t triangle, NearestTriangle& nearest) {
  const Eigen::Vector3i& corners = field.triangles_[static_cast<size_t>(triangle)];
  const Eigen::Vector3f& a = field.vertices_[static_cast<size_t>(corners[0])];
  const Eigen::Vector3f& b = field.vertices_[static_cast<size_t>(corners[1])];
  const Eigen::Vector3f& c = field.vertices_[static_cast<size_t>(corners[2])];
  const ClosestPoint<float> closest = ClosestPointOnTriangle<float>(point, a, b, c);
  const Eigen::Vector3f way = point - closest.point;
  const float squared_distance = way.squaredNorm();
  if (!(squared_distance <= nearest.squared_distance * (1.0F + kTie))) return;
  const int feature = static_cast<int>(closest.feature);
  const Eigen::Vector3f normal =
      feature < 3 ? field.vertex_normals_[static_cast<size_t>(corners[feature])].eval() : (b - a).cross(c - a).eval();
  const float length = normal.norm() * std::sqrt(squared_distance);
  const float facing = length > 0.0F ? normal.dot(way) / length : 0.0F;
  const bool tie = squared_distance >= nearest.squared_distance * (1.0F - kTie);
  if (tie && std::abs(facing) <= std::abs(nearest.facing)) return;
  nearest = {squared_distance, facing, triangle};
}

void SignedDistanceFieldBuilder::SplatTriangles(size_t slot, const Eigen::Vector3i& first_node,
                                                BrickSamples& samples) const {
  constexpr int kNodes = SignedDistanceField::kBrickNodes;
  const float pitch = static_cast<float>(field_.pitch_);
  const float reach = kNearCells * pitch;
  for (uint32_t entry = field_.brick_triangles_begin_[slot]; entry < field_.brick_triangles_begin_[slot + 1]; ++entry) {
    const int32_t triangle = static_cast<int32_t>(field_.brick_triangles_[entry]);
    const Eigen::Vector3i& corners = field_.triangles_[static_cast<size_t>(triangle)];
    const Eigen::Vector3f& a = field_.vertices_[static_cast<size_t>(corners[0])];
    const Eigen::Vector3f& b = field_.vertices_[static_cast<size_t>(corners[1])];
    const Eigen::Vector3f& c = field_.vertices_[static_cast<size_t>(corners[2])];
    const Eigen::Array3f low = (a.cwiseMin(b).cwiseMin(c).array() - reach) / pitch;
    const Eigen::Array3f high = (a.cwiseMax(b).cwiseMax(c).array() + reach) / pitch;
    const Eigen::Vector3i from = (low.ceil().cast<int>().matrix() - first_node).cwiseMax(0);
    const Eigen::Vector3i to = (high.floor().cast<int>().matrix() - first_node).cwiseMin(kNodes - 1);
    for (int z = from.z(); z <= to.z(); ++z) {
      for (int y = from.y(); y <= to.y(); ++y) {
        for (int x = from.x(); x <= to.x(); ++x) {
          Consider(field_, FinePoint(first_node + Eigen::Vector3i(x, y, z)), triangle,
                   samples[static_cast<size_t>(x + kNodes * (y + kNodes * z))]);
        }
      }
    }
  }
}

// Hands nearest triangles on to the samples that splatting has not reached, twice forth and back. Such a sample is
// further than a pitch from the surface, so it lies on the same side as the neighbour that it takes a triangle from.
void SignedDistanceFieldBuilder::SpreadInBrick(const Eigen::Vector3i& first_node, BrickSamples& samples) const {
  constexpr int kNodes = SignedDistanceField::kBrickNodes;
  const float reach = kNearCells * static_cast<float>(field_.pitch_);
  const auto visit = [&](int x, int y, int z) {
    NearestTriangle& sample = samples[static_cast<size_t>(x + kNodes * (y + kNodes * z))];
    if (sample.squared_distance <= reach * reach) return;
    for (const Eigen::Vector3i& step : kNeighbours) {
      const Eigen::Vector3i other = Eigen::Vector3i(x, y, z) + step;
      if (!IsInside(other, Eigen::Vector3i::Constant(kNodes))) continue;
      const NearestTriangle& neighbour =
          samples[static_cast<size_t>(other.x() + kNodes * (other.y() + kNodes * other.z()))];
      if (neighbour.triangle < 0 || neighbour.triangle == sample.triangle) continue;
      NearestTriangle candidate = sample;
      Consider(field_, FinePoint(first_node + Eigen::Vector3i(x, y, z)), neighbour.triangle, candidate);
      if (candidate.triangle == sample.triangle) continue;
      sample = candidate;
      sample.facing = neighbour.facing;
    }
  };
  for (int round = 0; round < 2; ++round) {
    for (int index = 0; index < kNodes * kNodes * kNodes; ++index) {
      visit(index % kNodes, index / kNodes % kNodes, index / (kNodes * kNodes));
    }
    for (int index = kNodes * kNodes * kNodes - 1; index >= 0; --index) {
      visit(index % kNodes, index / kNodes % kNodes, index / (kNodes * kNodes));
    }
  }
}

void SignedDistanceFieldBuilder::FillBrick(size_t slot) {
  constexpr int kNodes = SignedDistanceField::kBrickNodes;
  const Eigen::Vector3i first_node = brick_of_slot_[slot] * SignedDistanceField::kBrickCells;
  BrickSamples samples(SignedDistanceField::kBrickSampleCount, NearestTriangle{kUnknown, 0.0F, -1});
  // Samples start at the splatting reach, so that a triangle further away is not taken for the nearest one.
  SplatTriangles(slot, first_node, samples);
  const bool reached =
      std::any_of(samples.begin(), samples.end(), [](const NearestTriangle& sample) { return sample.triangle >= 0; });
  if (reached) {
    SpreadInBrick(first_node, samples);
  } else {  // The surface only comes near: few triangles, tried by every sample.
    for (uint32_t entry = field_.brick_triangles_begin_[slot]; entry < field_.brick_triangles_begin_[slot + 1];
         ++entry) {
      for (int index = 0; index < SignedDistanceField::kBrickSampleCount; ++index) {
        const Eigen::Vector3i local(index % kNodes, index / kNodes % kNodes, index / (kNodes * kNodes));
        Consider(field_, FinePoint(first_node + local), static_cast<int32_t>(field_.brick_triangles_[entry]),
                 samples[static_cast<size_t>(index)]);
      }
    }
  }
  float* const stored = &field_.brick_samples_[slot * SignedDistanceField::kBrickSampleCount];
  for (size_t index = 0; index < samples.size(); ++index) {
    stored[index] = std::copysign(std::sqrt(samples[index].squared_distance), samples[index].facing);
  }
  constexpr int kStride = SignedDistanceField::kBrickCells / SignedDistanceField::kCoarsePerBrick;
  for (int node = 0; node < 27; ++node) {
    const Eigen::Vector3i local = Eigen::Vector3i(node % 3, node / 3 % 3, node / 9) * kStride;
    coarse_of_brick_[slot * 27 + static_cast<size_t>(node)] =
        samples[static_cast<size_t>(local.x() + kNodes * (local.y() + kNodes * local.z()))];
  }
}

void SignedDistanceFieldBuilder::FillCoarseGrid() {
  std::vector<NearestTriangle> nodes(field_.coarse_count_.cast<Eigen::Index>().prod(),
                                     NearestTriangle{kUnknown, 0.0F, -1});
  TakeOverBricks(nodes);
  std::vector<bool> fixed(nodes.size());
  for (size_t index = 0; index < nodes.size(); ++index) fixed[index] = nodes[index].triangle >= 0;
  SpreadOverCoarseGrid(nodes, fixed);
  SignCoarseGrid(nodes, fixed);
  field_.coarse_samples_.resize(nodes.size());
  for (size_t index = 0; index < nodes.size(); ++index) {
    field_.coarse_samples_[index] = std::copysign(std::sqrt(nodes[index].squared_distance), nodes[index].facing);
  }
}

void SignedDistanceFieldBuilder::TakeOverBricks(std::vector<NearestTriangle>& nodes) const {
  for (size_t slot = 0; slot < brick_of_slot_.size(); ++slot) {
    const Eigen::Vector3i first = brick_of_slot_[slot] * SignedDistanceField::kCoarsePerBrick;
    for (int node = 0; node < 27; ++node) {
      const NearestTriangle& known = coarse_of_brick_[slot * 27 + static_cast<size_t>(node)];
      NearestTriangle& target = nodes[field_.CoarseIndex(first + Eigen::Vector3i(node % 3, node / 3 % 3, node / 9))];
      if (known.squared_distance < target.squared_distance) target = known;
    }
  }
}

void SignedDistanceFieldBuilder::SpreadOverCoarseGrid(std::vector<NearestTriangle>& nodes,
                                                      const std::vector<bool>& fixed) const {
  const Eigen::Vector3i count = field_.coarse_count_;
  constexpr int kStride = SignedDistanceField::kBrickCells / SignedDistanceField::kCoarsePerBrick;
  const auto visit = [&](const Eigen::Vector3i& at) {
    const size_t index = field_.CoarseIndex(at);
    if (fixed[index]) return;
    for (const Eigen::Vector3i& step : kNeighbours) {
      if (!IsInside(at + step, count)) continue;
      const int32_t triangle = nodes[field_.CoarseIndex(at + step)].triangle;
      if (triangle < 0 || triangle == nodes[index].triangle) continue;
      Consider(field_, FinePoint(at * kStride), triangle, nodes[index]);
    }
  };
  // Sweeps in all eight directions reach every node from every side.
  for (int direction = 0; direction < 8; ++direction) {
    for (int k = 0; k < count.z(); ++k) {
      for (int j = 0; j < count.y(); ++j) {
        for (int i = 0; i < count.x(); ++i) {
          visit({(direction & 1) != 0 ? count.x() - 1 - i : i, (direction & 2) != 0 ? count.y() - 1 - j : j,
                 (direction & 4) != 0 ? count.z() - 1 - k : k});
        }
      }
    }
  }
}

// Nodes outside the bricks are further from the surface than half a step, so connected ones lie on one side. What the
// bricks say along a connected part decides by majority.
void SignedDistanceFieldBuilder::SignCoarseGrid(std::vector<NearestTriangle>& nodes,
                                                const std::vector<bool>& fixed) const {
  const Eigen::Vector3i count = field_.coarse_count_;
  const float half_step = static_cast<float>(2.0 * field_.pitch_);
  std::vector<bool> seen = fixed;
  std::vector<Eigen::Vector3i> part;
  for (int z = 0; z < count.z(); ++z) {
    for (int y = 0; y < count.y(); ++y) {
      for (int x = 0; x < count.x(); ++x) {
        if (seen[field_.CoarseIndex({x, y, z})]) continue;
        part.assign(1, Eigen::Vector3i(x, y, z));
        seen[field_.CoarseIndex(part.front())] = true;
        int64_t vote = 0;
        for (size_t next = 0; next < part.size(); ++next) {
          for (const Eigen::Vector3i& step : kNeighbours) {
            const Eigen::Vector3i other = part[next] + step;
            if (!IsInside(other, count)) continue;
            const size_t index = field_.CoarseIndex(other);
            if (fixed[index] && nodes[index].squared_distance > half_step * half_step) {
              vote += nodes[index].facing < 0.0F ? -1 : 1;
            }
            if (seen[index]) continue;
            seen[index] = true;
            part.push_back(other);
          }
        }
        for (const Eigen::Vector3i& node : part) nodes[field_.CoarseIndex(node)].facing = vote < 0 ? -1.0F : 1.0F;
      }
    }
  }
}

}  // namespace fitroom
