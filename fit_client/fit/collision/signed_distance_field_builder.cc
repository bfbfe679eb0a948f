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

Eigen::Vector3i LocalNode(int index) {
  constexpr int kNodes = 9;
  return {index % kNodes, index / kNodes % kNodes, index / (kNodes * kNodes)};
}

int LocalIndex(const Eigen::Vector3i& node) { return node.x() + 9 * (node.y() + 9 * node.z()); }

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
  SeedCoarseGrid();
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
    const Eigen::Vector3f centre = 0.5F * (triangle_low + triangle_high);
    const float squared_radius =
        std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(), (c - centre).squaredNorm()});
    spheres_.emplace_back(centre.x(), centre.y(), centre.z(), std::sqrt(squared_radius));
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
  nearest = {squared_distance, std::sqrt(squared_distance), facing, triangle};
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
          TryTriangle(FinePoint(first_node + Eigen::Vector3i(x, y, z)), triangle,
                      samples[static_cast<size_t>(x + kNodes * (y + kNodes * z))]);
        }
      }
    }
  }
}

// Gives the samples that splatting has not reached the nearest triangles that the coarse grid and their neighbours
// know.
void SignedDistanceFieldBuilder::SpreadInBrick(const Eigen::Vector3i& first_node, const std::vector<bool>& reached,
                                               BrickSamples& samples) const {
  constexpr int kNodes = SignedDistanceField::kBrickNodes;
  constexpr int kStride = SignedDistanceField::kBrickCells / SignedDistanceField::kCoarsePerBrick;
  const auto consider = [&](const Eigen::Vector3i& local, int32_t triangle, NearestTriangle& sample) {
    if (triangle < 0 || triangle == sample.triangle) return;
    TryTriangle(FinePoint(first_node + local), triangle, sample);
  };
  for (int index = 0; index < SignedDistanceField::kBrickSampleCount; ++index) {
    if (reached[static_cast<size_t>(index)]) continue;
    const Eigen::Vector3i local = LocalNode(index);
    const Eigen::Vector3i nearest_coarse = (first_node + local + Eigen::Vector3i::Constant(kStride / 2)) / kStride;
    consider(local, coarse_[field_.CoarseIndex(nearest_coarse)].triangle, samples[static_cast<size_t>(index)]);
  }
  const auto visit = [&](int index) {
    if (reached[static_cast<size_t>(index)]) return;
    const Eigen::Vector3i local = LocalNode(index);
    for (const Eigen::Vector3i& step : kNeighbours) {
      const Eigen::Vector3i other = local + step;
      if (!IsInside(other, Eigen::Vector3i::Constant(kNodes))) continue;
      consider(local, samples[static_cast<size_t>(LocalIndex(other))].triangle, samples[static_cast<size_t>(index)]);
    }
  };
  for (int index = 0; index < SignedDistanceField::kBrickSampleCount; ++index) visit(index);
  for (int index = SignedDistanceField::kBrickSampleCount - 1; index >= 0; --index) visit(index);
}

// Samples that splatting has not reached are further than a pitch from the surface, so they lie on the same side as
// their neighbours: the sign spreads from the reached ones, whose triangles are all known.
void SignedDistanceFieldBuilder::SpreadSigns(const std::vector<bool>& reached, BrickSamples& samples) {
  std::vector<int> queue;
  std::vector<bool> known = reached;
  for (int index = 0; index < SignedDistanceField::kBrickSampleCount; ++index) {
    if (reached[static_cast<size_t>(index)]) queue.push_back(index);
  }
  if (queue.empty()) {  // All on one side: the closest sample is the surest.
    const auto closest = std::min_element(
        samples.begin(), samples.end(),
        [](const NearestTriangle& a, const NearestTriangle& b) { return a.squared_distance < b.squared_distance; });
    queue.push_back(static_cast<int>(closest - samples.begin()));
    known[static_cast<size_t>(queue.front())] = true;
  }
  for (size_t next = 0; next < queue.size(); ++next) {
    const Eigen::Vector3i local = LocalNode(queue[next]);
    for (const Eigen::Vector3i& step : kNeighbours) {
      const Eigen::Vector3i other = local + step;
      if (!IsInside(other, Eigen::Vector3i::Constant(SignedDistanceField::kBrickNodes))) continue;
      const size_t index = static_cast<size_t>(LocalIndex(other));
      if (known[index]) continue;
      known[index] = true;
      samples[index].facing = samples[static_cast<size_t>(queue[next])].facing;
      queue.push_back(static_cast<int>(index));
    }
  }
}

