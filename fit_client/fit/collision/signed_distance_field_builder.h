#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fit_client/fit/collision/signed_distance_field.h"

namespace fitroom {

// Fills a SignedDistanceField. One object builds one field; not thread-safe, uses the executor itself.
//
// 1. Triangles are binned into the bricks they come within two pitches of; bricks without triangles are not stored.
// 2. The coarse grid gets a nearest triangle a node from triangles next to it and by sweeping from node to node.
// 3. BrickFiller computes each stored brick, with the coarse grid's triangles as hints for samples far from the
// surface.
//    Then neighbouring samples agree on their signs (side_votes.h).
// 4. The coarse nodes in bricks take over what the bricks know; connected parts of the others get their sign from what
//    the bricks along them say by majority, so that one bad triangle cannot turn a region inside out.
class SignedDistanceFieldBuilder {
 public:
  SignedDistanceFieldBuilder(const TriangleMesh& body, const SignedDistanceFieldOptions& options, Executor& executor);

  Result<SignedDistanceField> Build();

 private:
  struct Box {
    Eigen::Vector3i low;
    Eigen::Vector3i high;  // Inclusive.
  };
  struct CoarseNode {
    float distance = 0.0F;  // Unsigned (unit: metre).
    int32_t triangle = -1;  // None yet.
    int8_t side = 0;        // -1 inside, 1 outside.
  };

  Status CheckInput() const;
  Status LayOutRegion();
  Status BinTriangles();
  Box BricksNear(size_t triangle) const;

  void SeedCoarseGrid();
  void TryTriangle(const Eigen::Vector3i& node, int32_t triangle);
  void SpreadOverCoarseGrid();
  void FillBricks(size_t begin, size_t end);
  void SettleBrickSides();
  std::vector<bool> TakeOverBricks();
  void SignCoarseGrid(const std::vector<bool>& in_brick);
  void StoreCoarseGrid();

  const TriangleMesh& body_;
  const SignedDistanceFieldOptions& options_;
  Executor& executor_;
  SignedDistanceField field_;
  std::vector<Eigen::Vector3i> brick_of_slot_;
  std::vector<CoarseNode> coarse_;                          // One a coarse node.
  std::vector<std::array<CoarseNode, 27>> coarse_of_slot_;  // What each brick knows at its coarse nodes.
};

}  // namespace fitroom
