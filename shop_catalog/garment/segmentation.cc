#include "shop_catalog/garment/segmentation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "shop_catalog/garment/cv_image.h"

namespace fitroom::shop_catalog {
namespace {

constexpr int kWorkingSide = 320;  // Longest side at which the methods run (unit: pixel).
constexpr double kClearAgreement = 0.97;
constexpr double kClearContrast = 0.85;
constexpr int kPaletteSize = 5;       // Colours of the background that the frame may show.
constexpr double kColourNoise = 2.5;  // Least standard deviation of a background colour (unit: Lab).
constexpr uint64_t kRandomSeed =
    20260101;  // OpenCV's clustering draws from a generator; a fixed seed fixes the result.

cv::Mat Disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

cv::Mat FrameMask(cv::Size size, int width) {
  cv::Mat frame(size, CV_8U, cv::Scalar(255));
  frame(cv::Rect(width, width, size.width - 2 * width, size.height - 2 * width)).setTo(0);
  return frame;
}

struct BackgroundColour {
  cv::Vec3f mean;
  cv::Vec3f deviation;
  double share = 0.0;  // Of the frame's pixels.
};

// Clusters the colours along the frame.
std::vector<BackgroundColour> FindPalette(const cv::Mat& lab, const cv::Mat& frame) {
  std::vector<cv::Vec3f> colours;
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      if (frame.at<uint8_t>(y, x) != 0) colours.push_back(lab.at<cv::Vec3f>(y, x));
    }
  }
  const cv::Mat samples(static_cast<int>(colours.size()), 3, CV_32F, colours.data());
  cv::Mat labels;
  cv::kmeans(samples, kPaletteSize, labels, cv::TermCriteria(cv::TermCriteria::COUNT, 12, 0.0), 1,
             cv::KMEANS_PP_CENTERS);
  std::vector<BackgroundColour> palette(kPaletteSize);
  std::vector<cv::Vec3d> sums(kPaletteSize);
  std::vector<cv::Vec3d> squares(kPaletteSize);
  std::vector<double> counts(kPaletteSize, 0.0);
  for (size_t i = 0; i < colours.size(); ++i) {
    const auto k = static_cast<size_t>(labels.at<int>(static_cast<int>(i)));
    counts[k] += 1.0;
    for (int c = 0; c < 3; ++c) {
      sums[k][c] += static_cast<double>(colours[i][c]);
      squares[k][c] += static_cast<double>(colours[i][c]) * static_cast<double>(colours[i][c]);
    }
  }
  for (size_t k = 0; k < palette.size(); ++k) {
    palette[k].share = counts[k] / static_cast<double>(colours.size());
    if (counts[k] == 0.0) continue;
    for (int c = 0; c < 3; ++c) {
      const double mean = sums[k][c] / counts[k];
      const double variance = std::max(0.0, squares[k][c] / counts[k] - mean * mean);
      palette[k].mean[c] = static_cast<float>(mean);
      palette[k].deviation[c] = static_cast<float>(std::sqrt(variance + kColourNoise * kColourNoise));
    }
  }
  return palette;
}

// Distance of each pixel to the nearest background colour, in standard deviations, capped at 20. Lightness counts half:
// shadows and folds change it more than hue.
cv::Mat PaletteDistance(const cv::Mat& lab, const std::vector<BackgroundColour>& palette) {
  cv::Mat distance(lab.size(), CV_32F);
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      const cv::Vec3f& colour = lab.at<cv::Vec3f>(y, x);
      float best = 400.0f;
      for (const BackgroundColour& background : palette) {
        if (background.share < 0.03) continue;
        float squared = 0.0f;
        for (int c = 0; c < 3; ++c) {
          const float difference = (colour[c] - background.mean[c]) / background.deviation[c];
          squared += (c == 0 ? 0.5f : 1.0f) * difference * difference;
        }
        best = std::min(best, squared);
      }
      distance.at<float>(y, x) = std::sqrt(best);
    }
  }
  return distance;
}

double OtsuLevel(const cv::Mat& distance, double cap) {
  cv::Mat scaled;
  distance.convertTo(scaled, CV_8U, 255.0 / cap);
  cv::Mat ignored;
  return cv::threshold(scaled, ignored, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU) * cap / 255.0;
}

