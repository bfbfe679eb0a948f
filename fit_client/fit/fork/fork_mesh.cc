#include "fit_client/fit/fork/fork_mesh.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "fit_client/fit/fork/fork_half.h"
#include "fit_client/fit/panels/append_panel.h"
#include "fit_client/fit/panels/outline_samples.h"

namespace fitroom {
namespace {

// Two sections that are sewn together; `reversed` if they run opposite ways.
struct ForkSeam {
  int piece_a = 0;
  const char* section_a = "";
  int piece_b = 0;
  const char* section_b = "";
  bool reversed = false;
};

// Pieces: 0 front left, 1 front right, 2 back left, 3 back right.
constexpr std::array<ForkSeam, 6> kSeams = {{{0, "outseam_L", 2, "outseam_L", false},
                                             {1, "outseam_R", 3, "outseam_R", false},
                                             {0, "inseam_L", 2, "inseam_L", false},
                                             {1, "inseam_R", 3, "inseam_R", false},
                                             {0, "centre_L", 1, "centre_R", true},
                                             {2, "centre_L", 3, "centre_R", true}}};

using Shares = std::vector<std::vector<double>>;  // Per section.

size_t IndexOf(const PanelPattern& piece, const std::string& name) {
  const OutlineSection* section = FindSection(piece, name);
  FR_CHECK(section != nullptr);
  return static_cast<size_t>(section - piece.sections.data());
}

// Samples every section by its own points; of two that are sewn the second takes the shares of the first.
std::array<Shares, kForkPieceCount> ChooseShares(const ForkedPattern& forked, double pitch, double tight_pitch) {
  std::array<Shares, kForkPieceCount> shares;
  for (size_t p = 0; p < shares.size(); ++p) {
    const panels::MeshSize size(forked.pieces[p], pitch, tight_pitch);
    for (const OutlineSection& section : forked.pieces[p].sections) {
      shares[p].push_back(panels::SampleShares(section, size));
    }
  }
  for (const ForkSeam& seam : kSeams) {
    const size_t a = static_cast<size_t>(seam.piece_a), b = static_cast<size_t>(seam.piece_b);
    std::vector<double> taken = shares[a][IndexOf(forked.pieces[a], seam.section_a)];
    if (seam.reversed) {
      std::reverse(taken.begin(), taken.end());
      for (double& share : taken) share = 1.0 - share;
    }
    shares[b][IndexOf(forked.pieces[b], seam.section_b)] = std::move(taken);
  }
  return shares;
}

}  // namespace

Result<ClothMesh> MeshFork(const ForkedPattern& forked, double pitch, double tight_pitch) {
  FR_RETURN_IF_ERROR(panels::CheckPitch(pitch));
  FR_CHECK(forked.pieces.size() == static_cast<size_t>(kForkPieceCount));
  const std::array<Shares, kForkPieceCount> shares = ChooseShares(forked, pitch, tight_pitch);
  ClothMesh mesh;
  std::array<panels::OutlineSamples, kForkPieceCount> samples;
  std::array<std::vector<int>, kForkPieceCount> particles;
  for (size_t p = 0; p < samples.size(); ++p) {
    const PanelPattern& piece = forked.pieces[p];
    const bool left = p % 2 == 0;
    const PanelPattern& photographed = p < 2 ? forked.photographed.front : forked.photographed.back;
    const fork::ForkTexture texture(photographed, fork::TakeHalf(photographed, left), left);
    const double sign = left ? 1.0 : -1.0;
    const auto pixel_at = [&](const Eigen::Vector2d& point) { return texture.PixelAt({sign * point.x(), point.y()}); };
    samples[p] = panels::SampleOutlineAt(piece, shares[p]);
    FR_ASSIGN_OR_RETURN(particles[p], panels::AppendPanel(piece, forked.photographed.kind, samples[p],
                                                          panels::MeshSize(piece, pitch, tight_pitch), pixel_at, mesh));
  }
  for (const ForkSeam& seam : kSeams) {
    const size_t a = static_cast<size_t>(seam.piece_a), b = static_cast<size_t>(seam.piece_b);
    const std::vector<int>& of_a = samples[a].samples_of_section[IndexOf(forked.pieces[a], seam.section_a)];
    const std::vector<int>& of_b = samples[b].samples_of_section[IndexOf(forked.pieces[b], seam.section_b)];
    FR_CHECK(of_a.size() == of_b.size());
    for (size_t i = 0; i < of_a.size(); ++i) {
      const int sample_b = of_b[seam.reversed ? of_b.size() - 1 - i : i];
      mesh.seams.push_back({particles[a][static_cast<size_t>(of_a[i])], particles[b][static_cast<size_t>(sample_b)]});
    }
  }
  panels::SortSeams(mesh);
  FR_RETURN_IF_ERROR(panels::CheckSewn(mesh, forked.photographed.kind));
  return mesh;
}

}  // namespace fitroom
