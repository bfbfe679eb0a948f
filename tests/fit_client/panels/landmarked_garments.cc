#include "tests/fit_client/panels/landmarked_garments.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>
#include <utility>

#include "common/base/file.h"
#include "common/garment/polygon.h"
#include "common/image/decode.h"
#include "tests/support/test_data.h"

namespace fitroom::testing {
namespace {

using Landmarks = std::map<std::string, Eigen::Vector2d>;

std::string Bytes(const std::string& file) {
  Result<std::string> bytes = ReadFile(TestDataFolder() / "garments" / file, 50'000'000);
  if (!bytes.ok()) throw std::runtime_error(bytes.status().ToString());
  return std::move(bytes).value();
}

// "name": [x, y] wherever it stands; sizes and polygons do not look so.
Landmarks ReadLandmarks(const std::string& json) {
  static const std::regex kPair("\"([A-Za-z]+)\": \\[(-?[0-9.]+), (-?[0-9.]+)\\]");
  Landmarks landmarks;
  for (std::sregex_iterator it(json.begin(), json.end(), kPair), end; it != end; ++it) {
    landmarks[(*it)[1]] = Eigen::Vector2d(std::stod((*it)[2]), std::stod((*it)[3]));
  }
  return landmarks;
}

// Follows the cracks between the mask's pixels and the rest, the garment on the right hand: clockwise on the screen.
// The middles of the cracks, which half the stairs.
Polygon TraceMask(const Image& mask) {
  const auto inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < mask.width && y < mask.height && mask.at(x, y)[0] > 127;
  };
  const Eigen::Vector2i steps[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  // Pixels right ahead of a corner when walking in each direction: on the left hand and on the right.
  const Eigen::Vector2i ahead_left[4] = {{0, -1}, {0, 0}, {-1, 0}, {-1, -1}};
  const Eigen::Vector2i ahead_right[4] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
  Polygon best;
  std::vector<bool> seen(mask.pixels.size(), false);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (!inside(x, y) || inside(x, y - 1) || seen[static_cast<size_t>(y * mask.width + x)]) continue;
      Polygon polygon;
      const Eigen::Vector2i start(x, y);
      Eigen::Vector2i at = start;
      int heading = 0;
      do {
        if (heading == 0) seen[static_cast<size_t>(at.y() * mask.width + at.x())] = true;
        polygon.emplace_back(at.cast<double>() + 0.5 * steps[heading].cast<double>());
        at += steps[heading];
        const Eigen::Vector2i left = at + ahead_left[heading], right = at + ahead_right[heading];
        if (inside(left.x(), left.y())) {
          heading = (heading + 3) % 4;
        } else if (!inside(right.x(), right.y())) {
          heading = (heading + 1) % 4;
        }
      } while (at != start || heading != 0);
      if (polygon.size() > best.size()) best = std::move(polygon);
    }
  }
  return best;
}

// The landmarks' names, by image left and right, of the corners: the front's left is the wearer's right.
Landmarks CornersOf(GarmentKind kind, const Landmarks& marks) {
  std::vector<std::pair<std::string, std::string>> names;
  if (HasLegs(kind)) {
    names = {{"e3", "waistL"},       {"waist_centre", "waistM"}, {"e1", "waistR"},       {"e2", "outR"},
             {"hem_inner_L", "inR"}, {"crotch", "crotch"},       {"hem_inner_R", "inL"}, {"e4", "outL"}};
  } else if (kind == GarmentKind::kSkirt) {
    names = {{"e3", "waistL"}, {"waist_centre", "waistM"}, {"e1", "waistR"},
             {"e2", "hemR"},   {"hem_centre", "hemM"},     {"e4", "hemL"}};
  } else {
    const bool dress = kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece;
    names = {{"P1", "neckL"},        {"neck_drop", "neckM"},      {"P2", "neckR"},        {dress ? "e2" : "e3", "shR"},
             {"underarm_L", "armR"}, {"hem_L", "hemR"},           {"hem_centre", "hemM"}, {"hem_R", "hemL"},
             {"underarm_R", "armL"}, {dress ? "e6" : "e7", "shL"}};
    if (HasSleeves(kind)) {
      names.emplace_back(dress ? "sleeve_top_L" : "e4", "slRo");
      names.emplace_back("sleeve_bottom_L", "slRi");
      names.emplace_back("sleeve_bottom_R", "slLi");
      names.emplace_back(dress ? "sleeve_top_R" : "e8", "slLo");
    }
    if (marks.count("waistL") > 0) {
      names.emplace_back("waist_L", "waistR");
      names.emplace_back("waist_R", "waistL");
    }
  }
  Landmarks corners;
  for (const auto& [point, mark] : names) {
    if (marks.count(mark) == 0) throw std::runtime_error("no landmark " + mark);
    corners[point] = marks.at(mark);
  }
  return corners;
}

// As MeasureLength() defines it, along the garment's own axis.
double LengthInPixels(GarmentKind kind, const Landmarks& corners) {
  const bool bottom = IsBottom(kind);
  const Eigen::Vector2d upper = 0.5 * (corners.at(bottom ? "e1" : "P2") + corners.at(bottom ? "e3" : "P1"));
  const Eigen::Vector2d lower = 0.5 * (corners.at(bottom ? "e2" : "hem_L") + corners.at(bottom ? "e4" : "hem_R"));
  return (lower - upper).norm();
}

