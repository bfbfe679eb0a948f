#include "fit_client/fit/solver/self_collision_topology.h"

#include <algorithm>
#include <tuple>

namespace fitroom {
namespace {

// Mean rest length of the springs, which the model keeps in its batches; idle places name one particle twice.
double MeanRestLength(const ClothModel& model) {
  double sum = 0.0;
  int count = 0;
  const auto add = [&](const ClothChunk& chunk) {
    for (const StretchBatch& batch : chunk.stretch) {
      for (size_t lane = 0; lane < 4; ++lane) {
        if (batch.a[lane] == batch.b[lane]) continue;
        sum += static_cast<double>(batch.rest_length[lane]);
        ++count;
      }
    }
  };
  for (const ClothChunk& chunk : model.chunks()) add(chunk);
  add(model.border());
  return count > 0 ? sum / count : 0.01;
}

}  // namespace

NumberLists MakeNumberLists(int owner_count, std::span<const std::array<int, 2>> owned) {
  NumberLists lists;
  lists.begin.assign(static_cast<size_t>(owner_count) + 1, 0);
  for (const auto& [owner, item] : owned) ++lists.begin[static_cast<size_t>(owner) + 1];
  for (size_t owner = 1; owner < lists.begin.size(); ++owner) lists.begin[owner] += lists.begin[owner - 1];
  std::vector<int> next(lists.begin.begin(), lists.begin.end() - 1);
  lists.items.resize(owned.size());
  for (const auto& [owner, item] : owned) {
    lists.items[static_cast<size_t>(next[static_cast<size_t>(owner)]++)] = item;
  }
  return lists;
}

SelfCollisionTopology MakeSelfCollisionTopology(const ClothModel& model) {
  SelfCollisionTopology topology;
  std::vector<std::array<int, 2>> owned;
  std::vector<std::array<int, 3>> sides;  // Edge's ends, lower first, and a triangle.
  for (size_t index = 0; index < model.triangles().size(); ++index) {
    const auto& corners = model.triangles()[index];
    for (size_t corner = 0; corner < 3; ++corner) {
      owned.push_back({corners[corner], static_cast<int>(index)});
      const auto [low, high] = std::minmax(corners[corner], corners[(corner + 1) % 3]);
      sides.push_back({low, high, static_cast<int>(index)});
    }
  }
  topology.triangles_of_particle = MakeNumberLists(model.particle_count(), owned);
  owned.clear();
  std::vector<std::array<int, 2>> neighbours;
  for (size_t index = 0; index < model.edges().size(); ++index) {
    const auto& [a, b] = model.edges()[index];
    owned.push_back({a, static_cast<int>(index)});
    owned.push_back({b, static_cast<int>(index)});
    neighbours.push_back({a, b});
    neighbours.push_back({b, a});
  }
  topology.edges_of_particle = MakeNumberLists(model.particle_count(), owned);
  topology.neighbours_of_particle = MakeNumberLists(model.particle_count(), neighbours);
  std::sort(sides.begin(), sides.end());
  topology.triangles_of_edge.assign(model.edges().size(), {-1, -1});
  for (size_t index = 0; index < model.edges().size(); ++index) {
    const auto& [a, b] = model.edges()[index];
    auto side = std::lower_bound(sides.begin(), sides.end(), std::array<int, 3>{a, b, -1});
    for (int& triangle : topology.triangles_of_edge[index]) {
      if (side == sides.end() || (*side)[0] != a || (*side)[1] != b) break;
      triangle = (*side)[2];
      ++side;
    }
  }
  topology.mean_edge_length = MeanRestLength(model);
  return topology;
}

}  // namespace fitroom