// Runs GrabCut from a first guess: what is well inside it is garment, what is far from it background.
cv::Mat RefineByGrabCut(const cv::Mat& rgb, const cv::Mat& guess, int margin, int iterations) {
  cv::Mat inside;
  cv::Mat around;
  cv::erode(guess, inside, Disc(margin), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::dilate(guess, around, Disc(2 * margin));
  cv::Mat state(rgb.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  state.setTo(cv::GC_PR_BGD, around);
  state.setTo(cv::GC_PR_FGD, guess);
  state.setTo(cv::GC_FGD, inside);
  if (cv::countNonZero(inside) < 50 ||
      cv::countNonZero(around) > static_cast<int>(0.98 * static_cast<double>(rgb.total()))) {
    return {};
  }
  cv::Mat background_model;
  cv::Mat garment_model;
  cv::theRNG().state = kRandomSeed;
  cv::grabCut(rgb, state, cv::Rect(), background_model, garment_model, iterations, cv::GC_INIT_WITH_MASK);
  cv::Mat mask = (state == cv::GC_FGD) | (state == cv::GC_PR_FGD);
  return mask;
}

// Runs GrabCut knowing only that the frame is background.
cv::Mat SegmentByRectangle(const cv::Mat& rgb) {
  const int margin = std::max(2, std::min(rgb.cols, rgb.rows) / 40);
  cv::Mat state(rgb.size(), CV_8U, cv::Scalar(cv::GC_PR_FGD));
  state.setTo(cv::GC_BGD, FrameMask(rgb.size(), margin));
  cv::Mat background_model;
  cv::Mat garment_model;
  cv::theRNG().state = kRandomSeed;
  cv::grabCut(rgb, state, cv::Rect(), background_model, garment_model, 4, cv::GC_INIT_WITH_MASK);
  cv::Mat mask = (state == cv::GC_FGD) | (state == cv::GC_PR_FGD);
  return mask;
}

double FramePart(const cv::Mat& mask) {
  cv::Mat edge;
  cv::erode(mask, edge, Disc(1), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  edge = mask & ~edge;
  const int edge_count = cv::countNonZero(edge);
  return edge_count == 0 ? 0.0 : static_cast<double>(cv::countNonZero(edge & FrameMask(mask.size(), 2))) / edge_count;
}

// Part of the edge across which the mean colours 3 pixels inside and outside differ by more than 8 Lab units.
double EdgeContrast(const cv::Mat& lab, const cv::Mat& mask) {
  cv::Mat weight_inside;
  mask.convertTo(weight_inside, CV_32F, 1.0 / 255.0);
  const cv::Mat weight_outside = 1.0 - weight_inside;
  const auto local_mean = [&](const cv::Mat& weight) {
    std::vector<cv::Mat> channels;
    cv::split(lab, channels);
    cv::Mat total;
    cv::blur(weight, total, cv::Size(9, 9));
    for (cv::Mat& channel : channels) {
      channel = channel.mul(weight);
      cv::blur(channel, channel, cv::Size(9, 9));
      channel = channel / cv::max(total, 1e-3);
    }
    cv::Mat mean;
    cv::merge(channels, mean);
    return mean;
  };
  const cv::Mat inside = local_mean(weight_inside);
  const cv::Mat outside = local_mean(weight_outside);
  cv::Mat edge;
  cv::erode(mask, edge, Disc(1));
  edge = mask & ~edge;
  int count = 0;
  int visible = 0;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (edge.at<uint8_t>(y, x) == 0) continue;
      ++count;
      if (cv::norm(inside.at<cv::Vec3f>(y, x) - outside.at<cv::Vec3f>(y, x)) > 8.0) ++visible;
    }
  }
  return count == 0 ? 0.0 : static_cast<double>(visible) / count;
}

void AddCandidate(std::vector<MaskCandidate>& candidates, const char* method, const cv::Mat& raw) {
  if (raw.empty()) return;
  MaskCandidate candidate;
  candidate.method = method;
  candidate.mask = CleanMask(raw, 3);
  if (candidate.mask.empty()) return;
  const double part = static_cast<double>(cv::countNonZero(candidate.mask)) / static_cast<double>(raw.total());
  if (part < 0.02 || part > 0.95) return;
  candidates.push_back(std::move(candidate));
}

void Rate(std::vector<MaskCandidate>& candidates, const cv::Mat& lab) {
  for (MaskCandidate& candidate : candidates) {
    double sum = 0.0;
    for (const MaskCandidate& other : candidates) {
      if (&other != &candidate) sum += IntersectionOverUnion(candidate.mask, other.mask);
    }
    candidate.agreement = candidates.size() < 2 ? 0.0 : sum / static_cast<double>(candidates.size() - 1);
    candidate.contrast = EdgeContrast(lab, candidate.mask);
    candidate.frame_part = FramePart(candidate.mask);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const MaskCandidate& a, const MaskCandidate& b) {
    const auto score = [](const MaskCandidate& c) { return c.agreement + c.contrast - 2.0 * c.frame_part; };
    return score(a) > score(b);
  });
}

}  // namespace

