#include "fit_client/fit/collision/signed_distance_field_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "fit_client/fit/collision/brick_filler.h"
#include "fit_client/fit/collision/side_votes.h"

namespace fitroom {
namespace {

constexpr float kBandCells = 2.0F;           // Bricks are stored within this of the surface (unit: pitch).
constexpr double kLargestCoordinate = 10.0;  // (unit: metre)
constexpr double kMargin = 0.03;             // Region beyond the body's bounds where none is asked for (unit: metre).
constexpr size_t kCoarseNodeLimit = size_t{1} << 24;
constexpr uint64_t kBinnedTriangleLimit = uint64_t{1} << 26;
constexpr int kStride = 4;  // Fine cells along a coarse one.

const std::array<Eigen::Vector3i, 6> kNeighbours = {Eigen::Vector3i(-1, 0, 0), Eigen::Vector3i(1, 0, 0),
                                                    Eigen::Vector3i(0, -1, 0), Eigen::Vector3i(0, 1, 0),
                                                    Eigen::Vector3i(0, 0, -1), Eigen::Vector3i(0, 0, 1)};

bool IsInside(const Eigen::Vector3i& node, const Eigen::Vector3i& count) {
  return (node.array() >= 0).all() && (node.array() < count.array()).all();
}

// The place of a brick's coarse node 0 ... 26, x fastest.
Eigen::Vector3i CoarseOffset(int node) { return {node % 3, node / 3 % 3, node / 9}; }

Status OutOfReach() {
  return InvalidArgument("BODY_OUT_OF_REACH", "no part of the body lies in the region that the cloth can reach");
}

}  // namespace

SignedDistanceFieldBuilder::SignedDistanceFieldBuilder(const TriangleMesh& body,
                                                       const SignedDistanceFieldOptions& options, Executor& executor)
    : body_(body), options_(options), executor_(executor) {
  static_assert(SignedDistanceField::kBrickCells == kStride * SignedDistanceField::kCoarsePerBrick);
  static_assert(SignedDistanceField::kBrickSampleCount == BrickFiller::kSampleCount);
}

Result<SignedDistanceField> SignedDistanceFieldBuilder::Build() {
  FR_RETURN_IF_ERROR(CheckInput());
  FR_RETURN_IF_ERROR(LayOutRegion());
  field_.surface_ = SurfaceTriangles(body_, field_.region_, 4.0 * field_.pitch_);
  FR_RETURN_IF_ERROR(BinTriangles());
  const size_t slot_count = brick_of_slot_.size();
  if (slot_count == 0) return OutOfReach();
  field_.brick_samples_.resize(slot_count * SignedDistanceField::kBrickSampleCount);
  coarse_of_slot_.resize(slot_count);
  SeedCoarseGrid();
  constexpr size_t kBricksPerTask = 32;
  executor_.Run(static_cast<int>((slot_count + kBricksPerTask - 1) / kBricksPerTask), [&](int task) {
    const size_t begin = static_cast<size_t>(task) * kBricksPerTask;
    FillBricks(begin, std::min(begin + kBricksPerTask, slot_count));
  });
  SettleBrickSides();
  SignCoarseGrid(TakeOverBricks());
  StoreCoarseGrid();
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
  if (region.isEmpty()) return OutOfReach();
  field_.pitch_ = options_.pitch;
  const double brick_size = options_.pitch * SignedDistanceField::kBrickCells;
  field_.brick_count_ = (region.sizes() / brick_size).array().ceil().matrix().cast<int>().cwiseMax(1);
  field_.coarse_count_ = field_.brick_count_ * SignedDistanceField::kCoarsePerBrick + Eigen::Vector3i::Ones();
  const Eigen::Vector3d size = field_.brick_count_.cast<double>() * brick_size;
  field_.region_ = Eigen::AlignedBox3d(region.min(), region.min() + size);
  if (field_.coarse_count_.cast<double>().prod() > static_cast<double>(kCoarseNodeLimit)) {
    return ResourceExhausted("DISTANCE_FIELD_TOO_LARGE", "the region needs too many samples at this pitch");
  }
  return Status();
}

SignedDistanceFieldBuilder::Box SignedDistanceFieldBuilder::BricksNear(size_t triangle) const {
  const Eigen::Vector3f& a = field_.surface_.Corner(triangle, 0);
  const Eigen::Vector3f& b = field_.surface_.Corner(triangle, 1);
  const Eigen::Vector3f& c = field_.surface_.Corner(triangle, 2);
  const float pitch = static_cast<float>(field_.pitch_);
  const float brick_size = pitch * SignedDistanceField::kBrickCells;
  const Eigen::Array3f low = (a.cwiseMin(b).cwiseMin(c).array() - kBandCells * pitch) / brick_size;
  const Eigen::Array3f high = (a.cwiseMax(b).cwiseMax(c).array() + kBandCells * pitch) / brick_size;
  Box box;
  box.low = low.floor().cast<int>().matrix().cwiseMax(0);
  box.high = high.floor().cast<int>().matrix().cwiseMin(field_.brick_count_ - Eigen::Vector3i::Ones());
  return box;
}

Status SignedDistanceFieldBuilder::BinTriangles() {
  const auto for_each_brick = [&](size_t triangle, const auto& visit) {
    const Box box = BricksNear(triangle);
    for (int z = box.low.z(); z <= box.high.z(); ++z) {
      for (int y = box.low.y(); y <= box.high.y(); ++y) {
        for (int x = box.low.x(); x <= box.high.x(); ++x) visit(field_.BrickIndex({x, y, z}));
      }
    }
  };
  uint64_t total = 0;
  for (size_t triangle = 0; triangle < field_.surface_.size(); ++triangle) {
    const Box box = BricksNear(triangle);
    total += static_cast<uint64_t>((box.high - box.low + Eigen::Vector3i::Ones()).cwiseMax(0).cast<int64_t>().prod());
  }
  if (total > kBinnedTriangleLimit) {
    return ResourceExhausted("BODY_TRIANGLES_TOO_LARGE", "the body's triangles are too many for their size");
  }
  std::vector<uint32_t> count(static_cast<size_t>(field_.brick_count_.cast<int64_t>().prod()), 0);
  for (size_t triangle = 0; triangle < field_.surface_.size(); ++triangle) {
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
  for (size_t triangle = 0; triangle < field_.surface_.size(); ++triangle) {
    for_each_brick(triangle, [&](size_t brick) {
      field_.brick_triangles_[next[static_cast<size_t>(field_.brick_slot_[brick])]++] = static_cast<uint32_t>(triangle);
    });
  }
  return Status();
}

// Gives a coarse node a triangle if it is closer than the one it has.
void SignedDistanceFieldBuilder::TryTriangle(const Eigen::Vector3i& at, int32_t triangle) {
  CoarseNode& node = coarse_[field_.CoarseIndex(at)];
  if (triangle < 0 || triangle == node.triangle) return;
  const Eigen::Vector3f place = at.cast<float>() * static_cast<float>(field_.pitch_ * kStride);
  const float squared = field_.surface_.SquaredDistance(static_cast<size_t>(triangle), place, node.distance);
  if (!(squared < node.distance * node.distance)) return;
  node.distance = std::sqrt(squared);
  node.triangle = triangle;
}

void SignedDistanceFieldBuilder::SeedCoarseGrid() {
  coarse_.assign(static_cast<size_t>(field_.coarse_count_.cast<int64_t>().prod()),
                 CoarseNode{std::numeric_limits<float>::infinity(), -1, 0});
  const float step = static_cast<float>(field_.pitch_ * kStride);
  for (size_t triangle = 0; triangle < field_.surface_.size(); ++triangle) {
    Eigen::Vector3i last = Eigen::Vector3i::Constant(-1);
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3i node =
          (field_.surface_.Corner(triangle, corner) / step).array().round().matrix().cast<int>();
      if (node == last || !IsInside(node, field_.coarse_count_)) continue;
      last = node;
      TryTriangle(node, static_cast<int32_t>(triangle));
    }
  }
  SpreadOverCoarseGrid();
}

// Fast sweeping in all eight directions: every node is reached from every side.
void SignedDistanceFieldBuilder::SpreadOverCoarseGrid() {
  const Eigen::Vector3i count = field_.coarse_count_;
  for (int direction = 0; direction < 8; ++direction) {
    const Eigen::Vector3i step((direction & 1) != 0 ? -1 : 1, (direction & 2) != 0 ? -1 : 1,
                               (direction & 4) != 0 ? -1 : 1);
    for (int k = 0; k < count.z(); ++k) {
      for (int j = 0; j < count.y(); ++j) {
        for (int i = 0; i < count.x(); ++i) {
          const Eigen::Vector3i at(step.x() > 0 ? i : count.x() - 1 - i, step.y() > 0 ? j : count.y() - 1 - j,
                                   step.z() > 0 ? k : count.z() - 1 - k);
          if (i > 0) TryTriangle(at, coarse_[field_.CoarseIndex({at.x() - step.x(), at.y(), at.z()})].triangle);
          if (j > 0) TryTriangle(at, coarse_[field_.CoarseIndex({at.x(), at.y() - step.y(), at.z()})].triangle);
          if (k > 0) TryTriangle(at, coarse_[field_.CoarseIndex({at.x(), at.y(), at.z() - step.z()})].triangle);
        }
      }
    }
  }
}

void SignedDistanceFieldBuilder::FillBricks(size_t begin, size_t end) {
  constexpr int kNodes = SignedDistanceField::kBrickNodes;
  BrickFiller filler(field_.surface_, static_cast<float>(field_.pitch_));
  for (size_t slot = begin; slot < end; ++slot) {
    const Eigen::Vector3i first_coarse = brick_of_slot_[slot] * SignedDistanceField::kCoarsePerBrick;
    std::array<int32_t, 27> hints = {};
    for (int node = 0; node < 27; ++node) {
      hints[static_cast<size_t>(node)] = coarse_[field_.CoarseIndex(first_coarse + CoarseOffset(node))].triangle;
    }
    const std::span<const uint32_t> near(field_.brick_triangles_.data() + field_.brick_triangles_begin_[slot],
                                         field_.brick_triangles_begin_[slot + 1] - field_.brick_triangles_begin_[slot]);
    filler.Fill(brick_of_slot_[slot] * SignedDistanceField::kBrickCells, near, hints);
    float* stored = &field_.brick_samples_[slot * SignedDistanceField::kBrickSampleCount];
    for (int z = 0; z < kNodes; ++z) {
      for (int y = 0; y < kNodes; ++y) {
        for (int x = 0; x < kNodes; ++x) *stored++ = filler.distance({x, y, z});
      }
    }
    for (int node = 0; node < 27; ++node) {
      const Eigen::Vector3i local = CoarseOffset(node) * kStride;
      const float distance = filler.distance(local);
      coarse_of_slot_[slot][static_cast<size_t>(node)] = {std::abs(distance), filler.triangle(local),
                                                          static_cast<int8_t>(std::signbit(distance) ? -1 : 1)};
    }
  }
}

// Lets connected samples agree on their side, and the bricks' coarse nodes with them.
void SignedDistanceFieldBuilder::SettleBrickSides() {
  BrickSamples samples;
  samples.distances = field_.brick_samples_;
  samples.brick_of_slot = brick_of_slot_;
  samples.slot_at = [this](const Eigen::Vector3i& brick) {
    return IsInside(brick, field_.brick_count_) ? field_.brick_slot_[field_.BrickIndex(brick)] : -1;
  };
  samples.nodes = SignedDistanceField::kBrickNodes;
  samples.pitch = static_cast<float>(field_.pitch_);
  SettleSides(samples, executor_);
  for (size_t slot = 0; slot < brick_of_slot_.size(); ++slot) {
    for (int node = 0; node < 27; ++node) {
      const Eigen::Vector3i at = CoarseOffset(node) * kStride;
      const size_t sample = static_cast<size_t>(at.x() + samples.nodes * (at.y() + samples.nodes * at.z()));
      const float distance = field_.brick_samples_[slot * SignedDistanceField::kBrickSampleCount + sample];
      coarse_of_slot_[slot][static_cast<size_t>(node)].side = static_cast<int8_t>(std::signbit(distance) ? -1 : 1);
    }
  }
}

// Replaces the nodes that lie in stored bricks by what the bricks know; returns which those are.
std::vector<bool> SignedDistanceFieldBuilder::TakeOverBricks() {
  std::vector<bool> in_brick(coarse_.size(), false);
  for (size_t slot = 0; slot < brick_of_slot_.size(); ++slot) {
    const Eigen::Vector3i first = brick_of_slot_[slot] * SignedDistanceField::kCoarsePerBrick;
    for (int node = 0; node < 27; ++node) {
      const CoarseNode& known = coarse_of_slot_[slot][static_cast<size_t>(node)];
      const size_t target = field_.CoarseIndex(first + CoarseOffset(node));
      if (!in_brick[target] || known.distance < coarse_[target].distance) coarse_[target] = known;
      in_brick[target] = true;
    }
  }
  return in_brick;
}

// Nodes outside the bricks are further from the surface than half a step, so connected ones lie on one side.
void SignedDistanceFieldBuilder::SignCoarseGrid(const std::vector<bool>& in_brick) {
  const Eigen::Vector3i count = field_.coarse_count_;
  const float half_step = static_cast<float>(0.5 * kStride * field_.pitch_);
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
            if (in_brick[index] && coarse_[index].distance > half_step) vote += coarse_[index].side;
            if (seen[index]) continue;
            seen[index] = true;
            part.push_back(other);
          }
        }
        for (const Eigen::Vector3i& node : part) coarse_[field_.CoarseIndex(node)].side = vote < 0 ? -1 : 1;
      }
    }
  }
}

void SignedDistanceFieldBuilder::StoreCoarseGrid() {
  field_.coarse_samples_.reserve(coarse_.size());
  for (const CoarseNode& node : coarse_) {
    field_.coarse_samples_.push_back(node.side < 0 ? -node.distance : node.distance);
  }
}

}  // namespace fitroom
