#include "fit_client/render/size_sheet.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "fit_client/render/label.h"
#include "fit_client/render/renderer.h"
#include "fit_client/render/run_both.h"

namespace fitroom::render {
namespace {

constexpr int kColumnWidth = 300;  // (unit: pixel)
constexpr int kViewHeight = 450;   // (unit: pixel)
constexpr int kGap = 6;            // (unit: pixel)
constexpr int kHead = 52;          // Above the pictures (unit: pixel).
constexpr int kVerdictTop = 14;    // Below the pictures (unit: pixel).
constexpr int kVerdictLine = 18;   // (unit: pixel)
constexpr int kEaseFoot = 124;     // Below the verdict, for six lines of ease (unit: pixel).
constexpr int kFewestVerdictLines = 4;
constexpr int kMostVerdictLines = 16;  // A longer verdict ends in dots.
constexpr double kVerdictHeight = 12.0;
constexpr size_t kEaseLineCount = 6;
constexpr std::array<uint8_t, 3> kChosen = {0, 90, 160};

LabelStyle Style(double height, std::array<uint8_t, 3> colour) {
  LabelStyle style;
  style.height = height;
  style.stroke_width = height / 8.0;
  style.colour = colour;
  return style;
}

// Both views of the columns with this remainder by two.
struct Share {
  Status status;
  std::vector<std::vector<Image>> views;  // One a column of the share; empty: not dressed.
};

Share DrawShare(const DisplayBody& body, const std::vector<SizeColumn>& columns, size_t first,
                const std::array<Camera, 2>& cameras) {
  Share share;
  if (first >= columns.size()) return share;
  Result<Renderer> renderer = Renderer::Create();
  if (!renderer.ok()) {
    share.status = renderer.status();
    return share;
  }
  for (size_t c = first; c < columns.size(); c += 2) {
    Scene scene;
    scene.body = &body;
    scene.garments = columns[c].others;
    if (columns[c].shape.cloth != nullptr) scene.garments.push_back(columns[c].shape);
    Result<std::vector<Image>> views = renderer->Draw(scene, cameras);
    if (!views.ok()) {
      share.status = views.status();
      return share;
    }
    share.views.push_back(*std::move(views));
  }
  return share;
}

void Frame(Image& sheet, int left, int width) {
  constexpr int kThickness = 5;
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = left; x < left + width; ++x) {
      const bool is_border =
          x < left + kThickness || x >= left + width - kThickness || y < kThickness || y >= sheet.height - kThickness;
      if (is_border) std::copy(kChosen.begin(), kChosen.end(), sheet.at(x, y));
    }
  }
}

std::vector<std::string> VerdictLines(const SizeColumn& column) {
  std::vector<std::string> lines = WrapLabel(column.verdict, kVerdictHeight, kColumnWidth - 28);
  if (lines.size() > kMostVerdictLines) {
    lines.resize(kMostVerdictLines);
    lines.back() = "...";
  }
  return lines;
}

// Room below the pictures for the longest verdict and the ease (unit: pixel).
int FootOf(const std::vector<SizeColumn>& columns) {
  int most = kFewestVerdictLines;
  for (const SizeColumn& column : columns) most = std::max(most, static_cast<int>(VerdictLines(column).size()));
  return kVerdictTop + most * kVerdictLine + kEaseFoot;
}

void WriteColumn(Image& sheet, const SizeColumn& column, int left) {
  const std::array<uint8_t, 3> ink = {50, 52, 56};
  const LabelStyle name = Style(22.0, column.is_recommended ? kChosen : ink);
  DrawLabel(sheet, column.size, left + 0.5 * (kColumnWidth - MeasureLabel(column.size, name)), 15.0, name);
  double y = kHead + 2 * kViewHeight + kGap + kVerdictTop;
  const LabelStyle verdict = Style(kVerdictHeight, column.is_recommended ? kChosen : ink);
  for (const std::string& line : VerdictLines(column)) {
    DrawLabel(sheet, line, left + 14, y, verdict);
    y += kVerdictLine;
  }
  y += 6.0;
  const LabelStyle ease = Style(10.5, ink);
  for (size_t i = 0; i < std::min(column.ease_lines.size(), kEaseLineCount); ++i) {
    DrawLabel(sheet, column.ease_lines[i], left + 14, y, ease);
    y += 17.0;
  }
  if (column.is_recommended) Frame(sheet, left, kColumnWidth);
}

}  // namespace

std::vector<std::string> WrapLabel(const std::string& text, double height, double width) {
  LabelStyle style;
  style.height = height;
  std::vector<std::string> lines;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    start = end + 1;
    if (word.empty()) continue;
    const bool fits = !lines.empty() && MeasureLabel(lines.back() + " " + word, style) <= width;
    if (fits) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

Result<Image> DrawSizeSheet(const DisplayBody& body, const std::vector<SizeColumn>& columns, int thread_count) {
  if (columns.empty() || columns.size() > kMostSizeColumns) {
    return InvalidArgument("BAD_SIZE_SHEET", "a sheet shows 1 to " + std::to_string(kMostSizeColumns) + " sizes, not " +
                                                 std::to_string(columns.size()));
  }
  Eigen::AlignedBox3d subject = ComputeBounds(body.mesh);
  for (const SizeColumn& column : columns) {
    for (const Eigen::Vector3d& position : column.shape.positions) {
      if (position.allFinite()) subject.extend(position);
    }
  }
  const std::array<Camera, 2> cameras = {Camera{ViewDirection::kFront, subject, kColumnWidth, kViewHeight},
                                         Camera{ViewDirection::kSide, subject, kColumnWidth, kViewHeight}};
  std::array<Share, 2> shares;
  FR_RETURN_IF_ERROR(RunBoth(
      thread_count, [&] { shares[0] = DrawShare(body, columns, 0, cameras); },
      [&] { shares[1] = DrawShare(body, columns, 1, cameras); }));
  FR_RETURN_IF_ERROR(shares[0].status);
  FR_RETURN_IF_ERROR(shares[1].status);
  const int count = static_cast<int>(columns.size());
  Image sheet = MakeImage(count * (kColumnWidth + kGap) - kGap, kHead + 2 * kViewHeight + kGap + FootOf(columns), 3);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), uint8_t{255});
  for (size_t c = 0; c < columns.size(); ++c) {
    const int left = static_cast<int>(c) * (kColumnWidth + kGap);
    const std::vector<Image>& views = shares[c % 2].views[c / 2];
    for (size_t v = 0; v < views.size(); ++v) {
      const int top = kHead + static_cast<int>(v) * (kViewHeight + kGap);
      for (int row = 0; row < kViewHeight; ++row) {
        std::memcpy(sheet.at(left, top + row), views[v].at(0, row), static_cast<size_t>(kColumnWidth) * 3);
      }
    }
    WriteColumn(sheet, columns[c], left);
  }
  return sheet;
}

}  // namespace fitroom::render
