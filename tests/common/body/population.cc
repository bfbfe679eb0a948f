#include "tests/common/body/population.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "common/scan_file/scan_file.h"
#include "tests/support/test_data.h"

namespace fitroom::testing {
namespace {

std::vector<std::string> SplitLine(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

std::map<std::string, BodyTruth> ReadPopulationTruth() {
  std::map<std::string, BodyTruth> truth;
  const std::filesystem::path folder = TestDataFolder() / "bodies" / "population";
  std::string line;
  std::ifstream landmarks(folder / "landmarks.csv");
  std::getline(landmarks, line);  // id,landmark,vertex,x_cm,y_cm,z_cm
  while (std::getline(landmarks, line)) {
    const std::vector<std::string> cells = SplitLine(line);
    if (cells.size() < 6) continue;
    truth[cells[0]].landmarks[cells[1]] =
        Eigen::Vector3d(std::stod(cells[3]), std::stod(cells[4]), std::stod(cells[5]));
  }
  std::ifstream measurements(folder / "measurements.csv");
  std::getline(measurements, line);
  const std::vector<std::string> names = SplitLine(line);
  while (std::getline(measurements, line)) {
    const std::vector<std::string> cells = SplitLine(line);
    for (size_t i = 1; i < std::min(cells.size(), names.size()); ++i) {
      truth[cells[0]].measurements[names[i]] = std::strtod(cells[i].c_str(), nullptr);
    }
  }
  return truth;
}

TriangleMesh ReadBody(const std::string& path_below_bodies) {
  Result<RawScan> scan = ReadScanFile(TestDataFolder() / "bodies" / path_below_bodies);
  if (!scan.ok()) {
    ADD_FAILURE() << scan.status().ToString();
    return {};
  }
  return std::move(scan->mesh);
}

}  // namespace fitroom::testing