// Where the outline between two arc lengths passes a height.
double ArcAtHeight(const Polygon& outline, double from, double to, double y) {
  double best = from;
  for (int i = 0; i <= 400; ++i) {
    const double arc = from + (to - from) * i / 400.0;
    if (std::abs(PlaceAt(outline, arc).pixel.y() - y) < std::abs(PlaceAt(outline, best).pixel.y() - y)) best = arc;
  }
  return best;
}

}  // namespace

const std::vector<LandmarkedFile>& LandmarkedFiles() {
  static const std::vector<LandmarkedFile> kFiles = {
      {GarmentKind::kSleevedOnePiece, "dress/4569133b-2f46-464d-8405-8f7b5fe1ff6a", 0.90},
      {GarmentKind::kOnePiece, "dress/bed38b7f-0a9e-46af-864c-a790aebcc330", 0.90},
      {GarmentKind::kSleevedOnePiece, "dress/d18d6d32-50d0-4746-95e5-0b812e926f54", 0.90},
      {GarmentKind::kOnePiece, "dress/efe05a65-d5c5-4c4a-84c2-9787737488e0", 0.90},
      {GarmentKind::kLongSleeve, "longsleeve/5d4e1c72-615e-49b5-84ad-f52d18d665d2", 0.65},
      {GarmentKind::kLongSleeve, "shirt/464e94bd-fc98-4414-8869-86fad2d6ccf6", 0.70},
      {GarmentKind::kShorts, "shorts/0ec67bba-c4e8-4446-86f5-23d7f6f26809", 0.40},
      {GarmentKind::kSkirt, "skirt/038e4976-e75f-452e-bccc-2ebb5d5c0e0a", 0.60},
      {GarmentKind::kSkirt, "skirt/6d210194-60de-49c5-a215-05201cfa1a64", 0.50},
      {GarmentKind::kSkirt, "skirt/d44c49f4-e694-4ee6-a839-1579543b8e04", 0.50},
      {GarmentKind::kPants, "trousers/14625df7-84a3-435c-90a7-e57a9dce3888", 1.00},
      {GarmentKind::kPants, "trousers/52f73c9e-93da-47ae-bf67-f0e7b8216fe1", 1.00},
      {GarmentKind::kPants, "trousers/f7928953-1be4-4935-9cf6-1e70ceb7035d", 1.00},
      {GarmentKind::kTShirt, "tshirt/516f59c1-8bac-45e3-9457-a2cd5d8043df", 0.68},
      {GarmentKind::kTShirt, "tshirt/788d20a1-ad98-46fe-b80d-af9fd32a4e0f", 0.68},
      {GarmentKind::kTShirt, "tshirt/ea7b6656-3f84-4eb3-9099-23e623fc1018", 0.68}};
  return kFiles;
}

LandmarkedGarment ReadLandmarkedGarment(const LandmarkedFile& file) {
  LandmarkedGarment read;
  read.name = file.file;
  Result<Image> mask = DecodeImage(Bytes(std::string(file.file) + ".mask.png"));
  if (!mask.ok()) throw std::runtime_error(mask.status().ToString());
  read.mask = std::move(mask).value();
  Landmarks marks = ReadLandmarks(Bytes(std::string(file.file) + ".landmarks.json"));
  // One sleeve of the data has a single landmark, in the middle of its end: 8 pixels to both sides are its corners.
  if (HasSleeves(file.kind) && marks.count("slLi") == 0) {
    const Eigen::Vector2d middle = marks["slLo"];
    marks["slLi"] = middle;
    marks["slLo"] = middle + Eigen::Vector2d(5.0, -15.0);
  }
  const Landmarks corners = CornersOf(file.kind, marks);

  Garment& garment = read.garment;
  garment.id = "landmarked";
  garment.kind = file.kind;
  garment.length = file.length;
  GarmentView& view = garment.front;
  view.image_width = read.mask.width;
  view.image_height = read.mask.height;
  view.outline = TraceMask(read.mask);
  view.metre_per_pixel = file.length / LengthInPixels(file.kind, corners);

  const double perimeter = Perimeter(view.outline);
  const std::vector<std::string> order = OutlineOrder(file.kind, GarmentSide::kFront);
  std::map<std::string, double> arcs;
  double before = 0.0;
  for (const std::string& name : order) {
    if (corners.count(name) == 0) continue;
    double arc = NearestPlace(view.outline, corners.at(name)).arc_length;
    if (!arcs.empty() && arc < before) arc += perimeter;
    arcs[name] = before = arc;
  }
  if (HasLegs(file.kind)) {
    const double crotch = corners.at("crotch").y();
    arcs["crotch_level_L"] = ArcAtHeight(view.outline, arcs["e1"], arcs["e2"], crotch);
    arcs["crotch_level_R"] = ArcAtHeight(view.outline, arcs["e4"], arcs[order.front()] + perimeter, crotch);
  }
  // The others evenly between their given neighbours.
  for (size_t i = 0; i < order.size();) {
    size_t next = i + 1;
    while (next < order.size() && arcs.count(order[next]) == 0) ++next;
    const double from = arcs[order[i]];
    const double to = next < order.size() ? arcs[order[next]] : arcs[order.front()] + perimeter;
    for (size_t k = i + 1; k < next; ++k) {
      arcs[order[k]] = from + (to - from) * static_cast<double>(k - i) / static_cast<double>(next - i);
    }
    i = next;
  }
  for (const std::string& name : OutlinePointNames(file.kind)) {
    const bool inside = name == "neck_drop";  // The back of the neck may show above it.
    view.points.push_back({name, inside ? corners.at(name) : PlaceAt(view.outline, arcs.at(name)).pixel, 1.0});
  }
  return read;
}

}  // namespace fitroom::testing