double IntersectionOverUnion(const cv::Mat& a, const cv::Mat& b) {
  const int common = cv::countNonZero(a & b);
  const int either = cv::countNonZero(a | b);
  return either == 0 ? 0.0 : static_cast<double>(common) / either;
}

cv::Mat CleanMask(const cv::Mat& mask, int sliver) {
  cv::Mat opened;
  cv::morphologyEx(mask, opened, cv::MORPH_OPEN, Disc(std::max(1, sliver / 2)), cv::Point(-1, -1), 1,
                   cv::BORDER_REPLICATE);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(opened, labels, stats, centroids, 4, CV_32S);
  int best = 0;
  double best_score = 0.0;
  for (int i = 1; i < count; ++i) {
    const double dx = centroids.at<double>(i, 0) / mask.cols - 0.5;
    const double dy = centroids.at<double>(i, 1) / mask.rows - 0.5;
    const double score = stats.at<int>(i, cv::CC_STAT_AREA) * std::exp(-4.0 * (dx * dx + dy * dy));
    if (score > best_score) {
      best_score = score;
      best = i;
    }
  }
  if (best == 0) return {};
  // Holes are background that cannot be reached from outside the picture.
  cv::Mat padded;
  cv::copyMakeBorder(labels == best, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::floodFill(padded, cv::Point(0, 0), cv::Scalar(128));
  const cv::Mat filled = padded(cv::Rect(1, 1, mask.cols, mask.rows)) != 128;
  return filled.clone();
}

std::vector<MaskCandidate> SegmentGarment(const cv::Mat& rgb,
                                          const std::function<bool(const MaskCandidate&)>& is_plausible) {
  const double scale = std::min(1.0, kWorkingSide / static_cast<double>(std::max(rgb.cols, rgb.rows)));
  cv::Mat small;
  cv::resize(rgb, small, cv::Size(), scale, scale, cv::INTER_AREA);
  cv::Mat lab = LabOf(small);
  cv::GaussianBlur(lab, lab, cv::Size(0, 0), 1.0);
  cv::theRNG().state = kRandomSeed;
  const int frame_width = std::max(2, std::min(small.cols, small.rows) / 33);
  const std::vector<BackgroundColour> palette = FindPalette(lab, FrameMask(small.size(), frame_width));
  const cv::Mat distance = PaletteDistance(lab, palette);
  const int margin = std::max(3, std::max(small.cols, small.rows) / 40);

  std::vector<MaskCandidate> candidates;
  AddCandidate(candidates, "palette", distance > OtsuLevel(distance, 12.0));
  if (!candidates.empty()) {
    AddCandidate(candidates, "palette and grabcut", RefineByGrabCut(small, candidates[0].mask, margin, 3));
  }
  Rate(candidates, lab);
  // GrabCut is the dearest step: where two methods agree on a clear edge, more of them would say the same.
  const bool is_clear = candidates.size() == 2 && candidates[0].agreement > kClearAgreement &&
                        candidates[0].contrast > kClearContrast && candidates[0].frame_part == 0.0;
  if (!is_clear || !is_plausible(candidates[0])) {
    AddCandidate(candidates, "grabcut", SegmentByRectangle(small));
    AddCandidate(candidates, "palette, low", distance > 2.5);
    if (!candidates.empty() && candidates.back().method == "palette, low") {
      AddCandidate(candidates, "low palette and grabcut", RefineByGrabCut(small, candidates.back().mask, margin, 3));
    }
  }
  Rate(candidates, lab);
  for (MaskCandidate& candidate : candidates) {
    cv::resize(candidate.mask, candidate.mask, rgb.size(), 0, 0, cv::INTER_LINEAR);
    candidate.mask = candidate.mask >= 128;
  }
  return candidates;
}

cv::Mat RefineCoverage(const cv::Mat& rgb, const cv::Mat& mask) {
  const double scale = std::max(1.0, std::max(rgb.cols, rgb.rows) / static_cast<double>(kWorkingSide));
  const int band = std::max(2, static_cast<int>(std::lround(2.0 * scale)));
  const int window = 6 * band + 1;
  cv::Mat sure_inside;
  cv::Mat around;
  cv::erode(mask, sure_inside, Disc(band), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::dilate(mask, around, Disc(band));
  cv::Mat colours;
  rgb.convertTo(colours, CV_32FC3);
  const auto local_mean = [&](const cv::Mat& where) {
    cv::Mat weight;
    where.convertTo(weight, CV_32F, 1.0 / 255.0);
    std::vector<cv::Mat> channels;
    cv::split(colours, channels);
    cv::Mat total;
    cv::blur(weight, total, cv::Size(window, window));
    for (cv::Mat& channel : channels) {
      channel = channel.mul(weight);
      cv::blur(channel, channel, cv::Size(window, window));
      channel = channel / cv::max(total, 1e-4);
    }
    cv::Mat mean;
    cv::merge(channels, mean);
    return std::make_pair(mean, total);
  };
  const auto [inside, inside_weight] = local_mean(sure_inside);
  const auto [outside, outside_weight] = local_mean(~around);
  cv::Mat smooth;
  cv::GaussianBlur(mask, smooth, cv::Size(0, 0), 0.6 * band);
  cv::Mat coverage = mask.clone();
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      if (sure_inside.at<uint8_t>(y, x) != 0 || around.at<uint8_t>(y, x) == 0) continue;
      const cv::Vec3f garment = inside.at<cv::Vec3f>(y, x);
      const cv::Vec3f difference = garment - outside.at<cv::Vec3f>(y, x);
      const double squared_contrast = difference.dot(difference);
      const double by_mask = smooth.at<uint8_t>(y, x) / 255.0;
      double value = by_mask;
      if (inside_weight.at<float>(y, x) > 0.01f && outside_weight.at<float>(y, x) > 0.01f && squared_contrast > 25.0) {
        const double by_colour =
            (colours.at<cv::Vec3f>(y, x) - outside.at<cv::Vec3f>(y, x)).dot(difference) / squared_contrast;
        // Trust in colour grows from none at a contrast of 10 grey levels to full at 50.
        const double contrast_trust = std::clamp((std::sqrt(squared_contrast) - 10.0) / 40.0, 0.0, 1.0);
        // A print of a third colour says nothing about coverage: trust ends 60 grey levels off the line between both.
        const cv::Vec3f off_line =
            colours.at<cv::Vec3f>(y, x) - outside.at<cv::Vec3f>(y, x) - static_cast<float>(by_colour) * difference;
        const double trust = contrast_trust * std::clamp((60.0 - cv::norm(off_line)) / 35.0, 0.0, 1.0);
        value = trust * std::clamp(by_colour, 0.0, 1.0) + (1.0 - trust) * by_mask;
      }
      coverage.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(255.0 * value);
    }
  }
  // What the estimate split off or punched out goes back.
  const cv::Mat solid = CleanMask(coverage >= 128, 3);
  if (solid.empty()) return smooth;
  coverage.setTo(0, ~solid & (coverage >= 128));
  coverage.setTo(255, solid & (coverage < 128));
  return coverage;
}

}  // namespace fitroom::shop_catalog