void SignedDistanceFieldBuilder::FillBrick(size_t slot) {
  const Eigen::Vector3i first_node = brick_of_slot_[slot] * SignedDistanceField::kBrickCells;
  const float reach = kNearCells * static_cast<float>(field_.pitch_);
  // Nothing is known yet, and nothing further than the splatting reach is taken.
  BrickSamples samples(SignedDistanceField::kBrickSampleCount, NearestTriangle{reach * reach, reach, 0.0F, -1});
  SplatTriangles(slot, first_node, samples);
  std::vector<bool> reached(samples.size());
  bool any_reached = false;
  for (size_t index = 0; index < samples.size(); ++index) {
    reached[index] = samples[index].triangle >= 0;
    any_reached = any_reached || reached[index];
    if (!reached[index]) samples[index] = {kUnknown, kUnknown, 0.0F, -1};
  }
  if (!any_reached) {  // The surface only comes near: few triangles, tried by every sample.
    for (uint32_t entry = field_.brick_triangles_begin_[slot]; entry < field_.brick_triangles_begin_[slot + 1];
         ++entry) {
      for (int index = 0; index < SignedDistanceField::kBrickSampleCount; ++index) {
        TryTriangle(FinePoint(first_node + LocalNode(index)), static_cast<int32_t>(field_.brick_triangles_[entry]),
                    samples[static_cast<size_t>(index)]);
      }
    }
    SpreadSigns(reached, samples);
  }
  SpreadInBrick(first_node, reached, samples);
  if (any_reached) SpreadSigns(reached, samples);
  float* const stored = &field_.brick_samples_[slot * SignedDistanceField::kBrickSampleCount];
  for (size_t index = 0; index < samples.size(); ++index) {
    stored[index] = std::copysign(std::sqrt(samples[index].squared_distance), samples[index].facing);
  }
  constexpr int kStride = SignedDistanceField::kBrickCells / SignedDistanceField::kCoarsePerBrick;
  for (int node = 0; node < 27; ++node) {
    const Eigen::Vector3i local = Eigen::Vector3i(node % 3, node / 3 % 3, node / 9) * kStride;
    coarse_of_brick_[slot * 27 + static_cast<size_t>(node)] = samples[static_cast<size_t>(LocalIndex(local))];
  }
}

// Finds a nearest triangle for every coarse node: first those whose corners or centre are next to it, then what the
// neighbours know.
void SignedDistanceFieldBuilder::SeedCoarseGrid() {
  coarse_.assign(field_.coarse_count_.cast<Eigen::Index>().prod(), NearestTriangle{kUnknown, kUnknown, 0.0F, -1});
  constexpr int kStride = SignedDistanceField::kBrickCells / SignedDistanceField::kCoarsePerBrick;
  const float step = static_cast<float>(field_.pitch_ * kStride);
  for (size_t index = 0; index < field_.triangles_.size(); ++index) {
    const Eigen::Vector3i& corners = field_.triangles_[index];
    const Eigen::Vector3f& a = field_.vertices_[static_cast<size_t>(corners[0])];
    const Eigen::Vector3f& b = field_.vertices_[static_cast<size_t>(corners[1])];
    const Eigen::Vector3f& c = field_.vertices_[static_cast<size_t>(corners[2])];
    Eigen::Vector3i last = Eigen::Vector3i::Constant(-1);
    for (const Eigen::Vector3f& place : {((a + b + c) / 3.0F).eval(), a, b, c}) {
      const Eigen::Vector3i node = (place / step).array().round().matrix().cast<int>();
      if (node == last || !IsInside(node, field_.coarse_count_)) continue;
      last = node;
      TryTriangle(FinePoint(node * kStride), static_cast<int32_t>(index), coarse_[field_.CoarseIndex(node)]);
    }
  }
  SpreadOverCoarseGrid();
}

void SignedDistanceFieldBuilder::FillCoarseGrid() {
  const std::vector<bool> in_brick = TakeOverBricks();
  SignCoarseGrid(in_brick);
  field_.coarse_samples_.resize(coarse_.size());
  for (size_t index = 0; index < coarse_.size(); ++index) {
    field_.coarse_samples_[index] = std::copysign(std::sqrt(coarse_[index].squared_distance), coarse_[index].facing);
  }
}

// Replaces the nodes that lie in stored bricks by what the bricks know; returns which those are.
std::vector<bool> SignedDistanceFieldBuilder::TakeOverBricks() {
  std::vector<bool> in_brick(coarse_.size(), false);
  for (size_t slot = 0; slot < brick_of_slot_.size(); ++slot) {
    const Eigen::Vector3i first = brick_of_slot_[slot] * SignedDistanceField::kCoarsePerBrick;
    for (int node = 0; node < 27; ++node) {
      const NearestTriangle& known = coarse_of_brick_[slot * 27 + static_cast<size_t>(node)];
      const size_t target = field_.CoarseIndex(first + Eigen::Vector3i(node % 3, node / 3 % 3, node / 9));
      if (!in_brick[target] || known.squared_distance < coarse_[target].squared_distance) coarse_[target] = known;
      in_brick[target] = true;
    }
  }
  return in_brick;
}

void SignedDistanceFieldBuilder::SpreadOverCoarseGrid() {
  const Eigen::Vector3i count = field_.coarse_count_;
  constexpr int kStride = SignedDistanceField::kBrickCells / SignedDistanceField::kCoarsePerBrick;
  const auto visit = [&](const Eigen::Vector3i& at) {
    NearestTriangle& node = coarse_[field_.CoarseIndex(at)];
    for (const Eigen::Vector3i& step : kNeighbours) {
      if (!IsInside(at + step, count)) continue;
      const int32_t triangle = coarse_[field_.CoarseIndex(at + step)].triangle;
      if (triangle >= 0 && triangle != node.triangle) TryTriangle(FinePoint(at * kStride), triangle, node);
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
void SignedDistanceFieldBuilder::SignCoarseGrid(const std::vector<bool>& in_brick) {
  const Eigen::Vector3i count = field_.coarse_count_;
  const float half_step = static_cast<float>(2.0 * field_.pitch_);
  std::vector<bool> seen = in_brick;
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
            if (in_brick[index] && coarse_[index].squared_distance > half_step * half_step) {
              vote += coarse_[index].facing < 0.0F ? -1 : 1;
            }
            if (seen[index]) continue;
            seen[index] = true;
            part.push_back(other);
          }
        }
        for (const Eigen::Vector3i& node : part) coarse_[field_.CoarseIndex(node)].facing = vote < 0 ? -1.0F : 1.0F;
      }
    }
  }
}

}  // namespace fitroom
